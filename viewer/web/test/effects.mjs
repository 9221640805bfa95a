/**
 * What the playground shows of a map with effects: node effects.mjs SITE MAP X,Y ...
 * Prints JSON: for each eye the number of cells, the area that it sees, and the areas that it sees in
 * mirrors; what the heat map says, '' for nothing; the areas that are seen from a line, and the length of a
 * way, or why not. The table of tools/EFFECTS.md is checked by it.
 */
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [site, map, ...eyes] = process.argv.slice(2);
const part = (path) => import(pathToFileURL(join(resolve(site), path)));

/** @param {Float64Array} p x, y ... */
const areaOf = (p) => {
    let sum = 0;
    for (let i = 2; i + 3 < p.length; i += 2)
        sum += (p[i] - p[0]) * (p[i + 3] - p[1]) - (p[i + 2] - p[0]) * (p[i + 1] - p[1]);
    return Math.abs(sum) / 2;
};

/** What is asked answers, or why not. */
function tried(ask) {
    try {
        return { answer: ask() };
    } catch (error) {
        return { refused: error.message };
    }
}

const LINE = [[2, 2], [8, 8]], WAY = [[28, 8], [2, 2]];

const text = readFileSync(map, 'utf8');
const { Core } = await part('core/core.js');
const core = await Core.load();
core.bake(text, {});
const seen = eyes.map((eye) => {
    const found = core.look(eye.split(',').map(Number));
    return { cells: found.kept, area: areaOf(found.region), mirrored: found.mirrored.map(areaOf) };
});
let heat = '';
try {
    const graph = (await (await part('package/graph.js')).load({ memory: 2 ** 31 })).graph(text, { grid: 2 });
    graph.values('connectivity');
    graph.close();
} catch (error) {
    heat = error.message;
}
const floor = (await (await part('package/ways.js')).load({ memory: 2 ** 30 })).open(text);
const line = { ends: LINE, ...tried(() => ['some', 'all'].map((from) => floor.regionFrom(LINE, { seen: from }).area)) };
const way = { ends: WAY, ...tried(() => floor.path(...WAY)?.length ?? null) };
console.log(JSON.stringify({ seen, heat, line, way }));
