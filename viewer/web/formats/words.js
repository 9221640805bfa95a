import { t } from '../language/language.js';

/** Words by which editors name things. Those of the `sightline` command (lib/io/parts/names.c), by the names of their lists. */
export const lists = Object.fromEntries(Object.entries({
    solid_words: 'wall solid collide collider collidable collideable obstacle block blocked blocking blocker occluder ' +
        'occlusion opaque impassable collides coll impassible unpassable unwalkable nonwalkable nowalk nopass ' +
        'barrier boundary boundaries boundry boundries bounds mauer mauern wände waende hindernis hindernisse mur ' +
        'solide solido sólido solida sólida obstaculo obstáculo muro pared paredes colisión parede colisao colisão colisoes colisões bloqueo muri ' +
        'muratura parete pareti ostacolo ostacoli vägg väggar ściana ściany sciana sciany kolizja kolizje стена ' +
        'стены коллизия коллизии препятствие препятствия 墙 墙壁 墙体 牆 牆壁 碰撞 碰撞层 障碍 障碍物 障碍层 阻挡 阻挡层 壁 障害物 当たり判定 벽 충돌 ' +
        '장애물',
    solid_neutral: 'layer tile object group map area shape box is ge has ebene calque capa camada mask rect polygon geometry ' +
        'est ist es',
    not_words: 'no non not un cannot cant',
    walk_words: 'walk walkable walking pass passable passing passage passthrough traversable walkthrough accessible',
    walk_neutral: 'is can tile be on through ge',
    start_words: 'player spawn start starting entrance hero playerstart playerspawn playerpos spawnpoint startpoint ' +
        'startpos spawnpos startposition playerposition playerspawnpoint spawnposition playercharacter entry ' +
        'entrypoint playerentry startlayer protagonist',
    start_neutral: 'point position pos location loc place marker object entity tile area zone main here character default',
    door_words: 'door gate doorway gateway',
    door_neutral: 'object tile entity wood wooden iron metal steel stone left right top bottom up down north south east west ' +
        'front back main open opened closed shut locked secret small big large double single side horizontal ' +
        'vertical exit inner outer red green blue yellow h v hidden a b c entrance',
    door_others: 'trap no not fake to behind at near',
}).map(([name, words]) => [name, new Set(words.split(' '))]));

/** @param {string} name @returns {string[]} its words, in small letters: WallTops is wall, tops */
export const wordsOf = (name) => String(name ?? '').replace(/([a-z])([A-Z])/g, '$1 $2').toLowerCase()
    .split(/[^a-z\u0080-\uffff]+/).filter(Boolean);

/** Whether a list has the word, or the word without "s" or "es" at its end. */
const isIn = (word, list) => [word, word.replace(/s$/, ''), word.replace(/es$/, '')].some((w) => lists[list].has(w));

/** Whether all words are in one of two lists, one in the first at least. */
const says = (name, first, neutral) => {
    const words = wordsOf(name);
    return words.some((w) => isIn(w, first)) && words.every((w) => isIn(w, first) || isIn(w, neutral));
};

const isSolid = (word) => isIn(word, 'solid_words') || /^[ck]ol+is+i?on/.test(word);

/** Whether a name is made of words for solid alone, or of "not" and a word for walking. */
export function isSolidName(name) {
    let said = false, negated = false;
    for (const word of wordsOf(name)) {
        if (!negated && isIn(word, 'not_words')) {
            negated = true;
            continue;
        }
        if (negated !== isIn(word, 'walk_words')) return false;
        if (!negated && !isSolid(word) && !isIn(word, 'solid_neutral')) return false;
        said ||= negated || isSolid(word);
        negated = false;
    }
    return said && !negated;
}

/** Whether a name says the contrary: walkable, isPassable. */
export const isOpenName = (name) => says(name, 'walk_words', 'walk_neutral');

export const isStartName = (name) => says(name, 'start_words', 'start_neutral');

/** Whether a name ends in "door", or begins with it and says no more than which one. */
export function isDoorName(name) {
    const words = wordsOf(name), leads = words.length > 0 && isIn(words[0], 'door_words');
    if (words.some((w) => isIn(w, 'door_others'))) return false;
    return words.reduce((said, w) => isIn(w, 'door_words') || (leads && said && isIn(w, 'door_neutral')), false);
}

/** A number with its noun, in the language of the page: 1 light, 2 lights. */
export const plural = (n, one, many = `${one}s`) => `${n} ${t(n === 1 ? one : many)}`;

/** A name in one word, as map text wants it. */
export const oneWord = (name, spare) => String(name ?? '').trim().replace(/[\s#,]+/g, '_') || spare;
