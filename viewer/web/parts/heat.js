/**
 * A heat map: squares of a grid in the colours of a ramp, whose lightness goes one way only. The ramp
 * is that of lib/draw/marks.c (sl_palette_ramp).
 */
import { fillPolygons } from './plan.js';

/**
 * @typedef {Object} Heat
 * @property {number} step @property {number} left @property {number} bottom of the first square, in steps
 * @property {number} columns @property {number} rows
 * @property {Uint32Array} squares by point: column * rows + row
 * @property {Float64Array} values by point; NaN: not defined
 * @property {number} least @property {number} most
 */

/** Lightness, chroma and hue, on paper and in the dark. */
const STOPS = [
    [[0.965, 0.045, 100], [0.815, 0.1, 165], [0.665, 0.115, 225], [0.515, 0.13, 262]],
    [[0.3, 0.09, 300], [0.465, 0.105, 258], [0.63, 0.11, 195], [0.795, 0.165, 140]],
];

/** So many colours are drawn, each in one go. */
const LEVELS = 48;

const encode = (linear) => {
    const value = linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
    return Math.round(255 * Math.min(1, Math.max(0, value))).toString(16).padStart(2, '0');
};

/** A colour of the ramp, from Oklab's lightness, chroma and hue. @param {number} share 0 to 1 */
export function rampColour(dark, share) {
    const at = Math.min(1, Math.max(0, share)) * 3, i = at >= 2 ? 2 : at >= 1 ? 1 : 0;
    const [from, to] = STOPS[dark ? 1 : 0].slice(i, i + 2);
    const [lightness, chroma, hue] = from.map((v, k) => v + (to[k] - v) * (at - i));
    const a = chroma * Math.cos((hue * Math.PI) / 180), b = chroma * Math.sin((hue * Math.PI) / 180);
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3;
    return `#${encode(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s)}${
        encode(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s)}${
        encode(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)}`;
}

/**
 * The least and the most of what is defined. Small parts of the graph do not count: those with less than
 * a tenth of the largest part's points (sl_vga_scale_of).
 * @param {Float64Array} values @param {Float64Array} [sizes] by point: the size of its part
 */
export function rangeOf(values, sizes) {
    let least = Infinity, most = -Infinity, largest = 0;
    sizes?.forEach((size, i) => {
        if (!Number.isNaN(values[i])) largest = Math.max(largest, size);
    });
    for (let i = 0; i < values.length; i++) {
        const value = values[i];
        if (sizes && sizes[i] < largest / 10) continue;
        if (value < least) least = value;
        if (value > most) most = value;
    }
    return { least, most };
}

const shareOf = (heat, value) => (heat.most > heat.least ? (value - heat.least) / (heat.most - heat.least) : 0.5);

/** @param {Heat} heat @param {import('./tones.js').Tones} tones */
export function drawHeat(surface, camera, heat, tones) {
    // Squares overlap by less than a pixel, so that nothing shows between them.
    const groups = Array.from({ length: LEVELS }, () => []), { step } = heat, h = step / 2 + 0.4 / camera.scale;
    heat.squares.forEach((square, p) => {
        if (Number.isNaN(heat.values[p])) return;
        const level = Math.min(LEVELS - 1, Math.max(0, Math.floor(shareOf(heat, heat.values[p]) * LEVELS)));
        const x = (heat.left + Math.floor(square / heat.rows)) * step, y = (heat.bottom + (square % heat.rows)) * step;
        groups[level].push([x - h, y - h, x + h, y - h, x + h, y + h, x - h, y + h]);
    });
    groups.forEach((squares, i) => fillPolygons(surface, camera, squares, rampColour(tones.dark, (i + 0.5) / LEVELS)));
}

/** The value of the square that a place lies in; undefined without a point there. @param {Heat} heat */
export function valueAt(heat, [x, y]) {
    const column = Math.round(x / heat.step) - heat.left, row = Math.round(y / heat.step) - heat.bottom;
    if (!(column >= 0 && column < heat.columns && row >= 0 && row < heat.rows)) return undefined;
    const point = heat.squares.indexOf(column * heat.rows + row);
    return point < 0 ? undefined : heat.values[point];
}
