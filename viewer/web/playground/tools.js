/**
 * What a press, a move and a release do with each tool. Places are in map units, so the pointer, a
 * finger and the keyboard's cross all work in the same way.
 */
import { CameraTool } from './cameras.js';
import { moveEnds, pick, shiftItem } from './pick.js';

/** @typedef {[number, number]} Place */

const same = (a, b) => a[0] === b[0] && a[1] === b[1];

/** Draws things of two ends: by a drag, or by two presses. */
class DrawTool {
    constructor(app, kind) {
        this.app = app;
        this.kind = kind;
        this.from = null;
        this.to = null;
        this.dragged = false;
    }
    press(raw) {
        const place = this.app.snap(raw);
        if (this.from && !this.dragged) return this.finish(place, this.kind === 'wall');
        this.from = this.to = place;
        this.dragged = false;
    }
    move(raw, held) {
        this.to = this.app.snap(raw);
        if (held && this.from && !same(this.from, this.to)) this.dragged = true;
    }
    release(raw) {
        if (this.from && this.dragged) this.finish(this.app.snap(raw), false);
        this.dragged = false;
    }
    finish(place, goOn) {
        const points = [...this.from, ...place];
        const done = same(this.from, place);
        this.from = goOn && !done ? place : null;
        if (done) return;
        /** @type {import('../formats/map-text.js').Item} */
        const item = { kind: this.kind, points };
        if (this.kind === 'door') Object.assign(item, { name: this.app.freeName('door'), state: 'open' });
        this.app.doc.add(item);
    }
    cancel() {
        this.from = null;
    }
    preview() {
        return this.from ? [...this.from, ...(this.to ?? this.from)] : null;
    }
}

/** Moves ends and whole items; a press on nothing lets go. */
class MoveTool {
    constructor(app) {
        this.app = app;
        this.held = null;
    }
    press(raw) {
        if (this.held) return this.release();
        const { doc } = this.app, found = pick(doc.items, ...raw, this.app.reach());
        doc.select(found ? found.index : -1);
        if (!found) return;
        const item = doc.items[found.index];
        const at = found.end < 0 ? null : /** @type {Place} */ (item.points.slice(found.end, found.end + 2));
        this.held = { index: found.index, at, item, from: raw, items: doc.items, step: {} };
        this.app.live.begin(item);
    }
    move(raw) {
        const { doc } = this.app, h = this.held;
        if (!h) return;
        if (h.at) {
            const place = this.app.snap(raw, doc.items[h.index]);
            if (same(place, h.last ?? h.at)) return;
            h.last = place;
            doc.change(moveEnds(h.items, h.at, place), h.step);
        } else {
            const [ax, ay] = this.app.snap([h.item.points[0] + raw[0] - h.from[0], h.item.points[1] + raw[1] - h.from[1]], doc.items[h.index]);
            const moved = shiftItem(h.item, ax - h.item.points[0], ay - h.item.points[1]);
            if (String(moved.points) === String(doc.items[h.index].points)) return;
            doc.change(h.items.map((item, i) => (i === h.index ? moved : item)), h.step);
        }
        doc.select(h.index);
    }
    release() {
        this.held = null;
        if (this.app.live.end()) this.app.bake();
    }
    cancel() {
        const { held } = this;
        this.held = null;
        this.app.live.end();
        if (held && this.app.doc.items !== held.items) this.app.doc.undo();
        this.app.doc.select(-1);
    }
}

/** Places a start; there may be several. */
class StartTool {
    constructor(app) {
        this.app = app;
    }
    press(raw) {
        this.app.doc.add({ kind: 'start', points: this.app.snap(raw), heading: 0 });
    }
}

/** The eye follows; a press holds it at its place, and lets it go again. */
class LookTool {
    constructor(app) {
        this.app = app;
        this.pinned = false;
    }
    press(raw) {
        this.wasPinned = this.pinned;
        this.pinned = false;
        this.move(raw);
    }
    move(raw) {
        if (!this.pinned) this.app.setEye(raw);
    }
    release(raw) {
        this.move(raw);
        this.pinned = !this.wasPinned;
    }
    cancel() {
        this.pinned = false;
    }
}

/** Two cells: a press chooses the first one, a second press or the end of a drag the other one. */
class WhyTool {
    constructor(app) {
        this.app = app;
        this.asking = false;
    }
    press(raw) {
        this.app.askWhy(this.asking ? null : raw, raw);
        this.asking = !this.asking;
        this.dragged = false;
    }
    move(raw, held) {
        if (this.asking) this.app.askWhy(null, raw);
        this.dragged ||= held;
    }
    release() {
        if (this.dragged) this.asking = false;
    }
    cancel() {
        this.asking = false;
        this.app.forgetWhy();
    }
}

/** @param {any} app @returns {Record<string, any>} */
export function makeTools(app) {
    return {
        look: new LookTool(app),
        why: new WhyTool(app),
        move: new MoveTool(app),
        start: new StartTool(app),
        wall: new DrawTool(app, 'wall'),
        door: new DrawTool(app, 'door'),
        mirror: new DrawTool(app, 'mirror'),
        oneway: new DrawTool(app, 'oneway'),
        cameras: new CameraTool(app),
        line: app.line,
        path: app.path,
    };
}
