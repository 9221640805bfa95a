/** Questions of chapter 10: quadrants, neighbours, and work that follows what is found. */
import { fillPolygons } from '../../parts/plan.js';
import { drawText } from '../maps.js';
import { choice, number, planPicture } from './ask.js';
import { roomsOf } from './chance.js';

const quadrants = { 'right and up': [1, 1], 'left and up': [-1, 1], 'left and down': [-1, -1], 'right and down': [1, -1] };
const [COLUMNS, ROWS] = [4, 3];

function directed(chance, lab) {
    const { plan, scene, room, name, count } = chance.until(() => {
        const rooms = roomsOf(chance, COLUMNS, ROWS), map = () => lab.scene(rooms.text), at = [chance.whole(0, COLUMNS - 1), chance.whole(0, ROWS - 1)], way = chance.of(Object.keys(quadrants)), [sx, sy] = quadrants[way];
        if (map().insideCount !== COLUMNS * ROWS) return null;
        const cellOf = (x, y) => map().locate(4 * x + 2, 4 * y + 2), seen = new Set(map().row(cellOf(...at))), all = [];
        for (let x = at[0]; x >= 0 && x < COLUMNS; x += sx) for (let y = at[1]; y >= 0 && y < ROWS; y += sy) if (seen.has(cellOf(x, y))) all.push([x, y]);
        return all.length > 1 ? { plan: rooms, scene: map, room: at, name: way, count: all.length } : null;
    });
    return number(`Each room is a view cell. How many rooms does the marked one see by sightlines that go ${name}? It counts itself.`, count, 'Sightlines to these rooms leave by two of its sides only.',
        'Look at rooms on this side of the marked one, in its own row and column too.', planPicture('Rooms in a grid', plan, {}, { scene, from: scene().locate(4 * room[0] + 2, 4 * room[1] + 2) }));
}

/** Rooms in a grid, with numbers. */
const numbered = (columns, rows, marked) => ({ title: 'View cells with numbers', box: [0, 0, 4 * columns, 4 * rows], draw(surface, camera, tones) {
    for (let i = 0; i < columns * rows; i++) {
        const [x, y] = [4 * (i % columns), 4 * Math.floor(i / columns)];
        fillPolygons(surface, camera, [[x + 0.1, y + 0.1, x + 3.9, y + 0.1, x + 3.9, y + 3.9, x + 0.1, y + 3.9]], i === marked ? tones.source : tones.floor[0]);
        drawText(surface, camera, [x + 2, y + 2], String(i), tones);
    }
} });

function waits(chance) {
    const columns = chance.whole(3, 6), rows = chance.whole(2, 4), room = chance.whole(0, columns * rows - 1), name = chance.of(Object.keys(quadrants)), [sx, sy] = quadrants[name];
    const [x, y] = [room % columns, Math.floor(room / columns)], count = (x + sx >= 0 && x + sx < columns ? 1 : 0) + (y + sy >= 0 && y + sy < rows ? 1 : 0);
    return number(`A pass takes sightlines that go ${name}. For how many neighbours does view cell ${room} wait?`, count, 'It waits for the neighbours that such a sightline can enter next.',
        'Which sides can a sightline of these directions leave by? Is there a neighbour?', numbered(columns, rows, room));
}

function first(chance) {
    const columns = chance.whole(3, 6), rows = chance.whole(2, 4), name = chance.of(Object.keys(quadrants)), [sx, sy] = quadrants[name];
    const corners = [[0, 0], [1, 0], [0, 1], [1, 1]].map(([x, y]) => x * (columns - 1) + y * (rows - 1) * columns), right = (sx > 0 ? 1 : 0) + (sy > 0 ? 2 : 0);
    return choice(`A pass takes sightlines that go ${name}. Which view cell is done first?`, corners.map((room) => [`View cell ${room}.`, 'The first one has no neighbour in these directions, so it waits for nobody.']), right, numbered(columns, rows, -1));
}

function passes(chance) {
    const axes = chance.whole(2, 8);
    return number(`How many passes does the method need with ${axes} axes?`, 2 ** axes, `Each axis has two signs: 2^${axes}.`, 'With two axes there are four quadrants. Each further axis doubles them.');
}

export const kinds = [directed, waits, first, passes];
