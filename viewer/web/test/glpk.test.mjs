/** The page of GLPK's answers. SITE names a site that was built with it, PLAIN one that was not; TOOLS as in site.mjs. */
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { launch, programOf, serve } from './site.mjs';

const { SITE, PLAIN } = process.env;

test('other sites and the package are without GLPK', () => {
    assert.ok(existsSync(join(SITE, 'glpk/glpk.wasm')) && existsSync(join(SITE, 'glpk/COPYING')) && existsSync(join(SITE, 'glpk/glpk-source.tar.gz')));
    for (const file of [join(PLAIN, 'glpk'), join(PLAIN, 'package/glpk.wasm'), join(SITE, 'package/glpk.wasm')]) assert.ok(!existsSync(file), file);
});

test('the program, its optimum and the exact answer', { skip: programOf('chromium') ? false : 'Chromium is missing' }, async () => {
    const site = await serve(SITE), browser = await launch('chromium');
    try {
        const page = await browser.newPage(), errors = [];
        page.on('pageerror', (error) => errors.push(error.message));
        await page.goto(`${site.address}/glpk/index.html`);
        await page.waitForSelector('main[data-ready]');
        const says = async (sequence) => (await page.selectOption('select', sequence), page.locator('.says').textContent());
        const rows = await page.locator('table tbody tr').allTextContents();
        assert.deepEqual(rows.map((row) => /^(row 1|[LR]\d)/.exec(row)?.[0]), ['row 1', 'L1', 'R1', 'L2', 'R2', 'L3', 'R3']);
        const { program: found, portals } = await page.evaluate(() => document.querySelector('figure').figure.state);
        // The line really has this margin, and the prices prove that none has more: row 1 alone has a bound other than 0.
        const [[x, y], [u, v]] = found.line, left = ([px, py]) => (u - x) * (py - y) - (v - y) * (px - x);
        const spare = portals.flatMap(([lx, ly, rx, ry]) => [left([lx, ly]), -left([rx, ry])]);
        assert.ok(found.margin > 0.1 && Math.abs(Math.min(...spare) - found.margin) < 1e-9, `${spare} ${found.margin}`);
        assert.ok(Math.abs(found.rows[0].numbers[5] - found.d) < 1e-9, `${found.rows[0].numbers} ${found.d}`);
        assert.equal(await says('own'), `GLPK finds a margin of ${found.margin.toFixed(3)}: a line passes. Exact: a line passes.`);
        assert.match(await says('touch'), /too near to 0 to tell\. Exact: a line can only touch\.$/);
        assert.match(await says('slit'), /too near to 0 to tell\. Exact: a line passes\.$/);
        assert.match(await says('shut'), /too near to 0 to tell\. Exact: no line passes\.$/);
        assert.match(await page.locator('main').textContent(), /GNU General Public License, version 3/);
        await page.setViewportSize({ width: 390, height: 844 });
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 390), 'too wide for a phone');
        assert.deepEqual(errors, []);
    } finally {
        await browser.close();
        site.close();
    }
});
