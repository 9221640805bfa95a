/** The contents: what a student has answered, beside each chapter. */
import { t } from '../language/language.js';
import { loadProgress } from './progress.js';

export const figures = {}, exercises = {};

/** @param {HTMLElement} main */
export async function fill(main) {
    const answers = Object.entries(loadProgress().answers);
    for (const link of main.querySelectorAll('td a')) {
        const chapter = link.getAttribute('href').replace(/^.*\/|\.html$/g, '');
        const own = answers.filter(([key]) => key.startsWith(`${chapter}/`)), right = own.filter(([, { result }]) => result === 'right').length;
        if (own.length) link.after(t` (${right} of ${own.length} answers right)`);
    }
}
