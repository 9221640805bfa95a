/**
 * Long work beside the page. A message is {id, task, ...}; the answer is {id, result} or {id, error},
 * and before it, in long work, {id, progress}.
 */
import { Core } from './core.js';

let core = null;

/** Messages of progress come this often at most, in milliseconds. */
const EVERY = 100;

function teller(id) {
    let last = performance.now();
    return (stage, done, total) => {
        const now = performance.now();
        if (now - last < EVERY) return;
        last = now;
        postMessage({ id, progress: { stage, done, total } });
    };
}

const tasks = {
    bake({ id, text, options }) {
        const started = performance.now();
        const result = core.bake(text, { ...options, progress: teller(id) });
        return { ...result, bakeTime: performance.now() - started };
    },
    describe: ({ slv }) => core.describe(slv),
    explain({ a, b }) {
        const why = core.explain(a, b);
        const passed = why.sequence ?? (why.misses?.[0] && [...why.misses[0].sequence, why.misses[0].stopped_by]);
        return { ...why, dual: passed?.length ? core.dual(passed.map((p) => [...p.left, ...p.right])) : null };
    },
};

onmessage = async ({ data }) => {
    try {
        core ??= await Core.load();
        postMessage({ id: data.id, result: tasks[data.task](data) });
    } catch (error) {
        postMessage({ id: data.id, error: { message: error.message, line: error.line, broken: !core } });
    }
};
