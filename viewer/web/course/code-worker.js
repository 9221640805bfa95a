/**
 * Runs a student's function beside the page, so that a loop without end can be stopped. The page's policy forbids code
 * from text; a worker has its own. One message: the code, the name of the function, and arguments of each call. The
 * worker says that it begins; each answer is a message of its own. What the code prints goes to the console of the browser, up to MOST_LINES: more would
 * hold the page up for longer than the calls take.
 */
const MOST_LINES = 100;
let lines = 0;
const ownConsole = new Proxy(console, {
    get: (all, name) => (...words) => {
        if (++lines < MOST_LINES) all[name](...words);
        else if (lines === MOST_LINES) all.log('The rest is left out.');
    },
});

onmessage = ({ data: { code, name, calls } }) => {
    postMessage({ begins: true });
    try {
        const call = new Function('console', `'use strict';\n${code}\nreturn ${name};`)(ownConsole);
        calls.forEach((given, i) => {
            try {
                postMessage({ i, value: call(...structuredClone(given)) });
            } catch (error) {
                postMessage({ i, error: String(error) });
            }
        });
    } catch (error) {
        postMessage({ i: 0, error: String(error) });
    }
};
