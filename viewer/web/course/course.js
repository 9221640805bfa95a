/** A chapter, or a page beside the chapters: puts figures, exercises and more where its text has places for them. */
import { exerciseForm } from './exercise.js';
import { Figure } from './figure.js';
import { Lab } from './lab.js';
import { lectureMode } from './lecture.js';

const main = document.querySelector('main');

async function begin() {
    const [lab, chapter] = await Promise.all([Lab.open(), import(`./${document.body.dataset.chapter}.js`)]);
    for (const host of main.querySelectorAll('figure[data-figure]')) new Figure(host, chapter.figures[host.dataset.figure], lab);
    for (const host of main.querySelectorAll('div[data-exercise]'))
        host.replaceWith(exerciseForm({ ...chapter.exercises[host.dataset.exercise], name: host.dataset.exercise }, lab));
    await chapter.fill?.(main, lab);
    lectureMode(main);
    main.dataset.ready = 'yes';
}

begin().catch((error) => {
    const text = document.createElement('p');
    text.setAttribute('role', 'alert');
    text.textContent = `The figures cannot be shown: ${error.message}`;
    main.prepend(text);
    console.error(error);
});
