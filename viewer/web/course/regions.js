/** Chapter 10: all cells at once, by quadrants of directions. */
import { plural } from '../formats/words.js';
import { drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { element } from './figure.js';
import { round } from './lab.js';
import { drawWalls, grid, itemsOf } from './maps.js';

/** Quadrants: the signs of the directions, right and up. */
const quadrants = { ne: [1, 1, 'right and up'], nw: [-1, 1, 'left and up'], sw: [-1, -1, 'left and down'], se: [1, -1, 'right and down'] };

/** Rooms of a grid, and what each of them sees, by the library. */
const rooms = new Map();
function roomsOf(lab, columns, rows) {
    const key = `${columns} ${rows}`;
    if (rooms.has(key)) return rooms.get(key);
    const scene = lab.scene(grid(columns, rows)), list = [], ofCell = new Map();
    for (let i = 0; i < columns * rows; i++) {
        const [x, y] = [i % columns, Math.floor(i / columns)], cell = scene.locate(4 * x + 2, 4 * y + 2);
        list.push({ x, y, cell, square: [4 * x, 4 * y, 4 * x + 4, 4 * y, 4 * x + 4, 4 * y + 4, 4 * x, 4 * y + 4] });
        ofCell.set(cell, i);
    }
    for (const room of list) room.sees = [...scene.row(room.cell)].map((cell) => ofCell.get(cell));
    const result = { columns, rows, list };
    rooms.set(key, result);
    return result;
}

/** Rooms that a room sees in a quadrant. */
const directed = ({ list }, at, [sx, sy]) => list[at].sees.filter((to) => (list[to].x - list[at].x) * sx >= 0 && (list[to].y - list[at].y) * sy >= 0);

/** The neighbours that sightlines of a quadrant enter next. */
function nextOf({ list, columns, rows: count }, at, [sx, sy]) {
    const { x, y } = list[at], next = [];
    if (x + sx >= 0 && x + sx < columns) next.push(at + sx);
    if (y + sy >= 0 && y + sy < count) next.push(at + sy * columns);
    return next;
}

/** The refine set: the room itself, and what its next neighbours see in the quadrant. */
const refineSet = (plan, at, quadrant) =>
    new Set([at, ...nextOf(plan, at, quadrant).flatMap((next) => directed(plan, next, quadrant))]);

/** Rooms in an order in which the next neighbours come first. */
const orderOf = ({ list }, [sx, sy]) => list.map((_, i) => i).sort((a, b) => sx * (list[b].x - list[a].x) + sy * (list[b].y - list[a].y) || a - b);

const COLUMNS = 8, ROWS = 5, box = [0, 0, 4 * COLUMNS, 4 * ROWS], items = itemsOf(grid(COLUMNS, ROWS));
const choice = { name: 'way', label: 'directions', kind: 'choice', value: 'ne', options: Object.entries(quadrants).map(([key, [, , name]]) => [key, name]) };

const roomAt = ([x, y]) => Math.min(ROWS - 1, Math.floor(y / 4)) * COLUMNS + Math.min(COLUMNS - 1, Math.floor(x / 4));

function drawRooms(surface, camera, tones, { plan, at, seen, refine, done = [] }) {
    const squares = (list) => [...list].map((i) => plan.list[i].square);
    drawPlan(surface, camera, { items: [] }, tones);
    fillPolygons(surface, camera, squares(done), tones.floor[0]);
    fillPolygons(surface, camera, squares(seen), tones.seen[0]);
    fillPolygons(surface, camera, squares([at]), tones.source);
    strokeLines(surface, camera, squares(refine), tones.to, 3, [6, 4], true);
    drawWalls(surface, camera, items, tones);
}

const sets = {
    title: 'A directed visible set.',
    about: 'The dot chooses a view cell. Blue ones are seen in the chosen directions. Dashed ones are seen by the next neighbours, and are the candidates.',
    box,
    handles: [{ name: 'dot', at: [10, 6] }],
    controls: [choice],
    update(state, lab) {
        state.plan = roomsOf(lab, COLUMNS, ROWS);
        state.at = roomAt(state.dot);
        state.seen = directed(state.plan, state.at, quadrants[state.way]);
        state.refine = refineSet(state.plan, state.at, quadrants[state.way]);
    },
    draw: drawRooms,
    tell: ({ plan, at, seen, refine, way }) => `View cell ${at} looks ${quadrants[way][2]} and sees ${seen.length} of ${plan.list.length} view cells. ` +
        `${plural(refine.size, 'candidate')} had to be tested.`,
};

const order = {
    title: 'One pass.',
    about: 'The slider goes through the view cells in order. White ones are done; the orange one is next, and its candidates are dashed.',
    box,
    handles: [],
    controls: [choice, { name: 'step', label: 'step', kind: 'range', value: 18, min: 1, max: COLUMNS * ROWS }],
    update(state, lab) {
        const plan = (state.plan = roomsOf(lab, COLUMNS, ROWS)), quadrant = quadrants[state.way], list = orderOf(plan, quadrant);
        state.done = list.slice(0, state.step);
        state.at = list[state.step - 1];
        state.seen = directed(plan, state.at, quadrant);
        state.refine = refineSet(plan, state.at, quadrant);
        state.tested = state.done.reduce((sum, at) => sum + refineSet(plan, at, quadrant).size, 0);
        state.found = state.done.reduce((sum, at) => sum + directed(plan, at, quadrant).length, 0);
    },
    draw: drawRooms,
    tell: ({ plan, step, tested, found }) => `Step ${step} of ${plan.list.length}: ${plural(tested, 'candidate')} tested so far, ${found} of them seen: ` +
        `${round(tested / found, 2)} tests for each. Testing all would have taken ${step * plan.list.length}.`,
};

const growth = {
    title: 'Work against output.',
    about: 'The slider adds columns of rooms. The table has four passes, one for each quadrant.',
    box,
    handles: [],
    controls: [{ name: 'columns', label: 'columns', kind: 'range', value: 5, min: 2, max: COLUMNS }],
    update(state, lab) {
        const plan = roomsOf(lab, state.columns, ROWS);
        const sum = (of) => Object.values(quadrants).reduce((all, quadrant) => all + plan.list.reduce((s, _, at) => s + of(plan, at, quadrant), 0), 0);
        state.text = grid(state.columns, ROWS);
        state.count = plan.list.length;
        state.found = sum((p, at, quadrant) => directed(p, at, quadrant).length);
        state.tested = sum((p, at, quadrant) => refineSet(p, at, quadrant).size);
        state.all = 4 * state.count ** 2;
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { items: itemsOf(state.text) }, tones);
    },
    beside(state) {
        const row = (cells, tag) => element('tr', {}, ...cells.map((cell) => element(tag, {}, String(cell))));
        return element('table', {}, element('thead', {}, row(['what', 'number', 'for each found'], 'th')), element('tbody', {},
            ...[['found', state.found], ['tested by multipass', state.tested], ['each with all', state.all]].map(([what, n]) => row([what, n, round(n / state.found, 2)], 'td'))));
    },
    tell: (state) => `${plural(state.count, 'view cell')}: ${state.found} relations found. Multipass tests ${state.tested} candidates, and testing all would take ${state.all}.`,
};

export const figures = { sets, order, growth };

export const exercises = {
    passes: {
        kind: 'number',
        question: 'In the plane there are 4 quadrants, so 4 passes. How many passes are needed in space, with three axes?',
        right: () => 2 ** 3,
        why: 'Each axis has two signs, and there are three axes: 2 times 2 times 2 octants, with one pass for each.',
        low: 'Count the signs. Each of the three axes has a plus and a minus.',
        high: 'Each axis doubles the number of passes, and there are three axes.',
    },
    reason: {
        kind: 'choice',
        question: 'A view cell sees an object in the distance, right and up. Why must the next neighbour on the right or above see it, too?',
        options: [
            ['Because neighbours have nearly the same place.', 'Near is not enough. A wall between them could change everything. The sightline itself is the reason.'],
            ['Because the sightline goes through one of them, and its rest begins there.', 'A line to the right and up leaves the view cell through its right or upper side. The rest of it is a sightline of the neighbour.'],
            ['Because visibility goes both ways.', 'That is true, but it says nothing about neighbours. Follow the sightline out of the view cell.'],
        ],
        right: () => 1,
    },
    first: {
        kind: 'place',
        question: 'A pass takes the directions right and up. Put the dot into the view cell that can be done first, before all others.',
        solution: [[30, 18]],
        figure: { ...sets, title: 'Where does the pass begin?', about: 'Drag the dot, then press Check.', controls: [],
            update(state, lab) {
                state.plan = roomsOf(lab, COLUMNS, ROWS);
                Object.assign(state, { at: roomAt(state.dot), seen: [], refine: [] });
            },
            tell: ({ at }) => `The dot is in view cell ${at}.` },
        judge({ plan, at }) {
            const waits = nextOf(plan, at, quadrants.ne);
            if (!waits.length) return { right: true, text: 'It has no neighbour on the right or above, so it waits for nobody. Its only candidate is itself.' };
            return { right: false, text: `It waits for ${plural(waits.length, 'neighbour')}: ${waits.join(' and ')}. Go where the sightlines leave the map.` };
        },
    },
};
