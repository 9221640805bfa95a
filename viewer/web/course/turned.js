/** Plans turned by an angle with sine 4/5 and cosine 3/5, and five times as large: whole numbers stay whole. */
import { itemsOf, segmentsOf } from './maps.js';

export const turnPlace = ([x, y]) => [3 * x - 4 * y, 4 * x + 3 * y];

const turnList = (points) => Array.from({ length: points.length / 2 }, (_, i) => turnPlace([points[2 * i], points[2 * i + 1]])).flat();

/** A map of walls, turned. @param {{text: string, box: number[]}} plan */
export function turnedPlan({ text: straight, box: [x0, y0, x1, y1] }) {
    const text = straight.split('\n').map((line) => {
        const [kind, ...points] = line.split(' ');
        return ['wall', 'walls', 'solid'].includes(kind) ? [kind, ...turnList(points.map(Number))].join(' ') : line;
    }).join('\n');
    const corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(turnPlace), items = itemsOf(text);
    const range = (axis) => corners.map((corner) => corner[axis]);
    return { text, box: [Math.min(...range(0)), Math.min(...range(1)), Math.max(...range(0)), Math.max(...range(1))], items, walls: segmentsOf(items) };
}
