/** Help for tests in a browser: a server of the built site, and browsers to look at it. */
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

export { serve } from '../serve.mjs';

/** Modules for tests alone, from the folder that TOOLS names. */
export const tool = (name) => createRequire(join(process.env.TOOLS ?? '.', 'x.js'))(name);

const programs = { chromium: ['/usr/bin/chromium'], firefox: ['/usr/bin/firefox-esr', '/usr/bin/firefox'] };

/** @param {'chromium' | 'firefox'} name @returns {string | undefined} the program of the system */
export const programOf = (name) => programs[name].find(existsSync);

/**
 * Firefox as Debian has it speaks WebDriver BiDi, not the protocol of a patched one. Versions of
 * playwright-core up to 1.56 do so under the name below; later ones want commands that it lacks.
 * @param {'chromium' | 'firefox'} name
 */
export function launch(name) {
    const args = name === 'chromium' ? ['--no-sandbox', '--disable-gpu'] : [];
    const playwright = tool('playwright-core');
    const kind = name === 'firefox' ? playwright._bidiFirefox : playwright.chromium;
    return kind.launch({ executablePath: programOf(name), args });
}

/** What a button saves, which a selector names. Firefox does not tell of downloads here, so the page keeps a copy. */
export async function saved(page, selector) {
    await page.evaluate(() => {
        const make = URL.createObjectURL;
        window.lastSaved = null;
        URL.createObjectURL = (blob) => make.call(URL, (window.lastSaved = blob));
    });
    const comes = page.waitForEvent('download').catch(() => null);
    await page.click(selector);
    await page.waitForFunction(() => window.lastSaved);
    const copy = await page.evaluate(async () => [...new Uint8Array(await window.lastSaved.arrayBuffer())]);
    if (page.context().browser().browserType().name() !== 'chromium') return Buffer.from(copy);
    const file = readFileSync(await (await comes).path());
    assert.ok(file.equals(Buffer.from(copy)));
    return file;
}
