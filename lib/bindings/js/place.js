/**
 * Viewpoints (cameras, guards): what given ones see together, and where the fewest must stand. The
 * WebAssembly module is loaded by the first call.
 *
 * All work is done before a call returns: where a page must not wait, ask in a worker.
 */
import { numberOf, optionsOf } from './arguments.js'
import { CoverFloor } from './coverage.js'
import { floorsOf } from './floor.js'
import { SightlineError } from './host.js'

export { SightlineError }

const FROM = ['anywhere', 'corners', 'walls', 'grid']

/** The inside of a map, for viewpoints. Close it. Use open(). */
export class Floor extends CoverFloor {
  /** The fewest viewpoints that see all, with both bounds. Stopped, it gives what it has. */
  place(given) {
    const options = optionsOf(given, 'from', 'step', 'progress', 'stop', 'timeLimit'), { at, core } = this
    const { from = 'anywhere', step = 0 } = options
    if (!FROM.includes(from)) throw new SightlineError(`from: one of ${FROM.join(', ')} is needed`)
    numberOf('step', step, 0)
    core.watched(options, () => core.ask((its) => its.floor_place(at, FROM.indexOf(from) - 1, step)))
    const [lower, upper, count, viewpointsAt, witnessesAt, rounds, slivers, stopped] = core.given(8)
    const [unseenArea] = core.givenNumbers(1)
    // Rows are x, y, heading, fov, range, nearest and a flag in 8 bytes; x, y and a flag in 8 bytes.
    const made = {
      lower, upper, optimal: lower === upper, stopped: stopped === 1, rounds, slivers, unseenArea,
      viewpoints: this.placesAt(viewpointsAt, upper, 7),
      witnesses: this.placesAt(witnessesAt, count, 3),
      proof: core.textAt(core.core.floor_proof(at)),
    }
    // Laid over the inside anew: whatever went wrong before, they see it all.
    const { areas } = this.cover(made.viewpoints), all = areas.reduce((sum, area) => sum + area, 0)
    if (areas[0] > unseenArea + 1e-9 * all)
      throw new SightlineError(`no viewpoints were found that see everything: ${areas[0]} of ${all} is unseen`,
        { code: 'unsupported' })
    return made
  }
}

/**
 * Loads the module, for calls without promises. `memory`: the most bytes that it may take, 4 GiB by default.
 * Reads a map for questions about viewpoints.
 */
export const { load, open } = floorsOf('place', Floor)
