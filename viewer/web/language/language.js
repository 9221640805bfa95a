/**
 * Words of a page in its language: that of the page itself, <html lang>. Texts are written in English, which is also the name under
 * which a language has them; what it lacks stays English. The build makes a table of each .po file.
 */
const name = globalThis.document?.documentElement.lang || 'en';
const table = name === 'en' ? {} : await (await fetch(new URL(`${name}.json`, import.meta.url))).json();

/**
 * A text in the language of the page: t('Check'), or a template with values, t`Step ${n} of ${all}`, whose name is "Step {0} of {1}".
 * @param {string | TemplateStringsArray} text
 */
export function t(text, ...values) {
    if (typeof text === 'string') return table[text] ?? text;
    const key = text.reduce((all, part, i) => `${all}{${i - 1}}${part}`);
    return (table[key] ?? key).replace(/\{(\d+)\}/g, (_, i) => String(values[i]));
}
