/** Questions of chapter 4: rows, margins and what they decide. */
import { room, rowsOf } from '../simplex.js';
import { choice, number } from './ask.js';
import { portalsOf } from './chance.js';
import { clearPortals, portalsPicture } from './lines.js';

function rows(chance) {
    const count = chance.whole(4, 30);
    return number(`A sequence has ${count} portals. How many rows has its linear program?`, 2 * count, 'Each portal has two ends, and each end gives a row.', 'Each end of a portal is a condition.');
}

/** A line with a slope that doubles hold exactly, through portals on a grid of a half. */
const lineOf = (chance) => ({ a: chance.whole(-2, 2) / 4, b: chance.whole(6, 18) / 2 });
const drawn = ({ a, b }) => [0, b, 18, 18 * a + b];

function nearest(chance) {
    const { portals, line, order } = chance.until(() => {
        const list = portalsOf(chance, 4), by = lineOf(chance), sorted = rowsOf(list).map((row) => ({ name: row.name, off: room(row, by) })).sort((p, q) => p.off - q.off);
        return sorted[1].off - sorted[0].off >= 0.5 ? { portals: list, line: by, order: sorted } : null;
    });
    const why = `Measured upright, ${order[0].name} has ${order[0].off} and ${order[1].name} has ${order[1].off}; below zero is the wrong side.`;
    return choice('Which end decides about the margin of this line?', order.slice(0, 4).map(({ name }) => [name, why]), 0, portalsPicture('Portals and a line', portals, drawn(line)));
}

function margin(chance) {
    const portals = portalsOf(chance, 3), line = lineOf(chance), offs = rowsOf(portals).map((row) => room(row, line)), least = Math.min(...offs);
    const list = portals.map(([x, l, , r], i) => `portal ${i + 1} at x = ${x} from y = ${r} (R) to y = ${l} (L)`).join(', ');
    return number(`What is the margin of the line y = ${line.a} x + ${line.b}? ${list[0].toUpperCase()}${list.slice(1)}.`, least,
        `The least of all ends is at ${rowsOf(portals)[offs.indexOf(least)].name}.`, 'Compute for each L its height less that of the line, for each R the height of the line less its own. Take the least.',
        portalsPicture('Three portals and a line', portals, drawn(line)));
}

function sign(chance, lab) {
    const isSeen = chance.next() < 0.5, portals = clearPortals(chance, lab, 4, isSeen ? 'stabbed' : 'hidden');
    const why = 'The margin is above zero if a line passes with room on both sides, and below zero if none passes.';
    return choice('Is the best margin of this sequence above zero, zero, or below zero?', [['Above zero.', why], ['Zero.', why], ['Below zero.', why]], isSeen ? 0 : 2, portalsPicture('Four portals', portals));
}

export const kinds = [rows, nearest, margin, sign];
