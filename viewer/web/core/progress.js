/** Messages of progress come this often at most, in milliseconds. */
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
