/** GeoJSON: lines and outlines become walls; features of our own exports become what they were. */
import { FormatError } from './map-text.js';
import { oneWord, plural } from './words.js';

const flat = (line) => line.flatMap(([x, y]) => [x, y]);

/** A line as items of two ends each. */
function pieces(points, item) {
    const found = [];
    for (let i = 0; i + 3 < points.length; i += 2) found.push({ ...item, points: points.slice(i, i + 4) });
    return found;
}

/** The lines of a geometry. @returns {number[][]} */
function linesOf(geometry) {
    switch (geometry?.type) {
    case 'LineString': return [flat(geometry.coordinates)];
    case 'MultiLineString':
    case 'Polygon': return geometry.coordinates.map(flat);
    case 'MultiPolygon': return geometry.coordinates.flat().map(flat);
    case 'GeometryCollection': return geometry.geometries.flatMap(linesOf);
    default: return [];
    }
}

/** As the command decides: such numbers, with four decimals or more. */
const looksLikeDegrees = (items) => items.every(({ points }) => points.every((v, i) => Math.abs(v) <= (i % 2 ? 90 : 180))) &&
    items.some(({ points }) => points.some((v) => /\.\d{4}/.test(String(v))));

/** @param {any} file @returns {{items: import('./map-text.js').Item[], notes: string[]}} */
export function readGeoJson(file) {
    const features = file.type === 'FeatureCollection' ? file.features : file.type === 'Feature' ? [file]
        : [{ geometry: file, properties: {} }];
    const items = [], left = { cells: 0, points: 0 };
    for (const feature of features) {
        const { geometry = feature, properties } = feature; // some programs leave features out
        const kind = properties?.kind, name = oneWord(properties?.name, `door${items.length + 1}`);
        if (kind === 'cell' || kind === 'portal' || kind === 'view_cell' || kind === 'region') left.cells++;
        else if (geometry?.type === 'Point' && kind === 'start')
            items.push({ kind: 'start', points: flat([geometry.coordinates]), heading: properties.heading ?? 0 });
        else if (/Point$/.test(geometry?.type)) left.points++;
        else
            for (const points of linesOf(geometry)) {
                if (points.length < 4) continue;
                const state = properties?.open === false ? 'shut' : 'open';
                if (kind === 'door') items.push(...pieces(points, { kind, name, state }));
                else if (kind === 'mirror' || kind === 'oneway') items.push(...pieces(points, { kind }));
                else items.push({ kind: 'walls', points });
            }
    }
    if (!items.length) throw new FormatError('the file has no lines or outlines');
    const notes = [];
    if (left.cells) notes.push(`${plural(left.cells, 'cell, portal or region', 'cells, portals and regions')}, made anew here`);
    if (looksLikeDegrees(items)) notes.push('longitudes and latitudes, taken as plain units');
    if (left.points) notes.push(plural(left.points, 'point'));
    return { items, notes };
}
