/** Questions of chapter 1: who sees whom, and the region of one eye. */
import { strokeLines } from '../../parts/plan.js';
import { floorArea } from '../lab.js';
import { at, number, planPicture, surely, yesNo, choice } from './ask.js';
import { hallOf, roomsOf } from './chance.js';

const LINE = 'Draw the segment between the two places. A wall that cuts it hides one from the other.';

function sees(chance, lab) {
    const plan = roomsOf(chance, 4, 3), scene = () => lab.scene(plan.text), isWanted = chance.next() < 0.5;
    const [a, b] = chance.until(() => {
        const [p, q] = [chance.place(plan.box), chance.place(plan.box)];
        if (Math.hypot(p[0] - q[0], p[1] - q[1]) < 5) return null;
        return surely((near) => scene().canSee(at(near), at(q)), p) === isWanted ? [p, q] : null;
    });
    return yesNo('Does A see B?', scene().canSee(at(a), at(b)), LINE, planPicture('Rooms with two places, A and B', plan, { A: a, B: b }));
}

function count(chance, lab) {
    const plan = hallOf(chance, 5), scene = () => lab.scene(plan.text), inside = (p) => surely((q) => scene().locate(...q) >= 0 && scene().cell(scene().locate(...q)).inside, p, 0.5);
    const eye = chance.until(() => { const p = chance.place(plan.box); return inside(p) ? p : null; });
    const marks = { eye };
    for (const letter of 'ABCDEF')
        marks[letter] = chance.until(() => {
            const p = chance.place(plan.box), apart = Object.values(marks).every(([x, y]) => Math.hypot(x - p[0], y - p[1]) > 1.5);
            return apart && inside(p) && surely((near) => scene().canSee(at(eye), at(near)), p) !== null ? p : null;
        });
    const seen = [...'ABCDEF'].filter((letter) => scene().canSee(at(eye), at(marks[letter])));
    return number('How many of the places A to F does the eye see?', seen.length, seen.length ? `It sees ${seen.join(', ')}.` : 'It sees none of them.',
        'Draw a segment from the eye to each place, and look if a pillar cuts it.', planPicture('A hall with pillars, an eye and six places', plan, marks));
}

function occluding(chance, lab) {
    const plan = hallOf(chance, chance.whole(1, 3)), scene = lab.scene(plan.text);
    const { eye, seen } = chance.until(() => {
        const p = chance.place(plan.box), cell = scene.locate(...p);
        if (cell < 0 || !scene.cell(cell).inside) return null;
        const edges = surely((near) => scene.locate(...near) < 0 ? -1 : scene.isovist(...near).edges.filter((edge) => edge === 'occluding').length, p);
        return edges > 0 ? { eye: p, seen: scene.isovist(...p) } : null;
    });
    const polygon = [...seen.polygon];
    return number('The outline is the visible region of the eye. How many of its edges are occluding?', seen.edges.filter((edge) => edge === 'occluding').length,
        'These edges go through open air, and point straight away from the eye.', 'An occluding edge does not lie on a wall. Each begins at a corner of a pillar.',
        planPicture('A hall with pillars, and the visible region of an eye', plan, { eye }, { more: (surface, camera, tones) => strokeLines(surface, camera, [polygon], tones.glass, 2, [], true) }));
}

const shares = ['less than a quarter', 'between a quarter and a half', 'between a half and three quarters', 'more than three quarters'];

function share(chance, lab) {
    const plan = roomsOf(chance, 3, 2), scene = lab.scene(plan.text), floor = floorArea(scene);
    const { eye, part } = chance.until(() => {
        const p = chance.place(plan.box), seen = scene.isovist(...p).area / floor, isClear = [0.25, 0.5, 0.75].every((border) => Math.abs(seen - border) > 0.06);
        return isClear ? { eye: p, part: seen } : null;
    });
    const why = `It sees ${Math.round(100 * part)} % of the floor. Count the squares of rooms that are seen whole, and the parts of the others.`;
    return choice('How much of the floor does the eye see?', shares.map((text) => [text, why]), Math.floor(4 * part), planPicture('Six rooms, and an eye', plan, { eye }));
}

export const kinds = [sees, count, occluding, share];
