/**
 * Between places: what is seen from a line or an area, what may be seen within reach, and the
 * shortest way. The WebAssembly module is loaded by the first call.
 */
import { flagOf, given, listOf, numberOf, optionsOf, pointOf } from './arguments.js'
import { OpenFloor, floorsOf } from './floor.js'
import { SightlineError } from './host.js'

export { SightlineError }

/** Points as bytes of x, y ..., and their number. */
function pointsOf(name, points) {
  const flat = Float64Array.from(listOf(name, points).flatMap((point) => pointOf(name, point)))
  return [new Uint8Array(flat.buffer), flat.length / 2]
}

/**
 * As many corners as sl_set_of_disc() gives a disc whose chords are within a thousandth of its radius. The module
 * would bring sines of its own.
 */
const CORNERS = 71

function discOf([x, y], radius) {
  return Array.from({ length: CORNERS }, (_, i) => {
    const angle = (2 * Math.PI * i) / CORNERS
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)]
  })
}

/** A set as bytes; its number of points, whether it is an area, whether all must see; and the range, below 0: the map's. */
function setOf(points, options) {
  const { area = false, seen = 'some', radius = 0, range } = optionsOf(options, 'area', 'seen', 'radius', 'range')
  if (seen !== 'some' && seen !== 'all') throw new SightlineError(`seen: 'some' or 'all' is needed, not ${seen}`)
  const isDisc = numberOf('radius', radius, 0) > 0, list = listOf('points', points)
  if (isDisc && list.length !== 1) throw new SightlineError('radius: points must be one point, the middle of a disc')
  const [bytes, count] = pointsOf('points', isDisc ? discOf(pointOf('points', list[0]), radius) : list)
  const asked = [count, +(flagOf('area', area) || isDisc), +(seen === 'all')]
  return [bytes, asked, given(range, (value) => numberOf('range', value, 0))]
}

/** The inside of a map. Close it. Use open(). */
export class Floor extends OpenFloor {
  /** Asks the module with blocks of bytes, within a range. */
  #within(range, blocks, call) {
    const { at, core } = this, { generation } = core
    if (range >= 0) core.ask((its) => its.floor_set_range(at, range))
    try {
      return core.withBytes(blocks, call)
    } finally {
      if (range >= 0 && generation === core.generation) core.core.floor_set_range(at, -1)
    }
  }

  /** What is seen from some point of a line, an area or a disc, or from all of its points. */
  regionFrom(points, options) {
    const { at, core } = this, [bytes, asked, range] = setOf(points, options)
    this.#within(range, [bytes], (pointsAt) => core.ask((its) => its.floor_region_from(at, pointsAt, ...asked)))
    const [loops, endsAt, cornersAt, walled] = core.given(4), [area] = core.givenNumbers(1)
    const ends = [0, ...new Uint32Array(core.memory.buffer, endsAt, loops)]
    const corners = this.numbers(cornersAt, 2 * ends[loops])
    return { area, walled: walled === 1, loops: ends.slice(1).map((end, i) => corners.slice(2 * ends[i], 2 * end)) }
  }

  /** Which places are seen from a line, an area or a disc. */
  seenFrom(points, places, options) {
    const { at, core } = this, [bytes, asked, range] = setOf(points, options), [placeBytes, placeCount] = pointsOf('places', places)
    return this.#within(range, [bytes, placeBytes, new Uint8Array(placeCount)], (pointsAt, placesAt, seenAt) => {
      core.ask((its) => its.floor_seen_from(at, pointsAt, ...asked, placesAt, placeCount, seenAt))
      return Array.from(new Uint8Array(core.memory.buffer, seenAt, placeCount), (seen) => seen === 1)
    })
  }

  /** What of each thing is seen from a path, and from how much of the path. */
  exposure(path, things, options) {
    const { at, core } = this, { area = false } = optionsOf(options, 'area')
    const [way, wayCount] = pointsOf('path', path), lists = listOf('things', things).map((thing) => listOf('things', thing))
    const [bytes] = pointsOf('things', lists.flat()), counts = Uint32Array.from(lists, ({ length }) => length)
    const blocks = [way, bytes, new Uint8Array(counts.buffer), new Uint8Array(40 * lists.length)]
    const isArea = +flagOf('area', area)
    return core.withBytes(blocks, (wayAt, pointsAt, countsAt, rowsAt) => {
      core.ask((its) => its.floor_exposure(at, wayAt, wayCount, pointsAt, countsAt, lists.length, isArea, rowsAt))
      const rows = this.numbers(rowsAt, 5 * lists.length)
      return lists.map((_, i) => {
        const [size, seen, pathSome, pathAll, first] = rows.subarray(5 * i)
        return { size, seen, pathSome, pathAll, first: Number.isNaN(first) ? null : first }
      })
    })
  }

  /** Whether some place near a may see some place near b. */
  seesWithin(a, aRadius, b, bRadius, options) {
    const { at, core } = this, { onFoot = false } = optionsOf(options, 'onFoot')
    const from = [...pointOf('a', a), numberOf('aRadius', aRadius, 0)]
    const to = [...pointOf('b', b), numberOf('bRadius', bRadius, 0)], foot = +flagOf('onFoot', onFoot)
    core.ask((its) => its.floor_sees_within(at, ...from, ...to, foot))
    return core.given(1)[0] === 1
  }

  /** The shortest way from a to b; null: there is none. */
  path(a, b, options) {
    const { at, core } = this, { loss, radius = 0 } = optionsOf(options, 'loss', 'radius')
    const ends = [...pointOf('a', a), ...pointOf('b', b)], shut = given(loss, (value) => numberOf('loss', value, 0))
    core.ask((its) => its.floor_path(at, ...ends, shut, numberOf('radius', radius, 0)))
    const [found, count, pointsAt] = core.given(3), [length] = core.givenNumbers(1)
    return found ? { length, points: this.numbers(pointsAt, 2 * count) } : null
  }
}

/**
 * Loads the module, for calls without promises. `memory`: the most bytes that it may take, 4 GiB by default.
 * Reads a map for questions about lines, areas and ways.
 */
export const { load, open } = floorsOf('ways', Floor)
