/** Chapter 9: culling the visible set of a cell for one eye, and the table of 1991. */
import { parseMap } from '../formats/map-text.js';
import { plural } from '../formats/words.js';
import { drawPlan, fillPolygons, strokeLines } from '../parts/plan.js';
import { table } from './figure.js';
import { cellAt, floorArea, round, stand } from './lab.js';
import { drawWalls, flat, house, itemsOf, threeRooms } from './maps.js';
import { mapNamed } from './own.js';

/** The methods, each of which keeps no more than the one before. */
const methods = [
    ['cell_to_cell', 'cell to cell'], ['disjoint_cell', 'disjoint cell'], ['connected_component', 'connected component'],
    ['incident_portals', 'incident portals'], ['exact', 'exact'],
];

const houseItems = itemsOf(house.text);

/** The two sides of a view cone, as lines that leave the picture. */
const coneLines = ([x, y], direction, field) => (field >= 360 ? [] : [-field / 2, field / 2].map((half) => {
    const angle = ((direction + half) * Math.PI) / 180;
    return [x, y, x + 40 * Math.cos(angle), y + 40 * Math.sin(angle)];
}));

const viewOf = (heading, fov) => (fov < 360 ? { heading, fov } : {});

const cull = {
    title: 'Five methods.',
    about: 'Drag the eye. Blue cells are kept by the method of the list. Outlined cells were dropped: the eye\'s cell sees them.',
    box: house.box,
    handles: [{ name: 'eye', at: [13, 8] }],
    controls: [
        { name: 'method', label: 'method', kind: 'choice', value: 'incident_portals', options: methods },
        { name: 'field', label: 'field of view', kind: 'range', value: 60, min: 30, max: 360, step: 30 },
        { name: 'direction', label: 'direction', kind: 'range', value: 150, min: 0, max: 345, step: 15 },
    ],
    update(state, lab) {
        const scene = stand(state, lab, house.text, state.eye);
        const look = (method) => (state.cell < 0 ? [] : [...scene.look(...state.eye, { method, ...viewOf(state.direction, state.field) })]);
        state.kept = new Set(look(state.method));
        state.dropped = look('cell_to_cell').filter((cell) => !state.kept.has(cell));
        state.counts = methods.map(([method]) => look(method).length);
    },
    marks: {
        kept: ({ scene, kept }) => ({ areas: [...kept].map((cell) => scene.corners(cell)) }),
        dropped: ({ scene, dropped }) => ({ areas: dropped.map((cell) => scene.corners(cell)) }),
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { space: state.scene, from: state.kept.has(state.cell) ? state.cell : -1, seen: state.kept }, tones);
        strokeLines(surface, camera, state.dropped.map((cell) => state.scene.corners(cell)), tones.to, 2, [5, 3], true);
        strokeLines(surface, camera, coneLines(state.eye, state.direction, state.field), tones.sourceEdge, 2);
        drawWalls(surface, camera, houseItems, tones);
    },
    tell: (state) => (state.cell < 0 ? 'Nobody can stand there.'
        : `Field of view ${state.field}°, direction ${state.direction}°. Kept: ` +
            `${methods.map(([, name], i) => `${name} ${state.counts[i]}`).join(', ')}.`),
};

const cross = (a, b) => a[0] * b[1] - a[1] * b[0];

/** The part of a convex polygon that lies to the left of a ray from the eye. */
function clip(polygon, eye, side) {
    const depth = ([x, y]) => cross(side, [x - eye[0], y - eye[1]]), result = [];
    polygon.forEach((p, i) => {
        const q = polygon[(i + 1) % polygon.length], a = depth(p), b = depth(q);
        if (a >= 0) result.push(p);
        if (a * b < 0) result.push([p[0] + (a / (a - b)) * (q[0] - p[0]), p[1] + (a / (a - b)) * (q[1] - p[1])]);
    });
    return result;
}

const pairsOf = (flatList) => Array.from({ length: flatList.length / 2 }, (_, i) => [flatList[2 * i], flatList[2 * i + 1]]);

/** Goes through portals with the cone that is left of the view; for a picture, in rounded numbers. */
function conesOf(scene, eye, first, most) {
    const pieces = [], portals = [];
    const visit = (cell, left, right, from, depth) => {
        let polygon = pairsOf(scene.corners(cell).slice());
        if (left) polygon = clip(clip(polygon, eye, right), eye, [-left[0], -left[1]]);
        pieces.push({ cell, depth, polygon: polygon.flat() });
        for (const portal of depth < most ? scene.cell(cell).portals : []) {
            if (portal.portal === from) continue;
            let l = [portal.left[0] - eye[0], portal.left[1] - eye[1]], r = [portal.right[0] - eye[0], portal.right[1] - eye[1]];
            if (left && cross(left, l) > 0) l = left;
            if (right && cross(right, r) < 0) r = right;
            if (cross(r, l) <= 0) continue;
            portals.push([...portal.left, ...portal.right]);
            visit(portal.cell, l, r, portal.portal, depth + 1);
        }
    };
    visit(first, null, null, -1, 0);
    return { pieces, portals };
}

const cones = {
    title: 'The cone gets narrower.',
    about: 'The slider says through how many portals the method goes. Green portals are passed.',
    box: house.box,
    handles: [{ name: 'eye', at: [8, 6.4] }],
    controls: [{ name: 'most', label: 'portals', kind: 'range', value: 2, min: 0, max: 8 }],
    update(state, lab) {
        const scene = stand(state, lab, house.text, state.eye);
        Object.assign(state, state.cell < 0 ? { pieces: [], portals: [] } : conesOf(scene, state.eye, state.cell, state.most));
        state.cells = new Set(state.pieces.map((piece) => piece.cell)).size;
        state.exact = state.cell < 0 ? 0 : scene.look(...state.eye, { method: 'exact' }).length;
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { space: state.scene }, tones);
        fillPolygons(surface, camera, state.pieces.map((piece) => piece.polygon), tones.region);
        strokeLines(surface, camera, state.pieces.map((piece) => piece.polygon), tones.sourceEdge, 1, [], true);
        strokeLines(surface, camera, state.portals, tones.portal, 3);
        drawWalls(surface, camera, houseItems, tones);
    },
    tell: (state) => (state.cell < 0 ? 'Nobody can stand there.'
        : `Up to ${plural(state.most, 'portal')}: ${plural(state.pieces.length, 'piece')} in ${plural(state.cells, 'cell')}. ` +
            `The exact method of the library keeps ${plural(state.exact, 'cell')}.`),
};

/** What was measured in 1991, for 360 and for 60 degrees: the mean share of the area, in percent. */
const of1991 = [[8.1, 8.1], [8.1, 3.1], [8.1, 2.4], [8.1, 2.2], [4.9, 1.8], [2.1, 0.3]];

/** Eyes over the whole picture; those in walls are left out. */
const EYES = 6;

function sharesOf(scene, [x0, y0, x1, y1]) {
    const whole = floorArea(scene) || 1, sums = of1991.map(() => [0, 0]), areas = [];
    for (let i = 0; i < scene.cellCount; i++) {
        const p = pairsOf(scene.corners(i));
        areas.push(p.reduce((sum, q, k) => sum + cross(q, p[(k + 1) % p.length]) / 2, 0));
    }
    const areaOf = (cells) => cells.reduce((sum, cell) => sum + areas[cell], 0);
    let eyes = 0;
    for (let i = 0; i < EYES * EYES; i++) {
        const eye = [x0 + (((i % EYES) + 0.43) / EYES) * (x1 - x0), y0 + ((Math.floor(i / EYES) + 0.57) / EYES) * (y1 - y0)];
        if (cellAt(scene, eye) < 0) continue;
        eyes++;
        [{}, { heading: 75 * i, fov: 60 }].forEach((view, k) => {
            methods.forEach(([method], m) => (sums[m][k] += areaOf(scene.look(...eye, { method, ...view }))));
            const p = pairsOf(scene.visiblePolygon(...eye, view));
            sums[5][k] += p.reduce((sum, q, j) => sum + cross(q, p[(j + 1) % p.length]) / 2, 0);
        });
    }
    return { eyes, rows: sums.map((row) => row.map((sum) => (100 * sum) / whole / Math.max(1, eyes))) };
}

const soda = {
    title: 'The table of 1991, beside your own map.',
    about: 'Choose a plan, or drop a file with one of your own. Drag the two ends of one more wall. The table has the mean share of the floor in percent, over many eyes.',
    box: flat.box,
    handles: [{ name: 'a', at: [6, 6.2], tone: 'from' }, { name: 'b', at: [11, 6.2], tone: 'to' }],
    controls: [{ name: 'plan', label: 'plan', kind: 'map', value: 'flat' }],
    update(state, lab) {
        const { text, box } = mapNamed(state.plan), [x0, y0, x1, y1] = box, digits = Math.max(0, Math.min(12, 2 - Math.floor(Math.log10(Math.hypot(x1 - x0, y1 - y0)))));
        if (state.box && state.box !== box)
            [state.a, state.b] = [0.3, 0.55].map((share) => [x0 + share * (x1 - x0), y0 + 0.52 * (y1 - y0)]);
        state.box = box;
        const ends = [...state.a, ...state.b].map((v) => round(v, digits));
        state.text = `${text}${ends[0] === ends[2] && ends[1] === ends[3] ? '' : `wall ${ends.join(' ')}\n`}`;
        try {
            state.scene = lab.scene(state.text);
            state.refused = '';
        } catch (error) {
            Object.assign(state, { text, scene: lab.scene(text), refused: `The wall cannot stand there: ${error.message}. ` });
        }
        state.shares = sharesOf(state.scene, box);
    },
    draw(surface, camera, tones, state) {
        drawPlan(surface, camera, { space: state.scene, items: parseMap(state.text) }, tones);
    },
    beside(state) {
        const names = [...methods.map(([, name]) => name), 'visible region'];
        return table(['kept', '360°', '1991', '60°', '1991'], names.map((name, m) =>
            [name, ...[0, 1].flatMap((k) => [state.shares.rows[m][k].toFixed(1), of1991[m][k]])]));
    },
    tell(state) {
        const { rows, eyes } = state.shares;
        return `${state.refused}${plural(state.scene.insideCount, 'cell')}, ${plural(eyes, 'eye')}. With 60° incident portals keep ` +
            `${round(rows[3][1])} % of the floor, the exact method ${round(rows[4][1])} %, and the region is ${round(rows[5][1])} %.`;
    },
};

export const figures = { cull, cones, table: soda };

export const exercises = {
    around: {
        kind: 'choice',
        question: 'The eye looks all round. Why do the first four methods keep the same cells?',
        options: [
            ['Because they ask only whether something meets the view cone, and a full circle meets all.', 'Only the exact method makes the cone narrower at each portal. So only it drops cells when the eye looks all round.'],
            ['Because from its cell the eye sees all that its cell sees.', 'It sees less: other places of the cell look through doors at other angles. The exact method drops these cells.'],
            ['Because the four methods are exact.', 'They are safe, but not exact. Each may keep cells that the eye does not see.'],
        ],
        right: () => 0,
    },
    away: {
        kind: 'number',
        question: 'Three rooms lie in a row, and their doors line up. An eye in the middle of the first room looks away from the door, with 60°. How many of the three cells does the disjoint cell method keep?',
        right: (lab) => lab.scene(threeRooms.text).look(2, 2, { method: 'disjoint_cell', heading: 180, fov: 60 }).length,
        why: 'Its own cell meets the cone, and the others lie behind the eye. All later methods keep this one cell as well.',
        low: 'The eye stands in a cell, and that cell meets the cone.',
        high: 'Draw the cone. Only cells that meet it are kept, and two rooms lie behind the eye.',
    },
    fewer: {
        kind: 'place',
        question: 'The eye looks all round. Put it where the exact method keeps at most half of the cells that its cell sees.',
        solution: [[2, 10.5]],
        figure: { title: 'Where is exactness worth most?', about: 'Drag the eye, then press Check.', box: house.box, handles: [{ name: 'eye', at: [13, 8] }],
            update(state, lab) {
                stand(state, lab, house.text, state.eye);
            },
            draw(surface, camera, tones, state) {
                const seen = new Set(state.cell < 0 ? [] : state.scene.row(state.cell));
                drawPlan(surface, camera, { space: state.scene, from: state.cell, seen }, tones);
                drawWalls(surface, camera, houseItems, tones);
            },
            tell: (state) => (state.cell < 0 ? 'There is no cell here.' : `Cell ${state.cell} sees ${plural(state.scene.row(state.cell).length, 'cell')}.`) },
        judge({ eye, cell }, lab) {
            if (cell < 0) return { right: false, text: 'The eye is in no cell. Put it on the floor.' };
            const scene = lab.scene(house.text), all = scene.row(cell).length, kept = scene.look(...eye, { method: 'exact' }).length;
            const text = `Its cell sees ${plural(all, 'cell')}, and the eye sees ${kept}.`;
            if (2 * kept <= all) return { right: true, text: `${text} The set of the cell is at least twice too large here.` };
            return { right: false, text: `${text} Look for a cell with long views, and go where they are blocked.` };
        },
    },
};
