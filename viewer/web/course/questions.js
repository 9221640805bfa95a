/** The page of questions: questions.html?chapter=here&seed=7. Without a chapter it is a list of them. */
import { exerciseForm } from './exercise.js';
import { element } from './figure.js';
import { questionsOf } from './questions/make.js';
import { keepPicture, picture } from './still.js';

export const figures = {}, exercises = {};

/** The largest number that names questions. */
export const MOST = 1000000;

/** A picture beside a question, in the colours of the page. */
export function pictureOf(question, tones) {
    const { title, box, draw } = question.picture;
    return picture(title, box, (surface, camera) => draw(surface, camera, tones), { width: 480, most: 320 });
}

/** @param {HTMLElement} main with a link for each chapter @param {import('./lab.js').Lab} lab */
export async function fill(main, lab) {
    const asked = new URL(location.href).searchParams, chapter = asked.get('chapter'), links = [...main.querySelectorAll('[data-questions] a')];
    if (!chapter) return;
    const link = links.find((each) => each.search === `?chapter=${chapter}`), seed = Number(asked.get('seed') ?? 1);
    if (!link) throw new Error(`there is no chapter ${chapter}`);
    if (!Number.isInteger(seed) || seed < 1 || seed > MOST) throw new Error(`the number of the questions is a whole one from 1 to ${MOST}, not ${asked.get('seed')}`);
    main.querySelector('h1').textContent = link.textContent;
    document.title = `${link.textContent}: questions - Sightline`;
    const field = element('input', { id: 'seed', type: 'number', min: 1, max: MOST, value: seed, required: true }), go = element('button', { type: 'submit' }, 'Show');
    const choose = element('form', { className: 'controls' }, element('span', {}, element('label', { htmlFor: 'seed' }, 'Number of the questions: '), field, go),
        element('a', { href: `${chapter}.html` }, 'The chapter'), element('a', { href: 'questions.html' }, 'Other chapters'));
    choose.addEventListener('submit', (event) => {
        event.preventDefault();
        location.search = `?chapter=${chapter}&seed=${field.value}`;
    });
    const forms = (await questionsOf(chapter, seed, lab)).map((question) => {
        const form = exerciseForm(question, lab);
        if (!question.picture) return form;
        const host = element('figure');
        form.prepend(host);
        keepPicture(host, (tones) => pictureOf(question, tones));
        return form;
    });
    main.querySelector('[data-questions]').replaceWith(element('nav', { 'aria-label': 'Questions' }, choose), ...forms);
}
