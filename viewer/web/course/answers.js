/** The page of a student's answers: a name, a list to print, a file to save and to read back. */
import { t } from '../language/language.js';
import { plural } from '../formats/words.js';
import { save } from '../playground/files.js';
import { element } from './figure.js';
import { button } from './lecture-mode.js';
import { forgetProgress, keepName, loadProgress, readText, saveText } from './progress.js';

export const figures = {}, exercises = {};

/** @param {import('./progress.js').Answer} answer */
function articleOf({ question, given, result, tries, last }) {
    const isCode = given.includes('\n'), when = new Date(last).toLocaleString(document.documentElement.lang === 'en' ? 'en-GB' : document.documentElement.lang);
    return element('article', { className: 'exercise' }, element('p', {}, question),
        element('p', {}, element('strong', {}, t('Answer: ')), isCode ? t('this code') : given), ...(isCode ? [element('pre', { tabIndex: 0 }, given)] : []),
        element('p', {}, t`${result === 'right' ? t('Right') : t('Not yet right')}, after ${plural(tries, 'try', 'tries')}. Last try: ${when}.`));
}

/** @param {HTMLElement} main */
export async function fill(main) {
    const name = element('input', { id: 'name', autocomplete: 'name' }), list = element('div'), said = element('p', { role: 'status', className: 'says' });
    const file = element('input', { type: 'file', id: 'answers-file', accept: '.json' });
    const show = () => {
        const progress = loadProgress(), answers = Object.values(progress.answers), right = answers.filter(({ result }) => result === 'right').length;
        name.value = progress.name;
        const chapters = [...new Set(answers.map(({ chapter }) => chapter))].sort((a, b) => parseInt(a, 10) - parseInt(b, 10));
        list.replaceChildren(...chapters.flatMap((chapter) => [element('h2', {}, chapter), ...answers.filter((answer) => answer.chapter === chapter).map(articleOf)]));
        said.textContent = answers.length ? t`${plural(answers.length, 'answer')}, ${right} of them right.` : t('There are no answers yet. Press Check below an exercise of a chapter.');
    };
    name.addEventListener('input', () => keepName(name.value));
    file.addEventListener('change', async () => {
        try {
            readText(await file.files[0].text());
            show();
        } catch (error) {
            said.textContent = t`${file.files[0].name} was not read. ${error.message}`;
        }
        file.value = '';
    });
    main.append(element('p', {}, element('label', { htmlFor: 'name' }, t('Your name: ')), name),
        element('p', { className: 'controls' }, button(t('Export my answers'), () => save(new Blob([saveText()], { type: 'application/json' }), 'answers.json')),
            button(t('Print, or save as PDF'), () => print()),
            button(t('Forget my answers'), () => {
                if (!confirm(t('Forget the name and all answers?'))) return;
                forgetProgress();
                show();
            }), element('span', {}, element('label', { htmlFor: file.id }, t('Read a file: ')), file)), said, list);
    show();
}
