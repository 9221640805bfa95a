/**
 * The published site: under a path of its own, without a network after the first load, with a policy that nothing breaks,
 * and no request elsewhere. SITE, TOOLS and BROWSERS as in playground.test.mjs.
 */
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { policy } from '../page.mjs';
import { launch, programOf, serve } from './site.mjs';

const { SITE } = process.env, web = dirname(dirname(fileURLToPath(import.meta.url)));
const wanted = (process.env.BROWSERS ?? 'chromium,firefox').split(',').filter(programOf);
const under = '/lab/sight%20line/', base = `https://example.org${under}`;

const run = (program, ...given) => new Promise((resolve) => execFile(program, given, (error, out, words) => resolve({ status: error?.code ?? 0, words })));
const publish = (...given) => run(process.execPath, join(web, 'publish.mjs'), ...given);

let top, folder;
const pages = () => readdirSync(folder, { recursive: true }).map((file) => String(file).replaceAll('\\', '/')).filter((file) => file.endsWith('.html'));
before(async () => {
    top = mkdtempSync(join(tmpdir(), 'publish-test-'));
    folder = join(top, decodeURIComponent(under));
    assert.deepEqual(await publish('--from', SITE, '--to', folder, '--base', base), { status: 0, words: '' });
});
after(() => rmSync(top, { recursive: true, force: true }));

test('each page has the policy, and words and a picture for those who link to it', () => {
    for (const path of pages()) {
        const html = readFileSync(join(folder, path), 'utf8');
        assert.equal(/http-equiv="Content-Security-Policy" content="([^"]*)"/.exec(html)?.[1], policy, path);
        const bare = html.replace(/="[^"]*"/g, '=""'); // values of attributes may say anything
        assert.doesNotMatch(bare, /<style|\sstyle=|\son\w+=|<script(?![^>]*\ssrc=)/, `${path}: code or style in the page`);
        if (html.includes('content="noindex"')) continue;
        const meta = Object.fromEntries([...html.matchAll(/<meta (?:property|name)="([\w:]+)" content="([^"]*)">/g)].map(([, name, value]) => [name, value]));
        assert.ok(meta['og:url'].startsWith(base) && meta['og:title'] && meta.description.length > 30, path);
        const picture = readFileSync(join(folder, meta['og:image'].slice(base.length)));
        assert.deepEqual([picture.readUInt32BE(16), picture.readUInt32BE(20)], [Number(meta['og:image:width']), Number(meta['og:image:height'])]);
    }
});

test('what those who link to the slides see is no note for the lecturer', () => {
    assert.match(readFileSync(join(folder, 'course/lecture.html'), 'utf8'), /<meta property="og:description" content="Slides of a course on visibility/);
});

test('the sitemap has each page that search engines may show, and no other', () => {
    const listed = [...readFileSync(join(folder, 'sitemap.xml'), 'utf8').matchAll(/<loc>([^<]*)<\/loc>/g)].map(([, address]) => address.slice(base.length).replace(/(^|\/)$/, '$1index.html'));
    assert.deepEqual(listed.sort(), pages().filter((path) => !/^404|^teachers/.test(path)).sort());
});

test('it says what is wrong, and touches no other folder', async () => {
    const other = join(top, 'other');
    mkdirSync(other);
    writeFileSync(join(other, 'mine.txt'), 'kept');
    for (const [given, about] of [
        [['--from', SITE, '--to', other, '--base', base], /other files/], [['--from', SITE, '--to', join(top, 'x')], /--base are needed/],
        [['--from', SITE, '--to', join(top, 'x'), '--base', 'example.org'], /not example\.org/], [['--from', SITE, '--to', join(top, 'x'), '--base', 'file:///x'], /not file/],
        [['--from', SITE, '--to', join(top, 'x'), '--base', `${base}?a`], /not https/], [['--from', other, '--to', join(top, 'x'), '--base', base], /no built site/],
        [['--from', SITE, '--to', join(other, 'mine.txt'), '--base', base], /no folder/], [['--what', 'x'], /--what/]]) {
        const { status, words } = await publish(...given);
        assert.equal(status, 2);
        assert.match(words, about);
    }
    const script = join(web, '../../tools/web.sh'), { status, words } = await run('sh', script, '--build', join(top, 'built'), '--site', other, '--base', base);
    assert.deepEqual([status, /other files/.test(words), existsSync(join(top, 'built'))], [2, true, false], 'web.sh builds before it refuses');
    assert.deepEqual(await publish('--to', join(top, 'x'), '--base', base), { status: 0, words: '' });
    assert.deepEqual(readdirSync(other), ['mine.txt']);
    assert.ok(!existsSync(join(top, 'x')));
    for (const given of [['--site', join(top, 'x')], ['--base', base], ['--site'], ['--base']]) assert.equal((await run('sh', script, ...given)).status, 2);
    const worker = () => readFileSync(join(folder, 'offline-worker.js'), 'utf8'), first = worker();
    assert.deepEqual(await publish('--from', SITE, '--to', folder, '--base', base.slice(0, -1)), { status: 0, words: '' });
    assert.equal(worker(), first, 'the same site is another version');
    assert.ok(!readdirSync(top).some((name) => name.endsWith('.part')));
});

for (const name of wanted)
    describe(`published site, ${name}`, () => {
        let browser, site;
        before(async () => {
            browser = await launch(name);
            site = await serve(top);
        });
        after(async () => {
            await browser?.close();
            site.close();
        });

        /** A page with what went wrong in it: errors, breaches of the policy, requests elsewhere, files that are missing. */
        async function open(context) {
            const page = await context.newPage(), wrong = [];
            await page.exposeFunction('tellBreach', (text) => wrong.push(text));
            await page.addInitScript(() => addEventListener('securitypolicyviolation', (event) =>
                window.tellBreach(`${event.violatedDirective}: ${event.blockedURI}`)));
            page.on('pageerror', (error) => wrong.push(error.message));
            page.on('console', (message) => message.type() === 'error' && wrong.push(message.text()));
            page.on('request', (request) => /^(data|blob):/.test(request.url()) || request.url().startsWith(site.address) || wrong.push(request.url()));
            page.on('response', (response) => response.status() >= 400 && wrong.push(`${response.status()} ${response.url()}`));
            return { page, wrong };
        }
        const ready = (page) => page.waitForFunction(() => !document.body.dataset.chapter || document.querySelector('main[data-ready]'), null, { timeout: 60000 });

        test('all pages load under a path, break no rule, and ask nobody else', async () => {
            const context = await browser.newContext({ serviceWorkers: 'block' }), { page, wrong } = await open(context);
            for (const path of pages()) {
                await page.goto(site.address + under + path);
                await ready(page);
                assert.deepEqual(wrong, [], path);
            }
            await page.evaluate(() => import('https://example.org/x.js').catch(() => {}));
            for (let tries = 100; tries-- && !wrong.length;) await page.waitForTimeout(50);
            assert.ok(wrong.length, 'the policy lets a page load code from elsewhere, or the test does not see it');
            await context.close();
        });

        test('links of the page for missing addresses lead on, from any address', async () => {
            const context = await browser.newContext({ serviceWorkers: 'block' }), { page } = await open(context);
            await page.route('**/is/not/here', (route) => route.fulfill({ status: 404, contentType: 'text/html', body: readFileSync(join(folder, '404.html'), 'utf8') }));
            await page.goto(`${site.address}${under}is/not/here`);
            assert.equal(await page.evaluate(() => getComputedStyle(document.querySelector('main')).maxWidth), '736px', 'it has no style');
            await page.click('main a >> nth=0');
            assert.equal(page.url(), `${site.address}${under}course/index.html`);
            await context.close();
        });

        test('after one page, all others come without a network', { skip: name === 'firefox' ? 'its driver cannot take the network away' : false }, async () => {
            const context = await browser.newContext(), { page, wrong } = await open(context);
            await page.goto(`${site.address}${under}`);
            await page.evaluate(() => navigator.serviceWorker.ready);
            await page.waitForFunction(() => navigator.serviceWorker.controller);
            site.close();
            for (const path of ['', ...pages().filter((file) => !/^404|^teachers/.test(file)), 'course/lines.html?from=elsewhere#slide-2']) {
                await page.goto(site.address + under + path);
                await ready(page);
                assert.deepEqual(wrong, [], path);
            }
            await context.close();
        });
    });
