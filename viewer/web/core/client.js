/**
 * The page's end of the worker. Cancelling ends the worker: work in it cannot be interrupted.
 * The next call starts a new one.
 */

/** An error of the core: of the map, of memory, or of the browser. */
export class CoreError extends Error {
    /** @param {string} message @param {number} [line] */
    constructor(message, line) {
        super(message);
        this.name = 'CoreError';
        this.line = line;
    }
}

export class CoreClient {
    /** @param {number} [memory] the most bytes that the core may take @param {string} [file] of the worker */
    constructor(memory, file = './worker.js') {
        this.file = file;
        this.memory = memory;
        /** @type {Worker | null} */
        this.worker = null;
        this.waiting = new Map();
        this.next = 1;
        /** @type {((at: {stage: string, done: number, total: number}) => void) | null} */
        this.onProgress = null;
    }

    start() {
        if (typeof WebAssembly !== 'object')
            throw new CoreError('This browser has no WebAssembly, so it cannot compute what is seen. You can still draw and save.');
        this.worker = new Worker(new URL(this.file, import.meta.url), { type: 'module' });
        this.worker.onmessage = ({ data }) => this.receive(data);
        this.worker.onerror = (event) => {
            event.preventDefault();
            this.stop(new CoreError(`The core could not be loaded or has failed. ${event.message ?? ''}`.trim()));
        };
    }

    receive({ id, result, error, progress }) {
        if (progress) return this.onProgress?.(progress);
        const call = this.waiting.get(id);
        this.waiting.delete(id);
        if (!error) return call?.resolve(result);
        call?.reject(new CoreError(error.message, error.line));
        if (error.broken) this.stop(new CoreError(error.message));
    }

    /** @param {string} task @param {Object} data @returns {Promise<any>} */
    call(task, data) {
        return new Promise((resolve, reject) => {
            if (!this.worker) this.start();
            const id = this.next++;
            this.waiting.set(id, { resolve, reject });
            this.worker.postMessage({ id, task, memory: this.memory, ...data });
        });
    }

    /** Ends all work. @param {Error} reason what those who wait are given */
    stop(reason) {
        this.worker?.terminate();
        this.worker = null;
        const calls = [...this.waiting.values()];
        this.waiting.clear();
        for (const call of calls) call.reject(reason);
    }
}
