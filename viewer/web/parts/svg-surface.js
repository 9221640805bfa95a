/**
 * The part of a canvas context that the drawing components use, as an SVG file.
 * So a picture on the screen and a saved one come from the same code.
 */
const shorten = (v) => String(Math.round(v * 100) / 100);
const escapeText = (s) => s.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

export class SvgSurface {
    /** @param {number} width @param {number} height @param {string} title */
    constructor(width, height, title) {
        this.width = width;
        this.height = height;
        this.title = title;
        this.fillStyle = '#000';
        this.strokeStyle = '#000';
        this.lineWidth = 1;
        this.lineCap = 'butt';
        this.lineJoin = 'miter';
        this.globalAlpha = 1;
        this.font = '12px sans-serif';
        this.textAlign = 'left';
        this.textBaseline = 'alphabetic';
        this.parts = [];
        this.dash = [];
        this.path = '';
    }

    beginPath() {
        this.path = '';
    }
    moveTo(x, y) {
        this.path += `M${shorten(x)} ${shorten(y)}`;
    }
    lineTo(x, y) {
        this.path += `L${shorten(x)} ${shorten(y)}`;
    }
    closePath() {
        this.path += 'Z';
    }
    /** Full circles alone. */
    arc(x, y, r) {
        const a = shorten(r), d = shorten(2 * r);
        this.path += `M${shorten(x - r)} ${shorten(y)}a${a} ${a} 0 1 0 ${d} 0a${a} ${a} 0 1 0 -${d} 0Z`;
    }
    setLineDash(dash) {
        this.dash = dash;
    }
    fill() {
        this.put(`fill="${this.fillStyle}" fill-rule="evenodd"`);
    }
    stroke() {
        let text = `fill="none" stroke="${this.strokeStyle}" stroke-width="${shorten(this.lineWidth)}"`;
        if (this.lineCap !== 'butt') text += ` stroke-linecap="${this.lineCap}"`;
        if (this.lineJoin !== 'miter') text += ` stroke-linejoin="${this.lineJoin}"`;
        if (this.dash.length) text += ` stroke-dasharray="${this.dash.map(shorten).join(' ')}"`;
        this.put(text);
    }
    put(attributes) {
        if (!this.path) return;
        const alpha = this.globalAlpha < 1 ? ` opacity="${shorten(this.globalAlpha)}"` : '';
        this.parts.push(`<path d="${this.path}" ${attributes}${alpha}/>`);
    }
    fillRect(x, y, w, h) {
        this.parts.push(`<rect x="${shorten(x)}" y="${shorten(y)}" width="${shorten(w)}" ` +
            `height="${shorten(h)}" fill="${this.fillStyle}"/>`);
    }
    fillText(text, x, y) {
        const anchor = { center: 'middle', right: 'end' }[this.textAlign] ?? 'start';
        const base = this.textBaseline === 'middle' ? ' dominant-baseline="central"' : '';
        const [, size, family] = /([\d.]+)px (.*)/.exec(this.font) ?? [0, 12, 'sans-serif'];
        this.parts.push(`<text x="${shorten(x)}" y="${shorten(y)}" font-size="${size}" ` +
            `font-family="${escapeText(family)}" fill="${this.fillStyle}" text-anchor="${anchor}"${base}>` +
            `${escapeText(text)}</text>`);
    }

    /** @returns {string} the file */
    text() {
        return `<svg xmlns="http://www.w3.org/2000/svg" width="${this.width}" height="${this.height}" ` +
            `viewBox="0 0 ${this.width} ${this.height}"><title>${escapeText(this.title)}</title>\n` +
            `${this.parts.join('\n')}\n</svg>\n`;
    }
}
