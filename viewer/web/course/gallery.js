/** Chapter 14: guards of a gallery: by hand, by Fisk's colouring, and the fewest. */
import { plural } from '../formats/words.js';
import { load } from '../package/place.js';
import { drawDot, drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { onGrid } from './angular.js';
import { element, table } from './figure.js';
import { coloursOf, earsOf, guardsOf, isSimple } from './fisk.js';
import { cellAt, round } from './lab.js';
import { comb, drawText, drawWalls, gallery, hall, house, itemsOf, pillars, rooms, uShape } from './maps.js';

let loading = null;
const floors = new Map();

/** The inside of a map for questions about guards; the module is loaded by the first call. */
export async function floorOf(text) {
    const core = await (loading ??= load({ memory: 2 ** 28 }));
    if (!floors.has(text)) floors.set(text, core.open(text));
    return floors.get(text);
}

/** Where all guards stand on the floor: what they see together. */
function watch(state, lab, text, names) {
    const scene = lab.scene(text), floor = floors.get(text);
    state.guards = names.map((name) => state[name]).filter((place) => cellAt(scene, place) >= 0);
    state.regions = state.guards.map(([x, y]) => scene.isovist(x, y).polygon);
    state.covered = floor?.cover(state.guards.map(([x, y]) => ({ x, y })));
}

/** @param {any[]} items walls of the map */
function drawWatch(surface, camera, tones, items, { regions, covered }) {
    drawPlan(surface, camera, {}, tones);
    for (const region of regions) fillPolygons(surface, camera, [region], tones.region, 0.55);
    const blind = covered?.pieces.filter(({ count }) => count === 0).map(({ points }) => [...points]) ?? [];
    fillPolygons(surface, camera, blind, tones.to, 0.75);
    drawWalls(surface, camera, items, tones);
}

const shareSeen = ({ areas }) => 1 - areas[0] / areas.reduce((a, b) => a + b);

const guardsFigure = {
    title: 'Three guards.',
    about: 'Drag the dots. Yellow floor is seen, and the more guards see it, the stronger is its colour. Purple floor is a blind spot.',
    box: gallery.box,
    handles: [{ name: 'a', at: [3, 10] }, { name: 'b', at: [8, 5] }, { name: 'c', at: [16, 10] }],
    start: (figure) => floorOf(gallery.text).then(() => figure.change()),
    isReady: ({ covered }) => Boolean(covered),
    update: (state, lab) => watch(state, lab, gallery.text, ['a', 'b', 'c']),
    draw: (surface, camera, tones, state) => drawWatch(surface, camera, tones, itemsOf(gallery.text), state),
    tell: ({ covered, guards }) => (!covered ? 'The figure is being loaded.' : `${plural(guards.length, 'guard')} on the floor: ` + (covered.blindSpots.length
        ? `they see ${round(100 * shareSeen(covered))} % of it, and leave ${plural(covered.blindSpots.length, 'blind spot')}.` : 'they see everything.')),
};

const shape = [[5, 7], [1, 8], [1, 1], [6, 1], [7, 4], [9, 1], [17, 1], [17, 6], [13, 5], [16, 11], [10, 9], [9, 11], [4, 11]];
const hues = ['glass', 'start', 'portal'], letters = ['B', 'O', 'G'];

const colouring = {
    title: 'Fisk\'s colouring.',
    about: 'The slider takes ears off, one by one, and then gives colours to the corners. Drag corners to change the gallery; a corner stops where the outline would meet itself. Letters name the colours: blue, orange, green.',
    box: [0, 0, 18, 12],
    handles: shape.map((at, i) => ({ name: `p${i}`, at, tone: 'ink' })),
    controls: [{ name: 'at', label: 'step', kind: 'range', value: 8, min: 0, max: 22, most: ({ points }) => 2 * (points.length - 2) }],
    update(state) {
        const points = shape.map((_, i) => onGrid(state[`p${i}`])), isInOrder = points.reduce((sum, [x, y], i) =>
            sum + x * points[(i + 1) % points.length][1] - y * points[(i + 1) % points.length][0], 0) > 0;
        if (isInOrder && isSimple(points)) state.points = points;
        state.points.forEach((at, i) => (state[`p${i}`] = at));
        const ears = earsOf(state.points), n = ears.length;
        state.ears = ears.slice(0, Math.min(state.at, n));
        state.colours = coloursOf(ears, state.points.length, Math.max(0, state.at - n));
        state.guards = state.at >= 2 * n ? guardsOf(state.colours) : [];
    },
    draw(surface, camera, tones, { points, ears, colours, guards }) {
        drawPlan(surface, camera, {}, tones);
        fillPolygons(surface, camera, [points.flat()], tones.floor[0]);
        if (ears.length && !colours.some((c) => c >= 0)) fillPolygons(surface, camera, [ears.at(-1).flatMap((i) => points[i])], tones.region);
        strokeLines(surface, camera, ears.map((ear) => ear.flatMap((i) => points[i])), tones.faint, 1, [], true);
        strokeLines(surface, camera, [points.flat()], tones.wall, 2.5, [], true);
        for (const i of guards) drawDot(surface, camera, points[i], 18, tones.source, tones.ink);
        for (const [i, colour] of colours.entries()) if (colour >= 0) {
            drawDot(surface, camera, points[i], 13, tones[hues[colour]], tones.page);
            drawText(surface, camera, points[i], letters[colour], tones, 20, -15);
        }
    },
    beside({ colours, points }) {
        const counts = [0, 1, 2].map((colour) => colours.filter((c) => c === colour).length);
        return table(['colour', 'corners'], [['blue', counts[0]], ['orange', counts[1]], ['green', counts[2]], ['all, divided by 3', `${points.length} / 3 = ${round(points.length / 3)}`]]);
    },
    tell({ ears, colours, guards, points, at }) {
        const coloured = colours.filter((c) => c >= 0).length;
        if (guards.length) return `${plural(guards.length, 'guard')} at the corners of the rarest colour. ${points.length} corners never need more than ${Math.floor(points.length / 3)}.`;
        if (coloured) return `${coloured} of ${points.length} corners have a colour. Each further tip gets the colour that its two neighbours do not have.`;
        return at ? `${plural(ears.length, 'triangle')} of ${points.length - 2}. The tip of the last ear is taken off.` : `A gallery with ${points.length} corners. It has an ear: a triangle that can be cut off.`;
    },
};

/** Plans whose fewest guards are looked for. */
const plans = { gallery, comb, house, pillars, hall: { text: hall(2), box: [0, 0, 8, 12] }, rooms };
const jobs = new Map();

/** How long the search may take, in seconds. */
const SECONDS = 20;

function jobOf(name, figure) {
    if (jobs.has(name)) return jobs.get(name);
    const job = { bounds: [], placement: null, trouble: '' }, worker = new Worker(new URL('./place-worker.js', import.meta.url), { type: 'module' });
    jobs.set(name, job);
    worker.addEventListener('message', ({ data: { lower, upper, placement } }) => {
        const last = job.bounds.at(-1), isNew = !last || last.lower !== lower || last.upper !== upper;
        if (isNew) job.bounds.push({ lower, upper });
        job.placement = placement ?? job.placement;
        if (placement) worker.terminate();
        if (isNew || placement) figure.change();
    });
    worker.addEventListener('error', (event) => {
        job.trouble = `The search cannot run here: ${event.message}`;
        figure.change();
    });
    worker.postMessage({ text: plans[name].text, seconds: SECONDS });
    return job;
}

const bounds = {
    title: 'The fewest guards.',
    about: 'Large dots are guards, small ones are witnesses. The slider chooses a guard: the floor and the witnesses that it sees are marked.',
    box: gallery.box,
    handles: [],
    controls: [
        { name: 'plan', label: 'plan', kind: 'choice', value: 'house', options: Object.keys(plans).map((name) => [name, name]) },
        { name: 'guard', label: 'guard', kind: 'range', value: 1, min: 1, max: 6, most: ({ job }) => job?.placement?.viewpoints.length ?? 6 },
    ],
    start(figure) {
        figure.state.ask = (name) => jobOf(name, figure);
    },
    isReady: ({ job }) => Boolean(job?.placement || job?.trouble),
    update(state, lab) {
        const { text, box } = plans[state.plan], scene = lab.scene(text);
        Object.assign(state, { text, box, job: state.ask?.(state.plan) });
        const { viewpoints = [], witnesses = [] } = state.job?.placement ?? {};
        state.at = viewpoints[Math.min(state.guard, viewpoints.length) - 1];
        state.region = state.at ? scene.isovist(state.at.x, state.at.y).polygon : null;
        state.seen = state.at ? witnesses.filter((witness) => scene.canSee(state.at, witness)) : [];
    },
    draw(surface, camera, tones, { text, job, at, region, seen }) {
        drawPlan(surface, camera, { region }, tones);
        drawWalls(surface, camera, itemsOf(text), tones);
        const { viewpoints = [], witnesses = [] } = job?.placement ?? {};
        for (const { x, y } of witnesses) drawDot(surface, camera, [x, y], 4, tones.to, tones.page);
        for (const { x, y } of seen) drawDot(surface, camera, [x, y], 6, tones.to, tones.ink);
        for (const guard of viewpoints) drawDot(surface, camera, [guard.x, guard.y], guard === at ? 9 : 7, tones.sourceEdge, guard === at ? tones.ink : tones.page);
    },
    beside: ({ job }) => element('div', {}, table(['round', 'at least', 'at most'], (job?.bounds ?? []).map(({ lower, upper }, i) => [i + 1, lower, upper]))),
    tell({ job, seen, at, guard }) {
        if (job?.trouble) return job.trouble;
        if (!job?.placement) return job?.bounds.length ? `At least ${job.bounds.at(-1).lower}, at most ${job.bounds.at(-1).upper} guards so far.` : 'The search begins.';
        const { lower, upper, witnesses } = job.placement, known = lower === upper ? `${plural(upper, 'guard')}, and no fewer can do it` : `Between ${lower} and ${upper} guards`;
        return `${known}. ${plural(witnesses.length, 'witness', 'witnesses')}; guard ${Math.min(guard, job.placement.viewpoints.length)} at ${round(at.x)}, ${round(at.y)} sees ${seen.length} of them.`;
    },
};

export const figures = { guards: guardsFigure, colouring, bounds };

/** Numbers of the text. */
const fewest = async ({ text }) => (await floorOf(text)).place().upper;
export const values = {
    'comb-guards': () => fewest(comb),
    'comb-corners': () => itemsOf(comb.text)[0].points.length / 2 - 1,
    'house-guards': () => fewest(house),
    'house-fewer': async () => (await fewest(house)) - 1,
};

/** A gallery of so many corners never needs more guards. */
const enough = (corners) => Math.floor(corners / 3);

export const exercises = {
    enough: {
        kind: 'number',
        question: 'A gallery without holes has 20 corners. How many guards are always enough?',
        right: () => enough(20),
        why: 'Three colours share 20 corners, so some colour has at most 20 / 3 of them: 6, as guards come whole.',
        low: 'There are galleries with 20 corners that need more. Think of a comb, whose teeth need a guard each.',
        high: 'Three colours share the corners. The rarest one has at most a third of them.',
    },
    colour: {
        kind: 'choice',
        question: 'Guards stand at all corners of one colour. Why do they see everything?',
        options: [
            ['Each triangle has a corner of each colour, and a corner of a triangle sees all of it.', 'A triangle is convex. So any of its corners sees all of it, and one of them has the colour.'],
            ['Each corner has a neighbour of that colour.', 'To see the corners is not enough: floor between them could be hidden. Think of the triangles.'],
            ['The rarest colour has the corners that see most.', 'The colours know nothing of what a corner sees. The rarest one is taken, because it needs the fewest guards.'],
        ],
        right: () => 0,
    },
    two: {
        kind: 'place',
        question: 'Put two guards so that they see all of this gallery.',
        solution: [[2, 1.5], [10, 1.5]],
        figure: { ...guardsFigure, title: 'Two guards.', about: 'Drag the dots, then press Check.', box: uShape.box, handles: [{ name: 'a', at: [2, 7] }, { name: 'b', at: [6, 1.5] }],
            start: () => floorOf(uShape.text),
            update(state, lab) {
                watch(state, lab, uShape.text, ['a', 'b']);
                state.covered = null;
            },
            draw: (surface, camera, tones) => drawWatch(surface, camera, tones, itemsOf(uShape.text), { regions: [], covered: null }),
            tell: ({ guards }) => `${plural(guards.length, 'guard')} on the floor.` },
        async judge({ guards }) {
            const covered = (await floorOf(uShape.text)).cover(guards.map(([x, y]) => ({ x, y })));
            const seen = `They see ${round(100 * shareSeen(covered))} % of the floor.`;
            if (!covered.blindSpots.length) return { right: true, text: `${seen} The corners of the legs witness that one guard is not enough: nobody sees into both legs.` };
            return { right: false, text: `${seen} ${plural(covered.blindSpots.length, 'blind spot')} left. Where does a guard see all of one leg, and the floor below?` };
        },
    },
};

