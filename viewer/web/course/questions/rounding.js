/** Questions of chapter 6: determinants, and digits that are needed for them. */
import { determinantOf } from '../exact.js';
import { choice, number } from './ask.js';

const points = (chance, most) => Array.from({ length: 3 }, () => [chance.whole(-most, most), chance.whole(-most, most)]);
const said = ([a, b, c]) => `A = (${a.join(', ')}), B = (${b.join(', ')}), C = (${c.join(', ')})`;
const valueOf = (list) => {
    const { whole, unit } = determinantOf(...list);
    return Number(whole) * 2 ** unit;
};

function determinant(chance) {
    const list = points(chance, 9), value = valueOf(list);
    return number(`What is the determinant of ${said(list)}?`, value, `It is twice the area of the triangle: ${value}.`, 'Multiply crosswise: (bx - ax) * (cy - ay) - (by - ay) * (cx - ax).');
}

function side(chance) {
    const list = points(chance, 9), isOn = chance.next() < 0.3;
    if (isOn) list[2] = [2 * list[1][0] - list[0][0], 2 * list[1][1] - list[0][1]];
    const value = valueOf(list), why = `The determinant is ${value}.`;
    return choice(`Where does C lie? ${said(list)}.`, [['Left of the line from A to B.', why], ['Right of it.', why], ['On it.', why]], value > 0 ? 0 : value < 0 ? 1 : 2);
}

function product(chance) {
    const digits = chance.whole(10, 60);
    return number(`Two whole numbers have ${digits} binary digits each. How many binary digits does their product need at most?`, 2 * digits,
        `The product of two numbers below 2^${digits} is below 2^${2 * digits}.`, 'Try with 4 digits: 15 times 15 is 225.');
}

function filter(chance) {
    const bound = chance.whole(2, 9), size = chance.of([0.2, 0.9, 1.5, 4, 20]), sign = chance.of([1, -1]), value = Number((sign * size * bound).toFixed(1));
    const why = `${Math.abs(value)} is ${Math.abs(value) > bound ? 'larger' : 'not larger'} than ${bound}.`;
    return choice(`In doubles a determinant is ${value}, and the bound of its error is ${bound}. What does the filter say?`,
        [['The sign is plus.', why], ['The sign is minus.', why], ['Nothing: compute exactly.', why]], Math.abs(value) <= bound ? 2 : value > 0 ? 0 : 1);
}

export const kinds = [determinant, side, product, filter];
