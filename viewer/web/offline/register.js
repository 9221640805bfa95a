/** Starts the worker that keeps the site for use without a network. Browsers have none for addresses that are not secure. */
navigator.serviceWorker?.register(new URL('../offline-worker.js', import.meta.url))
    .catch((error) => console.warn(`This site cannot be kept for use without a network: ${error.message}`));
