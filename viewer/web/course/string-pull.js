/**
 * The shortest way through a sequence of portals (Chazelle 1982; Lee and Preparata 1984): the funnel of ways.
 *
 * From the apex, the last corner where the way surely turns, two strings lead to the ends of the portal that was reached. Each
 * is the shortest way there, and each bends outwards: the left one turns left only. A new end is joined to its string.
 * Corners at which the string would turn the wrong way go. If the whole string goes, and the end lies across the other
 * string, the apex moves along that one. Each corner comes once and goes once, so n portals take about n steps.
 */
import { side } from './angular.js';

/** Joins an end to its own string; `turn` is 1 for the left string and -1 for the right one. Corners that the apex passes go to `way`. */
function join(own, other, end, turn, way) {
    while (own.length > 1 && turn * side(own.at(-2), own.at(-1), end) <= 0) own.pop();
    while (own.length === 1 && other.length > 1 && turn * side(other[0], other[1], end) < 0) {
        way.push(other.shift());
        own[0] = other[0];
    }
    own.push(end);
}

/**
 * @param {number[]} from @param {number[]} to @param {{left: number[], right: number[]}[]} portals as they are crossed
 * @returns {{way: number[][], left: number[][], right: number[][]}[]} a step for each portal, and one for the end, whose left
 *   string is the last part of the way
 */
export function pullString(from, to, portals) {
    const way = [], left = [from], right = [from];
    return [...portals, { left: to, right: to }].map((portal) => {
        join(left, right, portal.left, 1, way);
        join(right, left, portal.right, -1, way);
        return { way: [...way], left: [...left], right: [...right] };
    });
}

/** The way of the last step. */
export const wayOf = ({ way, left }) => [...way, ...left];

export const lengthOf = (way) => way.slice(1).reduce((sum, [x, y], i) => sum + Math.hypot(x - way[i][0], y - way[i][1]), 0);
