/**
 * A kd-tree of axial walls, with rules that can be switched off.
 *
 * A box without a wall inside is a cell. Any other box is split along a line through a wall. The rules
 * of Teller and Séquin (1991) choose it: a wall that spans the box first; else a line that walls cover
 * for the most part and that cuts few walls. The library has the same idea, with more care; this one is
 * small enough to read. Cost: each box looks at each of its lines and walls.
 */

/** @typedef {{box: number[], depth: number}} Cell */

/** Axial walls as {axis, at, from, to}: axis 0 is a wall x = at. @param {number[][]} segments */
export const axialWalls = (segments) => segments.map(([ax, ay, bx, by]) => (ax === bx
    ? { axis: 0, at: ax, from: Math.min(ay, by), to: Math.max(ay, by) }
    : { axis: 1, at: ay, from: Math.min(ax, bx), to: Math.max(ax, bx) }));

/** The parts of walls inside a box, without those on its sides. */
function clip(walls, box) {
    return walls.flatMap((wall) => {
        const { axis, at } = wall, across = 1 - axis;
        const from = Math.max(wall.from, box[across]), to = Math.min(wall.to, box[across + 2]);
        return at > box[axis] && at < box[axis + 2] && from < to ? [{ axis, at, from, to }] : [];
    });
}

/** Lines through walls: how much of each is covered, and how many walls it cuts. */
function linesOf(walls, box) {
    const lines = new Map();
    for (const { axis, at } of walls) {
        if (lines.has(`${axis} ${at}`)) continue;
        const on = walls.filter((w) => w.axis === axis && w.at === at), across = 1 - axis;
        const cut = walls.filter((w) => w.axis === across && w.from < at && w.to > at).length;
        const covered = on.reduce((sum, w) => sum + w.to - w.from, 0) / (box[across + 2] - box[across]);
        const off = Math.abs(at - (box[axis] + box[axis + 2]) / 2);
        lines.set(`${axis} ${at}`, { axis, at, covered, cut, off });
    }
    return [...lines.values()];
}

/** @param {{spanning: boolean, obscured: boolean, cleaving: boolean}} rules */
function choose(lines, rules) {
    const spanning = lines.filter((line) => line.covered >= 1);
    if (rules.spanning && spanning.length) return spanning.sort((a, b) => a.off - b.off)[0];
    const obscured = lines.filter((line) => line.covered >= 0.5);
    const left = rules.obscured && obscured.length ? obscured : lines;
    return [...left].sort((a, b) => (rules.cleaving ? a.cut - b.cut : 0) || a.off - b.off)[0];
}

/**
 * Splits box after box, the largest depth last, at most `most` times.
 * @returns {{cells: Cell[], splits: number[][]}} splits as segments
 */
export function kdTree(walls, box, rules, most = Infinity) {
    const open = [{ box, depth: 0 }], cells = [], splits = [];
    while (open.length) {
        const cell = open.shift(), inside = clip(walls, cell.box);
        if (!inside.length || splits.length >= most) {
            cells.push(cell);
            continue;
        }
        const { axis, at } = choose(linesOf(inside, cell.box), rules), [x0, y0, x1, y1] = cell.box;
        splits.push(axis ? [x0, at, x1, at] : [at, y0, at, y1]);
        const halves = axis ? [[x0, y0, x1, at], [x0, at, x1, y1]] : [[x0, y0, at, y1], [at, y0, x1, y1]];
        for (const half of halves) open.push({ box: half, depth: cell.depth + 1 });
    }
    return { cells, splits };
}

/** Open parts of sides between cells, as segments. @param {Cell[]} cells */
export function portalsOf(cells, walls) {
    const portals = [];
    for (const { box: a } of cells)
        for (const { box: b } of cells)
            for (const axis of [0, 1]) {
                const across = 1 - axis, at = a[axis + 2];
                if (at !== b[axis]) continue;
                let from = Math.max(a[across], b[across]);
                const to = Math.min(a[across + 2], b[across + 2]);
                const on = walls.filter((w) => w.axis === axis && w.at === at && w.from < to && w.to > from);
                for (const wall of [...on.sort((p, q) => p.from - q.from), { from: to, to }]) {
                    if (wall.from > from) portals.push(axis ? [from, at, wall.from, at] : [at, from, at, wall.from]);
                    from = Math.max(from, wall.to);
                }
            }
    return portals;
}
