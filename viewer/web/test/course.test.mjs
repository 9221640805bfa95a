/**
 * The course in real browsers: each figure by mouse, touch and keys, each exercise with a wrong and a
 * right answer, lecture mode, and axe-core. SITE, TOOLS, BROWSERS, SHOTS and QUICK as in playground.test.mjs.
 */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch, programOf, serve } from './site.mjs';

const { SITE, SHOTS, TOOLS, QUICK } = process.env;
const wanted = (process.env.BROWSERS ?? 'chromium,firefox').split(',').filter(programOf);

/** Answers that are known beforehand: [exercise, wrong, right]; places are x, y of each handle. */
const chapters = {
    here: [['convex', 5, 0], ['mutual', 0, 1], ['guard', [[2, 10]], [[7.1, 8]]]],
    rooms: [['ell', 3, 2], ['why', 0, 1], ['most', [[2, 10]], [[10, 6.5]]]],
    lines: [['count', 7, 14], ['turn', 0, 1], ['through', [[1, 2], [17, 10]], [[1, 5.5], [17, 5.6]]]],
    program: [['unknowns', 10, 3], ['negative', 0, 1], ['widen', [[9, 5.5], [9, 3]], [[9, 8], [9, 4]]]],
    search: [['stop', 0, 1], ['row', 4, 3], ['largest', [[2, 2.5]], [[4, 10]]]],
    hidden: [['ends', 3, 4], ['proves', 0, 1], ['shut', [[9, 7], [9, 6.5]], [[9, 11.5], [9, 10]]]],
    view: [['around', 1, 0], ['away', 3, 1], ['fewer', [[12, 7.1]], [[2, 9]]]],
    regions: [['passes', 4, 8], ['reason', 0, 1], ['first', [[2, 2]], [[30, 18]]]],
    frames: [['tests', 15, 7], ['safe', 0, 1], ['costly', [[3, 11.5]], [[8, 8]]]],
    effects: [['states', 20, 1024], ['turned', 0, 1], ['corner', [[10, 9]], [[4, 9]]]],
};

let site;
before(async () => (site = await serve(SITE)));
after(() => site.close());

/** Puts the handles of a figure somewhere, by mouse. */
async function place(page, figure, places) {
    for (const [i, [x, y]] of places.entries()) {
        await figure.locator('canvas').scrollIntoViewIfNeeded();
        const [from, to] = await figure.evaluate((host, [index, at]) => {
            const { camera, spec, state, canvas } = host.figure, box = canvas.getBoundingClientRect();
            const screen = (p) => camera.toScreen(...p).map((v, k) => v + (k ? box.top : box.left));
            return [screen(state[spec.handles[index].name]), screen(at)];
        }, [i, [x, y]]);
        await page.mouse.move(...from);
        await page.mouse.down();
        await page.mouse.move(...to, { steps: 3 });
        await page.mouse.up();
    }
}

async function answer(page, form, given) {
    if (Array.isArray(given)) await place(page, form.locator('figure'), given);
    else if (await form.locator('input[type=radio]').count()) await form.locator('input[type=radio]').nth(given).check();
    else await form.locator('input[type=number]').fill(String(given));
    await form.locator('button').click();
    return [await form.getAttribute('data-result'), await form.locator('.answer').textContent()];
}

/** What a figure shows: its words and its pixels. */
const picture = (figure) => figure.evaluate((host) => host.querySelector('.says').textContent +
    host.querySelector('canvas').toDataURL() + (host.querySelector('.beside')?.innerHTML ?? ''));

for (const name of wanted)
    describe(`course, ${name}`, () => {
        let browser;
        before(async () => (browser = await launch(name)));
        after(() => browser.close());

        async function open(chapter, options = {}) {
            const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
            const page = await context.newPage(), errors = [];
            page.setDefaultTimeout(20000);
            page.on('pageerror', (error) => (SHOTS && /inline style/.test(error.message)) || errors.push(error.message));
            await page.goto(`${site.address}/course/${chapter}.html`);
            if (chapter !== 'index') await page.waitForSelector('main[data-ready]');
            const close = async () => {
                await context.close();
                assert.deepEqual(errors, []);
            };
            return { page, close };
        }

        test('the contents page leads to each chapter', async () => {
            const { page, close } = await open('index');
            const links = await page.locator('main td a').evaluateAll((list) => list.map((a) => a.getAttribute('href')));
            assert.deepEqual(links, Object.keys(chapters).map((chapter) => `${chapter}.html`));
            assert.equal((await page.goto(`${site.address}/pages/glossary.html`)).status(), 200);
            await close();
        });

        for (const [chapter, exercises] of Object.entries(chapters)) {
            test(`${chapter}: each figure answers to mouse, keys and fields, in time`, async () => {
                const { page, close } = await open(chapter);
                const figures = page.locator('main > figure');
                assert.ok((await figures.count()) >= 3);
                for (let i = 0; i < (await figures.count()); i++) {
                    const figure = figures.nth(i), handles = await figure.evaluate((host) => host.figure.spec.handles.length);
                    let last = await picture(figure);
                    const changed = async (what) => {
                        const now = await picture(figure);
                        assert.ok(now !== last, `figure ${i}: ${what} changes nothing`);
                        last = now;
                    };
                    if (handles) {
                        const [x0, y0, x1, y1] = await figure.evaluate((host) => host.figure.spec.box);
                        await place(page, figure, [[x0 + 0.31 * (x1 - x0), y0 + 0.57 * (y1 - y0)]]);
                        await changed('mouse');
                        await figure.locator('canvas').focus();
                        await page.keyboard.press('ArrowRight');
                        await page.keyboard.press('ArrowUp');
                        await changed('arrows');
                        await page.keyboard.press('n');
                        await page.keyboard.press('Shift+ArrowUp');
                        await changed('next dot and arrow');
                    }
                    for (const check of await figure.locator('input[type=checkbox]').all()) {
                        await check.click();
                        await changed('tick');
                    }
                    for (const range of await figure.locator('input[type=range]').all()) {
                        await range.focus();
                        await page.keyboard.press((await range.evaluate((r) => r.value === r.max)) ? 'ArrowLeft' : 'ArrowRight');
                        await changed('slider');
                    }
                    for (const list of await figure.locator('select').all()) {
                        await list.selectOption({ index: 1 });
                        await changed('list');
                    }
                    const frame = await figure.evaluate((host) => {
                        let least = Infinity;
                        for (let k = 0; k < 10; k++) {
                            host.figure.change();
                            least = Math.min(least, host.figure.frame);
                        }
                        return least;
                    });
                    assert.ok(frame < 16, `figure ${i} takes ${frame} ms`);
                }
                await close();
            });

            test(`${chapter}: exercises tell right from wrong, and why`, async () => {
                const { page, close } = await open(chapter);
                assert.equal(await page.locator('form.exercise').count(), exercises.length);
                for (const [exercise, wrong, right] of exercises) {
                    const form = page.locator(`form[data-exercise=${exercise}]`);
                    const [bad, because] = await answer(page, form, wrong), [good, why] = await answer(page, form, right);
                    assert.deepEqual([bad, good], ['wrong', 'right'], `${exercise}: ${because} / ${why}`);
                    assert.ok(because.length > 30 && why.length > 30 && because !== why);
                }
                await close();
            });

            test(`${chapter}: lecture mode shows one thing at a time, by keys`, async () => {
                const { page, close } = await open(chapter);
                await page.click('#lecture');
                const shown = () => page.locator('main > figure:visible, main > form:visible').count();
                const where = page.locator('.lecture-bar [role=status]');
                const slides = Number((await where.textContent()).split(' of ')[1]);
                assert.equal(await shown(), 1);
                for (let i = 2; i <= slides; i++) {
                    await page.keyboard.press('PageDown');
                    assert.equal(await where.textContent(), `${i} of ${slides}`);
                    assert.equal(await shown(), 1);
                }
                await page.keyboard.press('PageUp');
                assert.equal(await where.textContent(), `${slides - 1} of ${slides}`);
                await page.locator('.lecture-bar').getByText('Leave').click();
                assert.ok((await shown()) > 3);
                await close();
            });

            test(`${chapter}: a phone shows all, and a finger moves dots`, async () => {
                const { page, close } = await open(chapter, { viewport: { width: 390, height: 844 }, hasTouch: true });
                assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 390));
                const figure = page.locator('main > figure').first(), canvas = figure.locator('canvas');
                if (name === 'chromium' && (await figure.evaluate((host) => host.figure.spec.handles.length))) {
                    const before = await picture(figure);
                    await canvas.tap({ position: { x: 200, y: 120 } });
                    assert.ok((await picture(figure)) !== before, 'a tap changes nothing');
                }
                if (SHOTS) await page.screenshot({ path: join(SHOTS, `${name}-${chapter}-phone.png`), fullPage: true });
                await close();
            });
        }

        test('program: its simplex method agrees with the exact verdict of the library', async () => {
            const { page, close } = await open('program');
            const wrong = await page.evaluate(async () => {
                const [{ simplex, rowsOf }, { Lab }] = await Promise.all([import('./simplex.js'), import('./lab.js')]);
                const { core } = await Lab.open(), seen = new Set();
                let at = 5, wrong = 0;
                const chance = () => (at = (at * 48271) % 2147483647) / 2147483647;
                for (let k = 0; k < 400; k++) {
                    const portals = Array.from({ length: 2 + Math.floor(8 * chance()) }, (_, i) => {
                        const [y, size] = [Math.round(8 * chance()), 1 + Math.round(5 * chance())];
                        return [2 * i, y + size, 2 * i, y];
                    });
                    const steps = simplex(rowsOf(portals)), { m, comes } = steps.at(-1);
                    const verdict = m > 1e-9 ? 'stabbed' : m < -1e-9 ? 'hidden' : 'grazing';
                    seen.add(verdict);
                    const rises = steps.some((step, i) => i > 0 && step.m > steps[i - 1].m + 1e-9);
                    if (comes >= 0 || rises || verdict !== core.conflict(portals).verdict) wrong++;
                }
                return seen.size === 3 ? wrong : -1;
            });
            assert.equal(wrong, 0);
            await close();
        });

        test('hidden: a proof has four ends at most, and the line goes when the hulls meet', async () => {
            const { page, close } = await open('hidden');
            const says = await page.locator('main > figure').first().evaluate((host) => {
                const { figure } = host, places = [[9, 3], [1, 0], [12, 11]];
                return places.map(([l, r]) => {
                    Object.assign(figure.state, { l1: [9, l], r1: [9, r] });
                    figure.change();
                    return [figure.state.conflict.ends.length, figure.says.textContent];
                });
            });
            assert.deepEqual(says.map(([count]) => count), [0, 4, 4]);
            assert.match(says[0][1], /hulls are apart/);
            assert.match(says[1][1], /proof has 4 ends/);
            await close();
        });

        test('axe-core finds nothing', { skip: Boolean(QUICK) }, async () => {
            const axe = readFileSync(join(TOOLS, 'node_modules/axe-core/axe.min.js'), 'utf8');
            for (const colorScheme of ['light', 'dark'])
                for (const chapter of ['index', ...Object.keys(chapters)]) {
                    const { page, close } = await open(chapter, { colorScheme, bypassCSP: true });
                    if (SHOTS) await page.screenshot({ path: join(SHOTS, `${name}-${chapter}-${colorScheme}.png`), fullPage: true });
                    await page.evaluate(axe);
                    for (const lecture of chapter === 'index' ? [false] : [false, true]) {
                        if (lecture) await page.click('#lecture');
                        const { violations } = await page.evaluate(() => window.axe.run());
                        assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(' ')}`), [], `${chapter} ${colorScheme}`);
                    }
                    if (SHOTS) await page.screenshot({ path: join(SHOTS, `${name}-${chapter}-lecture-${colorScheme}.png`) });
                    await close();
                }
        });
    });
