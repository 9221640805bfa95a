/**
 * The Markdown of the project's documents as HTML: headings, paragraphs, lists, tables, fences,
 * images and links. It refuses nothing; what it does not know is text.
 */
export const escapeHtml = (s) => s.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);

/** As GitHub makes it, so that links within a page work. */
export const anchorOf = (title) => title.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').trim().replaceAll(' ', '-');

/**
 * @param {string} text
 * @param {(target: string) => string | null} link the address of a link; null to leave the words alone
 */
function inline(text, link) {
    const kept = [];
    const keep = (html) => `\0${kept.push(html) - 1}\0`;
    let out = text.replace(/`([^`]+)`/g, (_, code) => keep(`<code>${escapeHtml(code)}</code>`));
    out = out.replace(/!\[([^\]]*)\]\(([^)\s]+)\)/g, (_, alt, target) =>
        keep(`<img src="${escapeHtml(link(target, true) ?? '')}" alt="${escapeHtml(alt)}" loading="lazy">`));
    out = out.replace(/\[([^\]]+)\]\(([^)\s]+)\)/g, (_, words, target) => {
        const address = link(target, false);
        return address === null ? words : `${keep(`<a href="${escapeHtml(address)}">`)}${words}${keep('</a>')}`;
    });
    out = escapeHtml(out).replace(/\*\*([^*]+)\*\*/g, '<strong>$1</strong>').replace(/(^|[^\w*])\*([^*\s][^*]*)\*/g, '$1<em>$2</em>');
    while (/\0\d+\0/.test(out)) out = out.replace(/\0(\d+)\0/g, (_, i) => kept[i]);
    return out;
}

/** Cells of a row of a table; a bar behind a backslash is text. */
const cellsOf = (line) => line.trim().replace(/^\||\|$/g, '').split(/(?<!\\)\|/).map((c) => c.trim().replaceAll('\\|', '|'));

/** @param {string[]} lines */
function list(lines, put) {
    const ordered = /^\d+\./.test(lines[0]), items = [];
    for (const line of lines)
        if (/^(-|\*|\d+\.) /.test(line)) items.push(line.replace(/^(-|\*|\d+\.) +/, ''));
        else items[items.length - 1] += ` ${line.trim()}`;
    const tag = ordered ? 'ol' : 'ul', first = ordered ? parseInt(lines[0], 10) : 1;
    return `<${tag}${first === 1 ? '' : ` start="${first}"`}>\n${items.map((item) => `<li>${put(item)}</li>`).join('\n')}\n</${tag}>`;
}

function table(lines, put) {
    const [head, , ...rows] = lines.map(cellsOf);
    const row = (cells, tag) => `<tr>${cells.map((c) => `<${tag}>${put(c)}</${tag}>`).join('')}</tr>`;
    return `<div class="table" role="group" aria-label="Table" tabindex="0"><table>\n<thead>${row(head, 'th')}</thead>\n` +
        `<tbody>\n${rows.map((r) => row(r, 'td')).join('\n')}\n</tbody>\n</table></div>`;
}

/** @returns {string} the HTML of a document's body */
export function toHtml(markdown, link) {
    const lines = markdown.replaceAll('\r\n', '\n').split('\n'), out = [], put = (text) => inline(text, link);
    const while_ = (i, keep) => {
        const from = i;
        while (i < lines.length && keep(lines[i])) i++;
        return lines.slice(from, i);
    };
    for (let i = 0; i < lines.length;) {
        const line = lines[i], fence = /^(`{3,})/.exec(line);
        let taken;
        if (fence) {
            taken = while_(i + 1, (l) => !l.startsWith(fence[1]));
            out.push(`<pre tabindex="0"><code>${escapeHtml(taken.join('\n'))}</code></pre>`);
            i += taken.length + 2;
            continue;
        }
        const heading = /^(#{1,6}) (.*)/.exec(line);
        if (!line.trim()) taken = [line];
        else if (heading) {
            const n = heading[1].length;
            out.push(`<h${n} id="${anchorOf(heading[2].replaceAll('`', ''))}">${put(heading[2])}</h${n}>`);
            taken = [line];
        } else if (line.startsWith('|')) out.push(table(taken = while_(i, (l) => l.startsWith('|')), put));
        else if (/^(-|\*|\d+\.) /.test(line)) out.push(list(taken = while_(i, (l) => /^(-|\*|\d+\.) |^ +\S/.test(l)), put));
        else if (line.startsWith('> ')) out.push(`<blockquote>${put((taken = while_(i, (l) => l.startsWith('>'))).map((l) => l.slice(2)).join(' '))}</blockquote>`);
        else {
            taken = while_(i, (l) => l.trim() && !/^(#{1,6} |\||```|(-|\*|\d+\.) )/.test(l));
            if (!taken.length) taken = [line];
            out.push(`<p>${put(taken.join('\n'))}</p>`);
        }
        i += taken.length;
    }
    return out.join('\n');
}

/** The first heading, for the title of the page. */
export const titleOf = (markdown) => /^# (.*)$/m.exec(markdown)?.[1] ?? 'Sightline';

/** The anchors of all headings. */
export const anchorsOf = (markdown) => [...markdown.matchAll(/^#{1,6} (.*)$/gm)].map(([, title]) => anchorOf(title.replaceAll('`', '')));
