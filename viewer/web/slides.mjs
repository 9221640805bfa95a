/**
 * The slides of the lecture, of one Markdown text: a heading of level 2 is the name of a chapter, one of level 3 a slide.
 * A paragraph that begins with "Notes:" is for the lecturer. {show: CHAPTER/FIGURE NAME=VALUE ... / NAME=VALUE ...} is a figure in
 * a state, and what changes in it when the class has made a prediction; a value is a number, a place such as 2,6.5, yes, no or a word.
 */
import { escapeHtml } from './markdown.mjs';

const valueOf = (text) => (/^-?[\d.]+(,-?[\d.]+)*$/.test(text) ? (text.includes(',') ? text.split(',').map(Number) : Number(text)) : { yes: true, no: false }[text] ?? text);

/** @returns {Record<string, any>} the values of some words such as eye=2,6.5; a number is text where a control has a choice */
function stateOf(words, spec, fail) {
    return Object.fromEntries((words.match(/\S+/g) ?? []).map((word) => {
        const [name, text] = word.split('='), control = spec.controls?.find((each) => each.name === name);
        if (text === undefined || !(control || spec.handles.some((handle) => handle.name === name))) fail(`no ${word} in "${spec.title}"`);
        return [name, control?.kind === 'choice' ? text : valueOf(text)];
    }));
}

/** The place of a figure. @param {(name: string) => Promise<any>} load a chapter's module */
async function placeOf(words, load, fail) {
    const [target, ...rest] = words.split(' '), [chapter, name] = target.split('/'), spec = (await load(chapter)).figures[name] ?? fail(`no figure ${target}`);
    const [state, then = ''] = rest.join(' ').split('/');
    const json = (text) => escapeHtml(JSON.stringify(stateOf(text, spec, fail)));
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
            const kind = /^<h3 [^>]*>([^<]*)/.exec(text)?.[1] ?? '', [whole, words] = /<p>\{show: ([^}]*)\}<\/p>/.exec(text) ?? [];
            const place = words && (await placeOf(words, load, fail)), body = text.replace(/^<h\d [^]*?<\/h\d>/, '');
            out.push(slide(chapter, kind, kind === 'Figure' ? place.title : kind || chapter.about, place ? body.replace(whole, place.html) : body));
        }
    }
    return out.join('\n');
}
