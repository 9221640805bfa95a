/**
 * Fisk's proof of the art gallery theorem, as a program: a polygon is cut into triangles, its corners get three colours,
 * and guards stand at the corners of the rarest colour.
 *
 * Triangles are taken off as ears: three corners in a row whose triangle lies inside and holds no other corner. Each
 * polygon has an ear. The last triangle gets three colours. Back to the first ear, each tip gets the colour that its two
 * neighbours do not have. All decisions are signs of cross products; with coordinates on a grid they are exact.
 */
const side = ([ax, ay], [bx, by], [cx, cy]) => Math.sign((bx - ax) * (cy - ay) - (by - ay) * (cx - ax));

const isWithin = ([ax, ay], [bx, by], [x, y]) => Math.min(ax, bx) <= x && x <= Math.max(ax, bx) && Math.min(ay, by) <= y && y <= Math.max(ay, by);

/** Whether two segments have a place in common. */
function meet(a, b, c, d) {
    const [s, t, u, v] = [side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)];
    return (s !== t && u !== v) || (s === 0 && isWithin(a, b, c)) || (t === 0 && isWithin(a, b, d)) || (u === 0 && isWithin(c, d, a)) || (v === 0 && isWithin(c, d, b));
}

/** Whether an outline does not meet itself. @param {number[][]} points */
export function isSimple(points) {
    const n = points.length, next = (i) => points[(i + 1) % n];
    return points.every((p, i) => (p[0] !== next(i)[0] || p[1] !== next(i)[1]) && points.every((q, j) => {
        if (j <= i) return true;
        if (j === i + 1 || (i === 0 && j === n - 1)) {
            const [a, b, c] = j === i + 1 ? [p, q, next(j)] : [q, p, next(i)];
            return side(a, b, c) !== 0 || !(isWithin(a, b, c) || isWithin(b, c, a));
        }
        return !meet(p, next(i), q, next(j));
    }));
}

/**
 * The ears of a polygon in the order in which they are taken off; the last one is what is left.
 * @param {number[][]} points counter-clockwise, a simple polygon
 * @returns {number[][]} three corners each, by number: before, tip, after
 */
export function earsOf(points) {
    const left = points.map((_, i) => i), ears = [];
    while (left.length > 3) {
        const at = left.findIndex((tip, k) => {
            const [before, after] = [left.at(k - 1), left[(k + 1) % left.length]], [a, b, c] = [points[before], points[tip], points[after]];
            const turn = side(a, b, c);
            return turn === 0 || (turn > 0 && !left.some((i) => i !== before && i !== tip && i !== after &&
                side(a, b, points[i]) >= 0 && side(b, c, points[i]) >= 0 && side(c, a, points[i]) >= 0));
        });
        ears.push([left.at(at - 1), left[at], left[(at + 1) % left.length]]);
        left.splice(at, 1);
    }
    return [...ears, left];
}

/** The colours 0, 1 and 2 of corners; -1 where the first `steps` of the colouring do not come. @param {number[][]} ears */
export function coloursOf(ears, count, steps = ears.length) {
    const colours = Array(count).fill(-1), [last, ...others] = [...ears].reverse().slice(0, steps);
    last?.forEach((corner, i) => (colours[corner] = i));
    for (const [before, tip, after] of others) colours[tip] = 3 - colours[before] - colours[after];
    return colours;
}

/** The corners of the colour that fewest have. */
export function guardsOf(colours) {
    const groups = [0, 1, 2].map((colour) => colours.flatMap((c, i) => (c === colour ? [i] : [])));
    return groups.reduce((least, group) => (group.length < least.length ? group : least));
}
