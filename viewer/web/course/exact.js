/**
 * Signs of three points in four kinds of arithmetic, for figures about rounding.
 *
 * A finite double is a whole number below 2^53 times a power of two. So with the smallest power of all
 * coordinates as the unit, coordinates are whole numbers, and BigInt adds and multiplies them without
 * rounding. The library does the same in fixed-point numbers (lib/geometry/orient.c); a test compares.
 *
 * The cost: some millionths of a second for each sign, against a thousandth of that in doubles.
 */
const view = new DataView(new ArrayBuffer(8));

/** A double as [m, e] with value m times 2^e. @param {number} x @returns {[bigint, number]} */
function partsOf(x) {
    view.setFloat64(0, x);
    const bits = view.getBigUint64(0), biased = Number((bits >> 52n) & 0x7ffn), fraction = bits & ((1n << 52n) - 1n);
    const m = biased ? fraction | (1n << 52n) : fraction;
    return [bits >> 63n ? -m : m, (biased || 1) - 1075];
}

/** Doubles as whole numbers of one unit, 2^unit. @param {number[]} values @returns {{unit: number, whole: bigint[]}} */
export function wholeOf(values) {
    const parts = values.map(partsOf), unit = Math.min(...parts.map(([m, e]) => (m ? e : 0)));
    return { unit, whole: parts.map(([m, e]) => (m ? m << BigInt(e - unit) : 0n)) };
}

/** The double next to n times 2^e, halves to even. Results near underflow may be off by a unit. */
export function nearest(n, e) {
    if (n < 0n) return -nearest(-n, e);
    const spare = 4 * n.toString(16).length - 64; // what is cut off only breaks ties
    if (spare > 0) {
        const top = n >> BigInt(spare), isExact = top << BigInt(spare) === n;
        [n, e] = [(top << 1n) | (isExact ? 0n : 1n), e + spare - 1];
    }
    let value = Number(n);
    for (; e < -1000; e += 1000) value *= 2 ** -1000;
    return value * 2 ** e;
}

/** The next double above a positive one, less that one: a unit in the last place. */
export const unitOf = (x) => 2 ** (Math.max(partsOf(Math.abs(x) || 1)[1], -1074));

/** a times b plus c, rounded once. */
export function fused(a, b, c) {
    const { unit, whole: [m, n] } = wholeOf([a, b]), { unit: other, whole: [k] } = wholeOf([c]), least = Math.min(2 * unit, other);
    return nearest(((m * n) << BigInt(2 * unit - least)) + (k << BigInt(other - least)), least);
}

const signOf = (v) => (v > 0 ? 1 : v < 0 ? -1 : 0);

/** (b - a) x (c - a) without rounding: whole times 2^unit. */
export function determinantOf([ax, ay], [bx, by], [cx, cy]) {
    const { unit, whole: [x0, y0, x1, y1, x2, y2] } = wholeOf([ax, ay, bx, by, cx, cy]);
    return { whole: (x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0), unit: 2 * unit };
}

/** The two products of (b - a) x (c - a) in doubles, and what is known of their difference. */
export function roundedOf([ax, ay], [bx, by], [cx, cy]) {
    const left = (bx - ax) * (cy - ay), right = (by - ay) * (cx - ax), determinant = left - right, u = 2 ** -53;
    return { left, right, determinant, bound: (3 * u + 16 * u * u) * (Math.abs(left) + Math.abs(right)) };
}

/** What each arithmetic says: 1 where c lies to the left of the line from a to b, -1 right, 0 on it. */
export const arithmetics = {
    doubles: (a, b, c) => signOf(roundedOf(a, b, c).determinant),
    fused: ([ax, ay], [bx, by], [cx, cy]) => signOf(fused(bx - ax, cy - ay, -((by - ay) * (cx - ax)))),
    epsilon(a, b, c) {
        const { determinant } = roundedOf(a, b, c);
        return Math.abs(determinant) < 1e-9 ? 0 : signOf(determinant);
    },
    exact(a, b, c) {
        const { determinant, bound } = roundedOf(a, b, c);
        if (Math.abs(determinant) > bound) return signOf(determinant);
        return signOf(determinantOf(a, b, c).whole);
    },
};
