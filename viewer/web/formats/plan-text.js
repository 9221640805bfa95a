/**
 * ASCII plans: a square for each character. Walls stand where solid and open squares meet, each
 * with the solid ground at its left. Runs along one line become one wall.
 */
import { FormatError } from './map-text.js';

/** Whether a text looks like a plan. @param {string} text */
export const isPlan = (text) => /^[#.+@ \r\n]*$/.test(text) && text.includes('#');

/**
 * Walls along one direction of the grid. `solid(a, i)` says whether a square before (i - 1) or
 * behind (i) the line is solid.
 */
function runs(lines, length, sideAt, put) {
    for (let i = 0; i <= lines; i++) {
        let from = 0, side = 0;
        for (let k = 0; k <= length; k++) {
            const now = k < length ? sideAt(i, k) : 0;
            if (now === side) continue;
            if (side) put(i, from, k, side);
            from = k;
            side = now;
        }
    }
}

/** @param {boolean[][]} solid rows from below, of one length @returns {import('./map-text.js').Item[]} */
export function gridWalls(solid, size = 1, x0 = 0, y0 = 0) {
    const rows = solid.length, columns = solid[0]?.length ?? 0, items = [];
    const at = (x, y) => solid[y]?.[x] ?? true;
    const wall = (ax, ay, bx, by) => items.push({
        kind: 'wall',
        points: [x0 + ax * size, y0 + ay * size, x0 + bx * size, y0 + by * size],
        state: 'solid',
    });
    // 1: solid ground below or at the left of the line, 2: above it or at the right.
    const side = (first, second) => (first === second ? 0 : first ? 1 : 2);
    runs(rows, columns, (y, x) => side(at(x, y - 1), at(x, y)),
        (y, from, to, s) => (s === 2 ? wall(from, y, to, y) : wall(to, y, from, y)));
    runs(columns, rows, (x, y) => side(at(x - 1, y), at(x, y)),
        (x, from, to, s) => (s === 1 ? wall(x, from, x, to) : wall(x, to, x, from)));
    return items;
}

/** @param {string} text @returns {import('./map-text.js').Item[]} */
export function parsePlan(text) {
    const lines = text.split(text.includes('\n') ? '\n' : '\r').map((line) => line.replace(/\r$/, ''));
    while (lines.length && lines[lines.length - 1] === '') lines.pop();
    const columns = Math.max(0, ...lines.map((line) => line.length)), rows = lines.length;
    const rowsUp = lines.map((line) => line.padEnd(columns, '#')).reverse();
    const solid = rowsUp.map((line) => [...line].map((c) => c === '#'));
    const at = (x, y) => solid[y]?.[x] ?? true;
    const items = gridWalls(solid), starts = [];
    let doors = 0;
    for (let y = rows - 1; y >= 0; y--)
        for (let x = 0; x < columns; x++) {
            const c = rowsUp[y][x];
            if (c === '@') starts.push({ kind: 'start', points: [x + 0.5, y + 0.5], heading: 0 });
            if (c !== '+') continue;
            const across = at(x - 1, y) && at(x + 1, y), along = at(x, y - 1) && at(x, y + 1);
            if (across === along)
                throw new FormatError(`column ${x + 1}: a door needs solid squares on two opposite ` +
                    'sides, and open floor on one of the others', rows - y);
            const points = across ? [x, y + 0.5, x + 1, y + 0.5] : [x + 0.5, y, x + 0.5, y + 1];
            items.push({ kind: 'door', name: `door${++doors}`, points, state: 'open' });
        }
    return [...items, ...starts];
}
