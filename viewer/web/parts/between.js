/** What lies between two places, on a plan: a line with what it sees, and the shortest way. */
import { classColours } from './coverage.js';
import { drawDot, fillPolygons, strokeLines } from './plan.js';
import { mix } from './tones.js';

/** @typedef {[number, number][]} Ends */

/** What some point sees, and what all points see. @param {import('./tones.js').Tones} tones */
export const seenColours = (tones) => [1, 3].map((seen) => classColours(tones)[seen]);

/** @param {{loops: ArrayLike<number>[]}[]} regions seen from some point, and from all */
export function drawSeenFrom(surface, camera, regions, tones) {
    seenColours(tones).forEach((colour, i) => {
        fillPolygons(surface, camera, regions[i].loops, colour);
        strokeLines(surface, camera, regions[i].loops, mix(colour, tones.ink, 0.4), 0.9, [], true);
    });
}

/** A line that stands out, from end to end. @param {ArrayLike<number>} line */
export function drawBetween(surface, camera, line, ends, tones) {
    for (const [colour, width] of [[tones.page, 6], [tones.start, 3]]) strokeLines(surface, camera, [line], colour, width);
    for (const end of ends) drawDot(surface, camera, end, 6, tones.start, tones.page);
}
