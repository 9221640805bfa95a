/**
 * Questions as GIFT, Moodle's text format for them: https://docs.moodle.org/en/GIFT_format. A category for each chapter. Pictures are within
 * the text, as SVG. Characters that the format uses itself stand behind a backslash.
 */
const plain = (text) => text.replace(/[\\~=#{}:]/g, (c) => `\\${c}`);
const html = (text) => plain(text.replace(/[&<>]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;' })[c]));

/** @param {import('../course/questions/ask.js').Question & {image: string}} question `image` is an SVG in base64 */
function item(question) {
    const image = question.image ? plain(`<p><img src="data:image/svg+xml;base64,${question.image}" alt="${question.picture.title}"></p>`) : '';
    const answers = question.kind === 'number' ? `#${question.value}:0#${html(question.why)}`
        : `\n${question.options.map(([text, remark], i) => `${i === question.value ? '=' : '~'}${html(text)}#${html(remark)}`).join('\n')}\n`;
    return `::${plain(`${question.chapter} ${question.name}`)}::[html]<p>${html(question.question)}</p>${image} {${answers}}\n`;
}

/** @param {{title: string, questions: any[]}[]} parts */
export const giftText = (parts) => parts.map(({ title, questions }) => [`$CATEGORY: $course$/${title.replaceAll('/', '//')}\n`, ...questions.map(item)].join('\n')).join('\n');
