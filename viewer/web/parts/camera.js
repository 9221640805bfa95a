/**
 * Where a plan lies on the screen: the map's y goes up, the screen's goes down.
 * It knows pixels and map units alone, so figures of any kind can use it.
 */
export class Camera {
    /** @param {number} width @param {number} height of the view in pixels */
    constructor(width = 300, height = 150) {
        this.width = width;
        this.height = height;
        this.x = 0;
        this.y = 0;
        this.scale = 1;
    }

    /** @param {number} x @param {number} y @returns {[number, number]} */
    toScreen(x, y) {
        return [
            this.width / 2 + (x - this.x) * this.scale,
            this.height / 2 - (y - this.y) * this.scale,
        ];
    }

    /** @param {number} px @param {number} py @returns {[number, number]} */
    toMap(px, py) {
        return [
            this.x + (px - this.width / 2) / this.scale,
            this.y - (py - this.height / 2) / this.scale,
        ];
    }

    /** @param {number} width @param {number} height */
    resize(width, height) {
        this.width = Math.max(1, width);
        this.height = Math.max(1, height);
    }

    /** Shows a box [x0, y0, x1, y1] as large as it fits. @param {number[]} box */
    fit(box, margin = 24) {
        const [x0, y0, x1, y1] = box, w = x1 - x0 || 1, h = y1 - y0 || 1;
        const room = (size) => Math.max(size - 2 * margin, size / 3);
        this.scale = Math.min(room(this.width) / w, room(this.height) / h);
        this.x = (x0 + x1) / 2;
        this.y = (y0 + y1) / 2;
    }

    /** Zooms; the place under the pixel stays there. */
    zoomAt(px, py, factor) {
        const [x, y] = this.toMap(px, py);
        const scale = this.scale * factor;
        if (!(scale > 1e-12 && scale < 1e12)) return;
        this.scale = scale;
        const [nx, ny] = this.toMap(px, py);
        this.x += x - nx;
        this.y += y - ny;
    }

    pan(dx, dy) {
        this.x -= dx / this.scale;
        this.y += dy / this.scale;
    }

    /** Moves as little as shows the place, with a margin in pixels. */
    show(x, y, margin = 30) {
        const [px, py] = this.toScreen(x, y);
        const over = (at, size) => (at < margin ? margin - at : at > size - margin ? size - margin - at : 0);
        this.pan(over(px, this.width), over(py, this.height));
    }

    /** The part of the map on the screen. @returns {[number, number, number, number]} */
    box() {
        const [x0, y1] = this.toMap(0, 0), [x1, y0] = this.toMap(this.width, this.height);
        return [x0, y0, x1, y1];
    }
}

/** A step of 1, 2 or 5 times a power of ten, at least `pixels` wide on the screen. */
export function roundStep(scale, pixels) {
    const least = pixels / scale, power = 10 ** Math.floor(Math.log10(least));
    const factor = [1, 2, 5, 10].find((f) => f * power >= least * (1 - 1e-9)) ?? 10;
    return factor >= 1 && power < 1 ? factor / Math.round(1 / power) : factor * power;
}
