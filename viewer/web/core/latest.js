/**
 * Runs one job at a time. Of the jobs that are wanted in between, only the last one runs next: so
 * work that follows a pointer never queues up.
 * @template T
 */
export class Latest {
    /** @param {(wanted: T) => Promise<void>} run it deals with its own errors */
    constructor(run) {
        this.run = run;
        this.running = false;
        this.next = null;
    }

    /** @param {T} wanted */
    async want(wanted) {
        this.next = { wanted };
        if (this.running) return;
        this.running = true;
        while (this.next) {
            const job = this.next;
            this.next = null;
            await this.run(job.wanted);
        }
        this.running = false;
    }

    /** Forgets what would run next. */
    forget() {
        this.next = null;
    }
}
