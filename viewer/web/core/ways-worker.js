/**
 * Lines and ways beside the page, in a worker of its own: its module loads when it is first asked for.
 * Messages are those of worker.js. The floor of one map is kept, and its doors follow.
 */
import { load } from '../package/ways.js';

let core = null, floor = null, made = '', doorsOfFloor = {};

function floorOf({ text, doors }) {
    if (text !== made) {
        floor?.close();
        floor = null;
        made = '';
        floor = core.open(text, { doors });
        made = text;
    } else
        for (const [name, open] of Object.entries(doors)) if (doorsOfFloor[name] !== open) floor.setDoor(name, open);
    doorsOfFloor = doors;
    return floor;
}

const tasks = {
    /** What is seen from some point of a line, and from all. */
    line(data) {
        const its = floorOf(data);
        return { some: its.regionFrom(data.ends), all: its.regionFrom(data.ends, { seen: 'all' }) };
    },
    /** The shortest way; where there is none, the ways of a point and past shut doors. */
    path(data) {
        const its = floorOf(data), { ends, radius } = data, way = its.path(...ends, { radius });
        if (way) return { way };
        const ofPoint = radius ? its.path(...ends) : null;
        return { way, ofPoint, pastDoors: ofPoint ? null : its.path(...ends, { loss: 0 }) };
    },
};

onmessage = async ({ data }) => {
    try {
        core ??= await load({ memory: data.memory ?? 2 ** 30 });
        postMessage({ id: data.id, result: tasks[data.task](data) });
    } catch (error) {
        postMessage({ id: data.id, error: { message: error.message, line: error.line, broken: !core } });
    }
};
