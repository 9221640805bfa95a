/** Chapter 12: doors, mirrors, one-way glass, a view range, and what each of them costs. */
import { plural } from '../formats/words.js';
import { drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { element } from './figure.js';
import { cellAt, round, stand } from './lab.js';

/** Walls, doors, mirrors and glass of a map, as plan.js draws them. */
const itemsOf = (text) => text.split('\n').flatMap((line) => {
    const [kind, ...rest] = line.split(' ');
    if (kind === 'door') return [{ kind, name: rest[0], state: rest[5], points: rest.slice(1, 5).map(Number) }];
    return ['wall', 'walls', 'mirror', 'oneway'].includes(kind) ? [{ kind, points: rest.map(Number) }] : [];
});

const BOX = [0, 0, 20, 12];
const shell = 'sightline 1\nwalls 0 0 20 0 20 12 0 12 0 0\n';

const rooms = `${shell}wall 0 5 3 5\nwall 5 5 10 5\nwall 12 5 20 5\nwall 7 0 7 2\nwall 7 4 7 5\nwall 0 8 8 8\nwall 10 8 20 8\nwall 14 8 14 9\nwall 14 11 14 12\n`;
const doorLines = { a: '3 5 5 5', b: '10 5 12 5', c: '7 2 7 4', d: '8 8 10 8' };
const withDoors = rooms + Object.entries(doorLines).map(([name, ends]) => `door ${name} ${ends} open\n`).join('');
const doorItems = itemsOf(withDoors);

const doors = {
    title: 'Four doors.',
    about: 'The dot chooses a cell. Blue cells are seen through the doors that are open.',
    box: BOX,
    handles: [{ name: 'dot', at: [2, 2.3] }],
    controls: Object.keys(doorLines).map((name) => ({ name, label: `door ${name} is open`, kind: 'check', value: name !== 'c' })),
    update(state, lab) {
        const scene = stand(state, lab, withDoors, state.dot);
        const row = () => (state.cell < 0 ? [] : [...scene.row(state.cell)]);
        for (const name of Object.keys(doorLines)) scene.setDoor(name, true);
        state.most = row().length;
        for (const name of Object.keys(doorLines)) scene.setDoor(name, state[name]);
        state.seen = new Set(row());
        state.shut = new Set(Object.keys(doorLines).filter((name) => !state[name]));
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { space: state.scene, from: state.cell, seen: state.seen, items: doorItems, shut: state.shut }, tones);
    },
    tell: (state) => (state.cell < 0 ? 'There is no cell here.'
        : `Shut: ${[...state.shut].join(', ') || 'none'}. Cell ${state.cell} sees ${plural(state.seen.size, 'cell')}; with all doors open, ${state.most}.`),
};

const mirrorMap = `${shell}wall 8 0 8 7\nmirror 20 2 20 10\nmirror 8 11 8 12\n`, mirrorItems = itemsOf(mirrorMap);

/** What an eye sees directly, and in mirrors. */
function reflected(scene, eye, depth) {
    if (cellAt(scene, eye) < 0) return { region: null, parts: [] };
    return { region: scene.visiblePolygon(...eye), parts: depth ? scene.mirroredParts(...eye, { depth }) : [] };
}

const mirrors = {
    title: 'Two mirrors.',
    about: 'Drag the eye. The slider says how many reflections are followed. Dashed lines are where the reflected parts seem to be.',
    box: [0, 0, 34, 12],
    handles: [{ name: 'eye', at: [4, 9] }],
    controls: [
        { name: 'depth', label: 'reflections', kind: 'range', value: 1, min: 0, max: 4 },
        { name: 'images', label: 'show where they seem to be', kind: 'check', value: true },
    ],
    update(state, lab) {
        Object.assign(state, reflected(lab.scene(mirrorMap), state.eye, state.depth));
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { items: mirrorItems, region: state.region, mirrored: state.parts.map((part) => part.polygon) }, tones);
        if (state.images) strokeLines(surface, camera, state.parts.map((part) => part.image), tones.mirrored, 1.5, [6, 4], true);
    },
    tell: (state) => (state.region ? `Up to ${plural(state.depth, 'reflection')}: ${plural(state.parts.length, 'part')} seen in mirrors.`
        : 'The eye is outside the rooms.'),
};

const glassMap = (range) => `${shell}wall 10 0 10 3\noneway 10 3 10 9\nwall 10 9 10 12\n${range < 24 ? `range ${range}\n` : ''}`;
const glassItems = itemsOf(glassMap(24));

const glass = {
    title: 'One-way glass, and a view range.',
    about: 'Drag both dots. The region is that of the dot A on the right, the outline that of B. The dashed wall is glass.',
    box: BOX,
    handles: [{ name: 'a', at: [14, 6], tone: 'from' }, { name: 'b', at: [5, 7], tone: 'to' }],
    controls: [{ name: 'range', label: 'view range', kind: 'range', value: 12, min: 2, max: 24, step: 2 }],
    update(state, lab) {
        const scene = lab.scene(glassMap(state.range)), [a, b] = [state.a, state.b].map(([x, y]) => ({ x, y }));
        [state.region, state.other] = [state.a, state.b].map((eye) => (cellAt(scene, eye) < 0 ? [] : scene.visiblePolygon(...eye)));
        state.sees = scene.canSee(a, b);
        state.back = scene.canSee(b, a);
        state.far = Math.hypot(a.x - b.x, a.y - b.y);
        state.pairs = scene.account.pairs;
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { items: glassItems, region: state.region }, tones);
        if (state.other.length) strokeLines(surface, camera, [state.other], tones.to, 2, [6, 4], true);
        strokeLines(surface, camera, [[...state.a, ...state.b]], state.sees || state.back ? tones.sourceEdge : tones.faint, 2, state.sees && state.back ? [] : [4, 5]);
    },
    tell: ({ sees, back, far, range }) => `A ${sees ? 'sees' : 'does not see'} B, and B ${back ? 'sees' : 'does not see'} A. ` +
        `They are ${round(far)} m apart; ${range < 24 ? `the view range is ${range} m` : 'there is no view range'}.`,
};

const effects = {
    door: Object.entries(doorLines).map(([name, ends]) => `door ${name} ${ends} open\n`).join(''),
    mirror: 'mirror 20 5 20 8\nmirror 0 5 0 8\n',
    oneway: 'oneway 17 5 17 8\n',
    range: 'range 8\n',
};

/** The bake of a map, the least of some, in milliseconds; measured once. */
const times = new Map();
function bakeTime(lab, text) {
    if (!times.has(text)) {
        let least = Infinity;
        for (let i = 0; i < 5; i++) {
            const begin = performance.now();
            lab.core.open(text).close();
            least = Math.min(least, performance.now() - begin);
        }
        times.set(text, least);
    }
    return times.get(text);
}

function countsOf(lab, text) {
    const scene = lab.scene(text);
    let direct = 0, mirrored = 0;
    for (let i = 0; i < scene.cellCount; i++) if (scene.cellTable[6 * i + 4]) {
        direct += scene.row(i).length;
        mirrored += scene.mirrors.length ? scene.mirroredRow(i).length : 0;
    }
    return [['cells inside', scene.insideCount], ['pairs: sees directly', direct], ['pairs: by mirror', mirrored],
        ['bytes of the file', scene.slv().length], ['bake, ms', bakeTime(lab, text).toFixed(1)]];
}

const costs = {
    title: 'What each effect costs.',
    about: 'Choose effects. The table compares the map without them and with them. Drag the eye to look.',
    box: BOX,
    handles: [{ name: 'eye', at: [6, 6.5] }],
    controls: [['door', 'four doors'], ['mirror', 'two mirrors'], ['oneway', 'one-way glass'], ['range', 'view range of 8 m']]
        .map(([name, label]) => ({ name, label, kind: 'check', value: name === 'door' })),
    update(state, lab) {
        state.text = rooms + Object.keys(effects).map((name) => (state[name] ? effects[name] : '')).join('');
        state.plain = countsOf(lab, rooms);
        state.counts = countsOf(lab, state.text);
        const scene = lab.scene(state.text);
        Object.assign(state, reflected(scene, state.eye, state.mirror ? 1 : 0));
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { items: itemsOf(state.text), region: state.region, mirrored: state.parts.map((part) => part.polygon) }, tones);
    },
    beside(state) {
        const row = (cells, tag) => element('tr', {}, ...cells.map((cell) => element(tag, {}, String(cell))));
        return element('table', {}, element('thead', {}, row(['what', 'without', 'with'], 'th')),
            element('tbody', {}, ...state.counts.map(([what, value], i) => row([what, state.plain[i][1], value], 'td'))));
    },
    tell: (state) => `Effects: ${Object.keys(effects).filter((name) => state[name]).join(', ') || 'none'}. ` +
        `${state.counts.slice(0, 4).map(([what, value]) => `${what} ${value}`).join(', ')}.`,
};

export const figures = { doors, mirrors, glass, costs };

const TARGET = [10, 2];

/** Whether a polygon holds a place. */
function holds(polygon, [x, y]) {
    let isIn = false;
    for (let i = 0, j = polygon.length - 2; i < polygon.length; j = i, i += 2) {
        const [ax, ay, bx, by] = [polygon[i], polygon[i + 1], polygon[j], polygon[j + 1]];
        if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) isIn = !isIn;
    }
    return isIn;
}

export const exercises = {
    states: {
        kind: 'number',
        question: 'A map has 10 doors. Somebody stores one visible set of a cell for each state of all doors. How many sets is that for a cell?',
        right: (lab) => 2 ** lab.core.describe(shell + Array.from({ length: 10 }, (_, i) => `door d${i} ${2 * i} 4 ${2 * i + 1} 4 open\n`).join('')).doors.length,
        why: 'Each door doubles the number of states: 2 to the power of 10. So we store which doors each pair needs.',
        low: 'Doors open and shut independently of each other. Each further door doubles the number of states.',
        high: 'Each door has two states only, open and shut. Multiply the twos.',
    },
    turned: {
        kind: 'choice',
        question: 'A map gets one-way glass. What stops being true?',
        options: [
            ['A cell sees itself.', 'A cell is convex, and the glass lies on its border. Inside the cell all points still see each other.'],
            ['If cell A sees cell B, then B sees A.', 'Through the glass sight goes one way. So each direction is a question of its own, and the work grows.'],
            ['Light goes straight.', 'It still does. Glass stops light from one side, and it never bends it.'],
        ],
        right: () => 1,
    },
    corner: {
        kind: 'place',
        question: 'Somebody stands at the square behind the wall. Put the eye where it sees this place in the mirror on the right, but not directly.',
        solution: [[4, 9]],
        figure: { title: 'Around the corner.', about: 'Drag the eye, then press Check.', box: BOX, handles: [{ name: 'eye', at: [14, 4] }],
            update(state, lab) {
                state.isIn = cellAt(lab.scene(mirrorMap), state.eye) >= 0;
            },
            draw(surface, camera, tones) {
                const [x, y] = TARGET;
                drawPlan(surface, camera, { items: mirrorItems }, tones);
                fillPolygons(surface, camera, [[x - 0.3, y - 0.3, x + 0.3, y - 0.3, x + 0.3, y + 0.3, x - 0.3, y + 0.3]], tones.to);
            },
            tell: (state) => `The eye is at ${state.eye.map((v) => round(v)).join(', ')}. The square is at ${TARGET.join(', ')}.` },
        judge({ eye, isIn }, lab) {
            if (!isIn) return { right: false, text: 'The eye is outside the rooms. Put it on the floor.' };
            const scene = lab.scene(mirrorMap), [x, y] = TARGET;
            if (scene.canSee({ x: eye[0], y: eye[1] }, { x, y })) return { right: false, text: 'From there the eye sees the square directly. Go behind the wall.' };
            const isSeen = reflected(scene, eye, 1).parts.some((part) => holds(part.polygon, TARGET));
            if (isSeen) return { right: true, text: 'The wall hides the square, and one reflection shows it. The mirror image lies beyond the mirror, and a straight line leads to it.' };
            return { right: false, text: 'The wall hides the square, but no mirror shows it there. Imagine the square mirrored at the right wall, and look at it.' };
        },
    },
};
