/**
 * Sources of the course: entries of a BibTeX file, and each as a line of Markdown.
 *
 * The file is read as it is written here: one field a line, its value in braces. A field that is missing, an entry that
 * stands twice and a line that is no field end the build.
 */
const needed = { article: ['journal', 'pages'], inproceedings: ['booktitle', 'pages'], phdthesis: ['school'], book: ['publisher'] };

/** @param {string} text of a BibTeX file @returns {Map<string, Record<string, string>>} fields by key, with `kind` */
export function readReferences(text) {
    const entries = new Map();
    let entry = null;
    for (const line of text.split('\n')) {
        const begin = /^@(\w+)\{([\w-]+),$/.exec(line), field = /^ {2}(\w+) = \{(.*)\},?$/.exec(line);
        if (begin) {
            if (entries.has(begin[2]) || !needed[begin[1]]) throw new Error(`references: ${line} stands twice, or is of an unknown kind`);
            entries.set(begin[2], entry = { kind: begin[1] });
        } else if (field && entry) entry[field[1]] = field[2].replaceAll('--', '–').replaceAll('\\&', '&');
        else if (line && line !== '}' && !line.startsWith('%')) throw new Error(`references: what is "${line}"?`);
    }
    for (const [key, fields] of entries)
        for (const name of ['author', 'title', 'year', ...needed[fields.kind]])
            if (!fields[name]) throw new Error(`references: ${key} has no ${name}`);
    return entries;
}

/** @param {Record<string, string>} fields of one entry @returns {string} a line of Markdown */
export function referenceLine({ kind, author, title, year, doi, note, pages, volume, number, ...more }) {
    const isWhole = kind === 'book' || kind === 'phdthesis', authors = author.replaceAll(' and ', ', ');
    const place = isWhole ? `${kind === 'book' ? '' : 'PhD thesis, '}${more.publisher ?? more.school}`
        : `*${more.journal ?? more.booktitle}*${volume ? ` ${volume}${number ? `(${number})` : ''}` : ''}, ${pages}`;
    const link = doi ? ` [doi:${doi}](https://doi.org/${doi.replaceAll('(', '%28').replaceAll(')', '%29')})` : '';
    return `${authors}: ${isWhole ? `*${title}*` : title}. ${place}, ${year}${note ? ` (${note})` : ''}.${link}`;
}
