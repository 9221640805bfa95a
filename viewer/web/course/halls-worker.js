/** Computes the halls of the chapters beside the page, one message for each. */
import { hallOf, WIDEST } from './halls.js';
import { Lab } from './lab.js';

const lab = await Lab.open();
for (let columns = 1; columns <= WIDEST; columns++) postMessage(hallOf(lab, columns));
