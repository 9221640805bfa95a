/**
 * A lab: the student completes a function, and the page judges it on maps that it does not show, against the library.
 * The first map on which it fails is drawn, with a place as a counterexample.
 *
 * The judged function gives the visible region of an eye as a polygon. A place is a counterexample if the library sees it
 * from the eye and the polygon does not hold it, or the other way round. Places nearer than MARGIN to the border of the
 * region are left out: there, rounding of corners may decide. Lines that only touch walls do not count (open sight): a
 * region has no area there.
 */
import { drawDot, drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { isOn, onGrid } from './angular.js';
import { element } from './figure.js';
import { drawWalls, flat, hall, house, itemsOf, pillars, segmentsOf } from './maps.js';
import { keepPicture, picture } from './still.js';

/** How long all calls may take together, in milliseconds. */
const PATIENCE = 3000;

const [MARGIN, PLACES] = [1e-3, 200];

/** Numbers between 0 and 1, the same each time. */
function chances(seed) {
    let number = seed;
    return () => (number = (number * 48271) % 2147483647) / 2147483647;
}

const openScene = (lab, text) => lab.scene(text, { sight: 'open' });

const halls = [2, 3].map((columns) => ({ text: hall(columns), box: [0, 0, 4 * columns, 12] }));

/** Maps and eyes that the page does not show. Every other eye has coordinates of walls, so rays touch ends and lie on walls. */
export function hiddenCases(lab) {
    const chance = chances(11), cases = [];
    for (const { text, box } of [pillars, flat, house, ...halls]) {
        const items = itemsOf(text), walls = segmentsOf(items), scene = openScene(lab, text);
        for (let found = 0; found < 4;) {
            const place = [box[2] * chance(), box[3] * chance()], eye = found % 2 ? place.map((v) => Math.round(2 * v) / 2) : onGrid(place);
            const cell = scene.locate(...eye);
            if (cell < 0 || !scene.cellTable[6 * cell + 4] || walls.some((wall) => isOn(eye, wall))) continue;
            cases.push({ text, box, items, walls, eye });
            found++;
        }
    }
    return cases;
}

/** Whether a polygon holds a place (even-odd rule). @param {number[][]} polygon */
export const holds = (polygon, [x, y]) => polygon.reduce((inside, [ax, ay], i) => {
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
export function counterexample(lab, { text, box, eye }, polygon) {
    const scene = openScene(lab, text), chance = chances(5), region = [...scene.isovist(...eye).points], places = [];
    for (let i = 0; i < region.length; i += 2)
        for (const t of [0.02, -0.02]) places.push([region[i] + t * (eye[0] - region[i]), region[i + 1] + t * (eye[1] - region[i + 1])]);
    for (let i = 0; i < PLACES; i++) places.push([box[2] * chance(), box[3] * chance()]);
    const isFloor = (place) => {
        const cell = scene.locate(...place);
        return cell >= 0 && scene.cellTable[6 * cell + 4] !== 0;
    };
    for (const place of places) {
        if (!isFloor(place) || isNear(region, place)) continue;
        const isSeen = scene.canSee({ x: eye[0], y: eye[1] }, { x: place[0], y: place[1] });
        if (isSeen !== holds(polygon, place)) return { place, isSeen };
    }
    return null;
}

/** Calls the student's function beside the page. @returns {Promise<any[]>} what came of each call */
function run(code, name, calls) {
    const worker = new Worker(new URL('./code-worker.js', import.meta.url)), answers = [];
    return new Promise((resolve) => {
        const end = () => {
            worker.terminate();
            clearTimeout(timer);
            resolve(answers);
        };
        const timer = setTimeout(() => {
            answers[answers.length] = { error: `no answer within ${PATIENCE / 1000} seconds` };
            end();
        }, PATIENCE);
        worker.addEventListener('message', ({ data }) => {
            answers[data.i] = data;
            if (data.error || data.i === calls.length - 1) end();
        });
        worker.addEventListener('error', (event) => {
            answers[answers.length] = { error: event.message };
            end();
        });
        worker.postMessage({ code, name, calls });
    });
}

/** Lets the page answer between two maps. */
const breathe = () => new Promise((resolve) => setTimeout(resolve));

const isPolygon = (value) => Array.isArray(value) && value.every((p) => Array.isArray(p) && p.length === 2 && p.every(Number.isFinite));

/** The map of a case, the region that was given, and the counterexample. */
const drawing = ({ box, items, eye }, polygon, found) => (tones) => picture('A map on which the function fails', box, (surface, camera) => {
    drawPlan(surface, camera, {}, tones);
    if (polygon.length) fillPolygons(surface, camera, [polygon.flat()], tones.region);
    drawWalls(surface, camera, items, tones);
    if (found) strokeLines(surface, camera, [[...eye, ...found.place]], tones.to, 1.5, found.isSeen ? [] : [5, 4]);
    drawDot(surface, camera, eye, 7, tones.sourceEdge, tones.page);
    if (found) drawDot(surface, camera, found.place, 6, tones.to, tones.page);
}, { width: 420, most: 300 });

/** Judges code. @returns {Promise<{right: boolean, text: string, draw?: (tones: any) => Element}>} */
export async function judgeCode(code, lab) {
    const cases = hiddenCases(lab), answers = await run(code, 'region', cases.map(({ eye, walls }) => [eye, walls]));
    for (const [i, one] of cases.entries()) {
        const answer = answers[i], on = `On map ${i + 1} of ${cases.length}, which is drawn here,`, eye = `eye at ${one.eye.join(', ')}`;
        if (!answer || answer.error) return { right: false, text: `${on} the function ends with an error (${eye}): ${answer?.error ?? 'no answer'}`, draw: drawing(one, [], null) };
        if (!isPolygon(answer.value)) return { right: false, text: `${on} the function gives no list of places [x, y] with finite numbers (${eye}).`, draw: drawing(one, [], null) };
        await breathe();
        const found = counterexample(lab, one, answer.value);
        if (found) {
            const at = found.place.map((v) => Number(v.toFixed(2))).join(', '), verb = found.isSeen ? 'sees' : 'does not see';
            return { right: false, text: `${on} the ${eye} ${verb} the place ${at}. Your region says otherwise.`, draw: drawing(one, answer.value, found) };
        }
    }
    return { right: true, text: `It agrees with the library on all ${cases.length} maps, at ${PLACES} places of each and beside each corner. Many rays lie on walls or touch two ends.` };
}

/** The part of an exercise's form: the code, and where a counterexample is drawn. */
export function codePart(exercise, lab, id) {
    const area = element('textarea', { id, value: exercise.code, spellcheck: false, rows: exercise.code.split('\n').length + 2, autocapitalize: 'off', autocomplete: 'off' });
    const picture = element('figure', { className: 'counterexample', hidden: true }), again = element('button', { type: 'button' }, 'Begin anew');
    again.addEventListener('click', () => {
        area.value = exercise.code;
        area.dispatchEvent(new Event('input', { bubbles: true }));
    });
    const node = element('div', { className: 'code-part' }, element('label', { htmlFor: id }, exercise.question), area, picture, again);
    area.addEventListener('input', () => (picture.hidden = true));
    const judge = async () => {
        const { draw, ...said } = await judgeCode(area.value, lab);
        picture.hidden = !draw;
        if (draw) keepPicture(picture, draw);
        return said;
    };
    return { node, judge, read: () => area.value, write: (text) => (typeof text === 'string' ? (area.value = text) && true : false) };
}
