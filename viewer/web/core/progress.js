/** What goes between the page and a worker while it works. Messages and questions come this often at most, in milliseconds. */
const EVERY = 100;

/** @param {number} id of the call @returns {(stage: string, done: number, total: number) => void} */
export function tellEvery(id) {
    let last = performance.now();
    return (stage, done, total) => {
        const now = performance.now();
        if (now - last < EVERY) return;
        last = now;
        postMessage({ id, progress: { stage, done, total } });
    };
}

/**
 * Whether the page has revoked an address that it made. A worker hears no message while it works, but it can ask for this.
 * @param {string} address of a blob @returns {() => boolean}
 */
export function isRevoked(address) {
    let last = performance.now(), gone = false;
    return () => {
        const now = performance.now();
        if (gone || now - last < EVERY) return gone;
        last = now;
        const request = new XMLHttpRequest();
        request.open('GET', address, false);
        try {
            request.send();
        } catch {
            gone = true;
        }
        return gone;
    };
}
