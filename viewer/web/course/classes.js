/**
 * Classes of lines among posts: two lines are of one class if they pass each post on the same side.
 *
 * A post is a pillar without width. Lines go from the left wall of a room to its right wall, so two heights hold a
 * line: at the left wall and at the right one. These are coordinates of a dual plane. A post is a straight line there,
 * and lines of one class are a convex polygon between such lines. With k posts, k straight lines make at most
 * 1 + k + k (k - 1) / 2 polygons. Sides of k posts can be chosen in 2^k ways.
 *
 * The sides of the posts are a sequence of portals, above or below each post. The library decides exactly if a line
 * passes it, or only touches. A choice that fails for the first posts fails for more, so few are tried.
 */
import { plural } from '../formats/words.js';
import { svg } from '../parts/dual.js';
import { drawDot, drawPlan, strokeLines } from '../parts/plan.js';
import { element, table } from './figure.js';
import { planLine, round } from './lab.js';
import { drawText } from './maps.js';

const [WIDTH, HEIGHT] = [24, 12];
const box = [0, 0, WIDTH, HEIGHT];
const leftWall = [0, HEIGHT, 0, 0], rightWall = [WIDTH, HEIGHT, WIDTH, 0];

const MOST = 8;

/** The posts of an arrangement: no three of `apart` are on one line. */
export const posts = {
    apart: [[2.5, 7.3], [5, 4.2], [7.6, 8.4], [10.2, 5.1], [12.9, 7.7], [15.4, 4.6], [18.1, 6.9], [20.6, 5.3]],
    row: Array.from({ length: MOST }, (_, i) => [2.5 + 2.7 * i, 6]),
};

/** The portal above a post, or below it, as a line crosses it that goes to the right. */
const gap = ([x, y], above) => (above ? [x, HEIGHT, x, y] : [x, y, x, 0]);

/**
 * All classes of lines among the first posts, for 0, 1, 2 ... of them.
 * @param {boolean} mayTouch whether lines count that only touch posts
 * @returns {{sides: boolean[], portals: number[][], verdict: string}[][]}
 */
export function classesOf(core, list, mayTouch) {
    const levels = [[{ sides: [], portals: [leftWall], verdict: 'stabbed' }]];
    for (const post of list)
        levels.push(levels.at(-1).flatMap(({ sides, portals }) => [true, false].flatMap((above) => {
            const longer = [...portals, gap(post, above)], { verdict } = core.conflict([...longer, rightWall]);
            return verdict === 'stabbed' || (mayTouch && verdict === 'grazing') ? [{ sides: [...sides, above], portals: longer, verdict }] : [];
        })));
    return levels;
}

/** The polygon of a class: heights at both walls, x, y ...; one point for a class that only touches. */
function polygonOf(core, { portals }) {
    const dual = core.dual([...portals, rightWall]), corners = [];
    const put = (slope, height) => {
        const [ax, ay, bx, by] = planLine(dual, { slope, height }), at = (x) => ay + ((by - ay) * (x - ax)) / (bx - ax);
        corners.push(at(0), at(WIDTH));
    };
    if (!dual.corners.length) put(dual.best.slope, dual.best.height);
    for (let i = 0; i + 1 < dual.corners.length; i += 2) put(dual.corners[i], dual.corners[i + 1]);
    return corners;
}

const most = (k) => 1 + k + (k * (k - 1)) / 2;

const kept = new Map();

/** Classes with their polygons; computed once. */
function knownClasses({ core }, arrangement, count, mayTouch) {
    const key = `${arrangement} ${count} ${mayTouch}`;
    if (!kept.has(key)) {
        const levels = classesOf(core, posts[arrangement].slice(0, count), mayTouch);
        const polygons = levels.at(-1).filter(({ verdict }) => verdict === 'stabbed').map((one) => ({ ...one, polygon: polygonOf(core, one) }));
        const touching = levels.at(-1).find(({ verdict }) => verdict === 'grazing');
        kept.set(key, { counts: levels.map((level) => level.length), polygons, touching: touching && polygonOf(core, touching) });
    }
    return kept.get(key);
}

const side = ([x, y], [, left], [, right]) => Math.sign(left + ((right - left) * x) / WIDTH - y);

/** The dual plane: the height at the left wall goes across, that at the right wall goes up. */
function dualPicture({ list, polygons, touching, current, a, b, count, all }, tones) {
    const size = 240, at = (height) => (size * height) / HEIGHT, up = (height) => size - at(height);
    const points = (polygon) => Array.from({ length: polygon.length / 2 }, (_, i) => `${at(polygon[2 * i]).toFixed(1)},${up(polygon[2 * i + 1]).toFixed(1)}`).join(' ');
    const areas = polygons.map((one, i) => svg('polygon', { points: points(one.polygon), fill: one === current ? tones.source : tones.floor[i % 4], stroke: 'none' }));
    const lines = list.map(([x, y]) => {
        const t = x / WIDTH, right = (left) => (y - (1 - t) * left) / t;
        return svg('line', { x1: 0, y1: up(right(0)), x2: size, y2: up(right(HEIGHT)), stroke: tones.glass, 'stroke-width': 1.5 });
    });
    const ring = touching ? [svg('circle', { cx: at(touching[0]), cy: up(touching[1]), r: 11, fill: 'none', stroke: tones.to, 'stroke-width': 3 })] : [];
    const dot = svg('circle', { cx: at(a[1]), cy: up(b[1]), r: 5, fill: tones.sourceEdge, stroke: tones.page });
    return svg('svg', { viewBox: `0 0 ${size} ${size}`, role: 'img', 'aria-label': `Dual plane: ${plural(count, 'line')} for the posts, ${plural(polygons.length, 'polygon')}` +
        (touching ? `, and a point for ${all - polygons.length} classes of lines that only touch` : '') }, ...areas, ...lines, ...ring, dot);
}

export const classes = {
    title: 'Classes of lines.',
    about: 'The dots hold a line. Beside the plan is its dual plane: each post is a line there, each class of lines is a polygon, and your line is the dot.',
    box,
    handles: [{ name: 'a', at: [0, 6.5] }, { name: 'b', at: [WIDTH, 5.5] }],
    controls: [
        { name: 'count', label: 'posts', kind: 'range', value: 4, min: 1, max: MOST },
        { name: 'arrangement', label: 'places', kind: 'choice', value: 'apart', options: [['apart', 'no three in line'], ['row', 'all in a row']] },
        { name: 'mayTouch', label: 'a line may touch', kind: 'check', value: false },
    ],
    update(state, lab) {
        [state.a, state.b] = [[0, state.a[1]], [WIDTH, state.b[1]]];
        state.list = posts[state.arrangement].slice(0, state.count);
        Object.assign(state, knownClasses(lab, state.arrangement, state.count, state.mayTouch));
        state.all = state.counts.at(-1);
        state.signs = state.list.map((post) => side(post, state.a, state.b));
        state.current = state.polygons.find(({ sides }) => sides.every((above, i) => state.signs[i] === (above ? 1 : -1)));
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { items: [{ kind: 'walls', points: [0, 0, WIDTH, 0, WIDTH, HEIGHT, 0, HEIGHT, 0, 0] }] }, tones);
        strokeLines(surface, camera, [[...state.a, ...state.b]], tones.sourceEdge, 2.5);
        for (const [i, post] of state.list.entries()) {
            drawDot(surface, camera, post, 5, tones.wall, tones.page);
            drawText(surface, camera, post, String(i + 1), tones, 0, 15);
        }
    },
    beside: (state, tones) => element('div', {}, dualPicture(state, tones), table(['posts', 'classes', '1 + k + k(k - 1)/2', '2^k'],
        state.counts.slice(1).map((found, i) => [i + 1, found, most(i + 1), 2 ** (i + 1)]))),
    tell({ signs, all, count, a, b, polygons, touching, mayTouch }) {
        const above = signs.flatMap((sign, i) => (sign > 0 ? [i + 1] : [])), touched = signs.flatMap((sign, i) => (sign === 0 ? [i + 1] : []));
        const only = touching ? `, ${all - polygons.length} of them at the ring, where lines only touch` : mayTouch ? ', and none where lines only touch' : '';
        return `${plural(count, 'post')}: ${all} classes${only}, of ${2 ** count} choices of sides. The line goes from height ${round(a[1])} to ${round(b[1])}. ` +
            `It passes above ${above.length ? `post${above.length > 1 ? 's' : ''} ${above.join(', ')}` : 'no post'}${touched.length ? ` and touches ${touched.join(', ')}` : ''}.`;
    },
};

/** Numbers of the text. */
const counted = (arrangement, mayTouch) => ({ core }) => classesOf(core, posts[arrangement], mayTouch).at(-1).length;
export const classValues = {
    'posts': () => MOST,
    'classes-apart': counted('apart', false),
    'classes-most': () => most(MOST),
    'classes-row': counted('row', false),
    'classes-touch': counted('row', true),
    'choices': () => 2 ** MOST,
};
