/** Questions of chapter 9: what one eye keeps of the visible set of its cell. */
import { plural } from '../../formats/words.js';
import { cellAt, middleOf } from '../lab.js';
import { insideOf, number, planPicture, surely, yesNo } from './ask.js';
import { roomsOf } from './chance.js';

const sidesOf = ([x, y], { heading, fov }) => [-fov / 2, fov / 2].map((half) => ((heading + half) * Math.PI) / 180).map((angle) => [x, y, x + 3 * Math.cos(angle), y + 3 * Math.sin(angle)]);

/** An eye for which some method keeps as many cells from each place near it. */
function eyeFor(chance, lab, method, isWanted = () => true) {
    return chance.until(() => {
        const plan = roomsOf(chance, 3, 3, { missing: 0.1 }), scene = () => lab.scene(plan.text), eye = chance.place(plan.box), view = { heading: 15 * chance.whole(0, 23), fov: 60 };
        const kept = (place, options) => (cellAt(scene(), place) < 0 ? '' : String([...scene().look(...place, options)].sort()));
        const options = method === 'exact' ? { method } : { method, ...view };
        return surely((near) => kept(near, options), eye) && isWanted(scene(), eye, view) ? { plan, scene, eye, view, cell: cellAt(scene(), eye), kept: [...scene().look(...eye, options)] } : null;
    });
}

function cone(chance, lab) {
    const { plan, scene, eye, view, cell, kept } = eyeFor(chance, lab, 'disjoint_cell');
    return number('The eye looks between the two lines. Its cell is orange, and blue cells are seen from this cell. How many of all these cells does the method "disjoint cell" keep?', kept.length,
        `Of the visible set, ${plural(kept.length, 'cell')} ${kept.length === 1 ? 'meets' : 'meet'} the cone.`, 'Extend the two lines. Keep each orange or blue cell that has a part between them.',
        planPicture('Rooms, and an eye with a view cone', plan, { eye }, { scene, from: cell, seen: new Set(scene().row(cell)), lines: sidesOf(eye, view) }));
}

function exact(chance, lab) {
    const { plan, scene, eye, cell, kept } = eyeFor(chance, lab, 'exact', (map, place) => map.row(cellAt(map, place)).length > map.look(...place, { method: 'exact' }).length);
    return number('The eye looks all round. Its cell is orange, and blue cells are seen from this cell. How many of all these cells does the eye itself see?', kept.length,
        `From other places of its cell ${plural(scene().row(cell).length - kept.length, 'cell')} more can be seen.`, 'Look through each door from the place of the eye, and count cells that have a part in view.',
        planPicture('Rooms, and an eye', plan, { eye }, { scene, from: cell, seen: new Set(scene().row(cell)) }));
}

function kept(chance, lab) {
    const isWanted = chance.next() < 0.5, { plan, scene, eye, cell, kept: list } = eyeFor(chance, lab, 'exact', (map, place) => map.row(cellAt(map, place)).length > map.look(...place, { method: 'exact' }).length);
    const cells = [...scene().row(cell)].filter((other) => other !== cell && list.includes(other) === isWanted), other = cells.length ? chance.of(cells) : chance.of(insideOf(scene()).filter((each) => each !== cell));
    return yesNo('The eye looks all round. Does it see a part of the cell that is marked with X?', list.includes(other), 'Follow the sight from door to door: at each door it gets narrower.',
        planPicture('Rooms, an eye and a marked cell', plan, { eye, X: middleOf(scene(), other) }, { scene, from: cell, to: other }));
}

export const kinds = [cone, exact, kept];
