/** Questions of chapter 8: corners, what a rotation joins, and how work grows. */
import { drawDot, strokeLines } from '../../parts/plan.js';
import { middleOf, within } from '../lab.js';
import { drawText } from '../maps.js';
import { pivotsOf, rotate } from '../rotate.js';
import { number, planPicture } from './ask.js';
import { hallOf, roomsOf } from './chance.js';

function corners(chance, lab) {
    const plan = hallOf(chance, chance.whole(2, 6)), count = pivotsOf(lab.scene(plan.text)).length;
    return number('How many corners of this hall must the line rotate about?', count, 'Each corner of a pillar leaves free space over more than half a turn. Corners of the hall do not.',
        'A line must be able to touch the corner and go on at both sides of it.', planPicture('A hall with pillars', plan, {}));
}

function joined(chance, lab) {
    const { plan, scene, corner, stretch, angle } = chance.until(() => {
        const rooms = roomsOf(chance, 3, 2), open = lab.scene(rooms.text, { sight: 'open' }), pivot = chance.of(pivotsOf(open)), turn = chance.of(rotate(open, pivot));
        const isWide = turn.to - turn.from > 0.1, pairs = turn.before.length * turn.behind.length;
        return isWide && pairs > 1 && pairs < 13 ? { plan: rooms, scene: () => lab.scene(rooms.text, { sight: 'open' }), corner: pivot.at, stretch: turn, angle: (turn.from + turn.to) / 2 } : null;
    });
    const { before, behind } = stretch, [x, y] = corner, [dx, dy] = [60 * Math.cos(angle), 60 * Math.sin(angle)];
    const line = within(scene(), [x - dx, y - dy, x + dx, y + dy], [before.at(-1), behind.at(-1)]);
    return number('The line touches a corner, which is marked. How many pairs of cells does it join: one cell before the corner, one behind it?', before.length * behind.length,
        `Cells ${before.join(', ')} lie on one side of the corner, cells ${behind.join(', ')} on the other.`, 'Count cells that the line crosses on each side of the corner, and multiply.',
        planPicture('Rooms, and a line that touches a corner', plan, {}, { scene, more(surface, camera, tones) {
            strokeLines(surface, camera, [line], tones.sourceEdge, 2.5);
            for (const cell of [...before, ...behind]) drawText(surface, camera, middleOf(scene(), cell), String(cell), tones);
            drawDot(surface, camera, corner, 6, tones.start, tones.page);
        } }));
}

function classes(chance) {
    const posts = chance.whole(3, 20);
    return number(`${posts} posts stand in a room, no three in line. In how many classes, at most, do lines fall that pass each post on one side?`, 1 + posts + (posts * (posts - 1)) / 2,
        `${posts} straight lines cut a plane into at most 1 + k + k (k - 1) / 2 pieces.`, 'In the dual plane each post is a straight line. Count the pieces that they make.');
}

function operations(chance) {
    const [before, behind] = [chance.whole(3, 12), chance.whole(3, 12)];
    return number(`${before} cells lie before a corner and ${behind} behind it. A new cell comes into sight before it. How many pairs are joined at this event?`, behind,
        'The new cell is joined with each cell of the other half. All other pairs are known.', 'Which cells can the new one be joined with about this corner?');
}

export const kinds = [corners, joined, classes, operations];
