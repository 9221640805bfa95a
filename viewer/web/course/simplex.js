/**
 * A small simplex method: the best line through portals that are crossed from left to right.
 *
 * Unknown are slope a, height b and margin m of a line y = a x + b. Each end of a portal gives a row:
 * s (y - a x - b) >= m, with s = 1 for a left end and s = -1 for a right end. The largest m is wanted.
 *
 * A basis is three rows that hold with equality, so they give a, b and m. Weights w >= 0 of its rows add up
 * their left sides to m alone; so no line does better on these three. Each step takes the row that is
 * violated most, and drops the one that keeps all weights at 0 or above (the dual simplex method; Stiefel
 * 1959 calls it exchange). The margin never rises. If no row is violated, the line is the best one.
 *
 * It computes with rounded numbers, and stops at SLACK: it is for figures, and decides nothing. Cost: a step
 * looks at each row once. A list of rows may get longer between calls: the old basis is a good start.
 */
const SLACK = 1e-9;

/** @typedef {{name: string, portal: number, side: string, x: number, y: number, s: number}} Row */

/** @param {number[][]} portals left x, left y, right x, right y @returns {Row[]} */
export const rowsOf = (portals) => portals.flatMap(([lx, ly, rx, ry], portal) => [
    { name: `L${portal + 1}`, portal, side: 'L', x: lx, y: ly, s: 1 },
    { name: `R${portal + 1}`, portal, side: 'R', x: rx, y: ry, s: -1 }]);

/** What a row has to spare at a line without a margin. */
export const room = ({ x, y, s }, { a, b }) => s * (y - a * x - b);

const determinant = ([a, b, c], [d, e, f], [g, h, i]) => a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);

/** v with v[0] p + v[1] q + v[2] r = t, by Cramer's rule. */
function solve([p, q, r], t) {
    const all = determinant(p, q, r);
    return [determinant(t, q, r) / all, determinant(p, t, r) / all, determinant(p, q, t) / all];
}

const gradient = ({ x, s }) => [s * x, s, 1];

/** The line and the weights of a basis. @param {Row[]} rows @param {number[]} basis */
function lineOf(rows, basis) {
    const three = basis.map((i) => rows[i]), columns = [0, 1, 2].map((k) => three.map((row) => gradient(row)[k]));
    const [a, b, m] = solve(columns, three.map(({ s, y }) => s * y));
    return { basis, a, b, m, weights: solve(three.map(gradient), [0, 0, 1]) };
}

/**
 * All steps to the best line. Each has its basis, line, weights, and the rows that come and go next (-1: none).
 * @param {Row[]} rows of two portals or more @param {number[]} [start] the basis of fewer rows
 */
export function simplex(rows, start = [0, 1, 2]) {
    const steps = [];
    for (let basis = start; steps.length < 4 * rows.length;) {
        const step = { ...lineOf(rows, basis), comes: -1, goes: -1 };
        steps.push(step);
        const spare = rows.map((row) => room(row, step) - step.m), least = Math.min(...spare);
        if (least >= -SLACK) break;
        step.comes = spare.indexOf(least);
        const part = solve(basis.map((i) => gradient(rows[i])), gradient(rows[step.comes]));
        const ratio = part.map((v, k) => (v > SLACK ? step.weights[k] / v : Infinity));
        const out = ratio.indexOf(Math.min(...ratio));
        step.goes = basis[out];
        basis = basis.map((row, k) => (k === out ? step.comes : row));
    }
    return steps;
}
