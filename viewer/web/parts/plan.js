/**
 * Draws a plan: cells, portals, what is seen, walls and marks, one over the other.
 *
 * It keeps nothing: the same scene gives the same picture. The surface is a canvas context or an
 * SvgSurface, so figures elsewhere draw with it too.
 */

/**
 * @typedef {Object} Scene
 * @property {Space} [space] cells and portals
 * @property {Set<number>} [seen] cells of the visible set
 * @property {number} [from] a chosen cell @property {number} [to] a second one
 * @property {ArrayLike<number>} [region] x, y of the visible region
 * @property {ArrayLike<number>[]} [mirrored] parts that are seen in mirrors, where they lie
 * @property {(surface: any, camera: Camera, tones: Tones) => void} [heat] draws a heat map over the cells
 * @property {[number, number]} [eye]
 * @property {import('../formats/map-text.js').Item[]} [items] walls, doors ... as they are drawn
 * @property {Set<string>} [shut] names of doors that are shut
 * @property {{cells?: boolean, portals?: boolean, grid?: number}} [show]
 */

/**
 * Cells and portals as the package's Scene has them.
 * @typedef {Object} Space
 * @property {number} cellCount
 * @property {Float64Array} vertices x, y ... of all cells
 * @property {Uint32Array} cellTable six a cell: first vertex, vertices, ..., inside, solid
 * @property {number} portalCount
 * @property {Float64Array} portalEnds five a portal, the last four its two ends
 * @property {Uint32Array} portalCells ten a portal, the first two its cells
 */

/** @typedef {import('./camera.js').Camera} Camera */
/** @typedef {import('./tones.js').Tones} Tones */

/**
 * Closes by a line: closePath() of Chromium measures the whole path at each call.
 * @param {Camera} camera @param {ArrayLike<number>} flat x, y, x, y ...
 */
function trace(surface, camera, flat, closed) {
    for (let i = 0; i + 1 < flat.length; i += 2) {
        const [x, y] = camera.toScreen(flat[i], flat[i + 1]);
        if (i) surface.lineTo(x, y);
        else surface.moveTo(x, y);
    }
    if (closed && flat.length > 2) surface.lineTo(...camera.toScreen(flat[0], flat[1]));
}

/** From so many lines on, lines that would lie on one another are left out. */
const MANY = 20000;

/** A line that is shorter than this, in pixels, may be left out. */
const SHORT = 3;

/**
 * Of very many lines those that show: in the view, of short ones one for each square of pixels, and a longer one once where
 * it equals the last that was kept in its square.
 * @param {ArrayLike<number>[]} lines
 */
function thinOut(camera, lines) {
    if (lines.length <= MANY) return lines;
    const columns = Math.ceil(camera.width / SHORT) + 1, rows = Math.ceil(camera.height / SHORT) + 1;
    const last = new Array(2 * columns * rows), [x0, y0, x1, y1] = camera.box();
    return lines.filter((line) => {
        let [a, b, c, d] = [Infinity, Infinity, -Infinity, -Infinity];
        for (let i = 0; i + 1 < line.length; i += 2) {
            a = Math.min(a, line[i]);
            b = Math.min(b, line[i + 1]);
            c = Math.max(c, line[i]);
            d = Math.max(d, line[i + 1]);
        }
        if (c < x0 || a > x1 || d < y0 || b > y1) return false;
        const short = Math.max(c - a, d - b) * camera.scale <= SHORT;
        const [px, py] = camera.toScreen(Math.max(a, x0), Math.min(d, y1));
        const at = 2 * (Math.floor(py / SHORT) * columns + Math.floor(px / SHORT)) + (short ? 1 : 0), before = last[at];
        if (before && (short || (before.length === line.length && before.every((v, i) => v === line[i])))) return false;
        last[at] = line;
        return true;
    });
}

/** Of very many lines, those in one path: browsers take more than twice as long for twice as many that cross. */
const IN_A_PATH = 1000;

/** Strokes polylines of one kind. @param {ArrayLike<number>[]} lines */
export function strokeLines(surface, camera, lines, colour, width, dash = [], closed = false) {
    if (!lines.length) return;
    surface.strokeStyle = colour;
    surface.lineWidth = width;
    surface.setLineDash(dash);
    const shown = thinOut(camera, lines), inPath = lines.length > MANY ? IN_A_PATH : lines.length;
    for (let i = 0; i < shown.length; i += inPath) {
        surface.beginPath();
        for (const line of shown.slice(i, i + inPath)) trace(surface, camera, line, closed);
        surface.stroke();
    }
    surface.setLineDash([]);
}

/** @param {ArrayLike<number>[]} polygons */
export function fillPolygons(surface, camera, polygons, colour, alpha = 1) {
    if (!polygons.length) return;
    surface.beginPath();
    for (const polygon of thinOut(camera, polygons)) trace(surface, camera, polygon, false);
    surface.globalAlpha = alpha;
    surface.fillStyle = colour;
    surface.fill();
    surface.globalAlpha = 1;
}

/** A filled dot with a rim in the page's colour. */
export function drawDot(surface, camera, [x, y], radius, colour, rim) {
    const [px, py] = camera.toScreen(x, y);
    surface.beginPath();
    surface.arc(px, py, radius, 0, 2 * Math.PI);
    surface.fillStyle = colour;
    surface.fill();
    surface.strokeStyle = rim;
    surface.lineWidth = 1.5;
    surface.stroke();
}

/** Multiples of a step. They are counted: far from the origin the next whole number may be the same. */
function multiples(from, to, step) {
    const first = Math.ceil(from / step);
    return Array.from({ length: Math.max(0, Math.floor(to / step) - first + 1) }, (_, i) => (first + i) * step);
}

function drawGrid(surface, camera, step, colour) {
    const [x0, y0, x1, y1] = camera.box();
    if ((x1 - x0) / step > 400 || (y1 - y0) / step > 400) return;
    const lines = [...multiples(x0, x1, step).map((x) => [x, y0, x, y1]), ...multiples(y0, y1, step).map((y) => [x0, y, x1, y])];
    strokeLines(surface, camera, lines, colour, 0.5);
}

/** The area of an outline, over 0 where it runs counter-clockwise, and its length. @param {ArrayLike<number>} p x, y ... */
export function measureOutline(p) {
    let twice = 0, perimeter = 0;
    for (let i = 0; i < p.length; i += 2) {
        const next = (i + 2) % p.length, x = p[next] - p[i], y = p[next + 1] - p[i + 1];
        twice += (p[i] - p[0]) * y - x * (p[i + 1] - p[1]);
        perimeter += Math.hypot(x, y);
    }
    return { area: twice / 2, perimeter };
}

/** @param {Space} space @returns {Float64Array} x, y ... of one cell */
export function cellCorners(space, cell) {
    const [first, count] = space.cellTable.subarray(6 * cell, 6 * cell + 2);
    return space.vertices.subarray(2 * first, 2 * (first + count));
}

/** @param {Space} space */
export const isInside = (space, cell) => space.cellTable[6 * cell + 4] !== 0;

function cellColour(scene, tones, i) {
    if (scene.space.cellTable[6 * i + 5]) return tones.solid;
    if (!isInside(scene.space, i) || i === scene.from || i === scene.to) return null;
    return scene.seen?.has(i) ? tones.seen[i % 4] : tones.floor[i % 4];
}

/** Each cell is a path of its own: browsers fill convex ones faster than one path of all. */
function drawCells(surface, camera, scene, tones) {
    const groups = new Map(), outlines = [];
    for (let i = 0; i < scene.space.cellCount; i++) {
        const corners = cellCorners(scene.space, i), colour = cellColour(scene, tones, i);
        if (colour && !groups.has(colour)) groups.set(colour, []);
        groups.get(colour)?.push(corners);
        if (isInside(scene.space, i)) outlines.push(corners);
    }
    for (const [colour, polygons] of groups)
        for (const polygon of thinOut(camera, polygons)) fillPolygons(surface, camera, [polygon], colour);
    for (const [at, colour] of [[scene.from, tones.from], [scene.to, tones.to]])
        if (at >= 0 && at < scene.space.cellCount)
            fillPolygons(surface, camera, [cellCorners(scene.space, at)], colour, 0.55);
    strokeLines(surface, camera, outlines, tones.outline, 0.75, [], true);
}

/** Lines of one pixel are drawn faster than broader ones. */
function drawPortals(surface, camera, space, tones) {
    const lines = [];
    for (let i = 0; i < space.portalCount; i++)
        if (isInside(space, space.portalCells[10 * i])) lines.push(space.portalEnds.subarray(5 * i + 1, 5 * i + 5));
    strokeLines(surface, camera, lines, tones.portal, 1);
}

function drawRegion(surface, camera, scene, tones) {
    for (const part of scene.mirrored ?? []) fillPolygons(surface, camera, [part], tones.image);
    if (!scene.region?.length) return;
    fillPolygons(surface, camera, [scene.region], tones.region);
    strokeLines(surface, camera, [scene.region], tones.sourceEdge, 1.5, [], true);
}

const isPolygon = { solid: true, open: true, cell: true };

/** @returns {number[]} the item's line, closed where it is an outline */
export function itemLine(item) {
    const p = item.points;
    if (item.kind === 'object') return [p[0], p[1], p[2], p[1], p[2], p[3], p[0], p[3], p[0], p[1]];
    return isPolygon[item.kind] ? [...p, p[0], p[1]] : p;
}

/** Short strokes on a side of a line (1: the left one), for what only one side does. */
function ticks([x0, y0, x1, y1], side, camera) {
    const length = Math.hypot(x1 - x0, y1 - y0), [dx, dy] = [(x1 - x0) / length, (y1 - y0) / length];
    const high = 8 / camera.scale, count = Math.min(200, Math.floor((length * camera.scale) / 9));
    return Array.from({ length: count }, (_, i) => {
        const along = ((i + 0.5) * length) / count, x = x0 + dx * along, y = y0 + dy * along;
        return [x, y, x + high * (dx / 2 - side * dy), y + high * (dy / 2 + side * dx)];
    });
}

const grouped = new WeakMap();

/** Items by kind; lists of items are never changed in place, so this is kept with the list. */
function byKind(items) {
    let groups = grouped.get(items);
    if (groups) return groups;
    groups = {};
    for (const item of items) (groups[item.kind] ??= []).push(item);
    grouped.set(items, groups);
    return groups;
}

function drawItems(surface, camera, scene, tones, wall) {
    const groups = byKind(scene.items), of = (...kinds) => kinds.flatMap((kind) => groups[kind] ?? []);
    const solid = of('solid').map((item) => item.points);
    if (!scene.space) fillPolygons(surface, camera, solid, tones.solid, 0.6);
    const lines = (...kinds) => of(...kinds).map(itemLine);
    surface.lineCap = 'round';
    strokeLines(surface, camera, lines('seam'), tones.faint, 1, [2, 4]);
    strokeLines(surface, camera, lines('path'), tones.path, 1.5, [6, 4]);
    strokeLines(surface, camera, lines('object'), tones.object, 1.5);
    strokeLines(surface, camera, lines('wall', 'walls', 'solid', 'open'), tones.wall, wall);
    strokeLines(surface, camera, lines('mirror'), tones.mirrored, wall + 1);
    strokeLines(surface, camera, lines('oneway'), tones.glass, wall, [6, 4]);
    const backs = of('mirror').filter((item) => item.state === 'one').map((item) => item.points);
    strokeLines(surface, camera, backs.flatMap((points) => ticks(points, -1, camera)), tones.mirrored, 1.5);
    strokeLines(surface, camera, of('oneway').flatMap((item) => ticks(item.points, 1, camera)), tones.glass, 1.5);
    const doors = of('door'), isShut = (item) => scene.shut?.has(item.name) ?? item.state === 'shut';
    strokeLines(surface, camera, doors.filter(isShut).map(itemLine), tones.door, wall + 2);
    surface.lineCap = 'butt';
    const open = doors.filter((item) => !isShut(item)).map(itemLine);
    strokeLines(surface, camera, open, tones.door, 2, [4, 3]);
    for (const item of of('start')) drawStart(surface, camera, item, tones);
}

function drawStart(surface, camera, item, tones) {
    const [x, y] = item.points, angle = ((item.heading ?? 0) * Math.PI) / 180;
    const r = 14 / camera.scale;
    const tip = [x, y, x + r * Math.cos(angle), y + r * Math.sin(angle)];
    strokeLines(surface, camera, [tip], tones.start, 2);
    drawDot(surface, camera, [x, y], 4, tones.start, tones.page);
}

/** How thick walls are drawn at this scale, in pixels. */
export const wallWidth = (camera) => Math.min(3, Math.max(1, camera.scale * 0.12));

/**
 * @param {CanvasRenderingContext2D | import('./svg-surface.js').SvgSurface} surface
 * @param {Camera} camera @param {Scene} scene @param {Tones} tones
 */
export function drawPlan(surface, camera, scene, tones) {
    const show = { cells: true, portals: true, ...scene.show };
    surface.lineJoin = 'round';
    surface.fillStyle = tones.ground;
    surface.fillRect(0, 0, camera.width, camera.height);
    if (show.grid) drawGrid(surface, camera, show.grid, tones.hatch);
    if (scene.space && show.cells) drawCells(surface, camera, scene, tones);
    scene.heat?.(surface, camera, tones);
    drawRegion(surface, camera, scene, tones);
    if (scene.space && show.portals) drawPortals(surface, camera, scene.space, tones);
    if (scene.items) drawItems(surface, camera, scene, tones, wallWidth(camera));
    if (scene.eye) drawDot(surface, camera, scene.eye, 5, tones.sourceEdge, tones.page);
}
