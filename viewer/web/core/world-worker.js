/**
 * Walls that are dragged, beside the page, in a worker of its own: its module loads when it is first
 * asked for. Messages are those of worker.js. One world is kept.
 */
import { load } from '../package/world.js';

let core = null, world = null, numbers = null, mirrors = false;

/** Walls by their ends, as they go either way. */
const keyOf = ([ax, ay, bx, by]) => (ax < bx || (ax === bx && ay < by) ? [ax, ay, bx, by] : [bx, by, ax, ay]).join();

const listAt = (segment) => {
    const key = keyOf(segment);
    if (!numbers.has(key)) numbers.set(key, []);
    return numbers.get(key);
};

/** Moves a wall that lies at a segment; it goes on the way it went. */
function move([from, to]) {
    const wall = listAt(from).pop();
    if (wall === undefined) throw new Error('there is no such wall');
    const [x, y] = world.wall(wall).segment, same = x === from[0] && y === from[1];
    world.move(wall, same ? to : [to[2], to[3], to[0], to[1]]);
    listAt(to).push(wall);
}

const tasks = {
    open({ text, bounds, doors }) {
        world?.close();
        world = null;
        world = core.open(text, { bounds });
        numbers = new Map();
        mirrors = false;
        for (const { number, kind, segment, name, open } of world.walls) {
            listAt(segment).push(number);
            mirrors ||= kind === 'mirror';
            if (kind === 'door' && Object.hasOwn(doors, name) && doors[name] !== open) world.setOpen(number, doors[name]);
        }
        world.commit();
        return true;
    },
    drag({ moves, eye }) {
        const started = performance.now();
        for (const each of moves) move(each);
        world.commit();
        const stands = eye && world.locate(...eye) >= 0;
        const region = stands ? world.visiblePolygon(...eye) : null;
        const mirrored = stands && mirrors ? world.mirroredPolygons(...eye).map(({ polygon }) => polygon) : [];
        return { region, mirrored, time: performance.now() - started };
    },
    close() {
        world?.close();
        world = numbers = null;
    },
};

onmessage = async ({ data }) => {
    try {
        core ??= await load({ memory: data.memory ?? 2 ** 31 });
        postMessage({ id: data.id, result: tasks[data.task](data) });
    } catch (error) {
        postMessage({ id: data.id, error: { message: error.message, line: error.line, broken: !core } });
    }
};
