/** Universal VTT (.dd2vtt, .uvtt): lines of sight are walls, portals are doors. */
import { FormatError } from './map-text.js';
import { oneWord, plural } from './words.js';

/** @param {any} file @returns {{items: import('./map-text.js').Item[], notes: string[]}} */
export function readTabletop(file) {
    const size = file.resolution?.map_size, origin = file.resolution?.map_origin ?? { x: 0, y: 0 };
    if (!size) throw new FormatError("expected 'resolution' with a 'map_size'");
    const own = file.sightline ?? {}, top = own.y0 ?? origin.y + size.y, items = [], notes = [];
    const flat = (line) => line.flatMap((p) => [p.x, top - p.y]);
    for (const line of [...(file.line_of_sight ?? []), ...(file.objects_line_of_sight ?? [])])
        if (line.length > 1) items.push({ kind: 'walls', points: flat(line) });
    (file.portals ?? []).forEach((portal, i) => {
        if (portal.bounds?.length !== 2) return;
        const state = portal.closed === false ? 'open' : 'shut';
        items.push({ kind: 'door', name: oneWord(portal.sightline?.name, `door${i + 1}`), points: flat(portal.bounds), state });
    });
    const lights = file.lights?.length ?? 0;
    if (lights) notes.push(plural(lights, 'light'));
    if (file.image) notes.push('the picture');
    for (const { at, heading = 0 } of own.starts ?? []) items.push({ kind: 'start', points: flat([at]), heading });
    if (own.range) items.push({ kind: 'range', points: [], value: own.range });
    if (!items.length) throw new FormatError('the file has no walls');
    return { items, notes };
}
