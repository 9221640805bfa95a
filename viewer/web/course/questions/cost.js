/** Questions of chapter 13: guarantees, and what methods find on one map. */
import { choice, number, planPicture } from './ask.js';
import { roomsOf } from './chance.js';

/** Ordered pairs of cells that a method finds. */
const pairsOf = (scene) => {
    const all = new Set();
    for (let a = 0; a < scene.cellCount; a++) for (const b of scene.row(a)) all.add(a * scene.cellCount + b);
    return all;
};

const planOf = (chance) => roomsOf(chance, chance.whole(4, 6), chance.whole(3, 5));
const pictureOf = (plan) => planPicture('Rooms', plan, {});

function added(chance, lab) {
    const { plan, exact, flood } = chance.until(() => {
        const rooms = planOf(chance), [right, more] = ['sweep', 'flood'].map((method) => pairsOf(lab.scene(rooms.text, { method })).size);
        return more > right ? { plan: rooms, exact: right, flood: more } : null;
    });
    return number(`On this map an exact method finds ${exact} pairs, and flood, which is conservative, finds ${flood}. How many pairs of flood do not see each other?`, flood - exact, `A conservative method misses nothing, so all ${exact} are among them.`,
        'Which pairs can a conservative method have that the exact one has not?', pictureOf(plan));
}

function missed(chance, lab) {
    const { plan, exact, lines } = chance.until(() => {
        const rooms = planOf(chance), right = pairsOf(lab.scene(rooms.text)).size, fewer = pairsOf(lab.scene(rooms.text, { method: 'sampling', samples: 10, seed: chance.whole(1, 1000) })).size;
        return fewer < right ? { plan: rooms, exact: right, lines: fewer } : null;
    });
    return number(`On this map an exact method finds ${exact} pairs. Random lines, which are aggressive, find ${lines}. How many pairs do they miss?`, exact - lines, 'An aggressive method adds nothing, so all that it finds is right.',
        'Which pairs can an aggressive method lack?', pictureOf(plan));
}

function promise(chance, lab) {
    const name = chance.of(['flood', 'sampling']), { plan, few, many } = chance.until(() => {
        const rooms = planOf(chance), right = pairsOf(lab.scene(rooms.text)), other = pairsOf(lab.scene(rooms.text, name === 'flood' ? { method: name } : { method: name, samples: 10, seed: 1 }));
        const less = [...right].filter((pair) => !other.has(pair)).length, more = [...other].filter((pair) => !right.has(pair)).length;
        return less + more ? { plan: rooms, few: less, many: more } : null;
    });
    const why = `It misses ${few} and adds ${many}.`;
    return choice(`Compared with an exact method, some method misses ${few} pairs and adds ${many} on this map. Which promise can it have?`,
        [['Conservative: it misses nothing.', why], ['Aggressive: it adds nothing.', why], ['Exact: neither.', why]], few ? 1 : 0, pictureOf(plan));
}

function ordered(chance) {
    const cells = chance.whole(5, 60), pairs = chance.whole(cells, (cells * (cells - 1)) / 2);
    return number(`Of ${cells} cells, ${pairs} pairs of two different cells see each other. How many pairs does "compare" count?`, 2 * pairs + cells, `Each pair counts both ways, and each of the ${cells} cells sees itself.`,
        'A sees B and B sees A are two, and a cell sees itself.');
}

export const kinds = [added, missed, promise, ordered];
