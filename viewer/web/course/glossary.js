/**
 * The glossary: a small picture for each term. A picture has words, a box of the map, and draws with what
 * the library computes. Several are figures of chapters in a chosen state.
 */
import { t } from '../language/language.js';
import { dualFigure } from '../parts/dual.js';
import { drawDot, drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { cornerGraph, shortestWay } from './corner-graph.js';
import { figures as effects } from './effects.js';
import { figures as frames } from './frames.js';
import { drawHull, figures as hidden } from './hidden.js';
import { cellAt, middleOf, planLine } from './lab.js';
import { drawPortals, given, figures as lines, side } from './lines.js';
import { drawText, drawWalls, flat, house, itemsOf, pillars, segmentsOf } from './maps.js';
import { figures as program } from './program.js';
import { figures as regions } from './regions.js';
import { figures as rooms } from './rooms.js';
import { figures as search } from './search.js';
import { drawFigure, firstState, keepPicture, picture } from './still.js';
import { pullString } from './string-pull.js';
import { figures as view } from './view.js';
import { doors } from './ways.js';

export const figures = {}, exercises = {};

const items = { flat: itemsOf(flat.text), house: itemsOf(house.text), pillars: itemsOf(pillars.text) };
const blank = [0, 0, 18, 12];

/** A plan with what `scene` has, its walls on top. */
function drawMap(p, name, scene = {}) {
    drawPlan(p.surface, p.camera, scene, p.tones);
    drawWalls(p.surface, p.camera, items[name], p.tones);
}

const stroke = (p, list, tone, width = 2, dash = [], closed = false) => strokeLines(p.surface, p.camera, list, p.tones[tone], width, dash, closed);
const dot = (p, at, tone = 'sourceEdge', radius = 5) => drawDot(p.surface, p.camera, at, radius, p.tones[tone], p.tones.page);
const say = (p, at, text) => drawText(p.surface, p.camera, at, text, p.tones);

/** The visible region of a place, with its eye. */
function drawLook(p, at, options, text = flat.text) {
    const look = p.lab.scene(text).isovist(...at, options);
    drawMap(p, 'flat', { region: look.polygon, eye: at });
    return look;
}

/** A figure of a chapter; `change` goes over its first state. */
const figure = (words, spec, change = {}) => [words, spec.box, (p) => {
    const state = Object.assign(firstState(spec), change);
    spec.update(state, p.lab);
    drawFigure(p.surface, p.camera, p.tones, spec, state);
}];

const bareGround = (p) => drawPlan(p.surface, p.camera, {}, p.tones);

/** The lower or the upper chain of points from left to right: a string that is pulled tight. */
function chain(points, sign) {
    const tight = [];
    for (const q of points) {
        while (tight.length > 1 && sign * side(tight.at(-2), tight.at(-1), ...q) <= 0) tight.pop();
        tight.push(q);
    }
    return tight;
}

/** The cells that a method keeps for cell 7 of the house: blue, with a ring where it errs. */
const guarantee = (words, options) => [words, house.box, (p) => {
    const cell = 7, seen = new Set(p.lab.scene(house.text, options).row(cell)), truth = new Set(p.lab.scene(house.text).row(cell));
    const space = p.lab.scene(house.text), wrong = [...seen, ...truth].filter((other) => seen.has(other) !== truth.has(other));
    drawMap(p, 'house', { space, from: cell, seen });
    for (const other of wrong) dot(p, middleOf(space, other), 'start', 8);
}];

const grazes = [[4, 6, 4, 2], [9, 10, 9, 6], [14, 6, 14, 2]];
const corridor = [[3, 9, 3, 4], [7, 8, 7, 3], [11, 9, 11, 6], [15, 10, 15, 5]];
const upright = (portals) => ({ left: portals.map((q) => q.slice(0, 2)), right: portals.map((q) => q.slice(2)) });

/** Corners of the pillars. */
const corners = [4, 5, 11, 12].flatMap((x) => [3, 4, 8, 9].map((y) => [x, y]));

/** Names as in glossary.md: what is to be seen, the box of the map, and how it is drawn; without a box, an SVG. */
export const pictures = {
    sees: ['A full line joins A and B. A wall cuts the dashed line from A to C.', flat.box, (p) => {
        const [a, b, c] = [[3, 6.5], [17, 7], [12, 2]], sees = (q) => p.lab.scene(flat.text).canSee({ x: a[0], y: a[1] }, { x: q[0], y: q[1] });
        drawMap(p, 'flat');
        for (const q of [b, c]) stroke(p, [[...a, ...q]], sees(q) ? 'sourceEdge' : 'faint', sees(q) ? 3 : 1.5, sees(q) ? [] : [4, 4]);
        for (const [q, name] of [[a, 'A'], [b, 'B'], [c, 'C']]) {
            dot(p, q);
            say(p, [q[0] + (q === b ? 1.3 : -1.3), q[1]], name);
        }
    }],
    region: ['The area that an eye in a corridor sees.', flat.box, (p) => drawLook(p, [5, 6.5])],
    occluding: ['The same area; the edges that go through open air are dashed.', flat.box, (p) => {
        const { points, edges } = drawLook(p, [5, 6.5]), n = points.length;
        const open = edges.flatMap((edge, i) => (edge === 'occluding' ? [[points[2 * i], points[2 * i + 1], points[(2 * i + 2) % n], points[(2 * i + 3) % n]]] : []));
        stroke(p, open, 'glass', 3, [6, 4]);
    }],
    cone: ['An eye that looks to the right sees the part of the area within its cone.', flat.box, (p) => drawLook(p, [2, 6.5], { heading: 0, fov: 60 })],
    range: ['The area ends in an arc around the eye.', flat.box, (p) => drawLook(p, [8, 6.5], { range: 5 })],

    cell: ['A plan cut into cells; one of them is marked.', flat.box, (p) => drawMap(p, 'flat', { space: p.lab.scene(flat.text), from: 3, show: { portals: false } })],
    convex: ['In a rectangle a segment stays inside. In an L it may leave the shape.', blank, (p) => {
        const shapes = [[1, 2, 7, 2, 7, 10, 1, 10], [10, 2, 17, 2, 17, 5, 13, 5, 13, 10, 10, 10]];
        bareGround(p);
        fillPolygons(p.surface, p.camera, shapes, p.tones.floor[0]);
        stroke(p, shapes, 'wall', 2, [], true);
        stroke(p, [[2, 3, 6, 9]], 'sourceEdge', 3);
        stroke(p, [[11, 9, 16, 4]], 'faint', 2, [4, 4]);
        for (const q of [[2, 3], [6, 9], [11, 9], [16, 4]]) dot(p, q);
    }],
    portal: ['A cell; the open parts of its sides are thick.', flat.box, (p) => {
        const space = p.lab.scene(flat.text), cell = cellAt(space, [10, 6.5]);
        drawMap(p, 'flat', { space, from: cell, show: { portals: false } });
        stroke(p, space.cell(cell).portals.map(({ left, right }) => [left, right].flatMap((q) => ('x' in q ? [q.x, q.y] : q))), 'portal', 6);
    }],
    axial: ['A room along the axes, and the same room turned.', blank, (p) => {
        bareGround(p);
        stroke(p, [[1, 3, 7, 3, 7, 9, 1, 9], [13, 1.5, 17, 5.5, 13, 9.5, 9, 5.5]], 'wall', 3, [], true);
    }],
    tree: figure('A house cut by dashed lines, one after the other.', rooms.tree, { most: 5 }),
    spanning: ['A box with a wall from side to side, and one with a wall that ends inside.', blank, (p) => {
        bareGround(p);
        stroke(p, [[1, 2, 8, 2, 8, 10, 1, 10], [10, 2, 17, 2, 17, 10, 10, 10]], 'outline', 2, [], true);
        stroke(p, [[1, 6, 8, 6], [10, 6, 14, 6]], 'wall', 4);
        stroke(p, [[14, 6, 17, 6]], 'portal', 3, [5, 4]);
    }],
    mesh: figure('A turned plan whose cells have oblique sides.', rooms.oblique),

    sequence: ['Portals between two rooms, numbered in the order in which a line passes them.', house.box, (p) => {
        const space = p.lab.scene(house.text), why = space.explain(0, 10);
        drawMap(p, 'house', { space, from: 0, to: 10, show: { portals: false } });
        for (const [i, { left, right }] of (why.sequence ?? []).entries()) {
            stroke(p, [[...left, ...right]], 'portal', 5);
            say(p, [(left[0] + right[0]) / 2 + 0.8, (left[1] + right[1]) / 2 + 0.8], String(i + 1));
        }
    }],
    directed: ['An arrow crosses a portal to the right. L is above, R below.', blank, (p) => {
        drawPortals(p.surface, p.camera, p.tones, [[9, 9, 9, 3]]);
        stroke(p, [[3, 6, 15, 6], [13.5, 7, 15, 6, 13.5, 5]], 'sourceEdge', 3);
    }],
    sightline: figure('A line of sight between two cells of a plan.', lines.cells),
    stabs: ['A line passes three portals: left ends above it, right ends below.', blank, (p) => {
        drawPortals(p.surface, p.camera, p.tones, given);
        stroke(p, [planLine(p.lab.core.dual(given), p.lab.core.dual(given).best)], 'sourceEdge', 3);
    }],
    grazing: ['The only line through three portals touches an end of each.', blank, (p) => {
        const is = p.lab.core.conflict(grazes).verdict;
        if (is !== 'grazing') throw new Error(`the picture of grazing is ${is}`);
        drawPortals(p.surface, p.camera, p.tones, grazes);
        stroke(p, [[0, 6, 18, 6]], 'sourceEdge', 3);
    }],
    orientation: ['A line from a to b; p lies on its left and q on its right.', blank, (p) => {
        const [a, b, left, right] = [[3, 3], [15, 8], [6, 9], [12, 3]];
        bareGround(p);
        fillPolygons(p.surface, p.camera, [[...a, ...b, ...left]], p.tones.left, 0.25);
        fillPolygons(p.surface, p.camera, [[...a, ...b, ...right]], p.tones.right, 0.25);
        stroke(p, [[...a, ...b]], 'wall', 2);
        for (const [q, text] of [[a, 'a'], [b, 'b'], [left, `p ${side(a, b, ...left) > 0 ? '+' : '-'}`], [right, `q ${side(a, b, ...right) > 0 ? '+' : '-'}`]]) {
            dot(p, q, 'ink', 4);
            say(p, [q[0], q[1] + (q === right || q === a ? -1.1 : 1.2)], text);
        }
    }],
    dual: ['Ends of portals are lines here. The filled polygon has all lines of sight.', null, (p) => {
        const state = firstState(lines.dual);
        lines.dual.update(state, p.lab);
        return lines.dual.beside(state, p.tones);
    }],
    funnel: ['Strings along the left ends and along the right ends, with room between them.', blank, (p) => {
        const { left, right } = upright(corridor);
        drawPortals(p.surface, p.camera, p.tones, corridor);
        stroke(p, [chain(left, 1).flat()], 'glass', 3);
        stroke(p, [chain(right, -1).flat()], 'to', 3);
    }],
    sight: ['A line touches the corner of a pillar.', [0, 0, 9, 6], (p) => {
        bareGround(p);
        fillPolygons(p.surface, p.camera, [[3, 0.5, 6, 0.5, 6, 3, 3, 3]], p.tones.solid);
        stroke(p, [[0.5, 2, 8.5, 5.2]], 'sourceEdge', 3);
        dot(p, [3, 3]);
    }],

    margin: figure('A line, with a strip around it that reaches to the nearest ends.', program.steps, { step: 6 }),
    basis: figure('Three ends are large; each of them is equally far from the line.', program.steps, { step: 1 }),

    set: ['One cell, and in blue all cells that it sees.', house.box, (p) => {
        const space = p.lab.scene(house.text);
        drawMap(p, 'house', { space, from: 0, seen: new Set(space.row(0)) });
    }],
    'stab-tree': figure('From one cell, lines lead from portal to portal.', search.tree),
    conservative: guarantee('More cells are blue than are seen. Dots mark those too many.', { method: 'flood' }),
    exact: guarantee('The blue cells are those that are seen.', {}),
    aggressive: guarantee('Fewer cells are blue than are seen. Dots mark the missing ones.', { method: 'sampling', samples: 8, seed: 1 }),

    witness: figure('A line passes the portals between two rooms.', lines.cells, { a: [4, 10], b: [8, 2] }),
    conflict: figure('The hulls of left ends and of right ends meet. Large ends prove that no line passes.', hidden.hulls, { l1: [9, 1], r1: [9, 0] }),
    hull: ['Points in a rubber band.', blank, (p) => {
        const points = [[3, 3], [6, 10], [13, 9], [15, 4], [8, 2], [8, 6], [11, 5]];
        bareGround(p);
        drawHull(p.surface, p.camera, points, p.tones.glass);
        for (const q of points) dot(p, q, 'ink', 4);
    }],
    separating: ['Two portals. One line has them on two sides, the other one on the same side.', blank, (p) => {
        const [a, b] = [[5, 9, 5, 4], [13, 8, 13, 3]];
        drawPortals(p.surface, p.camera, p.tones, [a, b]);
        const beyond = ([x0, y0], [x1, y1]) => [0, y0 - (x0 * (y1 - y0)) / (x1 - x0), 18, y0 + ((18 - x0) * (y1 - y0)) / (x1 - x0)];
        stroke(p, [beyond(a.slice(0, 2), b.slice(2))], 'sourceEdge', 3);
        stroke(p, [beyond(a.slice(0, 2), b.slice(0, 2))], 'glass', 2, [6, 4]);
    }],

    critical: ['A line through corners of two pillars.', pillars.box, (p) => {
        drawMap(p, 'pillars');
        stroke(p, [[0, 4 + 5 / 6, 16, 4 - 11 / 6]], 'sourceEdge', 3);
        for (const q of [[5, 4], [11, 3]]) dot(p, q);
    }],
    sweep: ['Lines turn about the corner of a pillar, each to the next wall.', pillars.box, (p) => {
        const at = [5, 4], scene = p.lab.scene(pillars.text);
        drawMap(p, 'pillars');
        const rays = corners.filter(([x, y]) => (x !== at[0] || y !== at[1]) && scene.canSee({ x: at[0], y: at[1] }, { x, y }));
        stroke(p, rays.map((q) => [...at, ...q]), 'glass', 1.5, [5, 4]);
        stroke(p, [[...at, 14, 11]], 'sourceEdge', 3);
        for (const q of rays) dot(p, q, 'glass', 3);
        dot(p, at);
    }],
    graph: ['All corners of pillars that see each other are joined.', pillars.box, (p) => {
        const scene = p.lab.scene(pillars.text), see = ([ax, ay], [bx, by]) => scene.canSee({ x: ax, y: ay }, { x: bx, y: by });
        drawMap(p, 'pillars');
        stroke(p, corners.flatMap((a, i) => corners.slice(i + 1).filter((b) => see(a, b)).map((b) => [...a, ...b])), 'glass', 1);
        for (const q of corners) dot(p, q, 'glass', 3);
    }],

    culling: figure('An eye with its cone. Blue cells are kept, outlined ones are dropped.', view.cull),
    pieces: figure('The cone of an eye gets narrower at each portal.', view.cones),
    'view-cell': figure('Rooms of a grid; one is the view cell.', regions.order, { step: 1 }),
    'directed-set': figure('What a view cell sees to the right and upwards is blue.', regions.sets),
    hierarchy: figure('Boxes of the tree at which the test of visibility ends.', frames.hierarchy),
    merged: figure('Cells of one colour are one view cell.', frames.cells),

    doors: figure('A cell, and what it sees through the doors that are open.', effects.doors),
    mirrors: figure('An eye, and what it sees in two mirrors. Dashed is where that seems to be.', effects.mirrors),
    glass: figure('Sight passes the dashed wall one way only.', effects.glass, { range: 24 }),

    way: ['A way between two dots, with its turns.', house.box, (p) => {
        const { way } = shortestWay(cornerGraph([3, 1.5], [14.5, 12], segmentsOf(items.house)));
        drawMap(p, 'house');
        stroke(p, [way.flat()], 'sourceEdge', 3);
        for (const at of way.slice(1, -1)) dot(p, at, 'start');
        for (const at of [way[0], way.at(-1)]) dot(p, at, 'from');
    }],
    apex: ['Two strings part at the apex, and lead to the ends of a door.', blank, (p) => {
        const { way, left, right } = pullString([1, 6], [17, 4], doors.map(([lx, ly, rx, ry]) => ({ left: [lx, ly], right: [rx, ry] })))[2];
        drawPortals(p.surface, p.camera, p.tones, doors);
        stroke(p, [[...way.flat(), ...left[0]]], 'sourceEdge', 4);
        stroke(p, [left.flat()], 'left', 3);
        stroke(p, [right.flat()], 'right', 3);
        dot(p, left[0], 'start', 7);
    }],
};

const SIZE = { width: 280, most: 220, margin: 10 };

/** @param {HTMLElement} main with a place for each picture @param {import('./lab.js').Lab} lab */
export function fill(main, lab) {
    for (const host of main.querySelectorAll('figure[data-picture]')) {
        const [english, box, draw] = pictures[host.dataset.picture], words = t(english);
        keepPicture(host, (tones) => (box ? picture(words, box, (surface, camera) => draw({ surface, camera, tones, lab }), SIZE)
            : draw({ tones, lab })));
    }
}
