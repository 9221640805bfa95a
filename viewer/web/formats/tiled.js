/**
 * Tiled maps as JSON (.tmj), or as XML (tiled-xml.js): orthogonal maps, fixed or in chunks. A simpler reader than that of the
 * `sightline` command; the rules for what is solid are the same in order, and it says what it left.
 */
import { doorItems } from './grid-doors.js';
import { FormatError } from './map-text.js';
import { ownItems, ownLayer } from './own-layers.js';
import { gridWalls } from './plan-text.js';
import { isDoorName, isOpenName, isSolidName, isStartName, oneWord, plural } from './words.js';

const FLAGS = 0x1fffffff;

/** A few chunks far from each other span a huge map. */
const MOST_SQUARES = 2 ** 26;

/** True and false, also as a number or a word; undefined for all else. */
const truth = (value) => ({ true: true, 1: true, yes: true, false: false, 0: false, no: false })[String(value).toLowerCase()];

/** Properties of anything: an array, or an object in old files. @returns {{name: string, value: any}[]} */
const listed = (properties) => (Array.isArray(properties) ? properties
    : Object.entries(properties ?? {}).map(([name, value]) => ({ name, value })));

const propertyOf = (thing, name) => listed(thing.properties).find((p) => p.name === name)?.value;

/** What the properties of a layer, a tile or an object say. */
const flag = (properties) => {
    for (const { name, value } of listed(properties)) {
        const said = truth(value);
        if (said !== undefined && isSolidName(name)) return said;
        if (said !== undefined && isOpenName(name)) return !said;
    }
    return undefined;
};

/** Whether a layer says that it is solid; undefined where it says nothing. */
const layerSays = (layer) => flag(layer.properties) ??
    (isSolidName(layer.class ?? layer.type) || isSolidName(layer.name) ? true : undefined);

async function decode(data, compression, encoding) {
    if (Array.isArray(data)) return data;
    if (encoding !== 'base64') throw new FormatError(`tile data in '${encoding}' are not read here`);
    let bytes = Uint8Array.from(atob(data.trim()), (c) => c.charCodeAt(0));
    if (compression) {
        const method = { gzip: 'gzip', zlib: 'deflate' }[compression];
        if (!method) throw new FormatError(`tiles packed by ${compression} are not read here: choose CSV in Tiled`);
        const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream(method));
        bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    }
    return new Uint32Array(bytes.buffer, 0, bytes.length >> 2);
}

/** The chunks of a layer: { x, y, width, height, tiles }. */
async function chunksOf(layer) {
    const raw = layer.chunks ?? [{ ...layer, x: 0, y: 0 }], chunks = [];
    for (const chunk of raw)
        chunks.push({ ...chunk, tiles: await decode(chunk.data, layer.compression, layer.encoding) });
    return chunks;
}

function* flatten(layers, says, dx = 0, dy = 0) {
    for (const layer of layers ?? []) {
        const own = layerSays(layer) ?? says;
        const x = dx + (layer.offsetx ?? 0), y = dy + (layer.offsety ?? 0);
        if (layer.type === 'group') yield* flatten(layer.layers, own, x, y);
        else yield { layer, says: own, x, y };
    }
}

/** What the tilesets say of each tile: a map from number to true or false. */
function tilesSay(map, notes) {
    const says = new Map();
    let shaped = 0;
    for (const set of map.tilesets ?? []) {
        if (set.source) notes.push(`the tileset ${set.source} in a file of its own`);
        const whole = flag(set.properties) ?? (isSolidName(set.name) ? true : undefined);
        if (whole !== undefined)
            for (let i = 0; i < (set.tilecount ?? 0); i++) says.set(set.firstgid + i, whole);
        for (const tile of set.tiles ?? []) {
            const said = flag(tile.properties) ??
                (isSolidName(tile.type ?? tile.class) ? true : undefined) ??
                (tile.objectgroup?.objects?.length ? true : undefined);
            if (said !== undefined) says.set(set.firstgid + tile.id, said);
            if (tile.objectgroup?.objects?.length) shaped++;
        }
    }
    if (shaped) notes.push(`${plural(shaped, 'tile')} with shapes of collision: each is solid as a whole`);
    return says;
}

/** The corners of an object; y goes up from `height`. A picture stands on its place. @returns {number[][]} */
function cornersOf({ gid, x, y, width = 0, height: h = 0, rotation = 0, polygon, polyline }, height) {
    const turn = (rotation * Math.PI) / 180, c = Math.cos(turn), s = Math.sin(turn), up = (py) => height - py;
    const place = (px, py) => (turn ? [x + c * px - s * py, up(y + s * px + c * py)] : [x + px, up(y + py)]);
    return (polygon ?? polyline ?? [[0, 0], [width, 0], [width, h], [0, h]].map(([a, b]) => ({ x: a, y: gid ? b - h : b }))).map((p) => place(p.x, p.y));
}

const headingOf = ({ rotation = 0 }) => -rotation || 0;

const isShut = (object) => propertyOf(object, 'open') === false;

/** An object on a layer of our own, as items. */
function ownObject(layer, object, height, counts) {
    const corners = cornersOf(object, height), closed = object.polyline ? corners : [...corners, corners[0]];
    return ownItems(layer, closed, { name: object.name, isShut: isShut(object), heading: headingOf(object) }, counts);
}

/** One object as items: its outline or a start. A door goes to the doors, but for one that is a slanted line. */
function objectItems(object, says, height, counts, doors) {
    const { width = 0, height: h = 0 } = object, kind = object.type || object.class;
    const corners = cornersOf(object, height), points = corners.flat();
    if (isStartName(object.name) || isStartName(kind)) {
        const [a, , b = a] = corners;
        return [{ kind: 'start', points: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], heading: headingOf(object) }];
    }
    const isSlanted = object.polyline && points.length === 4 && points[0] !== points[2] && points[1] !== points[3];
    if (isDoorName(object.name) || isDoorName(kind)) {
        const state = isShut(object) ? 'shut' : 'open';
        const xs = points.filter((_, i) => i % 2 === 0), ys = points.filter((_, i) => i % 2);
        const box = [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
        const name = oneWord(object.name || kind, 'door');
        if (isSlanted) return [{ kind: 'door', name, points, state }];
        doors.push({ name, box, state });
        return [];
    }
    const own = flag(object.properties) ?? (isSolidName(kind) ? true : says);
    if (!own || object.point || object.text) return [];
    if (object.ellipse) counts.ellipses++;
    if (object.polyline) return [{ kind: 'walls', points }];
    return width || h || object.polygon ? [{ kind: 'solid', points }] : [];
}

/** The tiles that are solid where nobody says so: empty ones. */
function guess(tiles) {
    if (tiles.some((t) => (t & FLAGS) === 0)) return 0;
    throw new FormatError('nothing in this Tiled map says what is solid: name a layer Walls, or give tiles the property solid');
}

/** @param {any} map @returns {Promise<{items: import('./map-text.js').Item[], notes: string[]}>} */
export async function readTiled(map) {
    if ((map.orientation ?? 'orthogonal') !== 'orthogonal')
        throw new FormatError(`${map.orientation} Tiled maps are not read here. The sightline command reads them.`);
    const notes = [], says = tilesSay(map, notes), layers = [...flatten(map.layers)];
    const { tilewidth: tw, tileheight: th } = map;
    if (tw !== th) throw new FormatError('tiles that are not square are not read here');
    const height = Number(propertyOf(map, 'sightline-y0') ?? map.height * th), counts = { ellipses: 0, doors: 0 }, doors = [];
    const cells = new Map(), items = [];
    // A map without bounds is as large as its chunks.
    const boxes = map.infinite ? [Infinity, Infinity, -Infinity, -Infinity] : [0, 0, map.width, map.height];
    const tileLayers = layers.filter(({ layer }) => layer.type === 'tilelayer');
    const spoken = says.size || layers.some((l) => l.says);
    let guessed = false, grid = null;
    const open = new Set();
    for (const { layer, says: whole, x, y } of tileLayers) {
        let taken = 0;
        if (x || y) notes.push(`the offset of the layer ${layer.name}`);
        for (const chunk of await chunksOf(layer)) {
            const lowest = !spoken && layer === tileLayers[0].layer;
            const solidTile = lowest ? guess(chunk.tiles) : -1;
            guessed ||= lowest;
            chunk.tiles.forEach((raw, i) => {
                const tile = raw & FLAGS, cx = chunk.x + (i % chunk.width), cy = chunk.y + Math.floor(i / chunk.width);
                boxes[0] = Math.min(boxes[0], cx);
                boxes[1] = Math.min(boxes[1], cy);
                boxes[2] = Math.max(boxes[2], cx + 1);
                boxes[3] = Math.max(boxes[3], cy + 1);
                const isSolid = lowest ? tile === solidTile : tile && (says.get(tile) ?? whole);
                if (isSolid) cells.set(`${cx},${cy}`, true);
                if (isSolid) taken++;
            });
        }
        if (!taken) open.add(layer.name);
    }
    if (tileLayers.length && cells.size) {
        if ((boxes[2] - boxes[0]) * (boxes[3] - boxes[1]) > MOST_SQUARES) throw new FormatError('the map is too large for this page');
        const solid = [];
        for (let cy = boxes[3] - 1; cy >= boxes[1]; cy--)
            solid.push(Array.from({ length: boxes[2] - boxes[0] }, (_, i) => cells.has(`${boxes[0] + i},${cy}`)));
        grid = { solid, size: tw, x0: boxes[0] * tw, y0: height - boxes[3] * th };
    }
    for (const { layer, says: whole, x, y } of layers)
        for (const object of layer.objects ?? []) {
            const own = ownLayer(layer.name), here = { ...object, x: object.x + x, y: object.y + y };
            items.push(...(own ? ownObject(own, here, height, counts) : objectItems(here, whole, height, counts, doors)));
        }
    for (const kind of ['range', 'snap']) {
        const value = Number(propertyOf(map, `sightline-${kind}`));
        if (value > 0) items.push({ kind, points: [], value });
    }
    const placed = doorItems(grid, doors, notes);
    if (grid) items.unshift(...gridWalls(grid.solid, grid.size, grid.x0, grid.y0));
    items.push(...placed);
    if (counts.ellipses) notes.push(`${plural(counts.ellipses, 'ellipse')}, taken as boxes`);
    if (open.size) notes.push(`layers of tiles without a solid one: ${[...open].join(', ')}`);
    if (guessed) notes.push('Nothing says what is solid: this is a guess from the lowest layer');
    if (!items.length) throw new FormatError('nothing in this Tiled map is solid');
    return { items, notes };
}
