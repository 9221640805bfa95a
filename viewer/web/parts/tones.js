/**
 * The colours of the project, on a light and on a dark page.
 *
 * They are those of lib/draw and viewer/ui/tones.c, whose contrast tests/viewer/test_tones.c checks.
 * test/tones.test.mjs compares them.
 */

/**
 * @typedef {Object} Tones
 * @property {boolean} dark
 * @property {string} page @property {string} ground @property {string} hatch
 * @property {string} solid @property {string[]} floor @property {string[]} seen
 * @property {string} source @property {string} sourceEdge @property {string} wall
 * @property {string} outline @property {string} portal @property {string} tree
 * @property {string} start @property {string} path @property {string} door
 * @property {string} glass @property {string} object @property {string} mirrored
 * @property {string} ink @property {string} faint @property {string} region
 * @property {string} image what is seen in a mirror
 * @property {string} from @property {string} to
 * @property {string} left @property {string} right ends of a portal
 * @property {Record<string, string>} guarantees of methods, in charts
 */

const SKY = '#56b4e9';

const light = {
    dark: false,
    page: '#fbf9f4',
    ground: '#f0ece3',
    hatch: '#dcd5c7',
    solid: '#6b665e',
    floor: ['#ffffff', '#f8f6f1', '#f3f3ee', '#fbf8ef'],
    source: '#f0b63f',
    sourceEdge: '#b26a00',
    wall: '#1d222b',
    outline: '#c9c4b8',
    portal: '#00845f',
    tree: '#00233f',
    start: '#c45200',
    path: '#5b4a8a',
    door: '#a8487d',
    glass: '#0072b2',
    object: '#7a6a53',
    mirrored: '#b8558c',
    ink: '#252a33',
    faint: '#646971',
    from: '#b86a00',
    to: '#a8487d',
};

const dark = {
    dark: true,
    page: '#12151a',
    ground: '#181c22',
    hatch: '#272d36',
    solid: '#958c7c',
    floor: ['#2b313b', '#303742', '#272d36', '#333943'],
    source: '#cf9013',
    sourceEdge: '#ffcf70',
    wall: '#ffffff',
    outline: '#49515e',
    portal: '#3ccfa4',
    tree: '#fffafd',
    start: '#ff7a1f',
    path: '#b9a6f2',
    door: '#cc79a7',
    glass: SKY,
    object: '#c9b896',
    mirrored: '#e58fc0',
    ink: '#ece9e2',
    faint: '#9aa1ab',
    from: '#b7821a',
    to: '#e58fc0',
};

/** @param {string} a @param {string} b @param {number} share @returns {string} */
export function mix(a, b, share) {
    let text = '#';
    for (let i = 1; i < 7; i += 2) {
        const from = parseInt(a.slice(i, i + 2), 16), to = parseInt(b.slice(i, i + 2), 16);
        text += Math.round(from + (to - from) * share).toString(16).padStart(2, '0');
    }
    return text;
}

/** @param {boolean} isDark @returns {Tones} */
export function makeTones(isDark) {
    const base = isDark ? dark : light, strength = isDark ? 0.58 : 0.62;
    const region = mix(base.floor[0], base.source, 0.65), image = mix(base.floor[0], base.mirrored, 0.45);
    const ends = { left: base.glass, right: base.start };
    const guarantees = { exact: base.portal, conservative: base.glass, aggressive: base.door, rounded: base.start };
    return { ...base, ...ends, guarantees, region, image, seen: base.floor.map((c, i) => mix(c, SKY, strength - 0.04 * i)) };
}

/**
 * Calls back with the tones of the page's colour scheme, now and whenever it changes.
 * @param {(tones: Tones) => void} use
 */
export function watchTones(use) {
    const query = matchMedia('(prefers-color-scheme: dark)');
    query.addEventListener('change', () => use(makeTones(query.matches)));
    use(makeTones(query.matches));
}
