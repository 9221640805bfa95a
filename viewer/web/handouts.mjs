/**
 * Handouts of the course as PDF: node viewer/web/handouts.mjs --site SITE --out DIR [--paper a4|letter] [--only NAME]
 *
 * Chromium prints the pages of a built site. DIR/students gets the chapters, the glossary and the plan of
 * the course, DIR/teachers the slides of each lecture, and the solutions, if the site has them. Without --paper both sizes are made;
 * slides have a size of their own. --only makes one page, such as `here` or `lecture-90`. Chromium is driven by its own protocol over a pipe, so no package is needed.
 */
import { spawn } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { plans } from './course/plans.js';
import { escapeHtml } from './markdown.mjs';
import { serve } from './serve.mjs';

/** Width and height in inches. */
const papers = { a4: [210 / 25.4, 297 / 25.4], letter: [8.5, 11] };
const PATIENCE = 60000;

const stop = (message, status = 2) => {
    console.error(`handouts: ${message}`);
    process.exit(status);
};

function readArguments(given) {
    const values = {};
    for (let i = 0; i < given.length; i += 2) {
        if (!['--site', '--out', '--paper', '--only'].includes(given[i]) || given[i + 1] === undefined)
            stop(`what is ${given[i]}? usage: node handouts.mjs --site SITE --out DIR [--paper a4|letter] [--only NAME]`);
        values[given[i].slice(2)] = given[i + 1];
    }
    if (!values.site || !values.out) stop('--site and --out are needed');
    if (values.paper && !papers[values.paper]) stop(`--paper is a4 or letter, not ${values.paper}`);
    return values;
}

/** Pages in the order of the contents, each with its file and its readers. */
function listPages(site) {
    const file = join(site, 'course/index.html');
    if (!existsSync(file)) stop(`there is no built site in ${site}`);
    const rows = [...readFileSync(file, 'utf8').matchAll(/<td><a href="([\w-]+)\.html">(?:(\d+)\. )?/g)];
    const chapters = rows.map(([, name, number]) => ({ name, path: `course/${name}`, file: number ? `${number.padStart(2, '0')}-${name}` : name, folder: 'students' }));
    const more = [['course/glossary', 'students'], ['course/weeks', 'students'], ['teachers/solutions', 'teachers']]
        .filter(([path]) => existsSync(join(site, `${path}.html`)))
        .map(([path, folder]) => ({ name: path.split('/')[1], path, file: path.split('/')[1], folder }));
    const lectures = Object.keys(plans).map((plan) =>
        ({ name: `lecture-${plan}`, path: 'course/lecture', ask: `?plan=${plan}&print=all`, file: `lecture-${plan}`, folder: 'teachers', isSlides: true }));
    return [...chapters, ...more, ...lectures];
}

/** Chromium without a window. `send(method, params, session)` asks; an error of the browser is thrown. */
class Browser {
    constructor(program) {
        this.profile = mkdtempSync(join(tmpdir(), 'handouts-'));
        this.child = spawn(program, ['--headless', '--no-sandbox', '--disable-gpu', '--remote-debugging-pipe',
            `--user-data-dir=${this.profile}`, 'about:blank'], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
        this.waiting = new Map();
        this.count = 0;
        this.text = '';
        this.child.stdio[3].on('error', () => {});
        this.child.stdio[4].setEncoding('utf8').on('data', (data) => this.receive(data));
        this.child.on('error', (error) => this.fail(error));
        this.child.on('exit', () => this.fail(new Error('Chromium ended')));
    }

    fail(error) {
        for (const { reject } of this.waiting.values()) reject(error);
        this.waiting.clear();
    }

    receive(data) {
        const messages = (this.text + data).split('\0');
        this.text = messages.pop();
        for (const { id, error, result } of messages.map((message) => JSON.parse(message))) {
            const asked = this.waiting.get(id);
            this.waiting.delete(id);
            if (error) asked?.reject(new Error(error.message));
            else asked?.resolve(result);
        }
    }

    send(method, params = {}, sessionId = undefined) {
        return new Promise((resolve, reject) => {
            const id = ++this.count;
            const timer = setTimeout(() => reject(new Error(`Chromium does not answer to ${method}`)), PATIENCE);
            const done = (use) => (value) => {
                clearTimeout(timer);
                use(value);
            };
            this.waiting.set(id, { resolve: done(resolve), reject: done(reject) });
            this.child.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
        });
    }

    /** Its helper processes write to the profile for a moment longer, so removing it may need several tries. */
    async close() {
        const ended = new Promise((resolve) => this.child.once('exit', resolve));
        if (this.child.exitCode === null && this.child.pid) {
            this.child.kill();
            await ended;
        }
        for (let tries = 20; tries--;)
            try {
                return rmSync(this.profile, { recursive: true, force: true });
            } catch {
                await new Promise((resolve) => setTimeout(resolve, 100));
            }
    }
}

/** Waits until all figures of the page are there, and says its title. */
const READY = `new Promise((resolve, reject) => {
    const end = Date.now() + ${PATIENCE - 5000}, figures = () => [...document.querySelectorAll('main > figure')].flatMap((host) => host.figure ?? []);
    const isReady = () => document.querySelector('main[data-ready]') && figures().every(({ spec, state }) => spec.isReady?.(state) ?? true);
    const look = () => {
        const alert = document.querySelector('main [role=alert]');
        if (alert) reject(new Error(alert.textContent));
        else if (document.querySelector('main') && (!document.body.dataset.chapter || isReady()))
            resolve(document.querySelector('h1').textContent);
        else if (Date.now() > end) reject(new Error('its figures do not come'));
        else setTimeout(look, 50);
    };
    look();
})`;

/** The bytes of a PDF for each paper; slides bring their own paper, and have no footer. */
async function print(browser, address, sizes, isSlides) {
    const { targetId } = await browser.send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await browser.send('Target.attachToTarget', { targetId, flatten: true });
    const send = (method, params) => browser.send(method, params, sessionId);
    const { errorText } = await send('Page.navigate', { url: address });
    if (errorText) throw new Error(errorText);
    const { result, exceptionDetails } = await send('Runtime.evaluate', { expression: READY, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description?.split('\n')[0] ?? exceptionDetails.text);
    const footer = `<div style="font: 8px sans-serif; width: 100%; padding: 0 18mm; display: flex; justify-content: space-between">` +
        `<span>Sightline: ${escapeHtml(result.value)}</span><span><span class="pageNumber"></span> / <span class="totalPages"></span></span></div>`;
    const files = [];
    for (const size of sizes) {
        const [paperWidth, paperHeight] = papers[size] ?? [];
        const { data } = await send('Page.printToPDF', { printBackground: true, ...(isSlides ? { preferCSSPageSize: true }
            : { paperWidth, paperHeight, displayHeaderFooter: true, headerTemplate: '<span></span>', footerTemplate: footer }) });
        files.push([size, Buffer.from(data, 'base64')]);
    }
    await browser.send('Target.closeTarget', { targetId });
    return files;
}

const { site, out, paper, only } = readArguments(process.argv.slice(2));
const program = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
const pages = listPages(site).filter(({ name }) => !only || name === only);
if (!pages.length) stop(`the course has no page ${only}`);
if (!program) stop('Chromium is missing', 77);
const server = await serve(site), browser = new Browser(program);
try {
    for (const { name, path: page, ask = '', file, folder, isSlides } of pages) {
        mkdirSync(join(out, folder), { recursive: true });
        const made = await print(browser, `${server.address}/${page}.html${ask}`, isSlides ? ['slides'] : paper ? [paper] : Object.keys(papers), isSlides)
            .catch((error) => Promise.reject(new Error(`${name}: ${error.message}`)));
        for (const [size, bytes] of made) {
            const path = join(out, folder, `${file}${isSlides ? '' : `-${size}`}.pdf`);
            writeFileSync(`${path}.part`, bytes);
            renameSync(`${path}.part`, path);
            console.log(`handouts: ${path}`);
        }
    }
} catch (error) {
    console.error(`handouts: ${error.message}`);
    process.exitCode = 1;
} finally {
    await browser.close();
    server.close();
}
