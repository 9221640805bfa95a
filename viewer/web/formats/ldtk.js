/** LDtk projects and levels: solid values of IntGrid layers, doors and starts of entities. */
import { doorItems } from './grid-doors.js';
import { FormatError } from './map-text.js';
import { gridWalls } from './plan-text.js';
import { isDoorName, isSolidName, isStartName, oneWord, plural } from './words.js';

/** The values of each IntGrid layer that are solid, by the layer's number; null for all but 0. */
function solidValues(project, notes) {
    const found = new Map();
    for (const layer of project.defs?.layers ?? []) {
        const values = layer.intGridValues ?? [], named = values.filter((v) => isSolidName(v.identifier));
        found.set(layer.uid, named.length ? new Set(named.map((v) => v.value)) : null);
        const doors = values.filter((v) => isDoorName(v.identifier)).length;
        const open = named.length ? values.filter((v) => !named.includes(v)) : [];
        const names = (some) => some.map((v) => v.identifier ?? v.value).join(', ');
        if (open.length) notes.push(`solid are the values ${names(named)}, and open ${names(open)}`);
        else if (!named.length && values.length) notes.push(`all values are solid: ${names(values)}`);
        if (doors) notes.push(`${plural(doors, 'value')} of ${layer.identifier ?? 'a layer'} named as a door: taken as ground`);
    }
    return found;
}

/** Degrees counter-clockwise, by a field of the entity. */
function headingOf(entity) {
    const words = { right: 0, east: 0, up: 90, north: 90, left: 180, west: 180, down: 270, south: 270 };
    for (const { __identifier: name, __value: value } of entity.fieldInstances ?? []) {
        if (!/^(angle|rotation|heading|facing|direction)$/i.test(name)) continue;
        if (typeof value === 'number') return -value || 0;
        if (words[String(value).toLowerCase()] !== undefined) return words[value.toLowerCase()];
    }
    return 0;
}

/** Levels with the place of their upper left corner; in linear worlds one stands behind the other. */
function placedLevels(world) {
    let x = 0, y = 0;
    return (world.levels ?? [world]).map((level) => {
        const across = world.worldLayout === 'LinearHorizontal', down = world.worldLayout === 'LinearVertical';
        const at = across || down ? { x, y } : { x: level.worldX ?? 0, y: level.worldY ?? 0 };
        if (across) x += level.pxWid;
        if (down) y += level.pxHei;
        return { level, ...at };
    });
}

/** A start goes to the items, a door to the doors. */
function takeEntity(entity, grid, left, top, items, doors) {
    if (!entity.px) return;
    const [px, py] = entity.px, [ax, ay] = entity.__pivot ?? [0, 0];
    const w = entity.width ?? grid, h = entity.height ?? grid;
    const x = left + px + (0.5 - ax) * w, y = top - (py + (0.5 - ay) * h);
    if (isStartName(entity.__identifier)) items.push({ kind: 'start', points: [x, y], heading: headingOf(entity) });
    if (!isDoorName(entity.__identifier)) return;
    const shut = (entity.fieldInstances ?? []).some((f) => /^(open|isopen)$/i.test(f.__identifier) && f.__value === false);
    const box = [x - w / 2, y - h / 2, x + w / 2, y + h / 2];
    doors.push({ name: oneWord(entity.__identifier, 'door'), box, state: shut ? 'shut' : 'open' });
}

/**
 * Levels on one grid: solid is what a layer says, and what no level covers.
 * @param {{x: number, bottom: number, layer: any, is: (value: number) => boolean}[]} grids y up
 */
function gridOf(grids) {
    const size = grids[0].layer.__gridSize, covered = new Map();
    const x0 = Math.min(...grids.map((g) => g.x)), y0 = Math.min(...grids.map((g) => g.bottom));
    let columns = 0, rows = 0;
    for (const { x, bottom, layer, is } of grids) {
        const dx = (x - x0) / size, dy = (bottom - y0) / size, n = layer.__cWid;
        if (layer.__gridSize !== size || !Number.isInteger(dx) || !Number.isInteger(dy))
            throw new FormatError('the levels do not lie on one grid: drop the level files one by one');
        columns = Math.max(columns, dx + n);
        rows = Math.max(rows, dy + layer.__cHei);
        layer.intGridCsv.forEach((value, i) => {
            const at = `${dx + (i % n)},${dy + layer.__cHei - 1 - Math.floor(i / n)}`;
            covered.set(at, (covered.get(at) ?? false) || is(value));
        });
    }
    if (columns * rows > 2 ** 26) throw new FormatError('the levels lie too far apart for this page');
    const solid = Array.from({ length: rows }, (_, y) => Array.from({ length: columns }, (__, x) => covered.get(`${x},${y}`) ?? true));
    return { solid, size, x0, y0 };
}

/** @param {any} project @returns {{items: import('./map-text.js').Item[], notes: string[]}} */
export function readLdtk(project) {
    const world = project.worlds?.[0] ?? project, levels = placedLevels(world);
    const inside = levels.filter(({ level }) => level.layerInstances);
    if (!inside.length)
        throw new FormatError('the levels are in files of their own: drop a level file, or save the project as one file');
    const depth = inside[0].level.worldDepth ?? 0, used = inside.filter(({ level }) => (level.worldDepth ?? 0) === depth);
    const lowest = Math.max(...used.map(({ level, y }) => y + level.pxHei));
    const notes = [], values = solidValues(project, notes), grids = [], starts = [], doors = [];
    if (project.worlds?.length > 1) notes.push(`${plural(project.worlds.length - 1, 'world')} but the first`);
    for (const { level, x, y } of used) {
        const top = lowest - y;
        const all = level.layerInstances.filter((l) => l.__type === 'IntGrid');
        const named = all.filter((l) => isSolidName(l.__identifier));
        for (const layer of named.length ? named : all) {
            const set = values.get(layer.layerDefUid), is = (v) => (set ? set.has(v) : v !== 0);
            const { __pxTotalOffsetX: dx = 0, __pxTotalOffsetY: dy = 0 } = layer;
            grids.push({ x: x + dx, bottom: top - dy - layer.__cHei * layer.__gridSize, layer, is });
        }
        for (const layer of level.layerInstances)
            for (const entity of layer.entityInstances ?? [])
                takeEntity(entity, layer.__gridSize, x + (layer.__pxTotalOffsetX ?? 0), top - (layer.__pxTotalOffsetY ?? 0), starts, doors);
    }
    if (!grids.length) throw new FormatError('no level has an IntGrid layer');
    const grid = gridOf(grids), placed = doorItems(grid, doors, notes);
    const walls = gridWalls(grid.solid, grid.size, grid.x0, grid.y0);
    if (!walls.length) throw new FormatError('no IntGrid layer has solid values');
    const left = levels.length - used.length;
    if (left) notes.push(`${plural(left, 'level')} at another depth or in other files`);
    return { items: [...walls, ...placed, ...starts], notes };
}
