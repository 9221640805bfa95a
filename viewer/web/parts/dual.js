/**
 * The dual plane of a portal sequence as an SVG figure. A line y' = a x' + b of the plan is the point
 * (a, b). Each portal end is a line of this plane; the lines of sight lie above those of right ends
 * and below those of left ends. What is left is a polygon, and nothing if no line passes all portals.
 */
import { t } from '../language/language.js';

const NS = 'http://www.w3.org/2000/svg';

/** @param {string} name @param {Record<string, string | number>} attributes */
export function svg(name, attributes, ...children) {
    const node = document.createElementNS(NS, name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, String(value));
    node.append(...children);
    return node;
}

/**
 * A place of the plan in the frame of a dual: x', y'.
 * @param {{origin: number[], along: number[], scale: number}} dual @param {number[]} point
 */
export function turnPoint(dual, [px, py]) {
    const x = px - dual.origin[0], y = py - dual.origin[1], [ax, ay] = dual.along;
    return [(x * ax + y * ay) / dual.scale, (y * ax - x * ay) / dual.scale];
}

/**
 * The part of the dual plane that is worth showing: about the polygon, or about the best line. Lines that run beside it are
 * drawn in, if it gets up to twice as high by that. @param {number[][]} ends in the frame of the dual
 */
function windowOf(dual, ends) {
    const { corners, best } = dual;
    let [a0, a1, b0, b1] = [best.slope - 0.4, best.slope + 0.4, best.height - 0.4, best.height + 0.4];
    if (corners.length) {
        const slopes = corners.filter((_, i) => i % 2 === 0), heights = corners.filter((_, i) => i % 2);
        const [s0, s1, h0, h1] = [Math.min(...slopes), Math.max(...slopes), Math.min(...heights), Math.max(...heights)];
        const room = Math.max(s1 - s0, h1 - h0, 1e-3) * 0.6;
        [a0, a1, b0, b1] = [s0 - room, s1 + room, h0 - room, h1 + room];
    }
    const high = b1 - b0, [floor, top] = [b0 - high / 2, b1 + high / 2], room = 0.15 * high;
    for (const [px, py] of ends) {
        const [low, most] = [py - a0 * px, py - a1 * px].sort((p, q) => p - q);
        if (low > b1 - room && low < top) b1 = Math.max(b1, low + room);
        if (most < b0 + room && most > floor) b0 = Math.min(b0, most - room);
    }
    return { a0, a1, b0, b1 };
}

const WIDTH = 320, HEIGHT = 240;

/**
 * @param {import('./why-scene.js').WhyScene & {dual: any}} why @param {import('./tones.js').Tones} tones
 * @returns {SVGElement}
 */
export function dualFigure(why, tones) {
    const { dual } = why, miss = why.sequence?.length ? null : why.misses?.[0];
    const portals = miss ? [...miss.sequence, miss.stopped_by] : why.sequence;
    const ends = portals.flatMap(({ left, right }) => [left, right].map((end) => turnPoint(dual, end))), { a0, a1, b0, b1 } = windowOf(dual, ends);
    const x = (a) => ((a - a0) / (a1 - a0)) * WIDTH, y = (b) => HEIGHT - ((b - b0) / (b1 - b0)) * HEIGHT;
    const isEnd = (portal, side) => miss?.ends.some((e) => e.portal === portal.portal && e.side === side);
    const lines = portals.flatMap((portal) => ['left', 'right'].map((side) => {
        const [px, py] = turnPoint(dual, portal[side]), bold = isEnd(portal, side);
        const at = (a) => py - a * px;
        return svg('line', { x1: x(a0), y1: y(at(a0)), x2: x(a1), y2: y(at(a1)),
            stroke: tones[side], 'stroke-width': bold ? 3 : 1,
            ...(side === 'right' ? { 'stroke-dasharray': '6 3' } : {}) });
    }));
    const points = [];
    for (let i = 0; i + 1 < dual.corners.length; i += 2) points.push(`${x(dual.corners[i])},${y(dual.corners[i + 1])}`);
    const polygon = points.length ? [svg('polygon', { points: points.join(' '), fill: tones.source, stroke: tones.sourceEdge })] : [];
    const text = points.length ? t('Dual plane: each point of the filled polygon is a sightline.')
        : t('Dual plane: no point lies above all right ends and below all left ends.');
    const caption = svg('text', { x: 6, y: HEIGHT - 8, 'font-size': 12, fill: tones.ink });
    caption.textContent = t('left ends: full lines, right ends: dashed');
    return svg('svg', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'aria-label': text },
        svg('rect', { width: WIDTH, height: HEIGHT, fill: tones.floor[0] }), ...polygon, ...lines,
        svg('rect', { y: HEIGHT - 24, width: WIDTH, height: 24, fill: tones.floor[0] }), caption);
}
