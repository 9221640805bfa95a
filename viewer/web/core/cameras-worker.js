/**
 * Cameras beside the page, in a worker of its own: its modules load when they are first asked for.
 * Messages are those of worker.js. The floor of one map is kept.
 */
import { load } from '../package/cameras.js';
import { isRevoked, tellEvery } from './progress.js';

/** By module: what is loaded, and the floor that is open. */
const cores = {}, floors = {};

async function floorOf(name, { text, doors, memory }) {
    cores[name] ??= name === 'cameras' ? await load({ memory: memory ?? 2 ** 30 })
        : await (await import('../package/place.js')).load({ memory: memory ?? 2 ** 30 });
    const key = JSON.stringify([text, doors]);
    if (floors[name]?.key === key) return floors[name].floor;
    floors[name]?.floor.close();
    delete floors[name];
    floors[name] = { key, floor: cores[name].open(text, { doors }) };
    return floors[name].floor;
}

/** Long work tells how far it is, and stops once the page revokes `going`; the best set so far is kept. */
const watched = ({ id, options, going }) => ({ ...options, progress: tellEvery(id), stop: isRevoked(going) });

/** Points along walls: up to `most`, unless each wall has few already. */
function alongWalls(floor, step, most) {
    let points = floor.points('walls', step);
    for (let wide = 1.5 * step, before = Infinity; points.length > most && points.length < before; wide *= 1.5) {
        before = points.length;
        points = floor.points('walls', wide);
    }
    return points;
}

const tasks = {
    async cover(data) {
        return (await floorOf('cameras', data)).cover(data.cameras);
    },
    async choose(data) {
        const floor = await floorOf('cameras', data), { from, step, most, like, headings } = data;
        const points = from === 'walls' ? alongWalls(floor, step, most) : floor.points(from, from === 'corners' ? 0 : step);
        const places = points.flatMap(({ x, y }) => Array.from({ length: headings }, (_, i) => ({ ...like, x, y, heading: 360 * i / headings })));
        const choice = floor.choose(places, watched(data));
        return { ...choice, coverage: floor.cover(choice.viewpoints) };
    },
    async place(data) {
        const floor = await floorOf('place', data), placement = floor.place(watched(data));
        return { ...placement, coverage: floor.cover(placement.viewpoints) };
    },
};

onmessage = async ({ data }) => {
    try {
        postMessage({ id: data.id, result: await tasks[data.task](data) });
    } catch (error) {
        postMessage({ id: data.id, error: { message: error.message, line: error.line, broken: !cores.cameras && !cores.place } });
    }
};
