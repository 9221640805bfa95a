/**
 * Bakes the map again and again as it changes. One bake runs at a time; of the changes in between
 * only the last one is baked next.
 */
export class LiveBake extends EventTarget {
    /** @param {import('../core/client.js').CoreClient} client */
    constructor(client) {
        super();
        this.client = client;
        this.running = false;
        this.next = null;
        this.stopped = false;
        /** The last result that went well. */
        this.result = null;
    }

    /** @param {() => string} text @param {import('../core/core.js').BakeOptions} options */
    want(text, options) {
        this.next = { text, options };
        if (!this.running) this.run();
    }

    async run() {
        while (this.next) {
            const { text, options } = this.next;
            this.next = null;
            this.running = true;
            this.since = performance.now();
            this.dispatchEvent(new Event('begin'));
            try {
                this.result = await this.client.call('bake', { text: text(), options });
                this.result.wait = performance.now() - this.since;
                this.dispatchEvent(new Event('baked'));
            } catch (error) {
                this.dispatchEvent(new CustomEvent('failed', { detail: error }));
            }
            this.running = false;
        }
        this.dispatchEvent(new Event('end'));
    }
}
