/** The teachers' page: for each exercise of each chapter its answer, why it is right, and what is said to wrong ones. */
import { element } from '../course/figure.js';
import { puzzles } from '../course/puzzles.js';
import { firstState, keepPicture, stillOf } from '../course/still.js';
import { solutions } from './lab-solutions.js';

export const figures = {}, exercises = {};

const said = (...parts) => element('li', {}, ...parts);

function choice(exercise, lab) {
    const right = exercise.right(lab), [answer, why] = exercise.options[right];
    return { answer, why, wrong: exercise.options.filter((_, i) => i !== right).map(([text, remark]) => said(element('q', {}, text), ` ${remark}`)) };
}

const number = async (exercise, lab) => ({ answer: String(await exercise.right(lab)), why: exercise.why,
    wrong: [said(`Too low: ${exercise.low}`), said(`Too high: ${exercise.high}`)] });

const code = ({ name }) => ({ answer: 'for example this code', why: solutions[name].why, wrong: [], host: element('pre', { tabIndex: 0 }, solutions[name].code) });

/** The picture with its handles in right places. Whether they are right is judged as a student's are. */
async function place(exercise, lab) {
    if (!exercise.solution) return { answer: 'no example is stored', why: '', wrong: [] };
    const spec = { ...exercise.figure, handles: exercise.figure.handles.map((handle, i) => ({ ...handle, at: exercise.solution[i] })) };
    const state = firstState(spec);
    spec.update(state, lab);
    const { right, text } = await exercise.judge(state, lab), host = element('figure');
    if (!right) throw new Error(`the solution of "${exercise.question}" is wrong: ${text}`);
    keepPicture(host, (tones) => stillOf(spec, state, tones));
    return { answer: `for example ${exercise.solution.map((at) => `(${at.join(', ')})`).join(' and ')}`, why: text, wrong: [], host };
}

async function solution(name, exercise, lab) {
    const { answer, why, wrong, host } = await { choice, number, place, code }[exercise.kind]({ ...exercise, name }, lab);
    return element('article', { className: 'exercise', 'data-solution': name }, element('p', {}, exercise.question), ...(host ? [host] : []),
        element('p', {}, element('strong', {}, `Answer: ${answer}${/[.?]$/.test(answer) ? '' : '.'}`), ` ${why}`),
        ...(wrong.length ? [element('ul', {}, ...wrong)] : []));
}

/** @param {HTMLElement} main with a section for each chapter @param {import('../course/lab.js').Lab} lab */
export async function fill(main, lab) {
    for (const section of main.querySelectorAll('[data-solutions]')) {
        const chapter = await import(`../course/${section.dataset.solutions}.js`);
        const exercises = Object.entries({ puzzle: puzzles[section.dataset.solutions], ...chapter.exercises });
        section.append(...(await Promise.all(exercises.map(([name, exercise]) => solution(name, exercise, lab)))));
    }
}
