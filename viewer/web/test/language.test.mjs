/** Pages in other languages: nothing is missing, links lead on, figures and exercises speak the language. SITE, TOOLS and BROWSERS as in playground.test.mjs. */
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { languages, pages, translatePage } from '../language/pages.mjs';
import { readPo, writePo } from '../language/po.mjs';
import { launch, programOf, serve } from './site.mjs';

const { SITE } = process.env, web = dirname(dirname(fileURLToPath(import.meta.url))), wanted = (process.env.BROWSERS ?? 'chromium,firefox').split(',').filter(programOf);
const check = (...given) => new Promise((resolve) => execFile(process.execPath, [join(web, 'language/check.mjs'), ...given], (error, out, words) => resolve({ status: error?.code ?? 0, out, words })));

test('no language lacks a text, or has one in vain', async () => {
    const { status, words } = await check(SITE);
    assert.deepEqual([status, words], [0, '']);
    for (const [given, about] of [[[], /usage/], [[SITE, '--missing'], /usage/], [[SITE, '--missing', 'xx'], /no language xx/], [['nowhere'], /usage/]]) {
        const wrong = await check(...given);
        assert.equal(wrong.status, 2);
        assert.match(wrong.words, about);
    }
});

test('a translation keeps links, marks and values of its text', () => {
    for (const code of Object.keys(languages))
        for (const [text, words] of readPo(join(web, `language/${code}.po`))) {
            const marks = (s) => [...s.matchAll(/<[^>]*>|\{\d+\}| $/g)].map(([mark]) => mark).sort();
            assert.deepEqual(marks(words), marks(text), text);
            assert.ok(!text.startsWith(' ') || words.startsWith(' '), text);
        }
});

test('a page is translated by paragraphs, and code, sources and numbers are left alone', () => {
    const asked = [], html = '<html><title>Eyes - Sightline</title><h1 id="a">Eyes</h1>\n<p>One <a href="x.html">eye</a>\nsees <code>x</code>.</p><p><code>sees</code></p><pre><code>one eye</code></pre>' +
        '<table><td>12</td><td>a wall</td></table><nav aria-label="Pages"><a href="a.html">Course</a> <a rel="next" href="b.html">Next: 2. Rooms</a></nav><label><input type="checkbox"> cells</label>' +
        '<h2 id="references">References</h2>\n<ul><li>Somebody: A paper.</li></ul></html>';
    const said = translatePage(html, (text) => asked.push(text) && text.toUpperCase());
    assert.deepEqual(asked.sort(), ['2. Rooms', 'Course', 'Eyes', 'Eyes', 'Next:', 'One <a href="x.html">eye</a> sees <code>x</code>.', 'Pages', 'References', 'a wall', 'cells'].sort());
    assert.ok(said.includes('<title>EYES - Sightline</title>') && said.includes('aria-label="PAGES"') && said.includes('<input type="checkbox"> CELLS') && said.includes('<li>Somebody: A paper.</li>'), said);
    assert.ok(said.includes('>NEXT: 2. ROOMS</a>') && said.includes('<pre><code>one eye</code></pre>'), said);
});

test('a file of translations is read back, and a fault has its line', () => {
    const folder = mkdtempSync(join(tmpdir(), 'po-test-')), path = join(folder, 'x.po'), entries = [['a "b"', 'c\\d'], ['é\n{0}', '']];
    try {
        writeFileSync(path, `# a comment\n${writePo(entries)}`);
        assert.deepEqual([...readPo(path)], entries);
        writeFileSync(path, 'msgid ""\n"one "\n"two"\nmsgstr "drei"\n');
        assert.deepEqual([...readPo(path)], [['one two', 'drei']]);
        for (const [text, about] of [['msgid "a"\nmsgstr "b"\nmsgid "a"\nmsgstr "c"\n', /stands twice/], ['msgid "a"\nwords\n', /x\.po:2: what is words/], ['msgid "a"\nmsgid "b"\n', /x\.po:2: a msgid without msgstr/], ['msgid "a\n', /x\.po:1/]]) {
            writeFileSync(path, text);
            assert.throws(() => readPo(path), about);
        }
    } finally {
        rmSync(folder, { recursive: true });
    }
});

test('links of pages in other languages lead on, and each page leads to its other languages', () => {
    for (const code of Object.keys(languages))
        for (const path of pages) {
            const here = join(SITE, code, path), html = readFileSync(here, 'utf8');
            assert.match(html, new RegExp(`<html lang="${code}">`));
            for (const [, target] of html.matchAll(/(?:href|src)="([^"#?]+)/g)) if (!/^[a-z]+:/.test(target)) assert.ok(existsSync(join(dirname(here), target)), `${code}/${path}: ${target}`);
            for (const [from, to, file] of [['en', code, join(SITE, path)], [code, 'en', here]]) {
                const link = new RegExp(`<a href="([^"]*)" lang="${to}"`).exec(readFileSync(file, 'utf8'))?.[1];
                assert.equal(join(dirname(file), link), from === 'en' ? here : join(SITE, path));
            }
        }
});

for (const name of wanted)
    describe(`languages, ${name}`, () => {
        let browser, site;
        before(async () => {
            browser = await launch(name);
            site = await serve(SITE);
        });
        after(async () => {
            await browser?.close();
            site.close();
        });

        async function open(path) {
            const page = await browser.newPage({ locale: 'de-DE' }), errors = [];
            page.on('pageerror', (error) => errors.push(error.message));
            page.on('response', (response) => response.status() >= 400 && errors.push(response.url()));
            await page.goto(site.address + path);
            if (path.includes('course')) await page.waitForSelector('main[data-ready]', { timeout: 30000 });
            return { page, errors };
        }

        test('a chapter in German: text, figures, exercises and answers', async () => {
            const { page, errors } = await open('/de/course/lines.html');
            assert.equal(await page.locator('h1').textContent(), '3. Von Zelle zu Zelle');
            assert.match(await page.locator('main > figure .says').first().textContent(), /^Die Linie hat Steigung -?[\d.]+\. Auf der falschen Seite: L1, R3\.$/);
            assert.match(await page.locator('main > figure figcaption').first().textContent(), /^Eine Linie von Hand\. .* Pfeile bewegen/);
            const form = page.locator('form[data-exercise=count]');
            await form.locator('button').click();
            assert.equal(await form.locator('.answer').textContent(), 'Schreiben Sie zuerst eine Zahl.');
            await form.locator('input').fill('14');
            await form.locator('button').click();
            assert.match(await form.locator('.answer').textContent(), /^Richtig\. Jedes Portal hat zwei Enden/);
            assert.equal(await page.locator('#lecture').textContent(), 'Vortrag');
            await page.click('text=Meine Antworten');
            await page.waitForSelector('main[data-ready]');
            assert.equal(await page.locator('.says').textContent(), '1 Antwort, davon 1 richtig.');
            assert.match(await page.locator('article').textContent(), /Eine Folge hat 7 Portale.*Antwort: 14.*Richtig, nach 1 Versuch/s);
            await page.click('text=English');
            await page.locator('.says').getByText('1 answer, 1 of them right.').waitFor();
            assert.deepEqual(errors, []);
            await page.close();
        });

        test('the glossary and the playground in German', async () => {
            const { page, errors } = await open('/de/course/glossary.html'), labels = await page.locator('figure[data-picture] svg').evaluateAll((list) => list.map((node) => node.getAttribute('aria-label')));
            assert.ok(labels.length >= 40 && labels.includes('Punkte in einem Gummiband.') && !labels.some((label) => /\bthe\b/.test(label)));
            await page.click('text=Spielwiese');
            await page.waitForFunction(() => window.playground?.plan);
            assert.equal(await page.locator('#tools span').first().textContent(), 'Sehen');
            assert.equal(await page.locator('#facts dt').first().textContent(), 'Wandstücke');
            assert.match(await page.locator('#where').textContent(), /^Auge bei /);
            assert.deepEqual(errors, []);
            await page.close();
        });
    });
