/**
 * A line that rotates about a corner, for figures: the idea of the sweep in ordinary numbers.
 *
 * A line passes a corner freely while no wall at the corner is on one side of it and some other on the
 * other side. So its directions lie in the widest gap between the walls of the corner, and that gap is
 * wider than half a turn. Between two directions in which the line meets ends of portals, both its
 * halves cross the same cells. So one direction between each two neighbours is enough.
 *
 * Invariant: cells of the forward half and of the backward half of one direction see each other. Cost:
 * for each corner, as many walks along the line as there are ends of portals. The library walks once,
 * with exact signs, and handles lines that only touch; here they are left out, as with open sight.
 */

const turn = 2 * Math.PI;
const cross = (ax, ay, bx, by) => ax * by - ay * bx;
const wrap = (angle) => ((angle % turn) + turn) % turn;

/** Directions that differ by less are one. */
const SAME = 1e-9;

/** Places of wall ends, each with the directions of its walls. */
function wallEndsOf(scene) {
    const places = new Map(), ends = scene.wallEnds;
    for (let i = 0; i < scene.wallCount; i++) {
        const [ax, ay, bx, by] = ends.subarray(5 * i, 5 * i + 4);
        for (const [x, y, dx, dy] of [[ax, ay, bx - ax, by - ay], [bx, by, ax - bx, ay - by]]) {
            const key = `${x} ${y}`;
            if (!places.has(key)) places.set(key, { at: [x, y], walls: [] });
            places.get(key).walls.push(wrap(Math.atan2(dy, dx)));
        }
    }
    return [...places.values()];
}

const cellBeside = (scene, [x, y], angle) => {
    const cell = scene.locate(x + 1e-6 * Math.cos(angle), y + 1e-6 * Math.sin(angle));
    return cell >= 0 && scene.cellTable[6 * cell + 4] ? cell : -1;
};

/**
 * The corners that a line rotates about, each with its first direction and how far it turns.
 * @returns {{at: number[], from: number, size: number}[]}
 */
export function pivotsOf(scene) {
    return wallEndsOf(scene).flatMap(({ at, walls }) => {
        walls.sort((a, b) => a - b);
        const gaps = walls.map((from, i) => ({ from, size: i + 1 < walls.length ? walls[i + 1] - from : walls[0] + turn - from }));
        const widest = gaps.reduce((best, gap) => (gap.size > best.size ? gap : best)), size = widest.size - Math.PI;
        if (size < SAME || cellBeside(scene, at, widest.from + widest.size / 2) < 0) return [];
        return [{ at, from: widest.from, size }];
    });
}

/** The cells that a ray crosses, in order. */
export function cellsAlong(scene, [x, y], angle) {
    const dx = Math.cos(angle), dy = Math.sin(angle), cells = [], { cellTable: table, directedEnds: ends, directedCells: behind } = scene;
    for (let cell = cellBeside(scene, [x, y], angle); cell >= 0 && cells.length < scene.cellCount;) {
        cells.push(cell);
        const [first, count] = table.subarray(6 * cell + 2, 6 * cell + 4);
        cell = -1;
        for (let i = first; i < first + count && cell < 0; i++) {
            const [lx, ly, rx, ry] = ends.subarray(5 * i + 1, 5 * i + 5);
            if (cross(dx, dy, lx - x, ly - y) > 0 && cross(dx, dy, rx - x, ry - y) < 0) cell = behind[10 * i + 1];
        }
    }
    return cells;
}

/** Directions to ends of portals, as differences to `from` below `size`, ascending; `period` is a turn or half of it. */
function directionsTo(scene, [x, y], from, size, period) {
    const ends = scene.portalEnds, list = [0, size];
    for (let i = 0; i < ends.length; i += 5)
        for (const at of [i + 1, i + 3]) {
            if (ends[at] === x && ends[at + 1] === y) continue;
            const angle = wrap(Math.atan2(ends[at + 1] - y, ends[at] - x) - from) % period;
            if (angle < size) list.push(angle);
        }
    list.sort((a, b) => a - b);
    return list.filter((angle, i) => !i || angle - list[i - 1] > SAME);
}

/**
 * The rotation about one corner: stretches of directions with the same cells before and behind.
 * @param {{at: number[], from: number, size: number}} pivot
 * @returns {{from: number, to: number, before: number[], behind: number[]}[]}
 */
export function rotate(scene, pivot) {
    const angles = directionsTo(scene, pivot.at, pivot.from, pivot.size, Math.PI), stretches = [];
    for (let i = 0; i + 1 < angles.length; i++) {
        const [from, to] = [pivot.from + angles[i], pivot.from + angles[i + 1]], middle = (from + to) / 2, last = stretches.at(-1);
        const before = cellsAlong(scene, pivot.at, middle), behind = cellsAlong(scene, pivot.at, middle + Math.PI);
        if (last && String(last.before) === String(before) && String(last.behind) === String(behind)) last.to = to;
        else stretches.push({ from, to, before, behind });
    }
    return stretches;
}

/** All cells that are seen from one place. */
export function seenFrom(scene, place) {
    const angles = directionsTo(scene, place, 0, turn, turn), seen = new Set();
    for (let i = 0; i + 1 < angles.length; i++)
        for (const cell of cellsAlong(scene, place, (angles[i] + angles[i + 1]) / 2)) seen.add(cell);
    return seen;
}

/** Pairs of cells, as a set of numbers; each pair once, and no cell with itself. */
export class Pairs {
    constructor(cellCount) {
        this.cellCount = cellCount;
        this.all = new Set();
    }

    /** @returns {boolean} whether the pair is new */
    add(a, b) {
        if (a === b) return false;
        const number = Math.min(a, b) * this.cellCount + Math.max(a, b), isNew = !this.all.has(number);
        this.all.add(number);
        return isNew;
    }

    has(a, b) {
        return this.all.has(Math.min(a, b) * this.cellCount + Math.max(a, b));
    }
}

/** Joins each cell before the corner with each one behind it. @returns {number[][]} pairs that are new */
export function joinAll(pairs, before, behind) {
    return before.flatMap((a) => behind.filter((b) => pairs.add(a, b)).map((b) => [a, b]));
}
