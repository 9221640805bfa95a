/**
 * Polyanya (Cui, Harabor and Grastien 2017): a shortest way by search among portals of convex cells, not among corners.
 *
 * A node is a root, the last corner of a way, and the directions that lead from it straight through a portal into a cell. Two
 * limits bound them: rays through ends of portals. From a cell the directions go on through its other portals; each limit is the
 * old one or an end of the new portal. Where a limit is an end of the portal just passed and a wall ends there, the way may
 * turn around it: that end is the root of directions beyond the limit. Nodes are taken by the way to the root plus the least that
 * is missing, by way of the piece of the portal that the directions pass. So the first way that arrives is a shortest one, and no
 * graph is made beforehand.
 *
 * Limits are ends of portals, so their signs are exact for places of few digits. Lengths are rounded.
 */
import { isOn, side } from './angular.js';
import { cellAt } from './lab.js';

const isSame = (a, b) => a[0] === b[0] && a[1] === b[1];

const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

/** Where the ray from a through b meets the line of a portal. */
function meet(a, b, { left, right }) {
    const [ux, uy] = [b[0] - a[0], b[1] - a[1]], [vx, vy] = [left[0] - right[0], left[1] - right[1]];
    const t = ((right[0] - a[0]) * vy - (right[1] - a[1]) * vx) / (ux * vy - uy * vx);
    return [a[0] + t * ux, a[1] + t * uy];
}

/** A place, or its mirror image if it lies on the same side of a portal as the root. */
function beyond(root, place, { left, right }) {
    if (side(right, left, root) * side(right, left, place) <= 0) return place;
    const [ux, uy] = [left[0] - right[0], left[1] - right[1]], k = (2 * (ux * (place[1] - right[1]) - uy * (place[0] - right[0]))) / (ux * ux + uy * uy);
    return [place[0] + k * uy, place[1] - k * ux];
}

/** The least length from a root to a place by way of a piece of a portal; and the piece. */
function pieceOf({ root, limits: [l, r] }, portal, to) {
    if (side(portal.right, portal.left, root) === 0) return { piece: [portal.left, portal.right], least: distance(root, to) };
    const piece = [[l, portal.left], [r, portal.right]].map(([limit, end]) => (!limit || isSame(limit, end) ? end : meet(root, limit, portal)));
    const place = beyond(root, to, portal), by = [1, -1].findIndex((turn, i) => turn * side(root, piece[i], place) > 0);
    return { piece, least: by < 0 ? distance(root, place) : distance(root, piece[by]) + distance(piece[by], place) };
}

/**
 * The limits of a node's directions that pass a portal; null for none. Limits are left and right, each a place or null for no
 * limit. From a root on the portal all of the cell behind is seen.
 */
function through({ root, limits }, { left, right }) {
    if (isOn(root, [...left, ...right])) return limits;
    const past = limits.map((limit, i) => [left, right].map((end) => (limit ? (i ? -1 : 1) * side(root, limit, end) : -1)));
    // A portal with both ends on a limit is passed by walking along it.
    if (past.some((ends) => ends.every((end) => end >= 0) && ends.some((end) => end > 0))) return null;
    return [left, right].map((end, i) => (past[i][i] > 0 ? limits[i] : end));
}

/** Where a way may turn after a portal: a root at each end that is a limit of the node and an end of a wall, with the directions beyond. */
const turnsOf = ({ root, limits, entry, length }, isCorner) => [0, 1].flatMap((i) => {
    const end = i ? entry?.right : entry?.left;
    if (!entry || isSame(root, end) || !limits[i] || !isSame(limits[i], end) || !isCorner(end)) return [];
    const ahead = [2 * end[0] - root[0], 2 * end[1] - root[1]];
    return [{ root: end, limits: i ? [ahead, null] : [null, ahead], length: length + distance(root, end) }];
});

/** Whether a place lies within the limits. */
const isWithin = ({ root, limits: [l, r] }, place) => !(l && side(root, l, place) > 0) && !(r && side(root, r, place) < 0);

/**
 * @param {number[]} from @param {number[]} to on the floor of the scene @param {number[][]} walls of its map
 * @returns {{steps: any[], way: number[][], length: number}} the nodes in the order in which they were taken; `way` is empty if there is none
 */
export function polyanya(scene, walls, from, to) {
    const corners = new Set(walls.flatMap(([ax, ay, bx, by]) => [`${ax} ${ay}`, `${bx} ${by}`])), isCorner = (place) => corners.has(place.join(' '));
    const goal = cellAt(scene, to), shortest = new Map(), known = new Set(), steps = [];
    const open = [{ root: from, limits: [null, null], entry: null, cell: cellAt(scene, from), length: 0, least: distance(from, to), roots: [from], piece: null }];
    while (open.length) {
        const node = open.splice(open.reduce((best, { least }, i) => (least < open[best].least ? i : best), 0), 1)[0];
        if (node.arrived) return { steps, way: [...node.roots, to], length: node.least };
        const key = node.root.join(' ');
        if (node.length > (shortest.get(key) ?? Infinity)) continue;
        shortest.set(key, node.length);
        steps.push(node);
        for (const start of [node, ...turnsOf(node, isCorner)]) {
            const roots = start === node ? node.roots : [...node.roots, start.root];
            if (node.cell === goal && isWithin(start, to)) open.push({ ...start, arrived: true, roots, least: start.length + distance(start.root, to) });
            for (const portal of scene.cell(node.cell).portals) {
                const limits = portal.portal === node.entry?.portal ? null : through(start, portal);
                const name = JSON.stringify([start.root, start.length, portal, limits]);
                if (!limits || known.has(name)) continue;
                known.add(name);
                const next = { root: start.root, limits, entry: portal, cell: portal.cell, length: start.length, roots }, { piece, least } = pieceOf(next, portal, to);
                open.push({ ...next, piece, least: start.length + least });
            }
        }
    }
    return { steps, way: [], length: Infinity };
}
