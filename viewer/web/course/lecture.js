/**
 * A lecture as slides: lecture.html?plan=90; plans.js has the plans. The address names the slide, as in #lines-puzzle, so it can be
 * kept. Right, Page Down and Space go on, also into the next chapter; Left and Page Up go back. A prediction goes on in two steps:
 * first the question, then what happens. `&view=presenter` is the lecturer's window, with notes and a clock. Windows of one plan show
 * the same slide, and what is moved in a figure moves in all of them. `&print=all` makes all figures, as they are
 * printed, and `&print=now` prints them as well.
 */
import { Figure, element } from './figure.js';
import { button, lectureBar, stepOf } from './lecture-mode.js';
import { plans, slidesOf } from './plans.js';
import { presenterPanel } from './presenter.js';

export const figures = {}, exercises = {};

/** The values of handles and controls. @param {Figure} figure */
const stateOf = ({ spec, state }) => structuredClone(Object.fromEntries([...spec.handles, ...(spec.controls ?? [])].map(({ name }) => [name, state[name]])));

const hostOf = ({ node }) => node.querySelector('figure[data-show]');

/** Makes the figure of a slide, in the state of the slide; `first` keeps it for the way back. */
async function build(slide, lab) {
    const host = hostOf(slide);
    if (!host || host.figure) return;
    const [chapter, name] = host.dataset.show.split('/'), { figures: own } = await import(`./${chapter}.js`);
    if (host.figure) return;
    new Figure(host, own[name], lab, JSON.parse(host.dataset.state));
    slide.first = stateOf(host.figure);
    slide.then = { ...slide.first, ...JSON.parse(host.dataset.then) };
}

const pause = () => new Promise((resolve) => setTimeout(resolve, 50));

/** All figures of all slides, as they are printed: predictions with their answer. */
async function prepareAll(slides, lab) {
    for (const slide of slides) {
        await build(slide, lab);
        const figure = hostOf(slide)?.figure;
        if (figure) figure.set(structuredClone(slide.then));
        slide.node.classList.add('answered');
    }
    const isReady = ({ figure }) => figure.spec.isReady?.(figure.state) ?? true;
    while (!slides.map(hostOf).filter(Boolean).every(isReady)) await pause();
}

/** In place of slides: which plans there are. */
function offerPlans(main, plan) {
    const links = Object.entries(plans).map(([name, { length }]) => element('li', {}, element('a', { href: `?plan=${name}` }, length > 1 ? `${length} lectures of 90 minutes` : `${name} minutes`)));
    main.replaceChildren(element('h1', {}, 'Lecture'), element('p', { role: 'alert' }, `There is no plan ${plan}. Choose one of these:`), element('ul', {}, ...links));
}

/** @param {HTMLElement} main with a section for each slide @param {import('./lab.js').Lab} lab */
export async function fill(main, lab) {
    const asked = new URL(location.href).searchParams, plan = asked.get('plan') ?? '90', isPresenter = asked.get('view') === 'presenter';
    if (!Object.hasOwn(plans, plan)) return offerPlans(main, plan);
    const slides = slidesOf(plan, [...main.querySelectorAll('section.slide')].map((node) => ({ node, chapter: node.dataset.chapter, kind: node.dataset.kind })));
    const lectures = plans[plan].length, talk = new BroadcastChannel(`sightline lecture ${plan}`), panel = isPresenter ? presenterPanel() : null;
    const { bar, back, next, where } = lectureBar(go);
    if (!isPresenter) bar.append(button('Presenter view', () => open(`?plan=${plan}&view=presenter${location.hash}`, '_blank', 'popup,width=1100,height=720')),
        button('Print, or save as PDF', () => (location.href = `?plan=${plan}&print=now`)));
    document.body.classList.add('lecture', 'deck', ...(isPresenter ? ['presenter'] : []));
    main.replaceChildren(...slides.map(({ node }) => node), ...(panel ? [panel.node] : []), bar);
    let at = 0, isAnswered = false, began = 0, isTold = false;

    const slideOf = (hash) => Math.max(0, slides.findIndex(({ node }) => `#${node.id}` === hash));
    const tell = (more = {}) => talk.postMessage({ slide: slides[at].node.id, isAnswered, began, ...more });

    async function show(wanted, answered) {
        const slide = slides[wanted], { node } = slide;
        [at, isAnswered] = [wanted, answered];
        for (const other of slides) other.node.classList.toggle('on', other === slide);
        node.classList.toggle('answered', answered);
        where.textContent = `${lectures > 1 ? `Lecture ${slide.lecture} of ${lectures}, ` : ''}${at + 1} of ${slides.length}`;
        back.disabled = at === 0 && !answered;
        next.disabled = at === slides.length - 1 && (answered || slide.kind !== 'prediction');
        document.title = `${node.querySelector('h2').textContent} - ${node.querySelector('h1').textContent} - Sightline`;
        panel?.show(slide, slides[at + 1], began);
        await build(slide, lab);
        const figure = hostOf(slide)?.figure;
        if (!figure || slides[at] !== slide) return;
        if (slide.kind === 'prediction') figure.set(structuredClone(isAnswered ? slide.then : slide.first));
        figure.resize();
    }

    function move(wanted, answered) {
        began ||= Date.now();
        if (wanted !== at) history.pushState(null, '', `#${slides[wanted].node.id}`);
        show(wanted, answered);
        tell();
    }
    function go(by) {
        if (by > 0 && slides[at].kind === 'prediction' && !isAnswered) move(at, true);
        else if (by < 0 && isAnswered) move(at, false);
        else if (slides[at + by]) move(at + by, false);
    }

    talk.onmessage = async ({ data: { slide, isAnswered: answered, began: start, hello, values } }) => {
        if (hello) return tell();
        began ||= start;
        const wanted = slideOf(`#${slide}`);
        if (wanted !== at || answered !== isAnswered) {
            history.replaceState(null, '', `#${slide}`);
            await show(wanted, answered);
        } else panel?.show(slides[at], slides[at + 1], began);
        const figure = values && hostOf(slides[at])?.figure;
        if (!figure) return;
        isTold = true;
        figure.set(structuredClone(values));
        isTold = false;
    };
    /** What a hand has changed here goes to the other windows. */
    const share = () => {
        const figure = hostOf(slides[at])?.figure;
        if (figure && !isTold) tell({ values: stateOf(figure) });
    };
    main.addEventListener('input', share);
    main.addEventListener('keyup', share);
    main.addEventListener('pointermove', ({ buttons }) => buttons && share());
    main.addEventListener('pointerup', share);
    addEventListener('popstate', () => {
        show(slideOf(location.hash), false);
        tell();
    });
    document.addEventListener('keydown', (event) => {
        const by = stepOf(event);
        if (!by) return;
        event.preventDefault();
        go(by);
    });
    await show(slideOf(location.hash), false);
    talk.postMessage({ hello: true });
    if (asked.has('print')) await prepareAll(slides, lab);
    if (asked.get('print') === 'now') print();
}
