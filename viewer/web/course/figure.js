/**
 * A figure that answers: a picture with handles and controls, and a sentence that says what it shows.
 *
 * A figure is data: `handles` are places to drag, `controls` are fields below the picture. Whenever one
 * changes, `update(state, lab)` computes, `draw(surface, camera, tones, state)` draws, and `tell(state)`
 * says it in words. `beside(state, tones)` may give a second picture. Mouse, touch and keys all move handles.
 * A control of kind 'map' chooses a plan or a map of the reader's own (own.js); `update` then puts `box` into the state.
 * `press(state, place, camera)` is called for a press of the mouse or a finger, before handles move; it may set controls.
 * `marks` name parts of the picture: words of the text light them (words.js).
 * `start(figure)` is called once: work beside the page calls `figure.change()` when it has something new.
 */
import { t } from '../language/language.js';
import { Camera } from '../parts/camera.js';
import { watchTones } from '../parts/tones.js';
import { mapField } from './own.js';
import { drawFigure, drawMark, firstState, paper, stillOf } from './still.js';

/**
 * @typedef {Object} Spec
 * @property {string} title @property {string} about what the reader can do
 * @property {number[]} box of the map: x0, y0, x1, y1
 * @property {{name: string, at: number[], tone?: string, letter?: string}[]} handles
 * @property {{name: string, label: string, kind: 'range' | 'check' | 'choice' | 'map', value: any,
 *   min?: number, max?: number, step?: number, most?: (state: any) => number, options?: string[][]}[]} [controls] `most` is
 *   the end of a slider that depends on the state
 * @property {(state: any, lab: import('./lab.js').Lab) => void} update
 * @property {(surface: any, camera: Camera, tones: any, state: any) => void} draw
 * @property {(state: any) => string} tell
 * @property {(state: any, tones: any) => Element} [beside]
 * @property {boolean} [wide] `beside` stands below the picture
 * @property {(state: any) => boolean} [isReady] false while work beside the page goes on; handouts wait for it
 * @property {(state: any) => any} [paper] the state to print, if it is not the one on the screen
 * @property {(figure: Figure) => void} [start]
 * @property {(state: any, place: number[], camera: Camera) => void} [press] `place` in pixels
 * @property {Record<string, (state: any) => {lines?: number[][], areas?: number[][], dots?: number[][]}>} [marks]
 */

/** @returns {any} an element with properties, attributes (data-, aria-, role) and children */
export function element(tag, properties = {}, ...children) {
    const node = document.createElement(tag);
    for (const [key, value] of Object.entries(properties))
        if (key in node && !key.includes('-')) node[key] = value;
        else node.setAttribute(key, value);
    node.append(...children);
    return node;
}

/** A table for the place beside a picture. @param {string[]} head @param {(string | number)[][]} rows */
export function table(head, rows) {
    const row = (cells, tag) => element('tr', {}, ...cells.map((cell) => element(tag, {}, String(cell))));
    return element('table', {}, element('thead', {}, row(head, 'th')), element('tbody', {}, ...rows.map((cells) => row(cells, 'td'))));
}

/** How near a pointer must be to a handle to take it, in pixels. */
const NEAR = 28;

/** A finger that moves farther than this, in pixels, does not tap. */
const TAP = 10;

/** The words below a picture: sentences that say what to do are left out of handouts. @param {string} about */
const captionOf = (about) => about.split(/(?<=[.!?]) (?=[A-Z])/).flatMap((sentence) => [' ',
    /\b(drag|sliders?|press|choose|zieh\w*|Regler|wähl\w*|drück\w*)\b/i.test(sentence) ? element('span', { className: 'keys' }, sentence) : sentence]);

/** In lecture mode lines and letters are up to LARGER times as large, as long as LEAST_WIDTH of their own pixels fit across. */
const [LARGER, LEAST_WIDTH] = [2, 360];

let count = 0;

export class Figure {
    /**
     * @param {HTMLElement} host @param {Spec} spec @param {import('./lab.js').Lab} lab
     * @param {Record<string, any>} [given] values of handles and controls to begin with, in place of the spec's
     */
    constructor(host, spec, lab, given = {}) {
        this.spec = spec;
        this.lab = lab;
        this.camera = new Camera();
        this.active = 0;
        this.zoom = 1;
        this.inputs = {};
        this.state = { ...firstState(spec), ...given };
        this.build(host);
        spec.start?.(this);
        watchTones((tones) => {
            this.tones = tones;
            this.change();
        });
        new ResizeObserver(() => this.resize()).observe(this.canvas);
        window.addEventListener('beforeprint', () => this.onPaper());
        window.addEventListener('afterprint', () => this.change());
    }

    /** The box of the map: that of the state, where `update` gives one. */
    get box() {
        return this.state.box ?? this.spec.box;
    }

    build(host) {
        const { spec } = this, id = `figure-${++count}`;
        const keys = spec.handles.length > 1 ? t(' Arrows move the chosen dot; N chooses the next one.')
            : spec.handles.length ? t(' Arrows move the dot.') : '';
        this.canvas = element('canvas', { tabIndex: 0, role: 'application', 'aria-label': t(spec.title), 'aria-describedby': `${id}-about ${id}-says` });
        this.still = element('div', { className: 'still' });
        this.beside = element('div', { className: spec.wide ? 'beside wide' : 'beside' });
        this.says = element('p', { className: 'says', id: `${id}-says`, role: 'status' });
        const caption = element('figcaption', { id: `${id}-about` }, element('strong', { id: `${id}-title` }, t(spec.title)), ...captionOf(t(spec.about)), element('span', { className: 'keys' }, keys));
        this.controls = element('div', { className: 'controls' });
        for (const control of spec.controls ?? []) this.controls.append(this.field(control, id));
        host.replaceChildren(element('div', { className: 'pictures' }, this.canvas, this.still, ...(spec.beside ? [this.beside] : [])),
            ...(spec.controls?.length ? [this.controls] : []), this.says, caption);
        host.setAttribute('aria-labelledby', `${id}-title`);
        host.figure = this;
        this.listen();
    }

    field(control, id) {
        const name = `${id}-${control.name}`, first = this.state[control.name];
        const set = (value) => {
            this.state[control.name] = value;
            this.change();
        };
        if (control.kind === 'map') return mapField(name, { ...control, value: first }, set, this.lab);
        if (control.kind === 'choice') {
            const list = element('select', { id: name }, ...control.options.map(([value, text]) =>
                element('option', { value, selected: value === first }, t(text))));
            this.inputs[control.name] = list;
            list.addEventListener('change', () => set(list.value));
            return element('span', {}, element('label', { htmlFor: name }, t(control.label), ' '), list);
        }
        const isCheck = control.kind === 'check';
        const input = element('input', isCheck ? { id: name, type: 'checkbox', checked: first }
            : { id: name, type: 'range', min: control.min, max: control.max, step: control.step ?? 1 });
        this.inputs[control.name] = input;
        if (!isCheck) input.value = first;
        input.addEventListener('input', () => set(isCheck ? input.checked : Number(input.value)));
        const label = element('label', { htmlFor: name }, t(control.label));
        return element('span', {}, ...(isCheck ? [input, ' ', label] : [label, ' ', input]));
    }

    listen() {
        const at = (event) => {
            const box = this.canvas.getBoundingClientRect();
            return [(event.clientX - box.left) / this.zoom, (event.clientY - box.top) / this.zoom];
        };
        this.canvas.addEventListener('pointerdown', (event) => {
            if (this.spec.press) this.press(at(event));
            const { handle, distance } = this.nearest(at(event)), isTouch = event.pointerType === 'touch';
            if (handle < 0) return;
            this.tap = isTouch && distance >= NEAR ? { handle, at: at(event) } : null;
            if (this.tap) return;
            this.active = handle;
            this.dragged = event.pointerId;
            this.canvas.setPointerCapture(event.pointerId);
            if (event.pointerType === 'mouse') this.moveTo(this.camera.toMap(...at(event)));
        });
        this.canvas.addEventListener('pointermove', (event) => {
            if (this.dragged === event.pointerId) this.moveTo(this.camera.toMap(...at(event)));
        });
        this.canvas.addEventListener('pointerup', (event) => {
            const [x, y] = at(event), { tap } = this, isTap = tap && Math.hypot(x - tap.at[0], y - tap.at[1]) < TAP;
            if (isTap) this.active = tap.handle;
            if (isTap || this.dragged === event.pointerId) this.moveTo(this.camera.toMap(x, y));
            this.dragged = this.tap = undefined;
        });
        this.canvas.addEventListener('pointercancel', () => (this.dragged = this.tap = undefined));
        // A finger on a handle drags it; elsewhere it scrolls the page, and a tap brings the nearest handle.
        this.canvas.addEventListener('touchstart', (event) => {
            if (this.nearest(at(event.touches[0])).distance < NEAR) event.preventDefault();
        }, { passive: false });
        this.canvas.addEventListener('keydown', (event) => this.key(event));
    }

    press(place) {
        this.spec.press(this.state, place, this.camera);
        this.set({});
    }

    /** Puts values into the state, and the state into the controls. @param {Record<string, any>} values */
    set(values) {
        Object.assign(this.state, values);
        for (const [name, input] of Object.entries(this.inputs))
            if (input.type === 'checkbox') input.checked = this.state[name];
            else input.value = this.state[name];
        this.change();
    }

    /** Lights a part of the picture, or none. @param {string} [mark] of the spec's marks */
    light(mark) {
        this.lit = mark;
        this.draw();
    }

    nearest([px, py]) {
        let best = { handle: -1, distance: Infinity };
        this.spec.handles.forEach(({ name }, handle) => {
            const [x, y] = this.camera.toScreen(...this.state[name]), distance = Math.hypot(x - px, y - py);
            if (distance < best.distance) best = { handle, distance };
        });
        return best;
    }

    /** Keys move the chosen dot, or choose the next one. Where nothing else is to be said, the sentence says where the dot is. */
    key(event) {
        const before = this.told, by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
        const handles = this.spec.handles;
        if (!handles.length || event.ctrlKey || event.metaKey || event.altKey) return;
        if (by) {
            const [x0, , x1] = this.box, step = ((x1 - x0) / 80) * (event.shiftKey ? 5 : 1);
            const [x, y] = this.state[handles[this.active].name];
            this.moveTo([x + by[0] * step, y + by[1] * step]);
        } else if (event.key.toLowerCase() === 'n' && handles.length > 1) {
            this.active = (this.active + 1) % handles.length;
            this.change();
        } else return;
        const { name, letter } = handles[this.active], place = this.state[name].map((v) => Number(v.toFixed(2))).join(', ');
        if (this.told === before) this.says.textContent = `${before} ${letter ? t`${letter} is at ${place}.` : t`The dot is at ${place}.`}`;
        event.preventDefault();
        event.stopPropagation();
    }

    moveTo([x, y]) {
        const [x0, y0, x1, y1] = this.box, name = this.spec.handles[this.active].name;
        this.state[name] = [Math.min(x1, Math.max(x0, x)), Math.min(y1, Math.max(y0, y))];
        this.change();
    }

    resize() {
        const width = this.canvas.clientWidth, height = this.canvas.clientHeight, ratio = window.devicePixelRatio || 1;
        if (!width || !height) return;
        this.zoom = document.body.classList.contains('lecture') ? Math.min(LARGER, Math.max(1, width / LEAST_WIDTH)) : 1;
        this.canvas.width = Math.round(width * ratio);
        this.canvas.height = Math.round(height * ratio);
        this.camera.resize(width / this.zoom, height / this.zoom);
        this.fit();
        this.draw();
    }

    fit() {
        const [x0, y0, x1, y1] = (this.shown = this.box);
        this.canvas.style.setProperty('--shape', `${x1 - x0} / ${y1 - y0}`);
        this.camera.fit(this.shown, 16);
    }

    /** Computes, says and draws. */
    change() {
        this.spec.update(this.state, this.lab);
        for (const { name, most } of this.spec.controls ?? []) if (most) this.inputs[name].max = most(this.state);
        if (this.box !== this.shown) this.fit();
        this.says.textContent = this.told = this.spec.tell(this.state);
        if (this.spec.beside) this.beside.replaceChildren(this.spec.beside(this.state, this.tones));
        this.draw();
    }

    draw() {
        const surface = this.canvas.getContext('2d'), ratio = (window.devicePixelRatio || 1) * this.zoom, { tones } = this;
        surface.setTransform(ratio, 0, 0, ratio, 0, 0);
        drawFigure(surface, this.camera, tones, this.spec, this.state, this.active);
        if (this.lit) drawMark(surface, this.camera, tones, this.spec.marks[this.lit](this.state));
    }

    /** For print: what is on the screen now, as vectors and in light colours. */
    onPaper() {
        const state = this.spec.paper?.(this.state) ?? this.state;
        this.still.replaceChildren(stillOf(this.spec, state));
        this.says.textContent = this.spec.tell(state);
        if (this.spec.beside) this.beside.replaceChildren(this.spec.beside(state, paper));
    }
}
