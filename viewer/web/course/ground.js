/** What figures and exercises ask the library about ways. The module is loaded by the first call of `loadGround`. */
import { load } from '../package/ways.js';

const HIGH = 12, MOST = 20;

let core = null, loading = null;
const floors = new Map();

export const loadGround = async () => (core = await (loading ??= load({ memory: 2 ** 28 })));

/** The floor of a map for questions about ways; null until the module is loaded. The last 20 maps are kept, so ask again at each use. */
export function groundNow(text) {
    if (!core) return null;
    const floor = floors.get(text) ?? core.open(text);
    floors.delete(text);
    floors.set(text, floor);
    if (floors.size > MOST) {
        const [oldest, old] = floors.entries().next().value;
        floors.delete(oldest);
        old.close();
    }
    return floor;
}

/** The library's shortest way: its length and its places; null if there is none. The module must be loaded. */
export function wayBetween(text, from, to, options) {
    const found = groundNow(text).path(from, to, options);
    return found && { length: found.length, way: Array.from({ length: found.points.length / 2 }, (_, i) => [found.points[2 * i], found.points[2 * i + 1]]) };
}

/** A map of rooms that lie side by side, with a door between each two. @param {number[][]} doors left x, left y, right x, right y, from left to right */
export function roomsInARow(doors, [x0, x1] = [0, 18]) {
    const walls = doors.flatMap(([lx, ly, rx, ry]) => [`wall ${lx} ${ly} ${lx} ${HIGH}`, `wall ${rx} 0 ${rx} ${ry}`]);
    return ['sightline 1', `walls ${x0} 0 ${x1} 0 ${x1} ${HIGH} ${x0} ${HIGH} ${x0} 0`, ...walls, ''].join('\n');
}
