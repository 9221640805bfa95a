/**
 * The one place that knows the package: which of its functions the site calls, and their options.
 */
import { load } from '../package/bake.js';

/** @typedef {{sight?: 'closed' | 'open', progress?: (stage: string, done: number, total: number) => void}} BakeOptions */

/**
 * A baked map as the page draws it: copies, which can go from thread to thread.
 * @typedef {import('../parts/plan.js').Space & {doors: {name: string, open: boolean, segments: number[][]}[],
 *   pairs: number, guarantee: string, method: string}} Plan
 */

/** @param {any} scene of the package @returns {Plan} */
export function planOf(scene) {
    return {
        cellCount: scene.cellCount,
        vertices: scene.vertices.slice(),
        cellTable: scene.cellTable.slice(),
        portalCount: scene.portalCount,
        portalEnds: scene.portalEnds.slice(),
        doors: scene.doors,
        pairs: scene.account.pairs,
        guarantee: scene.guarantee,
        method: scene.method,
    };
}

/** Bakes maps, and keeps the last one for questions. */
export class Core {
    /** @param {any} module */
    constructor(module) {
        this.module = module;
        this.scene = null;
    }

    static async load() {
        return new Core(await load());
    }

    /** @param {string} text @param {BakeOptions} options @returns {{slv: Uint8Array, plan: Plan}} */
    bake(text, options) {
        this.scene?.close();
        this.scene = null;
        this.scene = this.module.open(text, options);
        return { slv: this.scene.slv(), plan: planOf(this.scene) };
    }

    /** @param {Uint8Array} slv @returns {any} the JSON export */
    describe(slv) {
        return this.module.describe(slv);
    }

    /** Why cell a of the last map sees cell b or not. @param {number} a @param {number} b */
    explain(a, b) {
        if (!this.scene) throw new Error('The map is not computed yet.');
        return this.scene.explain(a, b);
    }

    /** The lines through portals in the dual plane. @param {number[][]} portals left and right ends */
    dual(portals) {
        return this.module.dual(portals);
    }
}
