/**
 * The map that is drawn, with undo and redo. Items are never changed in place, so a step of the
 * past is a list of the same items: it costs what the list costs.
 */
import { t } from '../language/language.js';
import { boundsOf, writeMap } from '../formats/map-text.js';

/** @typedef {import('../formats/map-text.js').Item} Item */

/** All steps together keep at most this many entries of lists. */
const KEPT_ENTRIES = 5e6;

export class MapDocument extends EventTarget {
    constructor() {
        super();
        /** @type {Item[]} */
        this.items = [];
        /** Where the map comes from: a name for messages, its place in the list of maps, its items as they were read. */
        this.origin = { name: t('the map from before'), file: '', items: this.items };
        /** Steps: {items, origin}. */
        this.past = [];
        this.future = [];
        /** The items before the last step. */
        this.before = this.items;
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
        if (!step || step !== this.step) this.keep();
        this.step = step;
        this.replace(items);
    }

    /** Takes another map. The first one is no step to undo. @param {Item[]} items */
    load(items, name, file = '') {
        if (this.canUndo || this.items.length) this.keep();
        this.step = null;
        this.origin = { name, file, items };
        this.replace(items);
    }

    keep() {
        this.past.push({ items: this.items, origin: this.origin });
        this.future = [];
        this.before = this.items;
        let kept = 0, from = this.past.length;
        while (from > 0 && (kept += this.past[from - 1].items.length + 1) < KEPT_ENTRIES) from--;
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
        to.push({ items: this.items, origin: this.origin });
        this.step = null;
        this.selected = -1;
        this.before = this.items;
        const { items, origin } = from.pop();
        this.origin = origin;
        this.replace(items);
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
