/**
 * Map text and items: one item for each statement, so that nothing of a file is lost.
 * maps/FORMAT.md describes the statements. The core checks the rest when it bakes.
 */

/**
 * @typedef {Object} Item
 * @property {string} kind the statement: wall, walls, door ... or 'comment', 'note'
 * @property {number[]} points x, y, x, y ...
 * @property {string} [name] of a door, a path or an object
 * @property {string} [state] the word at the end: open, shut, solid, one, both
 * @property {string} [change] of a door that changes once: breakable, site
 * @property {string} [stops] of a wall: what it stops, such as 'sight,steps'; without it, all
 * @property {number} [heading] of a start @property {number} [value] of range, snap and precision
 * @property {string} [text] of comments and notes
 */

/** A file that cannot be read, with the line where there is one. */
export class FormatError extends Error {
    /** @param {string} message @param {number} [line] */
    constructor(message, line) {
        super(line ? `Line ${line}: ${message}` : message);
        this.name = 'FormatError';
        this.line = line;
        this.words = message;
    }
}

/**
 * name: a word comes first; points: at least and at most that many; words: what may end it; changes: after
 * that; stops: before what it stops, which the core checks; whole: all that follows is its name.
 */
const statements = {
    wall: { points: [2, 2], words: ['solid'], stops: true },
    walls: { points: [2, Infinity], stops: true },
    solid: { points: [3, Infinity], stops: true },
    open: { points: [3, Infinity] },
    door: { name: true, points: [2, 2], words: ['open', 'shut'], changes: ['breakable', 'site'] },
    mirror: { points: [2, 2], words: ['one', 'both'] },
    oneway: { points: [2, 2] },
    seam: { points: [2, 2] },
    path: { name: true, points: [1, Infinity] },
    object: { name: true, points: [2, 2] },
    cell: { points: [3, Infinity] },
    range: { value: true },
    snap: { value: true },
    precision: { value: true },
    entrance: { value: true, words: ['doors'] },
    unit: { whole: true, points: [0, 0] },
    earth: { whole: true, points: [0, 0] },
    crs: { whole: true, points: [0, 0] },
    start: { heading: true },
};

export const kinds = Object.keys(statements);

const numeral = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

function readNumber(word, line) {
    const value = numeral.test(word) ? Number(word) : NaN;
    if (!Number.isFinite(value)) throw new FormatError(`expected a finite decimal number, found '${word}'`, line);
    return value;
}

/** @returns {Item} */
function readStatement(words, line) {
    const [kind, ...rest] = words, form = statements[kind];
    if (!Object.hasOwn(statements, kind)) throw new FormatError(`unknown statement '${kind}'`, line);
    /** @type {Item} */
    const item = { kind, points: [] };
    if (form.name) item.name = rest.shift();
    if (form.whole) item.name = rest.splice(0).join(' ');
    if (form.stops && rest[rest.length - 2] === 'stops') item.stops = rest.splice(-2)[1];
    if (form.changes?.includes(rest[rest.length - 1])) item.change = rest.pop();
    if (form.words?.includes(rest[rest.length - 1])) item.state = rest.pop();
    const numbers = rest.map((word) => readNumber(word, line));
    const wrong = () => new FormatError(`'${kind}' has the wrong number of values`, line);
    if (form.value || form.heading) {
        if (numbers.length !== (form.value ? 1 : 3)) throw wrong();
        if (form.value) return { ...item, value: numbers[0] };
        return { ...item, points: numbers.slice(0, 2), heading: numbers[2] };
    }
    const [least, most] = form.points;
    if (numbers.length % 2 || numbers.length < 2 * least || numbers.length > 2 * most) throw wrong();
    return { ...item, points: numbers };
}

/** @param {string} text @returns {Item[]} */
export function parseMap(text) {
    const items = [];
    let started = false;
    text.replace(/^\ufeff/, '').split(text.includes('\n') ? '\n' : '\r').forEach((raw, i) => {
        const line = raw.replace(/\r$/, ''), at = line.indexOf('#');
        const words = (at < 0 ? line : line.slice(0, at)).split(/[ \t]+/).filter(Boolean);
        const said = at < 0 ? '' : line.slice(at);
        if (!words.length && !said) return;
        if (said) items.push({ kind: said.startsWith('#! ') ? 'note' : 'comment', points: [], text: said });
        if (!words.length) return;
        if (!started) {
            if (words[0] !== 'sightline')
                throw new FormatError(`expected 'sightline 1' as the first statement, found '${words[0]}'`, i + 1);
            if (words.length !== 2 || words[1] !== '1')
                throw new FormatError(`expected version 1 alone ('sightline 1'), found '${words.slice(1).join(' ')}'`, i + 1);
            started = true;
        } else {
            items.push(readStatement(words, i + 1));
        }
    });
    if (!started) throw new FormatError("expected 'sightline 1' as the first statement, found none");
    return items;
}

/** @param {Item} item @returns {string} */
export function writeItem(item) {
    if (item.text !== undefined) return item.text;
    let text = item.kind;
    if (item.name !== undefined) text += ` ${item.name}`;
    for (const value of item.points) text += ` ${value}`;
    if (item.heading !== undefined) text += ` ${item.heading}`;
    if (item.value !== undefined) text += ` ${item.value}`;
    if (item.state) text += ` ${item.state}`;
    if (item.change) text += ` ${item.change}`;
    return item.stops ? `${text} stops ${item.stops}` : text;
}

/** Item i is on line i + 2. @param {Item[]} items @returns {string} */
export function writeMap(items) {
    let text = 'sightline 1\n';
    for (const item of items) text += `${writeItem(item)}\n`;
    return text;
}

/** The box about all points; a unit box where there are none. @param {Item[]} items */
export function boundsOf(items) {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const { points } of items)
        for (let i = 0; i + 1 < points.length; i += 2) {
            box[0] = Math.min(box[0], points[i]);
            box[1] = Math.min(box[1], points[i + 1]);
            box[2] = Math.max(box[2], points[i]);
            box[3] = Math.max(box[3], points[i + 1]);
        }
    return box[0] <= box[2] ? box : [0, 0, 20, 12];
}

/** How many walls the items are. @param {Item[]} items */
export function countWalls(items) {
    let count = 0;
    for (const { kind, points } of items)
        if (kind === 'wall' || kind === 'mirror') count++;
        else if (kind === 'walls') count += points.length / 2 - 1;
        else if (kind === 'solid' || kind === 'open') count += points.length / 2;
    return count;
}
