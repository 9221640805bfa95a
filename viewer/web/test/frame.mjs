/**
 * How long a step of a drag takes in the playground (native code, Node and Chromium in one run) and in each figure of
 * the course, as two tables. It is no test.
 * SITE names the built site, TOOLS a folder with playwright-core, SIGHTLINE the native program.
 *
 *     sh viewer/web/test/run.sh frame FOLDER PROGRAM
 *
 * A wall of the map is moved a little, again and again. Native: the least of the stages of a bake. Node: the
 * least processor time of a bake and of a look from the eye. Chromium: the processor time of a step, on average over
 * the steps of a round, of the page alone (it draws) and of its whole process, with the worker; and the median time from
 * the move to the picture. Of rounds the least counts. A figure: the least time from a move to the last line drawn.
 * Large maps: a bake, the median of what a world takes for a step, and the median time between two frames.
 */
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch, serve } from './site.mjs';

const { SITE, SIGHTLINE } = process.env, STEPS = 10, ROUNDS = 6;
const kinds = [['office'], ['office', '--turned', '30'], ['maze'], ['city'], ['city', '--turned', '30'], ['pillars'], ['pillars', '--turned', '30']];
const folder = mkdtempSync(join(tmpdir(), 'sightline-frame-'));
const path = (name) => join(folder, name);
const native = (...words) => execFileSync(SIGHTLINE, words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });

/** Milliseconds of a native bake, without reading and writing files. */
function nativeBake(map) {
    const least = {};
    for (let i = 0; i < 20; i++) {
        const { read, write, ...stages } = JSON.parse(native('bake', map, '--threads', '1', '--json', '-o', path('x.slv'))).seconds;
        for (const [stage, seconds] of Object.entries(stages)) least[stage] = Math.min(least[stage] ?? Infinity, 1000 * seconds);
    }
    return Object.values(least).reduce((sum, time) => sum + time, 0);
}

/** Processor milliseconds of a call, the least so far by name. */
function spend(least, name, call) {
    const before = process.cpuUsage(), result = call(), { user, system } = process.cpuUsage(before);
    least[name] = Math.min(least[name] ?? Infinity, (user + system) / 1000);
    return result;
}

async function inNode(text, eye) {
    const { Core } = await import(pathToFileURL(join(SITE, 'core/core.js')).href), core = await Core.load(), least = {};
    for (let i = 0; i < 30; i++) {
        spend(least, 'bake', () => core.bake(text, {}));
        spend(least, 'look', () => core.look(eye));
    }
    return least;
}

/** Moves the first wall that is inside, in the page itself; what a step takes. */
async function inPage(page, session, text) {
    await page.evaluate((map) => {
        const { playground } = /** @type {any} */ (window), data = new DataTransfer();
        data.items.add(new File([map], 'frame.map'));
        playground.plan = null;
        document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
    }, text);
    await page.waitForFunction(() => window.playground.plan && window.playground.seen);
    const drag = (steps) => page.evaluate(async (count) => {
        const { playground } = /** @type {any} */ (window), { doc, view } = playground, items = doc.items, step = {}, times = [];
        const { paint } = view;
        playground.patience = 1e6; // as on a machine that does nothing else
        /** Resolves after the frame that draws another plan. */
        const drawn = (plan) => new Promise((done) => {
            view.paint = () => {
                paint.call(view);
                if (playground.plan !== plan) setTimeout(done);
            };
        });
        const index = items.findIndex((item) => item.kind === 'wall') + 7;
        for (let i = 1; i <= count; i++) {
            const from = performance.now(), move = (i % 2 ? 1 : -1) * 1e-3 * i, picture = drawn(playground.plan);
            doc.change(items.map((item, k) => (k === index ? { ...item, points: item.points.map((v) => v + move) } : item)), step);
            await picture;
            times.push(performance.now() - from);
        }
        view.paint = paint;
        return times.sort((a, b) => a - b)[count >> 1];
    }, steps);
    const spent = async () => {
        const { metrics } = await session.send('Performance.getMetrics');
        return ['ThreadTime', 'ProcessTime'].map((wanted) => (1000 * metrics.find(({ name }) => name === wanted).value) / STEPS);
    };
    const least = [Infinity, Infinity, Infinity];
    await drag(2 * STEPS);
    for (let round = 0; round < ROUNDS; round++) {
        const before = await spent(), median = await drag(STEPS), after = await spent();
        [after[0] - before[0], after[1] - before[1], median].forEach((time, i) => (least[i] = Math.min(least[i], time)));
    }
    const [inThread, inProcess, median] = least;
    return { page: inThread, all: inProcess, median, eye: await page.evaluate(() => window.playground.eye),
        cells: await page.evaluate(() => window.playground.plan.cellCount), walls: await page.evaluate(() => window.playground.doc.items.filter((item) => item.kind === 'wall').length) };
}

/** Drags a wall of a large map by the tool, a step for each frame: what a world takes, and between two frames. */
async function follow(page, text) {
    await page.evaluate((map) => {
        const { playground } = /** @type {any} */ (window), data = new DataTransfer();
        data.items.add(new File([map], 'large.map'));
        playground.plan = null;
        document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
    }, text);
    await page.waitForFunction(() => window.playground.plan && window.playground.seen && !window.playground.bakes.running, null, { timeout: 300000 });
    return page.evaluate(async (frames) => {
        const { playground } = /** @type {any} */ (window), { eye, bakeTime, live } = playground, free = { altKey: true };
        const middleOf = ({ points: [a, b, c, d] }) => [(a + c) / 2, (b + d) / 2];
        const walls = playground.doc.items.filter(({ kind }) => kind === 'wall');
        const [x, y] = walls.map(middleOf).sort((a, b) => Math.hypot(a[0] - eye[0], a[1] - eye[1]) - Math.hypot(b[0] - eye[0], b[1] - eye[1]))[4];
        const frame = () => new Promise(requestAnimationFrame), gaps = [], times = [], { show } = live;
        live.show = (seen) => (times.push(seen.time), show(seen));
        playground.chooseTool('move');
        playground.press([x, y], free);
        for (let i = 1, last = await frame(); i <= frames; i++) {
            playground.move([x + 0.007 * i, y + 0.009 * i], true, free);
            const now = await frame();
            if (times.length) gaps.push(now - last);
            last = now;
        }
        playground.release([x, y]);
        live.show = show;
        const middle = (list) => list.sort((a, b) => a - b)[list.length >> 1];
        return { walls: walls.length, bake: bakeTime, world: middle(times), frame: middle(gaps) };
    }, 240);
}

/** By chapter, the milliseconds of each of its figures. */
async function figuresOf(page) {
    await page.goto(`${site.address}/course/index.html`);
    const chapters = await page.locator('main td a').evaluateAll((links) => links.map((a) => a.getAttribute('href')));
    const rows = [];
    for (const chapter of chapters) {
        await page.goto(`${site.address}/course/${chapter}`);
        await page.waitForSelector('main[data-ready]');
        rows.push([chapter.replace('.html', ''), await page.locator('main > figure').evaluateAll((hosts, rounds) => hosts.map((host) => {
            let least = Infinity;
            for (let k = 0; k < rounds; k++) {
                const from = performance.now();
                host.figure.change();
                least = Math.min(least, performance.now() - from);
            }
            return least;
        }), STEPS)]);
    }
    return rows;
}

const site = await serve(SITE), browser = await launch('chromium');
try {
    const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage();
    const session = await page.context().newCDPSession(page);
    await session.send('Performance.setTimeDomain', { timeDomain: 'threadTicks' });
    await session.send('Performance.enable');
    await page.goto(site.address);
    await page.waitForFunction(() => window.playground?.plan);
    console.log(`| map | walls | cells | native bake | Node: bake | Node: look | Chromium: page | Chromium: all | move to picture |\n|${' --- |'.repeat(9)}`);
    for (const [kind, ...turn] of kinds) {
        native('generate', kind, '--walls', '1000', '-o', path('x.map'), ...turn);
        const text = readFileSync(path('x.map'), 'utf8'), shown = await inPage(page, session, text), node = await inNode(text, shown.eye);
        const times = [nativeBake(path('x.map')), node.bake, node.look, shown.page, shown.all, shown.median].map((time) => time.toPrecision(3));
        console.log(`| ${kind}${turn.length ? ', turned' : ''} | ${shown.walls} | ${shown.cells} | ${times.join(' | ')} |`);
    }
    console.log('\n| large map | walls | bake | world | from frame to frame |\n| --- | --- | --- | --- | --- |');
    for (const [count, ...turn] of [[10000], [10000, '--turned', '30'], [100000]]) {
        native('generate', 'city', '--walls', String(count), '-o', path('x.map'), ...turn);
        const { walls, bake, world, frame } = await follow(page, readFileSync(path('x.map'), 'utf8'));
        console.log(`| city${turn.length ? ', turned' : ''} | ${walls} | ${bake.toFixed(0)} | ${world.toFixed(1)} | ${frame.toFixed(1)} |`);
    }
    console.log('\n| chapter | its figures |\n| --- | --- |');
    for (const [chapter, times] of await figuresOf(page)) console.log(`| ${chapter} | ${times.map((time) => time.toPrecision(2)).join(', ')} |`);
} finally {
    await browser.close();
    site.close();
    rmSync(folder, { recursive: true });
}
