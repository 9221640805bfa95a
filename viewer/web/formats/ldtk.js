/** LDtk projects and levels: solid values of IntGrid layers, doors and starts of entities. */
import { FormatError } from './map-text.js';
import { gridWalls } from './plan-text.js';
import { isDoorName, isSolidName, isStartName, plural } from './words.js';

/** The values of each IntGrid layer that are solid, by the layer's name; null for all but 0. */
function solidValues(project) {
    const found = new Map();
    for (const layer of project.defs?.layers ?? []) {
        const named = (layer.intGridValues ?? []).filter((v) => isSolidName(v.identifier));
        found.set(layer.identifier, named.length ? new Set(named.map((v) => v.value)) : null);
    }
    return found;
}

function entityItems(entity, grid, left, top, counts) {
    const [px, py] = entity.px, [ax, ay] = entity.__pivot ?? [0, 0];
    const w = entity.width ?? grid, h = entity.height ?? grid;
    const x = left + px + (0.5 - ax) * w, y = top - (py + (0.5 - ay) * h);
    if (isStartName(entity.__identifier)) return [{ kind: 'start', points: [x, y], heading: 0 }];
    if (!isDoorName(entity.__identifier)) return [];
    const shut = (entity.fieldInstances ?? []).some((f) => /^(open|isopen)$/i.test(f.__identifier) && f.__value === false);
    const points = w >= h ? [x - w / 2, y, x + w / 2, y] : [x, y - h / 2, x, y + h / 2];
    return [{ kind: 'door', name: `door${++counts.doors}`, points, state: shut ? 'shut' : 'open' }];
}

/** @param {any} project @returns {{items: import('./map-text.js').Item[], notes: string[]}} */
export function readLdtk(project) {
    const levels = project.levels ?? project.worlds?.[0]?.levels ?? [project];
    const inside = levels.filter((level) => level.layerInstances);
    if (!inside.length)
        throw new FormatError('the levels are in files of their own: drop a level file, or save the project as one file');
    const depth = inside[0].worldDepth ?? 0, used = inside.filter((l) => (l.worldDepth ?? 0) === depth);
    const bottom = Math.max(...used.map((l) => (l.worldY ?? 0) + l.pxHei));
    const values = solidValues(project), notes = [], items = [], counts = { doors: 0 };
    for (const level of used) {
        const x = level.worldX ?? 0, top = bottom - (level.worldY ?? 0);
        const grids = level.layerInstances.filter((l) => l.__type === 'IntGrid');
        const named = grids.filter((l) => isSolidName(l.__identifier));
        for (const layer of named.length ? named : grids) {
            const solidSet = values.get(layer.__identifier), n = layer.__cWid;
            const is = (v) => (solidSet ? solidSet.has(v) : v !== 0);
            const rows = [];
            for (let r = layer.__cHei - 1; r >= 0; r--)
                rows.push(layer.intGridCsv.slice(r * n, r * n + n).map(is));
            if (!rows.flat().some(Boolean)) continue;
            items.push(...gridWalls(rows, layer.__gridSize, x, top - layer.__cHei * layer.__gridSize));
        }
        for (const layer of level.layerInstances)
            for (const entity of layer.entityInstances ?? [])
                items.push(...entityItems(entity, layer.__gridSize, x, top, counts));
    }
    if (used.length > 1) notes.push(`${used.length} levels, side by side as in their world; walls stand between them`);
    if (used.length < levels.length) notes.push(`${plural(levels.length - used.length, 'level')} at another depth or in other files`);
    if (!items.length) throw new FormatError('no IntGrid layer has solid values');
    return { items, notes };
}
