/**
 * Cameras: placed, dragged and turned by hand, or chosen: the fewest, or the best of a number. What they
 * see together is found anew when one moves, the map changes or a door does.
 */
import { t } from '../language/language.js';
import { CoreClient } from '../core/client.js';
import { Latest } from '../core/latest.js';
import { countWalls } from '../formats/map-text.js';
import { plural } from '../formats/words.js';
import { armEnd, classColours, drawCameras, drawCoverage } from '../parts/coverage.js';
import { save } from './files.js';
import { showTable } from './panel.js';

const get = (id) => /** @type {any} */ (document.getElementById(id));
const CLASSES = [t('not seen'), t('seen by 1'), t('seen by 2'), t('seen by 3 or more')];

/** Headings to choose from, and points along walls at most. */
const HEADINGS = 8, POINTS = 500;

const short = (value) => value.toLocaleString('en', { maximumSignificantDigits: 4 });
const degrees = (dx, dy) => Math.round((Math.atan2(dy, dx) * 180) / Math.PI + 360) % 360;

export class Cameras {
    /** @param {any} app the playground @param {number} [memory] */
    constructor(app, memory) {
        this.app = app;
        this.client = new CoreClient(memory, './cameras-worker.js');
        this.client.onProgress = ({ done, total, stage }) =>
            this.say(stage === 'place' && total ? t`Computing: at least ${done}, at most ${total} so far.` : t('Computing ...'));
        this.jobs = new Latest(() => this.runCover());
        /** @type {import('../parts/coverage.js').PlanCamera[]} */
        this.list = [];
        this.chosen = -1;
        /** What they see together; null: not known. */
        this.coverage = null;
        this.choosing = false;
        /** That a choice may take. */
        this.seconds = 15;
        /** An address that the choice asks for while it works, and ends when it is revoked; empty: it was. */
        this.going = '';
        /** What was said of the cameras as they stand. */
        this.proof = '';
        for (const id of ['camera-fov', 'camera-range', 'camera-heading']) get(id).addEventListener('change', () => this.enter());
        get('camera-fewest').addEventListener('click', () => this.choose(0));
        get('camera-best').addEventListener('click', () => this.choose(Math.max(1, Math.round(Number(get('camera-count').value)) || 1)));
        get('camera-stop').addEventListener('click', () => this.stop());
        get('camera-clear').addEventListener('click', () => this.set([]));
        this.show();
    }

    /** What cameras of the panel look like. */
    get like() {
        const fov = Number(get('camera-fov').value), range = Number(get('camera-range').value);
        return { fov: fov > 0 && fov <= 360 ? fov : 360, range: range > 0 ? range : 0 };
    }

    /** Other cameras. */
    set(list, chosen = -1) {
        this.list = list;
        this.chosen = chosen;
        this.changed();
    }

    /** The camera at this place of the list is another one. */
    put(index, camera) {
        this.set(this.list.map((each, i) => (i === index ? camera : each)), index);
    }

    get canRemove() {
        return this.chosen >= 0;
    }
    remove() {
        if (this.chosen >= 0) this.set(this.list.filter((_, i) => i !== this.chosen));
    }

    select(index) {
        this.chosen = index;
        this.show();
    }

    /** Numbers of the panel are those of the chosen camera, or of the next one. */
    enter() {
        const camera = this.list[this.chosen];
        if (camera) this.put(this.chosen, { ...camera, ...this.like, heading: Number(get('camera-heading').value) || 0 });
    }

    /** The map changes: what was seen is of another one. */
    drop() {
        this.coverage = null;
        this.proof = '';
        this.show();
    }

    /** The baked map, a door or a camera has changed. */
    changed() {
        this.drop();
        if (this.list.length) this.jobs.want(null);
        this.app.redraw();
    }

    wanted() {
        return { text: this.app.doc.text(), doors: this.app.openDoors() };
    }

    async runCover() {
        if (!this.app.plan || !this.list.length || this.choosing) return;
        const { list } = this;
        try {
            const coverage = await this.client.call('cover', { ...this.wanted(), cameras: list });
            if (list === this.list) this.coverage = coverage;
        } catch (error) {
            if (list === this.list) this.proof = t`No coverage: ${error.message}`;
        }
        this.show();
        this.app.redraw();
    }

    /** The choice ends with the best cameras so far; asked once more, at once and without any. */
    stop() {
        if (!this.going) return this.client.stop(new Error(t('it was stopped.')));
        URL.revokeObjectURL(this.going);
        this.going = '';
    }

    /** The fewest cameras, or with `count` the best of so many. */
    async choose(count) {
        const { plan } = this.app;
        if (!plan || !countWalls(this.app.doc.items) || this.choosing) return;
        const from = get('camera-from').value, { fov, range } = this.like, bounds = this.app.doc.bounds();
        const size = Math.max(bounds[2] - bounds[0], bounds[3] - bounds[1]);
        const options = { timeLimit: this.seconds, ...(count ? { count } : {}) };
        this.choosing = true;
        this.going = URL.createObjectURL(new Blob());
        const wanted = this.wanted(), task = { ...wanted, options, going: this.going };
        this.show();
        this.say(t('Computing ...'));
        try {
            const found = await (from === 'anywhere' ? this.client.call('place', task)
                : this.client.call('choose', { ...task, from, step: size / (from === 'grid' ? 24 : 60), most: POINTS,
                    like: { fov, range }, headings: fov < 360 ? HEADINGS : 1 }));
            if (JSON.stringify(this.wanted()) !== JSON.stringify(wanted)) throw new Error(t('the map has changed.'));
            this.list = found.viewpoints.map(({ x, y, heading = 0 }) => ({ x, y, heading, ...(from === 'anywhere' ? { fov: 360, range: 0 } : { fov, range }) }));
            this.chosen = -1;
            this.coverage = found.coverage;
            this.proof = found.proof;
        } catch (error) {
            this.proof = t`Nothing was chosen: ${error.message}`;
        }
        this.choosing = false;
        URL.revokeObjectURL(this.going);
        this.show();
        this.app.redraw();
    }

    say(text) {
        get('camera-text').textContent = text;
    }

    /** The panel: numbers of the chosen camera, what is seen, what is proven. */
    show() {
        const camera = this.list[this.chosen], { choosing, coverage } = this;
        get('cameras').hidden = this.app.tool !== 'cameras' && !this.list.length;
        get('camera-heading').disabled = !camera;
        for (const [id, value] of Object.entries(camera ? { fov: camera.fov, range: camera.range || '', heading: camera.heading } : { heading: '' }))
            if (document.activeElement !== get(`camera-${id}`)) get(`camera-${id}`).value = String(value);
        get('camera-stop').disabled = !choosing;
        for (const id of ['fewest', 'best']) get(`camera-${id}`).disabled = choosing;
        for (const id of ['clear', 'save']) get(`camera-${id}`).disabled = choosing || !this.list.length;
        const areas = coverage?.areas ?? [], all = areas.reduce((sum, area) => sum + area, 0);
        showTable(get('camera-key'), areas.map((area, i) => ({ name: CLASSES[i], colour: classColours(this.app.tones)[i],
            values: [short(area), `${((100 * area) / all).toFixed(1)} %`] })));
        const seen = coverage?.viewpoints ?? [], blind = seen.filter((each) => !(each.seen > 0)).length;
        const spare = seen.filter((each) => each.spare && each.seen > 0).length;
        if (choosing) return;
        this.say([this.list.length ? `${plural(this.list.length, 'camera')}.` : this.app.tool === 'cameras' ? t('A click in a room puts a camera there.') : '',
            blind ? blind === 1 ? t('1 of them sees nothing of the inside.') : t`${blind} of them see nothing of the inside.` : '',
            spare === 1 ? t('The others see all that one of them sees.') : spare ? t`${spare} see nothing that the others do not.` : '', this.proof].filter(Boolean).join(' '));
    }

    saveTable() {
        const rows = this.list.map(({ x, y, heading, fov, range }, i) =>
            [`camera ${i + 1}`, x, y, fov < 360 ? heading : '', fov < 360 ? fov : '', range || ''].join(','));
        save(new Blob([`name,x,y,heading,fov,range\n${rows.join('\n')}\n`], { type: 'text/csv' }), 'cameras.csv');
    }

    /** For the scene: what draws the classes. */
    get layer() {
        const { coverage } = this;
        return coverage && ((surface, camera, tones) => drawCoverage(surface, camera, coverage.pieces, tones));
    }

    draw(surface, camera, tones) {
        drawCameras(surface, camera, this.list, this.chosen, tones);
    }
}

/** A press takes a camera, the end of its arm, or puts a new one, which a drag turns. */
export class CameraTool {
    constructor(app) {
        this.app = app;
        this.held = '';
    }
    press(raw) {
        const { cameras } = this.app, reach = this.app.reach(), { scale } = this.app.view.camera;
        const near = ([x, y]) => Math.hypot(x - raw[0], y - raw[1]) <= 1.2 * reach, chosen = cameras.list[cameras.chosen];
        if (chosen && chosen.fov < 360 && near(armEnd(chosen, scale))) return void (this.held = 'arm');
        const found = cameras.list.findIndex(({ x, y }) => near([x, y]));
        this.held = found >= 0 ? 'camera' : 'arm';
        if (found >= 0) return cameras.select(found);
        const [x, y] = this.app.keys.cross ? raw : this.app.snap(raw);
        cameras.set([...cameras.list, { x, y, heading: 0, ...cameras.like }], cameras.list.length);
    }
    move(raw, held) {
        const { cameras } = this.app, camera = cameras.list[cameras.chosen];
        if (!held || !camera || !this.held) return;
        const [x, y] = this.held === 'camera' ? this.app.snap(raw) : [camera.x, camera.y];
        const heading = this.held === 'arm' ? degrees(raw[0] - x, raw[1] - y) : camera.heading;
        if (x !== camera.x || y !== camera.y || heading !== camera.heading) cameras.put(cameras.chosen, { ...camera, x, y, heading });
    }
    release() {
        this.held = '';
    }
    cancel() {
        this.held = '';
        this.app.cameras.select(-1);
    }
}
