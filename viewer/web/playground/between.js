/**
 * Two places and what is asked about them: what is seen from the line that joins them, and the shortest
 * way. Each is put by a drag or by two clicks, and its ends are moved so, too. Answers follow the ends,
 * the map and its doors.
 */
import { t } from '../language/language.js';
import { Latest } from '../core/latest.js';
import { plural } from '../formats/words.js';
import { drawBetween, drawSeenFrom, seenColours } from '../parts/between.js';
import * as panel from './panel.js';

const get = (id) => /** @type {any} */ (document.getElementById(id));
const short = (value) => value.toLocaleString('en', { maximumSignificantDigits: 5 });
const lengthOf = ([[ax, ay], [bx, by]]) => Math.hypot(bx - ax, by - ay);

/** A tool, and its part of the panel. Subclasses have `begin`, `wanted`, `rows`, `brief` and `tell`. */
class Between {
    /** @param {any} app the playground @param {import('../core/client.js').CoreClient} client @param {'line' | 'path'} id */
    constructor(app, client, id) {
        this.app = app;
        this.client = client;
        this.id = id;
        this.jobs = new Latest(() => this.run());
        /** Both ends; the same place until the second one is chosen. @type {import('../parts/between.js').Ends | null} */
        this.ends = null;
        /** The end that follows the pointer; -1: none. Where the ends were before. */
        this.held = -1;
        this.before = null;
        /** The last answer and the ends that it is of; null: none of this map. @type {any} */
        this.answer = null;
        this.fault = '';
        /** The number of the map, with its doors. */
        this.turn = 0;
        /** The ends were moved, and the answer is to be said beside the plan. */
        this.moves = false;
        this.busy = false;
        get(`${id}-clear`).addEventListener('click', () => this.remove());
        get(`${id}-stop`).addEventListener('click', () => client.stop(new Error(t('it was stopped.'))));
        this.show();
    }

    get isLine() {
        return this.ends !== null && lengthOf(this.ends) > 0;
    }

    // --- the tool

    press(raw) {
        this.moved = this.held >= 0;
        if (this.moved) return this.put(raw);
        const reach = 1.2 * this.app.reach(), place = this.app.snap(raw);
        this.before = this.ends;
        this.held = (this.ends ?? []).findIndex(([x, y]) => Math.hypot(x - raw[0], y - raw[1]) <= reach);
        if (this.held >= 0) return this.show();
        this.held = 1;
        this.set([place, place]);
    }
    move(raw) {
        if (this.held >= 0) this.put(raw);
    }
    /** Where the end has not moved since the press, it follows until the next one. */
    release(raw) {
        if (this.held < 0 || !this.moved) return;
        this.put(raw);
        this.held = -1;
        if (this.isLine) this.show();
        else this.set(null);
    }
    cancel() {
        if (this.held < 0) return;
        this.held = -1;
        this.set(this.before);
    }
    put(raw) {
        const place = this.app.snap(raw), old = this.ends[this.held];
        if (place[0] === old[0] && place[1] === old[1]) return;
        this.moved = true;
        this.set(this.ends.map((end, i) => (i === this.held ? place : end)));
    }

    // --- answers

    set(ends) {
        this.ends = ends;
        this.fault = '';
        this.moves = this.isLine;
        if (this.isLine) this.jobs.want(null);
        else this.answer = null;
        this.show();
        this.app.redraw();
    }

    get canRemove() {
        return this.ends !== null;
    }
    remove() {
        this.held = -1;
        this.set(null);
    }

    /** The map changes: what was found is of another one. */
    drop() {
        this.turn++;
        this.answer = null;
        this.fault = '';
        this.moves = false;
        this.show();
    }

    /** The baked map, a door or a choice has changed. */
    changed() {
        this.drop();
        if (this.isLine) this.jobs.want(null);
        this.app.redraw();
    }

    async run() {
        const { app, ends, turn } = this;
        if (!app.plan || !this.isLine) return;
        this.busy = true;
        this.show();
        try {
            const answer = await this.client.call(this.id, { text: app.doc.text(), doors: app.openDoors(), ends, ...this.wanted() });
            // In a drag, answers about ends of a moment ago are shown with these.
            if (turn === this.turn && this.isLine) this.answer = { ends, ...answer };
        } catch (error) {
            if (turn === this.turn && ends === this.ends) [this.answer, this.fault] = [null, t`Nothing was computed: ${error.message}`];
        }
        this.busy = false;
        this.show();
        app.redraw();
    }

    // --- what is shown

    show() {
        const { id, answer, app } = this, isOpen = app.tool === id || (this.ends !== null && !app.own);
        get(id).hidden = !isOpen;
        if (!isOpen) return;
        get(`${id}-stop`).disabled = !this.busy;
        get(`${id}-clear`).disabled = !this.ends;
        panel.showTable(get(`${id}-key`), answer ? this.rows(answer) : []);
        const text = this.held >= 0 ? t('Choose the other end.') : !this.ends ? this.begin : this.fault ||
            (answer?.ends === this.ends ? this.tell(answer) : this.busy ? t('Computing ...') : '');
        if (get(`${id}-text`).textContent !== text) get(`${id}-text`).textContent = text;
        if (!this.moves || this.held >= 0 || !(this.fault || answer?.ends === this.ends)) return;
        this.moves = false;
        get('done').textContent = this.fault || this.brief(answer);
    }

    draw(surface, camera, tones) {
        const { ends, answer, app } = this;
        if (!ends || (app.own && app.own !== this)) return;
        const line = answer?.way?.points ?? (this.id === 'line' ? (answer?.ends ?? ends).flat() : null);
        drawBetween(surface, camera, line ?? [], ends, tones);
    }
}

export class FromLine extends Between {
    constructor(app, client) {
        super(app, client, 'line');
    }
    wanted() {
        return {};
    }
    get begin() {
        return t('Drag a line in the plan, or click both of its ends.');
    }
    rows({ ends, some, all }) {
        const colours = seenColours(this.app.tones);
        return [{ name: t('length of the line'), values: [short(lengthOf(ends))] },
            { name: t('seen from some point'), colour: colours[0], values: [short(some.area)] },
            ...(all.area ? [{ name: t('seen from all points'), colour: colours[1], values: [short(all.area)] }] : [])];
    }
    brief({ some, all }) {
        // As short as a phone's width.
        return t`Some see ${short(some.area)}, all see ${all.area ? short(all.area) : t('nothing')}`;
    }
    tell({ some, all }) {
        return some.walled ? t('A wall crosses the line, so no place is seen from all of it.')
            : all.area ? '' : t('No place is seen from all points of the line.');
    }

    /** For the scene: what draws the regions. */
    get layer() {
        const { answer } = this;
        return answer && ((surface, camera, tones) => drawSeenFrom(surface, camera, [answer.some, answer.all], tones));
    }
}

export class Path extends Between {
    constructor(app, client) {
        super(app, client, 'path');
        get('path-radius').addEventListener('change', () => this.changed());
    }
    get radius() {
        return Math.max(0, Number(get('path-radius').value) || 0);
    }
    wanted() {
        return { radius: this.radius };
    }
    get begin() {
        return t('Click where the way begins.');
    }
    rows({ ends, way }) {
        return way ? [{ name: t('length of the way'), values: [short(way.length)] },
            { name: t('straight line'), values: [short(lengthOf(ends))] }] : [];
    }
    brief(answer) {
        return answer.way ? t`The way is ${short(answer.way.length)} long` : this.tell(answer);
    }
    tell({ way, ofPoint, pastDoors }) {
        const turns = way && way.points.length / 2 - 2;
        if (way) return this.radius ? '' : turns ? t`It turns at ${plural(turns, 'corner')}.` : t('It is straight.');
        if (ofPoint) return t`No way is wide enough for this radius. For a point, a way of ${short(ofPoint.length)} leads there.`;
        if (pastDoors) return t`No way leads there: a shut door is in the way. With all doors open, it would be ${short(pastDoors.length)} long.`;
        return t('No way leads there.');
    }
}
