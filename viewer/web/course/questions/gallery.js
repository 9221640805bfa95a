/** Questions of chapter 14: corners, triangles and guards of galleries. */
import { drawDot, drawPlan, fillPolygons, strokeLines } from '../../parts/plan.js';
import { floorOf } from '../gallery.js';
import { drawText } from '../maps.js';
import { number, yesNo } from './ask.js';
import { galleryOf, nichesOf } from './chance.js';

const textOf = (points) => `sightline 1\nwalls ${[...points, points[0]].flat().join(' ')}\n`;

const picture = (points, marks = {}) => ({ title: 'A gallery', box: [0, 0, 18, 12], draw(surface, camera, tones) {
    drawPlan(surface, camera, {}, tones);
    fillPolygons(surface, camera, [points.flat()], tones.floor[0]);
    strokeLines(surface, camera, [points.flat()], tones.wall, 3, [], true);
    for (const [letter, at] of Object.entries(marks)) {
        drawDot(surface, camera, at, 7, tones.sourceEdge, tones.page);
        drawText(surface, camera, at, letter, tones, 14, -10);
    }
} });

function enough(chance) {
    const corners = chance.whole(10, 100);
    return number(`A gallery without holes has ${corners} corners. How many guards are always enough?`, Math.floor(corners / 3), `${corners} / 3, rounded down: the rarest of three colours has no more corners.`, 'Three colours share the corners, and guards come whole.');
}

function triangles(chance) {
    const points = galleryOf(chance, 8, 14);
    return number('Into how many triangles is this gallery cut, from corner to corner?', points.length - 2, `It has ${points.length} corners. Each ear takes one off, and three make the last triangle.`, 'Count its corners first.', picture(points));
}

async function watched(chance) {
    const isWanted = chance.next() < 0.5;
    for (let tries = 0; tries < 500; tries++) {
        const points = chance.next() < 0.5 ? galleryOf(chance, 7, 10) : nichesOf(chance, 2), floor = await floorOf(textOf(points)), names = ['A', 'B'], places = names.map(() => chance.of(points));
        if (places[0] === places[1]) continue;
        const { areas } = floor.cover(places.map(([x, y]) => ({ x, y }))), blind = areas[0] / areas.reduce((a, b) => a + b);
        if (isWanted ? blind === 0 : blind > 0.04)
            return yesNo('Guards stand at the corners A and B. Do they see all of the floor?', isWanted, isWanted ? 'Each place of the floor is seen from A or from B.' : `They leave ${Math.round(100 * blind)} % of the floor unseen.`, picture(points, Object.fromEntries(names.map((name, i) => [name, places[i]]))));
    }
    throw new Error('no question of this kind was found');
}

async function fewest(chance) {
    for (let tries = 0; tries < 50; tries++) {
        const points = nichesOf(chance, chance.whole(2, 4)), { lower, upper } = (await floorOf(textOf(points))).place({ timeLimit: 2 });
        if (lower === upper) return number('What is the fewest number of guards for this gallery? They may stand anywhere.', upper, `${upper} can see everything, and the library has proved that no fewer can.`, 'Look for places of which no guard can see two: each needs its own.', picture(points));
    }
    throw new Error('no question of this kind was found');
}

export const kinds = [enough, triangles, watched, fewest];
