/** Maps of the course, as text. Their units are metres. */
import { fillPolygons, itemLine, strokeLines } from '../parts/plan.js';

/** A plan with an outer wall, and more lines of map text. */
const plan = (width, height, ...lines) => ({
    box: [0, 0, width, height],
    text: ['sightline 1', `walls 0 0 ${width} 0 ${width} ${height} 0 ${height} 0 0`, ...lines, ''].join('\n'),
});
const wall = (x0, y0, x1, y1) => `wall ${x0} ${y0} ${x1} ${y1}`;
const pillar = (x, y, side) => {
    const [x1, y1] = [x + side, y + side].map((v) => Number(v.toFixed(2)));
    return `solid ${x} ${y} ${x1} ${y} ${x1} ${y1} ${x} ${y1}`;
};

/** Three rooms on a corridor. */
export const flat = plan(20, 12, wall(0, 5, 4, 5), wall(6, 5, 11, 5), wall(13, 5, 20, 5), wall(8, 0, 8, 5),
    wall(0, 8, 7, 8), wall(9, 8, 20, 8), wall(13, 8, 13, 9.5), wall(13, 10.5, 13, 12));

/** A house whose rooms do not line up. */
export const house = plan(24, 14, wall(6, 0, 6, 5), wall(6, 7, 6, 14), wall(0, 8, 4, 8), wall(2, 3, 6, 3), wall(6, 5, 10, 5),
    wall(12, 5, 18, 5), wall(14, 0, 14, 3), wall(18, 5, 18, 9), wall(18, 11, 18, 14), wall(10, 9, 16, 9), wall(10, 9, 10, 12),
    wall(13, 11, 13, 14), wall(20, 5, 24, 5), wall(20, 9, 24, 9), wall(16, 7, 18, 7));

/** A hall with four pillars. */
export const pillars = plan(16, 12, pillar(4, 3, 1), pillar(11, 3, 1), pillar(4, 8, 1), pillar(11, 8, 1));

/** Three rooms in a row, with doors that line up. */
export const threeRooms = plan(12, 4, wall(4, 0, 4, 1), wall(4, 3, 4, 4), wall(8, 0, 8, 1), wall(8, 3, 8, 4));

/** A hall with rows of thin pillars that do not line up. */
export function hall(columns) {
    const lines = [];
    for (let i = 0; i < columns; i++)
        for (let j = 0; j < 4; j++)
            lines.push(pillar(...[4 * i + 1 + 0.37 * j, 3 * j + 1 + 0.29 * i].map((v) => Number(v.toFixed(2))), 0.4));
    return plan(4 * columns, 12, ...lines).text;
}

/** Rooms in a grid; the doors of neighbouring rooms do not line up. */
export function grid(columns, rows) {
    const lines = [];
    for (let i = 0; i < columns; i++)
        for (let j = 0; j < rows; j++) {
            const x = 4 * i, y = 4 * j, at = 0.5 + ((3 * i + 5 * j) % 4) * 0.5;
            if (j) lines.push(wall(x, y, x + at, y), wall(x + at + 1.5, y, x + 4, y));
            if (i) lines.push(wall(x, y, x, y + at), wall(x, y + at + 1.5, x, y + 4));
        }
    return plan(4 * columns, 4 * rows, ...lines).text;
}

/** A room with an outline of its own. @param {number[][]} corners counter-clockwise */
const outlined = (width, height, corners) => ({ box: [0, 0, width, height], text: `sightline 1\nwalls ${[...corners, corners[0]].flat().join(' ')}\n` });

/** A gallery with nooks. */
export const gallery = outlined(18, 12, [[0, 0], [7, 0], [7, 3], [10, 3], [10, 0], [18, 0], [18, 5], [13, 5], [13, 8], [18, 8], [18, 12], [9, 12], [8, 7], [5, 7], [4, 12], [0, 12]]);

/** A comb with four teeth (Chvátal): each tooth needs a guard of its own. */
export const comb = outlined(20, 10, [[0, 0], [20, 0], [18.5, 10], [16.5, 2], [14.5, 2], [13.5, 10], [11.5, 2], [9, 2], [8, 10], [6, 2], [4, 2], [1.5, 10]]);

/** Two legs on a common floor. */
export const uShape = outlined(12, 8, [[0, 0], [12, 0], [12, 8], [8, 8], [8, 3], [4, 3], [4, 8], [0, 8]]);

/** Rooms in a small grid. */
export const rooms = { text: grid(4, 3), box: [0, 0, 16, 12] };

/** Plans that figures offer for a choice. */
export const plans = {
    flat, house, pillars, hall: { text: hall(3), box: [0, 0, 12, 12] },
    'long hall': { text: hall(6), box: [0, 0, 24, 12] }, rooms: { text: grid(6, 5), box: [0, 0, 24, 20] },
};

/** The walls of a map of the course, as plan.js draws them. */
export const itemsOf = (text) => text.split('\n').flatMap((line) => {
    const [kind, ...points] = line.split(' ');
    return ['wall', 'walls', 'solid'].includes(kind) ? [{ kind, points: points.map(Number) }] : [];
});

/** Walls as single segments. @param {import('../formats/map-text.js').Item[]} list */
export const segmentsOf = (list) => list.map(itemLine).flatMap((line) =>
    Array.from({ length: line.length / 2 - 1 }, (_, i) => line.slice(2 * i, 2 * i + 4)));

/** A few letters in a plan, with their middle `right` and `down` pixels from a place. */
export function drawText(surface, camera, [x, y], text, tones, right = 0, down = 0) {
    const [px, py] = camera.toScreen(x, y);
    surface.fillStyle = tones.ink;
    surface.font = '600 13px system-ui, sans-serif';
    surface.textAlign = 'center';
    surface.textBaseline = 'middle';
    surface.fillText(text, px + right, py + down);
}

/** Walls over a picture that is drawn already. @param {import('../formats/map-text.js').Item[]} items */
export function drawWalls(surface, camera, items, tones) {
    fillPolygons(surface, camera, items.filter((item) => item.kind === 'solid').map((item) => item.points), tones.solid);
    strokeLines(surface, camera, items.map(itemLine), tones.wall, 2);
}
