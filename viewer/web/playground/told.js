/** What a step has done to the map, in words. */
import { t } from '../language/language.js';

const round = (v) => Math.round(v * 1000) / 1000;
export const placeOf = (p) => `${round(p[0])}, ${round(p[1])}`;

/** @param {import('../formats/map-text.js').Item} item */
export function tellItem({ kind, name, points, value }) {
    const what = [t(kind === 'oneway' ? 'glass' : kind), name ?? value].filter((word) => word !== undefined).join(' ');
    if (points.length === 2) return t`${what} at ${placeOf(points)}`;
    if (points.length !== 4) return what;
    const ends = t`${what} from ${placeOf(points)} to ${placeOf(points.slice(2))}`;
    if (kind === 'object') return ends; // a box, by two of its corners
    return t`${ends}, length ${round(Math.hypot(points[2] - points[0], points[3] - points[1]))}`;
}

/** @param {import('../formats/map-text.js').Item[]} from @param {import('../formats/map-text.js').Item[]} to */
export function tellChange(from, to) {
    const least = Math.min(from.length, to.length);
    let first = 0, last = 0;
    while (first < least && from[first] === to[first]) first++;
    while (last < least - first && from.at(-1 - last) === to.at(-1 - last)) last++;
    const gone = from.slice(first, from.length - last), come = to.slice(first, to.length - last);
    const tell = (items) => (items.length === 1 ? tellItem(items[0]) : t`${items.length} items`);
    if (!gone.length && !come.length) return '';
    if (!gone.length) return t`Added: ${tell(come)}`;
    if (!come.length) return t`Deleted: ${tell(gone)}`;
    return t`Changed: ${tell(gone.length === come.length ? come.filter((item, i) => item !== gone[i]) : come)}`;
}
