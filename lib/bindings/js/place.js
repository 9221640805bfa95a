/**
 * Viewpoints (cameras, guards): what given ones see together, and where the fewest must stand. The
 * WebAssembly module is loaded by the first call.
 *
 * All work is done before a call returns: where a page must not wait, ask in a worker.
 */
import { listOf, numberOf, objectOf, optionsOf } from './arguments.js'
import { OpenFloor, floorsOf } from './floor.js'
import { SightlineError } from './host.js'

export { SightlineError }

const FROM = ['anywhere', 'corners', 'walls', 'grid']

/** A viewpoint as six numbers. */
function rowOf(given) {
  const { x, y, heading = 0, fov = 360, range = 0, nearest = 0 } = optionsOf(objectOf('viewpoint', given), 'x', 'y',
    'heading', 'fov', 'range', 'nearest', 'name', 'seen', 'alone', 'spare')
  numberOf('x', x)
  numberOf('y', y)
  numberOf('heading', heading)
  for (const [what, value] of Object.entries({ fov, range, nearest })) numberOf(what, value, 0)
  return [x, y, heading, fov, range, nearest]
}

/** The inside of a map, for viewpoints. Close it. Use open(). */
export class Floor extends OpenFloor {
  /** What viewpoints see together. */
  cover(viewpoints) {
    const { at, core } = this
    const given = listOf('viewpoints', viewpoints), rows = Float64Array.from(given.flatMap(rowOf))
    core.withBytes([new Uint8Array(rows.buffer)], (rowsAt) => core.ask((its) => its.floor_cover(at, rowsAt, given.length)))
    const [count, corners, spots, piecesAt, cornersAt, rowsAt] = core.given(6)
    const pieces = new Uint32Array(core.memory.buffer, piecesAt, 3 * count), xy = this.numbers(cornersAt, 2 * corners)
    const table = this.numbers(rowsAt, 3 * given.length + 7 * spots)
    let from = 0
    return {
      areas: [...core.givenNumbers(4)],
      viewpoints: given.map((viewpoint, i) => {
        const [seen, alone, spare] = table.subarray(3 * i)
        return { ...viewpoint, seen, alone, spare: spare === 1 }
      }),
      blindSpots: Array.from({ length: spots }, (_, i) => {
        const [area, x, y, minX, minY, maxX, maxY] = table.subarray(3 * given.length + 7 * i)
        return { area, x, y, minX, minY, maxX, maxY }
      }),
      pieces: Array.from({ length: count }, (_, i) => {
        const end = from + 2 * pieces[3 * i], spot = pieces[3 * i + 2]
        const piece = { count: pieces[3 * i + 1], blindSpot: spot === 0xffffffff ? -1 : spot, points: xy.slice(from, end) }
        from = end
        return piece
      }),
    }
  }

  /** The fewest viewpoints that see all, with both bounds. Stopped, it gives what it has. */
  place(given) {
    const options = optionsOf(given, 'from', 'step', 'progress', 'timeLimit'), { at, core } = this
    const { from = 'anywhere', step = 0 } = options
    if (!FROM.includes(from)) throw new SightlineError(`from: one of ${FROM.join(', ')} is needed`)
    numberOf('step', step, 0)
    core.watched(options, () => core.ask((its) => its.floor_place(at, FROM.indexOf(from) - 1, step)))
    const [lower, upper, count, viewpointsAt, witnessesAt, rounds, slivers, stopped] = core.given(8)
    const [unseenArea] = core.givenNumbers(1)
    // x, y, heading, fov, range, nearest and a flag in 8 bytes; x, y and a flag in 8 bytes
    const rows = this.numbers(viewpointsAt, 7 * upper), places = this.numbers(witnessesAt, 3 * count)
    const made = {
      lower, upper, optimal: lower === upper, stopped: stopped === 1, rounds, slivers, unseenArea,
      viewpoints: Array.from({ length: upper }, (_, i) => ({ x: rows[7 * i], y: rows[7 * i + 1] })),
      witnesses: Array.from({ length: count }, (_, i) => ({ x: places[3 * i], y: places[3 * i + 1] })),
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
