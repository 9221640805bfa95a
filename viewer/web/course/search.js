/** Chapter 5: the depth-first search, the stab tree, and how it grows. */
import { plural } from '../formats/words.js';
import { drawDot, drawPlan, strokeLines } from '../parts/plan.js';
import { element } from './figure.js';
import { WIDEST } from './halls.js';
import { middleOf, planLine, round, stand, within } from './lab.js';
import { searchCode } from './lab-code.js';
import { drawWalls, flat, hall, house, itemsOf, threeRooms } from './maps.js';
import { searchLab } from './search-lab.js';

const houseItems = itemsOf(house.text);

const code = [
    ['enter', 'search(cell, seq):'],
    ['enter', '  mark cell as seen'],
    ['', '  for each portal of cell:'],
    ['backwards', '    if it leads back:'],
    ['backwards', '      skip it'],
    ['hidden', '    if no line stabs seq + portal:'],
    ['hidden', '      skip it'],
    ['', '    search(cell behind, seq + portal)'],
    ['leave', '  return'],
];

/** Portals that lead to a step of the search, from the first one on; the parent of a leave is its enter. */
function sequenceOf(steps, at) {
    const list = [], last = steps[at];
    for (let step = last.kind === 'leave' ? steps[last.parent] : last; step.directed >= 0; step = steps[step.parent]) list.unshift(step.directed);
    return list;
}

const said = {
    enter: (step) => `a line stabs the sequence, so cell ${step.cell} is seen`,
    backwards: (step) => `this portal leads back to cell ${step.cell}`,
    hidden: (step) => `no line stabs the sequence to cell ${step.cell} on this way`,
    leave: (step) => `all portals of cell ${step.cell} are tried`,
};

const walk = {
    title: 'The search, step by step.',
    about: 'The dot chooses the first cell, the slider the step. Blue cells are seen so far. Green portals are the sequence; a dashed one is not passed.',
    box: house.box,
    handles: [{ name: 'dot', at: [3, 12] }],
    controls: [{ name: 'at', label: 'step', kind: 'range', value: 5, min: 0, max: 78 }],
    update(state, lab) {
        const scene = stand(state, lab, house.text, state.dot);
        state.steps = state.cell < 0 ? [] : scene.steps(state.cell).steps;
        if (!state.steps.length) return;
        state.now = Math.min(state.at, state.steps.length - 1);
        state.step = state.steps[state.now];
        state.portals = sequenceOf(state.steps, state.now).map((d) => scene.directed(d));
        state.seen = new Set(state.steps.slice(0, state.now + 1).filter((s) => s.kind === 'enter').map((s) => s.cell));
        const isLine = (state.step.kind === 'enter' || state.step.kind === 'leave') && state.portals.length;
        const dual = isLine ? lab.core.dual(state.portals.map((p) => [...p.left, ...p.right])) : null;
        state.line = dual ? within(scene, planLine(dual, dual.best), [state.cell, state.step.cell]) : null;
    },
    marks: {
        sequence: ({ portals = [] }) => ({ lines: portals.map((p) => [...p.left, ...p.right]) }),
        seen: ({ scene, seen = [] }) => ({ areas: [...seen].map((cell) => scene.corners(cell)) }),
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { space: state.scene, from: state.cell, seen: state.seen }, tones);
        drawWalls(surface, camera, houseItems, tones);
        if (!state.steps.length) return;
        const lines = state.portals.map((p) => [...p.left, ...p.right]), isStopped = state.step.kind === 'hidden' || state.step.kind === 'backwards';
        strokeLines(surface, camera, isStopped ? lines.slice(0, -1) : lines, tones.portal, 5);
        if (isStopped) strokeLines(surface, camera, lines.slice(-1), tones.to, 5, [5, 3]);
        if (state.line) strokeLines(surface, camera, [state.line], tones.sourceEdge, 3);
    },
    beside(state) {
        const kind = state.steps.length ? state.step.kind : '';
        const lines = code.flatMap(([of, text]) => [of && of === kind ? element('b', {}, text) : text, '\n']);
        return element('pre', { tabIndex: 0, role: 'region', 'aria-label': 'Pseudo-code of the search' }, ...lines);
    },
    tell: (state) => (state.steps.length
        ? `Step ${state.now} of ${state.steps.length - 1}: ${said[state.step.kind](state.step)}. ` +
            `${plural(state.portals.length, 'portal')} in the sequence, ${plural(state.seen.size, 'cell')} seen.`
        : 'There is no cell here.'),
};

const middle = ({ left, right }) => [(left[0] + right[0]) / 2, (left[1] + right[1]) / 2];

const tree = {
    title: 'A stab tree.',
    about: 'Drag the dot. Each branch goes from portal to portal, and ends where no line goes further.',
    box: house.box,
    handles: [{ name: 'dot', at: [12, 6.3] }],
    update(state, lab) {
        const scene = stand(state, lab, house.text, state.dot);
        state.nodes = state.cell < 0 ? [] : scene.stabTree(state.cell).nodes;
        state.seen = new Set(state.nodes.map((node) => node.cell));
        state.places = state.nodes.map((node) => (node.directed < 0 ? middleOf(scene, state.cell) : middle(scene.directed(node.directed))));
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { space: state.scene, from: state.cell, seen: state.seen }, tones);
        drawWalls(surface, camera, houseItems, tones);
        const branches = state.nodes.flatMap((node, i) => (node.parent < 0 ? [] : [[...state.places[node.parent], ...state.places[i]]]));
        strokeLines(surface, camera, branches, tones.tree, 2);
        for (const place of state.places) drawDot(surface, camera, place, 4, tones.tree, tones.page);
    },
    tell(state) {
        if (!state.nodes.length) return 'There is no cell here.';
        const depth = Math.max(...state.nodes.map((node) => node.depth));
        return `Dot at ${state.dot.map((v) => round(v)).join(', ')}. From cell ${state.cell}: ${plural(state.nodes.length, 'node')} ` +
            `for ${plural(state.seen.size, 'cell')}. The longest branch has ${plural(depth, 'portal')}.`;
    },
};

const growth = {
    title: 'A hall that grows.',
    about: 'The slider adds columns of pillars. The dot chooses the cell that the search starts in.',
    box: [0, 0, 24, 12],
    handles: [{ name: 'dot', at: [0.3, 0.3] }],
    controls: [{ name: 'columns', label: 'columns', kind: 'range', value: 3, min: 1, max: WIDEST }],
    update(state, lab) {
        state.text = hall(state.columns);
        const scene = stand(state, lab, state.text, state.dot);
        const { steps, complete } = state.cell < 0 ? { steps: [], complete: true } : scene.steps(state.cell, { most: 20000 });
        Object.assign(state, { steps: steps.length, isWhole: complete });
        state.seen = new Set(state.cell < 0 ? [] : scene.row(state.cell));
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { space: state.scene, from: state.cell, seen: state.seen }, tones);
        drawWalls(surface, camera, itemsOf(state.text), tones);
    },
    tell: (state) => (state.cell < 0 ? 'The dot is outside the hall, or in a pillar.'
        : `Dot at ${state.dot.map((v) => round(v)).join(', ')}. ${plural(state.scene.insideCount, 'cell')}, ${state.seen.size} of them seen. ` +
            `The search ${state.isWhole ? 'ends after' : 'has not ended after'} ${plural(state.steps, 'step')}: ${round(state.steps / state.seen.size)} for each cell that is seen.`),
};

export const figures = { walk, tree, growth };

/** Numbers of the text: the least hall and the widest one, from the corner where the dot stands first. */
const hallSteps = (lab, columns) => lab.scene(hall(columns)).steps({ x: growth.handles[0].at[0], y: growth.handles[0].at[1] }, { most: 20000 }).steps.length;
export const values = {
    'cells-first': (lab) => lab.scene(hall(1)).insideCount,
    'cells-last': (lab) => lab.scene(hall(WIDEST)).insideCount,
    'steps-first': (lab) => hallSteps(lab, 1),
    'steps-last': (lab) => hallSteps(lab, WIDEST),
};

const treeSize = (scene, cell) => scene.stabTree(cell).nodes.length;

export const exercises = {
    stop: {
        kind: 'choice',
        question: 'No line stabs the sequence A, B, C. Why does the search not look at A, B, C, D?',
        options: [
            ['Because D may be far away.', 'Distance plays no part: a far portal can be seen through near ones.'],
            ['Because a line through A, B, C, D would also be a line through A, B, C.', 'A longer sequence has all conditions of the shorter one, and two more. So it fails as well.'],
            ['Because D was tried before.', 'D may be tried many times, behind other sequences. Some of them may be stabbed.'],
        ],
        right: () => 1,
    },
    row: {
        kind: 'number',
        question: 'Three rooms lie in a row, and their two doors line up. How many nodes has the stab tree of the first room? Count its root.',
        right: (lab) => treeSize(lab.scene(threeRooms.text), { x: 2, y: 2 }),
        why: 'The root is the first room. One door leads to the second room, the next door to the third. All are one branch.',
        low: 'The root counts, and a straight line passes both doors.',
        high: 'There is one way only: each door leads to one new room, and the search never turns back.',
    },
    largest: {
        kind: 'place',
        question: 'Put the dot into a cell with the largest stab tree of this plan.',
        solution: [[4, 10]],
        figure: { title: 'Where does the search take longest?', about: 'Drag the dot, then press Check.', box: flat.box, handles: [{ name: 'dot', at: [2, 2] }],
            update(state, lab) {
                stand(state, lab, flat.text, state.dot);
            },
            draw(surface, camera, tones, state) {
                drawPlan(surface, camera, { space: state.scene, from: state.cell }, tones);
                drawWalls(surface, camera, itemsOf(flat.text), tones);
            },
            tell: (state) => (state.cell < 0 ? 'There is no cell here.' : `The dot is in cell ${state.cell}.`) },
        judge({ cell }, lab) {
            if (cell < 0) return { right: false, text: 'The dot is in no cell. Put it on the floor.' };
            const scene = lab.scene(flat.text), here = treeSize(scene, cell);
            const most = Math.max(...Array.from({ length: scene.cellCount }, (_, i) => treeSize(scene, i)));
            if (here === most) return { right: true, text: `Its tree has ${plural(here, 'node')}, and no tree has more.` };
            return { right: false, text: `Its tree has ${plural(here, 'node')}. The largest one has ${most}.` };
        },
    },
    visible: {
        kind: 'code',
        lab: searchLab,
        question: 'Complete the search. It gives the numbers of all cells that a cell sees.',
        code: searchCode.text,
    },
};
