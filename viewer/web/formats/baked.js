/** The JSON export (and with it a .slv file): the map in it, as EXPORT.md says under "As a map". */

import { FormatError } from './map-text.js';

/** @param {any} file @returns {{items: import('./map-text.js').Item[], notes: string[]}} */
export function readBaked(file) {
    const { version = 1 } = file;
    if (![1, 2].includes(version))
        throw new FormatError(`the JSON export has the version ${JSON.stringify(version)}; this page reads 1 and 2`);
    const items = [], key = (s) => s.join(' '), special = new Set();
    const oneSided = new Set(file.one_sided_mirrors ?? []);
    (file.mirrors ?? []).forEach((points, i) => {
        special.add(key(points)).add(key([...points.slice(2), ...points.slice(0, 2)]));
        items.push({ kind: 'mirror', points, ...(oneSided.has(i) ? { state: 'one' } : {}) });
    });
    for (const { segment: p, stops, solid } of file.partial_walls ?? []) {
        const turned = [...p.slice(2), ...p.slice(0, 2)];
        special.add(key(p)).add(key(turned)); // those that stop what the bake was for are walls, too
        items.push({ kind: 'wall', points: solid === 'right' ? turned : p, stops: stops.join(','),
            ...(solid ? { state: 'solid' } : {}) });
    }
    const left = new Set(file.solid_walls?.left), right = new Set(file.solid_walls?.right);
    (file.walls ?? []).forEach((p, i) => {
        if (special.has(key(p)) || (left.has(i) && right.has(i))) return;
        if (left.has(i)) items.push({ kind: 'wall', points: p, state: 'solid' });
        else if (right.has(i)) items.push({ kind: 'wall', points: [p[2], p[3], p[0], p[1]], state: 'solid' });
        else items.push({ kind: 'wall', points: p });
    });
    if (!file.solid_walls)
        for (const outline of file.solids ?? []) items.push({ kind: 'solid', points: outline.flat() });
    for (const door of file.doors ?? [])
        for (const points of door.segments)
            items.push({ kind: 'door', name: door.name, points, state: door.open ? 'open' : 'shut' });
    for (const points of file.oneways ?? []) items.push({ kind: 'oneway', points });
    for (const points of file.seams ?? []) items.push({ kind: 'seam', points });
    if (file.range) items.push({ kind: 'range', points: [], value: file.range });
    for (const start of file.starts ?? []) items.push({ kind: 'start', points: start.at, heading: start.heading });
    for (const path of file.paths ?? []) items.push({ kind: 'path', name: path.name, points: path.points.flat() });
    for (const object of file.objects ?? []) items.push({ kind: 'object', name: object.name, points: object.box });
    return { items, notes: ['cells and visible sets: they are made anew'] };
}
