/** The runtime of games on the page's own thread: it answers while the pointer moves. */

/** @param {Uint8Array} slv @returns {Promise<any>} */
export async function openLevel(slv) {
    const { Level } = await import('../package/sightline.js');
    return Level.open(slv);
}
