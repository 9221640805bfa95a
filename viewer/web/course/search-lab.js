/**
 * Lab two, for code-lab.js: which cells one cell sees, by depth-first search over portal sequences.
 *
 * Each case is a plan and a cell. Some plans are turned by an angle whose sine is 4/5: their cells are triangles that were
 * merged, and all coordinates are whole numbers still, so the signs of the student's code are exact. Lines may touch.
 * Rooms in a row are long, or have a line that a HAIR lets through or stops.
 */
import { drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { HAIR, hiddenPlans } from './code-lab.js';
import { roomsInARow } from './ground.js';
import { insideOf, middleOf } from './lab.js';
import { drawText, drawWalls, itemsOf } from './maps.js';
import { picture } from './still.js';
import { turnedPlan } from './turned.js';

const [CELLS, LONG] = [4, 24];

/** Rooms in a row: the heights of each door, from and to. */
function rowOf(doors) {
    const width = 3 * (doors.length + 1), text = roomsInARow(doors.map(([low, high], i) => [3 * (i + 1), high, 3 * (i + 1), low]), [0, width]);
    return { text, box: [0, 0, width, 12], items: itemsOf(text) };
}

/** One line fits at most: it touches the first door from below, the second one from above, and the third one from below. */
const rows = [Array(LONG).fill([4, 6]), ...[HAIR, 0, -HAIR].map((more) => [[2, 4], [6 + more, 8], [5, 8]])].map(rowOf);

/** Cells as the student's code takes them; none has portals to the outside. */
const cellsOf = (scene) => Array.from({ length: scene.cellCount }, (_, i) => scene.cell(i).portals
    .filter(({ cell }) => scene.cellTable[6 * cell + 4]).map(({ cell, left, right }) => ({ to: cell, left, right })));

function cases(lab) {
    const [columns, flat, house, hall] = hiddenPlans();
    return [columns, flat, turnedPlan(flat), house, turnedPlan(house), hall, ...rows].flatMap((plan) => {
        const scene = lab.scene(plan.text), cells = cellsOf(scene), inside = insideOf(scene);
        const starts = Array.from({ length: CELLS }, (_, k) => inside[Math.floor(((k + 0.5) * inside.length) / CELLS)]);
        return starts.map((start) => ({ ...plan, start, given: [cells, start], about: `cell ${start}` }));
    });
}

/** The cells of a case, and one that is judged wrongly: with the library's line, if it is seen. */
const drawing = ({ text, box, items, start }, lab, wrong = -1, line = null) => (tones) => picture('A map on which the function fails', box, (surface, camera) => {
    const scene = lab.scene(text);
    drawPlan(surface, camera, { space: scene, from: start }, tones);
    if (wrong >= 0) fillPolygons(surface, camera, [scene.corners(wrong)], tones.to, 0.7);
    drawWalls(surface, camera, items, tones);
    if (line) strokeLines(surface, camera, [line], tones.sourceEdge, 3);
    for (const cell of [start, wrong].filter((number) => number >= 0)) drawText(surface, camera, middleOf(scene, cell), String(cell), tones);
}, { width: 420, most: 300 });

/** @type {import('./code-lab.js').CodeLab} */
export const searchLab = {
    call: 'visible',
    gives: 'list of numbers of cells',
    cases,
    isAnswer: (value) => Array.isArray(value) && value.every(Number.isInteger),
    draw: drawing,
    judge(lab, one, value) {
        const { text, start } = one, scene = lab.scene(text), given = new Set(value), seen = new Set(scene.row(start));
        const wrong = [...seen, ...given].find((cell) => seen.has(cell) !== given.has(cell));
        if (wrong === undefined) return null;
        if (wrong < 0 || wrong >= scene.cellCount) return { text: `there is no cell ${wrong}, which your function gives.`, draw: drawing(one, lab) };
        const line = seen.has(wrong) ? scene.explain(start, wrong).shown : null;
        const verb = line ? 'sees' : 'does not see', more = line ? ' The line is drawn.' : '';
        return { text: `cell ${start} ${verb} cell ${wrong}.${more} Your function says otherwise.`, draw: drawing(one, lab, wrong, line) };
    },
    right: (count) => `It finds what the library finds, on all ${count} maps. On some of them lines pass that only touch, or miss by less than a billionth of a millimetre.`,
};
