/**
 * Shortest ways by the visibility graph of corners (Lozano-Pérez and Wesley 1979), with Dijkstra's search.
 *
 * A shortest way is a string that is pulled tight, so it turns only at corners that it can lie against: there the free
 * angle is wider than half a turn. Nodes are these corners, the beginning and the end. Two of them are joined if the
 * segment between them crosses no wall. Of these edges, a shortest way uses only those that are tangent to the corners at
 * their ends: the walls of the corner lie on one side.
 *
 * All decisions are signs, exact for places of few digits (`onGrid`); lengths are rounded. Walls may touch, but not cross.
 * Between walls that meet in a point there is no way through. Cost: n corners and m walls take n² m steps; a rotating line
 * about each corner takes n² log n.
 */
import { compareAngles, cross, isOn, side } from './angular.js';

const minus = ([ax, ay], [bx, by]) => [ax - bx, ay - by];

const isSame = ([ax, ay], [bx, by]) => ax === bx && ay === by;

/** Directions of the walls that leave a place. */
const armsAt = (at, walls) => walls.filter((wall) => isOn(at, wall))
    .flatMap(([ax, ay, bx, by]) => [[ax, ay], [bx, by]].filter((end) => !isSame(end, at)).map((end) => minus(end, at)));

/** Whether b is more than half a turn from a, counter-clockwise; for a single wall it is a whole turn. */
const isWide = (a, b) => cross(a, b) < 0 || (a[0] * b[0] + a[1] * b[1] > 0 && cross(a, b) === 0);

/** All ends of walls, with their arms; `gap` is the free angle that a way can turn in, or none. */
function endsOf(walls) {
    const ends = new Map(walls.flatMap(([ax, ay, bx, by]) => [[`${ax} ${ay}`, [ax, ay]], [`${bx} ${by}`, [bx, by]]]));
    return [...ends.values()].map((at) => {
        const arms = armsAt(at, walls).sort(compareAngles), i = arms.findIndex((arm, k) => isWide(arm, arms[(k + 1) % arms.length]));
        return { at, arms, gap: i < 0 ? null : [arms[i], arms[(i + 1) % arms.length]] };
    });
}

/** Whether a direction leads into the gap of a corner, or along its sides. */
const opens = ({ gap }, d) => !gap || !(cross(gap[1], d) > 0 && cross(d, gap[0]) > 0);

/** Whether a line in this direction passes a corner with all of its walls on one side. */
const isTangent = ({ gap }, d) => !gap || cross(d, gap[0]) * cross(d, gap[1]) >= 0;

const isBetween = (a, b, p) => side(a, b, p) === 0 && (p[0] - a[0]) * (p[0] - b[0]) + (p[1] - a[1]) * (p[1] - b[1]) < 0;

/** Whether one can walk from node to node straight on. */
function isFree(a, b, walls, ends) {
    const d = minus(b.at, a.at), crosses = ([ax, ay, bx, by]) => side(a.at, b.at, [ax, ay]) * side(a.at, b.at, [bx, by]) < 0 &&
        side([ax, ay], [bx, by], a.at) * side([ax, ay], [bx, by], b.at) < 0;
    if (!opens(a, d) || !opens(b, [-d[0], -d[1]]) || walls.some(crosses)) return false;
    return !ends.some(({ at, arms }) => isBetween(a.at, b.at, at) && arms.some((arm) => cross(d, arm) > 0) && arms.some((arm) => cross(d, arm) < 0));
}

/** New numbers for nodes 0 and 1 and all that is joined to them. Corners on the far side of outer walls are left out. */
function reached(pairs) {
    const numbers = new Map([[0, 0], [1, 1]]);
    for (let size = 0; size < numbers.size;) {
        size = numbers.size;
        for (const [i, j] of pairs)
            if (numbers.has(i) !== numbers.has(j)) numbers.set(numbers.has(i) ? j : i, numbers.size);
    }
    return numbers;
}

/**
 * The graph of two places among walls: nodes 0 and 1 are the places.
 * @param {number[]} from on no wall @param {number[]} to @param {number[][]} walls ax, ay, bx, by
 * @returns {{nodes: {at: number[]}[], edges: {a: number, b: number, length: number, isTangent: boolean}[]}}
 */
export function cornerGraph(from, to, walls) {
    const ends = endsOf(walls), all = [{ at: from, gap: null }, { at: to, gap: null }, ...ends.filter(({ gap }) => gap)], pairs = [];
    all.forEach((a, i) => all.slice(0, i).forEach((b, j) => {
        if (!isSame(a.at, b.at) && isFree(a, b, walls, ends)) pairs.push([i, j]);
    }));
    const numbers = reached(pairs), edges = pairs.flatMap(([i, j]) => {
        const d = minus(all[j].at, all[i].at);
        return numbers.has(i) ? [{ a: numbers.get(i), b: numbers.get(j), length: Math.hypot(...d), isTangent: isTangent(all[i], d) && isTangent(all[j], d) }] : [];
    });
    return { nodes: [...numbers.keys()].map((i) => all[i]), edges };
}

/** Dijkstra's search from node 0 to node 1. @returns {{order: number[], parents: number[], length: number, way: number[][]}} */
export function shortestWay({ nodes, edges }) {
    const far = nodes.map((_, i) => (i ? Infinity : 0)), parents = nodes.map(() => -1), order = [], left = new Set(nodes.keys());
    while (left.size && !order.includes(1)) {
        const next = [...left].reduce((best, i) => (far[i] < far[best] ? i : best));
        if (far[next] === Infinity) break;
        left.delete(next);
        order.push(next);
        for (const { a, b, length } of edges) {
            const other = a === next ? b : b === next ? a : -1;
            if (other >= 0 && far[next] + length < far[other]) [far[other], parents[other]] = [far[next] + length, next];
        }
    }
    const way = [];
    for (let i = far[1] < Infinity ? 1 : -1; i >= 0; i = parents[i]) way.unshift(nodes[i].at);
    return { order, parents, length: far[1], way };
}
