/** Halls with more and more columns of pillars: what the sweep and the search do in them, as the library counts it. */
import { hall } from './maps.js';

/** The widest hall of the figures. */
export const WIDEST = 6;

/** A hall with its visibility graph. `row`: columns, cells, edges of the graph, pieces of the sweep, nodes of the search. */
export function hallOf(lab, columns) {
    const text = hall(columns), scene = lab.scene(text), { pieces } = scene.account, places = new Map();
    for (let i = 0; i < scene.wallCount; i++)
        for (const at of [5 * i, 5 * i + 2]) {
            const [x, y] = scene.wallEnds.subarray(at, at + 2);
            places.set(`${x} ${y}`, { at: [x, y] });
        }
    const corners = [...places.values()], sees = (a, b) => scene.canSee({ x: a.at[0], y: a.at[1] }, { x: b.at[0], y: b.at[1] });
    const edges = corners.flatMap((a, i) => corners.slice(i + 1).filter((b) => sees(a, b)).map((b) => [...a.at, ...b.at]));
    const { nodes } = lab.scene(text, { method: 'dfs' }).account;
    return { columns, text, corners, edges, row: [columns, scene.insideCount, edges.length, pieces, nodes] };
}
