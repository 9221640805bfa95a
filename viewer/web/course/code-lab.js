/**
 * A lab: the student completes a function, and the page judges it on cases that it does not show, against the library.
 * The first case on which it fails is drawn, with a counterexample. What is asked and how it is judged is a CodeLab;
 * there is one a file: region-lab.js, search-lab.js, funnel-lab.js, pull-lab.js.
 */
import { element } from './figure.js';
import { flat, hall, house, itemsOf, pillars, segmentsOf } from './maps.js';
import { keepPicture } from './still.js';

/**
 * @typedef {Object} CodeLab
 * @property {string} call the name of the judged function @property {string} gives what it gives, in words
 * @property {(lab: import('./lab.js').Lab) => {given: any[], about: string}[]} cases arguments of each call, and more for the judge
 * @property {(value: any) => boolean} isAnswer whether a value has the right form
 * @property {(one: any, lab: import('./lab.js').Lab) => (tones: any) => Element} draw a case alone
 * @property {(lab: import('./lab.js').Lab, one: any, value: any) => any} judge null, or {text, draw}; it may be a promise
 * @property {(count: number) => string} right what is said when all cases are passed
 */

/** How long all calls may take together, in milliseconds, from when the worker begins. */
const PATIENCE = 3000;

/** By so little some cases are passed or missed. It is so few binary digits below whole numbers that signs of the labs stay exact. */
export const HAIR = 2 ** -40;

/** Numbers between 0 and 1, the same each time. */
export function chances(seed) {
    let number = seed;
    return () => (number = (number * 48271) % 2147483647) / 2147483647;
}

const halls = [2, 3].map((columns) => ({ text: hall(columns), box: [0, 0, 4 * columns, 12] }));

/** Maps for the cases. */
export const hiddenPlans = () => [pillars, flat, house, ...halls].map(({ text, box }) => {
    const items = itemsOf(text);
    return { text, box, items, walls: segmentsOf(items) };
});

/** Calls the student's function beside the page. @returns {Promise<any[]>} what came of each call */
function run(code, name, calls) {
    const worker = new Worker(new URL('./code-worker.js', import.meta.url)), answers = [];
    return new Promise((resolve) => {
        const end = () => {
            worker.terminate();
            clearTimeout(timer);
            resolve(answers);
        };
        const stop = () => {
            answers[answers.length] = { error: `no answer within ${PATIENCE / 1000} seconds` };
            end();
        };
        let timer;
        worker.addEventListener('message', ({ data }) => {
            if (data.begins) return (timer = setTimeout(stop, PATIENCE));
            answers[data.i] = data;
            if (data.error || data.i === calls.length - 1) end();
        });
        worker.addEventListener('error', (event) => {
            answers[answers.length] = { error: event.message };
            end();
        });
        worker.postMessage({ code, name, calls });
    });
}

/** Lets the page answer between two cases. */
const breathe = () => new Promise((resolve) => setTimeout(resolve));

/** Judges code. @param {CodeLab} asked @returns {Promise<{right: boolean, text: string, draw?: (tones: any) => Element}>} */
async function judgeCode(code, asked, lab) {
    const cases = await asked.cases(lab), answers = await run(code, asked.call, cases.map(({ given }) => given));
    for (const [i, one] of cases.entries()) {
        const answer = answers[i], on = `On map ${i + 1} of ${cases.length}, which is drawn here,`;
        const fails = (what) => ({ right: false, text: `${on} the function ${what}`, draw: asked.draw(one, lab) });
        if (!answer || answer.error) return fails(`ends with an error (${one.about}): ${answer?.error ?? 'no answer'}`);
        if (!asked.isAnswer(answer.value)) return fails(`gives no ${asked.gives} (${one.about}).`);
        await breathe();
        const found = await asked.judge(lab, one, answer.value);
        if (found) return { right: false, text: `${on} ${found.text}`, draw: found.draw };
    }
    return { right: true, text: asked.right(cases.length) };
}

/** The part of an exercise's form: the code, and where a counterexample is drawn. */
export function codePart(exercise, lab, id) {
    const area = element('textarea', { id, value: exercise.code, spellcheck: false, rows: exercise.code.split('\n').length + 2, autocapitalize: 'off', autocomplete: 'off' });
    const picture = element('figure', { className: 'counterexample', hidden: true }), again = element('button', { type: 'button' }, 'Begin anew');
    again.addEventListener('click', () => {
        area.value = exercise.code;
        area.dispatchEvent(new Event('input', { bubbles: true }));
    });
    const node = element('div', { className: 'code-part' }, element('label', { htmlFor: id }, exercise.question), area, picture, again);
    area.addEventListener('input', () => (picture.hidden = true));
    const judge = async () => {
        const { draw, ...said } = await judgeCode(area.value, exercise.lab, lab);
        picture.hidden = !draw;
        if (draw) keepPicture(picture, draw);
        return said;
    };
    return { node, judge, read: () => area.value, write: (text) => (typeof text === 'string' ? (area.value = text) && true : false) };
}
