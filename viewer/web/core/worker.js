/**
 * Long work beside the page. A message is {id, task, ...}; the answer is {id, result} or {id, error}.
 * The worker keeps the last .slv file, so that questions about it need not bring it along.
 */
import { Core } from './core.js';

let core = null;
let last = null;

/** Cells and portals for drawing. Who sees whom is asked of the .slv file. */
function outline(plan) {
    const pairs = plan.pvs.reduce((sum, row) => sum + row.length, 0);
    return { cells: plan.cells, portals: plan.portals, bounds: plan.bounds, doors: plan.doors ?? [],
        pairs, guarantee: plan.guarantee, method: plan.method };
}

const tasks = {
    bake({ text, options }) {
        const started = performance.now(), slv = core.bake(text, options), baked = performance.now();
        const plan = outline(core.describe(slv));
        last = slv;
        return { slv: slv.slice(), plan, bakeTime: baked - started, time: performance.now() - started };
    },
    describe: ({ slv }) => core.describe(slv),
    explain: ({ a, b }) => core.explain(last, a, b),
};

onmessage = async ({ data }) => {
    try {
        core ??= await Core.load();
        postMessage({ id: data.id, result: tasks[data.task](data) });
    } catch (error) {
        // A trap leaves the module in no state to go on: the page starts a new worker.
        const broken = error instanceof WebAssembly.RuntimeError || !core;
        postMessage({ id: data.id, error: { message: error.message, line: error.line, broken } });
    }
};
