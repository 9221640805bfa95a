/**
 * Says what translations lack: node viewer/web/language/check.mjs SITE [--missing CODE]
 *
 * SITE is a built site. The exit status is 1 if a language lacks a text, or has one that no page shows. --missing prints all texts that
 * a language lacks as entries for its .po file.
 */
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { faultsOf, hasLanguage, textsOfSite } from './pages.mjs';
import { writePo } from './po.mjs';

const [site, option, code, ...more] = process.argv.slice(2);
if (!site || more.length || (option && (option !== '--missing' || !code)) || !existsSync(join(site, 'course/index.html'))) {
    console.error('usage: node check.mjs SITE [--missing CODE], where SITE is a built site');
    process.exit(2);
}
if (code && !hasLanguage(code)) {
    console.error(`check: there is no language ${code}`);
    process.exit(2);
}
const texts = await textsOfSite(site, (path) => import(pathToFileURL(join(site, path)).href)), faults = faultsOf(texts);
if (code) process.stdout.write(writePo(faults.find((each) => each.code === code).missing.map((text) => [text, ''])));
else
    for (const { code: name, missing, unused } of faults) {
        for (const text of missing) console.error(`${name}.po: missing: ${text}`);
        for (const text of unused) console.error(`${name}.po: no page shows: ${text}`);
        if (missing.length + unused.length) process.exitCode = 1;
        else console.log(`${name}.po: all ${texts.size} texts`);
    }
