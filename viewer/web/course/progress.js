/**
 * Answers of a student, kept in the browser. Nothing is sent anywhere. They can be saved as a file, and read back.
 *
 * An answer has `value`, which puts it back into the form, and `given`, the same in words for a reader.
 * @typedef {Object} Answer
 * @property {string} chapter the title @property {string} question @property {any} value @property {string} given
 * @property {'right' | 'wrong'} result @property {string} remark @property {number} tries
 * @property {string} first time of the first try @property {string} last time of the last one, as in ISO 8601
 */
import { t } from '../language/language.js';

const KEY = 'sightline-course-answers';
const KIND = 'sightline course answers', VERSION = 1;

const nothing = () => ({ name: '', answers: {} });

/** Whether a value is what `saveText` writes; otherwise why not. */
function faultOf(kept) {
    if (kept?.kind !== KIND) return t('This is no file of answers.');
    if (kept.version !== VERSION) return t`The file has version ${kept.version}; this page reads version ${VERSION}.`;
    const isText = (value) => typeof value === 'string', isAnswer = (a) => a && [a.chapter, a.question, a.given, a.remark, a.first, a.last].every(isText) &&
        ['right', 'wrong'].includes(a.result) && Number.isInteger(a.tries) && a.tries > 0;
    if (!isText(kept.name) || !kept.answers || typeof kept.answers !== 'object') return t('The file has no name or no answers.');
    const wrong = Object.entries(kept.answers).find(([key, answer]) => !/^[\w-]+\/[\w-]+$/.test(key) || !isAnswer(answer));
    return wrong ? t`The answer ${wrong[0]} of the file is not complete.` : '';
}

/** @returns {{name: string, answers: Record<string, Answer>}} by chapter/exercise */
export function loadProgress() {
    try {
        const kept = JSON.parse(localStorage.getItem(KEY));
        return faultOf(kept) ? nothing() : kept;
    } catch {
        return nothing();
    }
}

/** @returns {boolean} whether the browser kept it */
function keep({ name, answers }) {
    try {
        localStorage.setItem(KEY, JSON.stringify({ kind: KIND, version: VERSION, name, answers }));
        return true;
    } catch {
        return false;
    }
}

/** Adds a try. @param {string} key chapter/exercise @param {Omit<Answer, 'tries' | 'first' | 'last'>} answer */
export function recordAnswer(key, answer) {
    const progress = loadProgress(), before = progress.answers[key], now = new Date().toISOString();
    progress.answers[key] = { ...answer, tries: (before?.tries ?? 0) + 1, first: before?.first ?? now, last: now };
    return keep(progress);
}

export const keepName = (name) => keep({ ...loadProgress(), name });

export function forgetProgress() {
    try {
        localStorage.removeItem(KEY);
    } catch {
        // A browser that keeps nothing has nothing to forget.
    }
}

/** The text of a file with all answers. */
export const saveText = () => `${JSON.stringify({ kind: KIND, version: VERSION, saved: new Date().toISOString(), ...loadProgress() }, null, 2)}\n`;

/** Takes the answers of a file in place of those that are kept; throws an error for people. @param {string} text */
export function readText(text) {
    let kept;
    try {
        kept = JSON.parse(text);
    } catch {
        throw new Error(t('This is no file of answers.'));
    }
    const fault = faultOf(kept);
    if (fault) throw new Error(fault);
    if (!keep(kept)) throw new Error(t('The browser keeps nothing for this page.'));
}
