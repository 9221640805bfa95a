/** Files of translations, as gettext has them: an English text and the same in another language, each in quotes on one line or on several. */
import { readFileSync } from 'node:fs';

/** @param {string} path of a .po file @returns {Map<string, string>} translations by the English text; '' where one is missing */
export function readPo(path) {
    const entries = new Map(), fail = (line, what) => { throw new Error(`${path}:${line + 1}: ${what}`); };
    let key = null, now = null;
    const keep = (line) => {
        if (key === null) return;
        if (now === null) fail(line, 'a msgid without msgstr');
        if (entries.has(key)) fail(line, `"${key}" stands twice`);
        entries.set(key, now);
    };
    readFileSync(path, 'utf8').split('\n').forEach((text, line) => {
        if (!text.trim() || text.startsWith('#')) return;
        const [, word = '', quoted] = /^(msgid |msgstr |)("(?:[^"\\]|\\.)*")$/.exec(text) ?? fail(line, `what is ${text}?`);
        const value = JSON.parse(quoted);
        if (word === 'msgid ') {
            keep(line);
            [key, now] = [value, null];
        } else if (word === 'msgstr ') now = value;
        else if (now !== null) now += value;
        else if (key !== null) key += value;
        else fail(line, 'a text without msgid');
    });
    keep(0);
    return entries;
}

/** @param {Iterable<[string, string]>} entries @returns {string} the text of a .po file */
export const writePo = (entries) => [...entries].map(([key, value]) => `msgid ${JSON.stringify(key)}\nmsgstr ${JSON.stringify(value)}\n`).join('\n');
