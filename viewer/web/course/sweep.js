/** Chapter 8: a line that rotates about corners, what it joins, and what it costs. */
import { plural } from '../formats/words.js';
import { svg } from '../parts/dual.js';
import { drawDot, drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { classes, classValues } from './classes.js';
import { table } from './figure.js';
import { hallOf, WIDEST } from './halls.js';
import { cellAt, insideOf, middleOf, round, within } from './lab.js';
import { drawText, drawWalls, flat, hall, house, itemsOf } from './maps.js';
import { Pairs, joinAll, pivotsOf, rotate, seenFrom } from './rotate.js';

const houseItems = itemsOf(house.text), flatItems = itemsOf(flat.text);

const nearestTo = ([x, y], places) => places.reduce((best, { at }, i) =>
    (Math.hypot(at[0] - x, at[1] - y) < Math.hypot(places[best].at[0] - x, places[best].at[1] - y) ? i : best), 0);

const sweeps = new Map();

/** All rotations of a map, and the pairs that each of them finds first; computed once. */
function sweepOf(lab, text) {
    if (sweeps.has(text)) return sweeps.get(text);
    const scene = lab.scene(text, { sight: 'open' }), pivots = pivotsOf(scene), pairs = new Pairs(scene.cellCount);
    const turns = pivots.map((pivot) => rotate(scene, pivot));
    const found = turns.map((stretches) => stretches.flatMap(({ before, behind }) => joinAll(pairs, before, behind)));
    const cells = insideOf(scene);
    const late = cells.flatMap((a) => joinAll(pairs, [a], [...seenFrom(scene, middleOf(scene, a))]));
    const sweep = { pivots, turns, found, late, cells };
    sweeps.set(text, sweep);
    return sweep;
}

/** The pairs that a map's library has, for tests: with open sight, as this page. */
export function comparePairs(lab, text) {
    const { found, late, cells } = sweepOf(lab, text), scene = lab.scene(text, { sight: 'open' }), pairs = new Pairs(scene.cellCount);
    for (const [a, b] of [...found.flat(), ...late]) pairs.add(a, b);
    const rows = new Map(cells.map((a) => [a, new Set(scene.row(a))]));
    const wrong = cells.flatMap((a) => cells.filter((b) => b > a && rows.get(a).has(b) !== pairs.has(a, b)));
    return { pairs: pairs.all.size, late: late.length, wrong: wrong.length };
}

const list = (cells) => (cells.length ? cells.join(', ') : 'none');

const turn = {
    title: 'A line rotates.',
    about: 'The dot chooses a corner, the slider the direction. Blue cells lie before the corner, yellow ones behind it. Cells of new pairs have a green outline, and the sentence lists the pairs.',
    box: house.box,
    handles: [{ name: 'dot', at: [12, 5] }],
    controls: [{ name: 'at', label: 'direction', kind: 'range', value: 26, min: 1, max: 119 }],
    update(state, lab) {
        const { pivots, turns } = sweepOf(lab, house.text), scene = (state.scene = lab.scene(house.text, { sight: 'open' }));
        const number = nearestTo(state.dot, pivots), stretches = turns[number], angle = pivots[number].from + (state.at / 120) * pivots[number].size;
        state.corner = pivots[number].at;
        state.count = stretches.length;
        state.now = Math.max(0, stretches.findIndex(({ to }) => angle < to));
        state.stretch = stretches[state.now];
        const known = new Pairs(scene.cellCount), { before, behind } = state.stretch, [x, y] = state.corner;
        for (const past of stretches.slice(0, state.now)) joinAll(known, past.before, past.behind);
        state.fresh = joinAll(known, before, behind);
        state.degrees = ((angle * 180) / Math.PI) % 360;
        const [dx, dy] = [40 * Math.cos(angle), 40 * Math.sin(angle)];
        state.line = within(scene, [x - dx, y - dy, x + dx, y + dy], [before.at(-1), behind.at(-1)]);
    },
    marks: {
        before: ({ scene, stretch }) => ({ areas: stretch.before.map((cell) => scene.corners(cell)) }),
        behind: ({ scene, stretch }) => ({ areas: stretch.behind.map((cell) => scene.corners(cell)) }),
    },
    draw(surface, camera, tones, state) {
        const { scene, stretch: { before, behind } } = state;
        drawPlan(surface, camera, { space: scene, seen: new Set(before) }, tones);
        fillPolygons(surface, camera, behind.map((cell) => scene.corners(cell)), tones.region, 0.75);
        strokeLines(surface, camera, before.map((cell) => scene.corners(cell)), tones.glass, 1.5, [], true);
        drawWalls(surface, camera, houseItems, tones);
        strokeLines(surface, camera, [...new Set(state.fresh.flat())].map((cell) => scene.corners(cell)), tones.portal, 3, [], true);
        for (const cell of [...before, ...behind]) drawText(surface, camera, middleOf(scene, cell), String(cell), tones);
        strokeLines(surface, camera, [state.line], tones.sourceEdge, 2.5);
        drawDot(surface, camera, state.corner, 5, tones.start, tones.page);
    },
    tell: ({ corner, now, count, degrees, stretch, fresh }) => `Corner at ${corner.join(', ')}, direction ${round(degrees)}°, after ${now} of ${plural(count - 1, 'event')}. ` +
        `Before: cells ${list(stretch.before)}. Behind: cells ${list(stretch.behind)}. ${fresh.length ? `New: ${fresh.map(([a, b]) => `${a} with ${b}`).join(', ')}` : 'No new pairs'}.`,
};

/** As the command `compare` counts: ordered pairs, and each cell with itself. */
const countOf = ({ all }, cells) => 2 * all.size + cells.length;

/** Which pairs are found, as a square of squares. */
function matrix({ cells, pairs, all }, tones) {
    const size = 10, width = cells.length * size, squares = cells.flatMap((a, i) => cells.map((b, j) => {
        const fill = a === b ? tones.outline : pairs.has(a, b) ? tones.glass : all.has(a, b) ? tones.region : tones.floor[0];
        return svg('rect', { x: j * size, y: i * size, width: size - 1, height: size - 1, fill });
    }));
    return svg('svg', { viewBox: `0 0 ${width} ${width}`, role: 'img',
        'aria-label': `Pairs of ${cells.length} cells: ${countOf(pairs, cells)} found, ${2 * (all.all.size - pairs.all.size)} not found yet` }, ...squares);
}

const every = {
    title: 'All corners in turn.',
    about: 'The slider adds corners, and the dot chooses a cell. Blue cells are joined with it so far, dashed ones later. In the table of pairs, blue is found and yellow is missing.',
    box: house.box,
    handles: [{ name: 'dot', at: [8, 12] }],
    controls: [
        { name: 'corners', label: 'corners', kind: 'range', value: 4, min: 0, max: 17 },
        { name: 'late', label: 'also look from each cell', kind: 'check', value: false },
    ],
    update(state, lab) {
        const { pivots, found, late, cells } = sweepOf(lab, house.text), scene = (state.scene = lab.scene(house.text, { sight: 'open' }));
        state.pivots = pivots;
        state.cells = cells;
        state.done = Math.min(state.corners, pivots.length);
        [state.pairs, state.all] = [new Pairs(scene.cellCount), new Pairs(scene.cellCount)];
        for (const [a, b] of [...found.slice(0, state.done).flat(), ...(state.late ? late : [])]) state.pairs.add(a, b);
        for (const [a, b] of [...found.flat(), ...late]) state.all.add(a, b);
        state.cell = cellAt(scene, state.dot);
        state.seen = new Set(cells.filter((b) => state.cell >= 0 && state.pairs.has(state.cell, b)));
        state.missing = cells.filter((b) => state.cell >= 0 && state.all.has(state.cell, b) && !state.seen.has(b));
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { space: state.scene, from: state.cell, seen: state.seen }, tones);
        strokeLines(surface, camera, state.missing.map((cell) => state.scene.corners(cell)), tones.to, 2, [5, 3], true);
        drawWalls(surface, camera, houseItems, tones);
        state.pivots.forEach(({ at }, i) => drawDot(surface, camera, at, i < state.done ? 5 : 3, i < state.done ? tones.start : tones.faint, tones.page));
    },
    beside: matrix,
    tell: (state) => `${state.done} of ${plural(state.pivots.length, 'corner')}: ${countOf(state.pairs, state.cells)} of ${plural(countOf(state.all, state.cells), 'pair')} found. ` +
        (state.cell < 0 ? 'The dot is in no cell.' : `Cell ${state.cell} is joined with ${plural(state.seen.size, 'cell')}, and ${state.missing.length} more will come.`),
};

/** Halls by columns, as they come from the worker. */
const halls = [];
let figureOfHalls = null, trouble = '';

function computeHalls() {
    const worker = new Worker(new URL('./halls-worker.js', import.meta.url), { type: 'module' });
    worker.addEventListener('message', ({ data }) => {
        halls[data.columns] = data;
        if (data.columns === WIDEST) worker.terminate();
        figureOfHalls.change();
    });
    worker.addEventListener('error', (event) => {
        trouble = event.message || 'a part of the page was not loaded';
        figureOfHalls.change();
    });
}

const growth = {
    title: 'A hall that grows.',
    about: 'The slider adds columns of pillars. Lines are the visibility graph: corners that see each other. The dot chooses a corner.',
    box: [0, 0, 24, 12],
    handles: [{ name: 'dot', at: [5.8, 4.7] }],
    controls: [{ name: 'columns', label: 'columns', kind: 'range', value: 3, min: 1, max: WIDEST }],
    start(figure) {
        figureOfHalls = figure;
        computeHalls();
    },
    isReady: () => Boolean(halls[WIDEST] || trouble),
    update(state) {
        const known = (state.known = halls[state.columns]);
        state.rows = halls.slice(1, state.columns + 1).map(({ row }) => row);
        state.items = itemsOf(hall(state.columns));
        if (!known) return;
        const [x, y] = (state.corner = known.corners[nearestTo(state.dot, known.corners)].at);
        state.own = known.edges.filter(([a, b, c, d]) => (a === x && b === y) || (c === x && d === y));
    },
    draw(surface, camera, tones, { known, items, own, corner }) {
        drawPlan(surface, camera, { items }, tones);
        if (!known) return;
        strokeLines(surface, camera, known.edges, tones.outline, 0.75);
        strokeLines(surface, camera, own, tones.glass, 1.5);
        drawWalls(surface, camera, items, tones);
        drawDot(surface, camera, corner, 5, tones.start, tones.page);
    },
    beside: (state) => table(['columns', 'cells', 'edges', 'sweep', 'search'], state.rows),
    tell({ known, own, columns: wanted }) {
        if (!known) return trouble ? `The halls cannot be computed here: ${trouble}.` : `The hall with ${plural(wanted, 'column')} is being computed.`;
        const [columns, cells, edges, pieces, nodes] = known.row;
        return `${plural(columns, 'column')}, ${plural(cells, 'cell')}, ${plural(edges, 'edge')} of the visibility graph, ${own.length} of them at this corner. ` +
            `The sweep looks at ${pieces} pieces, ${round(pieces / edges)} for each edge. The search enters ${nodes} nodes, ${round(nodes / edges)} for each edge.`;
    },
};

/** Numbers of the text, from the least hall and the widest one. */
const rows = [];
const rowOf = (lab, columns) => (rows[columns] ??= hallOf(lab, columns).row);
const times = (lab, at) => rowOf(lab, WIDEST)[at] / rowOf(lab, 1)[at];
export const values = {
    ...classValues,
    'pieces-first': (lab) => round(rowOf(lab, 1)[3] / rowOf(lab, 1)[2]),
    'pieces-last': (lab) => round(rowOf(lab, WIDEST)[3] / rowOf(lab, WIDEST)[2]),
    'nodes-first': (lab) => round(rowOf(lab, 1)[4] / rowOf(lab, 1)[2]),
    'nodes-last': (lab) => round(rowOf(lab, WIDEST)[4] / rowOf(lab, WIDEST)[2]),
    'cells-times': (lab) => round(times(lab, 1)),
    'nodes-times': (lab) => Math.round(times(lab, 4)),
    'power': (lab) => round(Math.log(times(lab, 4)) / Math.log(times(lab, 1))),
};

export const figures = { turn, every, growth, classes };

const pillar = 'sightline 1\nwalls 0 0 10 0 10 10 0 10 0 0\nsolid 4 4 6 4 6 6 4 6\n';

/** Two cells of the flat, far apart. */
const far = (scene) => [scene.locate(1, 1), scene.locate(16, 11)];

export const exercises = {
    corners: {
        kind: 'number',
        question: 'A square room has one square pillar in its middle. How many corners must the line rotate about?',
        right: (lab) => pivotsOf(lab.scene(pillar)).length,
        why: 'Each corner of the pillar has walls on one side, and free space over three quarters of a turn. The corners of the room have a quarter only.',
        low: 'Which corners can a line touch and go on, on both sides of them? Look at the pillar.',
        high: 'A line cannot pass a corner of the room: both its halves would have to lie in a quarter of a turn.',
    },
    event: {
        kind: 'choice',
        question: 'The backward half of the line meets cells A and B. Now cell C comes into the sight of the forward half. Which pairs are found?',
        options: [
            ['A and B, A and C, B and C.', 'A and B lie on the same half. This corner is not between them, so another corner has to join them, or they look at each other directly.'],
            ['A and C, B and C.', 'The line crosses A, B, the corner and C, and no wall. So C is joined with all cells of the other half: one operation on a row of bits.'],
            ['None, before the line has gone all the way round.', 'Each event can be dealt with at once. At this moment the line passes from A and B to C, and that is enough.'],
        ],
        right: () => 1,
    },
    joins: {
        kind: 'place',
        question: 'Put the dot on a corner about which the line joins the two marked cells.',
        solution: [[9, 8]],
        figure: { title: 'Which corner joins them?', about: 'Drag the dot, then press Check. The nearest corner counts.', box: flat.box, handles: [{ name: 'dot', at: [13, 5] }],
            update(state, lab) {
                state.scene = lab.scene(flat.text, { sight: 'open' });
                state.pivots = sweepOf(lab, flat.text).pivots;
                state.number = nearestTo(state.dot, state.pivots);
            },
            draw(surface, camera, tones, state) {
                const [from, to] = far(state.scene);
                drawPlan(surface, camera, { space: state.scene, from, to }, tones);
                drawWalls(surface, camera, flatItems, tones);
                for (const { at } of state.pivots) drawDot(surface, camera, at, 4, tones.start, tones.page);
            },
            tell: (state) => `The nearest corner is at ${state.pivots[state.number].at.join(', ')}.` },
        judge({ number }, lab) {
            const { pivots, turns } = sweepOf(lab, flat.text), [a, b] = far(lab.scene(flat.text, { sight: 'open' }));
            const joins = turns[number].filter(({ before, behind }) => (before.includes(a) && behind.includes(b)) || (before.includes(b) && behind.includes(a)));
            const where = `The corner at ${pivots[number].at.join(', ')}`;
            if (!joins.length) return { right: false, text: `${where} joins other cells. Take a corner that a line between the two cells could touch.` };
            const degrees = joins.reduce((sum, { from, to }) => sum + ((to - from) * 180) / Math.PI, 0);
            return { right: true, text: `${where} joins them, while the line rotates by ${round(degrees, 1)}°.` };
        },
    },
};
