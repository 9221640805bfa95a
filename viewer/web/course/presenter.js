/** The lecturer's window beside a lecture: notes of the slide, the next one, and a clock that says if time runs out. */
import { element } from './figure.js';

const clockText = (seconds) => `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, '0')}`;

/** How far a lecture is from its plan, in words. @param {number} seconds since it began @param {{begin: number, end: number}} slide in minutes */
export function paceOf(seconds, { begin, end }) {
    const minutes = seconds / 60, behind = Math.floor(minutes - end), ahead = Math.floor(begin - minutes);
    return behind > 0 ? `${behind} min behind` : ahead > 0 ? `${ahead} min ahead` : 'on time';
}

/** @returns {{node: HTMLElement, show: (slide: any, after: any, began: number) => void}} */
export function presenterPanel() {
    const notes = element('div', { className: 'notes-now' }), clock = element('p', { className: 'clock', role: 'timer' }), coming = element('p', { className: 'coming' });
    let now = null, start = 0;
    const tick = () => {
        const seconds = start ? (Date.now() - start) / 1000 : 0;
        clock.textContent = !now ? '' : `${clockText(seconds)} · this slide ends at ${clockText(60 * now.end)}` + (start ? ` · ${paceOf(seconds, now)}` : '');
    };
    setInterval(tick, 500);
    return {
        node: element('aside', { className: 'presenter-panel', 'aria-label': 'For the lecturer' }, clock, notes, coming),
        show(slide, after, began) {
            [now, start] = [slide, began];
            notes.replaceChildren(...[...slide.node.querySelector('.notes').childNodes].map((node) => node.cloneNode(true)));
            coming.textContent = after ? `Next: ${after.node.querySelector('h2').textContent}` : 'This is the last slide.';
            tick();
        },
    };
}
