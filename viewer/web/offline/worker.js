/**
 * The site without a network: all files are stored when a page is opened for the first time, and pages come from the
 * store. Another version is stored beside the old one, and takes over when no page of the old one is open, so a page
 * never gets files of two versions. publish.mjs puts `version` and `files` above this text.
 */
const mine = `sightline ${registration.scope} `, store = mine + version;

addEventListener('install', (event) =>
    event.waitUntil(caches.open(store).then((cache) => cache.addAll(files.map((file) => new Request(file, { cache: 'reload' }))))));

addEventListener('activate', (event) => event.waitUntil((async () => {
    for (const name of await caches.keys()) if (name.startsWith(mine) && name !== store) await caches.delete(name);
    await clients.claim();
})()));

async function answer(request) {
    const address = new URL(request.url);
    address.search = address.hash = '';
    if (address.pathname.endsWith('/')) address.pathname += 'index.html';
    return (await caches.match(address.href, { cacheName: store })) ?? fetch(request);
}

addEventListener('fetch', (event) => {
    if (event.request.method === 'GET' && event.request.url.startsWith(registration.scope)) event.respondWith(answer(event.request));
});
