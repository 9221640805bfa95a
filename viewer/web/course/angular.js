/**
 * The angular sweep: what one eye sees, step by step (Asano 1985 for walls that need not form one polygon).
 *
 * A ray turns once around the eye. An event is an end of a wall; events are sorted by their angle. The status holds the
 * walls that the ray meets, the nearest first. At an event a wall comes into the status or leaves it. Where the first
 * wall of the status changes, the region gets corners.
 *
 * Invariant: between two events the status is the order of the walls along every ray. Walls may touch, but not cross, so
 * two of them never change places. Cost: sorting 2 n ends, and for each of them a search in the status.
 *
 * All decisions are signs of cross products. They are exact here, since walls of the course have coordinates of few
 * digits, and the eye is put on a grid (`onGrid`). Only corners of the region are rounded. At one angle walls begin
 * before others end, so the ray does not slip between two walls that it only touches. A wall that lies on the ray
 * hides nothing and is left out.
 */

/** Places of the eye are multiples of 1/64, so products of coordinates fit a double. */
export const onGrid = (place) => place.map((v) => Math.round(64 * v) / 64);

export const cross = ([ax, ay], [bx, by]) => ax * by - ay * bx;

/** Positive if c lies to the left of the line from a to b. */
export const side = (a, b, c) => Math.sign(cross([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]));

/** Whether a place lies on a wall. */
export const isOn = ([x, y], [ax, ay, bx, by]) => side([ax, ay], [bx, by], [x, y]) === 0 &&
    Math.min(ax, bx) <= x && x <= Math.max(ax, bx) && Math.min(ay, by) <= y && y <= Math.max(ay, by);

/** 0 for directions from 0° on, 1 for those from 180° on. */
const halfOf = ([x, y]) => (y > 0 || (y === 0 && x > 0) ? 0 : 1);

/** Below zero if direction a comes before b, on the way round from 0°. */
export const compareAngles = (a, b) => halfOf(a) - halfOf(b) || -Math.sign(cross(a, b));

/** Walls with their first end on the way round; `number` counts from 1, as in the picture. */
function turned(eye, walls) {
    return walls.flatMap(([ax, ay, bx, by], i) => {
        const a = [ax, ay], b = [bx, by], turn = side(eye, a, b);
        return turn === 0 ? [] : [{ number: i + 1, begin: turn > 0 ? a : b, end: turn > 0 ? b : a }];
    });
}

/** Whether wall a is nearer to the eye than b, where a ray meets both. */
function isNearer(eye, a, b) {
    const mine = side(b.begin, b.end, eye), sides = [a.begin, a.end].map((p) => side(b.begin, b.end, p) * mine);
    if (sides.every((s) => s >= 0)) return true;
    if (sides.every((s) => s <= 0)) return false;
    const yours = side(a.begin, a.end, eye);
    return [b.begin, b.end].every((p) => side(a.begin, a.end, p) * yours <= 0);
}

/** Where the ray from the eye through a place meets the line of a wall. */
function meet(eye, [px, py], { begin, end }) {
    const d = [px - eye[0], py - eye[1]], w = [end[0] - begin[0], end[1] - begin[1]];
    const t = cross([begin[0] - eye[0], begin[1] - eye[1]], w) / cross(d, w);
    return [eye[0] + t * d[0], eye[1] + t * d[1]];
}

/**
 * @param {number[]} eye on no wall @param {number[][]} walls ax, ay, bx, by
 * @returns {{events: any[], steps: any[], corners: number[][], sorting: number}} each step has its `kind`, the number of
 *   its event, the status, and how many corners and comparisons there are by then
 */
export function angularSweep(eye, walls) {
    const list = turned(eye, walls), from = (p) => [p[0] - eye[0], p[1] - eye[1]], steps = [], corners = [], status = [];
    let comparisons = 0;
    const events = list.flatMap((wall) => [{ wall, at: wall.begin, isBegin: true }, { wall, at: wall.end, isBegin: false }]);
    events.sort((a, b) => {
        comparisons++;
        return compareAngles(from(a.at), from(b.at)) || b.isBegin - a.isBegin;
    });
    const sorting = comparisons;
    const note = (kind, event, more = {}) => steps.push({ kind, event, status: status.map((wall) => wall.number), corners: corners.length, comparisons, ...more });
    const insert = (wall) => {
        let [low, high] = [0, status.length];
        while (low < high) {
            const middle = (low + high) >> 1;
            comparisons++;
            if (isNearer(eye, wall, status[middle])) high = middle;
            else low = middle + 1;
        }
        status.splice(low, 0, wall);
        return low;
    };
    const find = (wall) => {
        comparisons += Math.ceil(Math.log2(status.length + 1));
        return status.indexOf(wall);
    };
    note('sort', -1);
    for (const wall of list) if (halfOf(from(wall.begin)) === 1 && halfOf(from(wall.end)) === 0) insert(wall);
    note('start', -1);
    events.forEach(({ wall, at, isBegin }, i) => {
        const before = status[0];
        note('next', i);
        const place = isBegin ? insert(wall) : find(wall);
        if (!isBegin) status.splice(place, 1);
        note(isBegin ? 'insert' : 'remove', i, { place });
        if (status[0] === before) return;
        for (const nearest of [before, status[0]]) if (nearest) corners.push(meet(eye, at, nearest));
        note('corner', i);
    });
    note('done', events.length - 1);
    return { events, steps, corners, sorting };
}
