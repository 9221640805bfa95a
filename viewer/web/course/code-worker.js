/**
 * Runs a student's function beside the page, so that a loop without end can be stopped. The page's policy forbids code
 * from text; a worker has its own. One message: the code, the name of the function, and arguments of each call. Each
 * answer is a message of its own.
 */
onmessage = ({ data: { code, name, calls } }) => {
    try {
        const call = new Function(`'use strict';\n${code}\nreturn ${name};`)();
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
