/** A server of a folder, on this machine alone. */
import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css',
    '.svg': 'image/svg+xml', '.json': 'application/json', '.wasm': 'application/wasm', '.png': 'image/png' };

/** @returns {Promise<{address: string, close: () => void}>} */
export function serve(folder) {
    const server = createServer((request, response) => {
        const path = join(folder, normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname)));
        const file = existsSync(path) && statSync(path).isDirectory() ? join(path, 'index.html') : path;
        if (!existsSync(file)) return response.writeHead(404).end();
        response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
        createReadStream(file).pipe(response);
    });
    return new Promise((resolve) => server.listen(0, '127.0.0.1', () =>
        resolve({ address: `http://127.0.0.1:${server.address().port}`, close() {
            server.close();
            server.closeAllConnections();
        } })));
}
