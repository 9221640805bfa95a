/** Questions of chapter 15: where the shortest way turns, and how long it is. */
import { drawPlan, strokeLines } from '../../parts/plan.js';
import { loadGround, wayBetween } from '../ground.js';
import { drawWalls, itemsOf } from '../maps.js';
import { pivotsOf } from '../rotate.js';
import { number, planPicture, surely, yesNo } from './ask.js';
import { hallOf, roomsOf } from './chance.js';

/** Two places whose way turns as often from each place near them. */
function wayIn(plan, chance) {
    return chance.until(() => {
        const [a, b] = [chance.place(plan.box), chance.place(plan.box)], turns = (from, to) => wayBetween(plan.text, from, to)?.way.length ?? 0;
        if (turns(a, b) < 3 || surely((near) => turns(near, b), a) === null || surely((near) => turns(a, near), b) === null) return null;
        return { a, b, way: wayBetween(plan.text, a, b).way };
    });
}

async function turns(chance) {
    await loadGround();
    const plan = roomsOf(chance, 4, 3, { missing: 0.1 }), { a, b, way } = wayIn(plan, chance);
    return number('How often does the shortest way from A to B turn?', way.length - 2, 'It turns at ends of walls only, and goes straight in between.', 'Pull a string tight from A to B. At which ends of walls does it bend?',
        planPicture('Rooms with two places, A and B', plan, { A: a, B: b }));
}

async function passes(chance, lab) {
    await loadGround();
    const plan = roomsOf(chance, 4, 3, { missing: 0.1 }), { a, b, way } = wayIn(plan, chance), isWanted = chance.next() < 0.5, inner = way.slice(1, -1);
    const others = pivotsOf(lab.scene(plan.text)).map(({ at }) => at).filter(([x, y]) => inner.every((p) => Math.hypot(p[0] - x, p[1] - y) > 1)), corner = chance.of(isWanted ? inner : others);
    return yesNo('Does the shortest way from A to B turn at X?', isWanted, 'A string that is pulled tight from A to B shows it.', planPicture('Rooms with two places, and the end of a wall', plan, { A: a, B: b, X: corner }));
}

const triples = [[3, 4, 5], [4, 3, 5], [6, 8, 10], [8, 6, 10]];

async function around(chance) {
    await loadGround();
    const [[dx, dy, one], [ex, ey, two]] = [chance.of(triples), chance.of(triples)], high = chance.whole(9, 11), text = `sightline 1\nwalls 0 0 20 0 20 12 0 12 0 0\nwall 10 0 10 ${high}\n`;
    const [a, b] = [[10 - dx, high - dy], [10 + ex, high - ey]], { length } = wayBetween(text, a, b);
    return number(`A wall goes from (10, 0) to (10, ${high}). How long is the shortest way from (${a.join(', ')}) to (${b.join(', ')})?`, Math.round(length),
        `It turns at the end of the wall: ${one} + ${two}.`, 'Compute the length from each place to the end of the wall, and add.', { title: 'A hall with one wall, and two places', box: [0, 0, 20, 12], draw(surface, camera, tones) {
            drawPlan(surface, camera, { items: itemsOf(text) }, tones);
            drawWalls(surface, camera, itemsOf(text), tones);
            strokeLines(surface, camera, [[...a, 10, high, ...b]], tones.sourceEdge, 2, [5, 4]);
        } });
}

function corners(chance, lab) {
    const plan = hallOf(chance, chance.whole(1, 6)), count = pivotsOf(lab.scene(plan.text)).length;
    return number('How many corners of this hall can a shortest way turn at?', count, 'At the corners of pillars the free angle is wider than half a turn. In the corners of the hall it is not.',
        'Which corners can hold a string that is pulled tight?', planPicture('A hall with pillars', plan, {}));
}

export const kinds = [turns, passes, around, corners];
