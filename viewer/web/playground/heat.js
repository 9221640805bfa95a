/**
 * The heat map: a measure of visibility graph analysis over the plan. The graph is made anew when the
 * map, a door or the grid changes. Until then nothing is shown: old values would be those of another map.
 */
import { t } from '../language/language.js';
import { CoreClient } from '../core/client.js';
import { Latest } from '../core/latest.js';
import { countWalls } from '../formats/map-text.js';
import { drawHeat, rampColour, rangeOf, valueAt } from '../parts/heat.js';
import { isInside, cellCorners } from '../parts/plan.js';

const get = (id) => /** @type {any} */ (document.getElementById(id));

/** The depth from the eye, and the measure to begin with. */
const DEPTH = 'visual_step_depth', USUAL = 'visual_integration_hh';
const labelOf = (name) => name.replaceAll('_', ' ') + (name === DEPTH ? ' from the eye' : '');

/** The usual grid has up to this number of points. */
const USUAL_POINTS = 3000;

/** The smallest of 1, 2, 5, 10 ... that gives few enough points. @param {import('../parts/plan.js').Space} space */
function usualStep(space) {
    let area = 0;
    for (let i = 0; i < space.cellCount; i++) {
        if (!isInside(space, i)) continue;
        const p = cellCorners(space, i), n = p.length;
        for (let k = 0; k < n; k += 2) area += (p[k] * p[(k + 3) % n] - p[(k + 2) % n] * p[k + 1]) / 2;
    }
    const least = Math.sqrt(area / USUAL_POINTS) || 1, ten = 10 ** Math.floor(Math.log10(least));
    return [1, 2, 5, 10].map((digit) => Number((digit * ten).toPrecision(1))).find((step) => step >= least) ?? 10 * ten;
}

export class HeatMap {
    /** @param {any} app the playground @param {number} [memory] */
    constructor(app, memory) {
        this.app = app;
        this.client = new CoreClient(memory, './graph-worker.js');
        this.jobs = new Latest(() => this.run());
        this.depths = new Latest((eye) => this.runDepth(eye));
        /** What is shown; null: nothing. @type {import('../parts/heat.js').Heat | null} */
        this.heat = null;
        /** What the worker's graph is of. */
        this.made = '';
        this.deepest = 0;
        /** The step that was entered; null: the usual one. @type {number | null} */
        this.step = null;
        for (const id of ['heat-on', 'heat-measure']) get(id).addEventListener('change', () => this.changed());
        get('heat-step').addEventListener('change', () => {
            this.step = get('heat-step').value === '' ? null : Number(get('heat-step').value);
            this.changed();
        });
        get('heat-stop').addEventListener('click', () => {
            get('heat-on').checked = false;
            this.client.stop(new Error(t('The heat map was stopped.')));
            this.made = '';
            this.changed();
        });
    }

    get on() {
        return get('heat-on').checked;
    }
    get measure() {
        return get('heat-measure').value;
    }

    /** The map changes: nothing is shown until it is baked. */
    drop() {
        this.heat = null;
        get('heat-choices').hidden = !this.on;
        get('heat-value').textContent = '';
        this.say('');
        this.showLegend();
        this.app.redraw();
    }

    /** The baked map, a door or a choice has changed. */
    changed() {
        this.drop();
        if (this.on) this.jobs.want(null);
    }

    say(text) {
        get('heat-text').textContent = text;
    }

    wanted() {
        const grid = this.step ?? usualStep(this.app.plan);
        return { text: this.app.doc.text(), grid, doors: this.app.openDoors() };
    }

    /** The measures to choose from: the worker's module knows them. */
    async fill() {
        const choice = get('heat-measure');
        if (choice.length) return;
        const names = [DEPTH, ...await this.client.call('measures', {})];
        if (choice.length) return;
        choice.append(...names.map((name) => new Option(labelOf(name), name)));
        choice.value = USUAL;
    }

    async run() {
        if (!this.on || !countWalls(this.app.doc.items) || !this.app.plan) return;
        const wanted = this.wanted(), key = JSON.stringify(wanted);
        // Not into what is being typed.
        if (document.activeElement !== get('heat-step')) get('heat-step').value = String(wanted.grid);
        get('heat-stop').disabled = false;
        this.say(t('Computing ...'));
        try {
            await this.fill();
            const { measure } = this;
            if (key !== this.made) {
                this.made = '';
                this.deepest = 0;
                this.graph = await this.client.call('graph', wanted);
                this.sizes = await this.client.call('values', { measure: 'visual_node_count' });
                this.made = key;
            }
            const values = measure === DEPTH ? null : await this.client.call('values', { measure });
            if (!this.on || !this.app.plan || this.measure !== measure || JSON.stringify(this.wanted()) !== key) return;
            this.say(t`${this.graph.count.toLocaleString(document.documentElement.lang)} points` + (this.graph.directed ? t(', of what a point sees') : ''));
            if (values) this.show(values, rangeOf(values, this.sizes));
            else this.follow();
        } catch (error) {
            // What the message says of the command's options is no help here.
            if (this.on) this.say(t`No heat map: ${error.message.replace(/; --without .*/, '')}`);
        } finally {
            get('heat-stop').disabled = true;
        }
    }

    show(values, { least, most }) {
        this.heat = { ...this.graph, values, least, most };
        this.showLegend();
        this.app.redraw();
    }

    /** The eye has moved: depths are from it. */
    follow() {
        if (this.on && this.measure === DEPTH && this.made && this.app.eye) this.depths.want(this.app.eye);
    }

    async runDepth(eye) {
        const key = this.made;
        try {
            const values = await this.client.call('depth', { eye });
            if (!values || !this.on || this.measure !== DEPTH || this.made !== key || !key) return;
            if (!this.app.plan || JSON.stringify(this.wanted()) !== key) return;
            // The scale holds while the eye moves: it ends at the most steps that were counted.
            this.deepest = Math.max(this.deepest, rangeOf(values).most);
            this.show(values, { least: 0, most: this.deepest });
        } catch (error) {
            if (this.on) this.say(t`No heat map: ${error.message}`);
        }
    }

    showLegend() {
        const ns = 'http://www.w3.org/2000/svg', bar = get('heat-legend'), { heat } = this;
        bar.hidden = !heat;
        if (!heat) return;
        const number = (v) => v.toLocaleString('en', { maximumSignificantDigits: 4 });
        const boxes = Array.from({ length: 24 }, (_, i) => {
            const box = document.createElementNS(ns, 'rect');
            const from = { x: i * 10, y: 0, width: 11, height: 14, fill: rampColour(this.app.tones.dark, (i + 0.5) / 24) };
            for (const [k, v] of Object.entries(from)) box.setAttribute(k, String(v));
            return box;
        });
        bar.querySelector('svg').replaceChildren(...boxes);
        get('heat-least').textContent = number(heat.least);
        get('heat-most').textContent = number(heat.most);
    }

    /** For the scene: what draws the heat map. */
    get layer() {
        const { heat } = this;
        return heat && ((surface, camera, tones) => drawHeat(surface, camera, heat, tones));
    }

    /** The value under the pointer, as text. @param {number[]} place */
    textAt(place) {
        const value = this.heat && valueAt(this.heat, place);
        if (value === undefined || value === null) return '';
        const text = Number.isNaN(value) ? t('not defined') : value.toLocaleString(document.documentElement.lang, { maximumSignificantDigits: 5 });
        return `${labelOf(this.measure)}: ${text}`;
    }
}
