/**
 * Exercises: a question, an answer that the page checks, and an explanation for right and for wrong.
 *
 * kind 'choice': `options` are pairs of an answer and what is to be said about it.
 * kind 'number': a number is typed; `low` and `high` say what a wrong one has missed.
 * kind 'code':   a function is completed; code-lab.js runs and judges it.
 * kind 'place':  handles of `figure` are put somewhere; `solution` has right places of them, for the teachers' page.
 * `sketch(surface, camera, tones, lab)` draws a picture of the map in `box`, beside a question without a figure.
 * Each part of a form can `judge` the answer, `read` it as a value, say it in words (`given`) and `write` a value that was kept.
 * `right(lab)` gives the index or the number (or a promise of that), computed by the library where it can be; for places,
 * `judge(state, lab)` gives whether it is right and what is to be said.
 */
import { t } from '../language/language.js';
import { codePart } from './code-lab.js';
import { Figure, element } from './figure.js';
import { loadProgress, recordAnswer } from './progress.js';
import { hash } from './questions/chance.js';
import { keepPicture, picture } from './still.js';

let count = 0;

/** Options in the order of the page: shuffled, and the same each time. */
const shuffled = (options) => options.map(([text], i) => ({ text, i })).sort((a, b) => hash(a.text) - hash(b.text));

/** @param {any} exercise @param {import('./lab.js').Lab} lab @returns {HTMLElement} */
export function exerciseForm(exercise, lab) {
    const id = `exercise-${++count}`, answer = element('p', { className: 'answer', role: 'status' });
    const form = element('form', { className: 'exercise', 'data-exercise': exercise.name, noValidate: true });
    const part = { choice: choicePart, number: numberPart, place: placePart, code: codePart }[exercise.kind](exercise, lab, id);
    form.append(part.node, element('button', { type: 'submit' }, t('Check')), answer);
    if (exercise.name === 'puzzle') {
        form.id = 'puzzle';
        form.classList.add('puzzle');
        form.prepend(element('strong', {}, t('A puzzle to begin with')));
    }
    if (exercise.sketch) {
        const host = element('figure');
        part.node.before(host);
        keepPicture(host, (tones) => picture(t('The plan of the puzzle'), exercise.box, (surface, camera) => exercise.sketch(surface, camera, tones, lab), { most: 300 }));
    }
    const key = `${exercise.chapter}/${exercise.name}`;
    const show = (result, text) => {
        form.dataset.result = result;
        answer.textContent = text;
    };
    const forget = () => show('', '');
    form.addEventListener('input', forget);
    part.node.addEventListener('pointerdown', forget);
    form.addEventListener('submit', async (event) => {
        event.preventDefault();
        const { right, text } = await part.judge();
        if (right === null) {
            forget();
            answer.textContent = text;
        } else {
            const result = right ? 'right' : 'wrong', value = part.read();
            show(result, `${right ? t('Right.') : t('Not yet.')} ${text}`);
            recordAnswer(key, { chapter: document.querySelector('h1').textContent, question: t(exercise.question), value, given: part.given?.() ?? String(value), result, remark: answer.textContent });
        }
    });
    const kept = loadProgress().answers[key];
    if (kept && part.write(kept.value) !== false) show(kept.result, kept.remark);
    return form;
}

function choicePart(exercise, lab, id) {
    const node = element('fieldset', {}, element('legend', {}, t(exercise.question)));
    for (const { text, i } of shuffled(exercise.options))
        node.append(element('label', {}, element('input', { type: 'radio', name: id, value: String(i) }), ` ${t(text)}`));
    const judge = () => {
        const chosen = node.querySelector('input:checked');
        if (!chosen) return { right: null, text: t('Choose an answer first.') };
        return { right: Number(chosen.value) === exercise.right(lab), text: t(exercise.options[Number(chosen.value)][1]) };
    };
    const read = () => Number(node.querySelector('input:checked').value), given = () => t(exercise.options[read()][0]);
    const write = (value) => {
        const option = [...node.querySelectorAll('input')].find((input) => Number(input.value) === value);
        if (!option) return false;
        option.checked = true;
    };
    return { node, judge, read, given, write };
}

function numberPart(exercise, lab, id) {
    const input = element('input', { id, type: 'number', step: 'any', inputMode: 'decimal' });
    const node = element('p', {}, element('label', { htmlFor: id }, t(exercise.question)), ' ', input);
    const judge = async () => {
        if (input.value === '') return { right: null, text: t('Type a number first.') };
        const given = Number(input.value), wanted = await exercise.right(lab);
        if (given === wanted) return { right: true, text: t(exercise.why) };
        return { right: false, text: t(given < wanted ? exercise.low : exercise.high) };
    };
    return { node, judge, read: () => Number(input.value), write: (value) => (typeof value === 'number' ? (input.value = String(value)) && true : false) };
}

function placePart(exercise, lab) {
    const host = element('figure'), node = element('div', {}, element('p', {}, t(exercise.question)), host);
    const figure = new Figure(host, exercise.figure, lab);
    const names = exercise.figure.handles.map((handle) => handle.name), read = () => names.map((name) => [...figure.state[name]]);
    const given = () => read().map((at) => `(${at.map((v) => Number(v.toFixed(2))).join(', ')})`).join(t(' and '));
    const write = (value) => {
        const isPlaces = Array.isArray(value) && value.length === names.length && value.every((at) => Array.isArray(at) && at.length === 2 && at.every(Number.isFinite));
        if (!isPlaces) return false;
        names.forEach((name, i) => (figure.state[name] = value[i]));
        figure.change();
    };
    return { node, judge: () => exercise.judge(figure.state, lab), read, given, write };
}
