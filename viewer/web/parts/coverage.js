/** Cameras on a plan, and how many of them see each part of it. */
import { drawDot, fillPolygons, strokeLines } from './plan.js';
import { mix } from './tones.js';

/** @typedef {{x: number, y: number, heading: number, fov: number, range: number}} PlanCamera */

/** How long the arm is by which a camera is turned, in pixels. */
export const ARM = 34;

/** What 0, 1, 2, and 3 or more see. @param {import('./tones.js').Tones} tones */
export const classColours = (tones) => [mix(tones.floor[0], tones.start, 0.42),
    ...[0.16, 0.38, 0.62].map((share) => mix(tones.floor[0], tones.glass, share))];

/** @param {{count: number, points: ArrayLike<number>}[]} pieces that tile the inside */
export function drawCoverage(surface, camera, pieces, tones) {
    const groups = [[], [], [], []];
    for (const { count, points } of pieces) groups[Math.min(count, 3)].push(points);
    classColours(tones).forEach((colour, i) => {
        fillPolygons(surface, camera, groups[i], colour);
        // Over the seams between pieces.
        strokeLines(surface, camera, groups[i], colour, 0.8, [], true);
    });
}

/** Where the arm of a camera ends. @param {PlanCamera} camera @returns {[number, number]} */
export function armEnd({ x, y, heading }, scale) {
    const angle = (heading * Math.PI) / 180;
    return [x + (ARM / scale) * Math.cos(angle), y + (ARM / scale) * Math.sin(angle)];
}

/** The sides of its view cone, as long as its range where that is in sight, and a piece of arc. */
function wedge({ x, y, heading, fov }, radius) {
    const steps = Math.max(2, Math.ceil(fov / 6)), line = fov < 360 ? [x, y] : [];
    for (let i = 0; i <= steps; i++) {
        const angle = ((heading - fov / 2 + (fov * i) / steps) * Math.PI) / 180;
        line.push(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
    }
    return line;
}

/** @param {PlanCamera[]} cameras @param {number} chosen the number of one; -1: none */
export function drawCameras(surface, camera, cameras, chosen, tones) {
    cameras.forEach((each, i) => {
        const at = [each.x, each.y], colour = i === chosen ? tones.start : tones.ink;
        if (each.fov < 360) fillPolygons(surface, camera, [wedge(each, 18 / camera.scale)], colour, 0.75);
        if (i === chosen) {
            if (each.range > 0) strokeLines(surface, camera, [wedge(each, each.range)], colour, 1, [4, 3], true);
            if (each.fov < 360) {
                const end = armEnd(each, camera.scale);
                strokeLines(surface, camera, [[...at, ...end]], colour, 2);
                drawDot(surface, camera, end, 5, tones.page, colour);
            }
        }
        drawDot(surface, camera, at, i === chosen ? 7 : 5, colour, tones.page);
    });
}
