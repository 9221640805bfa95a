/** Plans whose places are moved: turned, or made larger. */
import { itemsOf, segmentsOf } from './maps.js';

/** By an angle with sine 4/5 and cosine 3/5, and five times as large: whole numbers stay whole. */
export const turnPlace = ([x, y]) => [3 * x - 4 * y, 4 * x + 3 * y];

/** A map of walls whose places are moved. @param {{text: string, box: number[]}} plan */
function movedPlan({ text: given, box: [x0, y0, x1, y1] }, move) {
    const moveList = (points) => Array.from({ length: points.length / 2 }, (_, i) => move([points[2 * i], points[2 * i + 1]])).flat();
    const text = given.split('\n').map((line) => {
        const [kind, ...points] = line.split(' ');
        return ['wall', 'walls', 'solid'].includes(kind) ? [kind, ...moveList(points.map(Number))].join(' ') : line;
    }).join('\n');
    const corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(move), items = itemsOf(text);
    const range = (axis) => corners.map((corner) => corner[axis]);
    return { text, box: [Math.min(...range(0)), Math.min(...range(1)), Math.max(...range(0)), Math.max(...range(1))], items, walls: segmentsOf(items) };
}

export const turnedPlan = (plan) => movedPlan(plan, turnPlace);

export const largerPlan = (plan, times) => movedPlan(plan, (place) => place.map((v) => times * v));
