/**
 * The slides of the lecture, of one Markdown text: a heading of level 2 is the name of a chapter, one of level 3 a slide.
 * A paragraph that begins with "Notes:" is for the lecturer. {slide: CHAPTER/FIGURE | name=value, name=value | name=value} is a figure
 * in a state, and what changes in it when the class has made a prediction; course/words.js reads the values.
 */
import { stateOf } from './course/words.js';
import { escapeHtml } from './markdown.mjs';

/** The state that words name, checked against the figure; a control with a choice has words for values. */
function stateFor(words, spec, fail) {
    return Object.fromEntries(Object.entries(words ? stateOf(words) : {}).map(([name, value]) => {
        const control = spec.controls?.find((each) => each.name === name);
        if (value === undefined || !(control || spec.handles.some((handle) => handle.name === name))) fail(`no ${name} in "${spec.title}"`);
        return [name, control?.kind === 'choice' ? String(value) : value];
    }));
}

/** The place of a figure. @param {(name: string) => Promise<any>} load a chapter's module */
async function placeOf(words, load, fail) {
    const [target, state = '', then = ''] = words.split('|').map((part) => part.trim()), [chapter, name] = target.split('/'), spec = (await load(chapter)).figures[name] ?? fail(`no figure ${target}`);
    const json = (text) => escapeHtml(JSON.stringify(stateFor(text, spec, fail)));
    return { title: spec.title.replace(/\.$/, ''), html: `<figure data-show="${target}" data-state="${json(state)}" data-then="${json(then)}"></figure>` };
}

const [OPENS, NOTES] = ['<blockquote>', /^<p>Notes: ([^]*?)<\/p>$/m];

/** One slide, of its HTML; a figure has its own title. */
function slide(chapter, name, title, body) {
    const notes = NOTES.exec(body)?.[1] ?? '', kind = name ? name.toLowerCase().replaceAll(' ', '-') : 'title';
    return `<section class="slide" id="${chapter.name}-${kind}" data-chapter="${chapter.name}" data-kind="${kind}">
<h1>${chapter.title}</h1>
<h2>${title}</h2>
${body.replace(NOTES, '').trim().replace(OPENS, '<blockquote class="answer-slide">')}
<aside class="notes"><p>${notes}</p></aside>
</section>`;
}

/**
 * @param {string} html of the text, with places of figures as paragraphs
 * @param {{name: string, title: string, about: string}[]} chapters @param {(what: string) => never} fail
 */
export async function writeSlides(html, chapters, load, fail) {
    const out = [];
    for (const part of html.split(/(?=<h2 )/).filter((each) => each.startsWith('<h2 '))) {
        const name = /^<h2 [^>]*>([^<]*)/.exec(part)[1], chapter = chapters.find((each) => each.name === name) ?? fail(`no chapter ${name}`);
        for (const text of part.split(/(?=<h3 )/)) {
            const kind = /^<h3 [^>]*>([^<]*)/.exec(text)?.[1] ?? '', [whole, words] = /<p>\{slide: ([^}]*)\}<\/p>/.exec(text) ?? [];
            const place = words && (await placeOf(words, load, fail)), body = text.replace(/^<h\d [^]*?<\/h\d>/, '');
            out.push(slide(chapter, kind, kind === 'Figure' ? place.title : kind || chapter.about, place ? body.replace(whole, place.html) : body));
        }
    }
    return out.join('\n');
}
