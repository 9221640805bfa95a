/** The questions of a chapter for a number: the same number gives the same questions, on each computer. */
import { Chance } from './chance.js';

export const COUNT = 10;

/** The name under which the answer to a question is kept. @param {number} seed @param {number} i from 0 on */
export const nameOf = (seed, i) => `question-${seed}-${i + 1}`;

/**
 * Kinds of questions take turns. @param {string} chapter @param {number} seed a whole number from 1 on
 * @param {import('../lab.js').Lab} lab @returns {Promise<import('./ask.js').Question[]>}
 */
export async function questionsOf(chapter, seed, lab) {
    const { kinds } = await import(`./${chapter}.js`), questions = [];
    for (let i = 0; i < COUNT; i++) {
        const chance = new Chance(`${chapter} ${seed} ${i}`), make = kinds[i % kinds.length], isNew = ({ question, picture }) => picture || !questions.some((other) => other.question === question);
        let made = await make(chance, lab);
        while (!isNew(made)) made = await make(chance, lab);
        questions.push({ ...made, name: nameOf(seed, i), chapter });
    }
    return questions;
}
