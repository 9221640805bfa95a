/**
 * Visibility graph analysis: a grid of points in a map, which of them see each other, and measures
 * under the names that depthmapX gives them. The WebAssembly module is loaded by the first call.
 *
 * A group of measures is computed when one of them is asked for, and kept.
 */
import { flagOf, indexOf, listOf, numberOf, objectOf, optionsOf, textOf, wholeOf } from './arguments.js'
import { SightlineError, bytesOf } from './host.js'
import { isBaked } from './maptext.js'
import { Module, instantiable, loadedOnce } from './module.js'

export { SightlineError }

/** Measures that the module lists: name, group and unit of each, in the order of their values. */
const rowsOf = (core, at) => Object.freeze(core.textAt(at).toLowerCase().match(/.+/g).map((line) => {
  const [name, group, unit] = line.split(' ')
  return Object.freeze({ name, group, unit })
}))

/** The place of a measure among some. */
const placeOf = (rows, what, name) => {
  const place = rows.findIndex((row) => row.name === textOf(what, name))
  if (place < 0) throw new SightlineError(`there is no ${what} '${name}'`)
  return place
}

/** A made graph. Close it. */
export class Graph {
  #core
  #at
  #generation
  #values = new Map()

  /** Use graph(). */
  constructor(core, at, step) {
    this.#core = core
    this.#at = at
    this.#generation = core.generation
    const [count, points, columns, rows, squares, directed] = core.given(6)
    const [left, bottom] = core.givenNumbers(2)
    Object.assign(this, { step, count, columns, rows, left, bottom, directed: directed === 1 })
    this.points = new Float64Array(core.memory.buffer, points, 2 * count).slice()
    this.squares = new Uint32Array(core.memory.buffer, squares, count).slice()
  }

  get #place() {
    if (this.#at && this.#generation === this.#core.generation) return this.#at
    throw new SightlineError(this.#at ? 'the module stopped, and the graph is lost' : 'the graph is closed')
  }

  /** All measures of points: name, group, unit. */
  get measures() {
    return this.#core.measures
  }

  /** Likewise, of all depths from a point. */
  get depths() {
    return this.#core.depths
  }

  /** A column of the table that the last call left: values that are not defined are NaN. */
  #column({ length: width }, k) {
    const table = new Float64Array(this.#core.memory.buffer, this.#core.given(1)[0], width * this.count)
    return Float64Array.from({ length: this.count }, (_, p) => table[width * p + k])
  }

  /** A measure of all points; computes its group, where that is not done yet. */
  values(name, given) {
    const options = optionsOf(given, 'progress', 'timeLimit')
    const { measures } = this, k = placeOf(measures, 'measure', name), at = this.#place
    if (!this.#values.has(name)) {
      this.#core.watched(options, () => this.#core.ask((core) => core.graph_measure(at, k)))
      measures.forEach((row, i) => {
        if (row.group === measures[k].group) this.#values.set(row.name, this.#column(measures, i))
      })
    }
    return this.#values.get(name).slice()
  }

  /** The point in whose square a place lies, or -1. */
  find(x, y) {
    return this.#core.core.graph_find(this.#place, numberOf('x', x), numberOf('y', y))
  }

  /** How far all points are from the point at a place: NaN where nothing leads; null without a point there. */
  depth(x, y, name = 'visual_step_depth') {
    const { depths } = this, k = placeOf(depths, 'depth', name), from = this.find(x, y), at = this.#place
    if (from < 0) return null
    this.#core.ask((core) => core.graph_depth(at, k, from))
    return this.#column(depths, k)
  }

  /** Whether one point sees another, by their numbers. */
  sees(a, b) {
    const at = this.#place
    for (const point of [a, b]) indexOf('point', point, this.count)
    return this.#core.core.graph_sees(at, a, b) === 1
  }

  /** Gives back the memory. */
  close() {
    if (this.#at && this.#generation === this.#core.generation) this.#core.core.graph_close(this.#at)
    this.#at = 0
  }
}

/** The loaded module, for calls without promises. */
class GraphCore extends Module {
  /** All measures of points: name, group, unit. */
  measures = rowsOf(this, this.core.graph_rows())
  /** All depths from a point, likewise. */
  depths = rowsOf(this, this.core.depth_rows())

  #open(map, options) {
    if (!isBaked(map))
      return this.withMap(map, options, (name, at, size, items) => {
        const place = this.run((core) => core.graph_open(name, at, size, 0, options.entrance ?? 0))
        if (!place) throw this.failure(items)
        return place
      })
    const bytes = bytesOf(map)
    return this.withBytes([textOf('name', options.name ?? 'map.slv'), bytes], (name, at) => {
      const place = this.run((core) => core.graph_open(name, at, bytes.length, 1, 0))
      if (!place) throw this.failure()
      return place
    })
  }

  #fill(at, { grid, doors = {}, range = -1, most = 20000, measures: wanted = [] }) {
    for (const [name, open] of Object.entries(doors))
      this.withBytes([name], (nameAt) => this.ask((core) => core.graph_set_door(at, nameAt, +open)))
    this.ask((core) => core.graph_make(at, grid, range, most))
    const made = new Graph(this, at, grid)
    for (const name of wanted) made.values(name)
    return made
  }

  /** Makes a graph and keeps it. Close it. */
  graph(map, given) {
    const options = optionsOf(given, 'grid', 'measures', 'doors', 'range', 'most', 'entrance', 'name', 'progress',
      'timeLimit')
    const { grid, range = 0, entrance = 0, most = 1, measures: wanted = [], doors = {} } = options
    numberOf('grid', grid, 0)
    numberOf('range', range, 0)
    numberOf('entrance', entrance, 0)
    wholeOf('most', most, 0xffffffff)
    for (const [name, open] of Object.entries(objectOf('doors', doors))) flagOf(`door '${name}'`, open)
    for (const name of listOf('measures', wanted)) placeOf(this.measures, 'measure', name)
    return this.watched(options, () => {
      const at = this.#open(map, options)
      try {
        return this.#fill(at, options)
      } catch (error) {
        if (error.code !== 'internal') this.core.graph_close(at)
        throw error
      }
    })
  }
}

/**
 * Loads the module. `memory`: the most bytes that it may take, 4 GiB by default.
 *
 * @param {{memory?: number}} [options]
 */
export async function load(options) {
  return new GraphCore(...(await instantiable('graph', options)))
}

const loaded = loadedOnce(load)

/** Makes a graph of a map and measures it. Close it. */
export async function graph(map, options) {
  return (await loaded()).graph(map, options)
}
