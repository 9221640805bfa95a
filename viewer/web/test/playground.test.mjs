/**
 * The built site in real browsers. SITE names its folder, TOOLS a folder with playwright-core and
 * axe-core, SIGHTLINE the native program, SHOTS (if given) a folder for pictures of the page.
 */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, describe, test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { bakeNative, needsNative, shapes } from './native.mjs';
import { launch, programOf, saved, serve, tool } from './site.mjs';

const { SITE, SIGHTLINE, SHOTS } = process.env;
/** Those of BROWSERS that are installed. */
const wanted = (process.env.BROWSERS ?? 'chromium,firefox').split(',').filter(programOf);
let site;

before(async () => (site = await serve(SITE)));
after(() => site.close());

const shot = (page, name) => SHOTS && page.screenshot({ path: join(SHOTS, `${name}.png`) });

/** A file that is dropped on the page. */
const drop = (page, name, content) => page.evaluate(([fileName, text]) => {
    const data = new DataTransfer();
    data.items.add(new File([text], fileName));
    document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
}, [name, content]);

const fact = (page, name) => page.locator(`dt:text-is("${name}") + dd`).textContent();
const message = (page) => page.locator('#message').textContent();
const done = (page) => page.locator('#done').textContent();

/** Waits until the last change is baked. */
const settled = (page) => page.waitForFunction(() => {
    const p = window.playground;
    return p.doc.revision > 0 && !p.bakes.running && !p.looks.running && !p.questions.running && (p.plan || p.hasError);
});

/** Places of the map on the screen. */
const screen = (page, x, y) => page.evaluate(([mx, my]) => {
    const box = document.getElementById('plan').getBoundingClientRect();
    const [px, py] = window.playground.view.camera.toScreen(mx, my);
    return [box.left + px, box.top + py];
}, [x, y]);

const room = 'sightline 1\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\nstart 5 5 0\n';

for (const name of wanted)
    describe(name, () => {
        let browser, context, errors = [];
        afterEach(() => assert.deepEqual(errors.splice(0), []));
        before(async () => (browser = await launch(name)));
        after(() => browser.close());

        /** A page with a map on it. */
        async function open(options = {}, address = '', map = room) {
            context = await browser.newContext({ viewport: { width: 1200, height: 800 }, acceptDownloads: true, ...options });
            const page = await context.newPage();
            page.setDefaultTimeout(20000);
            // Taking a picture puts a style on the page, which the page's own policy forbids.
            const isOurs = (text) => SHOTS && /blocked an inline style/.test(text);
            page.on('pageerror', (error) => isOurs(error.message) || errors.push(error.message));
            await page.goto(`${site.address}/${address}`);
            await settled(page);
            if (!map) return page;
            await drop(page, 'room.map', map);
            await page.waitForFunction((text) => window.playground.doc.text() === text, map);
            await settled(page);
            return page;
        }

        test('begins with a map, and shows what is seen', async () => {
            const page = await open({}, '', null);
            assert.equal(await fact(page, 'Wall segments'), '139');
            assert.ok(parseInt(await fact(page, 'The eye sees'), 10) > 5);
            await page.mouse.move(...(await screen(page, 5, 5)));
            await page.waitForFunction(() => /Eye at 5/.test(document.getElementById('where').textContent));
            await shot(page, `${name}-begin`);
            await context.close();
        });

        test('draws, undoes, moves and deletes by mouse', async () => {
            const page = await open(), count = () => page.evaluate(() => window.playground.doc.items.length);
            const cells = await fact(page, 'Cells');
            await page.check('input[value=wall]');
            await page.mouse.move(...(await screen(page, 14, 0)));
            await page.mouse.down();
            await page.mouse.move(...(await screen(page, 14, 5)), { steps: 4 });
            await page.mouse.move(...(await screen(page, 14, 7)), { steps: 4 });
            await page.mouse.up();
            await settled(page);
            assert.match(await page.evaluate(() => window.playground.doc.text()), /\nwall 14 0 14 7\n$/);
            assert.equal(await done(page), 'Added: wall from 14, 0 to 14, 7, length 7');
            assert.notEqual(await fact(page, 'Cells'), cells);
            await page.check('input[value=move]');
            await page.mouse.move(...(await screen(page, 14, 7)));
            await page.mouse.down();
            await page.mouse.move(...(await screen(page, 16, 8)), { steps: 5 });
            await page.mouse.up();
            await settled(page);
            assert.match(await page.evaluate(() => window.playground.doc.text()), /\nwall 14 0 16 8\n$/);
            assert.equal(await done(page), 'Changed: wall from 14, 0 to 16, 8, length 8.246');
            await page.click('[data-do=undo]');
            assert.match(await page.evaluate(() => window.playground.doc.text()), /\nwall 14 0 14 7\n$/);
            assert.equal(await done(page), 'Undone. Changed: wall from 14, 0 to 14, 7, length 7');
            await page.mouse.click(...(await screen(page, 14, 3)));
            await page.click('[data-do=remove]');
            assert.equal(await count(), 4);
            assert.equal(await done(page), 'Deleted: wall from 14, 0 to 14, 7, length 7');
            await page.click('[data-do=undo]');
            assert.equal(await count(), 5);
            assert.equal(await done(page), 'Undone. Added: wall from 14, 0 to 14, 7, length 7');
            await context.close();
        });

        test('draws a step of a drag once, with its answer', async () => {
            const page = await open();
            const paints = await page.evaluate(async () => {
                const { playground } = /** @type {any} */ (window), { client, doc, view } = playground, counts = [];
                const { call } = client, { paint } = view, frame = () => new Promise(requestAnimationFrame);
                let count = 0;
                view.paint = () => (count++, paint.call(view));
                // The answer comes in a later frame, as that of a larger map does.
                client.call = async (...task) => {
                    const answer = await call.apply(client, task);
                    await frame();
                    return answer;
                };
                playground.patience = 10000;
                // What opening the page has left to draw is drawn before.
                for (let still = 0; still < 5; still = count ? 0 : still + 1) {
                    count = 0;
                    await frame();
                }
                for (let i = 1; i <= 3; i++) {
                    await frame();
                    count = 0;
                    doc.change(doc.items.map((item) => (item.kind === 'wall' ? { ...item, points: item.points.map((v) => v + i / 100) } : item)));
                    while (playground.bakes.running) await frame();
                    await frame();
                    counts.push(count);
                }
                // What takes long is not waited for.
                client.call = () => new Promise(() => {});
                playground.patience = count = 0;
                doc.undo();
                await frame();
                await frame();
                return [...counts, count];
            });
            assert.deepEqual(paints, [1, 1, 1, 1]);
            await context.close();
        });

        test('what is seen follows a wall of a large map that is dragged, and cells come back after it', async () => {
            const page = await open();
            let rooms = 'sightline 1\n';
            for (let i = 0; i < 33; i++)
                for (let k = 0; k < 32; k++) rooms += `wall ${k} ${i} ${k + 1} ${i}\nwall ${i} ${k} ${i} ${k + 1}\n`;
            await drop(page, 'rooms.map', rooms);
            await page.waitForFunction(() => window.playground.doc.items.length === 2112);
            await settled(page);
            const area = () => page.evaluate(() => {
                const p = window.playground.seen.region;
                let sum = 0;
                for (let i = 0; i < p.length; i += 2) sum += (p[i] * p[(i + 3) % p.length] - p[(i + 2) % p.length] * p[i + 1]) / 2;
                return Number(sum.toFixed(9));
            });
            await page.evaluate(() => window.playground.setEye([16.5, 15.5]));
            await page.waitForFunction(() => !window.playground.looks.running);
            assert.equal(await area(), 1);
            await page.evaluate(() => {
                const { playground } = /** @type {any} */ (window), free = { altKey: true };
                playground.chooseTool('move');
                playground.view.zoom(4);
                playground.press([16.5, 16], free);
                playground.move([16.5, 16.25], true, free);
            });
            await page.waitForFunction(() => !window.playground.plan && window.playground.seen && !window.playground.live.steps.running);
            assert.equal(await area(), 1.25);
            assert.equal(await page.evaluate(() => window.playground.bakes.running), false);
            await shot(page, `${name}-dragged`);
            // Out of the bounds of the world it is baked step by step.
            await page.evaluate(() => {
                window.playground.move([16.5, 1000], true, { altKey: true });
            });
            await settled(page);
            assert.equal(await area(), 2);
            await page.evaluate(() => {
                window.playground.move([16.5, 16.5], true, { altKey: true });
                window.playground.release([16.5, 16.5]);
            });
            await settled(page);
            assert.equal(await area(), 1.5);
            assert.ok(await page.evaluate(() => window.playground.plan.cellCount > 1000));
            await page.click('[data-do=undo]');
            await settled(page);
            assert.equal(await area(), 1);
            await context.close();
        });

        test('does the same by keyboard', async () => {
            const page = await open();
            await page.focus('#plan');
            await page.keyboard.press('w');
            assert.equal(await done(page), 'Tool: Wall');
            const start = await page.evaluate(() => window.playground.snap(window.playground.middle()));
            const step = await page.evaluate(() => window.playground.step());
            await page.keyboard.press('ArrowRight');
            await page.keyboard.press('Enter');
            assert.equal(await done(page), `Begins at ${[start[0] + step, start[1]].map((v) => +v.toFixed(3)).join(', ')}`);
            await page.keyboard.press('Shift+ArrowUp');
            await page.keyboard.press('Enter');
            assert.match(await done(page), /^Added: wall from /);
            await page.keyboard.press('Escape');
            const points = await page.evaluate(() => window.playground.doc.items.at(-1).points);
            assert.deepEqual(points.map((v) => +v.toFixed(6)), [start[0] + step, start[1], start[0] + step, start[1] + 10 * step].map((v) => +v.toFixed(6)));
            await page.keyboard.press('m');
            await page.keyboard.press('Enter');
            await page.keyboard.press('ArrowLeft');
            await page.keyboard.press('Enter');
            const moved = await page.evaluate(() => window.playground.doc.items.at(-1).points);
            assert.equal(+(points[2] - moved[2]).toFixed(6), +step.toFixed(6));
            await page.keyboard.press('Delete');
            assert.equal(await page.evaluate(() => window.playground.doc.items.length), 4);
            await page.keyboard.press('Control+z');
            assert.equal(await page.evaluate(() => window.playground.doc.items.length), 5);
            await context.close();
        });

        test('takes the places of the grid by keyboard, also beside the end of a wall', async () => {
            const page = await open();
            const points = await page.evaluate(async () => {
                const { playground: p } = window, [x, y] = p.snap(p.middle()), step = p.step();
                p.doc.add({ kind: 'wall', points: [x + 0.1 * step, y, x + 0.1 * step, y + 4 * step] });
                return [x, y, x - step, y];
            });
            await page.focus('#plan');
            for (const key of ['w', 'ArrowRight', 'ArrowLeft', 'Enter', 'ArrowLeft', 'Enter', 'Escape']) await page.keyboard.press(key);
            assert.deepEqual(await page.evaluate(() => window.playground.doc.items.at(-1).points), points);
            await context.close();
        });

        test('opens a map of the list by keys only after Enter', async () => {
            const page = await open(), walls = () => page.evaluate(() => window.playground.doc.text());
            await page.waitForFunction(() => document.querySelectorAll('#gallery option').length > 3);
            // The arrows of a list that is shut are up to the system: the events alone are the same on each.
            const choose = (index) => page.evaluate((i) => {
                const list = document.getElementById('gallery');
                list.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowDown' }));
                list.selectedIndex = i;
                list.dispatchEvent(new Event('change'));
            }, index);
            const before = await walls();
            await page.evaluate(() => {
                window.asked = [];
                window.playground.openGallery = (name) => window.asked.push(name);
            });
            await page.focus('#gallery');
            await choose(1);
            await choose(2);
            assert.deepEqual([await walls(), await page.evaluate(() => window.asked)], [before, []]);
            const third = await page.inputValue('#gallery');
            await page.keyboard.press('Enter');
            assert.deepEqual(await page.evaluate(() => window.asked), [third]);
            await choose(3);
            await page.focus('#plan');
            assert.equal(await page.evaluate(() => window.asked.length), 2);
            await context.close();
        });

        test('undoes a map of the list: the message, the list and the view are those of the map before', async () => {
            const page = await open(), list = page.locator('#gallery');
            await page.waitForFunction(() => document.querySelectorAll('#gallery option').length > 3);
            const camera = () => page.evaluate(() => {
                const { x, y, scale } = window.playground.view.camera;
                return [x, y, scale];
            });
            const before = await camera();
            await list.selectOption('spiral.map');
            await page.waitForFunction(() => /^spiral.map was read/.test(document.getElementById('message').textContent));
            assert.equal(await list.inputValue(), 'spiral.map');
            const sample = await camera();
            assert.notDeepEqual(sample, before);
            await page.click('[data-do=undo]');
            assert.equal(await message(page), 'Undone: room.map is back.');
            assert.deepEqual([await list.inputValue(), await camera()], ['', before]);
            await page.click('[data-do=redo]');
            assert.equal(await message(page), 'Redone: spiral.map is back.');
            assert.deepEqual([await list.inputValue(), await camera()], ['spiral.map', sample]);
            await page.evaluate(() => window.playground.doc.remove(0));
            assert.equal(await list.inputValue(), '', 'a map that was changed is none of the list');
            await context.close();
        });

        test('opens its help by a key', async () => {
            const page = await open(), help = page.locator('#help');
            await page.focus('#range');
            await page.keyboard.press('?');
            assert.equal(await help.isVisible(), false);
            await page.focus('#plan');
            await page.keyboard.press('?');
            assert.equal(await help.isVisible(), true);
            await page.keyboard.press('Escape');
            assert.equal(await help.isVisible(), false);
            await context.close();
        });

        test('keeps no step to undo before the first map', async () => {
            const page = await open({}, '', null);
            await page.waitForFunction(() => window.playground?.doc.items.length > 0);
            assert.equal(await page.evaluate(() => window.playground.doc.canUndo), false);
            assert.equal(await page.inputValue('#gallery'), 'office.map');
            await context.close();
        });

        test('opens and shuts doors without a bake', async () => {
            const page = await open({}, '', room.replace('wall 10 6', 'door front 10 4 10 6\nwall 10 6'));
            assert.equal(await fact(page, 'The eye sees'), '2 cells');
            await page.uncheck('#door-list input');
            await page.waitForSelector('dt:text-is("The eye sees") + dd:text-matches("^1 cell")');
            await context.close();
        });

        test('says why', async () => {
            const page = await open({}, '', `${room}wall 10 4.5 12 4.5\nwall 10 5.5 12 5.5\nwall 14 0 14 7\n`);
            await page.check('input[value=why]');
            await page.mouse.click(...(await screen(page, 2, 9)));
            await page.mouse.click(...(await screen(page, 18, 9)));
            await settled(page);
            assert.match(await page.locator('#why-text').textContent(), /see each other|hidden/);
            await shot(page, `${name}-why`);
            await context.close();
        });

        test('saves what the program would write', { skip: SIGHTLINE ? false : 'SIGHTLINE does not name the program' }, async () => {
            const page = await open(), folder = mkdtempSync(join(tmpdir(), 'sightline-web-'));
            const { file, text } = await page.evaluate(async () => ({ file: 'x.map', text: window.playground.doc.text() }));
            assert.equal((await saved(page, '[data-do=saveMap]')).toString(), text);
            const slv = await saved(page, '[data-do=saveSlv]');
            execFileSync('sh', ['-c', `printf %s "$TEXT" >"${folder}/${file}"; printf '\\n' >>"${folder}/${file}"`], { env: { ...process.env, TEXT: text.trimEnd() } });
            execFileSync(SIGHTLINE, ['bake', join(folder, file), '-o', join(folder, 'x.slv'), '--quiet']);
            assert.ok(slv.equals(readFileSync(join(folder, 'x.slv'))), 'the bytes differ');
            rmSync(folder, { recursive: true });
            assert.equal((await saved(page, '[data-do=savePng]')).subarray(1, 4).toString(), 'PNG');
            const svg = (await saved(page, '[data-do=saveSvg]')).toString();
            assert.match(svg, /^<svg [^]*<path [^]*<\/svg>\n$/);
            // The saved files come back: a .slv as the same walls.
            await page.setInputFiles('#file', { name: 'x.slv', mimeType: '', buffer: slv });
            await page.waitForFunction(() => /x\.slv was read/.test(document.getElementById('message').textContent));
            await settled(page);
            assert.equal(await fact(page, 'Cells'), '2');
            await context.close();
        });

        test('a map that was shared and then changed does not come back, nor do messages about it', async () => {
            const page = await open(), text = () => page.evaluate(() => window.playground.doc.text());
            await page.click('[data-do=share]');
            await page.waitForFunction(() => location.hash.length > 5);
            assert.match(await message(page), /address/);
            await page.check('input[value=start]');
            await page.mouse.click(...(await screen(page, 15, 5)));
            const changed = await text();
            assert.notEqual(changed, room);
            assert.equal(new URL(page.url()).hash, '');
            assert.ok(await page.locator('#message').isHidden());
            await page.reload();
            await settled(page);
            assert.equal(await text(), changed);
            await context.close();
        });

        test('the key names all that has a colour of its own, and a phone shows all tools', async () => {
            const page = await open({ viewport: { width: 390, height: 844 } });
            assert.deepEqual((await page.locator('#key li').allTextContents()).slice(-2), ['path', 'box']);
            const cut = await page.locator('#tools span, #edit button').evaluateAll((list) => list.map((node) => node.getBoundingClientRect())
                .filter(({ left, right }) => left < 0 || right > 390).length);
            assert.equal(cut, 0, 'tools are cut off');
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 390));
            await shot(page, `${name}-phone-tools`);
            await context.close();
        });

        test('shares a map by its address, and keeps work', async () => {
            const page = await open();
            await page.click('[data-do=share]');
            await page.waitForFunction(() => location.hash.length > 5);
            const address = new URL(page.url()).hash, again = await context.newPage();
            await page.waitForTimeout(600);
            await again.goto(site.address);
            await again.waitForFunction((text) => window.playground?.doc.text() === text, room);
            await context.close();
            const other = await open({}, address, null);
            assert.equal(await other.evaluate(() => window.playground.doc.text()), room);
            await context.close();
            const mine = await open(), own = room.replace('20 10', '20 11');
            await drop(mine, 'own.map', own);
            await mine.waitForTimeout(600);
            await mine.goto('about:blank');
            await mine.goto(`${site.address}/${address}`);
            await mine.waitForFunction((text) => window.playground?.doc.text() === text, room);
            await mine.reload();
            await mine.selectOption('#gallery', 'own');
            await mine.waitForFunction((text) => window.playground.doc.text() === text, own);
            await context.close();
            const cut = await open({}, address.slice(0, 30), null);
            assert.match(await message(cut), /cannot be read/);
            await context.close();
            const changed = await open({}, `#t=${Buffer.from(room.replace('wall 10', 'wall 1o')).toString('base64url')}`, null);
            assert.equal(await message(changed), "The address holds a map that cannot be read. Line 3: expected a finite decimal number, found '1o'");
            await context.close();
        });

        test('reads drawings', async () => {
            const page = await open();
            await drop(page, 'a.svg', '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10"><g transform="translate(1 1)">' +
                '<rect width="8" height="8"/><path d="M4 0V3M4 5v3"/></g><text>hall</text></svg>');
            await page.waitForFunction(() => /a\.svg was read as SVG.*1 text or picture/.test(document.getElementById('message').textContent));
            await settled(page);
            const bounds = await page.evaluate(() => window.playground.doc.bounds());
            assert.deepEqual(bounds, [1, 1, 9, 9]);
            await drop(page, 'layers.svg', '<svg xmlns="http://www.w3.org/2000/svg"><g id="Walls"><path d="M0 0H9V9"/></g><g id="chairs"><path d="M1 1H2"/></g></svg>');
            await page.waitForFunction(() => /^layers\.svg was read as SVG.*layers by their names: all shapes are walls here/.test(document.getElementById('message').textContent));
            // What was left out is said beside what is doubtful in the map, and goes with the next change.
            await drop(page, 'b.svg', '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H9V9"/><text>hall</text></svg>');
            await page.waitForFunction(() => /^b\.svg was read as SVG.*1 text or picture\. The command has more rules .*\nThe map has no start/.test(document.getElementById('message').textContent));
            await page.evaluate(() => window.playground.doc.add({ kind: 'wall', points: [1, 1, 2, 1] }));
            await settled(page);
            assert.deepEqual(await page.evaluate(() => ['#message', '#message .state'].map((part) => getComputedStyle(document.querySelector(part)).visibility)), ['hidden', 'visible']);
            await context.close();
        });

        test('a mirror reflects at one side, and is turned round', async () => {
            const page = await open(), last = () => page.evaluate(() => window.playground.doc.text().trimEnd().split('\n').pop());
            const images = () => page.evaluate(() => window.playground.seen.mirrored.length);
            assert.ok(await page.locator('#chosen').isHidden());
            await page.check('input[value=mirror]');
            await page.mouse.move(...(await screen(page, 2, 2)));
            await page.mouse.down();
            await page.mouse.move(...(await screen(page, 2, 8)), { steps: 4 });
            await page.mouse.up();
            await settled(page);
            assert.equal(await last(), 'mirror 2 2 2 8');
            const both = await images();
            assert.ok(both > 0);
            assert.ok(await page.locator('[data-do=turn]').isDisabled());
            await page.check('#one-sided'); // going up, its left side looks away from the eye
            await settled(page);
            assert.equal(await last(), 'mirror 2 2 2 8 one');
            assert.equal(await images(), 0);
            await shot(page, `${name}-mirror`);
            await page.click('[data-do=turn]');
            await settled(page);
            assert.equal(await last(), 'mirror 2 8 2 2 one');
            assert.equal(await images(), both);
            await page.click('[data-do=undo]');
            assert.equal(await last(), 'mirror 2 2 2 8 one');
            await page.click('[data-do=undo]');
            assert.equal(await last(), 'mirror 2 2 2 8');
            assert.ok(await page.locator('#chosen').isHidden());
            await context.close();
        });

        /** What the page and the program make of a file: equal cells, doors and starts. */
        async function comparesWithNative(page, file, content, ...options) {
            await drop(page, file, content);
            await page.waitForFunction((f) => document.getElementById('message').textContent.startsWith(`${f} was`), file);
            assert.match(await message(page), /was read as/);
            await settled(page);
            const text = await page.evaluate(() => window.playground.doc.text());
            const [a, b] = bakeNative([[file, content, ...options], ['b.map', text]]);
            assert.deepEqual(shapes(b), shapes(a), file);
            assert.deepEqual(b.starts, a.starts, file);
            const doorsOf = (plan) => (plan.doors ?? []).map((door) => [door.segments, door.open]);
            assert.deepEqual(doorsOf(b), doorsOf(a), file);
            return b;
        }

        test('Tiled XML becomes the same cells as in the program', needsNative, async () => {
            const page = await open(), grid = [1, 1, 1, 1, 1, 1, 0, 0, 0, 1, 1, 1, 1, 1, 1];
            const bytes = Buffer.from(Uint32Array.from(grid).buffer), layer = (data, more = '') => `<layer id="1" name="Walls" width="5" height="3"${more}>${data}</layer>`;
            const things = '<group name="g" offsetx="0"><objectgroup name="things"><object id="1" name="Player" x="20" y="20" width="8" height="8"/>' +
                '<object id="2" name="back_door" x="32" y="16" width="16" height="16"><properties><property name="open" type="bool" value="false"/></properties></object>' +
                '<object id="3" class="wall" x="20" y="18"><polyline points="0,0 4,0 4,4"/></object></objectgroup></group>';
            const map = (layers, sets = '', more = '') => `<?xml version="1.0" encoding="UTF-8"?>\n<map version="1.10" orientation="orthogonal" width="5" height="3" ` +
                `tilewidth="16" tileheight="16"${more}>${sets}${layers}</map>`;
            const csv = layer(`<data encoding="csv">\n${grid}\n</data>`), packed = deflateSync(bytes).toString('base64');
            for (const layers of [csv, layer(`<data>${grid.map((gid) => `<tile gid="${gid}"/>`).join('')}</data>`),
                layer(`<data encoding="base64">${bytes.toString('base64')}</data>`), layer(`<data encoding="base64" compression="zlib">\n  ${packed}\n</data>`)]) {
                const made = await comparesWithNative(page, 'a.tmx', map(layers + things), '--doors');
                assert.equal(made.doors.length, 1);
                assert.equal(made.starts.length, 1);
            }
            const tiles = '<tileset firstgid="1" name="t" tilewidth="16" tileheight="16" tilecount="2"><tile id="0"><properties><property name="solid" type="bool" value="true"/></properties></tile></tileset>';
            await comparesWithNative(page, 'b.tmx', map(csv.replace('Walls', 'floor'), tiles));
            await comparesWithNative(page, 'c.tmx', map(layer(`<data encoding="csv"><chunk x="-2" y="0" width="5" height="3">${grid}</chunk></data>`), '', ' infinite="1"'));
            await drop(page, 'd.tmx', map(layer('<data encoding="csv">1,2,x</data>')));
            await page.waitForFunction(() => /d\.tmx was not opened.*found 'x'/.test(document.getElementById('message').textContent));
            await context.close();
        });

        test('styles of SVG hide what they hide in the program', needsNative, async () => {
            const page = await open(), rect = (more) => `<rect x="6" y="2" width="3" height="3" ${more}/>`;
            const svg = (inner) => `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10"><rect width="12" height="8"/>${inner}</svg>`;
            let shown = 0;
            for (const [i, more] of ['display="none"', 'style="fill:red; display : none"', 'style="display:none !important"', 'visibility="hidden"', 'style="visibility:hidden"',
                'style="opacity:0"', 'opacity="0.0"', 'style="-x-display:none"', 'style="display:none-such"', 'style="display:inline"', 'class="no"'].entries()) {
                const { cells } = await comparesWithNative(page, `s${i}.svg`, svg(rect(more)));
                shown += cells.length > 1;
            }
            assert.equal(shown, 4);
            await comparesWithNative(page, 'moved.svg', svg(rect('style="transform:translate(1px, -1px) rotate(5deg)"')));
            await comparesWithNative(page, 'percent.svg', svg('<rect width="100%" height="100%"/>'));
            assert.match(await message(page), /1 shape with a size in percent/);
            await drop(page, 'em.svg', svg(rect('style="transform:translate(1em, 0)"')));
            await page.waitForFunction(() => /^em\.svg was not opened: transform: /.test(document.getElementById('message').textContent));
            const sheets = ['.no{display:none}', 'rect.no, .x{visibility:hidden}', '#o .no{display:none}', '.no{display:none} rect{display:inline}',
                '.no{display:none} #o rect{display:inline}', '#o rect{display:none !important} #o .no{display:inline}', '@import "x.css"; @media print{.no{display:none}}',
                '.no{fill:none;stroke:none}', 'g > .no{display:none}', '.nob{display:none}'];
            shown = 0;
            for (const [i, sheet] of sheets.entries()) {
                const { cells } = await comparesWithNative(page, `sheet${i}.svg`, svg(`<style>${sheet.replace('>', '&gt;')}</style><g id="o">${rect('class="no"')}</g>`));
                shown += cells.length > 1;
                assert.equal(/Left out[^.]*rule/.test(await message(page)), i === 6 || i === 8, sheet);
            }
            assert.equal(shown, 4);
            await context.close();
        });

        test('layers of our own become what the program makes of them', needsNative, async () => {
            const page = await open(), seeds = new URL('../../../tests/fuzz/seeds/', import.meta.url);
            for (const file of ['everything.svg', 'everything.tmx', 'everything.dd2vtt']) {
                const { starts, range } = await comparesWithNative(page, file, readFileSync(new URL(file, seeds), 'utf8'));
                assert.deepEqual([starts.length, range], [1, 500.25], file);
            }
            const part = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10"><g id="sightline-wall"><rect width="20" height="10"/></g>' +
                '<g id="sightline-wall-stops-sight-sound"><path d="M5 0V10"/></g></svg>';
            await comparesWithNative(page, 'part.svg', part);
            assert.match(await page.evaluate(() => window.playground.doc.text()), /^wall.* stops sight,sound$/m);
            await context.close();
        });

        test('a wrong file leaves the map as it was', async () => {
            const page = await open();
            const svg = (inner) => `<svg xmlns="http://www.w3.org/2000/svg">${inner}</svg>`, often = '<use href="#a"/>'.repeat(10);
            const uses = Array.from('bcdefgh', (id, i) => `<g id="${id}">${often.replaceAll('#a', `#${'abcdefg'[i]}`)}</g>`).join('');
            for (const [file, content] of [['a.map', 'sightline 1\nwall 0 0 1'],
                ['numbers.geojson', '{"type": "LineString", "coordinates": [["a", 0], [1, 1]]}'], ['far.svg', svg('<line x2="1e999"/>')],
                ['start.json', '{"format": "sightline", "walls": [[0, 0, 1, 1]], "starts": [{}]}'], ['none.json', '{"format": "sightline"}'],
                ['uses.svg', svg(`<defs><rect id="a" width="1" height="1"/>${uses}</defs><use href="#h"/>`)],
                ['packed.tmx', '<map tilewidth="8" tileheight="8" width="1" height="1"><layer name="walls"><data encoding="base64">!</data></layer></map>'], ['b.json', '{"a": 1}'], ['c.png', '\x89PNG\0\xff'], ['d.svg', '<svg'], ['e.tmx', '<map></map>']]) {
                await drop(page, file, content);
                await page.waitForFunction((f) => document.getElementById('message').textContent.startsWith(`${f} was not opened`), file);
                assert.equal(await page.evaluate(() => window.playground.doc.text()), room, file);
            }
            // What is text but no map: the page says which item is meant, and goes on after undo.
            await drop(page, 'f.map', `${room}solid 1 1 3 3 3 1 1 3\n`);
            await page.waitForFunction(() => /cross/.test(document.getElementById('message').textContent));
            assert.match(await message(page), /solid/);
            await page.click('[data-do=undo]');
            await settled(page);
            assert.equal(await fact(page, 'Cells'), '2');
            assert.equal(await message(page), 'Undone: room.map is back.');
            await context.close();
        });

        test('heat maps: measures, values, depth from the eye, doors, and what is refused', async () => {
            const page = await open({}, '', `${room.slice(0, -1)}\ndoor middle 10 4 10 6 open\noneway 4 0 4 10\nrange 15\n`);
            const text = () => page.locator('#heat-text').textContent(), legend = page.locator('#heat-legend');
            const shown = () => page.waitForFunction(() => window.playground.heat.heat && !window.playground.heat.jobs.running && !window.playground.heat.depths.running);
            assert.equal(await page.evaluate(() => performance.getEntriesByType('resource').some((r) => /graph/.test(r.name))), false);
            const step = async (value) => {
                await page.fill('#heat-step', value);
                await page.press('#heat-step', 'Enter');
            };
            await page.check('#heat-on');
            await step('1');
            await page.selectOption('#heat-measure', 'connectivity');
            await shown();
            await page.waitForFunction(() => window.playground.heat.graph.step === 1);
            await shown();
            assert.match(await text(), /^\d{3} points, of what a point sees$/);
            assert.ok(await legend.isVisible());
            const at = async (x, y) => {
                await page.mouse.move(...(await screen(page, x, y)));
                return page.locator('#heat-value').textContent();
            };
            const open6 = parseInt((await at(6.1, 5)).replace('connectivity: ', ''), 10);
            assert.ok(open6 > 40);
            await shot(page, `${name}-heat`);
            await page.click('#door-list input');
            await shown();
            assert.ok(parseInt((await at(6.1, 5)).replace('connectivity: ', ''), 10) < open6);
            await page.selectOption('#heat-measure', 'visual_step_depth');
            await page.click('#door-list input');
            await page.mouse.click(...(await screen(page, 2, 5)));
            await shown();
            await page.waitForFunction(() => window.playground.heat.textAt([2, 5]) === 'visual step depth from the eye: 0');
            assert.equal(await at(2, 5), 'visual step depth from the eye: 0');
            await shot(page, `${name}-heat-depth`);
            await page.selectOption('#heat-measure', 'connectivity');
            await step('0.001');
            await page.waitForFunction(() => /choose a coarser grid/.test(document.getElementById('heat-text').textContent));
            assert.equal(await legend.isVisible(), false);
            await step('1');
            await shown();
            await page.evaluate(() => window.playground.doc.add({ kind: 'mirror', points: [19, 2, 19, 8] }));
            await settled(page);
            await page.waitForFunction(() => /mirror/.test(document.getElementById('heat-text').textContent));
            assert.equal(await page.evaluate(() => window.playground.heat.heat), null);
            await context.close();
        });

        test('cameras: put, turned, moved by mouse and keys, chosen, and saved as a table', async () => {
            const page = await open(), text = () => page.locator('#camera-text').textContent();
            const list = () => page.evaluate(() => window.playground.cameras.list);
            const shown = () => page.waitForFunction(() => window.playground.cameras.coverage && !window.playground.cameras.jobs.running && !window.playground.cameras.choosing);
            const areas = () => page.evaluate(() => window.playground.cameras.coverage.areas);
            assert.equal(await page.evaluate(() => performance.getEntriesByType('resource').some((r) => /cameras\.wasm/.test(r.name))), false);
            assert.equal(await text(), '', 'a status of another tool');
            await page.check('input[value=cameras]');
            await page.mouse.move(...(await screen(page, 2, 5)));
            await page.mouse.down();
            await page.mouse.move(...(await screen(page, 2, 9)), { steps: 4 });
            await page.mouse.up();
            await shown();
            assert.deepEqual(await list(), [{ x: 2, y: 5, heading: 90, fov: 90, range: 0 }]);
            // A camera that looks up sees the part of its room above its cone's sides.
            const [blind, one] = await areas();
            assert.ok(Math.abs(blind + one - 200) < 1e-6 && one > 20 && one < 40, String(one));
            await page.mouse.move(...(await screen(page, 2, 5)));
            await page.mouse.down();
            await page.mouse.move(...(await screen(page, 4, 6)), { steps: 4 });
            await page.mouse.up();
            await page.fill('#camera-heading', '0');
            await page.press('#camera-heading', 'Enter');
            await shown();
            assert.deepEqual(await list(), [{ x: 4, y: 6, heading: 0, fov: 90, range: 0 }]);
            await page.locator('#plan').focus();
            await page.keyboard.press('Enter');
            await shown();
            assert.equal((await list()).length, 2);
            await page.keyboard.press('Delete');
            await shown();
            assert.equal((await list()).length, 1);
            // One all-round camera in the opening sees both rooms.
            await page.fill('#camera-fov', '360');
            await page.press('#camera-fov', 'Enter');
            await page.selectOption('#camera-from', 'anywhere');
            await page.click('#camera-fewest');
            await page.waitForFunction(() => /No fewer can/.test(document.getElementById('camera-text').textContent));
            assert.match(await text(), /^1 camera\. No fewer can: \d+ witnesses inside need 1 viewpoint, wherever they stand\.$/);
            assert.equal((await areas())[0], 0);
            await page.selectOption('#camera-from', 'walls');
            await page.fill('#camera-count', '1');
            await page.click('#camera-best');
            await page.waitForFunction(() => /^1 camera\./.test(document.getElementById('camera-text').textContent) && !window.playground.cameras.choosing);
            assert.match(await text(), /It sees [\d.]+ %; no 1 of these \d+ places sees more than [\d.]+ %\.$/);
            assert.match(await page.locator('#camera-key').textContent(), /not seen.*seen by 3 or more/);
            await shot(page, `${name}-cameras`);
            const table = (await saved(page, '[data-do=saveCameras]')).toString();
            assert.match(table, /^name,x,y,heading,fov,range\ncamera 1,[\d.]+,[\d.]+,,,\n$/);
            // A wall that comes changes what is seen, and the proof is of another map.
            const before = await areas();
            await page.evaluate(() => window.playground.doc.add({ kind: 'wall', points: [3, 0, 3, 10] }));
            await settled(page);
            await shown();
            assert.notDeepEqual(await areas(), before);
            assert.match(await text(), /^1 camera\.( 1 of them sees nothing of the inside\.)?$/);
            await page.click('#camera-clear');
            assert.match(await text(), /A click in a room/);
            await context.close();
        });

        test('cameras: Stop keeps the best set so far, with both bounds', async () => {
            const page = await open(), text = () => page.locator('#camera-text').textContent();
            await page.selectOption('#gallery', 'office.map');
            await settled(page);
            await page.check('input[value=cameras]');
            await page.fill('#camera-fov', '360');
            await page.selectOption('#camera-from', 'anywhere');
            await page.evaluate(() => (window.playground.cameras.seconds = 1e6));
            await page.click('#camera-fewest');
            await page.waitForFunction(() => /at most \d+ so far/.test(document.getElementById('camera-text').textContent));
            await page.click('#camera-stop');
            await page.waitForFunction(() => !window.playground.cameras.choosing);
            assert.match(await text(), /^\d+ cameras\. .*At least \d+ are needed: .* The work ended early; more time may close the gap\.$/);
            assert.equal((await page.evaluate(() => window.playground.cameras.coverage.areas))[0], 0);
            await context.close();
        });

        test('a line: what some of its points see and what all see, by mouse and keys, past doors as they stand', async () => {
            const page = await open({}, '', `${room.slice(0, -1)}\ndoor middle 10 4 10 6 open\n`);
            const text = () => page.locator('#line-text').textContent(), key = page.locator('#line-key');
            const found = (some, all) => page.waitForFunction(([a, b]) => {
                const { answer, ends } = window.playground.line;
                return answer?.ends === ends && Math.abs(answer.some.area - a) < 1e-9 && Math.abs(answer.all.area - b) < 1e-9;
            }, [some, all]);
            assert.equal(await page.evaluate(() => performance.getEntriesByType('resource').some((r) => /ways\.wasm/.test(r.name))), false);
            await page.check('input[value=line]');
            assert.equal(await text(), 'Drag a line in the plan, or click both of its ends.');
            await page.mouse.move(...(await screen(page, 5, 2)));
            await page.mouse.down();
            await page.mouse.move(...(await screen(page, 5, 6)), { steps: 4 });
            assert.equal(await text(), 'Choose the other end.');
            await page.mouse.move(...(await screen(page, 5, 8)), { steps: 4 });
            await page.mouse.up();
            // All see the left room, and a triangle behind the door; some see a part of the right room that widens.
            await found(180, 102.5);
            assert.match(await key.textContent(), /^length of the line6seen from some point180seen from all points102\.5$/);
            assert.deepEqual([await text(), await done(page)], ['', 'Some see 180, all see 102.5']);
            await shot(page, `${name}-line`);
            await page.uncheck('#door-list input');
            await found(100, 100);
            await page.check('#door-list input');
            await found(180, 102.5);
            // An end is dragged; a wall then crosses the line.
            await page.mouse.move(...(await screen(page, 5, 8)));
            await page.mouse.down();
            await page.mouse.move(...(await screen(page, 15, 2)), { steps: 4 });
            await page.mouse.up();
            await page.waitForFunction(() => /^A wall crosses the line/.test(document.getElementById('line-text').textContent));
            assert.equal(await page.evaluate(() => window.playground.line.answer.all.area), 0);
            assert.doesNotMatch(await key.textContent(), /all points/);
            assert.match(await done(page), /^Some see [\d.]+, all see nothing$/);
            await page.evaluate(() => window.playground.doc.add({ kind: 'mirror', points: [19, 1, 19, 9] }));
            await page.waitForFunction(() => /^Nothing was computed: .*mirror/.test(document.getElementById('line-text').textContent));
            assert.ok(await key.isHidden());
            await page.click('[data-do=undo]');
            await page.waitForFunction(() => window.playground.line.answer);
            await page.click('[data-do=remove]');
            assert.deepEqual(await page.evaluate(() => [window.playground.line.ends, window.playground.doc.items.length]), [null, 5]);
            await page.focus('#plan');
            for (const press of ['v', 'l', 'ArrowLeft', 'Enter', 'Shift+ArrowLeft', 'Enter']) await page.keyboard.press(press);
            await page.waitForFunction(() => window.playground.line.answer?.ends === window.playground.line.ends && window.playground.line.held < 0);
            const [[ax, ay], [bx, by]] = await page.evaluate(() => window.playground.line.ends), step = await page.evaluate(() => window.playground.step());
            assert.ok(Math.abs(ax - bx - 10 * step) < 1e-9 && ay === by);
            await page.keyboard.press('Enter');
            await page.keyboard.press('ArrowUp');
            await page.keyboard.press('Escape');
            assert.deepEqual(await page.evaluate(() => window.playground.line.ends), [[ax, ay], [bx, by]], 'Escape puts an end back');
            await page.keyboard.press('Delete');
            await page.check('input[value=look]');
            assert.ok(await page.locator('#line').isHidden());
            await context.close();
        });

        test('a path: by two clicks, for a radius, past doors as they stand, and as walls change', async () => {
            const page = await open({}, '', `${room.slice(0, -1)}\ndoor middle 10 4 10 6 open\n`);
            const says = (words) => page.waitForFunction((source) => new RegExp(source).test(document.getElementById('path-text').textContent), words.source);
            const length = () => page.evaluate(() => window.playground.path.answer.way.length);
            const radius = async (value) => {
                await page.fill('#path-radius', value);
                await page.press('#path-radius', 'Enter');
            };
            await page.check('input[value=path]');
            assert.equal(await page.locator('#path-text').textContent(), 'Click where the way begins.');
            await page.mouse.click(...(await screen(page, 5, 2)));
            assert.equal(await page.locator('#path-text').textContent(), 'Choose the other end.');
            await page.mouse.click(...(await screen(page, 15, 2)));
            await says(/^It turns at 1 corner\.$/);
            assert.ok(Math.abs((await length()) - 2 * Math.hypot(5, 2)) < 1e-9);
            assert.equal(await done(page), 'The way is 10.77 long');
            assert.match(await page.locator('#path-key').textContent(), /^length of the way10\.77straight line10$/);
            await shot(page, `${name}-path`);
            await radius('0.5');
            await page.waitForFunction(() => window.playground.path.answer?.way.length > 10.9);
            await radius('1.5');
            await says(/^No way is wide enough for this radius\. For a point, a way of 10\.77 leads there\.$/);
            await radius('2.5');
            await says(/^Nothing was computed: .*radius 2\.5/);
            await radius('');
            await says(/^It turns/);
            await page.uncheck('#door-list input');
            await says(/^No way leads there: a shut door is in the way\. With all doors open, it would be 10\.77 long\.$/);
            assert.ok(await page.locator('#path-key').isHidden());
            await page.check('#door-list input');
            await says(/^It turns/);
            await page.evaluate(() => window.playground.doc.add({ kind: 'wall', points: [12, 0, 12, 10] }));
            await says(/^No way leads there\.$/);
            await page.click('[data-do=undo]');
            await says(/^It turns/);
            // Of a map that cannot be baked nothing is said.
            await page.evaluate(() => window.playground.doc.add({ kind: 'solid', points: [1, 1, 3, 3, 3, 1, 1, 3] }));
            await page.waitForFunction(() => window.playground.hasError);
            assert.deepEqual([await page.locator('#path-text').textContent(), await page.locator('#path-key').isHidden()], ['', true]);
            await page.click('[data-do=undo]');
            await says(/^It turns/);
            await drop(page, 'other.map', room);
            await page.waitForFunction(() => window.playground.path.ends === null);
            await context.close();
        });

        test('a map with all effects: each is edited, and eye, region and pairs are answered', async () => {
            const all = `${room}door front 10 4 10 6 open\nwall 15 0 15 3\ndoor back 15 3 15 10 shut\nmirror 19 1 19 9\noneway 4 0 4 10\nrange 14\n`;
            const page = await open({}, '', all);
            const facts = async () => ({ pairs: await fact(page, 'Pairs that see each other'), cells: parseInt(await fact(page, 'The eye sees'), 10) });
            const seen = () => page.evaluate(() => {
                const { region, mirrored, kept, set } = window.playground.seen;
                const inRange = region.every((v, i) => i % 2 || Math.hypot(v - window.playground.eye[0], region[i + 1] - window.playground.eye[1]) < 14.01);
                return { farthest: Math.max(...region.filter((_, i) => i % 2 === 0)), nearest: Math.min(...region.filter((_, i) => i % 2 === 0)), parts: mirrored.length, kept, set: set.size, inRange };
            });
            const look = async (x, y) => {
                await page.evaluate(([ex, ey]) => window.playground.setEye([ex, ey]), [x, y]);
                await settled(page);
                return seen();
            };
            const first = await facts();
            const left = await look(3, 5), right = await look(5, 5);
            assert.ok(left.inRange && right.inRange && right.kept <= right.set);
            // Glass shows one side, the shut door hides what is behind it.
            assert.ok((left.farthest > 5) !== (right.nearest < 3), JSON.stringify([left, right]));
            assert.ok(right.farthest <= 15.01 && right.parts === 0);
            await page.click('#door-list input[value=back]');
            await settled(page);
            assert.ok((await seen()).farthest > 18);
            assert.ok((await look(13, 5)).parts > 0, 'seen in the mirror');
            await page.fill('#range', '3');
            await page.press('#range', 'Enter');
            await settled(page);
            assert.match(await page.evaluate(() => window.playground.doc.text()), /range 3\n$/);
            assert.ok(await page.isChecked('#door-list input[value=back]'), 'the door stays open through a bake');
            assert.ok((await seen()).farthest <= 16.01 && (await seen()).parts === 0);
            assert.notEqual((await facts()).pairs, first.pairs);
            await page.fill('#range', '');
            await page.press('#range', 'Enter');
            await settled(page);
            assert.doesNotMatch(await page.evaluate(() => window.playground.doc.text()), /range/);
            await page.click('[data-do=undo]');
            assert.equal(await page.inputValue('#range'), '3');
            await page.evaluate(() => window.playground.askWhy([8, 5], [12, 5]));
            await settled(page);
            assert.ok((await page.locator('#why-text').textContent()).length > 20);
            await page.check('#heat-on');
            await page.waitForFunction(() => /No heat map: .*mirror/.test(document.getElementById('heat-text').textContent));
            await shot(page, `${name}-effects`);
            await context.close();
        });

        test('long work shows itself and can be cancelled', async () => {
            const page = await open();
            let walls = 'sightline 1\n';
            for (let i = 0; i < 1500; i++) walls += `wall ${(i * 7919) % 1000} ${(i * 104729) % 997} ${(i * 1299709) % 991} ${(i * 15485863) % 983}\n`;
            await drop(page, 'long.map', walls);
            await page.waitForSelector('#busy:not([hidden])');
            await page.click('[data-do=cancel]');
            await page.waitForFunction(() => /cancelled/.test(document.getElementById('message').textContent));
            assert.equal(await page.evaluate(() => window.playground.doc.items.length), 1500);
            await page.click('[data-do=undo]');
            await settled(page);
            assert.equal(await fact(page, 'Cells'), '2');
            await context.close();
        });

        test('memory that runs out is said, and the page goes on', async () => {
            const page = await open({}, '?memory=12');
            let walls = 'sightline 1\n';
            for (let i = 0; i < 60000; i++) walls += `wall ${i % 300} ${Math.floor(i / 300)} ${(i % 300) + 0.5} ${Math.floor(i / 300) + 0.25}\n`;
            await drop(page, 'large.map', walls);
            await page.waitForFunction(() => /memory/.test(document.getElementById('message').textContent));
            await page.click('[data-do=undo]');
            await settled(page);
            assert.equal(await fact(page, 'Cells'), '2');
            await context.close();
        });

        test('a browser without WebAssembly can still draw and save', async () => {
            context = await browser.newContext({ acceptDownloads: true });
            await context.addInitScript(() => delete window.WebAssembly);
            const page = await context.newPage();
            await page.goto(site.address);
            await page.waitForFunction(() => /no WebAssembly/.test(document.getElementById('message').textContent));
            assert.match((await saved(page, '[data-do=saveMap]')).toString(), /^sightline 1\n/);
            await context.close();
        });

        test('a phone: all tools are there, and a finger draws', async () => {
            const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, ...(name === 'chromium' ? { isMobile: true } : {}) };
            const page = await open(phone);
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 390));
            // Fingers come through in Chromium alone.
            const tap = async (x, y) => page[name === 'chromium' ? 'touchscreen' : 'mouse'][name === 'chromium' ? 'tap' : 'click'](...(await screen(page, x, y)));
            await tap(15, 5);
            await page.waitForFunction(() => /Eye at 15|Eye at 14\.9/.test(document.getElementById('where').textContent));
            await page.check('input[value=wall]');
            await tap(2, 2);
            await tap(2, 8);
            await settled(page);
            assert.equal(await page.evaluate(() => window.playground.doc.items.length), 5);
            for (const [tool, item] of [['path', 'way'], ['line', 'some']]) {
                await page.check(`input[value=${tool}]`);
                await tap(5, 2);
                await tap(15, 2);
                await page.waitForFunction(([its, wanted]) => window.playground[its].answer?.[wanted], [tool, item]);
                await shot(page, `${name}-phone-${tool}`);
            }
            await shot(page, `${name}-phone`);
            await context.close();
        });

        test('axe-core finds nothing', { skip: Boolean(process.env.QUICK) }, async () => {
            const axe = readFileSync(tool('axe-core/package.json') && join(process.env.TOOLS, 'node_modules/axe-core/axe.min.js'), 'utf8');
            for (const colorScheme of ['light', 'dark'])
                for (const [address, width] of [['', 1200], ['', 390], ['pages/floor-plans.html', 1200], ['pages/game-maps.html', 390],
                    ['pages/teaching.html', 1200], ['pages/embedding.html', 390]]) {
                    context = await browser.newContext({ colorScheme, viewport: { width, height: 844 }, bypassCSP: true, reducedMotion: 'reduce' });
                    const page = await context.newPage();
                    await page.goto(`${site.address}/${address}`);
                    if (!address) await settled(page);
                    await page.evaluate(axe);
                    const { violations } = await page.evaluate(() => window.axe.run());
                    assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(' ')}`), [], `${address} ${width} ${colorScheme}`);
                    if (colorScheme === 'dark') await shot(page, `${name}-dark-${width}-${address.replace(/\W/g, '-')}`);
                    await context.close();
                }
        });
    });
