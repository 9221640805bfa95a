/**
 * Long work beside the page. A message is {id, task, ...}; the answer is {id, result} or {id, error},
 * and before it, in long work, {id, progress}.
 */
import { Core } from './core.js';
import { tellEvery } from './progress.js';

let core = null;

const tasks = {
    bake({ id, text, options, doors, eye }) {
        const started = performance.now(), plan = core.bake(text, { ...options, progress: tellEvery(id) });
        const bakeTime = performance.now() - started;
        core.setDoors(doors);
        plan.doors = core.open.doors; // as they stand now
        return { plan, bakeTime, seen: eye && core.look(eye) };
    },
    look({ eye, doors }) {
        core.setDoors(doors);
        return core.look(eye);
    },
    slv: () => core.slv(),
    describe: ({ slv }) => core.describe(slv),
    explain({ from, to }) {
        const pair = [core.locate(from), core.locate(to)];
        return { pair, why: pair[0] !== pair[1] && Math.min(...pair) >= 0 ? core.explain(...pair) : null };
    },
};

onmessage = async ({ data }) => {
    try {
        core ??= await Core.load(data.memory);
        postMessage({ id: data.id, result: tasks[data.task](data) });
    } catch (error) {
        postMessage({ id: data.id, error: { message: error.message, line: error.line, broken: !core } });
    }
};
