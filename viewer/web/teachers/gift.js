/** The page of questions for Moodle: chooses chapters and numbers, and saves the file. */
import { element } from '../course/figure.js';
import { COUNT, questionsOf } from '../course/questions/make.js';
import { MOST as LAST, pictureOf } from '../course/questions.js';
import { paper } from '../course/still.js';
import { save } from '../playground/files.js';
import { plural } from '../formats/words.js';
import { giftText } from './gift-text.js';

export const figures = {}, exercises = {};

const MOST = 20;

const bytesOf = (node) => btoa(String.fromCharCode(...new TextEncoder().encode(new XMLSerializer().serializeToString(node))));

/** @param {HTMLElement} main with a link for each chapter @param {import('../course/lab.js').Lab} lab */
export async function fill(main, lab) {
    const list = main.querySelector('[data-questions]'), said = element('p', { role: 'status', className: 'says' });
    const ticks = [...list.querySelectorAll('a')].map((link) => ({ chapter: new URL(link.href).searchParams.get('chapter'), title: link.textContent,
        input: element('input', { type: 'checkbox', checked: true, id: `tick-${new URL(link.href).searchParams.get('chapter')}` }) }));
    const [first, sets] = [['first', 'First number', 1, LAST], ['sets', 'How many numbers', 3, MOST]].map(([id, label, value, max]) => [element('input', { id, type: 'number', min: 1, max, value, required: true }), label]);
    const form = element('form', { className: 'exercise' }, ...ticks.map(({ input, title }) => element('p', {}, input, ' ', element('label', { htmlFor: input.id }, title))),
        ...[first, sets].map(([input, label]) => element('p', {}, element('label', { htmlFor: input.id }, `${label}: `), input)), element('button', { type: 'submit' }, 'Save'));
    form.addEventListener('submit', async (event) => {
        event.preventDefault();
        const begin = Number(first[0].value), parts = [];
        for (const { chapter, title, input } of ticks.filter((tick) => tick.input.checked))
            for (let seed = begin; seed < begin + Number(sets[0].value); seed++) {
                said.textContent = `${title}, number ${seed}`;
                const questions = await questionsOf(chapter, seed, lab);
                parts.push({ title, questions: questions.map((question) => ({ ...question, image: question.picture ? bytesOf(pictureOf(question, paper)) : '' })) });
                await new Promise((resolve) => setTimeout(resolve));
            }
        const text = giftText(parts);
        said.textContent = parts.length ? `${plural(parts.length * COUNT, 'question')} in ${(text.length / 1e6).toFixed(1)} MB.` : 'Choose a chapter first.';
        if (parts.length) save(new Blob([text], { type: 'text/plain' }), 'questions.gift');
    });
    list.replaceWith(form, said);
}
