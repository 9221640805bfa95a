/**
 * One house through all chapters: each chapter opens with a puzzle about it. Most people miss it at first. The remark says which
 * part of the chapter helps, and the library has the answer. Exercises as in exercise.js, by the name of the chapter.
 */
import { t } from '../language/language.js';
import { drawDot, drawPlan } from '../parts/plan.js';
import { floorOf } from './gallery.js';
import { loadGround, wayBetween } from './ground.js';
import { cellAt } from './lab.js';
import { drawText, drawWalls, house, itemsOf } from './maps.js';
import { pivotsOf } from './rotate.js';

const items = itemsOf(house.text), { text, box } = house;

const baked = (lab, options) => lab.scene(text, options);

/** Pairs of cells that see each other, each way, and each cell with itself. */
const pairsOf = (lab, options) => baked(lab, options).account.pairs;

/** Rooms by name, each with a place in it. */
const places = { hall: [8, 6.2], study: [3, 11], kitchen: [12, 2.5], bedroom: [21, 12], bath: [11.5, 12.5], store: [3, 1.5], larder: [21, 2], A: [17, 8], B: [18.5, 10] };

const pointOf = ([x, y]) => ({ x, y });

const cellOf = (lab, name) => cellAt(baked(lab), places[name]);

/** The house with names of rooms; with cells or with dots, if the question is about them. @param {'cells' | 'dots' | ''} shown */
const sketchOf = (names, shown) => (surface, camera, tones, lab) => {
    drawPlan(surface, camera, shown === 'cells' ? { space: baked(lab) } : {}, tones);
    drawWalls(surface, camera, items, tones);
    for (const name of names) {
        if (shown === 'dots') drawDot(surface, camera, places[name], 5, tones.to, tones.page);
        drawText(surface, camera, places[name], name, tones, 0, shown === 'dots' ? 15 : 0);
    }
};

const number = (question, names, shown, right, why, low, high) => ({ kind: 'number', question, right, why, low, high, box, sketch: sketchOf(names, shown) });

/** Dots to put somewhere; `names` are dots that stay. `faultOf(scene, places)` says what is wrong, or nothing. */
function put(question, handles, solution, names, why, faultOf) {
    const figure = { title: 'The house.', about: 'Drag the dots, then press Check.', box, handles,
        update() {},
        draw: sketchOf(names, 'dots'),
        tell: (state) => `${handles.map(({ name, letter = 'Eye' }) => t`${letter} at ${state[name].map((v) => Number(v.toFixed(1))).join(', ')}`).join('; ')}.` };
    return { kind: 'place', question, solution, figure, why,
        judge(state, lab) {
            const given = handles.map(({ name }) => state[name]), scene = baked(lab);
            const fault = given.some((place) => cellAt(scene, place) < 0) ? t('A dot stands on no floor.') : faultOf(scene, ...given);
            return fault ? { right: false, text: fault } : { right: true, text: t(why) };
        } };
}

export const puzzles = {
    here: put('Stand where you see the dot in the bath and the dot in the bedroom.', [{ name: 'eye', at: [8, 6.2] }], [[14.1, 9.3]], ['bath', 'bedroom'],
        'Few places see both. They are where the visible regions of the two dots meet.',
        (scene, eye) => {
            const missing = ['bath', 'bedroom'].filter((name) => !scene.canSee(pointOf(eye), pointOf(places[name])));
            return missing.length ? `You do not see the ${missing.join(', nor the ')}. To see is to be seen: what does each dot see itself? Read about visible regions, and come back.` : '';
        }),
    rooms: number('The library cuts this house into convex cells, whose sides have no wall inside. How many does it take?', [], '', (lab) => baked(lab).insideCount,
        'Each split goes through its whole box. So some rooms are cut that are convex already.',
        'It takes more. Rooms alone do not count: the hall is not convex, and each split goes through its whole box. The kd-tree of this chapter shows it.',
        'It takes fewer. One split along a wall may serve several rooms: see the rules of the kd-tree.'),
    lines: put('Put A into the store and B into the bedroom, so that they see each other.', [{ name: 'a', at: [4, 1], tone: 'from', letter: 'A' }, { name: 'b', at: [22.5, 12.8], tone: 'to', letter: 'B' }],
        [[0.3, 2.96], [21, 10.6]], ['store', 'bedroom'], 'The line passes all portals between them. Left ends lie to its left, right ends to its right.',
        (scene, a, b) => {
            if (scene.locate(...a) !== scene.locate(...places.store) || scene.locate(...b) !== scene.locate(...places.bedroom)) return t('A must be in the store, and B in the bedroom.');
            return scene.canSee(pointOf(a), pointOf(b)) ? '' : t('A wall is in the way. There is a line, but to move points is a slow way to find it. Look for the line, not for the points: the conditions of this chapter say which ends must lie to its left.');
        }),
    program: number('A line leads from the store to the bedroom through one way of portals. How many conditions must it meet?', ['store', 'bedroom'], 'cells',
        (lab) => 2 * baked(lab).explain(cellOf(lab, 'store'), cellOf(lab, 'bedroom')).sequence.length,
        'The sequence has half as many portals, and each of them has two ends. Each end is a row of the program.',
        'Each portal has two ends, and each end is a condition. Count portals where cells were cut in the open, too.',
        'Only ends of portals count, not all corners of the cells on the way.'),
    search: number('How many cells does the store see, itself included?', ['store'], 'cells', (lab) => baked(lab).row(cellOf(lab, 'store')).length,
        'Some of them are seen along one narrow line only. A search over sequences forgets none of them.',
        'There are more. Some are seen by a narrow line only. Who tries all sequences of portals, as in this chapter, does not forget them.',
        'Too many: some cells have a door in view, and still no line leads in. Test whole sequences, as in this chapter.'),
    rounding: {
        kind: 'choice', box, sketch: sketchOf(['study', 'larder'], 'cells'),
        question: 'A line from the study to the larder touches ends of walls on both sides. Now one of these walls is pushed into the line by a millionth of a millimetre. What becomes of the two rooms?',
        options: [
            ['Nothing: so small a push is less than any wall is thick.', 'On the map walls have no thickness, and there was no room at all. This chapter shows what follows.'],
            ['They do not see each other any more, and a program must notice.', 'The line had no room to spare. So any push counts, and only exact signs can tell.'],
            ['It depends on the computer.', 'It should not! With rounded signs it may, and this chapter shows how. The true answer does not.'],
        ],
        right: (lab) => (baked(lab).row(cellOf(lab, 'study')).includes(cellOf(lab, 'larder')) && !baked(lab, { sight: 'open' }).row(cellOf(lab, 'study')).includes(cellOf(lab, 'larder')) ? 1 : -1),
    },
    hidden: number('The study does not see the bedroom. Take the way that comes nearest to it. How few ends of portals prove that no line passes?', ['study', 'bedroom'], 'cells',
        (lab) => baked(lab).explain(cellOf(lab, 'study'), cellOf(lab, 'bedroom')).misses[0].ends.length,
        'Two left ends and two right ends are in conflict, whatever the others do.',
        'With fewer, a line in some direction would still pass. Count left and right ends that cross: this chapter says why.',
        'Fewer are enough. There is a theorem about that in this chapter.'),
    sweep: number('About how many corners of this house can a line rotate, so that it goes on at both sides of the corner?', [], '', (lab) => pivotsOf(baked(lab, { sight: 'open' })).length,
        'They are the ends of walls, and the corners of walls that jut into the floor.',
        'There are more. Each end of a wall counts where a door begins or ends.',
        'There are fewer. At the corner of a room the free angle is too small, and at the foot of a wall it is just half a turn.'),
    view: number('An eye at 8, 6.2 in the hall looks to the right with a view cone of 60°. How many cells does it see, its own included?', ['hall'], 'cells',
        (lab) => baked(lab).look(...places.hall, { heading: 0, fov: 60, method: 'exact' }).length,
        'Its cell sees nearly all of them. The cone, and the portals on the way, leave these.',
        'The cone is wide enough for more. Follow it from portal to portal, as the exact method does.',
        'Cells that the cone meets may lie behind a wall. The last method of this chapter asks for a ray through all portals on the way.'),
    regions: number('Each cell looks at each cell, itself included. How many times does it see it?', [], 'cells', (lab) => pairsOf(lab),
        'To test all pairs works here. In a building of a thousand cells there are a million.',
        'There are more: cells are seen through many doors. Would you like to test them one by one? This chapter asks neighbours instead.',
        'There are fewer. The study and the store look into one side of the house only.'),
    frames: number('An eye goes from A to B, around the end of a wall. How many cells appear or vanish?', ['A', 'B'], 'cells',
        (lab) => {
            const [a, b] = [places.A, places.B].map((eye) => baked(lab).look(...eye)), only = (x, y) => [...x].filter((cell) => !y.includes(cell)).length;
            return only(a, b) + only(b, a);
        },
        'All others keep their state. That is why a frame should begin where the last one ended.',
        'More of them do: the wall hid rooms on its other side.',
        'Most cells keep their state from step to step. This chapter lives on that.'),
    effects: number('A door is put between the hall and the three rooms in the west, from 6, 5 to 6, 7, and shut. How many cells does the study still see, itself included?', ['hall', 'study', 'store'], '',
        (lab) => {
            const scene = lab.scene(`${text}door west 6 5 6 7 shut\n`);
            return scene.row(cellAt(scene, places.study)).length;
        },
        'All other sightlines need the door, so they carry its name in their door sets.',
        'The rooms in the west still see each other: their sightlines do not need the door.',
        'Every line to the east passes the door. This chapter stores such doors beside each pair.'),
    cost: number('The method flood asks only if each two portals of a way can be passed. Count pairs of cells both ways, and each cell with itself. How many of those that flood finds in this house are wrong?', [], 'cells',
        (lab) => pairsOf(lab, { method: 'flood' }) - pairsOf(lab),
        'They are ways whose portals can be passed two by two, and not all together.',
        'More are wrong. How many does an exact method find? This chapter runs them all.',
        'Fewer are wrong. How many does an exact method find? This chapter runs them all.'),
    gallery: number('How many guards does this house need, so that together they see all of its floor?', [], '', async () => (await floorOf(text)).place().upper,
        'So many are enough, and there are witnesses that need so many.',
        'Try to place them: some room stays dark. This chapter shows how to prove that so few cannot do.',
        'Fewer can do it. A guard in a doorway sees two rooms.'),
    ways: number('How often does the shortest way from the dot in the store to the dot in the bath turn?', ['store', 'bath'], 'dots',
        async () => {
            await loadGround();
            return wayBetween(text, places.store, places.bath).way.length - 2;
        },
        'It turns at ends of walls only, and the string lies against each of them.',
        'Pull a string tight: at which ends of walls does it bend?',
        'A turn in the open can be cut short. A string that is pulled tight has none of these.'),
};
