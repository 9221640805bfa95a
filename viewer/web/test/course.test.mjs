/**
 * The course in real browsers: each figure by mouse, touch and keys, each exercise with a wrong and a
 * right answer, lecture mode, and axe-core. SITE, TOOLS, BROWSERS, SHOTS and QUICK as in playground.test.mjs.
 */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { solutions } from '../teachers/lab-solutions.js';
import { launch, programOf, serve } from './site.mjs';

const { SITE, SHOTS, TOOLS, QUICK } = process.env;
const wanted = (process.env.BROWSERS ?? 'chromium,firefox').split(',').filter(programOf);

/** Answers that are known beforehand: [exercise, wrong, right]; places are x, y of each handle. */
const chapters = {
    here: [['convex', 5, 0], ['mutual', 0, 1], ['guard', [[2, 10]], [[7.1, 8]]], ['region', { code: 'const region = () => [[0, 0], [20, 0], [20, 12], [0, 12]];' }, solutions.region]],
    rooms: [['ell', 3, 2], ['why', 0, 1], ['most', [[2, 10]], [[10, 6.5]]]],
    lines: [['count', 7, 14], ['turn', 0, 1], ['through', [[1, 2], [17, 10]], [[1, 5.5], [17, 5.6]]]],
    program: [['unknowns', 10, 3], ['negative', 0, 1], ['widen', [[9, 5.5], [9, 3]], [[9, 8], [9, 4]]], ['funnel', { code: 'const funnel = (portals) => portals.length;' }, solutions.funnel]],
    search: [['stop', 0, 1], ['row', 4, 3], ['largest', [[2, 2.5]], [[4, 10]]], ['visible', { code: 'const visible = (cells) => [...cells.keys()];' }, solutions.visible]],
    rounding: [['bits', 53, 106], ['epsilon', 0, 1], ['flips', [[0, 2], [20, 4]], [[0, 3.1], [20, 7.4]]]],
    hidden: [['ends', 3, 4], ['proves', 0, 1], ['shut', [[9, 7], [9, 6.5]], [[9, 11.5], [9, 10]]]],
    sweep: [['corners', 8, 4], ['event', 0, 1], ['joins', [[13, 5]], [[9, 8]]]],
    view: [['around', 1, 0], ['away', 3, 1], ['fewer', [[12, 7.1]], [[2, 9]]]],
    regions: [['passes', 4, 8], ['reason', 0, 1], ['first', [[2, 2]], [[30, 18]]]],
    frames: [['tests', 15, 7], ['safe', 0, 1], ['costly', [[3, 11.5]], [[8, 8]]]],
    effects: [['states', 20, 1024], ['turned', 0, 1], ['corner', [[10, 9]], [[4, 9]]]],
    cost: [['safe', 0, 1], ['added', 0, 16], ['misses', [[6, 6.3]], [[4, 6.3]]]],
    gallery: [['enough', 7, 6], ['colour', 1, 0], ['two', [[2, 7], [6, 1.5]], [[2, 1.5], [10, 1.5]]]],
    ways: [['around', 14, 15], ['turns', 0, 1], ['far', [[3, 1.4], [14.4, 12]], [[13.5, 1], [14.5, 1]]], ['pull', { code: 'const shortest = (from, to) => [from, to];' }, solutions.pull]],
};

let site;
before(async () => (site = await serve(SITE)));
after(() => site.close());

/** Puts the handles of a figure somewhere, by mouse. */
async function place(page, figure, places) {
    for (const [i, [x, y]] of places.entries()) {
        await figure.locator('canvas').scrollIntoViewIfNeeded();
        const [from, to] = await figure.evaluate((host, [index, at]) => {
            const { camera, spec, state, canvas, zoom } = host.figure, box = canvas.getBoundingClientRect();
            const screen = (p) => camera.toScreen(...p).map((v, k) => zoom * v + (k ? box.top : box.left));
            return [screen(state[spec.handles[index].name]), screen(at)];
        }, [i, [x, y]]);
        await page.mouse.move(...from);
        await page.mouse.down();
        await page.mouse.move(...to, { steps: 3 });
        await page.mouse.up();
    }
}

async function answer(page, form, given) {
    if (given.code) await form.locator('textarea').fill(given.code);
    else if (Array.isArray(given)) await place(page, form.locator('figure'), given);
    else if (await form.locator('input[type=radio]').count()) await form.locator(`input[type=radio][value="${given}"]`).check();
    else await form.locator('input[type=number]').fill(String(given));
    await form.locator('button[type=submit]').click();
    await form.locator('.answer:not(:empty)').waitFor({ timeout: 30000 });
    return [await form.getAttribute('data-result'), await form.locator('.answer').textContent()];
}

/** What a figure shows: its words and its pixels. */
const picture = (figure) => figure.evaluate((host) => host.querySelector('.says').textContent +
    host.querySelector('canvas').toDataURL() + (host.querySelector('.beside')?.innerHTML ?? ''));

for (const name of wanted)
    describe(`course, ${name}`, () => {
        let browser;
        const places = [0, 0, 0];
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
            test(`${chapter}: each figure answers to mouse, keys and fields`, async () => {
                const { page, close } = await open(chapter);
                const figures = page.locator('main > figure');
                assert.ok((await figures.count()) >= 2);
                const onBorders = await figures.evaluateAll((hosts) => hosts.flatMap(({ dataset, figure: { spec, state } }) => spec.handles.filter(({ name }) => {
                    const [x, y] = state[name], around = [[1, 1], [1, -1], [-1, 1], [-1, -1]].map(([dx, dy]) => state.scene?.locate?.(x + 1e-6 * dx, y + 1e-6 * dy));
                    return new Set(around).size > 1;
                }).map(() => dataset.figure)));
                assert.ok(onBorders.every((figure) => ['turn', 'table'].includes(figure)), `a dot of ${onBorders} begins on the border of two cells`);
                await page.emulateMedia({ media: 'print' });
                const isPaper = await page.evaluate(() => matchMedia('print').matches); // the driver of Firefox cannot
                assert.ok(isPaper || name === 'firefox');
                const captions = !isPaper ? [] : await page.locator('main > figure figcaption').evaluateAll((list) => list.map((node) => node.innerText));
                for (const caption of captions) assert.doesNotMatch(caption, /\b(drag|slider|press)\b/i, 'a handout says what only the page can do');
                await page.emulateMedia({ media: 'screen' });
                for (let i = 0; i < (await figures.count()); i++) {
                    const figure = figures.nth(i), handles = await figure.evaluate((host) => host.figure.spec.handles.length);
                    let last = await picture(figure);
                    const changed = async (what) => {
                        const now = await picture(figure);
                        assert.ok(now !== last, `figure ${i}: ${what} changes nothing`);
                        last = now;
                    };
                    if (handles) {
                        const [x0, y0, x1, y1] = await figure.evaluate((host) => host.figure.box);
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
                }
                await close();
            });

            test(`${chapter}: exercises tell right from wrong, and why`, async () => {
                const { page, close } = await open(chapter);
                assert.equal(await page.locator('form.exercise:not(.puzzle)').count(), exercises.length);
                for (const [exercise, wrong, right] of exercises) {
                    const form = page.locator(`form[data-exercise=${exercise}]`);
                    const [bad, because] = await answer(page, form, wrong), [good, why] = await answer(page, form, right);
                    assert.deepEqual([bad, good], ['wrong', 'right'], `${exercise}: ${because} / ${why}`);
                    const radios = await form.locator('input[type=radio]').evaluateAll((list) => list.map(({ checked }) => checked));
                    if (radios.length) places[radios.indexOf(true)]++;
                    assert.ok(because.length > 30 && why.length > 30 && because !== why);
                }
                await close();
            });

            test(`${chapter}: lecture mode shows one thing at a time, by keys, on a projector`, async () => {
                const { page, close } = await open(chapter, { viewport: { width: 1024, height: 768 } });
                await page.click('#lecture');
                const shown = () => page.locator('main > figure:visible, main > form:visible').count();
                const where = page.locator('.lecture-bar [role=status]');
                const slides = Number((await where.textContent()).split(' of ')[1]);
                for (let i = 1; i <= slides; i++) {
                    if (i > 1) await page.keyboard.press('PageDown');
                    assert.equal(await where.textContent(), `${i} of ${slides}`);
                    assert.equal(await shown(), 1);
                    const form = page.locator('main > form.on:not(.puzzle)');
                    if (await form.count()) await answer(page, form, exercises[i - 1 - (slides - exercises.length)][1]);
                    const { bar, lowest, zoom } = await page.evaluate(() => {
                        const pixels = (v) => Number(v.toFixed(3)); // Firefox adds up sixtieths, which doubles round
                        const bottom = (node) => pixels(node.getBoundingClientRect().bottom);
                        return { bar: pixels(document.querySelector('.lecture-bar').getBoundingClientRect().top),
                            lowest: Math.max(...[...document.querySelectorAll('main > .on, main > .on *:not(.beside *)')].map(bottom)),
                            zoom: document.querySelector('main > figure.on')?.figure.zoom ?? 2 };
                    });
                    assert.ok(lowest <= bar && bar < 768, `slide ${i} ends at ${lowest}, the bar begins at ${bar}`);
                    assert.ok(zoom > 1.2, `slide ${i}: lines are drawn for a desk`);
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

        test('lecture mode goes from chapter to chapter, and the address names the slide', async () => {
            const { page, close } = await open('rooms'), where = page.locator('.lecture-bar [role=status]');
            const at = () => page.evaluate(() => location.pathname.split('/').at(-1) + location.hash);
            await page.evaluate(() => history.replaceState(null, '', '#kept'));
            await page.click('#lecture');
            assert.equal(await at(), 'rooms.html#slide-1');
            const next = page.locator('.lecture-bar').getByText('Next'), count = Number((await where.textContent()).split(' of ')[1]);
            for (let i = 1; i < count; i++) await next.click();
            assert.equal(await at(), `rooms.html#slide-${count}`);
            await page.goBack();
            assert.equal(await where.textContent(), `${count - 1} of ${count}`);
            await page.goForward();
            await next.click();
            await page.waitForURL(/lines\.html#slide-1$/);
            await page.locator('.lecture-bar:visible [role=status]').getByText(/^1 of/).waitFor();
            await page.keyboard.press('PageUp');
            await page.waitForURL(/rooms\.html#slide-last$/);
            await page.locator('.lecture-bar:visible [role=status]').getByText(`${count} of ${count}`).waitFor();
            await page.locator('.lecture-bar').getByText('Leave').click();
            assert.equal(await at(), 'rooms.html');
            await close();
            const last = await open('cost');
            await last.page.click('#lecture');
            await last.page.keyboard.press('PageUp');
            await last.page.waitForURL(/effects\.html#slide-last$/);
            await last.close();
            const first = await open('here');
            await first.page.click('#lecture');
            assert.ok(await first.page.locator('.lecture-bar').getByText('Back').isDisabled());
            await first.page.locator('.lecture-bar').getByText('Leave').click();
            assert.deepEqual(await first.page.locator('nav.chapters a').allTextContents(), ['All chapters', 'Ten questions', 'My answers', 'Next: 2. Rooms and doors']);
            await first.close();
        });

        test('a finger that swipes over a figure leaves its dot alone', { skip: name === 'chromium' ? false : 'Chromium alone has touch here' }, async () => {
            const { page, close } = await open('here', { viewport: { width: 390, height: 844 }, hasTouch: true });
            const figure = page.locator('main > figure').first(), canvas = figure.locator('canvas');
            await canvas.scrollIntoViewIfNeeded();
            const box = await canvas.boundingBox(), before = await figure.evaluate((host) => [...host.figure.state.eye]);
            const client = await page.context().newCDPSession(page), [x, y] = [box.x + 0.8 * box.width, box.y + 0.7 * box.height];
            const send = (type, points) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points });
            const swipe = async (dx, dy) => {
                await send('touchStart', [{ x, y }]);
                for (let i = 1; i <= 6; i++) await send('touchMove', [{ x: x + (dx * i) / 6, y: y + (dy * i) / 6 }]);
                await send('touchEnd', []);
            };
            for (const [dx, dy] of [[0, -90], [40, 0]]) {
                await swipe(dx, dy);
                assert.deepEqual(await figure.evaluate((host) => [...host.figure.state.eye]), before, `swipe by ${dx}, ${dy}`);
            }
            await close();
        });

        test('an answer that changes takes the remark about the old one away', async () => {
            const { page, close } = await open('here'), form = page.locator('form[data-exercise=convex]');
            await answer(page, form, 5);
            await form.locator('input').fill('0');
            assert.deepEqual([await form.getAttribute('data-result'), await form.locator('.answer').textContent()], ['', '']);
            const guard = page.locator('form[data-exercise=guard]');
            await answer(page, guard, [[2, 10]]);
            await place(page, guard.locator('figure'), [[7.1, 8]]);
            assert.equal(await guard.locator('.answer').textContent(), '');
            await close();
        });

        test('answers are kept in the browser, exported with a name, and read back', async () => {
            const { page, close } = await open('here'), at = (chapter) => page.goto(`${site.address}/course/${chapter}.html`).then(() => page.waitForSelector('main[data-ready]'));
            const given = { convex: 5, mutual: 1, guard: [[7.1, 8]], region: { code: '// mine\nconst region = () => [];' } };
            const shown = () => page.locator('form.exercise:not(.puzzle)').evaluateAll((forms) => forms.map((form) => [form.dataset.exercise, form.dataset.result,
                form.querySelector('.answer').textContent, form.querySelector('input:checked, input[type=number], textarea')?.value ?? form.querySelector('figure')?.figure.state.eye.map((v) => v.toFixed(3)).join()]));
            for (const [exercise, value] of Object.entries(given)) await answer(page, page.locator(`form[data-exercise=${exercise}]`), value);
            await answer(page, page.locator('form[data-exercise=convex]'), 0);
            const before = await shown();
            assert.deepEqual(before.map(([, result]) => result), ['right', 'right', 'right', 'wrong']);
            await at('here');
            assert.deepEqual(await shown(), before);
            await at('index');
            assert.match(await page.locator('main td').first().textContent(), /\(3 of 4 answers right\)/);
            await at('answers');
            await page.locator('#name').fill('Ada Lovelace');
            assert.match(await page.locator('main .says').textContent(), /^4 answers, 3 of them right/);
            const texts = await page.locator('main article').allTextContents();
            assert.match(texts[0], /How long are all occluding.*Answer: 0Right, after 2 tries/);
            assert.match(texts[1], /Answer: Yes, always\.Right, after 1 try/);
            assert.match(texts[3], /const region = \(\) => \[\];Not yet right/);
            const saved = await page.evaluate(async () => {
                const make = URL.createObjectURL;
                const blob = new Promise((resolve) => (URL.createObjectURL = (given) => (resolve(given), make.call(URL, given))));
                [...document.querySelectorAll('button')].find((node) => node.textContent === 'Export my answers').click();
                return (await blob).text();
            });
            const file = JSON.parse(saved);
            assert.deepEqual([file.name, Object.keys(file.answers)], ['Ada Lovelace', Object.keys(given).map((exercise) => `here/${exercise}`)]);
            assert.equal(file.answers['here/convex'].tries, 2);
            page.on('dialog', (dialog) => dialog.accept());
            await page.getByText('Forget my answers').click();
            assert.match(await page.locator('main .says').textContent(), /no answers yet/);
            await at('here');
            assert.deepEqual((await shown()).map(([, result, remark]) => result || remark), ['', '', '', '']);
            await at('answers');
            const read = (text) => page.locator('#answers-file').setInputFiles({ name: 'a.json', mimeType: 'application/json', buffer: Buffer.from(text) });
            for (const [text, about] of [['no', /no file of answers/], ['{}', /no file of answers/], [saved.replace('"version": 1', '"version": 2'), /version 2/],
                [saved.replace('"tries": 2', '"tries": "2"'), /here\/convex of the file is not complete/], [saved.replace('"here/convex"', '"<b>"'), /<b> of the file/]]) {
                await read(text);
                await page.locator('main .says').getByText(about).waitFor();
            }
            assert.equal(await page.locator('main article').count(), 0, 'nothing is half read');
            await read(saved);
            await page.locator('main .says').getByText('4 answers').waitFor();
            assert.equal(await page.locator('#name').inputValue(), 'Ada Lovelace');
            await at('here');
            assert.deepEqual(await shown(), before);
            await close();
        });

        test('pictures name what their words name', async () => {
            const { page, close } = await open('here');
            const letters = await page.locator('figure[data-figure=pair]').evaluate((host) => {
                dispatchEvent(new Event('beforeprint'));
                return [...host.querySelectorAll('.still text')].map((node) => node.textContent);
            });
            assert.deepEqual(letters, ['A', 'B']);
            await close();
            const frames = await open('frames');
            const axes = await frames.page.locator('main > figure .beside svg').evaluateAll((list) => list.map((chart) => [...chart.querySelectorAll('text')].map((node) => node.textContent)));
            assert.equal(axes.length, 2);
            for (const [i, words] of [['frame', 'tests', '0', '50', '150'], ['view cells', 'cells to draw, expected', '5', '10']].entries())
                for (const word of words) assert.ok(axes[i].includes(word), `${word} of ${axes[i]}`);
            await frames.close();
        });

        test('rings of a basis cover no names', async () => {
            const { page, close } = await open('program');
            const { centres, names } = await page.locator('figure[data-figure=steps]').evaluate((host) => {
                dispatchEvent(new Event('beforeprint'));
                const rings = [...host.querySelectorAll('.still path[stroke]')].flatMap((node) => [/^M([\d.]+) ([\d.]+)a13 13/.exec(node.getAttribute('d')) ?? []]);
                return { centres: rings.filter((found) => found.length).map(([, x, y]) => [Number(x) + 13, Number(y)]),
                    names: [...host.querySelectorAll('.still text')].map((node) => [Number(node.getAttribute('x')), Number(node.getAttribute('y'))]) };
            });
            assert.equal(centres.length, 3);
            assert.deepEqual(names.filter(([x, y]) => centres.some(([cx, cy]) => Math.hypot(x - cx, y - cy) < 14)), []);
            await close();
        });

        test('the right option stands at each place about as often', () => {
            assert.ok(places.every((count) => count >= 3), `first, second, third: ${places}`);
        });

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

        test('here: occluding edges lie in the open, also for an eye on the line of a wall', async () => {
            const { page, close } = await open('here');
            const found = await page.locator('figure[data-figure=eye]').evaluate(async ({ figure }) => {
                const [{ flat, itemsOf, segmentsOf }, { isOn }] = await Promise.all([import('./maps.js'), import('./angular.js')]), walls = segmentsOf(itemsOf(flat.text));
                return [[5, 5], [12, 5], [3, 5.5], [8, 8]].map((eye) => {
                    figure.set({ eye });
                    const { lines } = figure.spec.marks.occluding(figure.state), middles = lines.map(([ax, ay, bx, by]) => [(ax + bx) / 2, (ay + by) / 2]);
                    return [lines.length, middles.filter((at) => walls.some((wall) => isOn(at, wall))).length, Number(/(\d+) edges are/.exec(figure.says.textContent)[1])];
                });
            });
            for (const [lines, onWalls, said] of found) assert.ok(lines > 0 && onWalls === 0 && said === lines, `${lines} edges, ${onWalls} of them on walls, ${said} said`);
            assert.equal(await page.locator('figure[data-figure=eye]').evaluate((host) => document.getElementById(host.getAttribute('aria-labelledby')).textContent), 'The visible region.');
            await close();
        });

        test('keys say where a dot is, if nothing else changes', async () => {
            const { page, close } = await open('lines'), figure = page.locator('figure[data-figure=dual]'), says = () => figure.locator('.says').textContent();
            const before = await says();
            await figure.locator('canvas').press('ArrowRight');
            assert.equal(await says(), `${before} The dot is at 4, 7.`);
            await figure.locator('canvas').press('n');
            assert.equal(await says(), `${before} The dot is at 4, 4.`);
            await close();
        });

        test('rounding: its exact signs agree with the library, where doubles do not', async () => {
            const { page, close } = await open('rounding');
            const counts = await page.evaluate(async () => {
                const [{ tipsOf, portalsOf, verdictOf }, { arithmetics }, { Lab }] =
                    await Promise.all([import('./rounding.js'), import('./exact.js'), import('./lab.js')]);
                const { core } = await Lab.open(), wrong = Object.fromEntries(Object.keys(arithmetics).map((name) => [name, 0]));
                for (let k = 0; k < 600; k++) {
                    const tips = tipsOf(1 + 0.05 * (k % 23), 9 - 0.05 * (k % 71), 3 + (k % 5));
                    if (k % 3 === 0) tips[k % tips.length][1] *= 1e-290;
                    const { verdict } = core.conflict(portalsOf(tips));
                    for (const name of Object.keys(wrong)) if (verdictOf(tips, arithmetics[name]) !== verdict) wrong[name]++;
                }
                return wrong;
            });
            assert.equal(counts.exact, 0);
            for (const name of ['doubles', 'fused', 'epsilon']) assert.ok(counts[name] > 20, `${name}: ${counts[name]}`);
            await close();
        });

        test('rounding: a fused multiply-add rounds once', async () => {
            const { page, close } = await open('rounding');
            const values = await page.evaluate(async () => {
                const { fused, nearest, unitOf } = await import('./exact.js');
                return [fused(0.1, 10, -1), fused(0.1, 0.3, 0) - 0.1 * 0.3, fused(0, 1, 0), nearest(2n ** 54n + 2n, 0) - 2 ** 54,
                    nearest(2n ** 54n + 6n, 0) - 2 ** 54, unitOf(1), unitOf(0.75)];
            });
            assert.deepEqual(values, [2 ** -54, 0, 0, 0, 8, 2 ** -52, 2 ** -53]);
            await close();
        });

        test('here: the angular sweep has the area of the library, step by step, also where rays only touch', async () => {
            const { page, close } = await open('here');
            const { count, wrong, steps } = await page.evaluate(async () => {
                const [{ angularSweep, isOn, onGrid }, maps, { Lab, cellAt }] = await Promise.all([import('./angular.js'), import('./maps.js'), import('./lab.js')]);
                const lab = await Lab.open();
                let [number, count, wrong, steps] = [7, 0, 0, true];
                const chance = () => (number = (number * 48271) % 2147483647) / 2147483647;
                for (const { text, box } of [maps.flat, maps.house, maps.pillars, { text: maps.hall(2), box: [0, 0, 8, 12] }, { text: maps.grid(3, 3), box: [0, 0, 12, 12] }]) {
                    const walls = maps.segmentsOf(maps.itemsOf(text)), scene = lab.scene(text);
                    for (let k = 0; k < 200; k++) {
                        const place = [box[2] * chance(), box[3] * chance()], eye = k % 3 ? onGrid(place) : place.map((v) => Math.round(2 * v) / 2);
                        if (cellAt(scene, eye) < 0 || walls.some((wall) => isOn(eye, wall))) continue;
                        const sweep = angularSweep(eye, walls), area = sweep.corners.reduce((sum, [x, y], i, all) => {
                            const [u, v] = all[(i + 1) % all.length];
                            return sum + (x * v - y * u) / 2;
                        }, 0), exact = scene.isovist(...eye).area;
                        if (!(Math.abs(area - exact) <= 1e-12 * exact)) wrong++;
                        // Each wall comes and goes once, and the status is what has come and not gone, with the walls of the first ray.
                        const first = sweep.steps[1].status, now = new Set(first);
                        for (const { kind, event, status } of sweep.steps.slice(1)) {
                            const { wall } = sweep.events[event] ?? {};
                            if (kind === 'insert') now.add(wall.number);
                            if (kind === 'remove') now.delete(wall.number);
                            steps &&= String([...status].sort()) === String([...now].sort());
                        }
                        steps &&= String([...now].sort()) === String([...first].sort());
                        count++;
                    }
                }
                return { count, wrong, steps };
            });
            assert.ok(count > 700);
            assert.deepEqual([wrong, steps], [0, true]);
            const figure = page.locator('figure[data-figure=sweep]'), lit = () => figure.locator('pre b').allTextContents();
            await figure.locator('input[type=range]').press('Home');
            assert.deepEqual(await lit(), ['sort the ends of walls by angle']);
            await figure.locator('input[type=range]').press('End');
            assert.deepEqual(await lit(), ['return the corners']);
            assert.match(await figure.locator('.says').textContent(), /^Step (\d+) of \1: .* n log n is 110 for 24 ends/);
            await close();
        });

        test('gallery: guards of Fisk\'s colouring are a third at most, and the library says that they see everything', async () => {
            const { page, close } = await open('gallery');
            const found = await page.evaluate(async () => {
                const [{ coloursOf, earsOf, guardsOf, isSimple }, { onGrid }, { Lab }] = await Promise.all([import('./fisk.js'), import('./angular.js'), import('./lab.js')]);
                const { core } = await Lab.open(), area = (p) => p.reduce((sum, [x, y], i) => sum + x * p[(i + 1) % p.length][1] - y * p[(i + 1) % p.length][0], 0) / 2;
                let [number, simple, crossing] = [3, 0, 0];
                const wrong = [], chance = () => (number = (number * 48271) % 2147483647) / 2147483647;
                const star = (count) => Array.from({ length: count }, (_, i) => {
                    const angle = (2 * Math.PI * (i + 0.8 * chance())) / count, r = 1 + 8 * chance();
                    return onGrid([10 + r * Math.cos(angle), 10 + r * Math.sin(angle)]);
                });
                const stars = Array.from({ length: 150 }, () => star(5 + Math.floor(14 * chance())));
                const flat = [[0, 0], [4, 0], [8, 0], [8, 4], [8, 8], [4, 8], [4, 4], [0, 4]], spiral = [[0, 0], [9, 0], [9, 9], [2, 9], [2, 3], [6, 3], [6, 6], [5, 6], [5, 4], [3, 4], [3, 8], [8, 8], [8, 1], [0, 1]];
                for (const points of [...stars, flat, spiral, [[0, 0], [4, 4], [4, 0], [0, 4]], [[0, 0], [4, 0], [2, 0], [2, 3]]]) {
                    if (area(points) <= 0 || !isSimple(points)) {
                        crossing++;
                        continue;
                    }
                    simple++;
                    const ears = earsOf(points), colours = coloursOf(ears, points.length), guards = guardsOf(colours);
                    const sum = ears.reduce((all, ear) => all + area(ear.map((i) => points[i])), 0), scene = core.open(`sightline 1\nwalls ${[...points, points[0]].flat().join(' ')}\n`);
                    // In each triangle a guard stands, and sees it: from a place beside the corner, to places beside the others and in the middle.
                    const isSeen = ears.every((ear) => {
                        const corners = ear.map((i) => points[i]), middle = [0, 1].map((k) => corners.reduce((all, p) => all + p[k], 0) / 3);
                        const places = corners.map((p) => ({ x: p[0] + 0.01 * (middle[0] - p[0]), y: p[1] + 0.01 * (middle[1] - p[1]) }));
                        const guard = ear.findIndex((i) => guards.includes(i)), isFlat = area(corners) === 0;
                        return guard >= 0 && (isFlat || [...places, { x: middle[0], y: middle[1] }].every((place) => scene.canSee(places[guard], place)));
                    });
                    scene.close();
                    const isFine = ears.length === points.length - 2 && ears.every((ear) => ear.map((i) => colours[i]).sort().join() === '0,1,2') &&
                        Math.abs(sum - area(points)) < 1e-9 && guards.length <= points.length / 3 && isSeen;
                    if (!isFine) wrong.push([points, guards, isSeen]);
                }
                return { simple, crossing, wrong };
            });
            assert.ok(found.simple > 100 && found.crossing >= 2, `${found.simple} polygons`);
            assert.deepEqual(found.wrong, []);
            const figure = page.locator('figure[data-figure=bounds]'), list = figure.locator('select');
            for (const [plan, guards] of [['house', 6], ['comb', 4], ['pillars', 2]]) {
                await list.selectOption(plan);
                await figure.locator('.says').getByText(`${guards} guards, and no fewer can do it.`).waitFor();
                assert.deepEqual((await figure.locator('tbody tr').last().locator('td').allTextContents()).slice(1), [String(guards), String(guards)]);
                // Each witness is seen by a guard.
                assert.ok(await figure.evaluate(async (host) => {
                    const { viewpoints, witnesses } = host.figure.state.job.placement, scene = host.figure.lab.scene(host.figure.state.text);
                    return witnesses.length > 0 && witnesses.every((witness) => viewpoints.some((guard) => scene.canSee(guard, witness)));
                }), plan);
            }
            await close();
        });

        test('sweep: the rotating line finds the pairs of the library', async () => {
            const { page, close } = await open('sweep');
            const found = await page.evaluate(async () => {
                const [{ comparePairs }, maps, { Lab }] = await Promise.all([import('./sweep.js'), import('./maps.js'), import('./lab.js')]);
                const lab = await Lab.open();
                return [maps.flat.text, maps.house.text, maps.pillars.text, maps.hall(2), maps.grid(4, 3)].map((text) => comparePairs(lab, text));
            });
            assert.deepEqual(found.map(({ wrong }) => wrong), [0, 0, 0, 0, 0]);
            assert.deepEqual(found.map(({ pairs }) => pairs), [30, 62, 64, 290, 65]);
            assert.ok(found.some(({ late }) => late > 0), 'the second step is not needed');
            await close();
        });

        test('sweep: halls that cannot be computed say so', async () => {
            const context = await browser.newContext(), page = await context.newPage();
            await page.route('**/halls-worker.js', (route) => route.abort());
            await page.goto(`${site.address}/course/sweep.html`);
            await page.locator('figure[data-figure=growth] .says').getByText(/^The halls cannot be computed here: .+\.$/).waitFor();
            await context.close();
        });

        test('sweep: the classes of lines are the faces of an arrangement, and touching doubles them in a row', async () => {
            const { page, close } = await open('sweep');
            const found = await page.evaluate(async () => {
                const [{ classesOf, posts }, { Lab }] = await Promise.all([import('./classes.js'), import('./lab.js')]);
                const { core } = await Lab.open(), count = (list, mayTouch) => classesOf(core, list, mayTouch).map((level) => level.length);
                return { posts, apart: count(posts.apart, false), apartTouching: count(posts.apart, true), row: count(posts.row, false), rowTouching: count(posts.row, true) };
            });
            // Euler: lines that cross a square make 1 + k + c faces of it, if they cross in c places, each in a place of its own.
            const inside = (p, q) => {
                const slope = (p[1] - q[1]) / (p[0] - q[0]), at = (x) => p[1] + slope * (x - p[0]);
                return at(0) > 0 && at(0) < 12 && at(24) > 0 && at(24) < 12;
            };
            const faces = (k) => 1 + k + found.posts.apart.slice(0, k).flatMap((p, i, list) => list.slice(0, i).filter((q) => inside(p, q))).length;
            const counts = Array.from({ length: 9 }, (_, k) => k);
            assert.deepEqual(found.apart, counts.map(faces));
            assert.deepEqual(found.apartTouching, found.apart, 'no three in line: nothing only touches');
            assert.deepEqual(found.row, counts.map((k) => Math.max(1, 2 * k)));
            assert.deepEqual(found.rowTouching, counts.map((k) => 2 ** k));
            await close();
        });

        test('numbers of the text are those of the figures', async () => {
            const { page, close } = await open('sweep'), text = (await page.locator('main').textContent()).replace(/\s+/g, ' ');
            assert.doesNotMatch(text, /\{value/);
            const growth = page.locator('figure[data-figure=growth]'), range = growth.locator('input[type=range]');
            const ratios = [];
            for (const key of ['Home', 'End']) {
                await range.press(key);
                await growth.locator('.says').getByText('The sweep looks at').waitFor();
                ratios.push([...(await growth.locator('.says').textContent()).matchAll(/, ([\d.]+) for each edge/g)].map(([, ratio]) => ratio));
            }
            const [[pieces, nodes], [piecesLast, nodesLast]] = ratios;
            assert.ok(text.includes(`there are ${pieces} pieces for each edge, in the widest one ${piecesLast}.`), text.match(/there are [\d.]+ pieces[^.]*/)?.[0]);
            assert.ok(text.includes(`from ${nodes} for each edge to ${nodesLast}.`));
            await close();
            const search = await open('search'), hall = search.page.locator('figure[data-figure=growth]');
            await hall.locator('input[type=range]').press('End');
            const [, steps] = /ends after (\d+) steps/.exec(await hall.locator('.says').textContent());
            assert.match(await search.page.locator('main').textContent(), new RegExp(`cells, and the search\\s+ends\\s+after\\s+${steps}\\s+steps`));
            await search.close();
        });

        test('cost: the chart fills, and each method keeps its promise', async () => {
            const { page, close } = await open('cost'), figure = page.locator('main > figure').first();
            await figure.locator('.says').getByText('All methods have run').waitFor({ timeout: 60000 });
            const rows = await figure.locator('tbody tr').evaluateAll((list) => list.map((row) => [...row.children].map((cell) => cell.textContent)));
            assert.equal(rows.length, 9);
            const counts = new Set(rows.map(([, guarantee]) => guarantee));
            assert.deepEqual([...counts].sort(), ['aggressive', 'conservative', 'exact']);
            for (const [method, guarantee, time, pairs, missed, added] of rows) {
                assert.ok(Number(time) > 0, method);
                if (guarantee !== 'aggressive') assert.equal(missed, '0', method);
                if (guarantee !== 'conservative') assert.equal(added, '0', method);
                assert.equal(Number(pairs), 1323 - Number(missed) + Number(added), method);
            }
            assert.ok(rows.some(([, , , , missed]) => Number(missed) > 10) && rows.some(([, , , , , added]) => Number(added) > 0));
            const printed = () => figure.evaluate((host) => {
                dispatchEvent(new Event('beforeprint'));
                const shown = [host.querySelector('.still').innerHTML, host.querySelector('tbody').textContent, host.querySelector('.says').textContent];
                for (const result of host.figure.state.job.results) result.seconds *= 3;
                dispatchEvent(new Event('afterprint'));
                return shown;
            });
            const before = await figure.locator('tbody').textContent();
            const first = await printed();
            assert.doesNotMatch(first[1], /NaN/);
            assert.deepEqual(await printed(), first, 'handouts have the times of the run that prints them');
            assert.notEqual(await figure.locator('tbody').textContent(), before);
            const dots = () => figure.evaluate((host) => host.figure.state.points.length);
            assert.equal(await dots(), 9);
            const at = await figure.evaluate(async (host) => {
                const { placesOf } = await import('./cost.js'), { state, camera } = host.figure;
                const { x, markY } = placesOf(state.points, camera.width, camera.height).marks.find(({ number }) => number === 7);
                return { x, y: markY };
            });
            await figure.locator('canvas').click({ position: at });
            assert.match(await figure.locator('.says').textContent(), / 10 lines: aggressive/);
            assert.equal(await figure.locator('input[type=range]').inputValue(), '7');
            const other = page.locator('main > figure').nth(1);
            await other.locator('select').first().selectOption('house');
            await figure.locator('select').selectOption('long hall');
            assert.ok((await dots()) < 9, 'another map begins anew');
            await figure.locator('.says').getByText('All methods have run').waitFor({ timeout: 60000 });
            await other.locator('.says').getByText(/10 lines: \d+ found, /).waitFor({ timeout: 60000 });
            const doors = 'sightline 1\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 4 0 4 6\ndoor a 4 6 4 8 open\nwall 10 0 10 1\n' +
                'door b 10 1 10 4 open\ndoor c 17 0 17 2 open\ndoor d 14 0 14 9 shut\n';
            await figure.locator('input[type=file]').setInputFiles({ name: 'doors.map', mimeType: 'text/plain', buffer: Buffer.from(doors) });
            await page.waitForFunction(() => document.querySelector('main > figure').figure.state.plan === 'own');
            await figure.locator('.says').getByText('All methods have run').waitFor({ timeout: 60000 });
            assert.ok(await figure.evaluate((host) => host.figure.state.points.every(({ guarantee, missed, added }) =>
                (guarantee === 'aggressive' || !missed.length) && (guarantee === 'conservative' || !added.length))), 'doors keep promises');
            const glass = `${'sightline 1\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n'}oneway 4 0 4 10\nmirror 20 2 20 8\n`;
            await figure.locator('input[type=file]').setInputFiles({ name: 'glass.map', mimeType: 'text/plain', buffer: Buffer.from(glass) });
            await figure.locator('td').getByText(/mirrors and one-way glass, which 'multipass' does not know$/).waitFor();
            await figure.locator('.says').getByText('All methods have run').waitFor({ timeout: 60000 });
            assert.equal(await dots(), 8);
            await close();
        });

        test('cost: pairs are counted as compare does, and cells that are not inside count', async () => {
            const { page, close } = await open('cost'), figure = page.locator('main > figure').first();
            await figure.locator('input[type=file]').setInputFiles(join(SITE, 'maps/grazing.map'));
            await page.waitForFunction(() => document.querySelector('main > figure').figure.state.plan === 'own');
            await figure.locator('.says').getByText('All methods have run').waitFor({ timeout: 60000 });
            const [sweep, flood] = await figure.evaluate((host) => host.figure.state.job.results.map(({ pairs }) => pairs));
            assert.deepEqual([sweep, flood], [133, 165]);
            await close();
        });

        test('cost: lecture mode shows the chart and all of its table', async () => {
            const { page, close } = await open('cost', { viewport: { width: 1280, height: 720 } });
            await page.locator('main > figure .says').first().getByText('All methods have run').waitFor({ timeout: 60000 });
            await page.click('#lecture');
            await page.keyboard.press('PageDown'); // the puzzle comes first
            const [table, bar, chart] = await Promise.all(['main > figure.on table', '.lecture-bar', 'main > figure.on canvas'].map((name) => page.locator(name).boundingBox()));
            assert.ok(table.y + table.height <= bar.y && table.x + table.width <= 1280, 'the table is cut off');
            assert.ok(chart.width > 600);
            await close();
        });

        test('cost and view: maps of the reader, by file, by drop, by address and from the playground', async () => {
            const room = 'sightline 1\nwalls 100 100 130 100 130 120 100 120 100 100\nwall 110 100 110 112\n';
            const chosen = (page) => page.locator('main > figure select').evaluateAll((lists) => lists.map((list) => list.value).filter((value) => value === 'own').length);
            const box = (page, i) => page.locator('main > figure').nth(i).evaluate((host) => host.figure.box);
            const file = (name, text) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
            for (const [chapter, number, fields] of [['cost', 1, 2], ['view', 2, 1]]) {
                const { page, close } = await open(chapter), input = page.locator('main > figure input[type=file]').first();
                await input.setInputFiles(file('bad.map', 'sightline 1\nwall 1 2 3\n'));
                await page.locator('.map-said').first().getByText('bad.map was not opened').waitFor();
                assert.equal(await chosen(page), 0);
                await input.setInputFiles(file('large.map', `sightline 1\n${'wall 0 0 1 1\n'.repeat(1501)}`));
                await page.locator('.map-said').first().getByText('1501 walls').waitFor();
                await input.setInputFiles(file('room.map', room));
                await page.waitForFunction(([n, x]) => document.querySelectorAll('main > figure')[n].figure.box[0] === x, [number, 100]);
                assert.equal(await chosen(page), fields);
                assert.equal(await page.locator('.map-said').first().textContent(), '');
                await page.evaluate((text) => {
                    const data = new DataTransfer();
                    data.items.add(new File([text], 'moved.map'));
                    document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
                }, room.replaceAll('130', '140'));
                await page.waitForFunction(([n, x]) => document.querySelectorAll('main > figure')[n].figure.box[2] === x, [number, 140]);
                await page.evaluate(async (text) => {
                    const { keepWork, packMap } = await import('../playground/share.js');
                    keepWork(text.replaceAll('130', '160'));
                    location.hash = await packMap(text.replaceAll('130', '150'));
                }, room);
                await page.waitForFunction(([n, x]) => document.querySelectorAll('main > figure')[n].figure.box[2] === x, [number, 150]);
                await page.reload();
                await page.waitForSelector('main[data-ready]');
                await page.waitForFunction(([n, x]) => document.querySelectorAll('main > figure')[n].figure.box[2] === x, [number, 150]);
                await page.locator('main > figure').nth(number).locator('select').first().selectOption('playground');
                assert.deepEqual(await box(page, number), [100, 100, 160, 120]);
                await page.evaluate(() => (location.hash = 'm=broken'));
                await page.locator('.map-said').first().getByText('cannot be read').waitFor();
                await close();
            }
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
