/**
 * Lab one, for code-lab.js: the visible region of an eye as a polygon.
 *
 * A place is a counterexample if the library sees it from the eye and the polygon does not hold it, or the other way
 * round. Places nearer than MARGIN to the border of the region are left out: there, rounding of corners may decide. Lines
 * that only touch walls do not count (open sight): a region has no area there. Some plans are TIMES as large, and MARGIN is
 * not: there a ray that goes astray by a hundred millionth of a radian leaves it.
 */
import { drawDot, drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { isOn, onGrid } from './angular.js';
import { chances, hiddenPlans } from './code-lab.js';
import { cellAt } from './lab.js';
import { drawWalls } from './maps.js';
import { picture } from './still.js';
import { largerPlan } from './turned.js';

const [MARGIN, PLACES, TIMES] = [1e-3, 200, 2 ** 14];

const openScene = (lab, text) => lab.scene(text, { sight: 'open' });

/** Maps and eyes. Every other eye has coordinates of walls, so rays touch ends and lie on walls. */
function cases(lab) {
    const chance = chances(11), list = [], plans = hiddenPlans(), [columns, flat] = plans;
    for (const [plan, unit] of [...plans.map((each) => [each, 1]), ...[columns, flat].map((each) => [largerPlan(each, TIMES), TIMES])]) {
        const { text, box, walls } = plan, scene = openScene(lab, text);
        for (let found = 0; found < 4;) {
            const place = [2, 3].map((k) => (box[k] / unit) * chance()), eye = (found % 2 ? place.map((v) => Math.round(2 * v) / 2) : onGrid(place)).map((v) => unit * v);
            if (cellAt(scene, eye) < 0 || walls.some((wall) => isOn(eye, wall))) continue;
            list.push({ ...plan, eye, given: [eye, walls], about: `eye at ${eye.join(', ')}` });
            found++;
        }
    }
    return list;
}

/** Whether a polygon holds a place (even-odd rule). @param {number[][]} polygon */
const holds = (polygon, [x, y]) => polygon.reduce((inside, [ax, ay], i) => {
    const [bx, by] = polygon[(i + 1) % polygon.length];
    return (ay > y) !== (by > y) && x < ax + ((y - ay) / (by - ay)) * (bx - ax) ? !inside : inside;
}, false);

function isNear(points, [x, y]) {
    for (let i = 0; i < points.length; i += 2) {
        const [ax, ay] = [points[i], points[i + 1]], [bx, by] = [points[(i + 2) % points.length], points[(i + 3) % points.length]];
        const length = (bx - ax) ** 2 + (by - ay) ** 2, t = length && Math.min(1, Math.max(0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length));
        if (Math.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay)) < MARGIN) return true;
    }
    return false;
}

/** A place where a polygon and the library differ; null if none is found. */
function counterexample(lab, { text, box, eye }, polygon) {
    const scene = openScene(lab, text), chance = chances(5), region = [...scene.isovist(...eye).points], places = [];
    for (let i = 0; i < region.length; i += 2)
        for (const t of [0.02, -0.02]) places.push([region[i] + t * (eye[0] - region[i]), region[i + 1] + t * (eye[1] - region[i + 1])]);
    for (let i = 0, n = region.length; i < n; i += 2) {
        const [ax, ay, bx, by] = [0, 1, 2, 3].map((k) => region[(i + k) % n]), length = Math.hypot(bx - ax, by - ay);
        for (const t of [0.1, 0.9]) for (const far of [2 * MARGIN, -2 * MARGIN].map((v) => v / length)) places.push([ax + t * (bx - ax) - far * (by - ay), ay + t * (by - ay) + far * (bx - ax)]);
    }
    for (let i = 0; i < PLACES; i++) places.push([box[2] * chance(), box[3] * chance()]);
    for (const place of places) {
        if (cellAt(scene, place) < 0 || isNear(region, place)) continue;
        const isSeen = scene.canSee({ x: eye[0], y: eye[1] }, { x: place[0], y: place[1] });
        if (isSeen !== holds(polygon, place)) return { place, isSeen };
    }
    return null;
}

/** The map of a case, the region that was given, and the counterexample. */
const drawing = ({ box, items, eye }, polygon, found) => (tones) => picture('A map on which the function fails', box, (surface, camera) => {
    drawPlan(surface, camera, {}, tones);
    if (polygon.length) fillPolygons(surface, camera, [polygon.flat()], tones.region);
    drawWalls(surface, camera, items, tones);
    if (found) strokeLines(surface, camera, [[...eye, ...found.place]], tones.to, 1.5, found.isSeen ? [] : [5, 4]);
    drawDot(surface, camera, eye, 7, tones.sourceEdge, tones.page);
    if (found) drawDot(surface, camera, found.place, 6, tones.to, tones.page);
}, { width: 420, most: 300 });

/** @type {import('./code-lab.js').CodeLab} */
export const regionLab = {
    call: 'region',
    gives: 'list of places [x, y] with finite numbers',
    cases,
    isAnswer: (value) => Array.isArray(value) && value.every((p) => Array.isArray(p) && p.length === 2 && p.every(Number.isFinite)),
    draw: (one) => drawing(one, [], null),
    judge(lab, one, polygon) {
        const found = counterexample(lab, one, polygon);
        if (!found) return null;
        const at = found.place.map((v) => Number(v.toFixed(2))).join(', '), verb = found.isSeen ? 'sees' : 'does not see';
        return { text: `the ${one.about} ${verb} the place ${at}. Your region says otherwise.`, draw: drawing(one, polygon, found) };
    },
    right: (count) => `It agrees with the library on all ${count} maps, at ${PLACES} places of each and beside each corner and edge. Many rays lie on walls or touch two ends, and some maps are as large as a country.`,
};
