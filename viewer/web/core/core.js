/**
 * The one place that knows the package: which of its functions the site calls, and their options.
 */
import { load } from '../package/bake.js';

/** @typedef {{sight?: 'closed' | 'open'}} BakeOptions */

/** The core on this thread. */
export class Core {
    /** @param {any} module */
    constructor(module) {
        this.module = module;
    }

    static async load() {
        return new Core(await load());
    }

    /** @param {string | Uint8Array} map @param {BakeOptions} options @returns {Uint8Array} the .slv file */
    bake(map, options) {
        return this.module.bake(map, options);
    }

    /** @param {Uint8Array} slv @returns {any} the JSON export */
    describe(slv) {
        return this.module.describe(slv);
    }

    /** @param {Uint8Array} slv @param {number} a @param {number} b @returns {any} */
    explain(slv, a, b) {
        return this.module.explain(slv, a, b);
    }
}
