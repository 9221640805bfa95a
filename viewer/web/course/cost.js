/** What accuracy costs: all methods of the package on one map, a chart of time against pairs, and where they differ. */
import { parseMap, writeMap } from '../formats/map-text.js';
import { plural } from '../formats/words.js';
import { drawDot, drawPlan, strokeLines } from '../parts/plan.js';
import { element, table } from './figure.js';
import { cellAt, round, stand } from './lab.js';
import { drawWalls, itemsOf, plans } from './maps.js';
import { mapNamed } from './own.js';

/** The sweep comes first: the others are compared with it. */
export const methods = [
    { name: 'sweep', options: { method: 'sweep' } },
    { name: 'flood', options: { method: 'flood' } },
    { name: 'prune', options: { method: 'prune' } },
    { name: 'multipass', options: { method: 'multipass' } },
    { name: 'dfs', options: { method: 'dfs' } },
    { name: 'one eye', options: {}, isEye: true },
    { name: '10 lines', options: { method: 'sampling', samples: 10 } },
    { name: '100 lines', options: { method: 'sampling', samples: 100 } },
    { name: '1000 lines', options: { method: 'sampling', samples: 1000 } },
];

/** After this many seconds a method is stopped. */
const LIMIT = 10;

const standing = new Map();

/** A map with its doors as they stand, as walls or nothing: some methods know no others, and all shall have one map. */
function standingText(text) {
    if (!standing.has(text))
        standing.set(text, !/^\s*door\b/m.test(text) ? text : writeMap(parseMap(text).flatMap((item) =>
            (item.kind !== 'door' ? [item] : item.state === 'shut' ? [{ kind: 'wall', points: item.points }] : []))));
    return standing.get(text);
}

const planOf = (value) => {
    const { text, box } = mapNamed(value);
    return { text: standingText(text), box };
};

/** By map text: what was found so far. One job runs at a time; those that no figure shows any more are dropped. */
const jobs = new Map(), figuresHere = new Set();

function tellFigures() {
    for (const figure of figuresHere) figure.change();
}

/** Drops what no figure shows, and starts the next job. */
function goOn() {
    const wanted = new Set([...figuresHere].map((figure) => planOf(figure.state.plan).text));
    for (const [text, job] of jobs)
        if (!job.done && !wanted.has(text)) {
            job.worker?.terminate();
            jobs.delete(text);
        }
    const open = [...jobs].filter(([, job]) => !job.done);
    if (open.length && !open.some(([, job]) => job.worker)) start(...open[0]);
}

function start(text, job) {
    const end = (trouble) => {
        job.worker.terminate();
        Object.assign(job, { done: true, trouble });
        goOn();
        tellFigures();
    };
    job.worker = new Worker(new URL('./cost-worker.js', import.meta.url), { type: 'module' });
    job.worker.onerror = (event) => end(`The methods cannot be run: ${event.message}`);
    job.worker.onmessage = ({ data }) => {
        if (data.done) return end('');
        job.results[data.number] = data;
        tellFigures();
    };
    job.worker.postMessage({ text, methods, seconds: LIMIT });
}

/** The results for a map, as far as they are there. */
function resultsOf(text) {
    if (!jobs.has(text)) jobs.set(text, { results: methods.map(() => null), done: false, trouble: '', worker: null });
    goOn();
    return jobs.get(text);
}

const milliseconds = (seconds) => (seconds < 1e-3 ? (1000 * seconds).toFixed(2) : String(Number((1000 * seconds).toPrecision(3))));

/** A mark by guarantee: exact is a circle, conservative points up, aggressive down. */
function mark(surface, guarantee, x, y, size) {
    surface.beginPath();
    if (guarantee === 'conservative' || guarantee === 'aggressive') {
        const up = guarantee === 'conservative' ? -1 : 1;
        surface.moveTo(x, y + 1.25 * up * size);
        surface.lineTo(x - 1.2 * size, y - 0.85 * up * size);
        surface.lineTo(x + 1.2 * size, y - 0.85 * up * size);
        surface.closePath();
    } else surface.arc(x, y, size, 0, 2 * Math.PI);
    surface.fill();
    surface.stroke();
}

/** Places of the results in the chart, in pixels; those that would lie on one another move up. */
export function placesOf(points, width, height) {
    const [left, right, top, bottom] = [48, width - 24, 46, height - 44], times = points.map((p) => Math.log10(Math.max(p.seconds, 1e-6)));
    const shares = points.map((p) => p.share), low = Math.min(90, ...shares.map((share) => share - 3)), high = Math.max(101, ...shares) + 1;
    const [t0, t1] = [Math.floor(Math.min(-4, ...times)), Math.ceil(Math.max(-2, ...times))];
    const x = (t) => left + ((t - t0) / (t1 - t0)) * (right - left), y = (share) => bottom - ((share - low) / (high - low)) * (bottom - top);
    const marks = [];
    points.forEach((p, i) => {
        const place = { ...p, x: x(times[i]), y: y(p.share) };
        place.markY = place.y;
        while (marks.some((m) => Math.hypot(m.x - place.x, m.markY - place.markY) < 24)) place.markY -= 8;
        marks.push(place);
    });
    return { marks, x, y, low, high, t0, t1, left, right, top, bottom };
}

const timeNames = { '-6': '1 µs', '-5': '10 µs', '-4': '0.1 ms', '-3': '1 ms', '-2': '10 ms', '-1': '0.1 s', 0: '1 s', 1: '10 s' };

function drawAxes(surface, chart, tones) {
    const { x, y, low, high, t0, t1, left, right, top, bottom } = chart;
    surface.strokeStyle = tones.outline;
    surface.lineWidth = 1;
    surface.fillStyle = tones.ink;
    surface.font = `${right > 800 ? 15 : 12}px system-ui, sans-serif`;
    surface.textAlign = 'center';
    const line = (x0, y0, x1, y1) => {
        surface.beginPath();
        surface.moveTo(x0, y0);
        surface.lineTo(x1, y1);
        surface.stroke();
    };
    for (let t = t0; t <= t1; t++) {
        line(x(t), top, x(t), bottom);
        surface.fillText(timeNames[t] ?? `10^${t} s`, x(t), bottom + 16);
    }
    surface.fillText('time of one run', (left + right) / 2, bottom + 34);
    surface.textAlign = 'right';
    const step = high - low > 60 ? 20 : high - low > 25 ? 10 : 5;
    for (let share = Math.ceil(low / step) * step; share <= high; share += step) {
        surface.strokeStyle = share === 100 ? tones.ink : tones.outline;
        surface.lineWidth = share === 100 ? 2 : 1;
        line(left, y(share), right, y(share));
        surface.fillText(`${share} %`, left - 5, y(share) + 4);
    }
    surface.textAlign = 'left';
    surface.fillText('pairs found, of the exact ones', 8, 16);
}

/** What the chart shows: the methods that answered, by their share of the exact pairs. */
function pointsOf(results) {
    const all = results[0]?.pairs;
    return results.flatMap((r, i) => (r && !r.refused && all !== undefined ? [{ ...r, number: i + 1, share: all ? (100 * r.pairs) / all : 100 }] : []));
}

/**
 * Times for handouts, in milliseconds, so that all of them agree: of the plan hall, by method. They are the
 * least ones of eight loads of this page, in Chromium 156 on a virtual machine.
 */
const hallTimes = [0.48, 0.17, 0.77, 1, 2.2, 1.11, 0.28, 2.55, 44];

const chart = {
    title: 'What accuracy costs, on your map.',
    about: 'Numbers are those of the table. Circles are exact, triangles that point up conservative, those that point down aggressive. A press on one, or the slider, chooses it.',
    box: [0, 0, 1, 1],
    handles: [],
    wide: true,
    controls: [
        { name: 'plan', label: 'plan', kind: 'map', value: 'hall' },
        { name: 'shown', label: 'method', kind: 'range', value: 1, min: 1, max: methods.length },
    ],
    start: (figure) => figuresHere.add(figure),
    isReady: ({ job }) => job.done,
    press(state, [x, y], { width, height }) {
        const far = (m) => Math.hypot(m.x - x, m.markY - y), marks = placesOf(state.points, width, height).marks.filter((m) => far(m) < 28);
        if (marks.length) state.shown = marks.reduce((best, m) => (far(m) < far(best) ? m : best)).number;
    },
    update(state) {
        state.job = resultsOf(planOf(state.plan).text);
        state.points = pointsOf(state.job.results);
    },
    paper(state) {
        const { results, done } = state.job;
        if (state.plan !== 'hall' || !done) return state;
        const stored = results.map((r, i) => ({ ...r, seconds: hallTimes[i] / 1000 }));
        return { ...state, isStored: true, job: { ...state.job, results: stored }, points: pointsOf(stored) };
    },
    draw(surface, camera, tones, state) {
        const { width, height } = camera, chart = placesOf(state.points, width, height);
        surface.fillStyle = tones.floor[0];
        surface.fillRect(0, 0, width, height);
        drawAxes(surface, chart, tones);
        for (const m of chart.marks) {
            const place = camera.toMap(m.x, m.y);
            if (m.markY !== m.y) strokeLines(surface, camera, [[...place, ...camera.toMap(m.x, m.markY)]], tones.ink, 1);
            drawDot(surface, camera, place, 3, tones.ink, tones.page);
            surface.fillStyle = tones.guarantees[m.guarantee];
            surface.strokeStyle = m.number === state.shown ? tones.ink : tones.page;
            surface.lineWidth = m.number === state.shown ? 4 : 1.5;
            mark(surface, m.guarantee, m.x, m.markY, 10);
            surface.fillStyle = tones.dark ? '#12151a' : '#ffffff';
            surface.font = 'bold 12px system-ui, sans-serif';
            surface.textAlign = 'center';
            surface.fillText(String(m.number), m.x, m.markY + 4);
        }
    },
    beside({ job: { results } }) {
        const rows = methods.map(({ name }, i) => {
            const r = results[i];
            if (!r) return [`${i + 1}. ${name}`, '...', '', '', '', ''];
            if (r.refused) return [`${i + 1}. ${name}`, r.refused, '', '', '', ''];
            return [`${i + 1}. ${name}`, r.guarantee, milliseconds(r.seconds), r.pairs, r.missed.length, r.added.length];
        });
        return element('div', { className: 'table', role: 'group', 'aria-label': 'Methods', tabIndex: 0 }, table(['method', 'guarantee', 'ms', 'pairs', 'missed', 'added'], rows));
    },
    tell(state) {
        const { job: { results, done, trouble } } = state, r = results[state.shown - 1], ready = results.filter(Boolean).length;
        const { name } = methods[state.shown - 1], run = state.isStored ? 'Times are of one machine.' : done ? 'All methods have run.' : ready < methods.length ? `${ready} of ${methods.length} methods have run.` : 'All run again, for better times.';
        if (trouble) return trouble;
        if (!r) return `${run} ${name}: not yet.`;
        if (r.refused) return `${run} ${name}: ${r.refused}.`;
        return `${run} ${name}: ${r.guarantee}, ${milliseconds(r.seconds)} ms, ${plural(r.pairs, 'pair')}; ${r.missed.length} missed, ${r.added.length} added.`;
    },
};

/** What a method says of one cell, from the exact set and where the method differs. */
function differences({ missed, added }, cell, cellCount) {
    const of = (pairs) => pairs.filter((pair) => Math.floor(pair / cellCount) === cell).map((pair) => pair % cellCount);
    return { missed: of(missed), added: of(added) };
}

const where = {
    title: 'Where does it differ?',
    about: 'The dot chooses a cell. Blue cells are found by the method of the list. Dashed ones are seen, but missed; those with a full outline are added.',
    box: plans.hall.box,
    handles: [{ name: 'dot', at: [1, 6] }],
    controls: [
        { name: 'plan', label: 'plan', kind: 'map', value: 'hall' },
        { name: 'method', label: 'method', kind: 'choice', value: '6', options: methods.map(({ name }, i) => [String(i), name]) },
    ],
    start: (figure) => figuresHere.add(figure),
    update(state, lab) {
        const { text, box } = planOf(state.plan), [x0, y0, x1, y1] = box;
        if (state.box && state.box !== box) state.dot = [x0 + 0.1 * (x1 - x0), y0 + 0.5 * (y1 - y0)];
        state.box = box;
        state.items = state.text === text ? state.items : parseMap(text);
        state.text = text;
        const scene = stand(state, lab, text, state.dot), number = Number(state.method);
        state.result = resultsOf(text).results[number];
        state.name = methods[number].name;
        const row = state.cell < 0 ? [] : [...scene.row(state.cell)];
        const isReady = state.cell >= 0 && state.result && !state.result.refused;
        Object.assign(state, isReady ? differences(state.result, state.cell, scene.cellCount) : { missed: [], added: [] });
        state.exact = row.length;
        state.seen = new Set(isReady ? [...row.filter((cell) => !state.missed.includes(cell)), ...state.added] : []);
    },
    draw(surface, camera, tones, state) {
        const outlines = (cells) => cells.map((cell) => state.scene.corners(cell));
        drawPlan(surface, camera, { space: state.scene, from: state.cell, seen: state.seen, items: state.items }, tones);
        strokeLines(surface, camera, outlines(state.missed), tones.guarantees.aggressive, 3, [5, 3], true);
        strokeLines(surface, camera, outlines(state.added), tones.guarantees.conservative, 3, [], true);
    },
    tell({ cell, result, name, exact, seen, missed, added }) {
        if (cell < 0) return 'The dot is in no cell.';
        if (!result) return `${name}: not run yet.`;
        if (result.refused) return `${name}: ${result.refused}.`;
        return `Cell ${cell} sees ${plural(exact, 'cell')}, itself included. ${name}: ${seen.size} found, ${missed.length} missed, ${added.length} added.`;
    },
};

export const figures = { chart, where };

/** The pairs that a method finds, as the command `compare` counts them. */
const pairsFound = (lab, text, options) => lab.scene(text, options).account.pairs;

/** Numbers of the text: the percentage of pairs that flood adds to the exact ones. */
const added = (plan) => (lab) => {
    const [flood, exact] = ['flood', 'sweep'].map((method) => pairsFound(lab, plans[plan].text, { method }));
    return round(100 * (flood / exact - 1), 1);
};
export const values = { 'flood-hall': added('hall'), 'flood-rooms': added('rooms') };

const hallText = plans.hall.text;

export const exercises = {
    safe: {
        kind: 'choice',
        question: 'A game draws only what the visible set of the eye\'s cell has. Nothing may vanish from the picture. Which guarantees will do?',
        options: [
            ['Exact only.', 'An exact set is safe. But a set that is too large is safe too: the game draws more than it must, and the picture is the same.'],
            ['Exact or conservative.', 'Neither misses a cell that is seen. A conservative set costs time when the game draws, and may save time when it is computed.'],
            ['Aggressive, with enough samples.', 'More samples miss less, but no number of samples promises that nothing is missed.'],
        ],
        right(lab) {
            const [flood, exact, few] = ['flood', 'sweep', 'sampling'].map((method) => pairsFound(lab, hallText, { method, ...(method === 'sampling' ? { samples: 10 } : {}) }));
            return flood >= exact && few < exact ? 1 : -1;
        },
    },
    added: {
        kind: 'number',
        question: 'The chart begins with the plan hall. How many pairs does flood add there in which the first cell does not see the second?',
        right: (lab) => pairsFound(lab, hallText, { method: 'flood' }) - pairsFound(lab, hallText, { method: 'sweep' }),
        why: 'Flood asks only whether each two portals of a sequence can be passed by one line. For these pairs all of them can, two by two, but not all together.',
        low: 'Flood is conservative: it finds more pairs than there are. Look at the last column of the table.',
        high: 'Take the pairs of flood, less the pairs of an exact method.',
    },
    misses: {
        kind: 'place',
        question: 'Ten random lines from each cell miss something. Put the dot into a cell for which nothing is missed.',
        solution: [[4, 6.3]],
        figure: { title: 'A cell that is easy to see.', about: 'Drag the dot, then press Check.', box: plans.hall.box, handles: [{ name: 'dot', at: [6, 6] }],
            update: (state, lab) => stand(state, lab, hallText, state.dot),
            draw(surface, camera, tones, state) {
                drawPlan(surface, camera, { space: state.scene, from: state.cell }, tones);
                drawWalls(surface, camera, itemsOf(hallText), tones);
            },
            tell: (state) => (state.cell < 0 ? 'The dot is in no cell.' : `The dot is in cell ${state.cell}.`) },
        judge({ dot }, lab) {
            const cell = cellAt(lab.scene(hallText), dot);
            if (cell < 0) return { right: false, text: 'The dot is in no cell. Put it on the floor.' };
            const few = lab.scene(hallText, { method: 'sampling', samples: 10 }).row(cell).length, all = lab.scene(hallText).row(cell).length;
            const said = `Ten lines a cell find ${few} of the ${plural(all, 'cell')} that this one sees, itself included: ${round((100 * few) / all)} %.`;
            return { right: few === all, text: few === all ? `${said} Large cells are met by many lines.` : `${said} Narrow cells and long ways are easily missed.` };
        },
    },
};
