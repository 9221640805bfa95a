/** Questions of chapter 12: doors, a range, mirrors. */
import { drawPlan, strokeLines } from '../../parts/plan.js';
import { at, number, planPicture, surely, yesNo } from './ask.js';
import { roomsOf } from './chance.js';

function states(chance) {
    const doors = chance.whole(3, 12);
    return number(`A map has ${doors} doors. In how many states can they be together?`, 2 ** doors, `Each door is open or shut: 2^${doors}.`, 'Each further door doubles the number.');
}

function through(chance, lab) {
    const isWanted = chance.next() < 0.5, { plan, a, b, shut } = chance.until(() => {
        const rooms = roomsOf(chance, 3, 2, { doors: true, missing: 0 }), scene = lab.scene(rooms.text), [p, q] = [chance.place(rooms.box), chance.place(rooms.box)];
        if (Math.hypot(p[0] - q[0], p[1] - q[1]) < 4 || surely((near) => scene.canSee(at(near), at(q)), p) !== true) return null;
        const closed = rooms.doors.filter(() => chance.next() < 0.3);
        if (!closed.length) return null;
        for (const name of closed) scene.setDoor(name, false);
        const sees = surely((near) => scene.canSee(at(near), at(q)), p);
        for (const name of closed) scene.setDoor(name, true);
        return sees === isWanted ? { plan: rooms, a: p, b: q, shut: closed } : null;
    });
    const barriers = plan.text.split('\n').filter((line) => line.startsWith('door')).map((line) => line.split(' ')).filter(([, name]) => shut.includes(name)).map(([, , ...ends]) => ends.slice(0, 4).map(Number));
    return yesNo('Doors that are shut are drawn as lines across their openings. Does A see B?', isWanted, 'Draw the segment. It must pass neither a wall nor a door that is shut.',
        planPicture('Rooms with doors, some of them shut', plan, { A: a, B: b }, { more: (surface, camera, tones) => strokeLines(surface, camera, barriers, tones.door, 4) }));
}

function range(chance, lab) {
    const text = 'sightline 1\nwalls 0 0 40 0 40 30 0 30 0 0\n', [dx, dy, far] = chance.of([[3, 4, 5], [6, 8, 10], [5, 12, 13], [8, 15, 17], [9, 12, 15]]), limit = far + chance.of([-2, -1, 1, 2]);
    const a = [chance.whole(1, 20), chance.whole(1, 12)], b = [a[0] + dx, a[1] + dy], sees = lab.scene(text).canSee(at(a), at(b), { range: limit });
    return yesNo(`An empty hall has a view range of ${limit}. Does an eye at (${a.join(', ')}) see a place at (${b.join(', ')})?`, sees, `They are ${far} apart: the root of ${dx}² + ${dy}².`);
}

function image(chance) {
    const mirror = chance.whole(8, 14), eye = [chance.whole(1, 6), chance.whole(1, 10)];
    return number(`A mirror lies along x = ${mirror}. An eye stands at (${eye.join(', ')}). At which x does its image stand?`, 2 * mirror - eye[0], `The image is as far behind the mirror as the eye is before it: ${mirror} + ${mirror - eye[0]}.`,
        'Measure from the eye to the mirror, and go as far again.', { title: 'An eye and a mirror', box: [0, 0, 18, 12], draw(surface, camera, tones) {
            drawPlan(surface, camera, { items: [{ kind: 'mirror', points: [mirror, 1, mirror, 11] }] }, tones);
            strokeLines(surface, camera, [[...eye, mirror, eye[1]]], tones.sourceEdge, 2, [5, 4]);
        } });
}

export const kinds = [states, through, range, image];
