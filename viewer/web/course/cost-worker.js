/**
 * Runs methods on one map, one after the other, beside the page. Each answer is a message of its own; the
 * last message is { done: true }. The map, the methods and their limit in seconds come in one message.
 *
 * Pairs are counted as the command `compare` counts them: ordered, and each cell with itself too.
 * They are compared with those of the sweep.
 */
import { load } from '../package/bake.js';
import { cellAt, middleOf } from './lab.js';

/**
 * Rounds after the first one, and how long a method runs in each, in milliseconds. A browser's clock is rough, it
 * compiles code better while it runs, and other programs disturb: so the least time of all rounds counts.
 */
const ROUNDS = 4, REPEAT = 40;

/** Methods that take longer, in seconds, run once. */
const LONG = 0.4;

/** Who sees whom, as ordered pairs; `seen` gives the cells that a cell sees. */
function pairsOf({ cellCount }, seen) {
    const pairs = new Set();
    for (let a = 0; a < cellCount; a++) for (const b of seen(a)) pairs.add(a * cellCount + b);
    return pairs;
}

/** One eye in the middle of each cell inside; the rows of other cells hold at most themselves. */
function lookFromMiddles(scene) {
    const eyes = Array.from({ length: scene.cellCount }, (_, i) => middleOf(scene, i));
    const begin = performance.now(), rows = eyes.map((eye, i) => (cellAt(scene, eye) < 0 ? scene.row(i) : scene.look(...eye)));
    return { seconds: (performance.now() - begin) / 1000, rows };
}

/** Why a method refuses a map, without what helps at a command line alone. */
const reasonOf = (error) => error.message.replace(/^\S+:\d+: /, '').split(/[:;]/)[0];

/** One run: its time in seconds, and who sees whom where that is asked for. */
function runOnce(core, text, { options, isEye }, seconds, isAsked) {
    const scene = core.open(text, { ...options, timeLimit: seconds });
    try {
        const look = isEye && lookFromMiddles(scene), rows = look?.rows;
        return { seconds: look ? look.seconds : scene.account.seconds.see, guarantee: isEye ? 'aggressive' : scene.guarantee,
            pairs: isAsked && pairsOf(scene, (cell) => rows?.[cell] ?? scene.row(cell)) };
    } finally {
        scene.close();
    }
}

/** The mean time of runs, for as long as a round takes. */
function meanTime(core, text, method, seconds) {
    const begin = performance.now();
    let spent = 0, runs = 0;
    for (; runs === 0 || performance.now() - begin < REPEAT; runs++) spent += runOnce(core, text, method, seconds).seconds;
    return spent / runs;
}

/** All methods once: what they find, and a first time. */
function firstRound(core, text, methods, seconds) {
    let exact = null;
    return methods.map((method, number) => {
        let answer;
        try {
            const { pairs, ...rest } = runOnce(core, text, method, seconds, true);
            exact ??= pairs;
            const missed = [...exact].filter((pair) => !pairs.has(pair)), added = [...pairs].filter((pair) => !exact.has(pair));
            answer = { number, ...rest, pairs: pairs.size, missed, added };
        } catch (error) {
            answer = { number, refused: error.code === 'interrupted' ? `no answer in ${seconds} seconds` : reasonOf(error) };
        }
        postMessage(answer);
        return answer;
    });
}

onmessage = async ({ data: { text, methods, seconds } }) => {
    const core = await load({ memory: 2 ** 30 }), answers = firstRound(core, text, methods, seconds);
    for (let round = 0; round < ROUNDS; round++)
        for (const answer of answers.filter((a) => !a.refused && a.seconds < LONG)) {
            const time = meanTime(core, text, methods[answer.number], seconds);
            if (round > 0 && time >= answer.seconds) continue; // the first time is of one run alone
            answer.seconds = time;
            postMessage(answer);
        }
    postMessage({ done: true });
};
