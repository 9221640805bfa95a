/** Maps of the course, as text. Their units are metres. */
import { fillPolygons, itemLine, strokeLines } from '../parts/plan.js';

/** Three rooms on a corridor. */
export const flat = {
    box: [0, 0, 20, 12],
    text: `sightline 1
walls 0 0 20 0 20 12 0 12 0 0
wall 0 5 4 5
wall 6 5 11 5
wall 13 5 20 5
wall 8 0 8 5
wall 0 8 7 8
wall 9 8 20 8
wall 13 8 13 9.5
wall 13 10.5 13 12
`,
};

/** A house whose rooms do not line up. */
export const house = {
    box: [0, 0, 24, 14],
    text: `sightline 1
walls 0 0 24 0 24 14 0 14 0 0
wall 6 0 6 5
wall 6 7 6 14
wall 0 8 4 8
wall 2 3 6 3
wall 6 5 10 5
wall 12 5 18 5
wall 14 0 14 3
wall 18 5 18 9
wall 18 11 18 14
wall 10 9 16 9
wall 10 9 10 12
wall 13 11 13 14
wall 20 5 24 5
wall 20 9 24 9
wall 16 7 18 7
`,
};

/** A hall with four pillars. */
export const pillars = {
    box: [0, 0, 16, 12],
    text: `sightline 1
walls 0 0 16 0 16 12 0 12 0 0
solid 4 3 5 3 5 4 4 4
solid 11 3 12 3 12 4 11 4
solid 4 8 5 8 5 9 4 9
solid 11 8 12 8 12 9 11 9
`,
};

/** A hall with rows of thin pillars that do not line up. */
export function hall(columns) {
    let text = `sightline 1\nwalls 0 0 ${4 * columns} 0 ${4 * columns} 12 0 12 0 0\n`;
    for (let i = 0; i < columns; i++)
        for (let j = 0; j < 4; j++) {
            const [x0, y0] = [4 * i + 1 + 0.37 * j, 3 * j + 1 + 0.29 * i].map((v) => Number(v.toFixed(2)));
            const [x1, y1] = [x0 + 0.4, y0 + 0.4].map((v) => Number(v.toFixed(2)));
            text += `solid ${x0} ${y0} ${x1} ${y0} ${x1} ${y1} ${x0} ${y1}\n`;
        }
    return text;
}

/** Rooms in a grid; the doors of neighbouring rooms do not line up. */
export function grid(columns, rows) {
    let text = `sightline 1\nwalls 0 0 ${4 * columns} 0 ${4 * columns} ${4 * rows} 0 ${4 * rows} 0 0\n`;
    for (let i = 0; i < columns; i++)
        for (let j = 0; j < rows; j++) {
            const x = 4 * i, y = 4 * j, at = 0.5 + ((3 * i + 5 * j) % 4) * 0.5;
            if (j) text += `wall ${x} ${y} ${x + at} ${y}\nwall ${x + at + 1.5} ${y} ${x + 4} ${y}\n`;
            if (i) text += `wall ${x} ${y} ${x} ${y + at}\nwall ${x} ${y + at + 1.5} ${x} ${y + 4}\n`;
        }
    return text;
}

/** The walls of a map of the course, as plan.js draws them. */
export const itemsOf = (text) => text.split('\n').flatMap((line) => {
    const [kind, ...points] = line.split(' ');
    return ['wall', 'walls', 'solid'].includes(kind) ? [{ kind, points: points.map(Number) }] : [];
});

/** Walls over a picture that is drawn already. @param {import('../formats/map-text.js').Item[]} items */
export function drawWalls(surface, camera, items, tones) {
    fillPolygons(surface, camera, items.filter((item) => item.kind === 'solid').map((item) => item.points), tones.solid);
    strokeLines(surface, camera, items.map(itemLine), tones.wall, 2);
}
