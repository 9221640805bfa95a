/** Chapter 1: the angular sweep, step by step. */
import { drawDot, drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { angularSweep, isOn, onGrid } from './angular.js';
import { element } from './figure.js';
import { cellAt } from './lab.js';
import { drawText, drawWalls, flat, itemsOf, segmentsOf } from './maps.js';

const items = itemsOf(flat.text);

const walls = segmentsOf(items);

const code = [
    ['sort', 'sort the ends of walls by angle'],
    ['start', 'status = walls on the first ray'],
    ['next', 'for each end, in order:'],
    ['insert', '  if a wall begins here:'],
    ['insert', '    insert it into the status'],
    ['remove', '  if a wall ends here:'],
    ['remove', '    remove it from the status'],
    ['corner', '  if another wall is nearest now:'],
    ['corner', '    put corners on old and new one'],
    ['done', 'return the corners'],
];

/** Places of the eye with rays that only touch. */
const cases = { 'two ends': [2, 3], 'on a ray': [5, 5], 'three ends': [9, 6.5] };

const said = {
    sort: ({ events, sorting }) => `${events.length} ends are sorted, by ${sorting} comparisons`,
    start: ({ step }) => `the first ray goes to the right; walls on it: ${step.status.join(', ')}`,
    next: ({ event }) => `the ray turns to ${event.isBegin ? 'the beginning' : 'the end'} of wall ${event.wall.number}`,
    insert: ({ event, step }) => `wall ${event.wall.number} comes into the status, at place ${step.place + 1}`,
    remove: ({ event, step }) => `wall ${event.wall.number} leaves the status, from place ${step.place + 1}`,
    corner: ({ step }) => `${step.status.length ? `wall ${step.status[0]} is` : 'no wall is'} the nearest now: the region gets corners`,
    done: ({ step }) => `the ray has come round, and the region has ${step.corners} corners`,
};

/** An event in few letters: + for a wall that begins, - for one that ends. */
const nameOf = ({ isBegin, wall }) => `${isBegin ? '+' : '\u2212'}${wall.number}`;

const lit = (text, isLit) => (isLit ? element('b', {}, text) : text);

export const sweepFigure = {
    title: 'The angular sweep, step by step.',
    about: 'The slider goes through the steps, and the dot is the eye. Walls have numbers. Blue walls are in the status, the nearest one is thick. The list of places has some where rays only touch.',
    box: flat.box,
    handles: [{ name: 'eye', at: [3.5, 6.5] }],
    controls: [
        { name: 'at', label: 'step', kind: 'range', value: 24, min: 0, max: 80, most: ({ sweep }) => sweep.steps.length - 1 },
        { name: 'place', label: 'place', kind: 'choice', value: 'own', options: [['own', 'the dot'], ['two ends', 'two ends on one ray'], ['on a ray', 'walls on a ray'], ['three ends', 'opposite ends']] },
    ],
    update(state, lab) {
        if (state.place !== state.last && cases[state.place]) state.eye = cases[state.place];
        state.last = state.place;
        state.eye = onGrid(state.eye);
        state.isFree = cellAt(lab.scene(flat.text), state.eye) >= 0 && !walls.some((wall) => isOn(state.eye, wall));
        if (state.isFree || !state.sweep) [state.sweep, state.from] = [angularSweep(state.isFree ? state.eye : [3.5, 6.5], walls), state.eye];
        const { steps, events } = state.sweep;
        state.now = Math.min(state.at, steps.length - 1);
        state.step = steps[state.now];
        state.event = events[state.step.event];
        state.corners = state.sweep.corners.slice(0, state.step.corners);
    },
    draw(surface, camera, tones, { step, event, corners, eye, isFree, from }) {
        drawPlan(surface, camera, {}, tones);
        if (isFree && corners.length) fillPolygons(surface, camera, [[...(step.kind === 'done' ? [] : from), ...corners.flat()]], tones.region);
        drawWalls(surface, camera, items, tones);
        if (isFree) {
            strokeLines(surface, camera, step.status.map((number) => walls[number - 1]), tones.glass, 3);
            strokeLines(surface, camera, step.status.slice(0, 1).map((number) => walls[number - 1]), tones.glass, 6);
            const [x, y] = event?.at ?? [eye[0] + 1, eye[1]], long = 40 / Math.hypot(x - eye[0], y - eye[1]);
            strokeLines(surface, camera, [[...eye, eye[0] + long * (x - eye[0]), eye[1] + long * (y - eye[1])]], tones.sourceEdge, 1.5, [6, 4]);
            strokeLines(surface, camera, [[...eye, x, y]], tones.sourceEdge, 2.5);
            if (event) drawDot(surface, camera, event.at, 6, tones.start, tones.page);
        }
        for (const [i, [ax, ay, bx, by]] of walls.entries()) {
            const right = ax !== bx ? 0 : ax === flat.box[2] ? -11 : 11;
            drawText(surface, camera, [ax + 0.6 * (bx - ax), ay + 0.6 * (by - ay)], String(i + 1), tones, right, right ? 0 : -11);
        }
    },
    beside({ step, sweep: { events } }) {
        const lines = code.flatMap(([kind, text]) => [lit(text, kind === step.kind), '\n']);
        const list = events.flatMap((event, i) => [lit(nameOf(event), i === step.event), ' ']);
        return element('div', {}, element('pre', { tabIndex: 0, role: 'region', 'aria-label': 'Pseudo-code of the sweep' }, ...lines),
            element('p', { className: 'events' }, element('strong', {}, 'Events: '), ...list),
            element('p', { className: 'events' }, element('strong', {}, 'Status: '), step.status.join(', ') || 'no wall'));
    },
    tell(state) {
        if (!state.isFree) return 'The eye stands on a wall. Move it to free floor.';
        const { sweep: { steps, events }, step, now } = state, n = events.length;
        return `Step ${now} of ${steps.length - 1}: ${said[step.kind]({ ...state, ...state.sweep })}. ` +
            `${step.comparisons} comparisons so far; n log n is ${Math.round(n * Math.log2(n))} for ${n} ends.`;
    },
};
