/** Parts that questions of all chapters are made of: kinds of answers, and pictures. */
import { drawDot, drawPlan, strokeLines } from '../../parts/plan.js';
import { drawText, drawWalls, itemsOf } from '../maps.js';

/**
 * @typedef {Object} Question as an exercise (exercise.js), with `picture`, and with `value` for those who export it
 * @property {'number' | 'choice'} kind @property {string} question @property {(lab: any) => number} right @property {number} value
 * @property {{title: string, box: number[], draw: (surface: any, camera: any, tones: any) => void}} [picture]
 */

/** A question for a number. @param {string} hint for wrong ones, whether too low or too high @returns {Question} */
export const number = (question, value, why, hint, picture) => ({ kind: 'number', question, value, right: () => value, why, low: hint, high: hint, picture });

/** A question with a few answers, each with its remark. @param {[string, string][]} options @returns {Question} */
export const choice = (question, options, value, picture) => ({ kind: 'choice', question, options, value, right: () => value, picture });

/** @param {string} why for both answers: what decides */
export const yesNo = (question, isYes, why, picture) => choice(question, [['Yes.', why], ['No.', why]], isYes ? 0 : 1, picture);

/** A plan with places that have letters. @param {{text: string, box: number[]}} plan @param {Record<string, number[]>} marks */
export const planPicture = (title, { text, box }, marks, { scene, from, to, seen, lines = [], more } = {}) => ({
    title, box, draw(surface, camera, tones) {
        drawPlan(surface, camera, scene ? { space: scene(), from, to, seen } : { items: itemsOf(text) }, tones);
        drawWalls(surface, camera, itemsOf(text), tones);
        more?.(surface, camera, tones);
        strokeLines(surface, camera, lines, tones.sourceEdge, 2);
        for (const [letter, at] of Object.entries(marks)) {
            drawDot(surface, camera, at, 6, tones.sourceEdge, tones.page);
            drawText(surface, camera, at, letter, tones, 14, -10);
        }
    },
});

/** Whether something is the same for a place and for places near it; so nobody has to measure. @returns {boolean | null} null if it is not */
export function surely(test, [x, y], near = 0.2) {
    const first = test([x, y]);
    return [[near, 0], [-near, 0], [0, near], [0, -near]].every(([dx, dy]) => test([x + dx, y + dy]) === first) ? first : null;
}

export const at = ([x, y]) => ({ x, y });

export { insideOf } from '../lab.js';
