/**
 * Lab three, for code-lab.js: how many portals of a sequence one line passes, by the funnel.
 *
 * Portals stand in a row, each a little aslant, with ends at whole numbers, so that many lines only touch. Every other
 * sequence is turned. They stand so far apart that a line meets them in their order. In the last sequences ends lie up to
 * a HAIR above or below whole numbers, so some lines just pass, and some just do not.
 */
import { drawDot, drawPlan, strokeLines } from '../parts/plan.js';
import { HAIR, chances } from './code-lab.js';
import { planLine } from './lab.js';
import { nameOf } from './lines.js';
import { drawText } from './maps.js';
import { picture } from './still.js';
import { turnPlace } from './turned.js';

const [CASES, NEAR_CASES, APART, HIGH] = [100, 60, 7, 6];

/** A line turns about an end, meets a second one while it only touches a third, and is cut there later: left and right ends. */
const RARE = [[0, 2, 1, 0], [8, 2, 8, 1], [15, 4, 14, 2], [21, 5, 21, 3], [28, 4, 28, 2], [36, 6, 35, 5], [43, 6, 42, 5]];

const flatOf = (portals) => portals.map(({ left, right }) => [...left, ...right]);

/** @param {(place: number[]) => number[]} move @returns {{left: number[], right: number[]}[]} */
function portalsOf(chance, move) {
    const whole = (most) => Math.floor((most + 1) * chance());
    return Array.from({ length: 2 + whole(8) }, (_, i) => {
        const y = whole(HIGH - 1), height = 1 + whole(HIGH - 1 - y);
        return { left: move([APART * i + whole(1), y + height]), right: move([APART * i + whole(1), y]) };
    });
}

function cases() {
    const chance = chances(17), rare = RARE.map(([lx, ly, rx, ry]) => ({ left: [lx, ly], right: [rx, ry] }));
    const stay = (place) => place, shift = ([x, y]) => [x, y + HAIR * (Math.floor(3 * chance()) - 1)];
    const whole = Array.from({ length: CASES }, (_, i) => portalsOf(chance, i % 2 ? turnPlace : stay)), near = Array.from({ length: NEAR_CASES }, () => portalsOf(chance, shift));
    return [...whole, rare, ...near].map((portals) => {
        const ends = flatOf(portals).flatMap(([a, b, c, d]) => [[a, b], [c, d]]);
        const range = (axis, pick) => pick(...ends.map((end) => end[axis]));
        const box = [range(0, Math.min) - 2, range(1, Math.min) - 2, range(0, Math.max) + 2, range(1, Math.max) + 2];
        return { portals, box, given: [portals], about: `${portals.length} portals` };
    });
}

const drawing = ({ portals, box }, line = null, bad = []) => (tones) => picture('Portals on which the function fails', box, (surface, camera) => {
    drawPlan(surface, camera, {}, tones);
    strokeLines(surface, camera, flatOf(portals), tones.portal, 3);
    if (line) strokeLines(surface, camera, [line], tones.sourceEdge, 2);
    for (const [portal, ends] of portals.entries())
        for (const [side, place, tone] of [['left', ends.left, tones.left], ['right', ends.right, tones.right]]) {
            const isBad = bad.some((end) => end.portal === portal && end.side === side);
            drawDot(surface, camera, place, isBad ? 7 : 4, tone, isBad ? tones.ink : tones.page);
            drawText(surface, camera, place, nameOf({ side: side === 'left' ? 'L' : 'R', portal }), tones, side === 'left' ? -14 : 14);
        }
}, { width: 420, most: 300 });

/** @type {import('./code-lab.js').CodeLab} */
export const funnelLab = {
    call: 'funnel',
    gives: 'whole number',
    cases,
    isAnswer: Number.isInteger,
    draw: (one) => drawing(one),
    judge({ core }, one, value) {
        const flat = flatOf(one.portals), verdicts = flat.map((_, i) => core.conflict(flat.slice(0, i + 1)));
        const first = verdicts.findIndex(({ verdict }) => verdict === 'hidden'), passed = first < 0 ? flat.length : first;
        if (value === passed) return null;
        const dual = core.dual(flat.slice(0, passed)), next = first < 0 ? '' : ' The large ends keep lines from the next one.';
        const touch = verdicts[passed - 1].verdict === 'grazing' ? ', and only touches ends' : '';
        return { text: `a line passes ${passed} of the ${flat.length} portals${touch}.${next} Your function says ${value}.`,
            draw: drawing(one, planLine(dual, dual.best), verdicts[first]?.ends) };
    },
    right: (count) => `It gives the library's answer for all ${count} sequences. For many of them the last line only touches, or misses by less than a billionth of a millimetre.`,
};
