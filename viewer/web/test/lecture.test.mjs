/**
 * The slides of a lecture: plans, keys, addresses, predictions, the lecturer's window, and PDF. SITE, TOOLS, SHOTS and BROWSERS as in
 * playground.test.mjs.
 */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { plans, slidesOf } from '../course/plans.js';
import { paceOf } from '../course/presenter.js';
import { writeSlides } from '../slides.mjs';
import { launch, programOf, serve } from './site.mjs';

const { SITE, SHOTS, TOOLS, QUICK } = process.env, wanted = (process.env.BROWSERS ?? 'chromium,firefox').split(',').filter(programOf);
const kinds = ['title', 'puzzle', 'key-statement', 'formula', 'figure', 'prediction', 'summary'];
const all = [...readFileSync(join(SITE, 'course/lecture.html'), 'utf8').matchAll(/<section class="slide" id="([\w-]+)" data-chapter="(\w+)" data-kind="([\w-]+)">([^]*?)<\/section>/g)]
    .map(([, id, chapter, kind, body]) => ({ id, chapter, kind, body }));

test('each chapter of a plan has all kinds of slides, with notes, and the minutes are those of the plan', () => {
    for (const [plan, lectures] of Object.entries(plans)) {
        const slides = slidesOf(plan, all), each = plan === '45' ? kinds.filter((kind) => kind !== 'formula') : kinds;
        assert.deepEqual(slides.map(({ id }) => id), lectures.flatMap((chapters) => Object.keys(chapters).flatMap((chapter) => each.map((kind) => `${chapter}-${kind}`))));
        for (const [i, chapters] of lectures.entries()) {
            const minutes = Object.values(chapters).reduce((sum, n) => sum + n), own = slides.filter(({ lecture }) => lecture === i + 1);
            assert.equal(minutes, plan === '45' ? 45 : 90);
            assert.ok(own[0].begin === 0 && Math.abs(own.at(-1).end - minutes) < 1e-9);
            own.slice(1).forEach((slide, k) => assert.ok(slide.begin === own[k].end && slide.end > slide.begin));
        }
    }
    for (const { id, kind, body } of all) {
        assert.match(body, /<aside class="notes"><p>\S[^]{10,}<\/p><\/aside>/, id);
        assert.equal(/data-show/.test(body), ['figure', 'prediction'].includes(kind), id);
        assert.equal(/answer-slide/.test(body), kind === 'prediction', id);
    }
});

test('the table of the lecture in TEACHING.md is the deck', () => {
    const rows = [...readFileSync(new URL('../../TEACHING.md', import.meta.url), 'utf8').matchAll(/^\| (\d+) \| [^|]+ \| \[\d+\]\(web\/course\/(\w+)\.md\) \| \*([^|]+)\* \| \*([^|]+)\* \|/gm)];
    assert.deepEqual(rows.map(([, minutes, chapter]) => [chapter, Number(minutes)]), Object.entries(plans[90][0]));
    return Promise.all(rows.map(async ([, , chapter, ...titles]) => {
        const { figures } = await import(pathToFileURL(join(SITE, `course/${chapter}.js`)).href);
        const shown = ['figure', 'prediction'].map((kind) => new RegExp(`data-show="${chapter}/(\\w+)"`).exec(all.find(({ id }) => id === `${chapter}-${kind}`).body)[1]);
        assert.deepEqual(titles, shown.map((name) => figures[name].title.replace(/\.$/, '')));
    }));
});

test('a clock says how far a lecture is from its plan', () => {
    const slide = { begin: 10, end: 12 };
    assert.deepEqual([9 * 60 - 1, 10 * 60, 12 * 60 + 59, 14 * 60].map((seconds) => paceOf(seconds, slide)), ['1 min ahead', 'on time', 'on time', '2 min behind']);
});

test('a slide whose chapter, figure or dot is not there ends the build', async () => {
    const figure = { title: 'A figure.', handles: [{ name: 'eye', at: [1, 2] }], controls: [{ name: 'method', kind: 'choice' }, { name: 'on', kind: 'check' }] };
    const fail = (what) => { throw new Error(what); }, chapters = [{ name: 'here', title: '1. Here', about: 'What?' }];
    const write = (show, chapter = 'here') => writeSlides(`<h2 id="x">${chapter}</h2>\n<h3 id="f">Figure</h3>\n<p>{slide: ${show}}</p>\n<p>Notes: Look.</p>`, chapters, async () => ({ figures: { figure } }), fail);
    const slides = await write('here/figure | eye=2 6.5, method=6 | on=yes');
    assert.ok(slides.includes('data-state="{&quot;eye&quot;:[2,6.5],&quot;method&quot;:&quot;6&quot;}" data-then="{&quot;on&quot;:true}"'), slides);
    assert.match(slides, /<h1>1\. Here<\/h1>\n<h2>A figure<\/h2>/);
    for (const [show, about] of [['here/other', /no figure here\/other/], ['here/figure | nose=1', /no nose/]]) await assert.rejects(write(show), about);
    await assert.rejects(write('here/figure', 'there'), /no chapter there/);
});

for (const name of wanted)
    describe(`lecture, ${name}`, () => {
        let browser, site;
        before(async () => {
            browser = await launch(name);
            site = await serve(SITE);
        });
        after(async () => {
            await browser?.close();
            site.close();
        });

        async function open(ask, context) {
            const page = await context.newPage(), errors = [];
            page.on('pageerror', (error) => errors.push(error.message));
            await page.goto(`${site.address}/course/lecture.html${ask}`);
            await page.waitForSelector('main[data-ready]', { timeout: 30000 });
            return { page, errors };
        }
        const at = (page) => page.evaluate(() => [document.querySelector('.slide.on').id, document.querySelector('.slide.on').classList.contains('answered')]);
        const says = (page) => page.locator('.slide.on .says').textContent();

        test('Next goes through all chapters of a plan, and each slide fits a projector', async () => {
            const context = await browser.newContext({ viewport: { width: 1024, height: 768 } });
            for (const plan of ['45', '90', '4x90']) {
                const { page, errors } = await open(`?plan=${plan}`, context), slides = slidesOf(plan, all);
                for (const [i, slide] of slides.entries()) {
                    if (i) await page.keyboard.press('PageDown');
                    assert.deepEqual(await at(page), [slide.id, false]);
                    if (slide.kind === 'prediction') {
                        await page.waitForSelector('.slide.on .says:not(:empty)');
                        await page.keyboard.press('PageDown');
                        assert.deepEqual(await at(page), [slide.id, true]);
                        await page.waitForSelector('.slide.on .answer-slide', { state: 'visible' });
                    }
                    const [lowest, bar] = await page.evaluate(() => [Math.max(...[...document.querySelectorAll('.slide.on, .slide.on *:not(.beside *)')].map((node) => node.getBoundingClientRect().bottom)),
                        document.querySelector('.lecture-bar').getBoundingClientRect().top]);
                    assert.ok(lowest <= bar + 1 && bar < 768, `${plan}, ${slide.id} ends at ${lowest}, the bar begins at ${bar}`);
                    if (SHOTS && plan === '4x90') await page.screenshot({ path: join(SHOTS, `slide-${slide.id}.png`) });
                }
                await page.keyboard.press('PageDown');
                assert.equal((await at(page))[0], slides.at(-1).id);
                assert.deepEqual(errors, []);
                await page.close();
            }
            await context.close();
        });

        test('the address names the slide, and Back of the browser goes to the one before', async () => {
            const context = await browser.newContext(), { page, errors } = await open('?plan=90#lines-formula', context);
            assert.deepEqual(await at(page), ['lines-formula', false]);
            await page.click('button:text-is("Next")');
            await page.click('button:text-is("Next")');
            assert.match(page.url(), /\?plan=90#lines-prediction$/);
            await page.reload();
            await page.waitForSelector('main[data-ready]');
            assert.deepEqual(await at(page), ['lines-prediction', false]);
            await page.goBack();
            await page.waitForSelector('#lines-figure.on');
            await page.click('button:text-is("Back")');
            assert.deepEqual(await at(page), ['lines-formula', false]);
            assert.deepEqual(errors, []);
            await page.goto(`${site.address}/course/lecture.html?plan=60`);
            await page.waitForSelector('main[data-ready]');
            assert.match(await page.locator('[role=alert]').textContent(), /no plan 60/);
            assert.equal(await page.locator('section.slide').count(), 0);
            assert.deepEqual(await page.locator('main a').evaluateAll((list) => list.map((link) => link.getAttribute('href'))), Object.keys(plans).map((plan) => `?plan=${plan}`));
            await page.click('main a[href="?plan=45"]');
            await page.waitForSelector('#here-title.on');
            await context.close();
        });

        test('a prediction changes its figure when the class has answered, and back again', async () => {
            const context = await browser.newContext(), { page } = await open('?plan=90#lines-prediction', context), before = await says(page);
            assert.match(before, /A line of sight passes/);
            await page.keyboard.press('PageDown');
            await page.locator('.slide.on .says').getByText('No line passes').waitFor();
            await page.keyboard.press('PageUp');
            await page.locator('.slide.on .says').getByText(before).waitFor();
            assert.deepEqual(await at(page), ['lines-prediction', false]);
            await context.close();
        });

        test('a prediction does not show its answer, and what it names is in the picture', async () => {
            const context = await browser.newContext({ viewport: { width: 1280, height: 720 } }), { page } = await open('?plan=90#cost-prediction', context);
            await page.locator('.slide.on .says').getByText('sweep: 37 found, 0 missed').waitFor({ timeout: 60000 });
            await page.keyboard.press('PageDown');
            await page.locator('.slide.on .says').getByText(/10 lines: \d+ found, [1-9]\d* missed/).waitFor({ timeout: 60000 });
            await page.close();
            const { page: other } = await open('?plan=90#here-prediction', context), area = async () => Number(/sees ([\d.]+) m²/.exec(await says(other))[1]), corridor = await area();
            await other.keyboard.press('PageDown');
            assert.ok((await area()) > corridor, 'the answer says that the eye sees more');
            await other.close();
            const { page: lines } = await open('?plan=90#lines-figure', context), beside = lines.locator('.slide.on .beside');
            const crossing = () => beside.locator('line').evaluateAll((list) => list.filter((line) => [1, 2].map((k) => Number(line.getAttribute(`y${k}`))).some((y) => y > 0 && y < 216)).length);
            assert.equal(await crossing(), 6, 'each end is a line in the picture');
            await lines.goto(`${site.address}/course/lecture.html?plan=90#lines-prediction`);
            await lines.keyboard.press('PageDown');
            await lines.locator('.slide.on .says').getByText('No line passes').waitFor();
            assert.ok(await beside.evaluate((node) => node.scrollHeight <= node.clientHeight), 'the dual plane has a scroll bar');
            await context.close();
        });

        test('arrows within a figure leave its slide alone; they go on from a button', async () => {
            const context = await browser.newContext(), { page } = await open('?plan=90#search-figure', context);
            await page.locator('.slide.on pre').focus();
            await page.keyboard.press('ArrowRight');
            assert.equal((await at(page))[0], 'search-figure');
            await page.click('button:text-is("Next")');
            await page.keyboard.press('ArrowLeft');
            assert.equal((await at(page))[0], 'search-figure');
            await context.close();
        });

        test('axe-core finds nothing, light and dark, on a projector and on a phone', { skip: Boolean(QUICK) }, async () => {
            const axe = readFileSync(join(TOOLS, 'node_modules/axe-core/axe.min.js'), 'utf8');
            for (const [colorScheme, width, height] of [['light', 1280, 800], ['dark', 390, 844]])
                for (const ask of ['#lines-title', '#lines-formula', '#cost-figure', '#lines-prediction', '&view=presenter#lines-prediction']) {
                    const context = await browser.newContext({ viewport: { width, height }, colorScheme, bypassCSP: true }), { page } = await open(`?plan=90${ask}`, context);
                    if (ask.includes('prediction')) await page.keyboard.press('PageDown');
                    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${ask} at ${width} px`);
                    await page.evaluate(axe);
                    const { violations } = await page.evaluate(() => window.axe.run());
                    assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(' ')}`), [], `${ask} ${colorScheme}`);
                    if (SHOTS) await page.screenshot({ path: join(SHOTS, `lecture-${width}-${ask.replace(/\W/g, '')}.png`) });
                    await context.close();
                }
        });

        test('the lecturer has notes and a clock, and both windows show the same', async () => {
            const context = await browser.newContext(), { page: wall } = await open('?plan=90#here-key-statement', context);
            assert.equal(await wall.locator('.notes:visible, .presenter-panel').count(), 0);
            const { page: desk } = await open('?plan=90&view=presenter', context);
            await desk.waitForSelector('#here-key-statement.on');
            assert.match(await desk.locator('.notes-now').textContent(), /star-shaped/);
            assert.match(await desk.locator('.coming').textContent(), /^Next: Formula$/);
            await desk.click('button:text-is("Next")');
            await wall.waitForSelector('#here-formula.on');
            assert.match(wall.url(), /#here-formula$/);
            assert.match(await desk.locator('.clock').textContent(), /^0:0\d · this slide ends at 4:48 · \d min ahead$/);
            await wall.keyboard.press('PageDown');
            await desk.waitForSelector('#here-figure.on .says:not(:empty)');
            await wall.waitForSelector('#here-figure.on .says:not(:empty)');
            const before = await says(wall), box = await desk.locator('.slide.on canvas').boundingBox();
            await desk.mouse.click(box.x + 0.55 * box.width, box.y + 0.45 * box.height);
            await wall.waitForFunction((text) => document.querySelector('.slide.on .says').textContent !== text, before);
            assert.equal(await says(wall), await says(desk));
            const list = desk.locator('.slide.on input[type=range]');
            await list.press('ArrowLeft');
            await wall.locator('.slide.on .says').getByText('Field of view 330°').waitFor();
            assert.equal(await wall.locator('.slide.on input[type=range]').inputValue(), '330');
            await context.close();
        });
    });
