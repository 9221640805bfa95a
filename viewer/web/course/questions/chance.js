/** Numbers that look like chance and are the same for the same words, and plans of such numbers. */

import { isSimple } from '../fisk.js';

/** A number that depends on a text alone (FNV-1a, 32 bits). */
export const hash = (text) => [...text].reduce((sum, c) => Math.imul(sum ^ c.codePointAt(0), 0x01000193) >>> 0, 0x811c9dc5);

/** Spreads a difference of one bit over all bits (the last steps of MurmurHash3). */
function mixed(h) {
    h = Math.imul(h ^ (h >>> 16), 0x85ebca6b);
    h = Math.imul(h ^ (h >>> 13), 0xc2b2ae35);
    return (h ^ (h >>> 16)) >>> 0;
}

export class Chance {
    /** @param {string} words the same words give the same numbers */
    constructor(words) {
        this.number = (mixed(hash(words)) % 2147483646) + 1;
    }

    /** The next number from 0 to 1 (Park and Miller 1988). */
    next() {
        return (this.number = (this.number * 48271) % 2147483647) / 2147483647;
    }

    /** A whole number, both ends included. */
    whole(low, high) {
        return low + Math.floor(this.next() * (high - low + 1));
    }

    of(list) {
        return list[this.whole(0, list.length - 1)];
    }

    /** A place in a box, on a grid of a tenth. */
    place([x0, y0, x1, y1]) {
        return [this.whole(10 * x0 + 5, 10 * x1 - 5) / 10, this.whole(10 * y0 + 5, 10 * y1 - 5) / 10];
    }

    /** What `make` gives first that is something. Questions ask for what is common, so this ends early. */
    until(make) {
        for (let tries = 0; tries < 500; tries++) {
            const made = make();
            if (made !== null) return made;
        }
        throw new Error('no question of this kind was found');
    }
}

const SIDE = 4;

/**
 * Rooms in a grid; most walls between two rooms have a door, somewhere. With `doors` these are doors of the map, with names.
 * @param {Chance} chance @returns {{text: string, box: number[], doors: string[]}}
 */
export function roomsOf(chance, columns, rows, { doors: isNamed = false, missing = 0.2 } = {}) {
    const [width, height] = [SIDE * columns, SIDE * rows], doors = [];
    const lines = ['sightline 1', `walls 0 0 ${width} 0 ${width} ${height} 0 ${height} 0 0`];
    const put = (place) => {
        const from = chance.whole(4, 20) / 10, to = from + chance.whole(10, 15) / 10, line = (a, b) => [...place(a), ...place(b)].map((v) => Number(v.toFixed(2))).join(' ');
        if (chance.next() < missing) return lines.push(`wall ${line(0, SIDE)}`);
        lines.push(`wall ${line(0, from)}`, `wall ${line(to, SIDE)}`);
        if (!isNamed) return;
        doors.push(String.fromCharCode(97 + doors.length));
        lines.push(`door ${doors.at(-1)} ${line(from, to)} open`);
    };
    for (let i = 0; i < columns; i++)
        for (let j = 0; j < rows; j++) {
            if (i) put((t) => [SIDE * i, SIDE * j + t]);
            if (j) put((t) => [SIDE * i + t, SIDE * j]);
        }
    return { text: `${lines.join('\n')}\n`, box: [0, 0, width, height], doors };
}

/** Upright portals from left to right: left x, left y, right x, right y, on a grid of a half. @param {Chance} chance */
export const portalsOf = (chance, count) => Array.from({ length: count }, (_, i) => {
    const x = 3 + Math.round((12 * i) / (count - 1)), low = chance.whole(3, 15) / 2;
    return [x, low + chance.whole(3, 7) / 2, x, low];
});

/** A hall with square pillars that stand apart. @param {Chance} chance */
export function hallOf(chance, count) {
    const [width, height] = [18, 12], slots = Array.from({ length: 6 }, (_, i) => [6 * (i % 3), 6 * Math.floor(i / 3)]).sort(() => chance.next() - 0.5);
    const solids = slots.slice(0, count).map(([x, y]) => {
        const [a, b, side] = [x + chance.whole(10, 25) / 10, y + chance.whole(10, 25) / 10, chance.whole(8, 20) / 10], [c, d] = [a + side, b + side].map((v) => Number(v.toFixed(1)));
        return `solid ${a} ${b} ${c} ${b} ${c} ${d} ${a} ${d}`;
    });
    return { text: ['sightline 1', `walls 0 0 ${width} 0 ${width} ${height} 0 ${height} 0 0`, ...solids, ''].join('\n'), box: [0, 0, width, height] };
}

/** Corners of a corridor with deep niches above it, counter-clockwise. @param {Chance} chance */
export function nichesOf(chance, count) {
    const width = 18 / (2 * count + 1), top = Array.from({ length: 2 * count + 1 }, (_, i) => (i % 2 ? chance.whole(7, 11) : 2 + chance.whole(0, 2) / 2));
    const steps = top.flatMap((high, i) => [[i * width, high], [(i + 1) * width, high]]).map(([x, y]) => [Math.round(10 * x) / 10, y]).reverse();
    return [[0, 0], [18, 0], ...steps];
}

/** The sine of how far a walk turns at each corner: plus to the left. @param {number[][]} points */
export const turnsOf = (points) => points.map(([x, y], i) => {
    const [px, py] = points.at(i - 1), [qx, qy] = points[(i + 1) % points.length];
    return ((x - px) * (qy - y) - (y - py) * (qx - x)) / (Math.hypot(x - px, y - py) * Math.hypot(qx - x, qy - y));
});

/** Corners of a gallery around its middle, counter-clockwise: each at its own angle, near or far, and none of them flat. @param {Chance} chance */
export const galleryOf = (chance, least, most) => chance.until(() => {
    const count = chance.whole(least, most), points = Array.from({ length: count }, (_, i) => {
        const angle = (2 * Math.PI * (i + 0.15 + 0.7 * chance.next())) / count, far = chance.next() < 0.5 ? 2.2 : 5.6;
        return [9 + far * 1.5 * Math.cos(angle), 6 + far * Math.sin(angle)].map((v) => Math.round(2 * v) / 2);
    });
    return turnsOf(points).every((turn) => Math.abs(turn) > 0.25) && isSimple(points) ? points : null;
});
