/** What bench.js times in Node and in a browser alike. */

/** Runs until it has taken a while, at least three times. The least of what `time` gives. */
function least(time) {
  const end = performance.now() + 500
  let best = Infinity
  for (let i = 0; i < 3 || (performance.now() < end && i < 400); i++) best = Math.min(best, time())
  return best
}

/** The least milliseconds of each stage, added: a pause hits one stage of one run. */
export function leastStages(bake) {
  const stages = {}
  least(() => {
    for (const [stage, seconds] of Object.entries(bake())) stages[stage] = Math.min(stages[stage] ?? Infinity, seconds)
    return 0
  })
  return Object.values(stages).reduce((sum, seconds) => sum + 1000 * seconds, 0)
}

/** Places all over the map. */
export const eyesOf = ({ minX, minY, maxX, maxY }) => Array.from({ length: 1000 }, (_, i) => [
  minX + ((i * 0.618034) % 1) * (maxX - minX), minY + ((i * 0.414214) % 1) * (maxY - minY)])

/**
 * @param {any} core of `load()` @param {any} Level @param {Uint8Array} text of a map @param {Uint8Array} slv its native bake
 * @param {() => number} clock in milliseconds
 * @returns {Promise<{walls: number, same: boolean, bake: number, step: number, cells: number, polygon: number, region: number}>}
 */
export async function measure(core, Level, text, slv, clock) {
  const timed = (call) => {
    const from = clock()
    call()
    return clock() - from
  }
  const options = { name: 'bench.map' }
  const made = core.bake(text, options), same = made.length === slv.length && made.every((byte, i) => byte === slv[i])
  const bake = least(() => {
    let scene
    const time = timed(() => (scene = core.open(text, options)))
    scene.close()
    return time
  })
  const level = await Level.open(slv), scene = core.open(slv), eyes = eyesOf(level.bounds)
  const each = (ask) => (1000 * least(() => timed(() => { for (const [x, y] of eyes) ask(x, y) }))) / eyes.length
  const inside = eyes.find(([x, y]) => level.look(x, y).length) ?? eyes[0]
  const step = least(() => {
    let fresh
    const time = timed(() => {
      fresh = core.open(text, options)
      fresh.look(...inside)
      fresh.visiblePolygon(...inside)
    })
    fresh.close()
    return time
  })
  const times = {
    walls: scene.wallCount, same, bake, step, cells: each((x, y) => level.look(x, y)),
    polygon: each((x, y) => level.visiblePolygon(x, y)), region: each((x, y) => scene.visiblePolygon(x, y)),
  }
  scene.close()
  level.close()
  return times
}
