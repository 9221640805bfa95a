/**
 * SVG drawings: outlines and lines become walls, through groups, uses and transforms. Groups named
 * sightline-door and so on (lib/io/FORMATS.md, "Layers of our own") become what they say.
 */
import { FormatError } from './map-text.js';
import { ownItems, ownLayer } from './own-layers.js';
import { apply, ellipse, identity, multiply, numbersOf, parsePath, parseTransform } from './svg-path.js';
import { isSolidName, plural } from './words.js';

const number = (node, name, spare = 0) => parseFloat(node.getAttribute(name) ?? '') || spare;

/** Whether a size is a part of the window. */
const isInPercent = (node) => [...node.attributes].some(({ name, value }) => /^([cr]?[xy][12]?|r|width|height)$/.test(name) && /%\s*$/.test(value));

const pairs = (values) => values.flatMap((v, i) => (i % 2 || i + 1 >= values.length ? [] : [[v, values[i + 1]]]));

const close = (points) => (points.length ? [...points, points[0]] : points);

/** The polylines of one shape, before its transform; null for other elements. */
function shape(node) {
    const n = (name) => number(node, name);
    switch (node.localName) {
    case 'line': return [[[n('x1'), n('y1')], [n('x2'), n('y2')]]];
    case 'polyline': return [pairs(numbersOf(node.getAttribute('points')))];
    case 'polygon': return [close(pairs(numbersOf(node.getAttribute('points'))))];
    case 'rect': {
        const [x, y, w, h] = ['x', 'y', 'width', 'height'].map(n);
        return w && h ? [close([[x, y], [x + w, y], [x + w, y + h], [x, y + h]])] : [];
    }
    case 'circle': return n('r') ? [ellipse(n('cx'), n('cy'), n('r'), n('r'))] : [];
    case 'ellipse': return n('rx') && n('ry') ? [ellipse(n('cx'), n('cy'), n('rx'), n('ry'))] : [];
    case 'path': return parsePath(node.getAttribute('d') ?? '');
    default: return null;
    }
}

/** Elements by uses, as often as they are used: a small drawing can hold a huge one. */
const MOST_USED = 2 ** 17;

const skipped = new Set(['defs', 'symbol', 'clipPath', 'mask', 'pattern', 'marker', 'metadata', 'title',
    'desc', 'style', 'script', 'linearGradient', 'radialGradient', 'filter']);

const hiding = { display: 'none', visibility: 'hidden' };

/** The rules of a text, read by the browser. @param {string} text */
function parseRules(text) {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(text);
    return [...sheet.cssRules];
}

/** What the style sheets of a drawing say that may hide, by selector: what counts more comes later. */
function readSheets(page, counts) {
    const rules = [], text = [...page.querySelectorAll('style')]
        .filter(({ type }) => !type || type === 'text/css').map((sheet) => sheet.textContent).join('\n');
    const imports = /@import\b[^;]*;/g;
    counts.rules = text.match(imports)?.length ?? 0;
    for (const { selectorText, style, media } of parseRules(text.replace(imports, ''))) {
        counts.rules += media ? 1 : 0;
        if (!['display', 'visibility', 'opacity', 'transform', 'fill', 'stroke'].some((property) => style?.[property])) continue;
        for (const selector of selectorText?.split(',') ?? [])
            if (/[>+~:[|\\]/.test(selector)) counts.rules++;
            else rules.push({ selector, style, weight: weightOf(selector) });
    }
    return rules.sort((a, b) => a.weight - b.weight);
}

/** A selector counts by its #ids, then its .classes, then its names (CSS 2.1, 6.4.3). */
function weightOf(selector) {
    const count = (form) => selector.match(form)?.length ?? 0;
    return count(/#/g) * 2 ** 16 + count(/\./g) * 2 ** 8 + count(/(^|\s)[^\s.#*]/g);
}

/** The styles of an element: what counts more comes later. */
function stylesOf(node, rules) {
    const styles = rules.filter(({ selector }) => node.matches(selector)).map(({ style }) => style);
    const own = node.getAttribute('style');
    if (own) styles.push(...parseRules(`*{${own}}`).slice(0, 1).map(({ style }) => style));
    return styles;
}

/** What attributes, the style or style sheets say of a property, as lib/io/svg/svg_style.c reads them. */
function said(node, styles, property) {
    let now = node.getAttribute(property)?.trim();
    for (const priority of ['', 'important'])
        for (const style of styles)
            if (style[property] && style.getPropertyPriority(property) === priority) now = style[property];
    return now;
}

/** A transform as the attribute has it, of a style too. */
function withoutUnits(text) {
    const plain = text?.replace(/(\d)(px|deg)\b/g, '$1').replace(/^none$/, '');
    if (/\d(%|e[a-z]|[a-df-z])/i.test(plain ?? '')) throw new FormatError(`transform: '${plain}' has a unit that is not read here`);
    return plain;
}

const labelOf = (node) => [...node.attributes].find((a) => a.localName === 'label')?.value ?? '';

const layerName = (node) => {
    const label = labelOf(node);
    return ownLayer(label) ?? ownLayer(node.id);
};

/** Items of a polyline in a layer. */
const itemsOf = (layer, node, points, counts) => ownItems(layer, points, {
    name: node.getAttribute('data-name') ?? '',
    isShut: node.getAttribute('data-open') === 'false',
    heading: Number(node.getAttribute('data-heading')) || 0,
}, counts);

/** @param {string} text @returns {{items: import('./map-text.js').Item[], notes: string[]}} */
export function readSvg(text) {
    const page = new DOMParser().parseFromString(text, 'image/svg+xml');
    if (page.querySelector('parsererror') || page.documentElement.localName !== 'svg')
        throw new FormatError('this is not an SVG file that can be read');
    const root = page.documentElement, items = [], counts = { named: false, inUse: 0, used: 0, percent: 0, doors: 0, left: 0, hidden: 0, rules: 0 };
    const rules = readSheets(page, counts);
    const box = numbersOf(root.getAttribute('viewBox'));
    const own = root.getAttribute('data-sightline-y0');
    const top = own !== null ? Number(own) : box.length === 4 ? 2 * box[1] + box[3] : number(root, 'height');
    const visit = (node, matrix, layer, above, depth) => {
        if (skipped.has(node.localName)) return;
        if (counts.inUse && ++counts.used > MOST_USED) throw new FormatError('the drawing has too many elements for this page, as often as they are used');
        const styles = stylesOf(node, rules);
        const paint = { fill: said(node, styles, 'fill') ?? above.fill, stroke: said(node, styles, 'stroke') ?? above.stroke };
        const lines = shape(node);
        const isHidden = Object.entries(hiding).some(([property, value]) => said(node, styles, property) === value) ||
            parseFloat(said(node, styles, 'opacity')) === 0;
        if (isHidden || (lines && paint.fill === 'none' && paint.stroke === 'none')) {
            counts.hidden++;
            return;
        }
        if (depth > 64) throw new FormatError('groups and uses are nested too deeply');
        const here = multiply(matrix, parseTransform(withoutUnits(said(node, styles, 'transform'))));
        const inLayer = layerName(node) ?? layer;
        if (inLayer === undefined) counts.named ||= isSolidName(labelOf(node)) || isSolidName(node.id);
        if (lines && isInPercent(node)) counts.percent++;
        else if (lines) {
            for (const line of lines) {
                const points = line.map((p) => apply(here, p)).map(([x, y]) => [x, top - y]);
                if (points.length > 1) items.push(...itemsOf(inLayer, node, points, counts));
            }
        }
        if (lines) return;
        if (node.localName === 'text' || node.localName === 'image') counts.left++;
        if (node.localName === 'use') {
            const reference = node.getAttribute('href') ?? node.getAttributeNS('http://www.w3.org/1999/xlink', 'href');
            const target = reference?.startsWith('#') && page.getElementById(reference.slice(1));
            const moved = multiply(here, [1, 0, 0, 1, number(node, 'x'), number(node, 'y')]);
            counts.inUse++;
            if (target?.localName === 'symbol')
                for (const child of target.children) visit(child, moved, inLayer, paint, depth + 1);
            else if (target) visit(target, moved, inLayer, paint, depth + 1);
            counts.inUse--;
        }
        for (const child of node.children) visit(child, here, inLayer, paint, depth + 1);
    };
    visit(root, identity, undefined, { stroke: 'none' }, 0);
    const notes = [];
    if (counts.left) notes.push(plural(counts.left, 'text or picture', 'texts and pictures'));
    if (counts.percent) notes.push(plural(counts.percent, 'shape with a size in percent', 'shapes with a size in percent'));
    if (counts.named) notes.push('layers by their names: all shapes are walls here, while the command tells walls, doors and furniture apart');
    if (counts.hidden) notes.push(plural(counts.hidden, 'hidden element'));
    if (counts.rules) notes.push(plural(counts.rules, 'rule of a style sheet', 'rules of style sheets'));
    for (const kind of ['range', 'snap']) {
        const value = Number(root.getAttribute(`data-sightline-${kind}`));
        if (value > 0) items.push({ kind, points: [], value });
    }
    if (!items.length) throw new FormatError('the drawing has no lines or outlines');
    return { items, notes };
}
