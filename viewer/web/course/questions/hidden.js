/** Questions of chapter 7: hulls, and proofs of a few points. */
import { drawDot, drawPlan } from '../../parts/plan.js';
import { drawHull, hull } from '../hidden.js';
import { box, side } from '../lines.js';
import { drawText } from '../maps.js';
import { choice, number, yesNo } from './ask.js';
import { clearPortals } from './lines.js';

/** Places in general position: no three are nearly on one line. */
function scattered(chance, count) {
    const points = [];
    while (points.length < count)
        points.push(chance.until(() => {
            const p = [chance.whole(4, 32) / 2, chance.whole(3, 21) / 2];
            return points.every((a, i) => Math.hypot(a[0] - p[0], a[1] - p[1]) > 1.5 && points.slice(i + 1).every((b) => Math.abs(side(a, b, ...p)) > 4)) ? p : null;
        }));
    return points;
}

const dots = (title, points, tone = () => 'sourceEdge', more = () => {}) => ({ title, box, draw(surface, camera, tones) {
    drawPlan(surface, camera, {}, tones);
    more(surface, camera, tones);
    points.forEach((p, i) => {
        drawDot(surface, camera, p, 6, tones[tone(i)], tones.page);
        drawText(surface, camera, p, String.fromCharCode(65 + i), tones, 14, -10);
    });
} });

function corners(chance) {
    const points = scattered(chance, chance.whole(5, 8)), count = hull(points).length;
    return number('How many corners has the convex hull of these points?', count, 'The other points lie inside of the rubber band.', 'Put a rubber band around all points. Which of them does it touch?', dots('Points in the plane', points));
}

function radon(chance) {
    const points = scattered(chance, 4), isCrossing = hull(points).length === 4, why = 'If all four are corners of their hull, its two diagonals cross. Otherwise one lies in the triangle of the others.';
    return choice('Four points fall into two groups whose hulls meet. How?', [['Two segments cross.', why], ['A triangle has a point inside.', why]], isCrossing ? 0 : 1, dots('Four points', points));
}

function meet(chance, lab) {
    const isHidden = chance.next() < 0.5, portals = clearPortals(chance, lab, 3, isHidden ? 'hidden' : 'stabbed'), ends = portals.flatMap(([lx, ly, rx, ry]) => [[lx, ly], [rx, ry]]);
    return yesNo('Blue points are left ends of portals, the others right ends. Do the hulls of the two groups meet?', isHidden,
        'If they do not meet, a line runs between them: it passes all portals.', dots('Ends of portals in two colours', ends, (i) => (i % 2 ? 'right' : 'left')));
}

function proof(chance) {
    const isCrossing = chance.next() < 0.5, { points, left } = chance.until(() => {
        const p = scattered(chance, 4), order = hull(p);
        if (order.length !== 4) return null;
        const first = p.indexOf(order[0]), opposite = p.indexOf(order[2]), beside = p.indexOf(order[1]);
        return { points: p, left: [first, isCrossing ? opposite : beside] };
    });
    return yesNo('Two of these points are left ends (blue), two are right ends. Do they prove that no line passes?', isCrossing,
        'They do if the segment between the left ends crosses the segment between the right ends.', dots('Two left and two right ends', points, (i) => (left.includes(i) ? 'left' : 'right'),
            (surface, camera, tones) => [true, false].forEach((is) => drawHull(surface, camera, points.filter((_, i) => left.includes(i) === is), tones[is ? 'left' : 'right']))));
}

export const kinds = [corners, radon, meet, proof];
