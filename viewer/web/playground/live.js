/**
 * A drag in a large map: what the eye sees follows each frame, in a world (world.h), and the map is
 * baked when the drag ends. In between there are no cells to show.
 */
import { CoreClient } from '../core/client.js';
import { Latest } from '../core/latest.js';
import { countWalls, writeMap } from '../formats/map-text.js';
import { itemLine } from '../parts/plan.js';

/** From so many walls on: a bake of fewer takes less than a frame or two. */
const LEAST_WALLS = 2000;

const WALLS = ['wall', 'walls', 'solid', 'open', 'door', 'mirror', 'oneway', 'seam'];

/** @typedef {import('../formats/map-text.js').Item} Item */

/** @param {Item} item @returns {number[][]} its walls */
function segmentsOf(item) {
    const line = itemLine(item), segments = [];
    for (let i = 0; i + 3 < line.length; i += 2) segments.push(Array.from(line.slice(i, i + 4)));
    return segments;
}

/** What moved from one list of items to another. @param {Item[]} from @param {Item[]} to */
export function movesOf(from, to) {
    const moves = [];
    if (from.length !== to.length) throw new Error('walls came or went');
    to.forEach((item, i) => {
        if (item === from[i] || !WALLS.includes(item.kind)) return;
        const before = segmentsOf(from[i]), after = segmentsOf(item);
        after.forEach((segment, k) => String(segment) !== String(before[k]) && moves.push([before[k], segment]));
    });
    return moves;
}

/** Bounds with as much room on each side as the map is large. @param {Item[]} items */
function roomOf(items) {
    let [minX, minY, maxX, maxY] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const { points } of items)
        for (let i = 0; i + 1 < points.length; i += 2) {
            minX = Math.min(minX, points[i]);
            maxX = Math.max(maxX, points[i]);
            minY = Math.min(minY, points[i + 1]);
            maxY = Math.max(maxY, points[i + 1]);
        }
    const size = Math.max(maxX - minX, maxY - minY);
    return { minX: minX - size, minY: minY - size, maxX: maxX + size, maxY: maxY + size };
}

export class Live {
    /**
     * @param {import('./sight.js').Sight} app @param {number} [memory]
     * @param {(seen: {region: Float64Array | null, mirrored: Float64Array[], time: number}) => void} show
     */
    constructor(app, memory, show) {
        this.app = app;
        this.show = show;
        this.client = new CoreClient(memory, './world-worker.js');
        this.steps = new Latest((wanted) => this.run(wanted));
        /** The items that the world has; null where there is none. @type {Item[] | null} */
        this.items = null;
        /** A drag goes on that the world follows; the number of the drag. */
        this.on = false;
        this.turn = 0;
        /** The drag cannot be followed: it is baked step by step. */
        this.failed = false;
    }

    /** Whether a drag of an item is followed. @param {Item} item */
    begin(item) {
        this.failed = !WALLS.includes(item.kind) || countWalls(this.app.doc.items) < LEAST_WALLS;
        this.items = null;
        this.turn++;
    }

    /** Follows a step of the drag. @param {Item[]} before the map when the drag began */
    follow(before) {
        if (this.failed) return false;
        this.on = true;
        this.steps.want({ turn: this.turn, before, items: this.app.doc.items, eye: this.app.eye });
        return true;
    }

    async run({ turn, before, items, eye }) {
        const goesOn = () => this.on && turn === this.turn;
        if (!goesOn()) return;
        try {
            if (!this.items) {
                await this.client.call('open', { text: writeMap(before), bounds: roomOf(before), doors: this.app.doors });
                if (!goesOn()) return;
                this.items = before;
            }
            const moves = movesOf(this.items, items);
            this.items = items;
            const seen = await this.client.call('drag', { moves, eye });
            if (goesOn()) this.show(seen);
        } catch {
            // A wall left the bounds, has no length for now, or the map has cells of its own.
            if (!goesOn()) return;
            this.failed = true;
            this.on = false;
            this.app.bake();
        }
    }

    /** Ends the drag. Whether it was followed, so that the map is to be baked. */
    end() {
        const was = this.on;
        this.on = false;
        this.turn++;
        this.steps.forget();
        if (was) this.client.call('close', {}).catch(() => {});
        this.items = null;
        return was;
    }
}
