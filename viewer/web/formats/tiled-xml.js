/**
 * Tiled maps as XML (.tmx), as the JSON that Tiled writes of the same map: tiled.js reads both.
 */
import { FormatError } from './map-text.js';

/** The elements of a name within an element, in order. */
const inside = (node, ...names) => [...node.children].filter((child) => names.includes(child.localName));

/** All attributes; those that JSON has as numbers are numbers. */
function attributesOf(node, texts = ['name', 'type', 'class', 'value', 'source', 'template', 'encoding', 'compression', 'orientation']) {
    const found = {};
    for (const { localName, value } of node.attributes)
        found[localName] = texts.includes(localName) || !value.trim() || !Number.isFinite(Number(value)) ? value : Number(value);
    return found;
}

const propertiesOf = (node) => inside(node, 'properties').flatMap((list) => inside(list, 'property')).map((property) => {
    const { name, type, value = property.textContent } = attributesOf(property);
    return { name, type, value: type === 'bool' ? value === 'true' : type === 'int' || type === 'float' ? Number(value) : value };
});

const pointsOf = (node) => (node.getAttribute('points') ?? '').trim().split(/\s+/).map((pair) => {
    const [x, y] = pair.split(',').map(Number);
    if (!Number.isFinite(x) || !Number.isFinite(y)) throw new FormatError(`points: expected x,y, found '${pair}'`);
    return { x, y };
});

function objectOf(node) {
    const object = { x: 0, y: 0, ...attributesOf(node), properties: propertiesOf(node) };
    for (const shape of inside(node, 'polygon', 'polyline')) object[shape.localName] = pointsOf(shape);
    for (const mark of inside(node, 'ellipse', 'point', 'text')) object[mark.localName] = true;
    return object;
}

/** Numbers of tiles, or packed text that tiled.js unpacks. */
function tilesIn(node, encoding) {
    if (!encoding) return inside(node, 'tile').map((tile) => Number(tile.getAttribute('gid') ?? 0));
    if (encoding !== 'csv') return node.textContent;
    return node.textContent.split(',').map((word) => {
        if (!/^\s*\d+\s*$/.test(word)) throw new FormatError(`tile data: expected a number, found '${word.trim()}'`);
        return Number(word);
    });
}

function tileLayerOf(node) {
    const [data] = inside(node, 'data');
    if (!data) throw new FormatError(`the layer ${node.getAttribute('name') ?? ''} has no tile data`);
    const { encoding, compression } = attributesOf(data), chunks = inside(data, 'chunk');
    if (chunks.length)
        return { encoding, compression, chunks: chunks.map((chunk) => ({ ...attributesOf(chunk), data: tilesIn(chunk, encoding) })) };
    return { encoding, compression, data: tilesIn(data, encoding) };
}

const layersOf = (node) => inside(node, 'layer', 'objectgroup', 'group').map((layer) => {
    const kind = layer.localName, own = { ...attributesOf(layer), properties: propertiesOf(layer) };
    if (kind === 'group') return { ...own, type: 'group', layers: layersOf(layer) };
    if (kind === 'layer') return { ...own, type: 'tilelayer', ...tileLayerOf(layer) };
    return { ...own, type: 'objectgroup', objects: inside(layer, 'object').map(objectOf) };
});

const tilesetOf = (node) => ({
    ...attributesOf(node),
    properties: propertiesOf(node),
    tiles: inside(node, 'tile').map((tile) => ({
        ...attributesOf(tile), properties: propertiesOf(tile),
        objectgroup: { objects: inside(tile, 'objectgroup').flatMap((group) => inside(group, 'object').map(objectOf)) },
    })),
});

/** @param {string} text @returns {any} the map as Tiled's JSON has it */
export function tiledFromXml(text) {
    const page = new DOMParser().parseFromString(text, 'application/xml'), map = page.documentElement;
    if (page.querySelector('parsererror') || map.localName !== 'map' || !map.getAttribute('tilewidth'))
        throw new FormatError('this is not a Tiled map that can be read');
    return { ...attributesOf(map), properties: propertiesOf(map), tilesets: inside(map, 'tileset').map(tilesetOf), layers: layersOf(map) };
}
