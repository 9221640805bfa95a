/**
 * What figures and exercises ask the library: maps are baked once, and kept.
 */
import { load } from '../package/bake.js';

export class Lab {
    /** @param {import('../package/bake.js').Core} core */
    constructor(core) {
        this.core = core;
        this.scenes = new Map();
    }

    static async open() {
        return new Lab(await load({ memory: 2 ** 28 }));
    }

    /** A baked map. The last 40 are kept; an older one is closed, so ask again at each use. */
    scene(text, options = {}) {
        const key = JSON.stringify([text, options]);
        let scene = this.scenes.get(key);
        if (scene) this.scenes.delete(key);
        scene ??= this.core.open(text, options);
        this.scenes.set(key, scene);
        if (this.scenes.size > 40) {
            const [oldest, old] = this.scenes.entries().next().value;
            this.scenes.delete(oldest);
            old.close();
        }
        return scene;
    }
}

/** The area of the cells inside. */
export function floorArea(scene) {
    let sum = 0;
    for (let i = 0; i < scene.cellCount; i++) {
        const { corners: p, inside } = scene.cell(i), n = p.length;
        if (inside) for (let k = 0; k < n; k += 2) sum += (p[k] * p[(k + 3) % n] - p[(k + 2) % n] * p[k + 1]) / 2;
    }
    return sum;
}

/** The cell inside that holds a place; -1 for none. */
export function cellAt(scene, [x, y]) {
    const cell = scene.locate(x, y);
    return cell >= 0 && scene.cellTable[6 * cell + 4] ? cell : -1;
}

/** The cells inside. */
export const insideOf = (scene) => Array.from({ length: scene.cellCount }, (_, i) => i).filter((i) => scene.cellTable[6 * i + 4]);

/** Puts the baked map and the cell of a place into the state of a figure. @returns the map */
export function stand(state, lab, text, place) {
    state.scene = lab.scene(text);
    state.cell = cellAt(state.scene, place);
    return state.scene;
}

/** The middle of a cell. */
export function middleOf(scene, cell) {
    const p = scene.corners(cell);
    let x = 0, y = 0;
    for (let k = 0; k < p.length; k += 2) [x, y] = [x + p[k], y + p[k + 1]];
    return [(2 * x) / p.length, (2 * y) / p.length];
}

/** A line y' = slope x' + height of a dual, as a segment of the plan. */
export function planLine(dual, { slope, height }) {
    const place = (x) => {
        const y = slope * x + height, [ax, ay] = dual.along;
        return [dual.origin[0] + dual.scale * (x * ax - y * ay), dual.origin[1] + dual.scale * (x * ay + y * ax)];
    };
    return [...place(-4), ...place(4)];
}

/** The part of a line within some convex cells and between them. */
export function within(scene, [ax, ay, bx, by], cells) {
    let first = Infinity, last = -Infinity;
    for (const cell of cells) {
        const p = scene.corners(cell), n = p.length;
        let from = 0, to = 1;
        for (let k = 0; k < n; k += 2) {
            const ex = p[(k + 2) % n] - p[k], ey = p[(k + 3) % n] - p[k + 1];
            const at = ex * (ay - p[k + 1]) - ey * (ax - p[k]), change = ex * (by - ay) - ey * (bx - ax);
            if (change > 0) from = Math.max(from, -at / change);
            else if (change < 0) to = Math.min(to, -at / change);
        }
        [first, last] = [Math.min(first, from), Math.max(last, to)];
    }
    const at = (t) => [ax + t * (bx - ax), ay + t * (by - ay)];
    return [...at(first), ...at(last)];
}

export const round = (v, digits = 1) => Number(v.toFixed(digits));
