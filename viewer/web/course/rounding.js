/** Chapter 6: signs in doubles against exact ones, and what hangs on them. */
import { plural } from '../formats/words.js';
import { drawDot, drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { svg } from '../parts/dual.js';
import { arithmetics, determinantOf, nearest, roundedOf, unitOf } from './exact.js';
import { element, table } from './figure.js';
import { round } from './lab.js';
import { drawWalls } from './maps.js';
import { firstState } from './still.js';

const side = { '1': 'left', '0': 'on the line', '-1': 'right' };
const names = [['doubles', 'doubles'], ['fused', 'doubles, fused'], ['epsilon', 'doubles, epsilon 1e-9'], ['exact', 'exact']];

/** Points about (0.5, 0.5), 2^-53 apart, against the diagonal, which is given by two places on it. */
const GRID = 40, STEP = 2 ** -53;

/** Half the width of a mark, as a share of a square. */
const MARK = 0.22;

const lines = { '8.8 and 12.1': [8.8, 12.1], '12 and 24': [12, 24], '17.3 and 24.1': [17.3, 24.1] };

const grids = {};

/** Signs of all points of the grid, in each arithmetic. */
function gridOf(line, arithmetic) {
    return (grids[`${line} ${arithmetic}`] ??= Array.from({ length: GRID * GRID }, (_, i) => {
        const p = [0.5 + (i % GRID) * STEP, 0.5 + Math.floor(i / GRID) * STEP], [q, r] = lines[line];
        return arithmetics[arithmetic](p, [q, q], [r, r]);
    }));
}

const grid = {
    title: 'One line, 1,600 points.',
    about: 'Each square is a point; the next one is a ten-millionth of a billionth away. Blue is left of the line, yellow right, and the colour of walls on it. A dot marks a wrong answer.',
    box: [0, 0, GRID, GRID],
    handles: [{ name: 'dot', at: [10.5, 13.5] }],
    controls: [
        { name: 'arithmetic', label: 'arithmetic', kind: 'choice', value: 'doubles', options: names },
        { name: 'line', label: 'line through', kind: 'choice', value: '8.8 and 12.1', options: Object.keys(lines).map((name) => [name, name]) },
    ],
    update(state) {
        state.signs = gridOf(state.line, state.arithmetic);
        state.exact = gridOf(state.line, 'exact');
        state.wrong = state.signs.flatMap((sign, i) => (sign === state.exact[i] ? [] : [i]));
        const [x, y] = state.dot.map((v) => Math.min(GRID - 1, Math.floor(v)));
        Object.assign(state, { x, y, at: y * GRID + x });
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, {}, tones);
        for (const [sign, colour] of [[1, tones.seen[0]], [0, tones.wall], [-1, tones.region]])
            fillPolygons(surface, camera, state.signs.flatMap((s, i) => {
                const x = i % GRID, y = Math.floor(i / GRID);
                return s === sign ? [[x, y, x + 1, y, x + 1, y + 1, x, y + 1]] : [];
            }), colour);
        strokeLines(surface, camera, [[0, 0, GRID, GRID]], tones.sourceEdge, 2);
        // One path for all: in some arithmetics nearly every square has a mark.
        fillPolygons(surface, camera, state.wrong.map((i) => {
            const x = (i % GRID) + 0.5, y = Math.floor(i / GRID) + 0.5;
            return [x - MARK, y, x, y - MARK, x + MARK, y, x, y + MARK];
        }), tones.start);
    },
    tell: (state) => `Point ${state.x} across, ${state.y} up: ${side[state.signs[state.at]]}; exact: ${side[state.exact[state.at]]}. ` +
        `Of ${plural(GRID * GRID, 'point')}, ${state.wrong.length} have a wrong sign.`,
};

/** Where the slits of the corridor stand: first one, and step; chosen so that rounding shows. */
const spacing = { 3: [5.3, 5.2], 4: [3.9, 4], 5: [3.7, 3.3], 6: [3.2, 3], 7: [2.2, 2.7] };
const LONG = 20, HIGH = 10;

/** Tips of slits on a line from the left to the right side, each rounded to a double. */
export const tipsOf = (from, to, count) => Array.from({ length: count }, (_, i) => {
    const [first, step] = spacing[count], x = Number((first + i * step).toFixed(1));
    return [x, from + (to - from) * (x / LONG)];
});

/** Portals past walls that stand on the floor and hang from the ceiling in turn. */
export const portalsOf = (tips) => tips.map(([x, y], i) => (i % 2 ? [x, y, x, 0] : [x, HIGH, x, y]));

/** Whether a line passes all slits: each end of three against the line through two others. */
export function verdictOf(tips, sign) {
    let touches = false;
    for (let j = 1; j < tips.length - 1; j++)
        for (let i = j - 1; i >= 0; i -= 2)
            for (let k = j + 1; k < tips.length; k += 2) {
                const turn = sign(tips[i], tips[j], tips[k]) * (j % 2 ? 1 : -1);
                if (turn > 0) return 'hidden';
                touches ||= turn === 0;
            }
    return touches ? 'grazing' : 'stabbed';
}

const slitWalls = (tips) => tips.map(([x, y], i) => ({ kind: 'wall', points: i % 2 ? [x, y, x, HIGH] : [x, 0, x, y] }));
const frame = { kind: 'walls', points: [0, 0, LONG, 0, LONG, HIGH, 0, HIGH, 0, 0] };

/** How far each tip lies above the line through the first and the last one, in units in its last place. */
function heightsOf(tips) {
    const first = tips[0], last = tips.at(-1);
    return tips.map((tip) => {
        const { whole, unit } = determinantOf(first, last, tip);
        return nearest(whole, unit) / (last[0] - first[0]) / unitOf(tip[1]);
    });
}

/** The tips under a magnifier: walls from below and from above, in units in the last place. */
function magnifier(state, tones) {
    const width = 320, height = 130, middle = height / 2, most = Math.max(1.5, ...state.heights.map(Math.abs));
    const rows = state.tips.flatMap(([x], i) => {
        const px = (x / LONG) * width, py = middle - (state.heights[i] / most) * (middle - 14);
        const isAbove = i % 2, wall = { x1: px, x2: px, y1: py, y2: isAbove ? 0 : height, stroke: tones.wall, 'stroke-width': 4 };
        return [svg('line', wall), svg('circle', { cx: px, cy: py, r: 4, fill: tones.sourceEdge })];
    });
    const said = `The tips magnified: ${state.heights.map((h) => round(h, 2)).join(', ')} units above the line through the first and the last one.`;
    return svg('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': said },
        svg('rect', { width, height, fill: tones.floor[0] }),
        svg('line', { x1: 0, x2: width, y1: middle, y2: middle, stroke: tones.glass, 'stroke-width': 2, 'stroke-dasharray': '6 3' }), ...rows);
}

const isSeen = (verdict) => verdict !== 'hidden';
const snap = (v) => Math.round(20 * v) / 20;

const slits = {
    title: 'A corridor of slits.',
    about: 'Drag the ends of the line up and down. Each slit begins where the line crosses it, as a double. The small picture magnifies the heights of the tips about a million billion times.',
    box: [0, 0, LONG, HIGH],
    handles: [{ name: 'a', at: [0, 3.1], tone: 'from' }, { name: 'b', at: [LONG, 7.4], tone: 'to' }],
    controls: [{ name: 'count', label: 'slits', kind: 'range', value: 5, min: 3, max: 7 }],
    update(state, lab) {
        state.a = [0, snap(state.a[1])];
        state.b = [LONG, snap(state.b[1])];
        state.tips = tipsOf(state.a[1], state.b[1], state.count ?? 5);
        state.heights = heightsOf(state.tips);
        state.truth = lab.core.conflict(portalsOf(state.tips)).verdict;
        state.verdicts = names.map(([name]) => (name === 'exact' ? state.truth : verdictOf(state.tips, arithmetics[name])));
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, {}, tones);
        fillPolygons(surface, camera, [frame.points], tones.floor[0]);
        strokeLines(surface, camera, [[...state.a, ...state.b]], tones.sourceEdge, 2, [6, 4]);
        drawWalls(surface, camera, [frame, ...slitWalls(state.tips)], tones);
    },
    beside: (state, tones) => element('div', {}, magnifier(state, tones), table(['arithmetic', 'the far end is', 'right?'], names.map(([, name], i) =>
        [name, state.verdicts[i], isSeen(state.verdicts[i]) === isSeen(state.truth) ? 'yes' : 'no']))),
    tell(state) {
        const wrong = names.filter((_, i) => isSeen(state.verdicts[i]) !== isSeen(state.truth)).map(([, name]) => name);
        return `Line from ${state.a[1]} to ${state.b[1]}, ${plural(state.tips.length, 'slit')}. Exact: ${state.truth}. Doubles: ${state.verdicts[0]}. ` +
            (wrong.length ? `Wrong about seen or hidden: ${wrong.join('; ')}.` : 'All agree about seen or hidden.');
    },
};

const filter = {
    title: 'A filter.',
    about: 'Drag A and B. C stands beside the line; the slider moves it nearer, by ten times with each step.',
    box: [0, 0, LONG, HIGH],
    handles: [{ name: 'a', at: [2, 2.1], tone: 'from' }, { name: 'b', at: [17, 8.3], tone: 'to' }],
    controls: [{ name: 'near', label: 'nearer', kind: 'range', value: 3, min: 0, max: 18 }],
    update(state) {
        const [ax, ay] = state.a, [bx, by] = state.b, dx = bx - ax, dy = by - ay, far = 10 ** -state.near / (Math.hypot(dx, dy) || 1);
        state.c = [ax + 0.6 * dx - far * dy, ay + 0.6 * dy + far * dx];
        state.rounded = roundedOf(state.a, state.b, state.c);
        state.isSure = Math.abs(state.rounded.determinant) > state.rounded.bound;
        const { whole, unit } = determinantOf(state.a, state.b, state.c);
        state.value = nearest(whole, unit);
        state.sign = arithmetics.exact(state.a, state.b, state.c);
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, {}, tones);
        fillPolygons(surface, camera, [[...state.a, ...state.b, ...state.c]], tones.region);
        strokeLines(surface, camera, [[...state.a, ...state.b]], tones.wall, 2);
        drawDot(surface, camera, state.c, 6, tones.glass, tones.page);
    },
    beside: (state) => table(['step', 'value'], [
        ['first product', String(state.rounded.left)], ['second product', String(state.rounded.right)],
        ['difference, rounded', state.rounded.determinant.toExponential(3)], ['bound of the error', state.rounded.bound.toExponential(3)],
        ['is the sign sure?', state.isSure ? 'yes: done' : 'no: go on'], ['difference, exact', state.isSure ? 'not needed' : state.value.toExponential(3)],
    ]),
    tell: (state) => `C is about ${10 ** -state.near} beside the line. The difference is ${state.rounded.determinant.toExponential(1)}, its error at most ` +
        `${state.rounded.bound.toExponential(1)}. ${state.isSure ? 'The filter is sure' : 'Exact arithmetic decides'}: C is ${side[state.sign]}` +
        `${state.sign ? ' of the line' : ''}.`,
};

export const figures = { grid, slits, filter };

/** Numbers of the text: for how many steps the filter is sure, as A and B stand first. */
export const values = {
    'steps-sure'() {
        const state = firstState(filter), isSure = (near) => filter.update(Object.assign(state, { near })) ?? state.isSure;
        let steps = 0;
        while (isSure(steps)) steps++;
        return steps - 1;
    },
};

/** Doors of 1e-9 in halls of a million metres; a line passes the first two, and misses the third by 1e-9. */
const nano = [[1e6, 5e5 + 1e-9, 1e6, 5e5], [2e6, 5e5 + 1e-9, 2e6, 5e5], [3e6, 5e5 + 2e-9, 3e6, 5e5 + 1e-9]];

export const exercises = {
    bits: {
        kind: 'number',
        question: 'The digits of a double are a whole number of at most 53 bits. How many bits can the exact product of two such numbers have?',
        right: () => ((2n ** 53n - 1n) ** 2n).toString(2).length,
        why: 'Bits add up in a product. A double keeps 53 of the 106 bits, so the product of two doubles is usually rounded.',
        low: 'Try small numbers: 3 has two bits and 7 has three. Their product 21 needs five.',
        high: 'The largest number of 53 bits is below 2^53. So the product is below 2^53 times 2^53.',
    },
    epsilon: {
        kind: 'choice',
        question: 'A program counts a determinant below 1e-9 as zero, and zero as seen. What goes wrong?',
        options: [
            ['Nothing: no wall is that thin.', 'The determinant is an area, not a thickness. Small maps have small areas everywhere, and large maps round by more than 1e-9.'],
            ['In a map of millimetres many hidden cells count as seen; in a map of kilometres nothing changes.', 'An area has no natural size. A limit that fits one map is far too large for another one, and has no effect on a third.'],
            ['The program becomes slower.', 'One comparison costs nothing. What changes is the answer.'],
        ],
        right(lab) {
            const small = [[0, 2e-5], [1e-5, 0], [2e-5, 2e-5]], large = nano.map(([x, y]) => [x, y]);
            const hides = lab.core.conflict([[0, 1, 0, 2e-5], [1e-5, 0, 1e-5, -1], [2e-5, 1, 2e-5, 2e-5]]).verdict === 'hidden';
            return hides && arithmetics.epsilon(...small) === 0 && arithmetics.epsilon(...large) === arithmetics.doubles(...large) ? 1 : -1;
        },
    },
    flips: {
        kind: 'place',
        question: 'Drag the ends of the line, until doubles are wrong about whether the far end of the corridor is seen.',
        solution: [[0, 3.1], [LONG, 7.4]],
        figure: { ...slits, title: 'Make the doubles wrong.', about: 'Drag the two ends, then press Check.', controls: undefined, handles: [{ name: 'a', at: [0, 2], tone: 'from' }, { name: 'b', at: [LONG, 4], tone: 'to' }],
            beside: undefined, tell: (state) => `The line goes from ${state.a[1]} to ${state.b[1]}.` },
        judge({ verdicts: [doubles], truth, heights }) {
            const said = `Exact signs say ${truth}, doubles say ${doubles}.`, most = Math.max(...heights.map(Math.abs));
            if (isSeen(doubles) === isSeen(truth)) return { right: false, text: `${said} They agree. Try lines whose heights are not whole or half numbers.` };
            return { right: true, text: `${said} All tips lie within ${round(most, 1)} units in the last place of one line.` };
        },
    },
};
