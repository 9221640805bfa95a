/** A chapter, or a page beside the chapters: puts figures, exercises and more where its text has places for them. */
import { t } from '../language/language.js';
import { exerciseForm } from './exercise.js';
import { Figure } from './figure.js';
import { Lab } from './lab.js';
import { lectureMode } from './lecture-mode.js';
import { wireWords } from './words.js';

const main = document.querySelector('main');

async function begin() {
    const name = document.body.dataset.chapter, needsLab = main.querySelector('[data-figure], [data-exercise], [data-puzzle], [data-picture], [data-show], [data-questions], [data-solutions]');
    const [lab, chapter] = await Promise.all([needsLab && Lab.open(), import(`./${name}.js`)]);
    for (const host of main.querySelectorAll('figure[data-figure]')) new Figure(host, chapter.figures[host.dataset.figure], lab);
    for (const host of main.querySelectorAll('div[data-exercise]'))
        host.replaceWith(exerciseForm({ ...chapter.exercises[host.dataset.exercise], name: host.dataset.exercise, chapter: name }, lab));
    for (const host of main.querySelectorAll('div[data-puzzle]')) {
        const { puzzles } = await import('./puzzles.js');
        host.replaceWith(exerciseForm({ ...puzzles[name], name: 'puzzle', chapter: name }, lab));
    }
    wireWords(main);
    await chapter.fill?.(main, lab);
    lectureMode(main);
    main.dataset.ready = 'yes';
}

begin().catch((error) => {
    const text = document.createElement('p');
    text.setAttribute('role', 'alert');
    text.textContent = t`The figures cannot be shown: ${error.message}`;
    main.prepend(text);
    console.error(error);
});
