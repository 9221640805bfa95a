/** Chapter 11: hierarchical culling with coherence, and view cells that follow what is seen. */
import { plural } from '../formats/words.js';
import { fillPolygons, drawPlan, strokeLines } from '../parts/plan.js';
import { mix } from '../parts/tones.js';
import { element } from './figure.js';
import { cellAt, round } from './lab.js';
import { drawWalls, grid, house, itemsOf } from './maps.js';
import { firstState } from './still.js';

const plan = { text: grid(8, 5), box: [0, 0, 32, 20] };
const planItems = itemsOf(plan.text);

/** The kd-tree of a scene: each node has its cells, and is a child or a pair of children. */
function treeOf(scene) {
    const nodes = scene.nodes, list = [];
    const make = (at, parent) => {
        const node = { id: list.length, parent, cells: [], children: [] };
        list.push(node);
        if (at < 0) node.cells = [~at];
        else {
            node.children = [make(nodes[at].below, node), make(nodes[at].above, node)];
            node.cells = node.children.flatMap((child) => child.cells);
        }
        return node;
    };
    return { root: make(scene.root, null), list };
}

/** What a test of a node says. */
function stateOf(node, seen) {
    const count = node.cells.filter((cell) => seen.has(cell)).length;
    return count === 0 ? 'hidden' : count === node.cells.length ? 'visible' : 'partly';
}

/** From a node down: tests it, and goes on where it is partly visible. Gives the nodes where it ends. */
function descend(node, seen, ends) {
    const state = stateOf(node, seen);
    if (state !== 'partly') return ends.push({ node, state }), 1;
    return 1 + node.children.reduce((tests, child) => tests + descend(child, seen, ends), 0);
}

/** Neighbours of one state become their parent, which is not tested. */
function pullUp(ends) {
    const byNode = new Map(ends.map((end) => [end.node, end]));
    for (const end of ends) {
        let { node } = end;
        while (node.parent) {
            const [a, b] = node.parent.children.map((child) => byNode.get(child));
            if (!a || !b || a.state !== b.state) break;
            byNode.delete(a.node);
            byNode.delete(b.node);
            node = node.parent;
            byNode.set(node, { node, state: a.state });
        }
    }
    return [...byNode.values()];
}

/** One frame from the ends of the last one. `skip` of the visible ends are not tested. */
function update(last, seen, skip) {
    const ends = [];
    let tests = 0;
    for (const end of last)
        if (end.state === 'visible' && skip()) ends.push(end);
        else tests += descend(end.node, seen, ends);
    return { tests, ends: pullUp(ends) };
}

const bounds = (scene, node) => {
    const p = node.cells.flatMap((cell) => [...scene.corners(cell)]), xs = p.filter((_, i) => i % 2 === 0), ys = p.filter((_, i) => i % 2);
    const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    return [x0, y0, x1, y0, x1, y1, x0, y1];
};

function drawEnds(surface, camera, tones, state) {
    drawPlan(surface, camera, { items: [] }, tones);
    const boxes = (kind) => state.ends.filter((end) => end.state === kind).map((end) => bounds(state.scene, end.node));
    fillPolygons(surface, camera, boxes('visible'), tones.seen[0]);
    strokeLines(surface, camera, [...boxes('visible'), ...boxes('hidden')], tones.glass, 1.5, [], true);
    drawWalls(surface, camera, planItems, tones);
}

const hierarchy = {
    title: 'Tests in a tree.',
    about: 'Drag the eye. Each blue box is a node where the test ends: filled, if all of it is kept, and empty, if all of it is hidden.',
    box: plan.box,
    handles: [{ name: 'eye', at: [14, 9] }],
    update(state, lab) {
        const scene = (state.scene = lab.scene(plan.text)), cell = cellAt(scene, state.eye);
        state.tree ??= treeOf(scene);
        state.seen = new Set(cell < 0 ? [] : scene.look(...state.eye, { method: 'exact' }));
        state.ends = [];
        state.tests = descend(state.tree.root, state.seen, state.ends);
    },
    draw: drawEnds,
    tell: (state) => `${plural(state.scene.cellCount, 'cell')}, ${state.seen.size} seen. ` +
        `The tree has ${plural(state.tree.list.length, 'node')}; ${plural(state.tests, 'test')} are enough.`,
};

/** A way through rooms of the plan, and the eye at a frame. */
const way = [[2, 2], [6, 1.7], [10.6, 2.6], [10.6, 7], [14, 6.4], [18, 6], [18, 9], [22, 9.6], [22, 13.5], [26, 14], [30, 13], [30, 18]];
const FRAMES = 180;
function eyeAt(frame) {
    const t = (frame / FRAMES) * (way.length - 1), i = Math.min(way.length - 2, Math.floor(t)), s = t - i;
    return way[i].map((v, k) => v + s * (way[i + 1][k] - v));
}

let walked;
/** What is seen in each frame, and the tests without coherence; computed once. */
function framesOf(scene) {
    if (walked) return walked;
    const tree = treeOf(scene);
    walked = { tree, frames: [] };
    for (let i = 0; i <= FRAMES; i++) {
        const eye = eyeAt(i), seen = new Set(scene.look(...eye, { method: 'exact' })), ends = [];
        walked.frames.push({ eye, seen, classical: descend(tree.root, seen, ends) });
    }
    return walked;
}

/** A chance that is the same each time: the next number of a simple sequence. */
function chances(share) {
    let number = 1;
    return () => (number = (number * 48271) % 2147483647) / 2147483647 < share;
}

const svg = (tag, attributes, ...children) => {
    const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    node.append(...children);
    return node;
};

/** A step of 1, 2 or 5 times a power of ten that divides a length into up to five parts. */
const stepOf = (length) => [1, 2, 5, 10].map((f) => f * 10 ** Math.floor(Math.log10(length / 5))).find((step) => length / step <= 5);

/**
 * Curves over a common scale, with a title for those who cannot see them.
 * @param {{title: string, across: string, up: string, from?: (i: number) => number}} words `from` numbers the axis across
 * @param {{name: string, values: number[], tone: string}[]} curves @param {number} at the place across that is marked
 */
function chart({ title, across, up, from = (i) => i }, curves, tones, at) {
    const [left, right, top, bottom] = [34, 292, 42, 172], most = Math.max(1, ...curves.flatMap((curve) => curve.values)), count = curves[0].values.length - 1;
    const x = (i) => left + ((right - left) * i) / count, y = (v) => bottom - ((bottom - top) * v) / most;
    const line = (x1, y1, x2, y2, stroke) => svg('line', { x1, y1, x2, y2, stroke }), words = (at, text) => svg('text', { 'font-size': 11, fill: tones.ink, ...at }, text);
    const marks = (low, high) => Array.from({ length: Math.floor(high / stepOf(high - low)) + 1 }, (_, i) => i * stepOf(high - low)).filter((v) => v >= low);
    const [low, high] = [from(0), from(count)].sort((a, b) => a - b), placeOf = (number) => x(from(0) < from(count) ? number - low : high - number);
    return svg('svg', { viewBox: '0 0 300 204', role: 'img', 'aria-label': title },
        ...marks(0, most).flatMap((v) => [line(left, y(v), right, y(v), tones.outline), words({ x: left - 4, y: y(v) + 4, 'text-anchor': 'end' }, String(v))]),
        ...marks(low, high).flatMap((v) => [line(placeOf(v), bottom, placeOf(v), bottom + 4, tones.ink), words({ x: placeOf(v), y: bottom + 15, 'text-anchor': 'middle' }, String(v))]),
        line(left, bottom, right, bottom, tones.ink), line(left, top, left, bottom, tones.ink),
        words({ x: 4, y: 30 }, up), words({ x: (left + right) / 2, y: 201, 'text-anchor': 'middle' }, across),
        ...curves.flatMap(({ name, values, tone }, k) => [
            svg('polyline', { points: values.map((v, i) => `${x(i).toFixed(1)},${y(v).toFixed(1)}`).join(' '), fill: 'none', stroke: tones[tone], 'stroke-width': 1.5 }),
            svg('text', { x: 4 + 96 * k, y: 13, 'font-size': 11, fill: tones[tone] }, name)]),
        svg('line', { x1: x(at), x2: x(at), y1: top, y2: bottom, stroke: tones.ink, 'stroke-dasharray': '3 3' }));
}

const coherence = {
    title: 'A walk of 180 steps.',
    about: 'The first slider goes along the way. The second one is the chance that a visible node is not tested. The curves count tests in each frame.',
    box: plan.box,
    handles: [],
    controls: [
        { name: 'frame', label: 'frame', kind: 'range', value: 60, min: 0, max: FRAMES },
        { name: 'share', label: 'chance to skip', kind: 'range', value: 0.5, min: 0, max: 0.9, step: 0.1 },
    ],
    update(state, lab) {
        state.scene = lab.scene(plan.text);
        const { tree, frames } = framesOf(state.scene), never = () => false, skip = chances(state.share);
        let [plain, bold] = [null, null];
        state.curves = [[], [], []];
        frames.forEach(({ seen, classical }, i) => {
            const start = [{ node: tree.root, state: 'partly' }];
            plain = update(plain?.ends ?? start, seen, never);
            bold = update(bold?.ends ?? start, seen, skip);
            [classical, plain.tests, bold.tests].forEach((tests, k) => state.curves[k].push(tests));
            if (i === state.frame) Object.assign(state, { ends: bold.ends, eye: frames[i].eye, seen });
        });
        state.kept = new Set(state.ends.filter((end) => end.state === 'visible').flatMap((end) => end.node.cells)).size;
    },
    draw(surface, camera, tones, state) {
        drawEnds(surface, camera, tones, state);
        strokeLines(surface, camera, [way.flat()], tones.path, 1.5, [6, 4]);
        fillPolygons(surface, camera, [[-0.4, -0.4, 0.4, -0.4, 0.4, 0.4, -0.4, 0.4].map((v, k) => v + state.eye[k % 2])], tones.sourceEdge);
    },
    beside: (state, tones) => chart({ title: 'Tests in each frame, by three methods', across: 'frame', up: 'tests' }, [
        { name: 'from the root', values: state.curves[0], tone: 'ink' }, { name: 'updating', values: state.curves[1], tone: 'glass' },
        { name: 'and skipping', values: state.curves[2], tone: 'start' }], tones, state.frame),
    tell(state) {
        const mean = state.curves.map((curve) => round(curve.reduce((a, b) => a + b) / curve.length));
        return `Frame ${state.frame}, chance ${state.share}. Tests in a frame, on average: ${mean[0]} from the root, ${mean[1]} updating, ` +
            `${mean[2]} with skipping. ${state.seen.size} cells are seen here, and ${state.kept} are kept.`;
    },
};

/** Merges neighbouring cells, the cheapest pair first; `blind` takes the smallest pair instead. */
function mergesOf(scene, blind) {
    const groups = [], area = (cell) => {
        const p = scene.corners(cell);
        let sum = 0;
        for (let k = 0; k < p.length; k += 2) sum += (p[k] * p[(k + 3) % p.length] - p[(k + 2) % p.length] * p[k + 1]) / 2;
        return sum;
    };
    for (let i = 0; i < scene.cellCount; i++) if (scene.cellTable[6 * i + 4])
        groups.push({ cells: [i], area: area(i), seen: new Set(scene.row(i)), next: new Set(scene.cell(i).portals.map((p) => p.cell)) });
    const whole = groups.reduce((sum, group) => sum + group.area, 0);
    const cost = (list) => list.reduce((sum, group) => sum + group.area * group.seen.size, 0) / whole;
    const steps = [groups];
    for (let list = groups; list.length > 1;) {
        let best = null;
        for (const a of list) for (const b of list) if (a.cells[0] < b.cells[0] && a.cells.some((cell) => b.next.has(cell))) {
            const seen = new Set([...a.seen, ...b.seen]);
            const price = blind ? a.area + b.area : (a.area + b.area) * seen.size - a.area * a.seen.size - b.area * b.seen.size;
            if (!best || price < best.price) best = { a, b, seen, price };
        }
        if (!best) break;
        const { a, b, seen } = best;
        list = [...list.filter((group) => group !== a && group !== b),
            { cells: [...a.cells, ...b.cells].sort((p, q) => p - q), area: a.area + b.area, seen, next: new Set([...a.next, ...b.next]) }];
        steps.push(list);
    }
    return { steps, costs: steps.map(cost) };
}

let merged;
const mergesOfHouse = (scene) => (merged ??= { adaptive: mergesOf(scene, false), blind: mergesOf(scene, true) });
const houseItems = itemsOf(house.text);

function viewCells(state, lab) {
    state.scene = lab.scene(house.text);
    state.merges = mergesOfHouse(state.scene);
    state.cell = cellAt(state.scene, state.dot);
    const { steps } = state.merges[state.by ?? 'adaptive'], at = Math.max(0, steps[0].length - (state.count ?? 5));
    state.at = Math.min(at, steps.length - 1);
    state.groups = steps[state.at];
    state.group = state.groups.find((group) => group.cells.includes(state.cell));
}

function drawGroups(surface, camera, tones, state) {
    drawPlan(surface, camera, { space: state.scene, show: { portals: false }, seen: state.group?.seen }, tones);
    const hues = ['glass', 'portal', 'start', 'to', 'path', 'object'];
    state.groups.forEach((group, i) => fillPolygons(surface, camera, group.cells.map((cell) => state.scene.corners(cell)),
        mix(tones.page, tones[hues[i % hues.length]], 0.6), 0.55));
    if (state.group) strokeLines(surface, camera, [...state.group.seen].map((cell) => state.scene.corners(cell)), tones.sourceEdge, 3, [], true);
    drawWalls(surface, camera, houseItems, tones);
}

const cells = {
    title: 'Fewer view cells.',
    about: 'Each colour is a view cell. The thick outline is what the view cell of the dot sees. The slider says how many view cells there are.',
    box: house.box,
    handles: [{ name: 'dot', at: [3, 12] }],
    controls: [
        { name: 'count', label: 'view cells', kind: 'range', value: 5, min: 1, max: 14 },
        { name: 'by', label: 'merge', kind: 'choice', value: 'adaptive', options: [['adaptive', 'what costs least'], ['blind', 'what is smallest']] },
    ],
    update: viewCells,
    draw: drawGroups,
    beside: ({ merges, at }, tones) => chart({ title: 'Cost over view cells, for both ways to merge', across: 'view cells', up: 'cells to draw, expected', from: (i) => merges.adaptive.costs.length - i }, [
        { name: 'costs least', values: merges.adaptive.costs, tone: 'glass' }, { name: 'is smallest', values: merges.blind.costs, tone: 'start' }], tones, at),
    tell: ({ groups, merges, at, group }) => `${plural(groups.length, 'view cell')}. Expected cells to draw: ${round(merges.adaptive.costs[at], 2)} if the ` +
        `cheapest pair is merged, ${round(merges.blind.costs[at], 2)} if the smallest. ${group ? `The dot's view cell sees ${group.seen.size}.` : 'The dot is nowhere.'}`,
};

export const figures = { hierarchy, coherence, cells };

/** Numbers of the text: the percentage of tests that updating saves on the walk. */
export const values = {
    saved(lab) {
        const state = firstState(coherence);
        coherence.update(state, lab);
        const [root, updating] = state.curves.map((curve) => curve.reduce((a, b) => a + b));
        return Math.round(100 * (1 - updating / root));
    },
};

/** A tree with leaves 0 to count - 1, a power of two. */
function evenTree(first, count, parent = null) {
    const node = { parent, cells: Array.from({ length: count }, (_, i) => first + i), children: [] };
    if (count > 1) node.children = [evenTree(first, count / 2, node), evenTree(first + count / 2, count / 2, node)];
    return node;
}

export const exercises = {
    tests: {
        kind: 'number',
        question: 'An even binary tree has 8 leaves, and exactly one of them is visible. How many nodes are tested from the root down?',
        right: () => descend(evenTree(0, 8), new Set([5]), []),
        why: 'The root is one test. On each of the three levels below it, both children of a partly visible node are tested: 1 + 2 + 2 + 2.',
        low: 'Both children of a partly visible node are tested, also the one that turns out to be hidden.',
        high: 'Below a hidden node nothing is tested. There are three levels below the root, and two tests on each.',
    },
    safe: {
        kind: 'choice',
        question: 'A visible node is skipped and stays visible. What can go wrong?',
        options: [
            ['Something that is seen is missing in the picture.', 'Only nodes that count as visible are skipped, and they are drawn. So nothing can be missing.'],
            ['Something hidden is drawn.', 'The node may have become hidden meanwhile. It is drawn in vain until its next test, and the picture stays right.'],
            ['The tree changes.', 'The tree is that of the map, and stays. Only the states of its nodes change.'],
        ],
        right: () => 1,
    },
    costly: {
        kind: 'place',
        question: 'The house has five view cells, merged by cost. Put the dot into the one that sees the most cells.',
        solution: [[8, 8]],
        figure: { title: 'The most costly view cell.', about: 'Drag the dot, then press Check.', box: house.box, handles: [{ name: 'dot', at: [3, 12] }],
            update: viewCells, draw: (surface, camera, tones, state) => drawGroups(surface, camera, tones, { ...state, group: null }),
            tell: ({ group }) => (group ? `The view cell of the dot has ${plural(group.cells.length, 'cell')}.` : 'There is no cell here.') },
        judge({ group, groups }) {
            if (!group) return { right: false, text: 'The dot is in no cell. Put it on the floor.' };
            const most = Math.max(...groups.map((other) => other.seen.size)), text = `Its view cell sees ${plural(group.seen.size, 'cell')}`;
            if (group.seen.size === most) return { right: true, text: `${text}, and no other one sees more. Merged cells see what any of their parts sees.` };
            return { right: false, text: `${text}. Another one sees ${most}: look in the middle of the house.` };
        },
    },
};
