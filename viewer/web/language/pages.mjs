/**
 * Pages in other languages: DIR/de/... beside DIR/..., with the same modules. A .po file of this folder has all texts of a language: those of
 * pages, by the HTML within a paragraph, heading, item or cell, and those of modules, which language.js looks up.
 */
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join, posix } from 'node:path';
import { fileURLToPath } from 'node:url';
import { readPo } from './po.mjs';

const here = dirname(fileURLToPath(import.meta.url));

/** What each language calls itself; its file is NAME.po. */
export const languages = { de: 'Deutsch' };

/** Pages that have other languages. */
export const pages = ['index.html', 'course/index.html', 'course/answers.html', 'course/glossary.html', 'course/rooms.html', 'course/lines.html'];

const leaf = /<(title|h[1-6]|p|li|t[dh]|d[td]|legend|option|label|span|figcaption)\b([^>]*)>((?:[^<]|<\/?(?:a|button|strong|em|code)\b[^>]*>)*)<\/\1>|<(a|button)\b([^>]*)>([^<]*)<\/\4>/g;
const hasWords = (text) => /\p{L}{2}/u.test(text.replace(/<[^>]*>|&\w+;/g, ''));

/** A text without what is the same in all languages: one link around all of it, the name of the site, a mark before a title. */
function sayCore(text, say) {
    const [, before, core, after] = /^((?:<(?:a|button)\b[^>]*>)?)([^]*?)((?:<\/(?:a|button)>)?(?: - Sightline)?)$/.exec(text), isWhole = !/<\/?(?:a|button)\b/.test(core);
    if (!isWhole) return say(text);
    const mark = /^(Back:|Next:) (.*)$/.exec(core);
    return before + (mark ? `${say(mark[1])} ${say(mark[2])}` : say(core)) + after;
}

/** A page with each of its texts given to `say`. Sources of papers and code stay as they are. */
export function translatePage(html, say) {
    const put = (text) => (hasWords(text) && !/^<code>[^<]*<\/code>$|^[A-Z]{3}$|doi\.org/.test(text.trim()) ? text.replace(/^(\s*)([^]*?)(\s*)$/, (_, before, inner, after) => before + sayCore(inner.replace(/\s+/g, ' '), say) + after) : text);
    const parts = html.split(/(<h2 id="references">[^]*?<\/ul>|<pre\b[^]*?<\/pre>)/);
    return parts.map((part, i) => (i % 2 ? part.replace(/(<h2[^>]*>)([^<]*)/, (_, tag, text) => tag + say(text)) : part
        .replace(leaf, (_, block, ofBlock, inner, link, ofLink, words) => (block ? `<${block}${ofBlock}>${put(inner)}</${block}>` : `<${link}${ofLink}>${put(words)}</${link}>`))
        .replace(/(<input\b[^>]*>)([^<]+)/g, (_, input, text) => input + put(text))
        .replace(/\b(aria-label|placeholder)="([^"]*\p{L}{2}[^"]*)"/gu, (_, name, text) => `${name}="${say(text)}"`)
        .replace(/(<meta name="description" content=")([^"]*)/, (_, head, text) => head + say(text)))).join('');
}

/** Links of a page of a language: to pages that it has, or else to the English ones. @param {string} path of the page */
function relink(html, path) {
    const up = posix.relative(posix.dirname(path) || '.', '.') || '.';
    return html.replace(/\b(href|src)="([^"]*)"/g, (whole, name, target) => {
        if (/^[a-z]+:|^#/.test(target)) return whole;
        const [file, end = ''] = target.split(/(?=[?#])/), full = posix.join(posix.dirname(path), file);
        return `${name}="${pages.includes(full) ? target : posix.join(up, '..', full) + end}"`;
    });
}

/** Links to the same page in other languages, at the end of its first list of links. */
const withLinks = (html, links) => html.replace('</nav>', () => `${links.map(([code, word, href]) => `<a href="${href}" lang="${code}" hreflang="${code}">${word}</a>\n`).join('')}</nav>`);

/** Writes tables and pages of all languages. @param {string} site */
export function writeLanguages(site) {
    mkdirSync(join(site, 'language'), { recursive: true });
    const english = new Map(pages.map((path) => [path, readFileSync(join(site, path), 'utf8')]));
    for (const code of Object.keys(languages)) {
        const words = new Map([...readPo(join(here, `${code}.po`))].filter(([, text]) => text)), say = (text) => words.get(text) ?? text;
        writeFileSync(join(site, 'language', `${code}.json`), `${JSON.stringify(Object.fromEntries(words))}\n`);
        for (const [path, html] of english) {
            const up = posix.relative(posix.dirname(path) || '.', '.') || '.', file = join(site, code, path);
            mkdirSync(dirname(file), { recursive: true });
            const translated = relink(translatePage(html, say), path).replace('<html lang="en">', `<html lang="${code}">`);
            writeFileSync(file, withLinks(translated, [['en', 'English', posix.join(up, '..', path)]]));
        }
    }
    for (const [path, html] of english) {
        const up = posix.relative(posix.dirname(path) || '.', '.') || '.';
        writeFileSync(join(site, path), withLinks(html, Object.entries(languages).map(([code, word]) => [code, word, posix.join(up, code, path)])));
    }
}

/** Texts of figures and exercises that stand in their data. */
function textsOf({ figures = {}, exercises = {}, pictures = {} }) {
    const ofFigure = ({ title, about, controls = [] }) => [title, about, ...(controls ?? []).flatMap(({ label, options = [] }) => [label, ...options.map(([, text]) => text)])];
    return [...Object.values(figures).flatMap(ofFigure), ...Object.values(pictures).map(([words]) => words), ...Object.values(exercises).flatMap(({ question, why, low, high, options = [], figure }) =>
        [question, why, low, high, ...options.flat(), ...(figure ? ofFigure(figure) : [])])].filter((text) => text && hasWords(text));
}

/** A value of a template, which may hold brackets and templates of its own. */
const VALUE = '\\$\\{(?:[^{}`]|\\{[^{}]*\\}|`(?:[^`$]|\\$\\{[^{}]*\\})*`)*\\}';

/** Texts that modules give to `t`, plain ones and templates, also those within others. */
function textsOfCode(code) {
    const plain = [...code.matchAll(/\bt\('((?:[^'\\]|\\.)*)'\)/g)].map(([, text]) => text.replace(/\\'/g, "'"));
    const templates = [...code.matchAll(new RegExp(`\\bt\`((?:[^\`\\\\$]|\\\\.|${VALUE})*)\``, 'g'))].map(([, text]) => {
        let i = 0;
        return text.replace(new RegExp(VALUE, 'g'), () => `{${i++}}`);
    });
    return [...plain, ...templates];
}

/** Nouns that `plural` counts: in code of pages with other languages. */
const nounsOf = (code) => [...code.matchAll(/\bplural\([^']*'(\w+)'(?:, '(\w+)')?/g)].flatMap(([, one, many = `${one}s`]) => [one, many]);

const modules = [...pages.map((path) => posix.basename(path, '.html')).filter((name) => name !== 'index'), 'index'].map((name) => `course/${name}.js`);
const shared = ['course/course.js', 'course/exercise.js', 'course/figure.js', 'course/still.js', 'course/lecture-mode.js', 'course/own.js', 'course/progress.js', 'course/puzzles.js', 'parts/dual.js', 'parts/why-scene.js',
    'playground/main.js', 'playground/sight.js', 'playground/panel.js', 'playground/cameras.js', 'playground/between.js', 'playground/heat.js', 'playground/files.js', 'playground/share.js', 'playground/document.js', 'playground/told.js'];

/** All texts that a language needs, in the order of a reader. @param {string} site @param {(path: string) => Promise<any>} load a module of it */
export async function textsOfSite(site, load) {
    const texts = new Set(), add = (list) => list.forEach((text) => texts.add(text)), { kinds } = await load('formats/map-text.js'), { puzzles } = await load('course/puzzles.js');
    for (const path of pages) translatePage(readFileSync(join(site, path), 'utf8').replace(/<a [^>]*hreflang[^]*?<\/a>\n/g, ''), (text) => texts.add(text) && text);
    for (const path of [...shared, ...modules]) {
        const code = readFileSync(join(site, path), 'utf8');
        add([...textsOfCode(code), ...nounsOf(code)]);
        if (modules.includes(path)) add(textsOf(await load(path)));
        const puzzle = puzzles[posix.basename(path, '.js')];
        if (modules.includes(path) && puzzle) add(textsOf({ exercises: { puzzle } }));
    }
    add([...kinds, 'glass']); // as the playground names items
    return texts;
}

/** What languages lack, and what they have in vain. @returns {{code: string, missing: string[], unused: string[]}[]} */
export const faultsOf = (texts) => readdirSync(here).filter((file) => file.endsWith('.po')).map((file) => {
    const words = readPo(join(here, file));
    return { code: file.slice(0, -3), missing: [...texts].filter((text) => !words.get(text)), unused: [...words.keys()].filter((text) => !texts.has(text)) };
});

export const hasLanguage = (code) => Object.hasOwn(languages, code) && existsSync(join(here, `${code}.po`));
