/**
 * Reads a file of any format that the page knows. The content decides, not the ending of the name.
 */
import { readBaked } from './baked.js';
import { readGeoJson } from './geojson.js';
import { readLdtk } from './ldtk.js';
import { FormatError, parseMap, writeMap } from './map-text.js';
import { isPlan, parsePlan } from './plan-text.js';
import { readSvg } from './svg.js';
import { readTabletop } from './tabletop.js';
import { readTiled } from './tiled.js';
import { tiledFromXml } from './tiled-xml.js';

/**
 * @typedef {Object} Reading
 * @property {import('./map-text.js').Item[]} items
 * @property {string[]} notes what was left out or guessed
 * @property {string} format
 */

/** Also a file whose first byte a program has changed. */
const isSlv = (bytes) => /^[^\0-\x7f]{1,3}SLV/.test(String.fromCharCode(...bytes.subarray(0, 8)));

/** Files that the page does not read, by their first bytes: what they are, and a name for the command if it does. */
const others = [
    [/^AC10\d\d/, 'a DWG drawing: save it as ASCII DXF in the program that it is from'],
    [/^AutoCAD Binary DXF/, 'a binary DXF drawing: save it as ASCII DXF'],
    [/^(\s*999\r?\n.*\n)*\s*0\s*\n\s*SECTION\s/, 'a DXF drawing', 'plan.dxf'],
    [/^[IP]WAD/, 'a WAD of Doom', 'levels.wad'],
    [/^(\x89PNG|P[1-6]\s)/, 'a picture', 'plan.png'],
    [/^(?=[^]*^image:)[^]*^resolution:/m, 'a map of ROS', 'map.yaml'],
];

const byCommand = (name) => `. The page does not read it, the command does: sightline convert ${name} -o plan.map`;

/** @param {Uint8Array} bytes */
function refuseOthers(bytes) {
    const start = String.fromCharCode(...bytes.subarray(0, 2000));
    for (const [known, what, name] of others)
        if (known.test(start))
            throw new FormatError(`this is ${what}${name ? byCommand(name) : ''}`);
}

/** @returns {[string, (file: any) => any]} */
function jsonReader(file) {
    if (file?.format === 'sightline') return ['the JSON export', readBaked];
    if (file?.layers && file.tilewidth) return ['Tiled', readTiled];
    if (file?.jsonVersion || file?.__header__ || file?.layerInstances) return ['LDtk', readLdtk];
    if (file?.line_of_sight || file?.resolution) return ['Universal VTT', readTabletop];
    if (/^(Feature|FeatureCollection|GeometryCollection|(Multi)?(Point|LineString|Polygon))$/.test(file?.type))
        return ['GeoJSON', readGeoJson];
    if (Array.isArray(file?.walls)) throw new FormatError(`this is a scene of Foundry${byCommand('scene.json')}`);
    throw new FormatError('this JSON is none of Tiled, LDtk, Universal VTT, GeoJSON or the JSON export');
}

/** Reads text of any format but .slv. @param {Uint8Array} bytes @returns {Promise<Reading>} */
async function readText(bytes) {
    let text;
    try {
        text = new TextDecoder('utf-8', { fatal: true }).decode(bytes);
    } catch {
        throw new FormatError('this file is not text. The page reads map text, ASCII plans, .slv, Tiled ' +
            'maps, LDtk, Universal VTT, SVG and GeoJSON; the sightline command reads more');
    }
    const start = text.trimStart();
    if (start.startsWith('{') || start.startsWith('[')) {
        let file;
        try {
            file = JSON.parse(text);
        } catch (error) {
            throw new FormatError(`this is not JSON that can be read: ${error.message}`);
        }
        const [format, read] = jsonReader(file);
        return { format, ...(await read(file)) };
    }
    if (start.startsWith('<') && /<svg[\s>]/i.test(start.slice(0, 4000))) return { format: 'SVG', ...readSvg(text) };
    if (start.startsWith('<') && /<map[\s>]/.test(start.slice(0, 4000))) return { format: 'Tiled', ...(await readTiled(tiledFromXml(text))) };
    if (start.startsWith('<')) throw new FormatError('XML files but SVG and Tiled maps are not read here');
    if (isPlan(text)) return { format: 'an ASCII plan', items: parsePlan(text), notes: [] };
    return { format: 'map text', items: parseMap(text), notes: [] };
}

/** Items as map text has them: what it cannot hold is refused before it takes the place of the map. @param {Reading} reading */
function checked(reading) {
    if (!reading.items.length) throw new FormatError('nothing in this file is a wall');
    try {
        return { ...reading, items: parseMap(writeMap(reading.items)) };
    } catch (error) {
        throw error instanceof FormatError ? new FormatError(error.words) : error;
    }
}

/**
 * @param {Uint8Array} bytes
 * @param {(bytes: Uint8Array) => Promise<any>} describe the core's JSON of a .slv file
 * @returns {Promise<Reading>}
 */
export async function readMapFile(bytes, describe) {
    const baked = isSlv(bytes) ? await describe(bytes) : null;
    if (!baked) refuseOthers(bytes);
    try {
        const reading = baked ? { format: 'a .slv file', ...readBaked(baked) } : await readText(bytes);
        return reading.format === 'map text' ? reading : checked(reading);
    } catch (error) {
        if (error instanceof FormatError || error instanceof RangeError) throw error;
        throw new FormatError('a part of this file is not as its format wants it. The command says which one: sightline info FILE');
    }
}
