/**
 * The whole library: bakes maps, and answers what only a bake or its space can. The WebAssembly
 * module is loaded by the first call. `load()` gives the calls without promises, for programs that
 * ask within a frame.
 *
 * Where a call fails, SightlineError tells the line. Where the module itself stops (a stack that
 * overflows), its scenes are lost: the instance is replaced, and calls about them say so.
 */
import { SightlineError, bytesOf } from './host.js'
import { isBaked, mapText } from './maptext.js'
import { Module, instantiable } from './module.js'
import { Scene } from './scene.js'

export { SightlineError, mapText }

/** A loaded module. All calls are synchronous; scenes stay until they are closed. */
export class Core extends Module {
  #configure(options = {}) {
    const known = ['method', 'subdivide', 'sight', 'insideOnly', 'stabTrees', 'check', 'weld', 'mirrorDepth',
      'doorLimit', 'samples', 'seed', 'name', 'progress', 'timeLimit', 'version', 'misses', 'tests',
      'gap', 'thin', 'heading', 'fov', 'range', 'tolerance', 'format']
    for (const name of Object.keys(options))
      if (!known.includes(name)) throw new SightlineError(`there is no option '${name}'`)
    const { method = '', subdivide = '', sight = 'closed', insideOnly = false, stabTrees = false,
      check = false, weld = -1, mirrorDepth = -1, doorLimit = -1, samples = -1, seed = -1 } = options
    if (!['closed', 'open'].includes(sight)) throw new SightlineError("sight: 'closed' or 'open' is needed")
    if (mirrorDepth > 16) throw new SightlineError('mirrorDepth: 0 to 16 is needed')
    this.withBytes([method, subdivide], (a, b) =>
      this.ask((core) => core.options(a, b, +(sight === 'open'), +insideOnly, +stabTrees,
        +check, weld, mirrorDepth, doorLimit, samples, seed)))
  }

  /** Bakes a map, or opens a baked file, and keeps it for questions. Close it. */
  open(map, options = {}) {
    this.#configure(options)
    if (isBaked(map)) {
      const bytes = bytesOf(map)
      return this.withBytes([options.name ?? 'map.slv', bytes], (name, at) =>
        this.#scene(this.run((core) => core.scene_open(name, at, bytes.length))))
    }
    return this.withMap(map, options, (name, at, size, items) =>
      this.watched(options, () =>
        this.#scene(this.run((core) => core.scene_bake(name, at, size)), items)))
  }

  #scene(at, items) {
    if (!at) throw this.failure(items)
    return new Scene(this, at, items)
  }

  #withScene(map, options, call) {
    const scene = this.open(map, options)
    try {
      return call(scene)
    } finally {
      scene.close()
    }
  }

  /** The bytes of the baked file. */
  bake(map, options) {
    return this.#withScene(map, options, (scene) => scene.slv())
  }

  /** The JSON export, version 2, as an object. */
  describe(map, options) {
    return this.#withScene(map, options, (scene) => scene.describe())
  }

  /** Why one cell or point sees another or not, as an object. */
  explain(map, a, b, options) {
    return this.#withScene(map, options, (scene) => scene.explain(a, b, options))
  }

  /** What one point sees, with its measures. */
  isovist(map, x, y, options) {
    return this.#withScene(map, options, (scene) => scene.isovist(x, y, options))
  }

  /** Leaks, gaps, overlaps, crossings and thin cells of a map. */
  check(map, options = {}) {
    this.#configure(options)
    return this.withMap(map, options, (name, at, size, items) => {
      const status = this.watched(options, () =>
        this.run((core) => core.map_check(name, at, size, options.gap ?? 0, options.thin ?? 0)))
      if (status) throw this.failure(items)
      const found = JSON.parse(this.writtenText())
      if (items) for (const fault of found.faults) fault.items = fault.lines.map((line) => items[line] ?? '')
      return found
    })
  }

  /** A map as map text ('text', the default) or as an ASCII plan ('plan'). */
  writeMap(map, { format = 'text', ...options } = {}) {
    this.#configure(options)
    return this.withMap(map, options, (name, at, size, items) =>
      this.withBytes([format], (formatAt) => {
        if (this.run((core) => core.map_write(name, at, size, formatAt))) throw this.failure(items)
        return this.writtenText()
      }))
  }

  /** The cells that an eye in an open scene sees. */
  eye(scene, x, y, options) {
    return scene.look(x, y, options)
  }

  /** The stab tree of a cell of an open scene. */
  stabTree(scene, cell, options) {
    return scene.stabTree(cell, options)
  }

  /** Places portals, each [left x, left y, right x, right y], for dual() and conflict(). */
  #withPortals(portals, call) {
    const flat = Float64Array.from(portals.flat())
    if (flat.length !== 4 * portals.length || !portals.length || flat.some((n) => !Number.isFinite(n)))
      throw new SightlineError('portals: a list of [left x, left y, right x, right y] is needed')
    return this.withBytes([new Uint8Array(flat.buffer)], (at) => call(at))
  }

  /**
   * The lines through a portal sequence as a polygon of the dual plane: to be shown. Corners are
   * slope and height, in the frame that origin, along and scale give.
   */
  dual(portals, { cutting = portals.length } = {}) {
    return this.#withPortals(portals, (at) => {
      this.run((core) => core.dual(at, portals.length, cutting))
      const [ox, oy, ax, ay, scale, slope, height, margin] = this.givenNumbers(8)
      const [count, corners] = this.given(2)
      return {
        origin: [ox, oy], along: [ax, ay], scale, best: { slope, height }, margin,
        corners: new Float64Array(this.memory.buffer, corners, 2 * count).slice(),
      }
    })
  }

  /** What keeps lines from a portal sequence: the verdict and the few ends that prove it. Exact. */
  conflict(portals) {
    return this.#withPortals(portals, (at) => {
      this.ask((core) => core.conflict(at, portals.length))
      const [verdict, turns, count, ...ends] = this.given()
      return {
        verdict: ['hidden', 'grazing', 'stabbed'][verdict], turns: !!turns,
        ends: Array.from({ length: count }, (_, i) => ({ portal: ends[2 * i], side: ends[2 * i + 1] ? 'left' : 'right' })),
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
  return new Core(...(await instantiable('core', options)))
}

/** @type {Promise<Core> | undefined} */
let shared
const core = () => (shared ??= load().catch((error) => {
  shared = undefined
  throw error
}))

export const bake = async (map, options) => (await core()).bake(map, options)
export const describe = async (map, options) => (await core()).describe(map, options)
export const explain = async (map, a, b, options) => (await core()).explain(map, a, b, options)
export const isovist = async (map, x, y, options) => (await core()).isovist(map, x, y, options)
export const check = async (map, options) => (await core()).check(map, options)
/** Bakes or opens a map and keeps it for questions: a Scene. Close it. */
export const query = async (map, options) => (await core()).open(map, options)
