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
        portalCells: scene.portalCells.slice(),
        doors: scene.doors,
        pairs: scene.account.pairs,
        guarantee: scene.guarantee,
        method: scene.method,
    };
}

/**
 * What an eye sees.
 * @typedef {Object} Seen
 * @property {number} cell of the eye
 * @property {Uint32Array} row the cells that this cell sees
 * @property {number} kept how many of them the eye sees
 * @property {Float64Array} region x, y ... of what it sees
 * @property {Float64Array[]} mirrored the same of what it sees in mirrors, where it lies
 */

/** Bakes maps, and keeps the last one for questions. */
export class Core {
    /** @param {any} module */
    constructor(module) {
        this.module = module;
        this.scene = null;
    }

    /** @param {number} [memory] the most bytes that it may take */
    static async load(memory = 2 ** 31) {
        return new Core(await load({ memory }));
    }

    get open() {
        if (!this.scene) throw new Error('The map is not computed yet.');
        return this.scene;
    }

    /** @param {string} text @param {BakeOptions} options @returns {Plan} */
    bake(text, options) {
        this.scene?.close();
        this.scene = null;
        this.scene = this.module.open(text, options);
        return { ...planOf(this.scene), inside: this.scene.insideText() };
    }

    /** The .slv file of the last map. @returns {Uint8Array} */
    slv() {
        return this.open.slv();
    }

    /** @param {Uint8Array} slv @returns {any} the JSON export */
    describe(slv) {
        return this.module.describe(slv);
    }

    /** Opens and shuts doors. @param {Record<string, boolean>} doors names that are not there do nothing */
    setDoors(doors) {
        for (const { name, open } of this.open.doors)
            if (Object.hasOwn(doors, name) && doors[name] !== open) this.scene.setDoor(name, doors[name]);
    }

    /** @param {number[]} eye @returns {Seen | null} null where nobody stands */
    look([x, y]) {
        const scene = this.open, cell = this.locate([x, y]);
        if (cell < 0) return null;
        const mirrored = scene.mirrors.length ? scene.mirroredParts(x, y).map((part) => part.polygon) : [];
        return { cell, row: scene.row(cell), kept: scene.look(x, y).length, region: scene.visiblePolygon(x, y), mirrored };
    }

    /** @param {number[]} place @returns {number} its cell, -1 where nobody stands */
    locate([x, y]) {
        const cell = this.open.locate(x, y);
        return cell >= 0 && this.scene.cellTable[6 * cell + 4] ? cell : -1;
    }

    /** Why one cell sees another or not, with the lines through the portals in the dual plane. */
    explain(a, b) {
        const why = this.open.explain(a, b), miss = why.misses?.[0];
        const passed = why.sequence ?? (miss && [...miss.sequence, miss.stopped_by]);
        const portals = passed?.map((p) => [...p.left, ...p.right]);
        return { ...why, dual: portals?.length ? this.module.dual(portals) : null };
    }
}
