/** The page of GLPK's answers: the linear program of a portal sequence, its optimum, and the exact answer. */
import { element, Figure, table } from '../course/figure.js';
import { Lab } from '../course/lab.js';
import { box, drawPortals, given, heldPortals, long, nameOf } from '../course/lines.js';
import { compile } from '../package/host.js';
import { Module } from '../package/module.js';
import { strokeLines } from '../parts/plan.js';

/** As lib/stab/glpk_simplex.c has it, in the unit of the program. */
const TOLERANCE = 1e-9;

/** Portals that three ends at height 6 leave a slit of this height; below 0 they overlap. */
const slit = (height) => [[4, 6 + height, 4, 3], [9, 9, 9, 6], [14, 6 + height, 14, 3]];

const sequences = { touch: slit(0), slit: slit(1e-12), shut: slit(-1e-12) };

/** GLPK's program of portals. @param {Module} glpk @param {number[][]} portals left x, left y, right x, right y */
function programOf(glpk, portals) {
    const flat = Float64Array.from(portals.flat());
    return glpk.withBytes([new Uint8Array(flat.buffer)], (at) => {
        glpk.ask((core) => core.program(at, portals.length));
        const [count, place, solved] = glpk.given(3), { buffer } = glpk.memory;
        const [ox, oy, unit, ux, uy, c, d, margin] = glpk.givenNumbers(8), length = Math.hypot(ux, uy);
        const rows = Array.from({ length: count }, (_, i) => {
            const [left] = new Uint8Array(buffer, place + 64 * i + 4, 1), [isBasic] = new Uint8Array(buffer, place + 64 * i + 56, 1);
            const numbers = [...new Float64Array(buffer, place + 64 * i + 8, 6)];
            const name = i ? nameOf({ portal: (i - 1) >> 1, side: left ? 'L' : 'R' }) : 'row 1';
            return { name, bound: !i ? '= 1' : left ? '>= 0' : '<= 0', numbers, isBasic };
        });
        const on = [ox + (unit * c * uy) / length ** 2, oy - (unit * c * ux) / length ** 2];
        return { rows, solved, d, margin, share: margin / unit, line: [on, [on[0] + ux / length, on[1] + uy / length]] };
    });
}

const short = (v) => (v === 0 ? '0' : Math.abs(v) < 1e-3 ? v.toExponential(1) : v.toFixed(3));

const program = (glpk) => ({
    title: 'The program and its optimum.',
    about: 'Choose a sequence. Ends of your own portals can be dragged up and down.',
    box,
    wide: true,
    handles: given.flatMap(([lx, ly, rx, ry], i) => [{ name: `l${i}`, at: [lx, ly], tone: 'glass' }, { name: `r${i}`, at: [rx, ry], tone: 'to' }]),
    controls: [{ name: 'sequence', label: 'Sequence', kind: 'choice', value: 'own', options: [['own', 'your portals'],
        ['touch', 'a line that only touches'], ['slit', 'a slit of 0.000000000001'], ['shut', 'an overlap of 0.000000000001']] }],
    update(state, lab) {
        state.portals = sequences[state.sequence] ?? heldPortals(state);
        state.program = programOf(glpk, state.portals);
        state.conflict = lab.core.conflict(state.portals);
    },
    draw(surface, camera, tones, { portals, program: { line, solved, share } }) {
        drawPortals(surface, camera, tones, portals);
        if (solved) strokeLines(surface, camera, [long(...line)], share < -TOLERANCE ? tones.faint : tones.sourceEdge, 2.5);
    },
    beside: ({ program: { rows } }) => element('div', { className: 'table', tabIndex: 0, role: 'group', 'aria-label': 'Rows' },
        table(['row', 'ux', 'uy', 'c', 'd', 'bound', 'value', 'price', 'basis'], rows.map(({ name, bound, numbers, isBasic }) =>
            [name, ...numbers.slice(0, 4).map(short), bound, ...numbers.slice(4).map(short), isBasic ? 'yes' : 'no']))),
    tell({ program: { solved, margin, share }, conflict: { verdict } }) {
        const found = !solved ? 'finds no optimum' : `finds a margin of ${short(margin)}: ` +
            (share > TOLERANCE ? 'a line passes' : share < -TOLERANCE ? 'no line passes' : 'too near to 0 to tell');
        return `GLPK ${found}. Exact: ${{ stabbed: 'a line passes', grazing: 'a line can only touch', hidden: 'no line passes' }[verdict]}.`;
    },
});

const host = document.getElementById('program');
try {
    const [lab, module] = await Promise.all([Lab.open(), compile('glpk', new URL('glpk.wasm', import.meta.url))]);
    new Figure(host, program(new Module(module, 1024)), lab);
    document.querySelector('main').dataset.ready = 'yes';
} catch (error) {
    host.textContent = `The program cannot be shown: ${error.message}`;
}
