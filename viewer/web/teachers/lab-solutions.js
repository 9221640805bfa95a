/** Code that passes the labs, by the names of their exercises, and why it does. */
import { funnelCode, pullCode, regionCode, searchCode } from '../course/lab-code.js';

/** The code of a lab with lines put in. */
const filled = ({ text, your }, lines) => text.replace(your, lines);

export const solutions = {
    region: {
        why: 'The ray meets the line of the wall at eye + t d = a + s (b - a). Cramer\'s rule gives t and s. The wall is met if s is between 0 and 1 and t is above 0. ' +
            'The small number 1e-9 fails for walls that are far away and close together; the angular sweep needs no such number.',
        code: filled(regionCode, `        const wx = bx - ax, wy = by - ay, area = dx * wy - dy * wx;
        if (area === 0) continue; // the wall lies along the ray
        const t = ((ax - eye[0]) * wy - (ay - eye[1]) * wx) / area;
        const s = ((ax - eye[0]) * dy - (ay - eye[1]) * dx) / area;
        if (t > 0 && s >= 0 && s <= 1) best = Math.min(best, t);
`),
    },
    visible: {
        why: 'A longer sequence has all conditions of the shorter one, so a portal that no line passes ends this way, and nothing behind it is lost. ' +
            'A cell that was seen before is entered again: the new way may lead on to other cells.',
        code: filled(searchCode, `            const longer = [...sequence, portal];
            if (stabs(longer)) search(portal.to, longer);
`),
    },
    funnel: {
        why: 'The lines that pass the portals so far are a convex polygon of the dual plane, and the list has its corners. An end cuts it with a half-plane. ' +
            'On an edge that the cut crosses, all lines go through one end, `about`; the new corner goes through it, too. From the first new corner on, lines turn about the new end. ' +
            'No coordinate is computed, so nothing is rounded.',
        code: filled(funnelCode, `    corners.forEach((corner, i) => {
        const next = corners[(i + 1) % corners.length], { about } = corner;
        const [now, then] = [corner, next].map(({ from, to }) => sign * side(from, to, end));
        if (now >= 0) kept.push({ ...corner, about: now === 0 && then < 0 ? end : about });
        if (now > 0 && then < 0) kept.push({ from: about, to: end, about: end });
        if (now < 0 && then > 0) kept.push({ from: about, to: end, about });
    });
`),
    },
    pull: {
        why: 'Each string is the shortest way to its end, so it bends one way only. A corner at which it would bend the other way is not on the new string. ' +
            'When the end lies across the other string, all ways go around the first corner of that one, so this corner is the new apex.',
        code: filled(pullCode, `    while (own.length > 1 && turn * side(own.at(-2), own.at(-1), end) <= 0) own.pop();
    while (own.length === 1 && other.length > 1 && turn * side(other[0], other[1], end) < 0) {
        way.push(other.shift());
        own[0] = other[0];
    }
`),
    },
};
