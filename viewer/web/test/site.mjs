/** Help for tests in a browser: a server of the built site, and browsers to look at it. */
import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { extname, join, normalize } from 'node:path';

const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css',
    '.svg': 'image/svg+xml', '.json': 'application/json', '.wasm': 'application/wasm', '.png': 'image/png' };

/** Serves a folder on this machine alone. @returns {Promise<{address: string, close: () => void}>} */
export function serve(folder) {
    const server = createServer((request, response) => {
        const path = join(folder, normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname)));
        const file = existsSync(path) && statSync(path).isDirectory() ? join(path, 'index.html') : path;
        if (!existsSync(file)) return response.writeHead(404).end();
        response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
        createReadStream(file).pipe(response);
    });
    return new Promise((resolve) => server.listen(0, '127.0.0.1', () =>
        resolve({ address: `http://127.0.0.1:${server.address().port}`, close: () => server.close() })));
}

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
