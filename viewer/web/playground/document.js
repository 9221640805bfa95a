/**
 * The map that is drawn, with undo and redo. Items are never changed in place, so a step of the
 * past is a list of the same items: it costs what the list costs.
 */
import { boundsOf, writeMap } from '../formats/map-text.js';

/** @typedef {import('../formats/map-text.js').Item} Item */

/** All steps together keep at most this many entries of lists. */
const KEPT_ENTRIES = 5e6;

export class MapDocument extends EventTarget {
    constructor() {
        super();
        /** @type {Item[]} */
        this.items = [];
        this.past = [];
        this.future = [];
        this.step = null;
        this.selected = -1;
        this.revision = 0;
    }

    get canUndo() {
        return this.past.length > 0;
    }
    get canRedo() {
        return this.future.length > 0;
    }

    /**
     * Changes the map. Changes of one step (a drag) are undone together.
     * @param {Item[]} items @param {Object | null} step any value that stands for the step
     */
    change(items, step = null) {
        if (!step || step !== this.step) {
            this.past.push(this.items);
            this.future = [];
            this.forget();
        }
        this.step = step;
        this.replace(items);
    }

    forget() {
        let kept = 0, from = this.past.length;
        while (from > 0 && (kept += this.past[from - 1].length + 1) < KEPT_ENTRIES) from--;
        this.past.splice(0, Math.min(from, this.past.length - 1));
    }

    replace(items) {
        this.items = items;
        if (this.selected >= items.length) this.selected = -1;
        this.revision++;
        this.dispatchEvent(new Event('change'));
    }

    undo() {
        this.move(this.past, this.future);
    }
    redo() {
        this.move(this.future, this.past);
    }
    move(from, to) {
        if (!from.length) return;
        to.push(this.items);
        this.step = null;
        this.selected = -1;
        this.replace(from.pop());
    }

    /** @param {number} index -1 for none */
    select(index) {
        this.selected = index;
        this.dispatchEvent(new Event('select'));
    }

    /** @param {Item} item */
    add(item, step = null) {
        this.change([...this.items, item], step);
        this.select(this.items.length - 1);
    }

    remove(index) {
        this.change(this.items.filter((_, i) => i !== index));
        this.select(-1);
    }

    text() {
        return writeMap(this.items);
    }
    bounds() {
        return boundsOf(this.items);
    }
}
