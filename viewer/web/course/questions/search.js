/** Questions of chapter 5: what a cell sees, and the tree of its sequences. */
import { plural } from '../../formats/words.js';
import { middleOf } from '../lab.js';
import { insideOf, number, planPicture, yesNo } from './ask.js';
import { roomsOf } from './chance.js';

const planOf = (chance, lab, columns, rows) => {
    const plan = roomsOf(chance, columns, rows, { missing: 0.1 }), scene = () => lab.scene(plan.text);
    return { plan, scene, cell: chance.of(insideOf(scene())) };
};

function seen(chance, lab) {
    const { plan, scene, cell } = planOf(chance, lab, 3, 2), count = scene().row(cell).length;
    return number('How many cells does the orange cell see, itself included? Dashed lines are portals.', count, `From some place in it, ${plural(count, 'cell')} can be seen.`,
        'Look for lines from any place of the cell, not from its middle alone.', planPicture('Rooms, one of them orange', plan, {}, { scene, from: cell }));
}

function pair(chance, lab) {
    const { plan, scene } = planOf(chance, lab, 4, 3), cells = insideOf(scene()), isWanted = chance.next() < 0.5;
    const [a, b] = chance.until(() => {
        const [p, q] = [chance.of(cells), chance.of(cells)], near = scene().cell(p).portals.some((portal) => portal.cell === q);
        if (p === q || near || scene().canSee(p, q) !== isWanted) return null;
        return scene().explain(p, q).verdict === 'grazing' ? null : [p, q];
    });
    return yesNo('Does some place in the cell of A see some place in the cell of B?', isWanted, 'They see each other if one line passes all portals of some sequence between them.',
        planPicture('Rooms, two of them marked', plan, { A: middleOf(scene(), a), B: middleOf(scene(), b) }, { scene, from: a, to: b }));
}

function tree(chance, lab) {
    const { plan, scene, cell } = planOf(chance, lab, 3, 2), { nodes } = scene().stabTree(cell);
    return number('How many nodes has the stab tree of the orange cell? Its root counts.', nodes.length, `It has a node for each sequence that a line passes: ${nodes.length} with the empty one.`,
        'Follow each portal from the orange cell, and go on while one line passes all portals so far.', planPicture('Rooms, one of them orange', plan, {}, { scene, from: cell }));
}

function longest(chance, lab) {
    const { plan, scene, cell } = planOf(chance, lab, 4, 2), depth = Math.max(...scene().stabTree(cell).nodes.map((node) => node.depth));
    return number('How many portals can one line of sight pass that begins in the orange cell?', depth, `The longest branch of its stab tree has ${plural(depth, 'portal')}.`,
        'Try lines along the rooms, and lines that cross them at an angle.', planPicture('Rooms, one of them orange', plan, {}, { scene, from: cell }));
}

export const kinds = [seen, pair, tree, longest];
