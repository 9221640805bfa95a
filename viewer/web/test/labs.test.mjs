/**
 * Labs and puzzles of the course in Chromium: right code passes, each kind of wrong code is found out and drawn; puzzles; words that
 * are wired to figures; and the course's own searches for shortest ways against the library. SITE and TOOLS as in playground.test.mjs.
 */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, describe, test } from 'node:test';
import { solutions } from '../teachers/lab-solutions.js';
import { launch, programOf, serve } from './site.mjs';

/** By chapter and exercise: the name of the function, and changes of the right code, each of which makes it wrong. */
const wrong = {
    here: ['region', 'region', [['s >= 0 && s <= 1', 's >= 0'], ['t > 0 && ', ''], ['Math.min(best, t)', 'Math.max(best === Infinity ? 0 : best, t)'],
        ['angle - 1e-9', 'angle'], ['1e-9, angle', '0.05, angle'], ...['1e-4', '1e-6', '1e-8'].map((small) => ['angle - 1e-9, angle + 1e-9', `angle - ${small}, angle + ${small}`]),
        ['s >= 0 && s <= 1', 's >= -1e-6 && s <= 1 + 1e-6']]],
    search: ['visible', 'visible', [['if (stabs(longer))', 'if (!seen.has(portal.to) && stabs(longer))'], ['side(a, b, left) >= 0', 'side(a, b, left) > 0'],
        ...[4, 8, 20].map((most) => ['if (stabs(longer))', `if (sequence.length < ${most} && stabs(longer))`]), ['const seen = new Set()', 'const seen = new Set([99])'],
        ...['0.1', '1e-6', '1e-9'].map((small) => ['left) >= 0 && side(a, b, right) <= 0', `left) >= -${small} && side(a, b, right) <= ${small}`]),
        ['side(a, b, left) >= 0', 'side(a, b, left) >= -1e-6'], ['side(a, b, right) <= 0', 'side(a, b, right) <= 1e-6']]],
    program: ['funnel', 'funnel', [['now >= 0', 'now > 0'], ['now === 0 && then < 0 ? end : about', 'about'], ['about: end });', 'about });'],
        ['corners = cut(corners, portals[i].right, -1);', ''], ['return i;', 'return i + 1;'],
        ...['-0.5', '-0.1', '-0.01', '-0.001', '-1e-6', '-1e-9', '1e-9', '1e-6'].map((small) => ['sign * side(from, to, end)', `sign * side(from, to, end) - ${small}`])]],
    ways: ['pull', 'shortest', [['own.pop()', 'break'], ['other.length > 1 && ', 'other.length > 2 && '], ['own[0] = other[0];', ''], ['[...way, ...left]', '[...way, ...left].slice(1)']]],
};

/** Right answers to the puzzles, by chapter; places as x, y of each dot. */
const puzzles = {
    here: [[14.1, 9.3]], rooms: 14, lines: [[0.3, 2.96], [21, 10.6]], program: 12, search: 8, rounding: 1, hidden: 4, sweep: 17, view: 8, regions: 148,
    frames: 5, effects: 3, cost: 24, gallery: 6, ways: 3,
};

describe('labs', { skip: programOf('chromium') ? false : 'Chromium is missing' }, () => {
    let site, browser;
    before(async () => {
        site = await serve(process.env.SITE);
        browser = await launch('chromium');
    });
    after(async () => {
        await browser?.close();
        site?.close();
    });

    async function open(chapter) {
        const page = await browser.newPage({ viewport: { width: 1280, height: 800 } }), errors = [];
        page.on('pageerror', (error) => errors.push(error.message));
        await page.goto(`${site.address}/course/${chapter}.html`);
        await page.waitForSelector('main[data-ready]');
        const close = async () => {
            await page.close();
            assert.deepEqual(errors, []);
        };
        return { page, close };
    }

    for (const [chapter, [exercise, call, changes]] of Object.entries(wrong))
        test(`${chapter}: the lab finds what is wrong with code, and stops it`, async () => {
            const { page, close } = await open(chapter), form = page.locator(`form[data-exercise=${exercise}]`), { code } = solutions[exercise];
            const say = async (text) => {
                await form.locator('textarea').fill(text);
                await form.locator('button[type=submit]').click();
                await form.locator('.answer:not(:empty)').waitFor({ timeout: 60000 });
                return form.locator('.answer').textContent();
            };
            const start = await form.locator('textarea').inputValue();
            assert.match(await say(start), /^Not yet/);
            assert.match(await say(`function ${call}() { for (;;); }`), /no answer within 3 seconds/);
            assert.match(await say(`function ${call}( {`), /SyntaxError/);
            assert.match(await say(`function ${call}() { return document.title; }`), /ReferenceError/);
            assert.match(await say(`function ${call}() { return 'all'; }`), /gives no (list|whole number)/);
            for (const [from, to] of changes) {
                assert.ok(code.includes(from), from);
                assert.match(await say(code.replace(from, to)), /On map \d+ of \d+.*(Your (region|function) says|Yours has|there is no cell|no list of places)/, `${from} as ${to}`);
                assert.ok(await form.locator('.counterexample svg').isVisible());
            }
            if (exercise === 'pull') {
                const [, least, mine] = /shortest way is ([\d.]+) long\. Yours has ([\d.]+),/.exec(await say(code.replace('[...way, ...left]', '[...way, ...left].map(([x, y], i, { length }) => [x, i && i < length - 1 ? y + 1e-6 : y])')));
                assert.ok(Number(mine) > Number(least), `${mine} is longer than ${least}`);
            }
            assert.match(await say(code), /^Right\./);
            assert.match(await say(code.replace('return (b[0] - a[0])', 'console.log(a, b, p);\n$&').replace('const wx', 'console.log(eye, ax, ay, bx, by);\n$&')), /^Right\./, 'what code prints does not stop it');
            assert.ok(await form.locator('.counterexample').isHidden());
            await form.getByText('Begin anew').click();
            assert.equal(await form.locator('textarea').inputValue(), start);
            await close();
        });

    test('each chapter opens with a puzzle that fails at first, and says what helps', async () => {
        for (const [chapter, right] of Object.entries(puzzles)) {
            const { page, close } = await open(chapter), form = page.locator('form.puzzle'), check = async () => {
                await form.locator('button[type=submit]').click();
                await form.locator('.answer:not(:empty)').waitFor({ timeout: 60000 });
                return [await form.getAttribute('data-result'), await form.locator('.answer').textContent()];
            };
            const give = async (value) => {
                if (Array.isArray(value)) await form.locator('figure').evaluate(({ figure }, places) => figure.set(Object.fromEntries(figure.spec.handles.map(({ name }, k) => [name, places[k]]))), value);
                else if (await form.locator('input[type=radio]').count()) await form.locator(`input[value="${value}"]`).check();
                else await form.locator('input[type=number]').fill(String(value));
                await form.dispatchEvent('input');
                return check();
            };
            assert.ok(await form.evaluate((node) => !document.querySelector('main > figure')?.compareDocumentPosition(node) || node.compareDocumentPosition(document.querySelector('main > figure')) & 4), `${chapter}: figures come first`);
            const wrong = Array.isArray(right) ? [] : await form.locator('input[type=radio]').count() ? [right - 1] : [right - 1, right + 1];
            const said = Array.isArray(right) ? [await check()] : [];
            for (const value of wrong) said.push(await give(value));
            for (const [result, text] of said) assert.ok(result === 'wrong' && text.length > 50, `${chapter}: ${result}, ${text}`);
            assert.equal((await give(right))[0], 'right', chapter);
            assert.equal(await page.locator('a[href="#puzzle"]').count(), 1);
            await close();
        }
    });

    test('figures are the same drawn again; words light what they mean, and put figures into a state', async () => {
        for (const chapter of Object.keys(puzzles)) {
            const { page, close } = await open(chapter);
            if (['ways', 'gallery'].includes(chapter)) await page.waitForTimeout(1500);
            const others = await page.locator('main > figure').evaluateAll((hosts) => hosts.filter(({ figure }) => {
                const first = figure.canvas.toDataURL();
                figure.draw();
                return figure.canvas.toDataURL() !== first;
            }).map(({ dataset }) => dataset.figure));
            assert.deepEqual(others, [], `${chapter}: drawn again, the picture is another one`);
            const words = readFileSync(new URL(`../course/${chapter}.md`, import.meta.url), 'utf8').match(/\{(?:show|try): /g);
            assert.equal(await page.locator('button.show, button.try').count(), words.length, `${chapter}: words are not wired`);
            for (const word of await page.locator('button.show').all()) {
                await word.scrollIntoViewIfNeeded();
                const shown = () => word.evaluate((node) => document.querySelector(`figure[data-figure=${node.dataset.of}] canvas`).toDataURL());
                const dark = await shown(), isDark = async () => (await shown()) === dark, name = `${chapter}: ${await word.textContent()}`;
                await word.hover();
                assert.ok(!(await isDark()), `${name} lights nothing`);
                await page.mouse.move(0, 0);
                assert.ok(await isDark(), `${name} stays lit`);
                await word.click();
                await page.mouse.move(0, 0);
                assert.equal(await word.getAttribute('aria-pressed'), 'true');
                assert.ok(!(await isDark()), `${name} does not stay lit`);
                await word.click();
                await word.blur();
                await page.mouse.move(0, 0);
                assert.ok(await isDark(), `${name} cannot be put out`);
            }
            for (const word of await page.locator('button.try').all()) {
                await word.click();
                const { state, wanted, shown } = await word.evaluate(async (node) => {
                    const { stateOf } = await import('./words.js'), { figure } = document.querySelector(`figure[data-figure=${node.dataset.of}]`);
                    const values = stateOf(node.dataset.state), names = Object.keys(values), { inputs, state } = figure;
                    return { state: names.map((name) => String(state[name])), wanted: names.map((name) => String(values[name])),
                        shown: names.filter((name) => inputs[name] && String(inputs[name].type === 'checkbox' ? inputs[name].checked : inputs[name].value) !== String(values[name])) };
                });
                assert.deepEqual([state, shown], [wanted, []], `${chapter}: ${await word.textContent()}`);
            }
            await close();
        }
    });

    test('here: the angular sweep of the figure passes the lab', async () => {
        const { page, close } = await open('here'), form = page.locator('form[data-exercise=region]');
        const sweep = await page.evaluate(async () => (await (await fetch('angular.js')).text()).replaceAll('export ', ''));
        await form.locator('textarea').fill(`${sweep}\nconst region = (eye, walls) => angularSweep(eye, walls).corners;`);
        await form.locator('button[type=submit]').click();
        await form.locator('.answer').getByText(/^Right/).waitFor({ timeout: 30000 });
        await close();
    });

    test('ways: graph, tangent edges and intervals give the library\'s lengths, also along walls and on turned plans', async () => {
        const { page, close } = await open('ways');
        const found = await page.evaluate(async () => {
            const names = ['corner-graph', 'polyanya', 'angular', 'maps', 'lab', 'ground', 'turned', 'string-pull'], modules = await Promise.all(names.map((name) => import(`./${name}.js`)));
            const [{ cornerGraph, shortestWay }, { polyanya }, { isOn, onGrid }, maps, { Lab, cellAt }, { loadGround, wayBetween }, { turnedPlan }, { lengthOf }] = modules;
            const lab = await Lab.open(), wrong = [];
            await loadGround();
            let [number, count, corners, none] = [7, 0, 0, 0];
            const chance = () => (number = (number * 48271) % 2147483647) / 2147483647, rooms = { text: maps.grid(3, 3), box: [0, 0, 12, 12] };
            // A shut-off room, so that some pairs have no way.
            const shut = { text: maps.flat.text + 'walls 14 9 17 9 17 11 14 11 14 9\n', box: maps.flat.box };
            for (const { text, box } of [maps.flat, maps.house, turnedPlan(maps.house), maps.pillars, { text: maps.hall(2), box: [0, 0, 8, 12] }, rooms, turnedPlan(rooms), shut]) {
                const walls = maps.segmentsOf(maps.itemsOf(text)), scene = lab.scene(text);
                const place = () => {
                    for (;;) {
                        const raw = [0, 1].map((k) => box[k] + (box[k + 2] - box[k]) * chance()), at = count % 3 ? onGrid(raw) : raw.map((v) => Math.round(2 * v) / 2);
                        if (cellAt(scene, at) >= 0 && !walls.some((wall) => isOn(at, wall))) return at;
                    }
                };
                for (let k = 0; k < 60; k++) {
                    const [a, b] = [place(), place()], way = wayBetween(text, a, b), length = way?.length ?? Infinity;
                    if (a.join() === b.join()) continue;
                    const graph = cornerGraph(a, b, walls), tangent = { ...graph, edges: graph.edges.filter(({ isTangent }) => isTangent) }, search = polyanya(scene, walls, a, b);
                    const differs = (other) => (length === Infinity ? other !== Infinity : !(Math.abs(other - length) <= 1e-12 * length));
                    const all = shortestWay(graph), mine = [all.length, shortestWay(tangent).length, search.length];
                    if (mine.some(differs) || (length < Infinity && [all.way, search.way].some((points) => differs(lengthOf(points))))) wrong.push([text, a, b, length, mine]);
                    corners = Math.max(corners, way ? way.way.length - 2 : 0);
                    none += way ? 0 : 1;
                    count++;
                }
            }
            return { wrong, count, corners, none };
        });
        assert.deepEqual(found.wrong, []);
        assert.ok(found.count > 450 && found.corners >= 4 && found.none > 0, `${found.count} pairs, up to ${found.corners} corners, ${found.none} without a way`);
        const strings = page.locator('figure[data-figure=strings]');
        await strings.locator('input[type=range]').press('End');
        await page.locator('figure[data-figure=tight] .says').getByText(/m long/).waitFor();
        const [own, library] = /The way is ([\d.]+) m .*The library says ([\d.]+) m/.exec(await strings.locator('.says').textContent()).slice(1);
        assert.equal(own, library);
        await close();
    });
});
