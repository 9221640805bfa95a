/** Words by which editors name things: solid layers, doors, starts. lib/io/FORMATS.md lists them. */
const solid = new Set(('wall walls solid solids collision collisions collide collides collider ' +
    'colliders obstacle obstacles block blocks blocked blocking blocker blockers occluder occluders ' +
    'occlusion opaque impassable').split(' '));
const beside = new Set('layer layers tile tiles object objects group groups map area areas shape shapes box boxes'.split(' '));

/** @param {string} name @returns {string[]} its words, in small letters: WallTops is wall, tops */
export const wordsOf = (name) => String(name ?? '').replace(/([a-z])([A-Z])/g, '$1 $2').toLowerCase()
    .split(/[^a-z]+/).filter(Boolean);

/** Whether a name is made of words for solid alone. */
export function isSolidName(name) {
    const words = wordsOf(name);
    return words.some((w) => solid.has(w)) && words.every((w) => solid.has(w) || beside.has(w));
}

export const isDoorName = (name) => wordsOf(name).some((w) => w === 'door' || w === 'doors');

export const isStartName = (name) => wordsOf(name).some((w) => /^(player|spawn|start|playerstart|spawnpoint)s?$/.test(w));

/** A number with its noun: 1 light, 2 lights. */
export const plural = (n, one, many = `${one}s`) => `${n} ${n === 1 ? one : many}`;

/** A name in one word, as map text wants it. */
export const oneWord = (name, spare) => String(name ?? '').trim().replace(/[\s#,]+/g, '_') || spare;
