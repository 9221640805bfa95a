/** Chapter 3: lines through portals, their ends, and the dual plane. */
import { t } from '../language/language.js';
import { dualFigure } from '../parts/dual.js';
import { drawDot, drawPlan, strokeLines } from '../parts/plan.js';
import { drawWhy, tellWhy } from '../parts/why-scene.js';
import { cellAt, planLine, round } from './lab.js';
import { drawWalls, flat, itemsOf } from './maps.js';

const items = itemsOf(flat.text);
export const box = [0, 0, 18, 12];

/** How large ends are that a picture points out, in pixels. */
export const BAD = 13;

/** Portals as they are crossed from left to right: left x, left y, right x, right y. */
export const given = [[4, 7, 4, 4], [9, 6, 9, 3], [14, 8, 14, 5]];

/** The name of an end, beside it. */
export function drawName(surface, camera, tones, end, place, right = 10) {
    const [px, py] = camera.toScreen(...place);
    surface.fillStyle = tones.ink;
    surface.font = 'bold 13px sans-serif';
    surface.textAlign = 'left';
    surface.textBaseline = 'middle';
    surface.fillText(nameOf(end), px + right, py);
}

/** The wall above and below each portal, and the portal with its ends; bad ends are so large that a handle on them leaves a rim. */
export function drawPortals(surface, camera, tones, portals, bad = [], right = 10) {
    drawPlan(surface, camera, {}, tones);
    strokeLines(surface, camera, portals.flatMap(([lx, ly, rx, ry]) => [[lx, ly, lx, box[3]], [rx, ry, rx, box[1]]]), tones.wall, 3);
    strokeLines(surface, camera, portals, tones.portal, 2);
    for (const [i, [lx, ly, rx, ry]] of portals.entries())
        for (const [name, x, y] of [['L', lx, ly], ['R', rx, ry]]) {
            const isBad = bad.some((end) => end.portal === i && end.side === name);
            drawDot(surface, camera, [x, y], isBad ? BAD : 5, isBad ? tones.ink : name === 'L' ? tones.left : tones.right, tones.page);
            if (isBad) drawDot(surface, camera, [x, y], 7, name === 'L' ? tones.left : tones.right, tones.page);
            drawName(surface, camera, tones, { side: name, portal: i }, [x, y], isBad ? Math.max(right, BAD + 4) : right);
        }
}

/** Positive where a place lies to the left of the line from a to b. */
export const side = ([ax, ay], [bx, by], x, y) => (bx - ax) * (y - ay) - (by - ay) * (x - ax);

/** Ends on the wrong side of the line from a to b. */
const wrongEnds = (a, b, portals) => portals.flatMap(([lx, ly, rx, ry], portal) => [
    ...(side(a, b, lx, ly) < 0 ? [{ portal, side: 'L' }] : []), ...(side(a, b, rx, ry) > 0 ? [{ portal, side: 'R' }] : [])]);

export const nameOf = (end) => `${end.side}${end.portal + 1}`;

/** The line beyond its two dots, over the whole picture. */
export function long([ax, ay], [bx, by]) {
    const size = Math.hypot(bx - ax, by - ay) || 1, k = 40 / size;
    return [ax - k * (bx - ax), ay - k * (by - ay), bx + k * (bx - ax), by + k * (by - ay)];
}

const line = {
    title: 'A line by hand.',
    about: 'The two dots hold a line that goes from the left dot to the right one. Ends on the wrong side are large. Portals are numbered from left to right.',
    box,
    handles: [{ name: 'a', at: [1, 9], tone: 'from' }, { name: 'b', at: [17, 3], tone: 'from' }],
    update(state) {
        const [a, b] = state.a[0] <= state.b[0] ? [state.a, state.b] : [state.b, state.a];
        state.wrong = wrongEnds(a, b, given);
        state.line = long(a, b);
        state.slope = (b[1] - a[1]) / (b[0] - a[0] || 1e-9);
    },
    marks: {
        left: () => ({ dots: given.map((p) => p.slice(0, 2)) }),
        right: () => ({ dots: given.map((p) => p.slice(2)) }),
    },
    draw(surface, camera, tones, state) {
        drawPortals(surface, camera, tones, given, state.wrong);
        strokeLines(surface, camera, [state.line], state.wrong.length ? tones.faint : tones.sourceEdge, state.wrong.length ? 1.5 : 3);
    },
    tell: (state) => t`The line has slope ${round(state.slope, 2)}. ` + (state.wrong.length
        ? t`On the wrong side: ${state.wrong.map(nameOf).join(', ')}.` : t('It passes all portals: it is a line of sight.')),
};

/** The portals that the dots of the figure hold, each at its place across and with its left end above. */
export function heldPortals(state, portals = given) {
    return portals.map(([x], i) => {
        const left = state[`l${i}`], right = state[`r${i}`];
        left[0] = right[0] = x;
        if (left[1] < right[1]) [left[1], right[1]] = [right[1], left[1]];
        if (left[1] - right[1] < 0.2) left[1] = right[1] + 0.2;
        return [...left, ...right];
    });
}

const dual = {
    title: 'Portals, and their dual plane.',
    about: 'Drag the ends of portals up and down. In the second picture, each end is a line, and each point of the filled polygon is a line of sight.',
    box,
    handles: given.flatMap(([lx, ly, rx, ry], i) => [{ name: `l${i}`, at: [lx, ly], tone: 'left' }, { name: `r${i}`, at: [rx, ry], tone: 'right' }]),
    update(state, lab) {
        state.portals = heldPortals(state);
        state.conflict = lab.core.conflict(state.portals);
        state.dual = lab.core.dual(state.portals);
        state.sees = state.conflict.verdict !== 'hidden';
        state.bad = state.conflict.ends.map((end) => ({ portal: end.portal, side: end.side === 'left' ? 'L' : 'R' }));
    },
    draw(surface, camera, tones, state) {
        drawPortals(surface, camera, tones, state.portals, state.bad);
        if (state.sees) strokeLines(surface, camera, [planLine(state.dual, state.dual.best)], tones.sourceEdge, 3);
    },
    beside(state, tones) {
        const all = state.portals.map(([lx, ly, rx, ry], portal) => ({ portal, cell: 0, left: [lx, ly], right: [rx, ry] }));
        const why = { from: 0, to: 1, seen: state.sees, sequence: state.sees ? all : [], dual: { ...state.dual, corners: [...state.dual.corners] },
            misses: [{ sequence: all.slice(0, 2), stopped_by: all[2], reason: 'conflict', ends: state.conflict.ends }] };
        return dualFigure(why, tones);
    },
    tell: (state) => (state.sees
        ? t`A line of sight passes all portals. The best line keeps ${round(state.dual.margin * state.dual.scale, 2)} m from all ends${state.conflict.verdict === 'grazing' ? t(': it can only touch') : ''}.`
        : t`No line passes. Ends that contradict each other: ${state.bad.map(nameOf).join(', ')}.`),
};

const cells = {
    title: 'Two cells of a plan.',
    about: 'Drag both dots into cells. The picture shows a line of sight from cell to cell, or the ends of portals that leave none.',
    box: flat.box,
    handles: [{ name: 'a', at: [3, 2], tone: 'from' }, { name: 'b', at: [17, 9], tone: 'to' }],
    update(state, lab) {
        state.scene = lab.scene(flat.text);
        [state.from, state.to] = [cellAt(state.scene, state.a), cellAt(state.scene, state.b)];
        state.why = state.from >= 0 && state.to >= 0 && state.from !== state.to ? lab.scene(flat.text).explain(state.from, state.to) : null;
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { space: state.scene, from: state.from, to: state.to }, tones);
        drawWalls(surface, camera, items, tones);
        if (state.why) drawWhy(surface, camera, state.why, tones);
    },
    tell: (state) => (state.why ? tellWhy(state.why) : t('Both dots are in one cell. A cell sees itself.')),
};

export const figures = { line, dual, cells };

export const exercises = {
    count: {
        kind: 'number',
        question: 'A sequence has 7 portals. How many conditions must a line meet to pass them all?',
        right: () => 2 * 7,
        why: 'Each portal has two ends, and each end is one condition.',
        low: 'Each portal has two ends, and the line has to keep to the right side of both.',
        high: 'There is one condition for each end of a portal, and a portal has two ends.',
    },
    turn: {
        kind: 'choice',
        question: 'We cross the same portal in the other direction. What happens to its left and its right end?',
        options: [
            ['They stay the same.', 'Left and right belong to the one who walks through. Turn round in a doorway to see it.'],
            ['They change places.', 'What was at the left hand is now at the right. So a portal has two directed forms, one for each way.'],
            ['One of them vanishes.', 'A portal is a segment. It has two ends whichever way it is crossed.'],
        ],
        right(lab) {
            const scene = lab.scene(flat.text), all = Array.from({ length: scene.cellCount }, (_, i) => scene.cell(i).portals).flat();
            const [first, back] = all.filter((p) => p.portal === all[0].portal);
            return String(first.left) === String(back.right) && String(first.right) === String(back.left) ? 1 : 0;
        },
    },
    through: {
        kind: 'place',
        question: 'Put the line through all three portals.',
        solution: [[1, 5.5], [17, 5.6]],
        figure: { ...line, title: 'Three portals.', about: 'Drag both dots, then press Check.', handles: [{ name: 'a', at: [1, 2], tone: 'from' }, { name: 'b', at: [17, 10], tone: 'from' }] },
        judge({ wrong }) {
            if (!wrong.length) return { right: true, text: t('All left ends lie to the left of the line, and all right ends to its right.') };
            return { right: false, text: t`On the wrong side: ${wrong.map(nameOf).join(', ')}. L must be above the line, R below it.` };
        },
    },
};
