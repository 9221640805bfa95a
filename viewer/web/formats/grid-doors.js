/**
 * Where a door stands among the squares of a map: from a solid square to the opposite one, with open
 * squares at both sides. The box of an object says roughly where, the squares say the rest. Where a
 * door is drawn on solid squares, they are opened. lib/io/parts/things_place.c does the same.
 */
import { plural } from './words.js';

/**
 * @typedef {Object} Grid
 * @property {boolean[][]} solid rows from below @property {number} size of a square
 * @property {number} x0 @property {number} y0 the lower left corner
 */

/** Squares from .. to (without it) whose middles lie in [low, high]; at least that of the middle. */
function range(low, high) {
    const from = Math.ceil(low - 0.5 - 1e-9), to = Math.floor(high - 0.5 + 1e-9) + 1;
    const middle = Math.floor((low + high) / 2);
    return from < to ? [from, to] : [middle, middle + 1];
}

/** A line of the door from solid to solid, with open squares at both sides; null for none. */
function findLine(isSolid, [from, to], [low, high], middle) {
    const found = [];
    for (let row = low; row < high; row++) {
        let [a, b] = [from, to];
        while (a < b && isSolid(a, row)) a++;
        while (b > a && isSolid(b - 1, row)) b--;
        const all = Array.from({ length: b - a }, (_, i) => a + i);
        const open = a < b && all.every((x) => !isSolid(x, row)) && isSolid(a - 1, row) && isSolid(b, row);
        if (open && all.some((x) => !isSolid(x, low - 1)) && all.some((x) => !isSolid(x, high))) found.push([a, b, row + 0.5]);
    }
    const [first] = found.sort((p, q) => Math.abs(p[2] - middle) - Math.abs(q[2] - middle));
    return first ?? null;
}

/**
 * @param {Grid} grid its squares change where the door is cut into solid ground
 * @param {number[]} box x0, y0, x1, y1 of the object @returns {number[] | null} the ends of the door
 */
export function placeDoor(grid, box) {
    const { solid, size, x0, y0 } = grid, at = (x, y) => solid[y]?.[x] ?? true;
    const [left, bottom, right, top] = box.map((v, i) => (v - (i % 2 ? y0 : x0)) / size);
    const columns = range(left, right), rows = range(bottom, top);
    const level = () => {
        const found = findLine(at, columns, rows, (bottom + top) / 2);
        return found && [x0 + found[0] * size, y0 + found[2] * size, x0 + found[1] * size, y0 + found[2] * size];
    };
    const upright = () => {
        const found = findLine((y, x) => at(x, y), rows, columns, (left + right) / 2);
        return found && [x0 + found[2] * size, y0 + found[0] * size, x0 + found[2] * size, y0 + found[1] * size];
    };
    const ways = right - left >= top - bottom ? [level, upright] : [upright, level];
    const found = ways[0]() ?? ways[1]();
    if (found) return found;
    const before = [];
    for (let y = rows[0]; y < rows[1]; y++)
        for (let x = columns[0]; x < columns[1]; x++)
            if (solid[y]?.[x]) {
                before.push([x, y]);
                solid[y][x] = false;
            }
    const cut = before.length ? ways[0]() ?? ways[1]() : null;
    if (!cut) for (const [x, y] of before) solid[y][x] = true;
    return cut;
}

/** The box's own middle line, along its longer side: for a door that no squares place. */
export function middleLine([x0, y0, x1, y1]) {
    return x1 - x0 >= y1 - y0 ? [x0, (y0 + y1) / 2, x1, (y0 + y1) / 2] : [(x0 + x1) / 2, y0, (x0 + x1) / 2, y1];
}

/** Whether a door that no squares place can be kept as it is drawn: it has a length, and stands on open ground. */
function canStand(grid, box) {
    const [ax, ay, bx, by] = middleLine(box);
    const at = (v, from) => Math.floor((v - from) / grid.size);
    return (ax !== bx || ay !== by) && !(grid && grid.solid[at((ay + by) / 2, grid.y0)]?.[at((ax + bx) / 2, grid.x0)]);
}

/**
 * Places doors, and makes their names differ.
 * @param {Grid | null} grid @param {{name: string, state: string, box: number[]}[]} doors @param {string[]} notes
 * @returns {import('./map-text.js').Item[]}
 */
export function doorItems(grid, doors, notes) {
    const used = new Map();
    let loose = 0, left = 0;
    const items = doors.flatMap(({ name, state, box }) => {
        const placed = grid && placeDoor(grid, box);
        if (!placed && !canStand(grid, box)) {
            left++;
            return [];
        }
        const count = (used.get(name) ?? 0) + 1;
        used.set(name, count);
        if (!placed) loose++;
        return { kind: 'door', name: count > 1 ? `${name}:${count}` : name, points: placed ?? middleLine(box), state };
    });
    if (left) notes.push(`${plural(left, 'door')} in solid ground or of no size`);
    if (loose && grid) notes.push(`${loose} ${loose === 1 ? 'door stands' : 'doors stand'} between no solid squares: check where`);
    return items;
}
