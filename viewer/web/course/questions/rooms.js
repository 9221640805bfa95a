/** Questions of chapter 2: cells, portals, and the graph that they form. */
import { drawPlan, strokeLines } from '../../parts/plan.js';
import { middleOf } from '../lab.js';
import { insideOf, number, planPicture } from './ask.js';
import { galleryOf, hallOf, roomsOf, turnsOf } from './chance.js';

function portals(chance, lab) {
    const plan = hallOf(chance, chance.whole(2, 4)), scene = () => lab.scene(plan.text), cell = chance.of(insideOf(scene()));
    return number('Dashed lines are portals. How many has the orange cell?', scene().cell(cell).portals.length, 'Each of them leads to another cell.',
        'Go round the orange cell, and count open parts of its sides. A side can have several.', planPicture('Cells of a hall, one of them orange', plan, {}, { scene, from: cell }));
}

/** Portals on the shortest way between two cells; -1 for none. */
function distance(scene, from, to) {
    const steps = new Map([[from, 0]]);
    for (const cell of steps.keys()) for (const { cell: next } of scene.cell(cell).portals) if (!steps.has(next)) steps.set(next, steps.get(cell) + 1);
    return steps.get(to) ?? -1;
}

function way(chance, lab) {
    const plan = roomsOf(chance, 4, 3), scene = () => lab.scene(plan.text), cells = insideOf(scene());
    const [from, to] = chance.until(() => {
        const pair = [chance.of(cells), chance.of(cells)];
        return distance(scene(), ...pair) > 1 ? pair : null;
    });
    return number('How many portals must be crossed at least on a walk from A to B?', distance(scene(), from, to), 'No way through the graph of cells is shorter.',
        'Number the cells: A is 0, its neighbours are 1, theirs are 2, and so on.',
        planPicture('Rooms, two of them marked', plan, { A: middleOf(scene(), from), B: middleOf(scene(), to) }, { scene }));
}

function reflex(chance) {
    const points = galleryOf(chance, 7, 11), into = turnsOf(points).filter((turn) => turn < 0).length;
    return number('How many corners of this room point into it?', into, 'At these corners the wall turns by more than half a circle inside. Convex cells cannot have them.',
        'At such a corner the angle inside is larger than 180°.', { title: 'A room with many corners', box: [0, 0, 18, 12], draw(surface, camera, tones) {
            drawPlan(surface, camera, {}, tones);
            strokeLines(surface, camera, [points.flat()], tones.wall, 3, [], true);
        } });
}

function cells(chance, lab) {
    const plan = hallOf(chance, chance.whole(1, 3)), scene = () => lab.scene(plan.text);
    return number('Into how many cells is this hall cut? Dashed lines are portals, and pillars are no cells.', scene().insideCount, 'Each cell is a convex piece of floor.',
        'Count pieces between walls, pillars and dashed lines.', planPicture('Cells of a hall with pillars', plan, {}, { scene }));
}

export const kinds = [portals, way, reflex, cells];
