/**
 * Lab four, for code-lab.js: the shortest way through a row of rooms, by the funnel of ways.
 *
 * Doors have ends at whole numbers, so that corners often lie in one line. Every other case is turned.
 */
import { drawDot, drawPlan, strokeLines } from '../parts/plan.js';
import { chances } from './code-lab.js';
import { loadGround, roomsInARow, wayBetween } from './ground.js';
import { drawWalls, itemsOf } from './maps.js';
import { picture } from './still.js';
import { lengthOf } from './string-pull.js';
import { turnPlace, turnedPlan } from './turned.js';

const [CASES, APART, HIGH] = [60, 3, 12];

/** Two lengths are the same if they differ by no more than rounding: this share of them. */
const SAME = 1e-9;

function caseOf(chance, isTurned) {
    const whole = (most) => Math.floor((most + 1) * chance()), count = 2 + whole(6), last = APART * (count + 1);
    const doors = Array.from({ length: count }, (_, i) => {
        const y = 1 + whole(HIGH - 3), height = 1 + whole(HIGH - 2 - y);
        return [APART * (i + 1), y + height, APART * (i + 1), y];
    });
    const plan = { text: roomsInARow(doors, [0, last]), box: [0, 0, last, HIGH] }, turn = isTurned ? turnPlace : (place) => place;
    const [from, to] = [[1, 1 + whole(HIGH - 2)], [last - 1, 1 + whole(HIGH - 2)]].map(turn);
    const portals = doors.map(([lx, ly, rx, ry]) => ({ left: turn([lx, ly]), right: turn([rx, ry]) }));
    return { ...(isTurned ? turnedPlan(plan) : { ...plan, items: itemsOf(plan.text) }), from, to, portals, given: [from, to, portals], about: `${count} doors` };
}

const drawing = ({ box, items, from, to }, given = [], way = []) => (tones) => picture('Rooms on which the function fails', box, (surface, camera) => {
    drawPlan(surface, camera, {}, tones);
    drawWalls(surface, camera, items, tones);
    strokeLines(surface, camera, way.length ? [way.flat()] : [], tones.sourceEdge, 3);
    strokeLines(surface, camera, given.length ? [given.flat()] : [], tones.to, 3, [6, 4]);
    for (const [place, tone] of [[from, tones.from], [to, tones.to]]) drawDot(surface, camera, place, 6, tone, tones.page);
}, { width: 420, most: 300 });

/** Two numbers with as many digits as tell them apart, three or more. */
function apart(a, b) {
    let digits = 3;
    while (a.toFixed(digits) === b.toFixed(digits) && a !== b) digits++;
    return [a, b].map((v) => v.toFixed(digits));
}

const isPlace = (p) => Array.isArray(p) && p.length === 2 && p.every(Number.isFinite);

/** @type {import('./code-lab.js').CodeLab} */
export const pullLab = {
    call: 'shortest',
    gives: 'list of two or more places [x, y]',
    cases: () => Array.from({ length: CASES }, ((chance) => (_, i) => caseOf(chance, i % 2 === 1))(chances(23))),
    isAnswer: (value) => Array.isArray(value) && value.length > 1 && value.every(isPlace),
    draw: (one) => drawing(one),
    async judge(_, one, given) {
        await loadGround();
        const { length, way } = wayBetween(one.text, one.from, one.to), mine = lengthOf(given), differs = (a, b) => a[0] !== b[0] || a[1] !== b[1];
        const [first, last] = [given[0], given.at(-1)], fault = differs(first, one.from) || differs(last, one.to) ? 'does not lead from the first place to the last one'
            : mine < length * (1 - SAME) ? 'is shorter, so it passes a wall' : mine > length * (1 + SAME) ? 'is longer' : '';
        if (!fault) return null;
        const [least, yours] = apart(length, mine);
        return { text: `the shortest way is ${least} long. Yours has ${yours}, dashed, and ${fault}.`, draw: drawing(one, given, way) };
    },
    right: (count) => `It finds ways as short as the library's through all ${count} rows of rooms.`,
};
