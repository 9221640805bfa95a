/**
 * The canvas: it draws the scene once a frame where something changed, and turns pointers, fingers
 * and the wheel into presses and moves at places of the map.
 */
import { Camera } from '../parts/camera.js';
import { drawPlan } from '../parts/plan.js';

/** How far a pointer may move between press and release of a click, in pixels. */
const CLICK = 4;

export class View {
    /**
     * @param {HTMLCanvasElement} canvas
     * @param {{scene: () => import('../parts/plan.js').Scene, over: (surface: any, camera: Camera, tones: any) => void,
     *   press: Function, move: Function, release: Function}} app
     */
    constructor(canvas, app) {
        this.canvas = canvas;
        this.app = app;
        this.camera = new Camera();
        this.pointers = new Map();
        this.asked = false;
        /** @type {import('../parts/tones.js').Tones | null} */
        this.tones = null;
        /** Makes the camera show all. @type {(() => void) | null} */
        this.fitTo = null;
        new ResizeObserver(() => this.resize()).observe(canvas);
        canvas.addEventListener('pointerdown', (e) => this.down(e));
        canvas.addEventListener('pointermove', (e) => this.moved(e));
        canvas.addEventListener('pointerup', (e) => this.up(e));
        canvas.addEventListener('pointercancel', (e) => this.pointers.delete(e.pointerId));
        canvas.addEventListener('wheel', (e) => this.wheel(e), { passive: false });
        canvas.addEventListener('contextmenu', (e) => e.preventDefault());
    }

    resize() {
        const { clientWidth: w, clientHeight: h } = this.canvas, ratio = window.devicePixelRatio || 1;
        if (!w || !h) return;
        const first = !this.sized, old = this.camera.width;
        this.canvas.width = Math.round(w * ratio);
        this.canvas.height = Math.round(h * ratio);
        this.camera.resize(w, h);
        this.sized = true;
        if (first || Math.abs(old - w) > 80) this.fitTo?.();
        this.draw(true);
    }

    /** Draws at the next frame, or at once. */
    draw(now = false) {
        if (now) return this.paint();
        if (this.asked) return;
        this.asked = true;
        requestAnimationFrame(() => {
            this.asked = false;
            this.paint();
        });
    }

    paint() {
        if (!this.tones || !this.sized) return;
        const surface = this.canvas.getContext('2d'), ratio = window.devicePixelRatio || 1;
        surface.setTransform(ratio, 0, 0, ratio, 0, 0);
        drawPlan(surface, this.camera, this.app.scene(), this.tones);
        this.app.over(surface, this.camera, this.tones);
    }

    place(event) {
        const box = this.canvas.getBoundingClientRect();
        return [event.clientX - box.left, event.clientY - box.top];
    }

    down(event) {
        this.canvas.focus({ preventScroll: true });
        const at = this.place(event);
        this.pointers.set(event.pointerId, at);
        this.canvas.setPointerCapture(event.pointerId);
        if (this.pointers.size === 2) {
            this.pinching = true;
            this.app.release(this.camera.toMap(...this.first), true);
            return;
        }
        this.panning = event.button === 1 || event.button === 2 || event.ctrlKey;
        this.first = at;
        if (!this.panning && !this.pinching) this.app.press(this.camera.toMap(...at), event);
    }

    moved(event) {
        const at = this.place(event), old = this.pointers.get(event.pointerId);
        if (old) {
            this.pointers.set(event.pointerId, at);
            if (this.pinching) return this.pinch(event.pointerId, old, at);
            if (this.panning) {
                this.camera.pan(at[0] - old[0], at[1] - old[1]);
                return this.draw();
            }
            if (Math.hypot(at[0] - this.first[0], at[1] - this.first[1]) < CLICK && !this.dragging) return;
            this.dragging = true;
        }
        this.app.move(this.camera.toMap(...at), Boolean(old), event);
    }

    up(event) {
        const at = this.place(event), known = this.pointers.delete(event.pointerId);
        this.dragging = false;
        if (this.pinching) {
            if (!this.pointers.size) this.pinching = false;
            return;
        }
        if (known && !this.panning) this.app.release(this.camera.toMap(...at), false);
        this.panning = false;
    }

    /** Two fingers move and zoom. */
    pinch(id, old, at) {
        const other = [...this.pointers].find(([key]) => key !== id)?.[1];
        if (!other) return;
        const before = Math.hypot(old[0] - other[0], old[1] - other[1]) || 1;
        const after = Math.hypot(at[0] - other[0], at[1] - other[1]) || 1;
        this.camera.pan((at[0] - old[0]) / 2, (at[1] - old[1]) / 2);
        this.camera.zoomAt((at[0] + other[0]) / 2, (at[1] + other[1]) / 2, after / before);
        this.draw();
    }

    wheel(event) {
        event.preventDefault();
        const unit = event.deltaMode === 1 ? 30 : 1;
        this.camera.zoomAt(...this.place(event), Math.exp((-event.deltaY * unit) / 500));
        this.draw();
    }

    zoom(factor) {
        this.camera.zoomAt(this.camera.width / 2, this.camera.height / 2, factor);
        this.draw();
    }
}
