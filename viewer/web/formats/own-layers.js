/** Shapes on layers of our own, as lib/io/FORMATS.md lists them: SVG drawings and Tiled maps have them. */
import { oneWord } from './words.js';

/** @param {string} name of a layer @returns {string | undefined} what its shapes are; undefined for any other layer */
export const ownLayer = (name) => (/^sightline-/i.test(name) ? name.toLowerCase().slice('sightline-'.length) : undefined);

/** @param {number[][]} points */
function boxOf(points) {
    const xs = points.map((p) => p[0]), ys = points.map((p) => p[1]);
    return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}

/**
 * @param {string | undefined} layer after `sightline-` @param {number[][]} points of one shape; outlines end where they begin
 * @param {{name?: string, isShut?: boolean, heading?: number}} told
 * @param {{doors: number}} counts doors so far, which name those without a name
 * @returns {import('./map-text.js').Item[]}
 */
export function ownItems(layer, points, { name = '', isShut = false, heading = 0 }, counts) {
    const [, what, stopped] = /^(.*?)(?:-stops-(.+))?$/.exec(layer ?? ''), stops = stopped && { stops: stopped.replaceAll('-', ',') };
    const pieces = (item) => points.slice(1).map((p, i) => ({ ...item, points: [...points[i], ...p], ...stops }));
    switch (what) {
    case 'solid': case 'open': case 'cell': return [{ kind: what, points: points.slice(0, -1).flat(), ...stops }];
    case 'wall-solid': return pieces({ kind: 'wall', state: 'solid' });
    case 'door': return pieces({ kind: 'door', name: oneWord(name, `door${++counts.doors}`), state: isShut ? 'shut' : 'open' });
    case 'mirror': case 'oneway': case 'seam': return pieces({ kind: what });
    case 'mirror-one': return pieces({ kind: 'mirror', state: 'one' });
    case 'path': return [{ kind: 'path', name: oneWord(name, 'path'), points: points.flat() }];
    case 'object': return [{ kind: 'object', name: oneWord(name, 'object'), points: boxOf(points) }];
    case 'start': {
        const [x0, y0, x1, y1] = boxOf(points);
        return [{ kind: 'start', points: [(x0 + x1) / 2, (y0 + y1) / 2], heading }];
    }
    default: return [{ kind: 'walls', points: points.flat(), ...stops }];
    }
}
