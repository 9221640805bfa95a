/**
 * Questions from a number: the same each time, judged by the library, answered in the page, and exported for Moodle. SITE, TOOLS, SHOTS,
 * QUICK and BROWSERS as in playground.test.mjs.
 */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch, programOf, saved, serve } from './site.mjs';

const { SITE, SHOTS, TOOLS, QUICK } = process.env, wanted = (process.env.BROWSERS ?? 'chromium,firefox').split(',').filter(programOf);
const listed = [...readFileSync(join(SITE, 'course/questions.html'), 'utf8').matchAll(/<li><a href="\.\.\/course\/questions\.html\?chapter=(\w+)">([^<]*)/g)].map(([, name, title]) => ({ name, title }));
const { Lab } = await import(join(SITE, 'course/lab.js')), { questionsOf } = await import(join(SITE, 'course/questions/make.js'));
const lab = await Lab.open();
const words = ({ question, value, options }) => JSON.stringify([question, value, options]);

test('each chapter has ten questions for each number, which differ, and are the same each time', async () => {
    assert.ok(listed.length >= 15);
    for (const { name } of listed) {
        const sets = [];
        for (let seed = 1; seed <= 6; seed++) {
            const questions = await questionsOf(name, seed, lab);
            assert.equal(questions.length, 10);
            assert.ok(new Set(questions.map(({ question }) => question.replace(/-?\d+/g, '#'))).size >= 3, `${name}: fewer than three kinds`);
            const texts = questions.filter(({ picture }) => !picture).map(({ question }) => question);
            assert.equal(new Set(texts).size, texts.length, `${name} ${seed}: a question stands twice`);
            for (const { kind, question, value, options, why, low, high } of questions) {
                assert.match(question, /[.?]$/);
                assert.doesNotMatch(JSON.stringify([question, value, options, why]), /NaN|undefined|Infinity/);
                if (kind === 'number') assert.ok(Number.isFinite(value) && why && low && high, question);
                else assert.ok(options[value] && options.every(([text, remark]) => text && remark.length > 15), question);
            }
            sets.push(questions.map(words).join());
        }
        assert.equal(sets[2], (await questionsOf(name, 3, lab)).map(words).join(), `${name}: another time, other questions`);
        assert.equal(new Set(sets).size, 6, `${name}: two numbers have the same questions`);
    }
});

test('answers in words are right, by another computation', async () => {
    const checks = [0, 0, 0, 0];
    const integers = (text) => [...text.matchAll(/-?\d+/g)].map(([digits]) => BigInt(digits));
    for (let seed = 1; seed <= 20; seed++) {
        for (const { question, value } of await questionsOf('rounding', seed, lab)) {
            if (!/^(What is the determinant|Where does C)/.test(question)) continue;
            const [ax, ay, bx, by, cx, cy] = integers(question.replace(/^[^(]*/, '')), twice = ax * (by - cy) + bx * (cy - ay) + cx * (ay - by);
            assert.equal(value, question.startsWith('What') ? Number(twice) : twice > 0n ? 0 : twice < 0n ? 1 : 2, question);
            checks[0]++;
        }
        for (const { question, value, options } of await questionsOf('regions', seed, lab)) {
            const first = /go (left|right) and (up|down)\. Which/.exec(question);
            if (!first) continue;
            const rooms = options.map(([text]) => Number(integers(text)[0])), [low, right, up, both] = rooms;
            assert.ok(low < right && right < up && up < both && right - low === both - up);
            assert.equal(rooms[value], { leftdown: low, rightdown: right, leftup: up, rightup: both }[first[1] + first[2]]);
            checks[1]++;
        }
        for (const { question, value } of await questionsOf('effects', seed, lab)) {
            const range = /range of (\d+)\. .*\((\d+), (\d+)\).*\((\d+), (\d+)\)/.exec(question)?.slice(1).map(Number);
            if (!range) continue;
            assert.equal(value, Math.hypot(range[3] - range[1], range[4] - range[2]) <= range[0] ? 0 : 1, question);
            checks[2]++;
        }
        const yes = (await questionsOf('here', seed, lab)).filter(({ question }) => question === 'Does A see B?');
        checks[3] += yes.filter(({ value }) => value === 0).length / yes.length / 20;
    }
    assert.ok(checks[0] >= 100 && checks[1] >= 40 && checks[2] >= 40, checks.join());
    assert.ok(checks[3] > 0.3 && checks[3] < 0.7, `${checks[3]} of the answers are yes`);
});

/** The parts of a GIFT file: categories, and questions with their text and answers. */
function readGift(text) {
    const bare = (s) => s.replace(/\\([\\~=#{}:])/g, '$1'), entities = (s) => s.replaceAll('&lt;', '<').replaceAll('&gt;', '>').replaceAll('&amp;', '&');
    return text.split(/\n\n(?=::|\$)/).filter((part) => part.startsWith('::')).map((part) => {
        const [, name, body, answers] = /^::((?:\\.|[^:\\])*)::((?:\\.|[^{}\\])*)\{((?:\\.|[^{}\\])*)\}\s*$/.exec(part) ?? assert.fail(part.slice(0, 200));
        const [, question] = /^\[html\]<p>([^]*?)<\/p>/.exec(bare(body)), image = /<img src="data:image\/svg\+xml;base64,([^"]*)"/.exec(bare(body))?.[1];
        const list = [...answers.trim().matchAll(/([=~])((?:\\.|[^#~=\\])*)#((?:\\.|[^~=\\])*)/g)];
        return { name: bare(name), question: entities(question), image: image && Buffer.from(image, 'base64').toString(),
            value: answers.startsWith('#') ? Number(/^#(-?[\d.]+):0#/.exec(answers)[1]) : list.findIndex(([, sign]) => sign === '='), options: list.map(([, , option]) => entities(bare(option))) };
    });
}

for (const name of wanted)
    describe(`questions, ${name}`, () => {
        let browser, site;
        before(async () => {
            browser = await launch(name);
            site = await serve(SITE);
        });
        after(async () => {
            await browser?.close();
            site.close();
        });

        async function open(path, options = {}) {
            const context = await browser.newContext(options), page = await context.newPage(), errors = [];
            page.on('pageerror', (error) => errors.push(error.message));
            await page.goto(site.address + path);
            await page.waitForSelector('main[data-ready]', { timeout: 30000 });
            const close = async () => {
                await context.close();
                assert.deepEqual(errors, []);
            };
            return { page, close };
        }

        test('the page tells right from wrong, and keeps the answers for the page to hand in', async () => {
            const { page, close } = await open('/course/questions.html?chapter=lines&seed=7'), questions = await questionsOf('lines', 7, lab);
            assert.equal(await page.locator('h1').textContent(), listed.find((chapter) => chapter.name === 'lines').title);
            for (const { name: key, kind, value, picture } of questions) {
                const form = page.locator(`form[data-exercise=${key}]`);
                assert.equal(await form.locator('figure svg').count(), picture ? 1 : 0);
                for (const [given, wantedResult] of [[kind === 'number' ? value + 1 : 1 - Math.min(1, value), 'wrong'], [value, 'right']]) {
                    if (kind === 'number') await form.locator('input').fill(String(given));
                    else await form.locator(`input[value="${given}"]`).check();
                    await form.locator('button').click();
                    assert.equal(await form.getAttribute('data-result'), wantedResult);
                }
            }
            await page.reload();
            await page.waitForSelector('main[data-ready]');
            assert.equal(await page.locator('form[data-result=right]').count(), 10);
            await page.goto(`${site.address}/course/answers.html`);
            await page.locator('.says').getByText('10 answers, 10 of them right.').waitFor();
            assert.equal(await page.locator('article').count(), 10);
            await close();
        });

        test('another number gives other questions, and one that is none says so', async () => {
            const { page, close } = await open('/course/questions.html?chapter=here');
            await page.fill('#seed', '12');
            await page.click('text=Show');
            await page.waitForSelector('form[data-exercise=question-12-1]');
            assert.match(page.url(), /\?chapter=here&seed=12$/);
            for (const [ask, about] of [['chapter=nothing', /no chapter nothing/], ['chapter=here&seed=0', /not 0/], ['chapter=here&seed=1.5', /not 1\.5/], ['chapter=here&seed=x', /not x/]]) {
                await page.goto(`${site.address}/course/questions.html?${ask}`);
                assert.match(await page.locator('[role=alert]').textContent(), about);
            }
            await close();
        });

        test('each chapter shows its questions on a phone, light and dark', { skip: Boolean(QUICK) }, async () => {
            const axe = readFileSync(join(TOOLS, 'node_modules/axe-core/axe.min.js'), 'utf8');
            for (const colorScheme of ['light', 'dark'])
                for (const chapter of listed) {
                    const { page, close } = await open(`/course/questions.html?chapter=${chapter.name}&seed=2`, { viewport: { width: 390, height: 844 }, colorScheme, bypassCSP: true });
                    assert.equal(await page.locator('form[data-exercise]').count(), 10);
                    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 390), chapter.name);
                    if (SHOTS) await page.screenshot({ path: join(SHOTS, `questions-${chapter.name}-${colorScheme}.png`), fullPage: true });
                    await page.evaluate(axe);
                    const { violations } = await page.evaluate(() => window.axe.run());
                    assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(' ')}`), [], `${chapter.name} ${colorScheme}`);
                    await close();
                }
        });

        test('the file for Moodle has the same questions, with pictures and right answers', async () => {
            const { page, close } = await open('/teachers/gift.html');
            for (const tick of await page.locator('input[type=checkbox]').all()) await tick.uncheck();
            await page.click('text=Save');
            await page.locator('.says').getByText('Choose a chapter first.').waitFor();
            for (const chapter of ['lines', 'rounding']) await page.check(`#tick-${chapter}`);
            await page.fill('#first', '5');
            await page.fill('#sets', '2');
            const text = String(await saved(page, 'text=Save')), items = readGift(text);
            assert.deepEqual([...text.matchAll(/^\$CATEGORY: \$course\$\/(.*)$/gm)].map(([, title]) => title[0]), ['3', '3', '6', '6']);
            assert.equal(items.length, 40);
            for (const [i, chapter, seed] of [[0, 'lines', 5], [10, 'lines', 6], [20, 'rounding', 5], [30, 'rounding', 6]])
                for (const [k, question] of (await questionsOf(chapter, seed, lab)).entries()) {
                    const item = items[i + k];
                    assert.deepEqual([item.question, item.value, item.options], [question.question, question.value, question.options?.map(([option]) => option) ?? []]);
                    assert.equal(Boolean(item.image?.startsWith('<svg xmlns="http://www.w3.org/2000/svg"') && item.image.endsWith('</svg>')), Boolean(question.picture));
                }
            assert.equal(new Set(items.map((item) => item.name)).size, 40);
            await close();
        });
    });
