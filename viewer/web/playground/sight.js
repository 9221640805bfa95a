/**
 * What is seen of the map that is drawn: it bakes the map whenever it changes, looks from the eye, and
 * asks why. All of it is work of the core; of the answers the newest one counts.
 */
import { t } from '../language/language.js';
import { Latest } from '../core/latest.js';
import { countWalls } from '../formats/map-text.js';
import { plural } from '../formats/words.js';
import { dualFigure } from '../parts/dual.js';
import { cellCorners, isInside, measureOutline } from '../parts/plan.js';
import { tellWhy } from '../parts/why-scene.js';
import * as panel from './panel.js';

const get = (id) => /** @type {any} */ (document.getElementById(id));

/** The middle of the largest cell inside. @param {import('../parts/plan.js').Space} space */
function largestCell(space) {
    let best = null, most = 0;
    for (let i = 0; i < space.cellCount; i++) {
        const p = cellCorners(space, i), n = p.length / 2;
        let x = 0, y = 0;
        for (let k = 0; k < n; k++) {
            x += p[2 * k] / n;
            y += p[2 * k + 1] / n;
        }
        const { area } = measureOutline(p);
        if (isInside(space, i) && area > most) [most, best] = [area, [x, y]];
    }
    return best;
}

export class Sight {
    /** @param {import('./document.js').MapDocument} doc @param {import('../core/client.js').CoreClient} client */
    constructor(doc, client) {
        this.doc = doc;
        this.client = client;
        this.bakes = new Latest((wanted) => this.runBake(wanted));
        this.looks = new Latest((eye) => this.runLook(eye));
        this.questions = new Latest((places) => this.runExplain(places));
        this.eye = null;
        /** What the eye sees, its visible set also as a set. */
        this.seen = null;
        /** The last two places of a question, their cells, and the answer. */
        this.places = null;
        this.pair = null;
        this.why = null;
        /** Doors that were opened or shut by hand, by name. @type {Record<string, boolean>} */
        this.doors = {};
        /** The last baked map; null where there is none. @type {import('../core/core.js').Plan | null} */
        this.plan = null;
        this.bakeTime = 0;
        /** What was said about what is inside. */
        this.inside = '';
        /** Bakes that take less than this, in milliseconds, are waited for: a step of a drag is drawn once. */
        this.patience = 50;
        /** Until when drawing waits for the bake that runs. */
        this.drawAt = 0;
        /** @type {import('../parts/tones.js').Tones | null} */
        this.tones = null;
    }

    /** Draws anew. */
    redraw() {}

    /** What follows the baked map and its doors, each with `drop` and `changed`. @returns {any[]} */
    followers() {
        return [];
    }

    bake() {
        this.bakes.want({ sight: get('sight').value });
    }

    async runBake(options) {
        if (!countWalls(this.doc.items)) return this.begun();
        panel.showBusy(t('Computing what is seen'));
        this.drawAt = this.bakeTime < this.patience ? performance.now() + this.patience : 0;
        try {
            const eye = this.eye ?? this.startPlace();
            this.baked(await this.client.call('bake', { text: this.doc.text(), options, doors: this.doors, eye }));
        } catch (error) {
            this.failed(error);
        }
        panel.showBusy('');
    }

    /** A map without walls: nothing to compute yet. */
    begun() {
        this.plan = this.seen = this.why = null;
        this.hasError = false;
        panel.showDoors([], new Set(), () => {});
        panel.showMessage(t('Draw a wall, or open a file. Undo brings back the last map.'));
        this.showFacts();
        this.redraw();
    }

    baked({ plan, bakeTime, seen }) {
        this.drawAt = 0;
        this.plan = plan;
        this.bakeTime = bakeTime;
        this.shut = new Set(plan.doors.filter((door) => !door.open).map((door) => door.name));
        panel.showDoors([...new Set(plan.doors.map((door) => door.name))], this.shut, (name, open) => this.setDoor(name, open));
        if (this.hasError || plan.inside !== this.inside || panel.hasNote())
            panel.showState(plan.inside && `${plan.inside}.`.replace(/^./, (c) => c.toUpperCase()));
        this.inside = plan.inside;
        this.hasError = false;
        this.eye ??= this.startPlace();
        if (this.eye) this.useSeen(seen);
        else this.setEye(largestCell(plan));
        if (this.places) this.questions.want(this.places);
        this.followers().forEach((each) => each.changed());
        this.redraw();
    }

    failed(error) {
        this.drawAt = 0;
        this.plan = this.seen = this.why = null;
        const item = error.line ? this.doc.items[error.line - 2] : null;
        if (item) this.doc.select(error.line - 2);
        this.hasError = true;
        panel.showMessage(item ? `${error.message}\n${t`The error is in this part, which is chosen now: ${t(item.kind)}.`}` : error.message, true);
        this.showFacts();
        this.redraw();
    }

    startPlace() {
        return this.doc.items.find((item) => item.kind === 'start')?.points ?? null;
    }
    setEye(place) {
        this.eye = place;
        if (this.plan && place) this.looks.want(place);
        this.heat.follow();
        this.redraw();
    }

    async runLook(eye) {
        try {
            this.useSeen(await this.client.call('look', { eye, doors: this.doors }));
        } catch {
            this.useSeen(null); // The bake that failed or was cancelled has said so.
        }
        this.redraw();
    }

    useSeen(seen) {
        this.seen = seen && { ...seen, set: new Set(seen.row) };
        this.showFacts();
    }

    /** Doors as they stand, by name. */
    openDoors() {
        return Object.fromEntries((this.plan?.doors ?? []).map(({ name }) => [name, !this.shut.has(name)]));
    }

    setDoor(name, open) {
        this.doors[name] = open;
        if (open) this.shut.delete(name);
        else this.shut.add(name);
        this.followers().forEach((each) => each.changed());
        this.setEye(this.eye);
    }

    showFacts() {
        const plan = this.plan, seen = this.seen;
        panel.showFacts([
            [t('Wall segments'), countWalls(this.doc.items)],
            [t('Cells'), plan?.cellCount],
            [t('Portals'), plan?.portalCount],
            [t('Pairs that see each other'), plan?.pairs],
            [t('Baked in'), plan && `${this.bakeTime.toFixed(1)} ms`],
            [t('Cell of the eye'), seen?.cell],
            [t('The cell sees'), seen?.set && plural(seen.set.size, 'cell')],
            [t('The eye sees'), seen?.set && plural(seen.kept, 'cell')],
            [t('Area in sight'), seen && Number(measureOutline(seen.region).area.toPrecision(6))],
            [t('Its perimeter'), seen && Number(measureOutline(seen.region).perimeter.toPrecision(6))],
        ]);
        get('where').textContent = this.eye ? t`Eye at ${this.eye.map((v) => Math.round(v * 1000) / 1000).join(', ')}` +
            (seen ? '' : this.plan ? t(', not inside: put a start in a room') : '') : '';
    }

    /** Asks for a pair of cells by places; null keeps the first one. */
    askWhy(from, to) {
        this.places = { from: from ?? this.places?.from ?? to, to };
        if (this.plan) this.questions.want(this.places);
    }

    async runExplain(places) {
        try {
            const { pair, why } = await this.client.call('explain', places);
            if (!this.places) return;
            [this.pair, this.why] = [pair, why];
            panel.showWhy(Math.min(...pair) < 0 ? t('Choose two places inside the map.')
                : why ? tellWhy(why) : t`Cell ${pair[0]} is chosen. Choose a second place.`);
            panel.showDual(why?.dual ? dualFigure(why, this.tones) : null);
        } catch (error) {
            this.why = null;
            panel.showWhy(error.message);
        }
        this.redraw();
    }

    forgetWhy() {
        this.why = this.pair = this.places = null;
        panel.showWhy('');
        this.redraw();
    }
}
