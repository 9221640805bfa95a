/**
 * Makes the site: node viewer/web/build.mjs --package PACKAGE --out SITE [--glpk FOLDER] [--teachers]
 *
 * FOLDER holds glpk.wasm, the licence and the sources of GLPK: with them, the site has a page of GLPK's answers.
 * With --teachers it has the pages of teachers/ as well, to which no page leads.
 * PACKAGE is the built npm package, SITE the folder to write. The site is plain files: this folder,
 * the package, the maps of maps/, the course, and a page from each document for an audience.
 */
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { basename, dirname, join, posix, relative } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { languages, writeLanguages } from './language/pages.mjs';
import { anchorOf, anchorsOf, titleOf, toHtml } from './markdown.mjs';
import { page, policy } from './page.mjs';
import { readReferences, referenceLine } from './references.mjs';
import { writeSlides } from './slides.mjs';

const here = dirname(fileURLToPath(import.meta.url)), root = join(here, '../..');

/** Documents that become pages. */
const documents = {
    'maps/FLOOR-PLANS.md': 'floor-plans',
    'maps/GAME-MAPS.md': 'game-maps',
    'viewer/TEACHING.md': 'teaching',
    'lib/EMBEDDING.md': 'embedding',
    'maps/FORMAT.md': 'map-text',
    'lib/io/FORMATS.md': 'formats',
    'lib/bake/EXPORT.md': 'export',
    'lib/GLOSSARY.md': 'glossary',
};

const parts = ['index.html', 'style.css', 'icon.svg', 'core', 'formats', 'language/language.js', 'parts', 'playground', 'course'];

/** Names in the gallery: the first comment of a map says what it shows. */
function titleOfMap(path, text) {
    const said = /#\s*(.*)/.exec(text.split('\n')[0])?.[1];
    const name = basename(path).replace(/\.\w+$/, '');
    const plan = { cellar: 'a few rooms', dungeon: 'rooms and corridors in rock' }[name];
    const about = path.endsWith('.map') ? said?.split(/[:;,.]/)[0] : plan;
    return about && about.toLowerCase() !== name ? `${name}: ${about.trim()}` : name;
}

function mapFiles(folder) {
    return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => entry.isDirectory()
        ? mapFiles(join(folder, entry.name)) : /\.(map|txt)$/.test(entry.name) ? [join(folder, entry.name)] : []);
}

function writeGallery(site) {
    const list = mapFiles(join(root, 'maps')).map((path) => {
        const text = readFileSync(path, 'utf8'), file = relative(join(root, 'maps'), path).replaceAll('\\', '/');
        mkdirSync(dirname(join(site, 'maps', file)), { recursive: true });
        writeFileSync(join(site, 'maps', file), text);
        return { file, title: titleOfMap(path, text) };
    });
    list.sort((a, b) => a.file.split('/').length - b.file.split('/').length || a.file.localeCompare(b.file));
    writeFileSync(join(site, 'maps/index.json'), `${JSON.stringify(list, null, 1)}\n`);
}

/** Links lead to pages of the site; those to sources stay words. Pictures are copied. */
function writePages(site) {
    mkdirSync(join(site, 'pages'), { recursive: true });
    for (const [path, name] of Object.entries(documents)) {
        const text = readFileSync(join(root, path), 'utf8');
        const link = (target, picture) => {
            if (/^(https?:|mailto:|#)/.test(target)) return target;
            const [file, anchor] = posix.join(posix.dirname(path), target).split('#');
            if (!existsSync(join(root, file))) throw new Error(`${path}: the link ${target} leads nowhere`);
            if (documents[file]) return `${documents[file]}.html${anchor ? `#${anchor}` : ''}`;
            const inCourse = /^viewer\/web\/(course\/[\w-]+)\.md$/.exec(file);
            if (inCourse) return `../${inCourse[1]}.html${anchor ? `#${anchor}` : ''}`;
            if (!picture) return null;
            const copy = file.replaceAll('/', '-');
            cpSync(join(root, file), join(site, 'pages', copy));
            return copy;
        };
        writeFileSync(join(site, 'pages', `${name}.html`), page(titleOf(text), toHtml(text, link)));
    }
}

/** Links to all headings of level 3, by the alphabet. */
function listTerms(text) {
    const terms = [...text.matchAll(/^### (.*)$/gm)].map(([, term]) => term).sort((a, b) => a.localeCompare(b, 'en'));
    return `<ul class="terms">\n${terms.map((term) => `<li><a href="#${anchorOf(term)}">${term}</a></li>`).join('\n')}\n</ul>`;
}

/**
 * The course: index.md lists the chapters, and each has its text and a module of one name. Lines such as
 * {figure: eye}, {exercise: eye} and {picture: eye} are places that the module fills. {value: edges} is a number or words
 * that `values` of the module computes by the library, here. {references: KEY, KEY} lists sources of references.bib.
 * {puzzle} is the one of puzzles.js that opens a chapter. {show: FIGURE MARK | words} and {try: FIGURE name=value | words} are words
 * that light a part of a figure, or put it into a state (words.js). {slide: ...} is a figure of a slide (slides.mjs).
 * {solutions} is a place for each chapter, {questions} lists those with questions, {chapter: 3} names one and links to it if it is
 * listed, and {terms} lists the headings of level 3. A link, an anchor, a value or a source that leads nowhere ends the build.
 */
async function writeCourse(site, folders) {
    const course = join(here, 'course');
    const chapters = [...readFileSync(join(course, 'index.md'), 'utf8').matchAll(/^\| \[([^\]]+)\]\(([\w-]+)\.md\) \| (.*) \|$/gm)]
        .map(([, title, name, about]) => ({ title, name, about: toHtml(about).replace(/<\/?p>/g, '') }));
    const sources = readReferences(readFileSync(join(course, 'references.bib'), 'utf8')), used = new Set();
    const load = (path) => import(pathToFileURL(join(site, path)).href), { Lab } = await load('course/lab.js'), lab = await Lab.open();
    const [{ puzzles }, { stateOf }] = await Promise.all([load('course/puzzles.js'), load('course/words.js')]);
    for (const folder of folders)
        for (const file of readdirSync(join(here, folder)).filter((name) => name.endsWith('.md'))) {
            const name = file.slice(0, -3), isChapter = existsSync(join(here, folder, `${name}.js`));
            const module = isChapter ? await load(`${folder}/${name}.js`) : {};
            const fail = (what) => { throw new Error(`${folder}/${file}: ${what}`); };
            const raw = readFileSync(join(here, folder, file), 'utf8'), values = new Map();
            for (const [, value] of raw.matchAll(/\{value: ([\w-]+)\}/g)) values.set(value, (await module.values?.[value]?.(lab)) ?? fail(`no value ${value}`));
            const text = raw
                .replace(/\{chapter: (\d+)\}/g, (_, number) => {
                    const chapter = chapters.find(({ title }) => title.startsWith(`${number}. `));
                    return chapter ? `[chapter ${number}](${chapter.name}.md)` : `chapter ${number}`;
                })
                .replace(/\{value: ([\w-]+)\}/g, (_, value) => values.get(value))
                .replace(/^\{references: (.*)\}$/m, (_, keys) => keys.split(', ').map((key) => {
                    used.add(key);
                    return `- ${referenceLine(sources.get(key) ?? fail(`no source ${key}`))}`;
                }).join('\n') + '\n\nAll sources of the course: [BibTeX](references.bib).');
            checkWords(text, module.figures, stateOf, fail);
            if (text.includes('{puzzle}') && !puzzles[name]) fail('it has no puzzle');
            const link = linkOf(folder, file, fail);
            const html = toHtml(text, link), isDeck = html.includes('<p>{slide: '), about = isDeck ? /<p>([^]*?)<\/p>/.exec(html)[1].replace(/\s+/g, ' ') : '';
            const body = isDeck ? await writeSlides(html, chapters, (chapter) => load(`course/${chapter}.js`), fail)
                : fillPlaces(html, text, chapters) + (folder === 'course' ? neighbours(chapters, name) : '');
            const chapter = isChapter ? (folder === 'course' ? name : `../${folder}/${name}`) : '';
            writeFileSync(join(site, folder, `${name}.html`), page(titleOf(text), body, { about, chapter, isCourse: true, isSecret: folder !== 'course' }));
            rmSync(join(site, folder, file));
        }
    for (const key of sources.keys()) if (!used.has(key)) throw new Error(`course/references.bib: no chapter names ${key}`);
}

/** Where links of a page of the course lead; those to sources stay words. */
const linkOf = (folder, file, fail) => (target) => {
    if (/^https:/.test(target)) return target;
    const [path, anchor = ''] = target.split('#'), end = anchor && `#${anchor}`, other = join(here, folder, path || file);
    if (!existsSync(other) || (anchor && !anchorsOf(readFileSync(other, 'utf8')).includes(anchor))) fail(`the link ${target} leads nowhere`);
    if (!path) return end;
    const source = posix.join('viewer/web', folder, path), document = documents[source];
    if (!document && source.endsWith('.md') && posix.dirname(source) !== 'viewer/web/course') return null;
    return document ? `../pages/${document}.html${end}` : path.replace(/\.md$/, '.html') + end;
};

/** Words of a text that are wired to a figure: its name, what of it, and the words. */
const wired = { show: /\{show: ([\w-]+) ([\w-]+) \| ([^}]+)\}/g, try: /\{try: ([\w-]+) ([^|}]+) \| ([^}]+)\}/g };

/** Ends the build if words name a figure, a part of it, a handle or a control that is not there. */
function checkWords(text, figures, stateOf, fail) {
    for (const [, figure, mark] of text.matchAll(wired.show)) if (!figures[figure]?.marks?.[mark]) fail(`no part ${mark} of figure ${figure}`);
    for (const [, figure, state] of text.matchAll(wired.try)) {
        const names = [...(figures[figure]?.handles ?? []), ...(figures[figure]?.controls ?? [])].map(({ name }) => name);
        for (const [name, value] of Object.entries(stateOf(state))) if (!names.includes(name) || value === undefined) fail(`figure ${figure} has no ${name}, or no value`);
    }
}

/** Places of a page for its module, and lists that the build makes. */
const fillPlaces = (html, text, chapters) => html
    .replace(/<p>\{figure: ([\w-]+)\}<\/p>/g, '<figure data-figure="$1"></figure>')
    .replace(/<p>\{exercise: ([\w-]+)\}<\/p>/g, '<div data-exercise="$1"></div>')
    .replace('<p>{puzzle}</p>', '<div id="puzzle" data-puzzle></div>')
    .replace('<h2 id="exercises">', (heading) => (text.includes('{puzzle}') ? `<p>Now try the <a href="#puzzle">puzzle</a> again.</p>\n${heading}` : heading))
    .replace(wired.show, '<button type="button" class="show" aria-pressed="false" data-of="$1" data-mark="$2">$3</button>')
    .replace(wired.try, '<button type="button" class="try" data-of="$1" data-state="$2">$3</button>')
    .replace(/<p>\{picture: ([\w-]+)\}<\/p>/g, '<figure data-picture="$1"></figure>')
    .replace(/<h3 [^]*?<\/figure>\n<p>[^]*?<\/p>/g, (entry) => (entry.includes('data-picture') ? `<div class="term">${entry}</div>` : entry))
    .replace('<p>{terms}</p>', () => listTerms(text))
    .replace('<p>{questions}</p>', () => `<ul data-questions>\n${chapters.filter(({ name }) => existsSync(join(here, `course/questions/${name}.js`)))
        .map(({ title, name }) => `<li><a href="../course/questions.html?chapter=${name}">${title}</a></li>`).join('\n')}\n</ul>`)
    .replace('<p>{solutions}</p>', () => chapters.map(({ title, name }) =>
        `<h2 id="${name}">${title}</h2>\n<section data-solutions="${name}" aria-labelledby="${name}"></section>`).join('\n'));

/** Links to the chapters before and after one, for its end. */
function neighbours(chapters, name) {
    const at = chapters.findIndex((chapter) => chapter.name === name);
    if (at < 0) return '';
    const link = (chapter, rel, mark) => (chapter ? `<a rel="${rel}" href="${chapter.name}.html">${mark} ${chapter.title}</a>` : '');
    const questions = existsSync(join(here, `course/questions/${name}.js`)) ? `<a href="questions.html?chapter=${name}">Ten questions</a>` : '';
    const links = [link(chapters[at - 1], 'prev', 'Back:'), '<a href="index.html">All chapters</a>', questions, '<a href="answers.html">My answers</a>', link(chapters[at + 1], 'next', 'Next:')];
    return `\n<nav class="chapters" aria-label="Chapters">\n${links.filter(Boolean).join('\n')}\n</nav>`;
}

const has = (name) => process.argv.includes(name), valueOf = (name) => process.argv[process.argv.indexOf(name) + 1];
const [site, library] = [valueOf('--out'), valueOf('--package')];
if (process.argv.length !== 6 + (has('--glpk') ? 2 : 0) + (has('--teachers') ? 1 : 0) || !has('--out') || !has('--package')) {
    console.error('usage: node build.mjs --package PACKAGE --out SITE [--glpk FOLDER] [--teachers]');
    process.exit(2);
}
if (!existsSync(join(library, 'sightline.js'))) {
    console.error(`build.mjs: there is no built package in ${library}`);
    process.exit(2);
}
for (const part of [...parts, ...Object.keys(languages), 'language', 'package', 'maps', 'pages', 'glpk', 'teachers']) rmSync(join(site, part), { recursive: true, force: true });
mkdirSync(site, { recursive: true });
for (const part of [...parts, ...(has('--teachers') ? ['teachers'] : [])])
    if (existsSync(join(here, part))) cpSync(join(here, part), join(site, part), { recursive: true });
cpSync(library, join(site, 'package'), { recursive: true });
writeGallery(site);
writePages(site);
await writeCourse(site, ['course', ...(has('--teachers') ? ['teachers'] : [])]);
if (has('--glpk')) for (const folder of [join(here, 'glpk'), valueOf('--glpk')]) cpSync(folder, join(site, 'glpk'), { recursive: true });
for (const path of ['index.html', 'glpk/index.html'].map((name) => join(site, name)))
    if (existsSync(path)) writeFileSync(path, readFileSync(path, 'utf8').replace('{policy}', policy));
writeLanguages(site);
