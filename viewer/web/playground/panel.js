/** The panel beside the plan: numbers, doors, colours. It is told what to show, and asks for nothing. */
import { t } from '../language/language.js';

const get = (id) => document.getElementById(id);

const numbers = new Intl.NumberFormat(document.documentElement.lang, { maximumFractionDigits: 2 });

/**
 * What has not changed stays as it is: this is called at each step of a drag.
 * @param {[string, string | number | null | undefined][]} rows those without a value are left out
 */
export function showFacts(rows) {
    const list = get('facts'), shown = rows.filter(([, value]) => value !== null && value !== undefined);
    const names = shown.map(([name]) => name).join('\n');
    if (list.dataset.names !== names) {
        list.dataset.names = names;
        list.replaceChildren(...shown.flatMap(([name]) => {
            const term = document.createElement('dt');
            term.textContent = name;
            return [term, document.createElement('dd')];
        }));
    }
    const places = list.querySelectorAll('dd');
    for (const [i, [, value]] of shown.entries()) {
        const text = typeof value === 'number' ? numbers.format(value) : value;
        if (places[i].textContent !== text) places[i].textContent = text;
    }
}

/** @param {string[]} names @param {Set<string>} shut @param {(name: string, open: boolean) => void} set */
export function showDoors(names, shut, set) {
    get('doors').hidden = !names.length;
    const list = get('door-list');
    if (list.dataset.names === names.join(' ')) {
        for (const box of list.querySelectorAll('input')) box.checked = !shut.has(box.value);
        return;
    }
    list.dataset.names = names.join(' ');
    list.replaceChildren(...names.map((name) => {
        const item = document.createElement('li'), label = document.createElement('label');
        const box = document.createElement('input');
        box.type = 'checkbox';
        box.value = name;
        box.checked = !shut.has(name);
        box.addEventListener('change', () => set(name, box.checked));
        label.append(box, ` ${name}`);
        item.append(label);
        return item;
    }));
}

/** The sides of a chosen mirror or glass. @param {any} item what is chosen, if anything is */
export function showChosen(item) {
    const isMirror = item?.kind === 'mirror', one = item?.state === 'one';
    get('chosen').hidden = !isMirror && item?.kind !== 'oneway';
    if (get('chosen').hidden) return;
    get('chosen-title').textContent = isMirror ? t('Chosen mirror') : t('Chosen glass');
    get('one-sided-label').hidden = !isMirror;
    get('one-sided').checked = one;
    document.querySelector('[data-do=turn]').disabled = isMirror && !one;
    get('chosen-text').textContent = !isMirror ? t('Ticks are on the dark side: who is there sees a wall.')
        : one ? t('Ticks are on the back, which is a wall.') : t('Both sides reflect.');
}

/** A small box of a colour. @param {string} colour */
function swatch(colour) {
    const ns = 'http://www.w3.org/2000/svg', picture = document.createElementNS(ns, 'svg'), box = document.createElementNS(ns, 'rect');
    for (const [k, v] of [['width', '100%'], ['height', '100%'], ['fill', colour]]) box.setAttribute(k, v);
    picture.setAttribute('aria-hidden', 'true');
    picture.append(box);
    return picture;
}

/** @param {[string, string][]} entries name and colour */
export function showKey(entries) {
    get('key').replaceChildren(...entries.map(([name, colour]) => {
        const item = document.createElement('li');
        item.append(swatch(colour), name);
        return item;
    }));
}

/**
 * A legend with values; without rows it is hidden.
 * @param {HTMLElement} table @param {{name: string, colour?: string, values: string[]}[]} rows
 */
export function showTable(table, rows) {
    table.hidden = !rows.length;
    table.replaceChildren(...rows.map(({ name, colour, values }) => {
        const row = document.createElement('tr'), head = document.createElement('th'), box = document.createElement('span');
        box.textContent = name;
        head.scope = 'row';
        head.append(...(colour ? [swatch(colour)] : []), box);
        row.append(head, ...values.map((text) => {
            const cell = document.createElement('td');
            cell.textContent = text;
            return cell;
        }));
        return row;
    }));
}

/** Says what is so of the map. @param {string} text @param {boolean} [isError] */
export function showMessage(text, isError = false) {
    const message = get('message');
    message.textContent = text;
    message.classList.toggle('error', isError);
    message.classList.remove('note', 'past');
}

/** Says what has happened, until the map changes. @param {string} text @param {boolean} [isError] */
export function showNote(text, isError = false) {
    showMessage(text, isError);
    get('message').classList.add('note');
    get('message').dataset.note = text;
}

/** Whether what has happened has its place, said or past. */
export const hasNote = () => get('message').classList.contains('note');

/** Says what is so of the map, below what has happened. @param {string} text */
export function showState(text) {
    if (!hasNote()) return showMessage(text);
    const state = document.createElement('span');
    state.className = 'state';
    state.textContent = text && `\n${text}`;
    get('message').replaceChildren(get('message').dataset.note, state);
}

/** The map has changed, so what has happened before is of no interest. The place stays, so that the plan does not move. */
export function dropNote() {
    get('message').classList.toggle('past', get('message').classList.contains('note'));
}

/** @param {string} text '' to hide */
export function showWhy(text) {
    get('why').hidden = !text;
    if (get('why-text').textContent !== text) get('why-text').textContent = text;
}

/** @param {SVGElement | null} figure */
export function showDual(figure) {
    get('why-dual').replaceChildren(...(figure ? [figure] : []));
}

let asked = 0;

/** Shows that work goes on, if it takes longer than a moment. @param {string} text '' when it is over */
export function showBusy(text) {
    clearTimeout(asked);
    if (!text) get('busy').hidden = true;
    else
        asked = setTimeout(() => {
            get('busy-text').textContent = text;
            get('progress').removeAttribute('value');
            get('busy').hidden = false;
        }, 400);
}

/** @param {number} share from 0 to 1 */
export function showProgress(share, text) {
    if (share >= 0) get('progress').value = share;
    get('busy-text').textContent = text;
}
