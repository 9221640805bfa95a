/** Chapter 2: cells, portals, the kd-tree and oblique walls. */
import { t } from '../language/language.js';
import { drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { plural } from '../formats/words.js';
import { cellAt, stand } from './lab.js';
import { axialWalls, kdTree, portalsOf } from './kdtree.js';
import { drawWalls, flat, house, itemsOf } from './maps.js';

const items = itemsOf(flat.text), houseItems = itemsOf(house.text);
const segments = houseItems.flatMap(({ points: p }) => Array.from({ length: p.length / 2 - 1 }, (_, i) => p.slice(2 * i, 2 * i + 4)));
const walls = axialWalls(segments);
const corners = ([x0, y0, x1, y1]) => [x0, y0, x1, y0, x1, y1, x0, y1];
const isIn = ([x, y], [x0, y0, x1, y1]) => x >= x0 && x <= x1 && y >= y0 && y <= y1;

const tree = {
    title: 'A kd-tree, split by split.',
    about: 'The slider adds splits. Dashed lines are splits, green lines are portals. The dot chooses a cell. Switch rules off and count.',
    box: house.box,
    handles: [{ name: 'dot', at: [15, 8] }],
    controls: [
        { name: 'most', label: 'splits', kind: 'range', value: 8, min: 0, max: 30 },
        { name: 'spanning', label: 'spanning: walls across first', kind: 'check', value: true },
        { name: 'obscured', label: 'obscured: lines that walls cover', kind: 'check', value: true },
        { name: 'cleaving', label: 'cleaving: cut few walls', kind: 'check', value: true },
    ],
    update(state) {
        const { cells, splits } = kdTree(walls, house.box, state, state.most);
        [state.cells, state.lines] = [cells, splits];
        state.cell = state.cells.find(({ box }) => isIn(state.dot, box));
        state.portals = portalsOf(state.cells, walls);
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, {}, tones);
        state.cells.forEach(({ box }, i) => fillPolygons(surface, camera, [corners(box)], tones.floor[i % 4]));
        fillPolygons(surface, camera, [corners(state.cell.box)], tones.source, 0.6);
        strokeLines(surface, camera, state.lines, tones.faint, 1, [5, 4]);
        strokeLines(surface, camera, state.portals, tones.portal, 3);
        drawWalls(surface, camera, houseItems, tones);
    },
    tell: (state) => t`${plural(state.lines.length, 'split')}, ${plural(state.cells.length, 'cell')}, ${plural(state.portals.length, 'portal')}. ` +
        t`The chosen cell lies ${plural(state.cell.depth, 'step')} below the root. Rules: ` +
        `${['spanning', 'obscured', 'cleaving'].map((rule) => `${rule} ${state[rule] ? t('on') : t('off')}`).join(', ')}.`,
};

/** The cells beside a cell, and the portals that lead there. */
const neighbours = (scene, cell) => (cell < 0 ? [] : scene.cell(cell).portals);

const beside = {
    title: 'Next door.',
    about: 'Drag the dot. Its cell is marked, and blue cells share a portal with it.',
    box: flat.box,
    handles: [{ name: 'dot', at: [12, 6.5] }],
    update(state, lab) {
        stand(state, lab, flat.text, state.dot);
        state.next = neighbours(state.scene, state.cell);
    },
    marks: {
        cell: ({ scene, cell }) => ({ areas: cell < 0 ? [] : [scene.corners(cell)] }),
        portals: ({ next }) => ({ lines: next.map((p) => [...p.left, ...p.right]) }),
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { space: state.scene, from: state.cell, seen: new Set(state.next.map((p) => p.cell)) }, tones);
        strokeLines(surface, camera, state.next.map((p) => [...p.left, ...p.right]), tones.portal, 4);
        drawWalls(surface, camera, items, tones);
    },
    tell: (state) => (state.cell < 0 ? t('There is no cell here.')
        : t`Dot at ${state.dot.map((v) => v.toFixed(1)).join(', ')}. Cell ${state.cell}: ${plural(state.next.length, 'portal')}, to ${plural(new Set(state.next.map((p) => p.cell)).size, 'cell')}.`),
};

/** The plan, turned about its middle. */
function turned(degrees) {
    const angle = (degrees * Math.PI) / 180, c = Math.cos(angle), s = Math.sin(angle);
    return items.map(({ kind, points }) => ({ kind, points: points.map((_, i) => {
        const k = i - (i % 2), x = points[k] - 10, y = points[k + 1] - 6;
        return Number((i % 2 ? s * x + c * y : c * x - s * y).toFixed(6));
    }) }));
}

const oblique = {
    title: 'The same plan, turned.',
    about: 'The slider turns all walls. The dot chooses a cell.',
    box: [-12, -12, 12, 12],
    handles: [{ name: 'dot', at: [0, 0.4] }],
    controls: [{ name: 'angle', label: 'angle', kind: 'range', value: 20, min: 0, max: 90, step: 5 }],
    update(state, lab) {
        state.items = turned(state.angle);
        state.scene = lab.scene(`sightline 1\n${state.items.map((item) => `${item.kind} ${item.points.join(' ')}`).join('\n')}\n`);
        state.cell = cellAt(state.scene, state.dot);
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { space: state.scene, from: state.cell, seen: new Set() }, tones);
        drawWalls(surface, camera, state.items, tones);
    },
    tell: ({ scene, angle, cell }) => t`Turned by ${angle}°: ${plural(scene.insideCount, 'cell')} inside. ` +
        (cell < 0 ? t('The dot is outside.') : t`Cell ${cell} has ${plural(scene.corners(cell).length / 2, 'corner')}.`),
};

export const figures = { tree, beside, oblique };

/** Numbers of the text: the whole tree, with all rules and without. */
const whole = (isOn) => kdTree(walls, house.box, { spanning: isOn, obscured: isOn, cleaving: isOn }, Infinity).cells;
export const values = {
    'cells-with': () => whole(true).length,
    'cells-without': () => whole(false).length,
    'portals-with': () => portalsOf(whole(true), walls).length,
    'portals-without': () => portalsOf(whole(false), walls).length,
};

export const exercises = {
    ell: {
        kind: 'number',
        question: 'A room has the shape of an L with six walls. Into how many convex cells must it be cut, at least?',
        right: (lab) => lab.scene('sightline 1\nwalls 0 0 8 0 8 4 4 4 4 8 0 8 0 0\n').insideCount,
        why: 'One corner points into the room. A split that begins at this corner leaves two convex cells.',
        low: 'An L is not convex: the ends of its arms cannot see each other. One cell is too few.',
        high: 'Fewer will do. Begin the cut at the corner that points into the room.',
    },
    why: {
        kind: 'choice',
        question: 'Why do we want convex cells?',
        options: [
            ['They use less memory than other polygons.', 'Cutting makes more polygons, not fewer. The gain is another one.'],
            ['In a convex cell all points see each other, so only portals matter.', 'A line that enters a cell reaches each portal of it freely. All that can stop the line lies between the cells.'],
            ['Each of them then has four sides.', 'Cells of a kd-tree have four sides, but merged triangles can have any number of them.'],
        ],
        right: () => 1,
    },
    most: {
        kind: 'place',
        question: 'Put the dot into a cell that has more portals than any other cell, or as many as the best one.',
        solution: [[10, 6.5]],
        figure: { ...beside, title: 'The busiest cell.', about: 'Drag the dot, then press Check.', handles: [{ name: 'dot', at: [2, 2] }] },
        judge({ cell }, lab) {
            const scene = lab.scene(flat.text), has = neighbours(scene, cell).length;
            const most = Math.max(...Array.from({ length: scene.cellCount }, (_, i) => neighbours(scene, i).length));
            if (has === most) return { right: true, text: t`Its cell has ${plural(has, 'portal')}. No cell has more.` };
            return { right: false, text: t`Its cell has ${plural(has, 'portal')}. Some cell has ${most}.` };
        },
    },
};
