/** The playground: brings the map, what is seen of it, the tools, files and the panel together. */
import { t } from '../language/language.js';
import { CoreClient, CoreError } from '../core/client.js';
import { countWalls, parseMap } from '../formats/map-text.js';
import { roundStep } from '../parts/camera.js';
import { drawDot, itemLine, strokeLines } from '../parts/plan.js';
import { makeTones, watchTones } from '../parts/tones.js';
import { drawWhy } from '../parts/why-scene.js';
import { FromLine, Path } from './between.js';
import { Cameras } from './cameras.js';
import { MapDocument } from './document.js';
import { acceptDrops, readFile, save, savePng, saveSvg } from './files.js';
import { HeatMap } from './heat.js';
import { Keys, onChosen } from './keys.js';
import { Live } from './live.js';
import * as panel from './panel.js';
import { snapTo } from './pick.js';
import { keepWork, loadWork, LONG_ADDRESS, packMap, unpackMap } from './share.js';
import { Sight } from './sight.js';
import { placeOf, tellChange, tellItem } from './told.js';
import { makeTools } from './tools.js';
import { View } from './view.js';

const get = (id) => /** @type {any} */ (document.getElementById(id));
const isOn = (id) => get(id).checked;

/** Above this many walls the browser is not asked to keep the map. */
const MOST_KEPT = 20000;

/** Where maps to begin with are. */
const maps = new URL('../maps/', import.meta.url);

/** The items of a shared map; one whose letters were changed on the way may still unpack. */
function readShared(text) {
    try {
        return parseMap(text);
    } catch (error) {
        throw new Error(t`The address holds a map that cannot be read. ${error.message}`);
    }
}

class Playground extends Sight {
    constructor() {
        // ?memory=MB in the address, for small devices and for tests.
        const asked = Number(new URLSearchParams(location.search).get('memory')), memory = asked > 0 ? asked * 2 ** 20 : undefined;
        super(new MapDocument(), new CoreClient(memory));
        this.tool = 'look';
        this.view = new View(get('plan'), this);
        this.view.fitTo = () => this.view.camera.fit(this.doc.bounds());
        this.heat = new HeatMap(this, memory);
        this.keys = new Keys(get('plan'), this);
        this.tones = makeTones(matchMedia('(prefers-color-scheme: dark)').matches);
        this.cameras = new Cameras(this, memory);
        const ways = new CoreClient(memory, './ways-worker.js');
        this.line = new FromLine(this, ways);
        this.path = new Path(this, ways);
        this.live = new Live(this, memory, (seen) => this.followed(seen));
        this.tools = makeTools(this);
        this.listen();
    }

    listen() {
        this.doc.addEventListener('change', () => this.changed());
        this.doc.addEventListener('select', () => this.redraw());
        this.client.onProgress = (at) => panel.showProgress(at.total ? at.done / at.total : -1, t`Computing what is seen: ${at.stage}`);
        for (const button of document.querySelectorAll('[data-do]'))
            button.addEventListener('click', () => this.act(button.dataset.do));
        for (const radio of document.querySelectorAll('input[name=tool]'))
            radio.addEventListener('change', () => this.chooseTool(radio.value));
        for (const id of ['show-cells', 'show-portals', 'show-set', 'show-region', 'snap'])
            get(id).addEventListener('change', () => this.redraw());
        get('range').addEventListener('change', () => this.setRange(Number(get('range').value)));
        get('sight').addEventListener('change', () => this.bake());
        get('one-sided').addEventListener('change', () =>
            this.changeChosen(({ state, ...item }) => (get('one-sided').checked ? { ...item, state: 'one' } : item)));
        get('file').addEventListener('change', () => {
            if (get('file').files[0]) this.openFile(get('file').files[0]);
            get('file').value = '';
        });
        onChosen(get('gallery'), (name) => this.openGallery(name));
        acceptDrops((file) => this.openFile(file));
        addEventListener('hashchange', () => this.openShared());
        addEventListener('pagehide', () => this.keep());
        watchTones((tones) => {
            this.tones = this.view.tones = tones;
            panel.showKey([[t('seen from the cell'), tones.seen[0]], [t('visible region'), tones.region],
                [t('seen in mirrors'), tones.image],
                [t('portal'), tones.portal], [t('door'), tones.door], [t('path'), tones.path], [t('box'), tones.object]]);
            this.heat?.showLegend();
            for (const each of [this.cameras, this.line, this.path]) each.show();
            this.redraw();
        });
    }

    followers() {
        return [this.heat, this.cameras, this.line, this.path];
    }

    // --- the map

    changed() {
        const { items, before } = this.doc;
        get('range').value = items.find((item) => item.kind === 'range')?.value ?? '';
        get('done').textContent = tellChange(before, items);
        this.showOrigin();
        panel.dropNote();
        this.leaveShared();
        const { held } = this.tools.move;
        if (!held || !this.live.follow(held.items)) this.bake();
        this.followers().forEach((each) => each.drop());
        clearTimeout(this.keeping);
        this.keeping = setTimeout(() => this.keep(), 400);
        this.redraw();
    }

    /** A bake from before a drag that a world follows comes too late: the end of the drag has one of its own. */
    baked(answer) {
        if (!this.live.on) super.baked(answer);
    }

    /** What the eye sees while a wall of a large map is dragged. */
    followed({ region, mirrored }) {
        this.seen = region && { region, mirrored };
        this.plan = null;
        this.showFacts();
        this.redraw();
    }

    /** The address holds a shared map as long as that is the map. Otherwise it would come back at the next load. */
    leaveShared() {
        if (this.shared === undefined || this.shared === this.doc.text()) return;
        this.shared = undefined;
        history.replaceState(null, '', location.pathname + location.search);
    }

    /** @param {(item: any) => any} make what is chosen, changed */
    changeChosen(make) {
        const { items, selected } = this.doc;
        if (selected >= 0) this.doc.change(items.map((item, i) => (i === selected ? make(item) : item)));
    }

    /** The view range is a statement of the map: 0 takes it out. @param {number} value */
    setRange(value) {
        const others = this.doc.items.filter((item) => item.kind !== 'range');
        this.doc.select(-1);
        this.doc.change(value > 0 ? [...others, { kind: 'range', points: [], value }] : others);
    }

    keep() {
        if (countWalls(this.doc.items) <= MOST_KEPT && keepWork(this.doc.text())) return;
        if (!this.saidUnkept) panel.showMessage(t('The browser cannot keep a map of this size. Save it as a file.'));
        this.saidUnkept = true;
    }

    /** Another map comes, by what `change` does: it is shown whole, and nothing is left of the one before. */
    arrive(change, message) {
        this.eye = this.places = this.pair = this.why = this.seen = null;
        this.doors = {};
        this.cameras.set([]);
        this.line.remove();
        this.path.remove();
        panel.showWhy('');
        this.tools.look.pinned = false;
        this.doc.select(-1);
        change();
        get('done').textContent = '';
        this.act('fit');
        if (message) panel.showNote(message);
    }

    /** @param {import('../formats/map-text.js').Item[]} items @param {string} name @param {string} [file] in the list of maps */
    load(items, name, message = '', file = '') {
        this.arrive(() => this.doc.load(items, name, file), message);
    }

    /** A step back, or forth again. @param {'undo' | 'redo'} way */
    travel(way) {
        const { doc } = this, said = way === 'undo' ? t('Undone') : t('Redone'), next = doc[way === 'undo' ? 'past' : 'future'].at(-1);
        if (!next) return;
        if (next.origin !== doc.origin) return this.arrive(() => doc[way](), t`${said}: ${next.origin.name} is back.`);
        doc[way]();
        get('done').textContent = `${said}. ${tellChange(doc.before, doc.items)}`;
    }

    /** The list of maps names the map, as long as nothing was changed in it. */
    showOrigin() {
        const { origin, items } = this.doc, list = get('gallery');
        list.value = origin.items === items ? origin.file : '';
        if (list.selectedIndex < 0) list.value = '';
    }

    async openFile(file, quiet = false, listed = '') {
        try {
            const { items, notes, format } = await readFile(file, (slv) => this.client.call('describe', { slv }));
            const left = notes.length ? t` Left out or guessed: ${notes.join('; ')}.` : '';
            const more = /^(SVG|Tiled|LDtk)$/.test(format) ? t(' The command has more rules for such files: sightline convert FILE -o FILE.map.') : '';
            this.load(items, file.name, quiet ? '' : t`${file.name} was read as ${format}.${left}${more}`, listed);
        } catch (error) {
            panel.showNote(error.message, true);
        }
    }

    async openGallery(name, quiet = false) {
        if (!name) return;
        if (name === 'own') return this.openFile(new File([loadWork('own')], 'your map'), quiet, name);
        try {
            const answer = await fetch(new URL(name, maps));
            if (!answer.ok) throw new Error(t`the server answered ${answer.status}`);
            await this.openFile(new File([await answer.blob()], name), quiet, name);
        } catch (error) {
            panel.showNote(t`${name} was not loaded: ${error.message}`, true);
        }
    }

    async openShared() {
        try {
            const text = await unpackMap(location.hash);
            if (text !== null) this.shared = text;
            if (text === null || text === this.doc.text()) return false;
            const items = readShared(text), own = this.doc.items.length > 0;
            if (own) keepWork(this.doc.text(), 'own');
            this.load(items, t('the shared map'), own ? t('This is a shared map. Undo brings back your own; it is in the list of maps too.') : '');
            this.shared = this.doc.text();
            this.offerOwn();
            return true;
        } catch (error) {
            panel.showMessage(error.message, true);
            return false;
        }
    }

    // --- drawing

    step() {
        return roundStep(this.view.camera.scale, 9);
    }
    reach() {
        return 10 / this.view.camera.scale;
    }
    snap(place, except = null) {
        if (!isOn('snap') || this.free) return place;
        if (this.keys.cross) return snapTo([], ...place, this.step(), 0);
        return snapTo(this.doc.items, ...place, this.step(), this.reach(), except);
    }
    middle() {
        return [this.view.camera.x, this.view.camera.y];
    }

    scene() {
        const asks = this.tool === 'why' && this.pair, { own } = this, hides = asks || own;
        const heat = asks ? null : own?.layer || this.heat.layer;
        return {
            space: this.plan,
            items: this.doc.items,
            shut: this.shut,
            heat,
            seen: hides || heat || !isOn('show-set') ? null : this.seen?.set,
            region: hides || heat || !isOn('show-region') ? null : this.seen?.region,
            mirrored: hides || heat || !isOn('show-region') ? null : this.seen?.mirrored,
            eye: hides ? null : this.eye,
            from: asks ? this.pair[0] : undefined,
            to: asks ? this.pair[1] : undefined,
            show: { cells: isOn('show-cells'), portals: isOn('show-portals'), grid: isOn('snap') ? roundStep(this.view.camera.scale, 40) : 0 },
        };
    }

    /** What the tool has of its own, which Delete removes: cameras, a line, a path. */
    get own() {
        return { cameras: this.cameras, line: this.line, path: this.path }[this.tool];
    }

    /** Marks over the plan: the explanation, what is chosen, what is being drawn, the cross. */
    over(surface, camera, tones) {
        this.overPicture(surface, camera, tones);
        const chosen = this.doc.items[this.doc.selected];
        if (chosen?.points.length) {
            strokeLines(surface, camera, [itemLine(chosen)], tones.start, 3);
            for (let i = 0; i + 1 < chosen.points.length; i += 2)
                drawDot(surface, camera, [chosen.points[i], chosen.points[i + 1]], 5, tones.start, tones.page);
        }
        const drawn = this.tools[this.tool].preview?.();
        if (drawn) {
            strokeLines(surface, camera, [drawn], tones.start, 2, [5, 3]);
            drawDot(surface, camera, drawn, 4, tones.start, tones.page);
        }
        if (!this.keys.cross) return;
        const [x, y] = this.keys.cross, r = 12 / camera.scale;
        for (const [colour, width] of [[tones.page, 5], [tones.ink, 2]])
            strokeLines(surface, camera, [[x - r, y, x + r, y], [x, y - r, x, y + r]], colour, width);
    }

    overPicture(surface, camera, tones) {
        if (this.tool === 'why' && this.why) drawWhy(surface, camera, this.why, tones);
        for (const each of [this.cameras, this.line, this.path]) each.draw(surface, camera, tones);
    }

    redraw() {
        for (const [name, able] of [['undo', this.doc.canUndo], ['redo', this.doc.canRedo], ['remove', this.own ? this.own.canRemove : this.doc.selected >= 0]])
            document.querySelector(`[data-do=${name}]`).disabled = !able;
        panel.showChosen(this.doc.items[this.doc.selected]);
        clearTimeout(this.drawing);
        const wait = this.drawAt - performance.now();
        if (wait > 0) this.drawing = setTimeout(() => this.view.draw(), wait);
        else this.view.draw();
    }

    // --- tools and commands

    press(place, event) {
        this.free = event?.altKey;
        const tool = this.tools[this.tool], drawn = tool.preview?.();
        tool.press(place);
        const begun = tool.preview?.();
        if (begun && !drawn) get('done').textContent = t`Begins at ${placeOf(begun)}`;
        this.redraw();
    }
    move(place, held, event) {
        this.free = event?.altKey;
        this.tools[this.tool].move?.(place, held);
        if (this.keys.cross || this.tool !== 'look') this.showAt(place);
        get('heat-value').textContent = this.heat.textAt(place);
        this.redraw();
    }
    release(place, cancelled = false) {
        const tool = this.tools[this.tool];
        if (cancelled) tool.cancel?.();
        else tool.release?.(place);
        this.redraw();
    }
    showAt(place) {
        const snapped = this.tool === 'look' || this.tool === 'why' ? place : this.snap(place);
        get('where').textContent = t`At ${snapped.map((v) => Math.round(v * 1000) / 1000).join(', ')}`;
    }
    showPlace([x, y]) {
        this.view.camera.show(x, y);
    }
    chooseTool(name) {
        this.tools[this.tool].cancel?.();
        this.tool = name;
        const radio = document.querySelector(`input[name=tool][value=${name}]`);
        radio.checked = true;
        get('done').textContent = t`Tool: ${radio.labels[0].textContent}`;
        for (const each of [this.cameras, this.line, this.path]) each.show();
        this.redraw();
    }
    cancelTool() {
        this.tools[this.tool].cancel?.();
        this.doc.select(-1);
    }
    selectNext(way) {
        const count = this.doc.items.length, able = (i) => this.doc.items[i].points.length;
        if (!this.doc.items.some((item) => item.points.length)) return;
        let i = this.doc.selected;
        do i = (i + way + count) % count; while (!able(i));
        this.doc.select(i);
        const item = this.doc.items[i];
        get('done').textContent = t`Chosen: ${tellItem(item)}`;
    }
    freeName(stem) {
        const used = new Set(this.doc.items.map((item) => item.name));
        for (let i = 1; ; i++) if (!used.has(`${stem}${i}`)) return `${stem}${i}`;
    }

    act(what) {
        const picture = () => [this.scene(), this.doc.bounds(), this.view.tones, (s, c) => this.overPicture(s, c, this.view.tones)];
        const acts = {
            undo: () => this.travel('undo'),
            redo: () => this.travel('redo'),
            remove: () => (this.own ? this.own.remove() : this.doc.selected >= 0 && this.doc.remove(this.doc.selected)),
            turn: () => this.changeChosen((item) => ({ ...item, points: [...item.points.slice(2), ...item.points.slice(0, 2)] })),
            zoomIn: () => this.view.zoom(1.4),
            zoomOut: () => this.view.zoom(1 / 1.4),
            fit: () => (this.view.fitTo(), this.redraw()),
            clear: () => this.load([], 'the empty map'),
            help: () => get('help').showModal(),
            open: () => get('file').click(),
            share: () => this.share(),
            saveMap: () => save(new Blob([this.doc.text()], { type: 'text/plain' }), 'plan.map'),
            saveCameras: () => this.cameras.saveTable(),
            saveSlv: () => this.saveSlv(),
            savePng: () => savePng(...picture()),
            saveSvg: () => saveSvg(...picture()),
            cancel: () => this.client.stop(new CoreError(t('The work was cancelled. The map is still here; the next change computes again.'))),
        };
        acts[what]();
    }

    async saveSlv() {
        if (!this.plan) return panel.showMessage(t('There is no baked map yet. Wait until it is computed, or mend the error.'), true);
        try {
            save(new Blob([await this.client.call('slv', {})], { type: 'application/octet-stream' }), 'plan.slv');
        } catch (error) {
            panel.showNote(t`The .slv file was not saved: ${error.message}`, true);
        }
    }

    async share() {
        this.shared = this.doc.text();
        const fragment = await packMap(this.shared);
        history.replaceState(null, '', `#${fragment}`);
        const long = fragment.length > LONG_ADDRESS ? t(' It is long: some programs may cut it off.') : '';
        try {
            await navigator.clipboard.writeText(location.href);
            panel.showNote(t`The address was copied. It holds the whole map.${long}`);
        } catch {
            panel.showNote(t`The address of this page now holds the whole map. Copy it from the address bar.${long}`);
        }
    }

    async begin() {
        this.loadGallery();
        const kept = loadWork();
        if (kept) {
            try {
                this.load(parseMap(kept), 'the map from before');
            } catch {
                panel.showMessage(t('The kept map could not be read.'), true);
            }
        }
        const shared = await this.openShared();
        if (!shared && !this.doc.items.length) await this.openGallery('office.map', true);
        this.act('fit');
    }

    /** The map from before a shared one was opened, in the list of maps. */
    offerOwn() {
        const list = get('gallery');
        if (loadWork('own') && !list.querySelector('[value=own]')) list.add(new Option(t('your own map from before'), 'own'), 1);
    }

    async loadGallery() {
        this.offerOwn();
        try {
            for (const { file, title } of await (await fetch(new URL('index.json', maps))).json())
                get('gallery').append(new Option(title, file));
            this.showOrigin();
        } catch {
            get('gallery').disabled = true;
        }
    }
}

const playground = new Playground();
// For tests and for the curious.
Object.assign(window, { playground });
playground.begin();
