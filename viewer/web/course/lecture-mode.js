/**
 * Lecture mode: the whole screen, large type, one figure or exercise at a time with its heading.
 * Right, Page Down and Space go on; Left and Page Up go back; Escape leaves. The slides of all chapters are one row:
 * after the last slide of a chapter comes the first one of the next. The address names the slide, as in #slide-3, so
 * it can be kept, and the browser's own Back goes to the slide before.
 */
import { t } from '../language/language.js';
import { element } from './figure.js';

/** The slide that an address names, from 0 on; -1 for none. @param {number} count of slides */
function slideOf(hash, count) {
    const found = /^#slide-(\d+|last)$/.exec(hash);
    return !found ? -1 : found[1] === 'last' ? count - 1 : Math.min(count, Math.max(1, Number(found[1]))) - 1;
}

/** How far a key goes: 1, -1, or 0 for a key that something else uses. @param {KeyboardEvent} event */
export function stepOf({ key }) {
    const at = document.activeElement, isField = at?.matches('input, select, textarea, [tabindex="0"]'), arrows = isField ? {} : { ArrowRight: 1, ArrowLeft: -1 };
    return { PageDown: 1, PageUp: -1, ...arrows, ...(isField || at?.matches('button') ? {} : { ' ': 1 }) }[key] ?? 0;
}

export const button = (text, action) => element('button', { type: 'button', onclick: action }, text);

/** The bar of a lecture, with buttons that go a step. @param {(by: number) => void} go */
export function lectureBar(go) {
    const where = element('span', { role: 'status' }), back = button(t('Back'), () => go(-1)), next = button(t('Next'), () => go(1));
    return { where, back, next, bar: element('div', { className: 'lecture-bar', role: 'group', 'aria-label': t('Lecture') }, back, next, where) };
}

/** @param {HTMLElement} main whose children are headings, text, figures and exercises */
export function lectureMode(main) {
    const slides = [...main.querySelectorAll(':scope > figure[data-figure], :scope > form')];
    if (!slides.length) return;
    let at = -1, address = '';
    const chapter = (rel) => main.querySelector(`.chapters a[rel=${rel}]`)?.href;
    const { bar, back, next, where } = lectureBar(go);
    bar.append(button(t('Leave'), () => leave()));
    bar.hidden = true;
    const begin = button(t('Lecture mode'), () => {
        document.documentElement.requestFullscreen?.().catch(() => {});
        address = location.hash;
        show(0, true);
    });
    begin.id = 'lecture';
    /** The picture of the slide for a screen of another size. */
    const fit = () => (slides[at].figure ?? slides[at].querySelector('figure')?.figure)?.resize();
    main.querySelector('h1').after(begin);
    main.append(bar);

    /** A step; behind the last slide and before the first one into the next chapter. */
    function go(by) {
        const wanted = at + by, other = wanted < 0 ? chapter('prev') : wanted >= slides.length ? chapter('next') : null;
        if (other) location.href = `${other}#slide-${by > 0 ? '1' : 'last'}`;
        else if (slides[wanted]) show(wanted, true);
    }

    /** @param {boolean} [isNew] the address does not name the slide yet */
    function show(wanted, isNew = false) {
        at = wanted;
        if (isNew) history.pushState(null, '', `#slide-${at + 1}`);
        document.body.classList.add('lecture');
        bar.hidden = false;
        for (const node of main.querySelectorAll(':scope > .on')) node.classList.remove('on');
        slides[at].classList.add('on');
        let heading = slides[at].previousElementSibling;
        while (heading && heading.tagName !== 'H2') heading = heading.previousElementSibling;
        heading?.classList.add('on');
        back.disabled = at === 0 && !chapter('prev');
        next.disabled = at === slides.length - 1 && !chapter('next');
        fit();
        where.textContent = t`${at + 1} of ${slides.length}`;
        window.scrollTo(0, 0);
    }
    function leave() {
        if (document.fullscreenElement) document.exitFullscreen();
        document.body.classList.remove('lecture');
        bar.hidden = true;
        fit();
        slides[at].scrollIntoView();
        at = -1;
        history.replaceState(null, '', location.pathname + location.search + address);
        begin.focus({ preventScroll: true });
    }
    const follow = () => {
        const wanted = slideOf(location.hash, slides.length);
        if (wanted >= 0) show(wanted);
        else if (at >= 0) leave();
    };
    addEventListener('popstate', follow);
    follow();
    document.addEventListener('fullscreenchange', () => at >= 0 && !document.fullscreenElement && leave());
    document.addEventListener('keydown', (event) => {
        if (at < 0) return;
        const by = stepOf(event);
        if (event.key === 'Escape') leave();
        else if (by) go(by);
        else return;
        event.preventDefault();
    });
}
