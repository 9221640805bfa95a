/** Chapter 1: visible regions, what bounds them, and their measures. */
import { drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { mix } from '../parts/tones.js';
import { side } from './angular.js';
import { sweepFigure } from './angular-figure.js';
import { cellAt, floorArea, round } from './lab.js';
import { regionCode } from './lab-code.js';
import { drawWalls, flat, itemsOf, pillars, segmentsOf } from './maps.js';
import { regionLab } from './region-lab.js';

const flatItems = itemsOf(flat.text), flatWalls = segmentsOf(flatItems), pillarItems = itemsOf(pillars.text);

/** Edges of a region of some kind, as lines. */
const edgesOf = (isovist, kind) => isovist.edges.flatMap((edge, i) => {
    const p = isovist.points, n = p.length;
    return edge === kind ? [[p[2 * i], p[2 * i + 1], p[(2 * i + 2) % n], p[(2 * i + 3) % n]]] : [];
});

/** The parts of a segment that no wall covers. All walls are axial, so no coordinate is rounded where one covers any. */
function openParts([ax, ay, bx, by], walls) {
    const k = Math.abs(bx - ax) > Math.abs(by - ay) ? 0 : 1, [from, to] = [[ax, ay], [bx, by]], parts = [];
    const covers = walls.map(([x0, y0, x1, y1]) => [[x0, y0], [x1, y1]]).filter((ends) => ends.every((end) => side(from, to, end) === 0))
        .map((ends) => ends.map((end) => end[k]).sort((u, v) => u - v)).sort((u, v) => u[0] - v[0]);
    const place = (v) => (k ? [ax, v] : [v, ay]), [first, last] = [from[k], to[k]].sort((u, v) => u - v);
    if (!covers.length) return [[ax, ay, bx, by]];
    let at = first;
    for (const [low, high] of covers) {
        if (Math.min(low, last) > at) parts.push([...place(at), ...place(Math.min(low, last))]);
        at = Math.max(at, high);
    }
    if (at < last) parts.push([...place(at), ...place(last)]);
    return parts;
}

/** Occluding edges in the open: where the eye stands on the line of a wall, the edge along it is open beside the wall only. */
const occludingOf = (isovist) => edgesOf(isovist, 'occluding').flatMap((edge) => openParts(edge, flatWalls));

const look = (lab, text, place, options) => {
    const scene = lab.scene(text);
    return cellAt(scene, place) < 0 ? null : scene.isovist(...place, options);
};

const eye = {
    title: 'The visible region.',
    about: 'Drag the dot, which is the eye. Blue dashed edges are occluding: behind them the floor goes on.',
    box: flat.box,
    handles: [{ name: 'eye', at: [4, 6.5] }],
    controls: [
        { name: 'edges', label: 'show occluding edges', kind: 'check', value: true },
        { name: 'field', label: 'field of view', kind: 'range', value: 360, min: 30, max: 360, step: 30 },
    ],
    update(state, lab) {
        const options = state.field < 360 ? { heading: 0, fov: state.field } : {};
        state.isovist = look(lab, flat.text, state.eye, options);
        state.share = state.isovist ? state.isovist.area / floorArea(lab.scene(flat.text)) : 0;
    },
    marks: {
        occluding: ({ isovist }) => ({ lines: isovist ? occludingOf(isovist) : [] }),
        walls: ({ isovist }) => ({ lines: isovist ? edgesOf(isovist, 'wall') : [] }),
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { items: flatItems, region: state.isovist?.polygon }, tones);
        if (state.isovist && state.edges) strokeLines(surface, camera, occludingOf(state.isovist), tones.glass, 3, [7, 4]);
    },
    tell: (state) => (state.isovist
        ? `Field of view ${state.field}°. The eye sees ${round(state.isovist.area)} m², ${round(100 * state.share)} % of the floor. ` +
            `${occludingOf(state.isovist).length} edges are occluding.`
        : 'Nobody can stand inside a wall.'),
};

const pair = {
    title: 'Two people.',
    about: 'Drag both dots. The line between them is drawn full where they see each other.',
    box: flat.box,
    handles: [{ name: 'a', at: [3, 6.5], tone: 'from', letter: 'A' }, { name: 'b', at: [12, 3], tone: 'to', letter: 'B' }],
    update(state, lab) {
        const scene = lab.scene(flat.text), [[ax, ay], [bx, by]] = [state.a, state.b];
        state.sees = scene.canSee({ x: ax, y: ay }, { x: bx, y: by });
        state.back = scene.canSee({ x: bx, y: by }, { x: ax, y: ay });
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { items: flatItems }, tones);
        strokeLines(surface, camera, [[...state.a, ...state.b]], state.sees ? tones.sourceEdge : tones.faint, state.sees ? 3 : 1.5, state.sees ? [] : [4, 5]);
    },
    tell: ({ a, b, sees, back }) => `A at ${a.map((v) => round(v)).join(', ')} ${sees ? 'sees' : 'does not see'} B at ${b.map((v) => round(v)).join(', ')}, ` +
        `and B ${back ? 'sees' : 'does not see'} A.`,
};

/** Measures, with their units and how they are said. */
const measures = {
    area: ['area', 'm²'], perimeter: ['perimeter', 'm'], occlusivity: ['occlusivity', 'm'],
    maxRadial: ['longest sightline', 'm'], compactness: ['compactness', ''], driftMagnitude: ['drift', 'm'],
};
const STEP = 0.8;

/** What is seen from the middle of each square of the floor; computed once. */
let views = null;
function viewsOf(lab) {
    const list = [], [x0, y0, x1, y1] = pillars.box;
    for (let x = x0; x < x1 - 1e-9; x += STEP)
        for (let y = y0; y < y1 - 1e-9; y += STEP) {
            const seen = look(lab, pillars.text, [x + STEP / 2, y + STEP / 2]);
            if (seen) list.push({ square: [x, y, x + STEP, y, x + STEP, y + STEP, x, y + STEP], seen });
        }
    return list;
}

/** One measure at the middle of each square. */
function fieldOf(lab, name) {
    const squares = (views ??= viewsOf(lab)).map(({ square, seen }) => ({ square, value: seen[name] }));
    const values = squares.map((s) => s.value), least = Math.min(...values), most = Math.max(...values);
    return { squares, least, most };
}

const field = {
    title: 'A measure everywhere.',
    about: 'Each square has the colour of one measure at its middle: the darker blue, the larger. The line at the eye is its drift.',
    box: pillars.box,
    handles: [{ name: 'eye', at: [2, 6] }],
    controls: [{ name: 'measure', label: 'measure', kind: 'choice', value: 'area', options: Object.entries(measures).map(([key, [name]]) => [key, name]) }],
    update(state, lab) {
        state.field = fieldOf(lab, state.measure);
        state.isovist = look(lab, pillars.text, state.eye);
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, {}, tones);
        const { squares, least, most } = state.field, shades = 12;
        for (let shade = 0; shade <= shades; shade++) {
            const group = squares.filter(({ value }) => Math.round((shades * (value - least)) / (most - least || 1)) === shade);
            fillPolygons(surface, camera, group.map((s) => s.square), mix(tones.floor[0], tones.glass, 0.9 * shade / shades));
        }
        drawWalls(surface, camera, pillarItems, tones);
        if (!state.isovist) return;
        strokeLines(surface, camera, [state.isovist.polygon], tones.sourceEdge, 2, [], true);
        const angle = (state.isovist.driftAngle * Math.PI) / 180, size = state.isovist.driftMagnitude, [x, y] = state.eye;
        strokeLines(surface, camera, [[x, y, x + size * Math.cos(angle), y + size * Math.sin(angle)]], tones.start, 4);
    },
    tell(state) {
        const [name, unit] = measures[state.measure], { least, most } = state.field;
        const here = state.isovist ? ` At the eye it is ${round(state.isovist[state.measure], 2)} ${unit}`.trimEnd() + '.' : ' Nobody can stand inside a pillar.';
        return `The ${name} goes from ${round(least, 2)} to ${round(most, 2)} ${unit}`.trimEnd() + `.${here}`;
    },
};

export const figures = { eye, sweep: sweepFigure, pair, field };

export const exercises = {
    convex: {
        kind: 'number',
        question: 'The eye stands in an empty square room of 10 by 10 metres. How long are all occluding edges together, in metres?',
        right: (lab) => lab.scene('sightline 1\nwalls 0 0 10 0 10 10 0 10 0 0\n').isovist(3, 4).occlusivity,
        why: 'A convex room hides nothing from anybody in it. Each edge of the region is a wall, so occlusivity is 0.',
        low: 'A length cannot be negative.',
        high: 'An occluding edge begins at a corner that juts into the view. An empty square has none.',
    },
    mutual: {
        kind: 'choice',
        question: 'A sees B. There are walls only: no mirrors, no glass, and both look all round. Does B see A?',
        options: [
            ['Only if both regions have the same area.', 'The areas say nothing here. What counts is the line between the two people.'],
            ['Yes, always.', 'The line from A to B is the line from B to A. No wall cuts it in one direction alone.'],
            ['Not if B stands behind a corner.', 'If a corner were between them, A would not see B either.'],
        ],
        right(lab) {
            const scene = lab.scene(flat.text), a = { x: 3, y: 6.5 }, b = { x: 10, y: 6 };
            return scene.canSee(a, b) && scene.canSee(b, a) ? 1 : -1;
        },
    },
    region: {
        kind: 'code',
        lab: regionLab,
        question: 'Complete the function. It gives the corners of the visible region, in the order of their angles.',
        code: regionCode.text,
    },
    guard: {
        kind: 'place',
        question: 'Put the eye where it sees at least 60 % of the floor.',
        solution: [[7.1, 8]],
        figure: { ...eye, title: 'A place for a guard.', about: 'Drag the dot, then press Check.', handles: [{ name: 'eye', at: [2, 10] }], controls: undefined,
            update(state, lab) {
                Object.assign(state, { field: 360, edges: false });
                eye.update(state, lab);
            },
            tell: (state) => (state.isovist ? `The eye is at ${round(state.eye[0])}, ${round(state.eye[1])}.` : 'Nobody can stand inside a wall.') },
        judge(state) {
            const seen = `The eye sees ${round(100 * state.share)} % of the floor.`;
            if (state.share >= 0.6) return { right: true, text: `${seen} A place in a doorway sees into both rooms at once.` };
            return { right: false, text: `${seen} Try a doorway: it belongs to two rooms.` };
        },
    },
};
