/** Questions of chapter 11: tests in a tree, and view cells that are merged. */
import { plural } from '../../formats/words.js';
import { fillPolygons, strokeLines } from '../../parts/plan.js';
import { middleOf } from '../lab.js';
import { insideOf, number, planPicture } from './ask.js';
import { roomsOf } from './chance.js';

/** Tests from a node down whose leaves are seen or not: it ends where all leaves are alike. @param {boolean[]} leaves */
const testsOf = (leaves) => (leaves.every((leaf) => leaf === leaves[0]) ? 1 : 1 + testsOf(leaves.slice(0, leaves.length / 2)) + testsOf(leaves.slice(leaves.length / 2)));

/** A binary tree above a row of leaves; those that are seen are blue. */
const treePicture = (leaves) => ({ title: 'A binary tree above a row of leaves', box: [0, 0, 16, 10], draw(surface, camera, tones) {
    const step = 16 / leaves.length, levels = Math.log2(leaves.length), x = (level, i) => ((i + 0.5) * 16) / 2 ** level, y = (level) => 9.5 - (8 * level) / levels, lines = [];
    for (let level = 0; level < levels; level++) for (let i = 0; i < 2 ** level; i++) for (const child of [2 * i, 2 * i + 1]) lines.push([x(level, i), y(level), x(level + 1, child), y(level + 1)]);
    strokeLines(surface, camera, lines, tones.wall, 2);
    leaves.forEach((isSeen, i) => fillPolygons(surface, camera, [[i * step + 0.15, 0, (i + 1) * step - 0.15, 0, (i + 1) * step - 0.15, 1.5, i * step + 0.15, 1.5]], isSeen ? tones.seen[0] : tones.solid));
} });

/** Leaves in runs, as neighbours often are alike. */
const leavesOf = (chance, count) => chance.until(() => {
    let now = chance.next() < 0.5;
    const leaves = Array.from({ length: count }, () => (chance.next() < 0.35 ? (now = !now) : now));
    return leaves.includes(true) && leaves.includes(false) ? leaves : null;
});

function tests(chance) {
    const leaves = leavesOf(chance, chance.of([8, 16])), count = testsOf(leaves);
    return number('Blue leaves are visible, the others hidden. How many nodes are tested, from the root down? A node whose leaves are all alike ends the way down.', count, 'The nodes above mixed leaves are tested, and their children.',
        'Begin with the root. Where leaves below are not all alike, test both children.', treePicture(leaves));
}

function saved(chance) {
    const leaves = leavesOf(chance, 8), count = testsOf(leaves), ends = (count + 1) / 2;
    return number('Nothing changes from this frame to the next one. How many tests does hierarchy updating take in the next frame?', ends, `It tests the ${ends} ends, and none of the ${plural(count - ends, 'node')} above.`,
        'It begins where the tests of this frame ended. Find these nodes.', treePicture(leaves));
}

function cost(chance) {
    const shares = chance.of([[50, 30, 20], [40, 40, 20], [60, 30, 10], [25, 25, 50]]), sizes = shares.map(() => 10 * chance.whole(1, 12)), value = shares.reduce((sum, share, i) => sum + (share * sizes[i]) / 100, 0);
    return number(`Three view cells have ${shares.join(' %, ')} % of the floor, and see ${sizes.join(', ')} things. What is the expected cost?`, value, `${shares.map((share, i) => `${share / 100} * ${sizes[i]}`).join(' + ')} = ${value}.`,
        'Multiply each share by what this view cell sees, and add.');
}

function merged(chance, lab) {
    const plan = roomsOf(chance, 3, 2, { missing: 0.1 }), scene = () => lab.scene(plan.text), cells = insideOf(scene()), a = chance.of(cells), b = chance.of(cells.filter((cell) => cell !== a));
    const [first, second] = [a, b].map((cell) => new Set(scene().row(cell))), both = [...first].filter((cell) => second.has(cell)).length, all = first.size + second.size - both;
    return number(`Cell A sees ${plural(first.size, 'cell')}, cell B ${plural(second.size, 'cell')}, and ${both === 1 ? '1 cell is' : `${both} cells are`} seen by both. How many does the view cell see that they make when merged?`, all,
        'It sees what A or B sees; what both see counts once.', 'What both see must not be counted twice.', planPicture('Rooms, two of them marked', plan, { A: middleOf(scene(), a), B: middleOf(scene(), b) }, { scene, from: a, to: b }));
}

export const kinds = [tests, saved, cost, merged];
