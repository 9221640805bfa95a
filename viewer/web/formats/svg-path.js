/** SVG paths and transforms: the data of a path as polylines, curves as chords. */
import { FormatError } from './map-text.js';

/** a, b, c, d, e, f of SVG */
export const identity = [1, 0, 0, 1, 0, 0];

export const apply = ([a, b, c, d, e, f], [x, y]) => [a * x + c * y + e, b * x + d * y + f];

export function multiply(m, n) {
    const [e, f] = apply(m, [n[4], n[5]]);
    return [m[0] * n[0] + m[2] * n[1], m[1] * n[0] + m[3] * n[1],
        m[0] * n[2] + m[2] * n[3], m[1] * n[2] + m[3] * n[3], e, f];
}

const turned = (degrees) => {
    const t = (degrees * Math.PI) / 180, quarter = degrees % 90 === 0;
    const c = quarter ? Math.round(Math.cos(t)) : Math.cos(t), s = quarter ? Math.round(Math.sin(t)) : Math.sin(t);
    return [c, s, -s, c, 0, 0];
};

const makers = {
    matrix: (v) => v,
    translate: ([x, y = 0]) => [1, 0, 0, 1, x, y],
    scale: ([x, y = x]) => [x, 0, 0, y, 0, 0],
    rotate: ([t, x = 0, y = 0]) => multiply(multiply([1, 0, 0, 1, x, y], turned(t)), [1, 0, 0, 1, -x, -y]),
    skewX: ([t]) => [1, 0, Math.tan((t * Math.PI) / 180), 1, 0, 0],
    skewY: ([t]) => [1, Math.tan((t * Math.PI) / 180), 0, 1, 0, 0],
};

export const numbersOf = (text) => (text?.match(/[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?/gi) ?? []).map(Number);

/** @param {string | null} text the attribute `transform` */
export function parseTransform(text) {
    let matrix = identity;
    for (const [, name, values] of (text ?? '').matchAll(/(\w+)\s*\(([^)]*)\)/g)) {
        if (!makers[name]) throw new FormatError(`transform: unknown '${name}'`);
        matrix = multiply(matrix, makers[name](numbersOf(values)));
    }
    return matrix;
}

const CHORDS = 16;

/** Points of a Bézier curve after its first one. */
function bezier(points) {
    const out = [];
    for (let i = 1; i <= CHORDS; i++) {
        let level = points;
        const t = i / CHORDS;
        while (level.length > 1)
            level = level.slice(1).map((q, k) => [level[k][0] + (q[0] - level[k][0]) * t, level[k][1] + (q[1] - level[k][1]) * t]);
        out.push(i === CHORDS ? points[points.length - 1] : level[0]);
    }
    return out;
}

/** An arc by SVG's rule (SVG 1.1, F.6.5). */
function arc(from, rx, ry, degrees, large, sweep, to) {
    if (!rx || !ry) return [to];
    const t = (degrees * Math.PI) / 180, c = Math.cos(t), s = Math.sin(t);
    const dx = (from[0] - to[0]) / 2, dy = (from[1] - to[1]) / 2;
    const x = c * dx + s * dy, y = -s * dx + c * dy;
    let [a, b] = [Math.abs(rx), Math.abs(ry)];
    const grow = Math.sqrt((x / a) ** 2 + (y / b) ** 2);
    if (grow > 1) [a, b] = [a * grow, b * grow];
    const q = (a * y) ** 2 + (b * x) ** 2;
    const k = (large === sweep ? -1 : 1) * Math.sqrt(Math.max(0, ((a * b) ** 2 - q) / q));
    const cx = (k * a * y) / b, cy = (-k * b * x) / a;
    const start = Math.atan2((y - cy) / b, (x - cx) / a);
    let sweepAngle = Math.atan2((-y - cy) / b, (-x - cx) / a) - start;
    if (sweep && sweepAngle < 0) sweepAngle += 2 * Math.PI;
    if (!sweep && sweepAngle > 0) sweepAngle -= 2 * Math.PI;
    const mx = (from[0] + to[0]) / 2 + c * cx - s * cy, my = (from[1] + to[1]) / 2 + s * cx + c * cy;
    const n = Math.max(2, Math.ceil((Math.abs(sweepAngle) / (2 * Math.PI)) * 4 * CHORDS)), out = [];
    for (let i = 1; i < n; i++) {
        const u = start + (sweepAngle * i) / n, px = a * Math.cos(u), py = b * Math.sin(u);
        out.push([mx + c * px - s * py, my + s * px + c * py]);
    }
    return [...out, to];
}

export const ellipse = (cx, cy, rx, ry) => {
    const half = arc([cx - rx, cy], rx, ry, 0, 0, 1, [cx + rx, cy]);
    return [[cx - rx, cy], ...half, ...arc([cx + rx, cy], rx, ry, 0, 0, 1, [cx - rx, cy])];
};

const arity = { M: 2, L: 2, H: 1, V: 1, C: 6, S: 4, Q: 4, T: 2, A: 7, Z: 0 };

/** Flags of arcs may stand without spaces. */
function valuesOf(command, text) {
    if (command !== 'A') return numbersOf(text);
    const out = [], pattern = /\s*,?\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)/iy, flagPattern = /\s*,?\s*([01])/y;
    for (let at = 0; at < text.length;) {
        const use = out.length % 7 === 3 || out.length % 7 === 4 ? flagPattern : pattern;
        use.lastIndex = at;
        const found = use.exec(text);
        if (!found) break;
        out.push(Number(found[1]));
        at = use.lastIndex;
    }
    return out;
}

/** @param {string} text @returns {number[][][]} polylines of points */
export function parsePath(text) {
    const lines = [];
    let line = [], at = [0, 0], last = null;
    const end = () => {
        if (line.length > 1) lines.push(line);
        line = [];
    };
    const add = (...points) => {
        if (!line.length) line.push(at);
        line.push(...points);
        at = points[points.length - 1];
    };
    let first = [0, 0];
    for (const [, letter, rest] of text.matchAll(/([MLHVCSQTAZ])([^MLHVCSQTAZ]*)/gi)) {
        const command = letter.toUpperCase(), values = valuesOf(command, rest), n = arity[command];
        const move = letter === command ? [0, 0] : null;
        if (command === 'Z') {
            if (line.length) add(first);
            end();
            at = first;
            continue;
        }
        for (let i = 0; i + n <= values.length; i += n) {
            const [ox, oy] = move ?? at, v = values.slice(i, i + n);
            const p = (k) => [ox + v[k], oy + v[k + 1]];
            let control = null;
            if (command === 'M' && i === 0) {
                end();
                at = first = p(0);
            } else if (command === 'M' || command === 'L') add(p(0));
            else if (command === 'H') add([ox + v[0], at[1]]);
            else if (command === 'V') add([at[0], oy + v[0]]);
            else if (command === 'A') add(...arc(at, v[0], v[1], v[2], v[3], v[4], p(5)));
            else {
                const smooth = last?.command === { S: 'C', T: 'Q' }[command] ? last.control : null;
                const mirrored = smooth ? [2 * at[0] - smooth[0], 2 * at[1] - smooth[1]] : at;
                const points = { C: () => [p(0), p(2), p(4)], S: () => [mirrored, p(0), p(2)],
                    Q: () => [p(0), p(2)], T: () => [mirrored, p(0)] }[command]();
                control = points[points.length - 2];
                add(...bezier([at, ...points]));
            }
            last = { command: { S: 'C', T: 'Q' }[command] ?? command, control };
        }
    }
    end();
    return lines;
}
