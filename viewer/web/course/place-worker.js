/** Finds the fewest guards of a map beside the page. Both bounds are messages as they come, then the placement. */
import { load } from '../package/place.js';

onmessage = async ({ data: { text, seconds } }) => {
    const floor = (await load({ memory: 2 ** 28 })).open(text);
    const placement = floor.place({ timeLimit: seconds, progress: (_, lower, upper) => postMessage({ lower, upper }) });
    postMessage({ lower: placement.lower, upper: placement.upper, placement });
};
