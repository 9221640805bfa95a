/**
 * Words of a chapter that are wired to a figure. Words that name a part of its picture light it, while the pointer or the
 * keyboard is on them, and a press keeps it lit. "Try this" puts the figure into a state, and shows it.
 *
 * In the text: {show: FIGURE MARK | words} and {try: FIGURE name=value, name=value | words}. A value is a number, yes, no, two
 * numbers for a place, or a choice. The build checks the names.
 */

/** @param {string} text @returns {Record<string, any>} */
export const stateOf = (text) => Object.fromEntries(text.split(',').map((part) => {
    const [name, value] = part.trim().split('='), numbers = value.split(' ').map(Number);
    if (numbers.some(Number.isNaN)) return [name, { yes: true, no: false }[value] ?? value];
    return [name, numbers.length === 2 ? numbers : numbers[0]];
}));

/** @param {HTMLElement} main */
export function wireWords(main) {
    const figureOf = (node) => main.querySelector(`figure[data-figure=${node.dataset.of}]`).figure;
    for (const node of main.querySelectorAll('button.try')) node.addEventListener('click', () => {
        const figure = figureOf(node);
        figure.set(structuredClone(stateOf(node.dataset.state)));
        figure.canvas.scrollIntoView({ block: 'center', behavior: matchMedia('(prefers-reduced-motion: reduce)').matches ? 'auto' : 'smooth' });
    });
    for (const node of main.querySelectorAll('button.show')) {
        const figure = figureOf(node), isKept = () => node.getAttribute('aria-pressed') === 'true';
        const keep = (isOn) => node.setAttribute('aria-pressed', String(isOn));
        for (const type of ['pointerenter', 'focus']) node.addEventListener(type, () => figure.light(node.dataset.mark));
        for (const type of ['pointerleave', 'blur']) node.addEventListener(type, () => {
            if (!isKept()) figure.light(main.querySelector(`button.show[data-of=${node.dataset.of}][aria-pressed=true]`)?.dataset.mark);
        });
        node.addEventListener('click', () => {
            const isOn = !isKept();
            for (const other of main.querySelectorAll(`button.show[data-of=${node.dataset.of}]`)) other.setAttribute('aria-pressed', 'false');
            keep(isOn);
            figure.light(isOn ? node.dataset.mark : undefined);
        });
    }
}
