/**
 * Visibility graph analysis beside the page, in a worker of its own: its module loads when it is first
 * asked for, and the other worker stays free. Messages are those of worker.js. One graph is kept.
 */
import { load } from '../package/graph.js';
import { tellEvery } from './progress.js';

let core = null, graph = null;

const tasks = {
    graph({ id, text, grid, doors, measure }) {
        graph?.close();
        graph = null;
        graph = core.graph(text, { grid, doors, progress: tellEvery(id) });
        const { step, count, columns, rows, left, bottom, squares, directed } = graph;
        const made = { step, count, columns, rows, left, bottom, squares, directed };
        return { ...made, values: measure && graph.values(measure, { progress: tellEvery(id) }) };
    },
    measures: () => core.measures.map(({ name }) => name),
    values: ({ id, measure }) => graph?.values(measure, { progress: tellEvery(id) }) ?? null,
    depth: ({ eye }) => graph?.depth(...eye) ?? null,
};

onmessage = async ({ data }) => {
    try {
        core ??= await load({ memory: data.memory ?? 2 ** 31 });
        postMessage({ id: data.id, result: tasks[data.task](data) });
    } catch (error) {
        postMessage({ id: data.id, error: { message: error.message, line: error.line, broken: !core } });
    }
};
