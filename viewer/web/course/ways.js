/** Chapter 15: shortest ways: a string pulled tight, the graph of corners, the funnel of a sequence, and intervals of portals. */
import { plural } from '../formats/words.js';
import { drawDot, drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { isOn, onGrid } from './angular.js';
import { cornerGraph, shortestWay } from './corner-graph.js';
import { groundNow, loadGround, roomsInARow, wayBetween } from './ground.js';
import { pullCode } from './lab-code.js';
import { cellAt, round } from './lab.js';
import { box, drawPortals, heldPortals } from './lines.js';
import { drawWalls, hall, house, itemsOf, segmentsOf } from './maps.js';
import { polyanya } from './polyanya.js';
import { pullLab } from './pull-lab.js';
import { lengthOf, pullString, wayOf } from './string-pull.js';

const items = itemsOf(house.text), walls = segmentsOf(items);

const straight = ([ax, ay], [bx, by]) => Math.hypot(bx - ax, by - ay);

/** Where a dot stands: on the floor, and on no wall. */
const standsOn = (scene, place, segments) => cellAt(scene, place) >= 0 && !segments.some((wall) => isOn(place, wall));

const LOST = 'A dot stands on a wall. Move it to free floor.';

/** Puts the dots on the grid. `isLost` where one stands on no floor. */
function placeDots(state, lab) {
    const scene = (state.scene = lab.scene(house.text));
    [state.a, state.b] = [onGrid(state.a), onGrid(state.b)];
    state.isLost = ![state.a, state.b].every((place) => standsOn(scene, place, walls));
    state.found = null;
}

/** The library's way between the dots. */
function askWay(state, lab, options) {
    placeDots(state, lab);
    state.trouble = state.isLost ? LOST : groundNow(house.text) ? '' : 'The figure is being loaded.';
    if (state.trouble) return;
    try {
        state.found = wayBetween(house.text, state.a, state.b, options);
        if (!state.found) state.trouble = 'No way leads from A to B for a walker of this size.';
    } catch {
        state.trouble = 'A walker of this size has no room where a dot stands.';
    }
}

const start = (figure) => loadGround().then(() => figure.change());

/** The browser compiles code for walls that grow at the first such way: before the reader moves a slider. */
const warmUp = () => setTimeout(() => wayBetween(house.text, ...dots.map(({ at }) => at), { radius: 0.05 }));

const isReady = () => Boolean(groundNow(house.text));

const dots = [{ name: 'a', at: [3, 1.5], tone: 'from', letter: 'A' }, { name: 'b', at: [14.5, 12], tone: 'to', letter: 'B' }];

const tight = {
    title: 'The shortest way.',
    about: 'Drag both dots. The slider makes the walker larger: the line is the way of its middle.',
    box: house.box,
    handles: dots,
    controls: [{ name: 'size', label: 'radius of the walker', kind: 'range', value: 0, min: 0, max: 1, step: 0.05 }],
    start: (figure) => start(figure).then(warmUp),
    isReady,
    update: (state, lab) => askWay(state, lab, state.size ? { radius: state.size } : {}),
    marks: {
        turns: ({ found }) => ({ dots: found?.way.slice(1, -1) }),
        straight: ({ a, b }) => ({ lines: [[...a, ...b]] }),
    },
    draw(surface, camera, tones, { found, a, b }) {
        drawPlan(surface, camera, { items }, tones);
        strokeLines(surface, camera, [[...a, ...b]], tones.faint, 1.5, [4, 5]);
        if (!found) return;
        strokeLines(surface, camera, [found.way.flat()], tones.sourceEdge, 3);
        for (const corner of found.way.slice(1, -1)) drawDot(surface, camera, corner, 5, tones.start, tones.page);
    },
    tell: ({ trouble, found, a, b }) => trouble || `The way is ${round(found.length, 2)} m long and turns at ${plural(found.way.length - 2, 'corner')}. ` +
        `The straight line is ${round(straight(a, b), 2)} m long.`,
};

const graph = {
    title: 'The graph of corners.',
    about: 'Edges join corners between which one can walk straight on. The slider takes nodes by Dijkstra\'s search, the nearest to A first; their shortest ways are thick.',
    box: house.box,
    handles: dots,
    controls: [
        { name: 'at', label: 'nodes taken', kind: 'range', value: 6, min: 1, max: 19, most: ({ found }) => found?.order.length ?? 1 },
        { name: 'isTangent', label: 'only tangent edges', kind: 'check', value: false },
    ],
    update(state, lab) {
        placeDots(state, lab);
        if (state.isLost) return;
        const { nodes, edges } = cornerGraph(state.a, state.b, walls);
        state.edges = edges.filter((edge) => edge.isTangent || !state.isTangent);
        state.found = { nodes, count: edges.length, ...shortestWay({ nodes, edges: state.edges }) };
        state.taken = state.found.order.slice(0, state.at);
    },
    draw(surface, camera, tones, { found, edges, taken }) {
        drawPlan(surface, camera, { items }, tones);
        if (!found) return;
        const { nodes, parents, order, way } = found, line = (i, j) => [...nodes[i].at, ...nodes[j].at];
        strokeLines(surface, camera, edges.map(({ a, b }) => line(a, b)), tones.faint, 1);
        strokeLines(surface, camera, taken.filter((i) => parents[i] >= 0).map((i) => line(i, parents[i])), tones.tree, 3);
        if (taken.length === order.length) strokeLines(surface, camera, [way.flat()], tones.sourceEdge, 4);
        for (const [i, { at }] of nodes.entries()) if (i > 1) drawDot(surface, camera, at, taken.includes(i) ? 6 : 4, taken.includes(i) ? tones.tree : tones.faint, tones.page);
    },
    tell({ isLost, found, edges, taken }) {
        if (isLost) return LOST;
        const end = taken.length < found.order.length ? '' : ` B is reached: ${round(found.length, 2)} m.`;
        return `${plural(found.nodes.length, 'node')}, ${plural(edges.length, 'edge')}${edges.length < found.count ? ` of ${found.count}` : ''}. ${taken.length} of ${plural(found.order.length, 'node')} taken.${end}`;
    },
};

/** Doors of rooms in a row, as [left x, left y, right x, right y]. */
export const doors = [[3, 10, 3, 8], [6, 5, 6, 3], [9, 9, 9, 6.5], [12, 4, 12, 2], [15, 8, 15, 5.5]];

const strings = {
    title: 'Two strings.',
    about: 'The slider takes one door after the other. The strings lead from the apex to the left end and to the right end; the way up to the apex is certain. Drag A, B and the ends of doors.',
    box,
    handles: [{ name: 'a', at: [1, 6], tone: 'from', letter: 'A' }, { name: 'b', at: [17, 4], tone: 'to', letter: 'B' },
        ...doors.flatMap(([lx, ly, rx, ry], i) => [{ name: `l${i}`, at: [lx, ly], tone: 'left' }, { name: `r${i}`, at: [rx, ry], tone: 'right' }])],
    controls: [{ name: 'at', label: 'doors', kind: 'range', value: 3, min: 1, max: 6 }],
    start,
    isReady,
    update(state) {
        state.a = onGrid([Math.min(state.a[0], 2.9), state.a[1]]);
        state.b = onGrid([Math.max(state.b[0], 15.1), state.b[1]]);
        state.portals = heldPortals(state, doors).map((ends) => ends.map((v) => onGrid([v])[0]));
        state.steps = pullString(state.a, state.b, state.portals.map(([lx, ly, rx, ry]) => ({ left: [lx, ly], right: [rx, ry] })));
        state.step = state.steps[Math.min(state.at, state.steps.length) - 1];
        state.way = wayOf(state.steps.at(-1));
        const rooms = roomsInARow(state.portals);
        state.library = groundNow(rooms) && wayBetween(rooms, state.a, state.b);
    },
    marks: {
        apex: ({ step }) => ({ dots: [step.left[0]] }),
        left: ({ step }) => ({ lines: [step.left.flat()] }),
        right: ({ step }) => ({ lines: [step.right.flat()] }),
    },
    draw(surface, camera, tones, { portals, step, way, at, steps }) {
        drawPortals(surface, camera, tones, portals);
        const { left, right } = step, isDone = at >= steps.length;
        strokeLines(surface, camera, [[...step.way.flat(), ...left[0]]], tones.sourceEdge, 4);
        if (isDone) strokeLines(surface, camera, [way.flat()], tones.sourceEdge, 4);
        else {
            strokeLines(surface, camera, [left.flat()], tones.left, 3);
            strokeLines(surface, camera, [right.flat()], tones.right, 3);
            drawDot(surface, camera, left[0], 7, tones.start, tones.page);
        }
    },
    tell({ step, steps, at, way, library }) {
        if (at < steps.length) return `After door ${at}: the apex is at ${step.left[0].map((v) => round(v)).join(', ')}. The left string has ${plural(step.left.length - 1, 'piece')}, the right one ${step.right.length - 1}.`;
        return `The way is ${round(lengthOf(way), 2)} m long and turns at ${plural(way.length - 2, 'corner')}.${library ? ` The library says ${round(library.length, 2)} m.` : ''}`;
    },
};

const intervals = {
    title: 'Roots and intervals.',
    about: 'The slider takes nodes. A node is a root, with the way to it, and the directions that pass a piece of a portal: the filled triangle.',
    box: house.box,
    handles: dots,
    controls: [{ name: 'at', label: 'node', kind: 'range', value: 5, min: 1, max: 30, most: ({ search }) => search?.steps.length ?? 1 }],
    start,
    isReady,
    update(state, lab) {
        askWay(state, lab, {});
        state.search = state.isLost ? null : polyanya(state.scene, walls, state.a, state.b);
        state.now = Math.min(state.at, state.search?.steps.length ?? 1);
        state.node = state.search?.steps[state.now - 1];
    },
    marks: {
        root: ({ node }) => ({ dots: node ? [node.root] : [] }),
        interval: ({ node }) => ({ lines: node?.piece ? [node.piece.flat()] : [] }),
    },
    draw(surface, camera, tones, { scene, search, node, now }) {
        drawPlan(surface, camera, { space: scene, from: node?.cell }, tones);
        drawWalls(surface, camera, items, tones);
        if (!node) return;
        if (node.piece) fillPolygons(surface, camera, [[...node.root, ...node.piece.flat()]], tones.region, 0.8);
        strokeLines(surface, camera, search.steps.slice(0, now).flatMap(({ piece }) => (piece ? [piece.flat()] : [])), tones.portal, 4);
        if (now === search.steps.length) strokeLines(surface, camera, [search.way.flat()], tones.sourceEdge, 4);
        else strokeLines(surface, camera, [node.roots.flat()], tones.sourceEdge, 3);
        drawDot(surface, camera, node.root, 6, tones.start, tones.page);
    },
    tell({ trouble, isLost, search, node, now, found }) {
        if (isLost || !search.way.length) return trouble;
        const end = now < search.steps.length ? '' : ` Then B is reached: ${round(search.length, 2)} m${found ? `, and the library says ${round(found.length, 2)} m` : ''}.`;
        return `Node ${now} of ${search.steps.length}: root at ${node.root.map((v) => round(v)).join(', ')}, ${round(node.length, 2)} m away. A way to B through it takes ${round(node.least, 2)} m or more.${end}`;
    },
};

export const figures = { tight, graph, strings, intervals };

/** Numbers of the text: the graph of the widest hall, from corner to corner, and what both searches take there. */
const COLUMNS = 4, ends = [[0.25, 0.25], [15.75, 11.75]];
let wide = null;
function wideHall(lab) {
    if (wide) return wide;
    const text = hall(COLUMNS), segments = segmentsOf(itemsOf(text)), all = cornerGraph(...ends, segments);
    const tangent = all.edges.filter(({ isTangent }) => isTangent), scene = lab.scene(text);
    return (wide = { corners: all.nodes.length - 2, edges: all.edges.length, tangent: tangent.length, taken: shortestWay({ ...all, edges: tangent }).order.length,
        nodes: polyanya(scene, segments, ...ends).steps.length, cells: scene.insideCount });
}

export const values = Object.fromEntries(['corners', 'edges', 'tangent', 'taken', 'nodes', 'cells'].map((name) => [name, (lab) => wideHall(lab)[name]]));

const tip = { text: `sightline 1\nwalls 0 0 20 0 20 12 0 12 0 0\nwall 10 0 10 9\n`, a: [4, 1], b: [13, 5] };

export const exercises = {
    around: {
        kind: 'number',
        question: 'A room is 20 m wide and 12 m deep. A wall leads from 10, 0 to 10, 9. How long is the shortest way from 4, 1 to 13, 5, in metres?',
        async right() {
            await loadGround();
            return wayBetween(tip.text, tip.a, tip.b).length;
        },
        why: 'The way turns at the end of the wall, 10, 9. To there it is 10 m (6 across, 8 up), and from there 5 m (3 across, 4 down).',
        low: 'A shorter way would cut the wall. Where does a tight string touch it?',
        high: 'Pull the string tighter: it touches the wall at one point only.',
    },
    turns: {
        kind: 'choice',
        question: 'At which places may a shortest way turn?',
        options: [
            ['At the middle of a doorway.', 'A way that turns in the open can be cut short: join a place before the turn with a place behind it.'],
            ['At corners of walls where the free angle is wider than half a turn.', 'The string lies against such a corner, and the wall keeps it from moving on. In the open, or in a corner of a room, nothing holds it.'],
            ['At any corner of a wall, those of rooms as well.', 'A string that is pulled tight leaves the corner of a room at once. Only corners that jut into the floor hold it.'],
        ],
        right: () => 1,
    },
    far: {
        kind: 'place',
        question: 'Put A and B so that the shortest way is at least four times as long as the straight line.',
        solution: [[13.5, 1], [14.5, 1]],
        figure: { ...tight, title: 'Near, and yet far.', about: 'Drag both dots, then press Check.', controls: undefined, start,
            update: (state, lab) => askWay(state, lab, {}),
            draw: (surface, camera, tones) => drawPlan(surface, camera, { items }, tones),
            tell: ({ trouble, a, b }) => trouble || `The straight line is ${round(straight(a, b), 2)} m long.` },
        async judge({ a, b, isLost }) {
            if (isLost) return { right: false, text: 'A dot stands on a wall, or both stand outside. Put them on the floor.' };
            if (straight(a, b) === 0) return { right: false, text: 'Both dots stand at the same place, so there is no way to walk.' };
            await loadGround();
            const { length } = wayBetween(house.text, a, b), times = length / straight(a, b), said = `The way is ${round(length, 2)} m long, ${round(times, 2)} times the straight line.`;
            if (times >= 4) return { right: true, text: `${said} On two sides of a wall, the way must go around its end.` };
            return { right: false, text: `${said} What lies between two places that are near each other?` };
        },
    },
    pull: {
        kind: 'code',
        lab: pullLab,
        question: 'Complete the function. It gives the corners of the shortest way through a row of doors.',
        code: pullCode.text,
    },
};
