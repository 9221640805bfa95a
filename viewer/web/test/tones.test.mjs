/** Colours mean the same in the pictures of the command and on the page: the numbers are compared with the sources in C. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { makeTones } from '../parts/tones.js';

const root = join(dirname(fileURLToPath(import.meta.url)), '../../..');
const source = (path) => readFileSync(join(root, path), 'utf8');
const themes = [['light', makeTones(false)], ['dark', makeTones(true)]];
const camel = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());

/** The palette of the library, by theme: names with their colours. */
function palettes() {
    const text = source('lib/draw/marks.c'), named = Object.fromEntries([...text.matchAll(/^ {4}([A-Z]+) = 0x(\w{6}),$/gm)].map(([, name, hex]) => [name, hex]));
    const [, light, dark] = text.split(/^ *\.page = /m);
    return [light, dark].map((part) => Object.fromEntries([...`.page = ${part}`.matchAll(/\.(\w+) = rgb\((?:0x(\w{6})|([A-Z]+))\)/g)]
        .map(([, name, hex, other]) => [name, `#${hex ?? named[other]}`])));
}

test('the palette is that of the library', () => {
    for (const [i, palette] of palettes().entries()) {
        assert.ok(Object.keys(palette).length > 15);
        for (const [name, colour] of Object.entries(palette))
            if (name !== 'doubtful') assert.equal(themes[i][1][camel(name)], colour, `${themes[i][0]}: ${name}`);
    }
});

test('from and to are those of the viewer', () => {
    for (const [, name, light, dark] of source('viewer/ui/tones.c').matchAll(/\[TONE_\w+\] = \{"(from|to)", \w+, \w+, 0x(\w{6}), 0x(\w{6})/g))
        assert.deepEqual(themes.map(([, tones]) => tones[name]), [`#${light}`, `#${dark}`], name);
});

test('left and right ends have the colours of an explanation', () => {
    const ends = [...source('lib/draw/draw_explain.c').matchAll(/pic->(left|right) = palette->(\w+);/g)];
    assert.equal(ends.length, 2);
    for (const [, end, name] of ends) for (const [theme, tones] of themes) assert.equal(tones[end], tones[camel(name)], `${theme}: ${end}`);
});

test('guarantees have the colours of the chart of compare', () => {
    const colours = [...source('lib/draw/chart_paint.c').matchAll(/case (\d):\s*return palette->(\w+);/g)].map(([, , name]) => name);
    const chosen = /\.colour = guarantee == SL_EXACT\s*\? (\d)\s*: guarantee == SL_ROUNDED\s*\? (\d)\s*: guarantee == SL_CONSERVATIVE\s*\? (\d)\s*: (\d)/.exec(source('tools/studies/compare_chart.c'));
    const places = { exact: chosen[1], rounded: chosen[2], conservative: chosen[3], aggressive: chosen[4] };
    for (const [theme, tones] of themes)
        for (const [guarantee, place] of Object.entries(places))
            assert.equal(tones.guarantees[guarantee], tones[camel(colours[place])], `${theme}: ${guarantee}`);
});
