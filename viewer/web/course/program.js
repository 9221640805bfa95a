/** Chapter 4: the linear program of a portal sequence: rows, margin, basis, steps. */
import { drawDot, strokeLines } from '../parts/plan.js';
import { element } from './figure.js';
import { funnelLab } from './funnel-lab.js';
import { funnelCode } from './lab-code.js';
import { box, drawPortals, given, heldPortals, long } from './lines.js';
import { room, rowsOf, simplex } from './simplex.js';

const metres = (v) => (Math.abs(v) < 5e-4 ? '0.00' : v.toFixed(2));

/** A table in fixed type; lines that begin with * are marked. */
function table(lines) {
    return element('pre', { tabIndex: 0, role: 'group', 'aria-label': 'Table' }, ...lines.flatMap((line) => [line.startsWith('*') ? element('b', {}, ` ${line.slice(1)}`) : line, '\n']));
}

const segment = ({ a, b }) => long([0, b], [18, 18 * a + b]);

/** The strip of a margin, upright, about a line. */
const strip = ({ a, b, m }) => [-m, m].map((off) => segment({ a, b: b + off }));

const byHand = {
    title: 'The margin of a line.',
    about: 'The two dots hold the line. The table has a row for each end: how far it is from the line, upright, and below zero on the wrong side. The least one is marked.',
    box,
    handles: [{ name: 'a', at: [1, 8], tone: 'from' }, { name: 'b', at: [17, 3], tone: 'from' }],
    update(state) {
        const [p, q] = state.a[0] <= state.b[0] ? [state.a, state.b] : [state.b, state.a];
        const a = (q[1] - p[1]) / Math.max(0.05, q[0] - p[0]);
        state.line = { a, b: p[1] - a * p[0] };
        state.rows = rowsOf(given);
        state.rooms = state.rows.map((row) => room(row, state.line));
        state.least = Math.min(...state.rooms);
        state.worst = state.rows[state.rooms.indexOf(state.least)];
        state.best = simplex(state.rows).at(-1).m;
    },
    draw(surface, camera, tones, state) {
        drawPortals(surface, camera, tones, given, [state.worst]);
        strokeLines(surface, camera, [segment(state.line)], state.least < 0 ? tones.faint : tones.sourceEdge, 2.5);
    },
    beside: (state) => table(['  end   distance', ...state.rows.map((row, i) =>
        `${row === state.worst ? '*' : '  '}${row.name}  ${metres(state.rooms[i]).padStart(9)} m`)]),
    tell: (state) => `The margin of this line is ${metres(state.least)} m, at ${state.worst.name}. The best line has ${metres(state.best)} m. ` +
        (state.least < 0 ? 'So this line is blocked.' : state.best - state.least < 0.05 ? 'That is as good as it gets.' : 'There is a better one.'),
};

/** The radius of a dot that marks an end of the basis. Names of ends stand beside it. */
const RING = 13;

/** Portals for which the method takes some steps. */
const crooked = [[2, 11.5, 2, 7.5], [5.5, 9.5, 5.5, 6.5], [9, 10.5, 9, 8], [12.5, 10.5, 12.5, 7], [16, 9, 16, 5.5]];

const steps = {
    title: 'Step by step to the best line.',
    about: 'The slider goes through the steps. Large ends are the basis, and the strip is its margin. Drag ends up and down to change the portals.',
    box,
    handles: crooked.flatMap(([lx, ly, rx, ry], i) => [{ name: `l${i}`, at: [lx, ly], tone: 'left' }, { name: `r${i}`, at: [rx, ry], tone: 'right' }]),
    controls: [{ name: 'step', label: 'Step', kind: 'range', value: 0, min: 0, max: 6 }],
    update(state) {
        state.portals = heldPortals(state, state.l4 ? crooked : given);
        state.rows = rowsOf(state.portals);
        state.all = simplex(state.rows);
        state.at = Math.min(state.step, state.all.length - 1);
        state.now = state.all[state.at];
    },
    draw(surface, camera, tones, { portals, rows, now }) {
        drawPortals(surface, camera, tones, portals, [], RING + 4);
        strokeLines(surface, camera, strip(now), tones.faint, 1);
        strokeLines(surface, camera, [segment(now)], now.m < 0 ? tones.ink : tones.sourceEdge, 2.5);
        for (const i of now.basis) drawDot(surface, camera, [rows[i].x, rows[i].y], RING, tones.ink, tones.page);
        if (now.comes >= 0) drawDot(surface, camera, [rows[now.comes].x, rows[now.comes].y], 11, tones.page, tones.ink);
    },
    beside: ({ rows, now }) => table(['  end   distance  weight', ...rows.map((row, i) => {
        const k = now.basis.indexOf(i), distance = metres(room(row, now)).padStart(8);
        return `${k >= 0 ? '*' : '  '}${row.name}  ${distance} m${k >= 0 ? metres(now.weights[k]).padStart(7) : ''}`;
    })]),
    tell({ rows, now, at, all, step }) {
        const names = now.basis.map((i) => rows[i].name).join(', '), m = metres(now.m);
        const head = `Step ${at} of ${all.length - 1}: basis ${names}, margin ${m} m. `;
        if (now.comes >= 0) return `${head}${rows[now.comes].name} comes in, as it is ${metres(now.m - room(rows[now.comes], now))} m too near; ${rows[now.goes].name} goes.`;
        const proof = now.basis.filter((_, k) => now.weights[k] > 1e-9).map((i) => rows[i].name).join(', ');
        const done = now.m < -1e-9 ? `No line passes: ${proof} prove it.` : now.m > 1e-9 ? 'It is the best line.' : 'The line can only touch.';
        return `${head}No end is nearer. ${done}${step > at ? ` Slider position ${step} has no further step.` : ''}`;
    },
};

/** Portals along a corridor, one metre apart, shifted by a rule that looks like chance. */
function corridor(count, seed) {
    let at = seed * 7919 + 13;
    const chance = () => (at = (at * 48271) % 2147483647) / 2147483647;
    return Array.from({ length: count }, (_, i) => {
        const middle = 6 + 2.4 * (chance() - 0.5) + 0.05 * (i - 8), half = 1.6 + 0.8 * chance();
        return [i + 1, middle + half, i + 1, middle - half];
    });
}

const MOST = 16;

const kept = {
    title: 'A basis that is kept.',
    about: 'The sliders set how many portals there are, and choose among corridors. The table compares steps from the first basis on with steps from the basis of one portal fewer.',
    box,
    handles: [],
    controls: [{ name: 'count', label: 'Portals', kind: 'range', value: 8, min: 3, max: MOST },
        { name: 'seed', label: 'Corridor', kind: 'range', value: 4, min: 1, max: 20 }],
    update(state) {
        state.portals = corridor(state.count, state.seed);
        const rows = rowsOf(state.portals);
        let basis = simplex(rows.slice(0, 4)).at(-1).basis;
        state.counts = [];
        for (let n = 3; n <= state.count; n++) {
            const part = rows.slice(0, 2 * n), warm = simplex(part, basis);
            state.counts.push({ n, cold: simplex(part).length - 1, warm: warm.length - 1 });
            basis = warm.at(-1).basis;
            state.now = warm.at(-1);
        }
        state.bad = state.now.basis.map((i) => rows[i]);
        [state.cold, state.warm] = ['cold', 'warm'].map((key) => state.counts.reduce((sum, row) => sum + row[key], 0));
    },
    draw(surface, camera, tones, { portals, now, bad }) {
        drawPortals(surface, camera, tones, portals, bad);
        strokeLines(surface, camera, [segment(now)], now.m < 0 ? tones.ink : tones.sourceEdge, 2.5);
    },
    beside: ({ counts, cold, warm }) => table(['  portals  anew  kept', ...counts.map(({ n, cold: c, warm: w }) =>
        `  ${String(n).padStart(7)}${String(c).padStart(6)}${String(w).padStart(6)}`), `*    all${String(cold).padStart(6)}${String(warm).padStart(6)}`]),
    tell: ({ count, cold, warm, now }) => `${count} portals, margin ${metres(now.m)} m${now.m < 0 ? ': hidden' : ''}. Portal by portal, the simplex takes ` +
        `${cold} steps if it begins anew each time, and ${warm} if it keeps the basis.`,
};

export const figures = { margin: byHand, steps, kept };

const blocked = [[4, 7, 4, 4], [9, 3, 9, 1], [14, 8, 14, 5]];

export const exercises = {
    unknowns: {
        kind: 'number',
        question: 'A sequence has 5 portals. How many unknown numbers does its linear program have?',
        right: () => 3,
        why: 'Slope, height and margin. More portals give more rows, but no more unknowns.',
        low: 'The line alone has two numbers, slope and height. The margin is wanted, too.',
        high: 'Count what is to be found, not the conditions. Ten ends give ten rows, but only one line is wanted.',
    },
    negative: {
        kind: 'choice',
        question: 'The simplex method ends, and the best margin is -0.4 m. What follows?',
        options: [
            ['The method has failed, and must start from another basis.', 'It has not failed. It ends only when no line has a larger margin, so -0.4 m is the best.'],
            ['No line passes the sequence.', 'Even the best line has an end on its wrong side. A line of sight would have a margin of zero or more.'],
            ['A line passes, but it is 0.4 m away from a portal.', 'A line that passes has all ends on the right sides, and then its margin is not below zero.'],
        ],
        right: (lab) => (simplex(rowsOf(blocked)).at(-1).m < 0 && lab.core.conflict(blocked).verdict === 'hidden' ? 1 : 2),
    },
    widen: {
        kind: 'place',
        question: 'Only the middle portal can be moved. Reach a margin of 1.2 m or more.',
        solution: [[9, 8], [9, 4]],
        figure: {
            ...steps, title: 'The middle portal.', about: 'Drag its ends up and down, then press Check. The best line is shown.', controls: [],
            handles: [{ name: 'l1', at: [9, 5], tone: 'left' }, { name: 'r1', at: [9, 2], tone: 'right' }],
            update(state) {
                for (const i of [0, 2]) [state[`l${i}`], state[`r${i}`]] = [given[i].slice(0, 2), given[i].slice(2)];
                steps.update(Object.assign(state, { step: Infinity }));
            },
            tell: ({ now }) => `The best line has a margin of ${metres(now.m)} m.`,
        },
        judge({ now, portals }, lab) {
            if (now.m >= 1.2 && lab.core.conflict(portals).verdict === 'stabbed')
                return { right: true, text: `The margin is ${metres(now.m)} m. More than 1.50 m is out of reach: each of the other two portals is 3 m wide.` };
            return { right: false, text: `The margin is ${metres(now.m)} m. The straight line between the middles of the outer portals is at height 6 there: make room for it on both sides.` };
        },
    },
    funnel: {
        kind: 'code',
        lab: funnelLab,
        question: 'Complete the cut. The function gives how many portals of a sequence one line passes.',
        code: funnelCode.text,
    },
};
