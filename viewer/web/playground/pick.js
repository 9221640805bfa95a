/** Which item, and which end of it, is near a place; and where the pointer snaps to. */
import { itemLine } from '../parts/plan.js';

/** @typedef {import('../formats/map-text.js').Item} Item */

/** Distance of a point from a segment. */
function distanceTo(x, y, ax, ay, bx, by) {
    const dx = bx - ax, dy = by - ay, length = dx * dx + dy * dy;
    const t = length ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / length)) : 0;
    return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

/**
 * The nearest item within a distance; an end wins over a line.
 * @param {Item[]} items @returns {{index: number, end: number} | null} end: of its points, -1 for none
 */
export function pick(items, x, y, within) {
    let best = null, least = within, leastEnd = within;
    items.forEach((item, index) => {
        const p = item.points;
        for (let i = 0; i + 1 < p.length; i += 2) {
            const d = Math.hypot(x - p[i], y - p[i + 1]);
            if (d <= leastEnd) {
                leastEnd = d;
                best = { index, end: i };
            }
        }
        if (best?.end >= 0) return;
        const line = itemLine(item);
        for (let i = 0; i + 3 < line.length; i += 2) {
            const d = distanceTo(x, y, line[i], line[i + 1], line[i + 2], line[i + 3]);
            if (d <= least) {
                least = d;
                best = { index, end: -1 };
            }
        }
    });
    return best;
}

const roundTo = (value, step) => (step < 1 ? Math.round(value * Math.round(1 / step)) / Math.round(1 / step)
    : Math.round(value / step) * step);

/** The nearest place of the grid, or an end of a wall that is nearer. */
export function snapTo(items, x, y, step, within, except = null) {
    let best = [roundTo(x, step), roundTo(y, step)], least = within;
    for (const item of items) {
        if (item === except) continue;
        const p = item.points;
        for (let i = 0; i + 1 < p.length; i += 2) {
            const d = Math.hypot(x - p[i], y - p[i + 1]);
            if (d < least) {
                least = d;
                best = [p[i], p[i + 1]];
            }
        }
    }
    return best;
}

/** Items with all ends at one place moved to another, so that joined walls stay joined. */
export function moveEnds(items, from, to) {
    return items.map((item) => {
        const p = item.points;
        let found = false;
        for (let i = 0; i + 1 < p.length; i += 2) found ||= p[i] === from[0] && p[i + 1] === from[1];
        if (!found) return item;
        const at = (i) => p[i] === from[0] && p[i + 1] === from[1];
        return { ...item, points: p.map((v, i) => (at(i - (i % 2)) ? to[i % 2] : v)) };
    });
}

/** @param {Item} item */
export const shiftItem = (item, dx, dy) => ({ ...item, points: item.points.map((v, i) => v + (i % 2 ? dy : dx)) });
