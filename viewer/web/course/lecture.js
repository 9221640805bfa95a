/**
 * Lecture mode: the whole screen, large type, one figure or exercise at a time with its heading.
 * Right, Page Down and Space go on; Left and Page Up go back; Escape leaves.
 */
import { element } from './figure.js';

/** @param {HTMLElement} main whose children are headings, text, figures and exercises */
export function lectureMode(main) {
    const slides = [...main.querySelectorAll(':scope > figure[data-figure], :scope > form')];
    if (!slides.length) return;
    let at = -1;
    const where = element('span', { role: 'status' });
    const button = (text, action) => {
        const node = element('button', { type: 'button' }, text);
        node.addEventListener('click', action);
        return node;
    };
    const bar = element('div', { className: 'lecture-bar', role: 'group', 'aria-label': 'Lecture', hidden: true },
        button('Back', () => show(at - 1)), button('Next', () => show(at + 1)), where, button('Leave', () => leave()));
    const begin = button('Lecture mode', () => {
        document.documentElement.requestFullscreen?.().catch(() => {});
        show(0);
    });
    begin.id = 'lecture';
    /** The picture of the slide for a screen of another size. */
    const fit = () => (slides[at].figure ?? slides[at].querySelector('figure')?.figure)?.resize();
    main.querySelector('h1').after(begin);
    main.append(bar);

    function show(wanted) {
        at = Math.min(slides.length - 1, Math.max(0, wanted));
        document.body.classList.add('lecture');
        bar.hidden = false;
        for (const node of main.querySelectorAll(':scope > .on')) node.classList.remove('on');
        slides[at].classList.add('on');
        let heading = slides[at].previousElementSibling;
        while (heading && heading.tagName !== 'H2') heading = heading.previousElementSibling;
        heading?.classList.add('on');
        fit();
        where.textContent = `${at + 1} of ${slides.length}`;
        window.scrollTo(0, 0);
    }
    function leave() {
        if (document.fullscreenElement) document.exitFullscreen();
        document.body.classList.remove('lecture');
        bar.hidden = true;
        fit();
        slides[at].scrollIntoView();
        at = -1;
        begin.focus({ preventScroll: true });
    }
    document.addEventListener('fullscreenchange', () => at >= 0 && !document.fullscreenElement && leave());
    document.addEventListener('keydown', (event) => {
        if (at < 0) return;
        const isField = /^(INPUT|SELECT|BUTTON|CANVAS)$/.test(document.activeElement?.tagName ?? '');
        const by = { PageDown: 1, PageUp: -1, ...(isField ? {} : { ArrowRight: 1, ArrowLeft: -1, ' ': 1 }) }[event.key];
        if (event.key === 'Escape') leave();
        else if (by) show(at + by);
        else return;
        event.preventDefault();
    });
}
