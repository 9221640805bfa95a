/**
 * Makes a folder for a web server of a built site: node viewer/web/publish.mjs --from SITE --to FOLDER --base ADDRESS
 *
 * ADDRESS is where the folder will be. Links between pages need no address, so they work anywhere. The picture and the
 * address of a page for those who link to it, the sitemap and the page for missing addresses need it. The folder also gets
 * a worker that keeps the site for use without a network. FOLDER is empty or holds an earlier site, which goes.
 * Without --from it checks FOLDER and ADDRESS, and writes nothing.
 */
import { createHash } from 'node:crypto';
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { escapeHtml } from './markdown.mjs';
import { page } from './page.mjs';

const here = dirname(fileURLToPath(import.meta.url)), PICTURE = 'pages/maps-office.png', WORKER = 'offline-worker.js';
const about = 'Rooms of an office, and what one of them sees';

const stop = (message) => {
    console.error(`publish: ${message}`);
    process.exit(2);
};

function readArguments(given) {
    const values = {};
    for (let i = 0; i < given.length; i += 2) {
        if (!['--from', '--to', '--base'].includes(given[i]) || given[i + 1] === undefined)
            stop(`what is ${given[i]}? usage: node publish.mjs [--from SITE] --to FOLDER --base ADDRESS`);
        values[given[i].slice(2)] = given[i + 1];
    }
    const { from, to, base } = values;
    if (!to || !base) stop('--to and --base are needed');
    if (!URL.canParse(base) || !/^https?:$/.test(new URL(base).protocol) || /[?#]/.test(base))
        stop(`--base is an address as in https://example.org/sightline/, not ${base}`);
    if (from && !existsSync(join(from, 'course/index.html'))) stop(`there is no built site in ${from}`);
    if (existsSync(to) && !statSync(to).isDirectory()) stop(`${to} is no folder`);
    if (existsSync(to) && readdirSync(to).length && !existsSync(join(to, WORKER))) stop(`${to} has other files; give an empty folder, or one of an earlier site`);
    return { from, to, base: new URL(base.endsWith('/') ? base : `${base}/`) };
}

/** All files of a folder, by the alphabet, with / between folders. */
const filesOf = (folder) => readdirSync(folder, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile())
    .map((entry) => relative(folder, join(entry.parentPath ?? entry.path, entry.name)).replaceAll('\\', '/')).sort();

/** The first sentences of a page, as plain HTML text. */
function aboutOf(html) {
    const given = /<meta name="description" content="([^"]*)"/.exec(html)?.[1];
    return given ?? /<p>([^]*?)<\/p>/.exec(html)?.[1].replace(/<[^>]*>/g, '').replace(/\s+/g, ' ').replaceAll('"', '&quot;') ?? '';
}

/** Lines of the head for those who link to a page, and for the worker. */
function headOf(html, path, { base, width, height }) {
    const title = /<title>([^<]*)/.exec(html)[1], own = base + path.replace(/(^|\/)index\.html$/, '$1'), text = aboutOf(html);
    const meta = Object.entries({ 'og:title': title, 'og:description': text, 'og:type': 'website', 'og:site_name': 'Sightline', 'og:url': escapeHtml(own),
        'og:image': escapeHtml(base + PICTURE), 'og:image:width': width, 'og:image:height': height, 'og:image:alt': about });
    return [...meta.map(([name, value]) => `<meta property="${name}" content="${value}">`), '<meta name="twitter:card" content="summary_large_image">',
        ...(html.includes('name="description"') ? [] : [`<meta name="description" content="${text}">`]), `<link rel="canonical" href="${escapeHtml(own)}">`,
        `<script type="module" src="${'../'.repeat(path.split('/').length - 1)}offline/register.js"></script>`].join('\n');
}

const { from, to, base } = readArguments(process.argv.slice(2)), part = `${to.replace(/[/\\]+$/, '')}.part`;
if (!from) process.exit();
rmSync(part, { recursive: true, force: true });
mkdirSync(dirname(part), { recursive: true });
cpSync(from, part, { recursive: true });
cpSync(join(here, 'offline/register.js'), join(part, 'offline/register.js'));
writeFileSync(join(part, '404.html'), page('Nothing here', '<h1>There is nothing at this address</h1>\n<p>Perhaps a page has moved. ' +
    `The <a href="${base.pathname}course/index.html">course</a> and the <a href="${base.pathname}index.html">playground</a> lead to all others.</p>`,
{ root: base.pathname, isSecret: true }));
const picture = readFileSync(join(part, PICTURE)), size = { base: base.href, width: picture.readUInt32BE(16), height: picture.readUInt32BE(20) }, open = [];
for (const path of filesOf(part).filter((file) => file.endsWith('.html'))) {
    const html = readFileSync(join(part, path), 'utf8');
    if (html.includes('content="noindex"')) continue;
    open.push(path);
    writeFileSync(join(part, path), html.replace('</head>', () => `${headOf(html, path, size)}\n</head>`));
}
writeFileSync(join(part, 'sitemap.xml'), '<?xml version="1.0" encoding="UTF-8"?>\n<urlset xmlns="http://www.sitemaps.org/schemas/sitemap/0.9">\n' +
    open.map((path) => `<url><loc>${escapeHtml(base.href + path.replace(/(^|\/)index\.html$/, '$1'))}</loc></url>\n`).join('') + '</urlset>\n');
const files = filesOf(part), hash = createHash('sha256');
for (const file of files) hash.update(`${file}\0`).update(readFileSync(join(part, file)));
writeFileSync(join(part, WORKER), `const version = '${hash.digest('hex').slice(0, 16)}', files = ${JSON.stringify(files, null, 1)};\n` +
    readFileSync(join(here, 'offline/worker.js'), 'utf8'));
rmSync(to, { recursive: true, force: true });
renameSync(part, to);
