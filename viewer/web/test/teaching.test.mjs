/**
 * What teachers take from the course: solutions, and handouts as PDF. SITE, TOOLS, SHOTS and QUICK as in
 * playground.test.mjs; without Chromium there is nothing to test.
 */
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { inflateSync } from 'node:zlib';
import { plans } from '../course/plans.js';
import { launch, programOf, serve } from './site.mjs';

const { SITE, SHOTS, TOOLS, QUICK } = process.env, hasChromium = Boolean(programOf('chromium'));
const web = dirname(dirname(fileURLToPath(import.meta.url)));

const run = (...given) => new Promise((resolve) => execFile(process.execPath, [join(web, 'handouts.mjs'), ...given],
    (error, out, words) => resolve({ status: error?.code ?? 0, out, words })));

/** What is in a PDF of Chromium: pages and their sizes, pictures of pixels, and lines that are drawn. */
function readPdf(path) {
    const text = readFileSync(path, 'latin1');
    const sizes = [...text.matchAll(/\/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]/g)].map(([, w, h]) => [Number(w), Number(h)]);
    const streams = [...text.matchAll(/\/Filter \/FlateDecode[^>]*>>\s*stream\r?\n([\s\S]*?)\r?\nendstream/g)]
        .map(([, bytes]) => inflateSync(Buffer.from(bytes, 'latin1')).toString('latin1'));
    const strokes = streams.reduce((sum, stream) => sum + (stream.match(/^(S|s|f|f\*)$/gm)?.length ?? 0), 0);
    const images = [...text.matchAll(/\/Subtype \/Image/g)].length;
    const isWhole = text.startsWith('%PDF') && text.trimEnd().endsWith('%%EOF'), pages = [...text.matchAll(/\/Type \/Page\b/g)].length;
    return { isWhole, pages, sizes, images, strokes };
}

test('tools/web.sh says how it is used', async () => {
    const script = join(web, '../../tools/web.sh');
    const ask = (option) => new Promise((resolve) => execFile('sh', [script, option], (error, out, words) => resolve([error?.code ?? 0, out, words])));
    const [help, unknown] = await Promise.all([ask('--help'), ask('--nonsense')]);
    assert.equal(help[0], 0);
    assert.match(help[1], /usage: .*--handouts DIR/);
    assert.equal(unknown[0], 2);
    assert.match(unknown[2], /--nonsense; usage/);
});

describe('handouts', { skip: hasChromium ? false : 'Chromium is missing' }, () => {
    let folder;
    before(() => (folder = mkdtempSync(join(tmpdir(), 'handouts-test-'))));
    after(() => rmSync(folder, { recursive: true }));

    test('a chapter is a PDF of either size, and its figures are vectors', async () => {
        const { status, words } = await run('--site', SITE, '--out', folder, '--only', 'lines');
        assert.equal(status, 0, words);
        assert.deepEqual(readdirSync(join(folder, 'students')).sort(), ['03-lines-a4.pdf', '03-lines-letter.pdf']);
        for (const [size, width, height] of [['a4', 595, 842], ['letter', 612, 792]]) {
            const pdf = readPdf(join(folder, `students/03-lines-${size}.pdf`));
            assert.ok(pdf.isWhole && pdf.pages >= 3 && pdf.pages <= 6, `${size}: ${pdf.pages} pages`);
            assert.equal(pdf.sizes.length, pdf.pages);
            for (const [w, h] of pdf.sizes) assert.ok(Math.abs(w - width) < 1.5 && Math.abs(h - height) < 1.5, `${w} x ${h}`);
            assert.equal(pdf.images, 0, 'a figure is a picture of pixels');
            assert.ok(pdf.strokes > 80, `only ${pdf.strokes} lines and areas`);
        }
    });

    test('a lecture is a PDF with a page for each slide, and its figures are vectors', async () => {
        const { status, words } = await run('--site', SITE, '--out', folder, '--only', 'lecture-45', '--paper', 'a4');
        assert.equal(status, 0, words);
        const pdf = readPdf(join(folder, 'teachers/lecture-45.pdf')), { 45: [chapters] } = plans;
        assert.deepEqual([pdf.isWhole, pdf.pages, pdf.images], [true, 6 * Object.keys(chapters).length, 0]);
        for (const [w, h] of pdf.sizes) assert.ok(Math.abs(w - 960) < 1.5 && Math.abs(h - 540) < 1.5, `${w} x ${h}`);
        assert.ok(pdf.strokes > 200, `only ${pdf.strokes} lines and areas`);
        rmSync(join(folder, 'teachers'), { recursive: true });
    });

    test('what it cannot do it says, and it writes nothing', async () => {
        for (const [given, status, about] of [
            [['--site', SITE], 2, /--out/], [['--site', SITE, '--out', folder, '--paper', 'a5'], 2, /a5/],
            [['--site', folder, '--out', folder], 2, /no built site/], [['--site', SITE, '--out', folder, '--only', 'nothing'], 2, /nothing/],
            [['--what', 'x'], 2, /--what/]]) {
            const done = await run(...given);
            assert.equal(done.status, status);
            assert.match(done.words, about);
        }
        assert.ok(!existsSync(join(folder, 'teachers')));
    });
});

describe('pages for teachers', { skip: hasChromium ? false : 'Chromium is missing' }, () => {
    let site, browser;
    before(async () => {
        site = await serve(SITE);
        browser = await launch('chromium');
    });
    after(async () => {
        await browser?.close();
        site?.close();
    });

    async function open(name, options = {}) {
        const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options }), page = await context.newPage(), errors = [];
        page.on('pageerror', (error) => errors.push(error.message));
        await page.goto(`${site.address}/${name === 'solutions' ? 'teachers' : 'course'}/${name}.html`);
        await page.waitForSelector('main[data-ready], body:not([data-chapter])', { timeout: 20000 });
        const close = async () => {
            await context.close();
            assert.deepEqual(errors, []);
        };
        return { page, close };
    }

    test('each exercise of each chapter has its solution, with a reason', async () => {
        const { page, close } = await open('solutions');
        const shown = await page.locator('section[data-solutions]').evaluateAll((sections) => sections.map((section) => [section.dataset.solutions,
            [...section.children].map((node) => [node.dataset.solution, node.querySelector('strong').textContent,
                node.querySelector('strong').parentElement.textContent.length, node.querySelectorAll('svg').length, node.querySelectorAll('li').length])]));
        const chapters = await page.evaluate(async (names) => {
            const { puzzles } = await import('../course/puzzles.js');
            return Object.fromEntries(await Promise.all(names.map(async (name) =>
                [name, Object.entries({ puzzle: puzzles[name], ...(await import(`../course/${name}.js`)).exercises }).map(([key, { kind }]) => [key, kind])])));
        }, shown.map(([name]) => name));
        const listed = [...readFileSync(join(SITE, 'course/index.html'), 'utf8').matchAll(/<td><a href="([\w-]+)\.html">/g)].map(([, name]) => name);
        assert.deepEqual(shown.map(([name]) => name), listed);
        for (const [name, solutions] of shown) {
            assert.deepEqual(solutions.map(([key]) => key), chapters[name].map(([key]) => key));
            for (const [i, [key, answer, length, pictures, remarks]] of solutions.entries()) {
                const kind = chapters[name][i][1];
                assert.doesNotMatch(answer, /undefined|NaN|no example/, `${name}, ${key}`);
                assert.ok(length > answer.length + 20, `${name}, ${key}: why?`);
                assert.deepEqual([pictures, remarks], { place: [1, 0], code: [0, 0] }[kind] ?? [0, 2], `${name}, ${key}`);
            }
        }
        assert.match(await page.locator('[data-solution=count] strong').textContent(), /^Answer: 14\.$/);
        await close();
    });

    test('the glossary has a picture and a chapter for each term, and chapters lead there', async () => {
        const { page, close } = await open('glossary');
        const terms = await page.locator('main h3').evaluateAll((list) => list.map((term) => {
            const host = term.nextElementSibling, text = host.nextElementSibling, svg = host.querySelector('svg');
            return { term: term.textContent, picture: [...(svg?.children ?? [])].filter((node) => node.tagName !== 'title').map((node) => node.outerHTML).join(''), words: svg?.getAttribute('aria-label') ?? '', text: text.textContent };
        }));
        assert.ok(terms.length >= 40);
        for (const { term, picture, words, text } of terms) {
            assert.ok(picture.length > 200 && words.length > 12, `${term}: a picture, and words for it`);
            assert.match(text, /^[A-Z][^]{30,}\(chapter\s\d+(,\schapter\s\d+)?\)\./, term);
        }
        assert.equal(new Set(terms.map(({ picture }) => picture)).size, terms.length, 'a picture stands twice');
        const unused = await page.evaluate(async () => Object.keys((await import('./glossary.js')).pictures)
            .filter((name) => !document.querySelector(`[data-picture=${name}]`)));
        assert.deepEqual(unused, []);
        const index = await page.locator('.terms a').allTextContents();
        assert.deepEqual([...index].sort(), terms.map(({ term }) => term).sort());
        const leading = readdirSync(join(SITE, 'course')).filter((file) => file.endsWith('.html') &&
            /href="glossary\.html#/.test(readFileSync(join(SITE, 'course', file), 'utf8')));
        assert.ok(leading.length >= 10, `${leading.length} chapters lead to terms`);
        await close();
    });

    test('the picture of a guarantee is what the method gives', async () => {
        const { page, close } = await open('glossary');
        const rings = await page.evaluate(() => ['exact', 'conservative', 'aggressive'].map((name) =>
            document.querySelectorAll(`[data-picture=${name}] path[stroke-width="1.5"]`).length));
        assert.deepEqual(rings, [0, 2, 2]);
        await close();
    });

    test('numbers of a list go on after commands, and lead to the answers', async () => {
        const { page, close } = await open('weeks');
        assert.deepEqual(await page.locator('ol').evaluateAll((lists) => lists.map((list) => list.start)), [1, 1, 5, 1, 1, 2, 1]);
        assert.equal(await page.locator('h2[id^=lab-]').count(), 4);
        await close();
    });

    test('no link of the course and of its documents leads nowhere', () => {
        let count = 0;
        for (const folder of ['course', 'pages'])
            for (const file of readdirSync(join(SITE, folder)).filter((name) => name.endsWith('.html'))) {
                const here = join(SITE, folder, file);
                for (const [, path, ask, anchor] of readFileSync(here, 'utf8').matchAll(/(?:href|src)="([^"#?]*)(?:\?([^"#]*))?(?:#([^"]*))?"/g)) {
                    if (/^[a-z]+:/.test(path)) continue;
                    if (ask) assert.ok(existsSync(join(SITE, `course/questions/${/^chapter=(\w+)$/.exec(ask)?.[1]}.js`)), `${folder}/${file}: ${path}?${ask}`);
                    const target = path ? join(SITE, folder, path) : here;
                    assert.ok(existsSync(target), `${folder}/${file}: ${path}`);
                    if (anchor) assert.ok(readFileSync(target, 'utf8').includes(`id="${anchor}"`), `${folder}/${file}: ${path}#${anchor}`);
                    count++;
                }
            }
        assert.ok(count > 200);
    });

    for (const name of ['glossary', 'solutions', 'weeks'])
        test(`${name}: fits a phone, and axe-core finds nothing`, { skip: ['course', 'teachers'].some((folder) => existsSync(join(SITE ?? '', `${folder}/${name}.html`))) ? false : 'not there' }, async () => {
            for (const colorScheme of ['light', 'dark']) {
                const { page, close } = await open(name, { viewport: { width: 390, height: 844 }, colorScheme, bypassCSP: true });
                assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 390));
                if (SHOTS) await page.screenshot({ path: join(SHOTS, `${name}-${colorScheme}-phone.png`), fullPage: true });
                if (!QUICK) {
                    await page.evaluate(readFileSync(join(TOOLS, 'node_modules/axe-core/axe.min.js'), 'utf8'));
                    const { violations } = await page.evaluate(() => window.axe.run());
                    assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(' ')}`), [], colorScheme);
                }
                await close();
            }
        });

    test('solutions are in a folder of their own, no page leads there, and without --teachers there are none', async () => {
        const plain = mkdtempSync(join(tmpdir(), 'site-test-')), files = (site) => readdirSync(site, { recursive: true }).map(String);
        try {
            const built = await new Promise((resolve) => execFile(process.execPath, [join(web, 'build.mjs'), '--package', join(SITE, 'package'), '--out', plain],
                (error, out, words) => resolve(error ? words : '')));
            assert.equal(built, '');
            assert.deepEqual(files(plain).filter((file) => /solution|teachers/.test(file)), []);
            assert.deepEqual(files(SITE).filter((file) => /solution/.test(file)).sort(), ['teachers/lab-solutions.js', 'teachers/solutions.html', 'teachers/solutions.js']);
            for (const file of files(SITE).filter((name) => name.endsWith('.html')))
                assert.doesNotMatch(readFileSync(join(SITE, file), 'utf8'), /href="[^"]*solutions\.html/, file);
        } finally {
            rmSync(plain, { recursive: true });
        }
    });

    test('each chapter lists its sources, with addresses that can be followed, and all are one BibTeX file', async () => {
        const { readReferences, referenceLine } = await import('../references.mjs');
        const sources = readReferences(readFileSync(join(SITE, 'course/references.bib'), 'utf8'));
        assert.ok(sources.size > 30);
        for (const [key, { doi, year }] of sources) {
            assert.match(year, /^(19|20)\d\d$/, key);
            if (doi) assert.match(doi, /^10\.\d{4,}\/\S+$/, key);
        }
        assert.equal(referenceLine(sources.get('welzl1985')), 'Emo Welzl: Constructing the visibility graph for n line segments in O(n²) time. ' +
            '*Information Processing Letters* 20(4), 167–171, 1985. [doi:10.1016/0020-0190(85)90044-4](https://doi.org/10.1016/0020-0190%2885%2990044-4)');
        for (const [, name] of readFileSync(join(SITE, 'course/index.html'), 'utf8').matchAll(/<td><a href="([\w-]+)\.html">/g)) {
            const text = readFileSync(join(SITE, `course/${name}.html`), 'utf8'), list = text.slice(text.indexOf('id="references"'));
            assert.ok((list.match(/<li>/g) ?? []).length >= 2, name);
            assert.match(list, /href="references\.bib"/, name);
        }
        for (const [broken, about] of [['@article{a,\n  title = {T}\n}', /a has no author/], ['@web{a,\n}', /unknown kind/], ['@book{a,\nx\n}', /what is "x"/]])
            assert.throws(() => readReferences(broken), about);
    });
});
