/** The readers and small parts that need no browser. */
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { readGeoJson } from '../formats/geojson.js';
import { FormatError, parseMap, writeMap } from '../formats/map-text.js';
import { parsePlan } from '../formats/plan-text.js';
import { readMapFile } from '../formats/read.js';
import { parsePath, parseTransform } from '../formats/svg-path.js';
import { toHtml } from '../markdown.mjs';
import { Camera, roundStep } from '../parts/camera.js';
import { rampColour, rangeOf, valueAt } from '../parts/heat.js';
import { drawPlan, measureOutline, strokeLines } from '../parts/plan.js';
import { SvgSurface } from '../parts/svg-surface.js';
import { makeTones } from '../parts/tones.js';
import { MapDocument } from '../playground/document.js';
import { moveEnds, pick, snapTo } from '../playground/pick.js';
import { packMap, unpackMap } from '../playground/share.js';
import { isDoorName, isSolidName, isStartName, lists } from '../formats/words.js';
import { tellChange } from '../playground/told.js';
import { bakeNative, needsNative, shapes } from './native.mjs';

const root = join(dirname(fileURLToPath(import.meta.url)), '../../..');
const read = (text) => readMapFile(new TextEncoder().encode(text), () => assert.fail('not a .slv file'));

test('a precision is kept', () => {
    const text = 'sightline 1\nprecision 0.005\nwall 0 0 9 0\n';
    assert.equal(writeMap(parseMap(text)), text);
});

const maps = ['maps', 'maps/effects', 'maps/oblique'].flatMap((folder) =>
    readdirSync(join(root, folder)).filter((f) => /\.(map|txt)$/.test(f)).map((f) => join(root, folder, f)));

test('a map text that is read and written again bakes to the same', needsNative, () => {
    for (const path of maps.filter((p) => p.endsWith('.map'))) {
        const text = readFileSync(path, 'utf8'), again = writeMap(parseMap(text));
        assert.equal(writeMap(parseMap(again)), again);
        const [a, b] = bakeNative([['a.map', text], ['b.map', again]]);
        assert.deepEqual(b, a, path);
    }
});

test('an ASCII plan becomes the same cells as in the program', needsNative, () => {
    for (const path of maps.filter((p) => p.endsWith('.txt'))) {
        const text = readFileSync(path, 'utf8');
        const [a, b] = bakeNative([['a.txt', text], ['b.map', writeMap(parsePlan(text))]]);
        assert.deepEqual(shapes(b), shapes(a), path);
        assert.deepEqual(b.doors, a.doors);
        assert.deepEqual(b.starts, a.starts);
    }
});

test('the JSON export becomes the map that it was made of', needsNative, async () => {
    for (const path of maps.filter((p) => p.endsWith('.map'))) {
        const [a] = bakeNative([['a.map', readFileSync(path, 'utf8')]]);
        const { items } = await read(JSON.stringify(a));
        const [b] = bakeNative([['b.map', writeMap(items)]]);
        assert.deepEqual(shapes(b), shapes(a), path);
        assert.equal(b.pvs.flat().length, a.pvs.flat().length, path);
    }
});

test('a version of the JSON export that is not known is refused, as by the command', async () => {
    const map = { format: 'sightline', walls: [[0, 0, 9, 0]] };
    for (const version of [1, 2]) assert.equal((await read(JSON.stringify({ ...map, version }))).items.length, 1);
    assert.equal((await read(JSON.stringify(map))).items.length, 1);
    for (const version of [99, 0, 1.5, '2'])
        await assert.rejects(read(JSON.stringify({ ...map, version })), { name: 'FormatError', message: /version/ });
});

test('an outline has its area and its length', () => {
    assert.deepEqual(measureOutline([0, 0, 3, 0, 3, 4]), { area: 6, perimeter: 12 });
    assert.deepEqual(measureOutline([1e9, 1e9, 1e9, 1e9 + 2, 1e9 + 2, 1e9 + 2, 1e9 + 2, 1e9]), { area: -4, perimeter: 8 });
    assert.deepEqual(measureOutline([]), { area: 0, perimeter: 0 });
});

/** Levels of editors, as small as they can be. */
const tiled = {
    orientation: 'orthogonal', width: 5, height: 3, tilewidth: 16, tileheight: 16, tilesets: [],
    layers: [{ type: 'tilelayer', name: 'floor', width: 5, height: 3, data: Array(15).fill(9) },
        { type: 'tilelayer', name: 'Walls', width: 5, height: 3, data: [1, 1, 1, 1, 1, 1, 0, 0, 0, 1, 1, 1, 1, 1, 1] },
        { type: 'objectgroup', name: 'things', objects: [
            { id: 1, name: 'Player', type: '', x: 20, y: 20, width: 8, height: 8, rotation: 0, visible: true },
            { id: 2, name: 'back_door', type: '', x: 32, y: 16, width: 16, height: 16, rotation: 0, visible: true,
                properties: [{ name: 'open', type: 'bool', value: false }] }] }],
};
const ldtk = {
    jsonVersion: '1.5.3', defs: { layers: [{ uid: 7, identifier: 'Grid', type: 'IntGrid', intGridValues: [{ value: 2, identifier: 'wall' }] }] },
    levels: [0, 1].map((i) => ({ identifier: `L${i}`, worldX: 32 * i, worldY: 0, worldDepth: 0, pxWid: 32, pxHei: 24, layerInstances: [{
        __identifier: 'Grid', layerDefUid: 7, __type: 'IntGrid', __cWid: 4, __cHei: 3, __gridSize: 8, __pxTotalOffsetX: 0, __pxTotalOffsetY: 0,
        intGridCsv: [2, 2, 2, 2, 1, 1, 1, 1, 2, 2, 2, 2],
        entityInstances: i ? [{ __identifier: 'IronDoor', px: [8, 8], width: 8, height: 8, __pivot: [0, 0], fieldInstances: [] }]
            : [{ __identifier: 'Player', px: [4, 12], width: 8, height: 8, __pivot: [0.5, 0.5], fieldInstances: [] }] }] })),
};
const vtt = {
    format: 0.3, resolution: { map_origin: { x: 0, y: 0 }, map_size: { x: 8, y: 6 }, pixels_per_grid: 70 }, image: 'abc', lights: [],
    line_of_sight: [[[0, 0], [8, 0], [8, 6], [0, 6], [0, 0]], [[4, 0], [4, 2]], [[4, 3], [4, 6]]].map((l) => l.map(([x, y]) => ({ x, y }))),
    portals: [{ position: { x: 4, y: 2.5 }, bounds: [{ x: 4, y: 2 }, { x: 4, y: 3 }], rotation: 0, closed: true, freestanding: false }],
};

test('levels of Tiled, LDtk and Universal VTT become the same cells as in the program', needsNative, async () => {
    for (const [name, file, ...options] of [['a.tmj', tiled, '--doors'], ['a.ldtk', ldtk, '--map', 'all', '--doors'], ['a.dd2vtt', vtt, '--doors']]) {
        const text = JSON.stringify(file), { items } = await read(text);
        const [a, b] = bakeNative([[name, text, ...options], ['b.map', writeMap(items)]]);
        assert.deepEqual(shapes(b), shapes(a), name);
        assert.equal(a.doors.length, 1, name);
        assert.deepEqual([b.doors[0].segments, b.doors[0].open], [a.doors[0].segments, a.doors[0].open], name);
        assert.deepEqual(b.starts, a.starts, name);
    }
});

test('wrong map text names its line', () => {
    const wrong = [['wall 0 0 1 1', 1], ['sightline 2', 1], ['sightline 1\n\nWall 0 0 1 1', 3],
        ['sightline 1\nwall 0 0 1', 2], ['sightline 1\nwall 0 0 1 0x10', 2], ['sightline 1\nstart 1 2', 2],
        ['sightline 1\ndoor a 0 0', 2], ['sightline 1\nrange', 2]];
    for (const [text, line] of wrong)
        assert.throws(() => parseMap(text), (error) => error instanceof FormatError && error.line === line, text);
    assert.throws(() => parseMap('# nothing'), FormatError);
});

test('lines may end with CR alone, as for the program', () => {
    assert.equal(writeMap(parseMap('sightline 1\rwall 0 0 9 0\r')), 'sightline 1\nwall 0 0 9 0\n');
    assert.deepEqual(parsePlan('###\r#.#\r###\r'), parsePlan('###\n#.#\n###\n'));
});

test('comments and notes of a map text stay', () => {
    const text = 'sightline 1\n#! By me.\n# outer walls\nwall 0 0 1.5 -2e-7 solid\n';
    assert.equal(writeMap(parseMap(text)), text);
});

test('a Tiled map: solid layers, doors, starts', async () => {
    const { items, format } = await read(JSON.stringify(tiled));
    assert.equal(format, 'Tiled');
    const text = items.map((item) => `${item.kind} ${item.points}`);
    assert.ok(text.includes('start 24,24'), text.join('; '));
    assert.ok(text.includes('door 40,16,40,32'), text.join('; '));
    assert.equal(items.filter((item) => item.kind === 'wall').length, 4, text.join('; '));
    assert.equal(items.find((item) => item.kind === 'door').state, 'shut');
});

test('a Tiled map: doors that could stand nowhere are left out, and the page says so', async () => {
    const map = { orientation: 'orthogonal', width: 3, height: 3, tilewidth: 8, tileheight: 8, layers: [
        { type: 'tilelayer', name: 'walls', width: 3, height: 3, data: [1, 1, 0, 1, 1, 0, 0, 0, 0] },
        { type: 'objectgroup', name: 'things', objects: [{ name: 'door', x: 0, y: 0, width: 8, height: 8 }, { name: 'door', x: 20, y: 4, width: 0, height: 0 }] }] };
    const { items, notes } = await read(JSON.stringify(map));
    assert.equal(items.filter(({ kind }) => kind === 'door').length, 0);
    assert.match(notes.join(), /^2 doors in solid ground or of no size$/);
});

test('a Tiled map that says nothing is guessed, and the page says so', async () => {
    const map = { orientation: 'orthogonal', width: 2, height: 2, tilewidth: 8, tileheight: 8,
        layers: [{ type: 'tilelayer', name: 'a', width: 2, height: 2, data: [1, 0, 1, 1] }] };
    const { notes } = await read(JSON.stringify(map));
    assert.match(notes.join(), /guess/);
    map.layers[0].data = [1, 2, 1, 1];
    await assert.rejects(read(JSON.stringify(map)), /says what is solid/);
    map.layers[0].data = [1, 0, 1, 1];
    map.layers[0].properties = [{ name: 'walkable', value: 'false' }];
    assert.ok((await read(JSON.stringify(map))).items.length);
});

test('LDtk, Universal VTT and GeoJSON', async () => {
    const level = await read(JSON.stringify(ldtk));
    assert.equal(level.format, 'LDtk');
    assert.ok(level.items.some((item) => item.kind === 'start' && String(item.points) === '4,12'));
    const table = await read(JSON.stringify(vtt));
    assert.deepEqual(table.items.slice(1).map((item) => item.points), [[4, 6, 4, 4], [4, 3, 4, 0], [4, 4, 4, 3]]);
    assert.match(table.notes.join(), /picture/);
    const geo = readGeoJson({ type: 'FeatureCollection', features: [
        { type: 'Feature', properties: { kind: 'door', name: 'front', open: false }, geometry: { type: 'LineString', coordinates: [[0, 0], [1, 0]] } },
        { type: 'Feature', properties: null, geometry: { type: 'Polygon', coordinates: [[[0, 0], [2, 0], [2, 2], [0, 0]]] } },
        { type: 'Feature', properties: { kind: 'cell' }, geometry: { type: 'Polygon', coordinates: [] } }] });
    assert.deepEqual(geo.items.map((item) => item.kind), ['door', 'walls']);
    assert.match(geo.notes.join(), /1 cell, portal or region/);
    const bare = readGeoJson({ type: 'FeatureCollection', features: [{ type: 'LineString', coordinates: [[8.1234, 50], [8.1235, 50]] }] });
    assert.deepEqual([bare.items.length, bare.notes], [1, ['longitudes and latitudes, taken as plain units']]);
    const entity = { ...ldtk, levels: ldtk.levels.map((one) => ({ ...one, layerInstances: [...one.layerInstances, { __type: 'Entities', entityInstances: [{}] }] })) };
    assert.deepEqual((await read(JSON.stringify(entity))).items, level.items, 'what has no place is passed over');
});

test('files that are wrong are refused with words', async () => {
    const wrong = ['', 'hello', '{"a": 1}', '{', '<map/>', '#x#', '[]', 'null', '{"type": "Feature"}',
        '{"layers": 5, "tilewidth": 1}', '{"resolution": {}}', '{"jsonVersion": "1", "levels": [{}]}',
        '{"format": "sightline", "walls": 7}', '{"format": "sightline", "walls": []}', 'sightline 1\ntoString 1 2\n', 'slv is a format\n', '####\n',
        '{"type": "LineString", "coordinates": [[1e400, 0], [1, 1]]}', '{"type": "LineString", "coordinates": [[null, 0], [1, 1]]}',
        '{"format": "sightline", "walls": [[0, 0, 1]]}', '{"format": "sightline", "walls": [[0, 0, 1, 1]], "starts": [{}]}',
        '{"format": "sightline", "walls": [], "doors": [{"name": "a b", "segments": [[0, 0, 1, 1]]}]}'];
    for (const text of wrong)
        await assert.rejects(read(text), (error) => error instanceof FormatError && error.message.length > 10 && !/undefined|iterable|properties of/.test(error.message), text);
    const chunk = (x) => ({ x, y: 0, width: 1, height: 1, data: [1] });
    await assert.rejects(read(JSON.stringify({ ...tiled, infinite: true, layers: [{ type: 'tilelayer', name: 'walls', chunks: [chunk(-2e9), chunk(2e9)] }] })), /too large/);
    await assert.rejects(readMapFile(Uint8Array.of(255, 254, 0, 7), () => null), FormatError);
    for (const [text, told] of [
        ['  0\r\nSECTION\r\n  2\r\nHEADER\r\n', /DXF drawing\..* sightline convert plan\.dxf -o plan\.map$/],
        ['999\nmade by hand\n0\nSECTION\n2\nENTITIES\n', /DXF drawing\./], ['{"walls": [{"c": [0, 0, 1, 1]}]}', /scene of Foundry\..* sightline convert scene\.json -o plan\.map$/], ['AC1027\0\0', /DWG drawing: save it as ASCII DXF/],
        ['AutoCAD Binary DXF\r\n', /binary DXF/], ['IWAD\x01\x02', /WAD/], ['P5 3 1 255 abc', /picture/],
        ['resolution: 0.05\nimage: map.pgm\n', /map of ROS/], ['image: map.pgm\norigin: [0, 0, 0]\nresolution: 1\n', /map of ROS/],
    ])
        await assert.rejects(read(text), (error) => error instanceof FormatError && told.test(error.message), text);
});

test('paths of SVG', () => {
    assert.deepEqual(parsePath('M0 0h4v3H0z'), [[[0, 0], [4, 0], [4, 3], [0, 3], [0, 0]]]);
    assert.deepEqual(parsePath('m1 1 2 0m1 1l0 2'), [[[1, 1], [3, 1]], [[4, 2], [4, 4]]]);
    const [arc] = parsePath('M1 0A1 1 0 01-1 0');
    for (const [x, y] of arc) assert.ok(Math.abs(Math.hypot(x, y) - 1) < 1e-9);
    assert.ok(arc.some(([, y]) => y > 0.99));
    const [curve] = parsePath('M0 0C0 1 1 1 1 0S2-1 2 0');
    assert.deepEqual(curve[curve.length - 1], [2, 0]);
    assert.deepEqual(parseTransform('translate(1,2) rotate(90)'), [0, 1, -1, 0, 1, 2]);
});

test('a map goes into an address and back', async () => {
    const text = readFileSync(maps.find((p) => p.endsWith('office.map')), 'utf8');
    const fragment = await packMap(text);
    assert.ok(fragment.length < text.length);
    assert.equal(await unpackMap(`#${fragment}`), text);
    assert.equal(await unpackMap('#top'), null);
    await assert.rejects(unpackMap(`#${fragment.slice(0, 60)}`), /cannot be read/);
    for (const wrong of ['#m=%', '#m=', `#${fragment}.`, '#t=a%20b', 't='])
        await assert.rejects(unpackMap(wrong), /cannot be read/, wrong);
});

test('undo brings back each step, and a drag is one step', () => {
    const doc = new MapDocument(), wall = (x) => ({ kind: 'wall', points: [x, 0, x, 1] });
    doc.add(wall(0));
    const drag = {};
    for (const x of [1, 2, 3]) doc.change([wall(x)], drag);
    doc.add(wall(9));
    doc.undo();
    assert.deepEqual(doc.items, [wall(3)]);
    doc.undo();
    assert.deepEqual(doc.items, [wall(0)]);
    doc.redo();
    assert.deepEqual(doc.items, [wall(3)]);
    doc.undo();
    doc.undo();
    assert.deepEqual(doc.items, []);
    assert.equal(doc.canUndo, false);
});

test('joined ends move together; the nearest end is picked and snapped to', () => {
    const items = [{ kind: 'wall', points: [0, 0, 4, 0] }, { kind: 'walls', points: [4, 0, 4, 4, 8, 4] }];
    const moved = moveEnds(items, [4, 0], [5, 1]);
    assert.deepEqual(moved.map((i) => i.points), [[0, 0, 5, 1], [5, 1, 4, 4, 8, 4]]);
    assert.deepEqual(pick(items, 2, 0.1, 0.5), { index: 0, end: -1 });
    assert.deepEqual(pick(items, 7.9, 4, 0.5), { index: 1, end: 4 });
    assert.equal(pick(items, 20, 20, 1), null);
    assert.deepEqual(snapTo(items, 3.8, 0.1, 1, 0.5), [4, 0]);
    assert.deepEqual(snapTo(items, 1.26, 2.2, 0.1, 0.5), [1.3, 2.2]);
});

test('a camera goes to the screen and back', () => {
    const camera = new Camera(800, 600);
    camera.fit([0, 0, 100, 10]);
    camera.zoomAt(100, 100, 3);
    const [x, y] = camera.toMap(...camera.toScreen(12, 7));
    assert.ok(Math.abs(x - 12) < 1e-9 && Math.abs(y - 7) < 1e-9);
    assert.equal(roundStep(10, 9), 1);
    assert.equal(roundStep(100, 9), 0.1);
    assert.equal(roundStep(1, 30), 50);
});

test('a grid is drawn where numbers are farther from each other than its lines', () => {
    const lines = [[0, 0, 9, 9], [1e15, 0, 1e15 + 9, 9], [1e20, 0, 1e20, 9], [-1e20, -1e300, 0, 1e300]].map((bounds) => {
        const camera = new Camera(300, 300), surface = new SvgSurface(300, 300, 'Plan');
        camera.fit(bounds);
        drawPlan(surface, camera, { items: [], show: { grid: roundStep(camera.scale, 40) } }, makeTones(false));
        return surface.text().match(/M/g)?.length ?? 0;
    });
    assert.deepEqual(lines, [10, 10, 6, 10]);
});

test('colours are those of the pictures of the project', () => {
    const source = readFileSync(join(root, 'lib/draw/marks.c'), 'utf8');
    const named = Object.fromEntries([...source.matchAll(/(\w+) = (0x[0-9a-f]{6}),/g)].map((m) => [m[1], m[2]]));
    for (const dark of [false, true]) {
        const tones = makeTones(dark), body = source.split(`static sl_palette ${dark ? 'dark' : 'light'}(void)`)[1].split('\n}\n')[0];
        let compared = 0;
        for (const [, name, value] of body.matchAll(/\.(\w+) = rgb\((\w+)\)/g)) {
            const key = name.replace(/_(\w)/g, (_, c) => c.toUpperCase());
            if (tones[key] === undefined) continue;
            assert.equal(tones[key], (named[value] ?? value).replace('0x', '#'), name);
            compared++;
        }
        assert.ok(compared > 15);
    }
});

test('the ramp of heat maps is even in lightness, and values are found by their squares', () => {
    for (const dark of [false, true]) {
        const light = (share) => parseInt(rampColour(dark, share).slice(3, 5), 16);
        assert.ok(dark ? light(0) < light(0.5) && light(0.5) < light(1) : light(0) > light(0.5) && light(0.5) > light(1));
    }
    const heat = { step: 0.5, left: -2, bottom: 0, columns: 2, rows: 3, squares: Uint32Array.of(0, 2, 4), values: Float64Array.of(5, NaN, 7), ...rangeOf(Float64Array.of(5, NaN, 7)) };
    assert.deepEqual([heat.least, heat.most], [5, 7]);
    // A part with less than a tenth of the points of the largest one does not set the scale.
    const values = Float64Array.of(...Array(11).fill(5), 6, 70), sizes = Float64Array.of(...Array(12).fill(12), 1);
    assert.deepEqual(rangeOf(values, sizes), { least: 5, most: 6 });
    assert.deepEqual(rangeOf(values), { least: 5, most: 70 });
    assert.equal(valueAt(heat, [-1.1, 0.1]), 5);
    assert.ok(Number.isNaN(valueAt(heat, [-1, 1])));
    assert.equal(valueAt(heat, [-0.5, 0.6]), 7);
    assert.equal(valueAt(heat, [-0.5, 0]), undefined);
    assert.equal(valueAt(heat, [9, 9]), undefined);
});

test('Markdown as HTML', () => {
    const html = toHtml('# A `b`\n\nOne *two* [x](y.md) <i>\nmore\n\n- a\n  b\n- c\n\n| a | b |\n| - | - |\n| 1 | `x` |\n\n```sh\n$ <a>\n```', (t) => (t === 'y.md' ? 'y.html' : null));
    for (const part of ['<h1 id="a-b">A <code>b</code></h1>', '<em>two</em> <a href="y.html">x</a> &lt;i&gt;\nmore', '<li>a b</li>',
        '<td><code>x</code></td>', '$ &lt;a&gt;'])
        assert.ok(html.includes(part), `${part} in ${html}`);
});

test('what a step has done is told by kind, name and place', () => {
    const items = (statement) => parseMap(`sightline 1\n${statement}\n`);
    assert.equal(tellChange([], items('wall 0 0 3 4')), 'Added: wall from 0, 0 to 3, 4, length 5');
    assert.equal(tellChange([], items('object crate 4 4 5 5')), 'Added: object crate from 4, 4 to 5, 5');
});

test('very many lines: equal ones are drawn once, others all, in several paths', () => {
    const camera = new Camera(800, 600);
    camera.fit([0, 0, 100, 75]);
    const drawn = (lines) => {
        const count = { lines: 0, paths: 0 };
        const surface = { beginPath() {}, setLineDash() {}, moveTo() { count.lines++; }, lineTo() {}, stroke() { count.paths++; } };
        strokeLines(surface, camera, lines, 'black', 1);
        return count;
    };
    const many = (n, line) => Array.from({ length: n }, (_, i) => line(i));
    assert.deepEqual(drawn(many(30000, () => [10, 10, 60, 40])), { lines: 1, paths: 1 });
    assert.deepEqual(drawn(many(30000, (i) => [10, 10, 60, 40 + i / 1000])), { lines: 30000, paths: 30 });
    assert.deepEqual(drawn(many(2000, () => [10, 10, 60, 40])), { lines: 2000, paths: 1 });
});

test('objects of Tiled that are pictures stand on their place, and what a tile or value is taken for is said', async () => {
    const thing = { x: 8, y: 16, width: 8, height: 8 };
    const map = { tilewidth: 8, tileheight: 8, width: 2, height: 2, layers: [
        { type: 'tilelayer', name: 'floor', width: 2, height: 2, data: [1, 1, 1, 1] },
        { type: 'objectgroup', name: 'walls', objects: [{ ...thing, gid: 1 }, { ...thing, y: 8 }, { ...thing, name: 'Player', gid: 1 }] }],
    tilesets: [{ firstgid: 2, tiles: [{ id: 0, objectgroup: { objects: [thing] } }] }] };
    const { items, notes } = await read(JSON.stringify(map));
    assert.deepEqual(items.map(({ kind, points }) => [kind, ...points]),
        [['solid', 8, 8, 16, 8, 16, 0, 8, 0], ['solid', 8, 8, 16, 8, 16, 0, 8, 0], ['start', 12, 4]]);
    assert.deepEqual(notes, ['1 tile with shapes of collision: each is solid as a whole', 'layers of tiles without a solid one: floor']);
    const values = [{ value: 1, identifier: 'wall' }, { value: 2, identifier: 'water' }];
    const layer = { __type: 'IntGrid', __identifier: 'grid', __gridSize: 8, __cWid: 2, __cHei: 1, layerDefUid: 1, intGridCsv: [1, 0] };
    const project = (intGridValues) => JSON.stringify({ jsonVersion: '1', defs: { layers: [{ uid: 1, intGridValues }] },
        levels: [{ pxWid: 16, pxHei: 8, layerInstances: [layer] }] });
    assert.deepEqual((await read(project(values))).notes, ['solid are the values wall, and open water']);
    assert.deepEqual((await read(project(values.slice(1)))).notes, ['all values are solid: water']);
});

test('words that name things are those of the command', () => {
    const source = readFileSync(join(root, 'lib/io/parts/names.c'), 'utf8').replace(/\/\/.*/g, '');
    for (const [name, words] of Object.entries(lists)) {
        const body = source.split(`static const char *const ${name}[] = {`)[1].split('};')[0];
        assert.deepEqual([...words], [...body.matchAll(/"([^"]+)"/g)].map(([, word]) => word), name);
    }
    const which = (is, names) => names.filter(is);
    assert.deepEqual(which(isSolidName, ['WallTops', 'Collisions', 'Kollision', 'not walkable', 'walkable', 'no wall', '当たり判定']),
        ['Collisions', 'Kollision', 'not walkable', '当たり判定']);
    assert.deepEqual(which(isStartName, ['Entrance', 'Player_1', 'PlayerHouse', 'start point']), ['Entrance', 'Player_1', 'start point']);
    assert.deepEqual(which(isDoorName, ['door_left', 'FrontDoor', 'trap door', 'doorbell', 'Gate']), ['door_left', 'FrontDoor', 'Gate']);
});
