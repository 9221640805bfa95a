/**
 * A figure as a still picture: an SVG with the drawing code of the screen. Print, solutions and the
 * glossary use it. Stills for paper have light colours, whatever the screen has.
 */
import { t } from '../language/language.js';
import { Camera } from '../parts/camera.js';
import { drawDot, fillPolygons, strokeLines } from '../parts/plan.js';
import { SvgSurface } from '../parts/svg-surface.js';
import { makeTones, watchTones } from '../parts/tones.js';
import { drawText } from './maps.js';

export const paper = makeTones(false);

/** Handles and controls as a figure has them at first. @param {import('./figure.js').Spec} spec */
export function firstState(spec) {
    const state = {};
    for (const handle of spec.handles) state[handle.name] = [...handle.at];
    for (const control of spec.controls ?? []) state[control.name] = control.value;
    return state;
}

/** The picture with its handles. `active` is the number of the one that keys move; -1 for none. */
export function drawFigure(surface, camera, tones, spec, state, active = -1) {
    spec.draw(surface, camera, tones, state);
    spec.handles.forEach(({ name, tone, letter }, i) => {
        const isActive = spec.handles.length > 1 && i === active;
        drawDot(surface, camera, state[name], isActive ? 9 : 7, tones[tone ?? 'sourceEdge'], isActive ? tones.ink : tones.page);
        if (letter) drawText(surface, camera, state[name], letter, tones, 16, -10);
    });
}

/** A part of a picture that words name, over all else. */
export function drawMark(surface, camera, tones, { lines = [], areas = [], dots = [] }) {
    fillPolygons(surface, camera, areas, tones.start, 0.4);
    strokeLines(surface, camera, areas, tones.start, 3, [], true);
    strokeLines(surface, camera, lines, tones.start, 7);
    for (const place of dots) drawDot(surface, camera, place, 10, tones.start, tones.page);
}

/**
 * An SVG of what `draw(surface, camera)` draws.
 * @param {string} title @param {number[]} box of the map @param {(surface: SvgSurface, camera: Camera) => void} draw
 * @returns {Element}
 */
export function picture(title, box, draw, { width = 640, most = 400, margin = 16 } = {}) {
    const [x0, y0, x1, y1] = box, inner = width - 2 * margin;
    const height = Math.round(Math.min(most, (inner * (y1 - y0)) / (x1 - x0) + 2 * margin));
    const surface = new SvgSurface(width, height, title), camera = new Camera(width, height);
    camera.fit(box, margin);
    draw(surface, camera);
    const node = document.importNode(new DOMParser().parseFromString(surface.text(), 'image/svg+xml').documentElement, true);
    node.setAttribute('role', 'img');
    node.setAttribute('aria-label', title);
    return node;
}

/** A figure in some state; for paper, if nothing else is said. */
export const stillOf = (spec, state, tones = paper) =>
    picture(t(spec.title), state.box ?? spec.box, (surface, camera) => drawFigure(surface, camera, tones, spec, state));

/** Keeps a picture in a place, in the colours of the page, and of paper for print. @param {(tones: any) => Element} draw */
export function keepPicture(host, draw) {
    let last = paper;
    watchTones((tones) => host.replaceChildren(draw((last = tones))));
    window.addEventListener('beforeprint', () => host.replaceChildren(draw(paper)));
    window.addEventListener('afterprint', () => host.replaceChildren(draw(last)));
}
