/**
 * Cameras: which of given places and headings see everything, or the most that a number of them can,
 * and what given ones see together. The WebAssembly module is loaded by the first call.
 *
 * All work is done before a call returns: where a page must not wait, ask in a worker.
 */
import { flagOf, listOf, numberOf, optionsOf, wholeOf } from './arguments.js'
import { CoverFloor, rowOf } from './coverage.js'
import { floorsOf } from './floor.js'
import { SightlineError } from './host.js'

export { SightlineError }

const FROM = ['corners', 'walls', 'grid'], MOST = 2 ** 32 - 1

/** The inside of a map, for cameras. Close it. Use open(). */
export class Floor extends CoverFloor {
  /** Points where cameras may stand: at corners, along walls, on a grid. */
  points(from, step = 0) {
    const { at, core } = this
    if (!FROM.includes(from)) throw new SightlineError(`from: one of ${FROM.join(', ')} is needed`)
    numberOf('step', step, 0)
    core.ask((its) => its.floor_points(at, FROM.indexOf(from), step))
    const [count, pointsAt] = core.given(2)
    return this.placesAt(pointsAt, count, 2)
  }

  /** The fewest of the places that see all that they can see; with `count`, the most that so many see. */
  choose(places, given) {
    const options = optionsOf(given, 'fixed', 'cover', 'count', 'network', 'progress', 'stop', 'timeLimit'), { at, core } = this
    const { fixed = [], cover = 1, count = 0, network = false } = options
    const all = [...listOf('fixed', fixed), ...listOf('places', places)], rows = Float64Array.from(all.flatMap(rowOf))
    wholeOf('cover', cover, MOST)
    wholeOf('count', count, MOST)
    flagOf('network', network)
    core.withBytes([new Uint8Array(rows.buffer)], (rowsAt) => core.watched(options, () =>
      core.ask((its) => its.floor_choose(at, rowsAt, all.length, fixed.length, cover, count, +network))))
    const [lower, upper, chosen, chosenAt, proofAt, stopped] = core.given(6)
    const [area, seen, seenMost, blindArea] = core.givenNumbers(4)
    const numbers = new Uint32Array(core.memory.buffer, chosenAt, chosen)
    return {
      lower, upper, stopped: stopped === 1, area, seen, blindArea,
      optimal: count ? seen === seenMost : lower === upper,
      ...(count ? { seenMost } : {}),
      viewpoints: Array.from(numbers, (i) => ({ ...all[i] })),
      proof: core.textAt(proofAt),
    }
  }
}

/**
 * Loads the module, for calls without promises. `memory`: the most bytes that it may take, 4 GiB by default.
 * Reads a map for questions about cameras.
 */
export const { load, open } = floorsOf('cameras', Floor)
