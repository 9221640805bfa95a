import { t } from '../language/language.js';

/** Words by which editors name things: solid layers, doors, starts. lib/io/FORMATS.md lists them. */
const solid = new Set(('wall walls solid solids collision collisions collide collides collider ' +
    'colliders obstacle obstacles block blocks blocked blocking blocker blockers occluder occluders ' +
    'occlusion opaque impassable impassible unpassable unwalkable collidable barrier barriers boundary bounds ' +
    'mauer mauern wände kollision hindernis hindernisse mur murs muro muros muri pared paredes parede colisión ' +
    'colisiones colisão obstáculo obstáculos collisioni vägg väggar ściana ściany стена стены 墙 墙壁 碰撞 碰撞层 障碍 ' +
    '壁 벽').split(' '));
const beside = new Set('layer layers tile tiles object objects group groups map area areas shape shapes box boxes is has'.split(' '));

/** @param {string} name @returns {string[]} its words, in small letters: WallTops is wall, tops */
export const wordsOf = (name) => String(name ?? '').replace(/([a-z])([A-Z])/g, '$1 $2').toLowerCase()
    .split(/[^\p{L}]+/u).filter(Boolean);

/** Whether a name is made of words for solid alone. */
export function isSolidName(name) {
    const words = wordsOf(name);
    return words.some((w) => solid.has(w)) && words.every((w) => solid.has(w) || beside.has(w));
}

/** Whether a name says the contrary: walkable, isPassable. */
export const isOpenName = (name) => {
    const words = wordsOf(name).filter((w) => w !== 'is');
    return words.length === 1 && ['walkable', 'passable', 'traversable'].includes(words[0]);
};

export const isDoorName = (name) => wordsOf(name).some((w) => w === 'door' || w === 'doors');

export const isStartName = (name) => wordsOf(name).some((w) => /^(player|spawn|start|playerstart|spawnpoint)s?$/.test(w));

/** A number with its noun, in the language of the page: 1 light, 2 lights. */
export const plural = (n, one, many = `${one}s`) => `${n} ${t(n === 1 ? one : many)}`;

/** A name in one word, as map text wants it. */
export const oneWord = (name, spare) => String(name ?? '').trim().replace(/[\s#,]+/g, '_') || spare;
