/**
 * Maps of the reader: a file that is chosen or dropped on the page, a map in the page's address, and the last
 * one of the playground. One map at a time; all figures of a page with a field for maps get it.
 */
import { t } from '../language/language.js';
import { boundsOf, countWalls, parseMap, writeMap } from '../formats/map-text.js';
import { acceptDrops, readFile } from '../playground/files.js';
import { loadWork, unpackMap } from '../playground/share.js';
import { element } from './figure.js';
import { plans } from './maps.js';

/** Figures compute while a dot is dragged, so larger maps would stop the page. */
const MOST_WALLS = 1500;

/** Maps of the reader, by the values of their options. */
const own = {};

/** @param {string} value of a field for maps @returns {{text: string, box: number[]}} */
export const mapNamed = (value) => own[value] ?? plans[value] ?? plans.flat;

/** Keeps a map of the reader, or says why it cannot. @param {import('../formats/map-text.js').Item[]} items */
function keep(value, items, lab) {
    const walls = countWalls(items), text = writeMap(items);
    if (!walls) throw new Error('There are no walls in it.');
    if (walls > MOST_WALLS) throw new Error(`It has ${walls} walls. Figures take up to ${MOST_WALLS}; the playground takes more.`);
    lab.scene(text);
    own[value] = { text, box: boundsOf(items) };
}

/** Fields of this page; a map that comes is for all of them. */
const fields = [];
let isListening = false;

async function takeFile(file, lab) {
    try {
        keep('own', (await readFile(file, async (bytes) => lab.core.describe(bytes))).items, lab);
        for (const field of fields) field.offer('own', 'your map', true);
    } catch (error) {
        for (const field of fields) field.say(error.message);
    }
}

async function takeAddress(lab) {
    try {
        const text = await unpackMap(location.hash);
        if (text === null) return;
        keep('own', parseMap(text), lab);
        for (const field of fields) field.offer('own', 'your map', true);
    } catch (error) {
        for (const field of fields) field.say(`The map of the address was not opened: ${error.message}`);
    }
}

/** The map that the playground kept; nothing is said where there is none that can be read. */
function takeWork(lab) {
    const text = loadWork();
    if (!text) return;
    try {
        keep('playground', parseMap(text), lab);
    } catch {
        return;
    }
    for (const field of fields) field.offer('playground', 'your map of the playground', false);
}

/** Starts once, when all figures of the page are there. */
function listen(lab) {
    if (isListening) return;
    isListening = true;
    acceptDrops((file) => takeFile(file, lab));
    addEventListener('hashchange', () => takeAddress(lab));
    queueMicrotask(() => {
        takeWork(lab);
        takeAddress(lab);
    });
}

/**
 * A field that chooses a plan of the course or a map of the reader.
 * @param {string} id @param {{label: string, value: string}} control @param {(value: string) => void} set
 */
export function mapField(id, control, set, lab) {
    const list = element('select', { id }, ...Object.keys(plans).map((value) => element('option', { value, selected: value === control.value }, value)));
    const file = element('input', { type: 'file', id: `${id}-file` }), said = element('span', { role: 'status', className: 'map-said' });
    const choose = () => {
        said.textContent = '';
        set(list.value);
    };
    list.addEventListener('change', choose);
    file.addEventListener('change', () => file.files[0] && takeFile(file.files[0], lab));
    fields.push({
        say: (text) => (said.textContent = text),
        offer(value, text, isChosen) {
            if (![...list.options].some((option) => option.value === value)) list.append(element('option', { value }, text));
            if (!isChosen) return;
            list.value = value;
            choose();
        },
    });
    listen(lab);
    return element('span', { className: 'map-field' }, element('label', { htmlFor: id }, t(control.label)), list,
        element('label', { htmlFor: file.id }, t('or a file')), file, said);
}
