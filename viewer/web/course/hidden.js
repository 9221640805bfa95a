/** Chapter 7: witnesses: lines for what is seen, a few ends of portals for what is hidden. */
import { drawDot, drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { drawWhy } from '../parts/why-scene.js';
import { cellAt, planLine, round } from './lab.js';
import { BAD, drawName, drawPortals, given, heldPortals, nameOf, side } from './lines.js';
import { drawWalls, house, itemsOf } from './maps.js';

const box = [0, 0, 18, 12], houseItems = itemsOf(house.text);

/** Corners of the convex hull, counter-clockwise (Andrew's monotone chain). @param {number[][]} points */
export function hull(points) {
    const sorted = [...points].sort((p, q) => p[0] - q[0] || p[1] - q[1]);
    const half = (list) => {
        const chain = [];
        for (const p of list) {
            while (chain.length > 1 && side(chain.at(-2), chain.at(-1), ...p) <= 0) chain.pop();
            chain.push(p);
        }
        return chain.slice(0, -1);
    };
    return [...half(sorted), ...half(sorted.reverse())];
}

/** A hull as a filled polygon, or as a line where it has no area. */
export function drawHull(surface, camera, points, colour) {
    const corners = hull(points);
    if (corners.length > 2) fillPolygons(surface, camera, [corners.flat()], colour, 0.18);
    const next = (i) => corners[(i + 1) % corners.length];
    strokeLines(surface, camera, corners.map((p, i) => [...p, ...next(i)]), colour, 2);
}

/** The ends that the library names as a proof. */
const proofOf = ({ ends }) => ends.map((end) => ({ portal: end.portal, side: end.side === 'left' ? 'L' : 'R' }));

const free = [[3, 9, 4, 5], [8, 7.5, 9, 4], [14, 8, 14, 6]];

/** Keeps each portal in its third of the picture, and its left end above: so it is crossed to the right. */
function freePortals(state) {
    return free.map((_, i) => {
        const left = state[`l${i}`], right = state[`r${i}`];
        for (const end of [left, right]) end[0] = Math.min(6 * i + 5.5, Math.max(6 * i + 0.5, end[0]));
        left[1] = Math.max(left[1], 0.3);
        right[1] = Math.min(right[1], left[1] - 0.3);
        return [...left, ...right];
    });
}

const hulls = {
    title: 'Two groups of ends.',
    about: 'Drag the ends of portals, each in its third of the picture. The areas are the convex hulls of all left ends, and of all right ends. Large ends prove that no line passes.',
    box,
    handles: free.flatMap(([lx, ly, rx, ry], i) => [{ name: `l${i}`, at: [lx, ly], tone: 'left' }, { name: `r${i}`, at: [rx, ry], tone: 'right' }]),
    update(state, lab) {
        state.portals = freePortals(state);
        state.conflict = lab.core.conflict(state.portals);
        state.bad = proofOf(state.conflict);
        state.sees = state.conflict.verdict !== 'hidden';
        state.dual = state.sees ? lab.core.dual(state.portals) : null;
    },
    marks: {
        left: ({ portals }) => ({ areas: [hull(portals.map((p) => p.slice(0, 2))).flat()] }),
        right: ({ portals }) => ({ areas: [hull(portals.map((p) => p.slice(2))).flat()] }),
    },
    draw(surface, camera, tones, { portals, bad, dual }) {
        drawPlan(surface, camera, {}, tones);
        drawHull(surface, camera, portals.map((p) => p.slice(0, 2)), tones.left);
        drawHull(surface, camera, portals.map((p) => p.slice(2)), tones.right);
        strokeLines(surface, camera, portals, tones.portal, 2);
        if (dual?.corners.length) strokeLines(surface, camera, [planLine(dual, dual.best)], tones.sourceEdge, 3);
        for (const end of bad) {
            const p = portals[end.portal];
            drawDot(surface, camera, end.side === 'L' ? p.slice(0, 2) : p.slice(2), BAD, tones.ink, tones.page);
        }
        for (const [portal, p] of portals.entries())
            for (const [letter, place] of [['L', p.slice(0, 2)], ['R', p.slice(2)]])
                drawName(surface, camera, tones, { side: letter, portal }, place, (bad.some((end) => end.portal === portal && end.side === letter) ? BAD : 9) + 4);
    },
    tell: ({ conflict, bad }) => ({
        stabbed: 'The hulls are apart: a line runs between them, and it passes all portals.',
        grazing: 'The hulls touch, and a line just fits between them: it can only touch.',
        hidden: `The hulls overlap, so no line passes. The proof has ${bad.length} ends: ${bad.map(nameOf).join(', ')}.`,
    })[conflict.verdict],
};

/** Weights that add up to 0, and so do the weighted points: Radon's relation of four points. */
function relation(p) {
    const area = (i, j, k) => side(p[i], p[j], ...p[k]);
    return [area(1, 2, 3), -area(0, 2, 3), area(0, 1, 3), -area(0, 1, 2)];
}

const radon = {
    title: 'Four points, two groups.',
    about: 'Drag the four dots. They fall into two groups whose hulls share a point, which is drawn as a ring.',
    box,
    handles: [[3, 3], [14, 9], [5, 10], [13, 2]].map((at, i) => ({ name: `p${i}`, at, tone: 'from' })),
    update(state) {
        state.points = [0, 1, 2, 3].map((i) => state[`p${i}`]);
        const weights = relation(state.points);
        state.groups = [1, -1].map((sign) => [0, 1, 2, 3].filter((i) => weights[i] * sign > 0));
        const sum = state.groups[0].reduce((all, i) => all + weights[i], 0);
        state.shared = sum > 0 ? [0, 1].map((k) => state.groups[0].reduce((all, i) => all + (weights[i] * state.points[i][k]) / sum, 0)) : null;
    },
    draw(surface, camera, tones, { points, groups, shared }) {
        drawPlan(surface, camera, {}, tones);
        groups.forEach((group, k) => group.length > 1 && drawHull(surface, camera, group.map((i) => points[i]), k ? tones.right : tones.left));
        if (shared) drawDot(surface, camera, shared, 12, tones.page, tones.ink);
        points.forEach((p, i) => {
            const [x, y] = camera.toScreen(...p);
            surface.fillStyle = tones.ink;
            surface.font = 'bold 13px sans-serif';
            surface.textAlign = 'left';
            surface.textBaseline = 'middle';
            surface.fillText(String(i + 1), x + 11, y - 9);
        });
    },
    tell({ groups, shared }) {
        if (!shared) return 'All four dots lie on one line.';
        const [few, many] = [...groups].sort((a, b) => a.length - b.length).map((group) => group.map((i) => i + 1).join(', '));
        const at = `The shared point is ${round(shared[0])}, ${round(shared[1])}.`;
        if (groups.some((group) => group.length === 1)) return `Dot ${few} lies in the hull of ${many}. ${at}`;
        return `The segment of ${few} and the segment of ${many} cross. ${at}`;
    },
};

const ways = {
    title: 'Why is it hidden?',
    about: 'Drag both dots into rooms. The slider goes through the ways that the search gave up. The dashed portal is the one that ended a way.',
    box: house.box,
    handles: [{ name: 'a', at: [3, 1.5], tone: 'from' }, { name: 'b', at: [22, 7], tone: 'to' }],
    controls: [{ name: 'way', label: 'Way', kind: 'range', value: 1, min: 1, max: 6 }],
    update(state, lab) {
        const scene = (state.scene = lab.scene(house.text));
        [state.from, state.to] = [cellAt(scene, state.a), cellAt(scene, state.b)];
        state.why = state.from >= 0 && state.to >= 0 && state.from !== state.to ? scene.explain(state.from, state.to, { misses: 6 }) : null;
        const misses = state.why?.misses ?? [];
        state.count = misses.length;
        state.miss = misses[(state.way - 1) % Math.max(1, misses.length)];
    },
    draw(surface, camera, tones, { scene, from, to, why, miss }) {
        drawPlan(surface, camera, { space: scene, from, to }, tones);
        drawWalls(surface, camera, houseItems, tones);
        if (why) drawWhy(surface, camera, miss ? { ...why, misses: [miss] } : why, tones);
    },
    tell({ why, miss, count, way }) {
        if (!why) return 'Both dots must be in rooms, and in two cells. A cell sees itself.';
        const pair = `Cells ${why.from} and ${why.to}`;
        if (why.seen) return `${pair} see each other. The witness is the line; it passes ${why.sequence.length} portals. For slider position ${way} there is no failed way to show.`;
        if (!miss) return `${pair}: there is no way at all.`;
        const ends = miss.ends.map((end) => `${end.side === 'left' ? 'L' : 'R'} at ${end.point.map((v) => round(v)).join(', ')}`);
        return `${pair} are hidden. Way ${((way - 1) % count) + 1} of ${count} that were kept, for position ${way}: it ends after ` +
            `${miss.sequence.length} portals. ${miss.reason === 'turn' ? 'A line would have to turn back. ' : ''}These ends contradict each other: ${ends.join('; ')}.`;
    },
};

export const figures = { hulls, radon, ways };

/** The middle portal is too high for any line. */
const loose = [[4, 7, 4, 4], [9, 11, 9, 10], [14, 8, 14, 5]];

export const exercises = {
    ends: {
        kind: 'number',
        question: 'No line passes a sequence of 20 portals without touching an end. How many of their 40 ends are enough to prove it, whatever the sequence?',
        right: () => 4,
        why: 'This is what Kirchberger proved for points in the plane. Often three or two are enough, but four always are. Lines that touch need up to six in rare cases.',
        low: 'Two crossing segments are a proof, one between left ends and one between right ends. Take one of their four points away, and a line may pass.',
        high: 'Fewer will do. Think of the two hulls: where they meet, a triangle holds a point, or two segments cross.',
    },
    proves: {
        kind: 'choice',
        question: 'Three ends of one sequence contradict each other. What does that prove?',
        options: [
            ['The two cells at its ends are hidden from each other.', 'They may see each other by another sequence. Only when all sequences fail are they hidden.'],
            ['No line passes this sequence, nor any longer one that begins with it.', 'The same three ends are in each longer sequence, and they contradict each other there as well.'],
            ['No line passes any part of this sequence.', 'A part without one of the three ends may well be passed: the first portal alone always is.'],
        ],
        right: (lab) => {
            const [all, part] = [loose, loose.slice(0, 1)].map((portals) => lab.core.conflict(portals).verdict);
            const longer = lab.core.conflict([...loose, [16, 9, 16, 4]]).verdict;
            return all === 'hidden' && longer === 'hidden' && part === 'stabbed' ? 1 : 2;
        },
    },
    shut: {
        kind: 'place',
        question: 'Move the middle portal until no line passes all three.',
        solution: [[9, 11.5], [9, 10]],
        figure: {
            title: 'Shut out the light.', about: 'Drag the ends of the middle portal up and down, then press Check.', box,
            handles: [{ name: 'l1', at: [9, 7.5], tone: 'left' }, { name: 'r1', at: [9, 6], tone: 'right' }],
            update(state, lab) {
                for (const i of [0, 2]) [state[`l${i}`], state[`r${i}`]] = [given[i].slice(0, 2), given[i].slice(2)];
                state.portals = heldPortals(state);
                state.conflict = lab.core.conflict(state.portals);
                state.bad = proofOf(state.conflict);
            },
            draw: (surface, camera, tones, { portals, bad }) => drawPortals(surface, camera, tones, portals, bad),
            tell: ({ portals }) => `The middle portal reaches from height ${round(portals[1][3], 2)} to ${round(portals[1][1], 2)}.`,
        },
        judge({ conflict, bad }) {
            if (conflict.verdict === 'hidden') return { right: true, text: `These ends prove it: ${bad.map(nameOf).join(', ')}. No line has them all on the right sides.` };
            if (conflict.verdict === 'grazing') return { right: false, text: 'One line is left, which touches ends. Move the portal a little further.' };
            return { right: false, text: 'A line still passes. Where do lines between the outer portals cross the middle? Leave these heights.' };
        },
    },
};
