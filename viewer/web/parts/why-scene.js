/**
 * Draws an explanation: the portals that sightlines would pass, and the line that passes them or,
 * of a hidden pair, the ends of portals that leave no line through.
 */
import { t } from '../language/language.js';
import { plural } from '../formats/words.js';
import { drawDot, strokeLines } from './plan.js';

/**
 * @typedef {Object} WhyScene what `sightline explain --json` says, or the part of it that is drawn
 * @property {number} from @property {number} to the two cells
 * @property {boolean} seen @property {boolean} [complete] @property {boolean} [touches]
 * @property {PassedPortal[]} [sequence] @property {number[]} [line] @property {number[]} [shown] the sightline
 * @property {{decides: string[]}} [effects]
 * @property {{verdict: string, line?: number[][]}} [by_mirror]
 * @property {{sequence: PassedPortal[], stopped_by: PassedPortal, reason: string,
 *   ends: {portal: number, side: string, point: number[]}[]}[]} misses
 */
/** @typedef {{portal: number, cell: number, left: number[], right: number[]}} PassedPortal */

const segment = (portal) => [...portal.left, ...portal.right];

/** @param {WhyScene} why @returns {PassedPortal[]} the portals that the picture is about */
export function portalsOf(why) {
    if (why.sequence?.length) return why.sequence;
    const miss = why.misses?.[0];
    return miss ? [...miss.sequence, miss.stopped_by] : [];
}

/** @param {WhyScene} why @param {import('./tones.js').Tones} tones */
export function drawWhy(surface, camera, why, tones) {
    const miss = why.sequence?.length ? null : why.misses?.[0];
    strokeLines(surface, camera, portalsOf(why).map(segment), tones.page, 7);
    strokeLines(surface, camera, portalsOf(why).map(segment), tones.portal, 4);
    if (miss) strokeLines(surface, camera, [segment(miss.stopped_by)], tones.to, 4, [5, 3]);
    const line = why.shown ?? why.line;
    if (line?.length && why.sequence?.length) {
        strokeLines(surface, camera, [line], tones.page, 6);
        strokeLines(surface, camera, [line], tones.sourceEdge, 3);
    }
    for (const end of miss?.ends ?? []) {
        const colour = tones[end.side];
        drawDot(surface, camera, end.point, 6, colour, tones.page);
        const [x, y] = camera.toScreen(...end.point);
        surface.font = 'bold 13px sans-serif';
        surface.textAlign = 'left';
        surface.textBaseline = 'middle';
        surface.fillStyle = tones.ink;
        surface.fillText(end.side === 'left' ? 'L' : 'R', x + 9, y - 9);
    }
    const bent = why.by_mirror?.line;
    if (bent?.length) strokeLines(surface, camera, [bent.flat()], tones.mirrored, 3);
}

/** Why, in words. @param {WhyScene} why */
export function tellWhy(why) {
    const pair = t`Cell ${why.from} and cell ${why.to}`;
    if (why.from === why.to) return t('A cell sees itself.');
    let effects = why.effects?.decides?.length ? t` What decides: ${why.effects.decides.join(', ')}.` : '';
    if (why.by_mirror?.verdict === 'stabbed') effects += t(' They see each other in a mirror.');
    if (why.complete === false) effects += t(' The search was stopped early, so this is not certain.');
    if (why.seen && why.sequence?.length)
        return t`${pair} see each other: the line passes ${plural(why.sequence.length, 'portal')}${why.touches ? t(', and touches ends of walls') : ''}.${effects}`;
    if (why.seen) return t`${pair} see each other.${effects}`;
    const miss = why.misses?.[0];
    if (!miss) return t`${pair}: there is no way from one to the other, so no line joins them.${effects}`;
    const ends = miss.ends.map((e) => `${e.side === 'left' ? 'L' : 'R'}${e.portal}`).join(', ');
    const what = miss.reason === 'conflict'
        ? t`No line has all these ends of portals on the right sides: ${ends}.`
        : t('A line would have to turn back.');
    return t`${pair} are hidden from each other. ${what} L marks ends that a line must have at its left, R those at its right. The picture shows one sequence of portals that leads there.${effects}`;
}
