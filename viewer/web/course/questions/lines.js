/** Questions of chapter 3: lines through portals, and the sign that decides. */
import { strokeLines } from '../../parts/plan.js';
import { box, drawPortals, long, nameOf, side } from '../lines.js';
import { choice, number, yesNo } from './ask.js';
import { portalsOf } from './chance.js';

export const portalsPicture = (title, portals, line) => ({ title, box, draw(surface, camera, tones) {
    drawPortals(surface, camera, tones, portals);
    if (line) strokeLines(surface, camera, [line], tones.sourceEdge, 2.5);
} });

/** Portals with a verdict that an eye can check: all of them half a unit wider or narrower give the same one. */
export function clearPortals(chance, lab, count, verdict) {
    return chance.until(() => {
        const portals = portalsOf(chance, count), by = (more) => lab.core.conflict(portals.map(([x, l, , r]) => [x, l + more, x, r - more])).verdict;
        return by(0) === verdict && by(0.4) === verdict && by(-0.4) === verdict ? portals : null;
    });
}

function passes(chance, lab) {
    const isWanted = chance.next() < 0.5, portals = clearPortals(chance, lab, chance.whole(3, 4), isWanted ? 'stabbed' : 'hidden');
    return yesNo('Does a straight line pass all portals?', isWanted, 'A line passes if all ends L lie above it and all ends R below it. Lay a ruler on the picture.', portalsPicture('Portals in a row', portals));
}

function wrong(chance) {
    const { portals, a, b, bad } = chance.until(() => {
        const list = portalsOf(chance, 4), [p, q] = [[0, chance.whole(2, 10)], [18, chance.whole(2, 10)]];
        const off = (x, y) => side(p, q, x, y) / 18, names = list.flatMap(([lx, ly, rx, ry], portal) => [...(off(lx, ly) < 0 ? [{ portal, side: 'L' }] : []), ...(off(rx, ry) > 0 ? [{ portal, side: 'R' }] : [])]);
        const isClear = list.every(([lx, ly, rx, ry]) => Math.abs(off(lx, ly)) > 0.4 && Math.abs(off(rx, ry)) > 0.4);
        return isClear && names.length ? { portals: list, a: p, b: q, bad: names.map(nameOf) } : null;
    });
    return number('The line goes from left to right. How many ends of portals are on its wrong side?', bad.length, `These ends are: ${bad.join(', ')}.`,
        'Each L must lie above the line, and each R below it.', portalsPicture('Portals and a line', portals, long(a, b)));
}

function sign(chance) {
    const [a, b, p] = Array.from({ length: 3 }, () => [chance.whole(-6, 6), chance.whole(-6, 6)]), value = side(a, b, ...p);
    const why = `(${b[0]} - ${a[0]}) * (${p[1]} - ${a[1]}) - (${b[1]} - ${a[1]}) * (${p[0]} - ${a[0]}) is ${value}.`.replaceAll('- -', '+ ');
    return choice(`On which side of the line from a = (${a.join(', ')}) to b = (${b.join(', ')}) lies p = (${p.join(', ')})?`,
        [['On the left.', why], ['On the right.', why], ['On the line.', why]], value > 0 ? 0 : value < 0 ? 1 : 2);
}

function dual(chance) {
    const [a, b] = [chance.whole(-3, 3) || 2, chance.whole(-5, 5)], x = chance.whole(1, 6);
    return number(`The point (${a}, ${b}) of the dual plane is a line y = a x + b. At which height does this line pass x = ${x}?`, a * x + b, `${a} times ${x}, plus ${b}, is ${a * x + b}.`,
        'The first number of the point is the slope, the second one the height at x = 0.');
}

export const kinds = [passes, wrong, sign, dual];
