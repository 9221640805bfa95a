/**
 * The whole library: bakes maps, and answers what only a bake or its space can. The WebAssembly
 * module is loaded by the first call. `load()` gives the calls without promises, for programs that
 * ask within a frame.
 *
 * Where a call fails, SightlineError tells the line. Where the module itself stops (a stack that
 * overflows), its scenes are lost: the instance is replaced, and calls about them say so.
 */
import { flagOf, given, listOf, numberOf, optionsOf, pick, pointOf, textOf, wholeOf } from './arguments.js'
import { SightlineError, bytesOf } from './host.js'
import { isBaked, mapText } from './maptext.js'
import { Module, instantiable, loadedOnce } from './module.js'
import { MOST_MIRRORS, Scene } from './scene.js'

export { Scene, SightlineError, mapText }

function sceneOf(scene) {
  if (scene instanceof Scene) return scene
  throw new SightlineError('scene: what open() gives is needed')
}

/** A loaded module. All calls are synchronous; scenes stay until they are closed. */
export class Core extends Module {
  /** The measures of an isovist, by name. Its members have the names in camel case. */
  measures = this.textAt(this.core.region_names()).match(/\w+/g)

  /** The options, checked; those of the bake are set. `more`: the options of the call beside these. */
  #configure(asked, ...more) {
    const options = optionsOf(asked, 'method', 'subdivide', 'sight', 'insideOnly', 'stabTrees', 'check', 'weld',
      'mirrorDepth', 'doorLimit', 'samples', 'seed', 'entrance', 'start', 'stops', 'without', 'name', 'progress',
      'timeLimit', ...more)
    const { method = '', subdivide = '', sight = 'closed', insideOnly = false, stabTrees = false, check = false } = options
    if (!['closed', 'open'].includes(sight)) throw new SightlineError("sight: 'closed' or 'open' is needed")
    const flags = { insideOnly, stabTrees, check }
    for (const [name, value] of Object.entries(flags)) flagOf(name, value)
    const count = (name, most) => given(options[name], (value) => wholeOf(name, value, most))
    const numbers = [given(options.weld, (value) => numberOf('weld', value, 0)), count('mirrorDepth', MOST_MIRRORS),
      count('doorLimit', 65535), count('samples', 0xffffffff), count('seed', Number.MAX_SAFE_INTEGER),
      numberOf('entrance', options.entrance ?? 0, 0)]
    this.withBytes([textOf('method', method), textOf('subdivide', subdivide)], (a, b) =>
      this.ask((core) => core.options(a, b, +(sight === 'open'), +insideOnly, +stabTrees,
        +check, ...numbers)))
    this.#chooseMap(options)
    return options
  }

  /** What is made of a map that is read. */
  #chooseMap({ start, stops = 'sight', without = [] }) {
    const at = ['sight', 'steps', 'sound'].indexOf(stops)
    if (at < 0) throw new SightlineError("stops: 'sight', 'steps' or 'sound' is needed")
    const names = listOf('without', without).map((name) => textOf('without', name)).join(',')
    const place = Float64Array.from(start ? pointOf('start', start) : [])
    this.withBytes([new Uint8Array(place.buffer), names], (startAt, namesAt) =>
      this.ask((core) => core.map_options(start ? startAt : 0, at, namesAt)))
  }

  /** Bakes a map, or opens a baked file, and keeps it for questions. Close it. */
  open(map, options) {
    return this.#open(map, this.#configure(options))
  }

  #open(map, options) {
    if (isBaked(map)) {
      const bytes = bytesOf(map)
      return this.withBytes([textOf('name', options.name ?? 'map.slv'), bytes], (name, at) =>
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

  #withScene(map, asked, more, call) {
    const options = this.#configure(asked, ...more)
    const scene = this.#open(map, options)
    try {
      return call(scene, pick(options, ...more))
    } finally {
      scene.close()
    }
  }

  /** The bytes of the baked file. */
  bake(map, options) {
    return this.#withScene(map, options, [], (scene) => scene.slv())
  }

  /** The JSON export, version 2, as an object. */
  describe(map, options) {
    return this.#withScene(map, options, [], (scene) => scene.describe())
  }

  /** Why one cell or point sees another or not, as an object. */
  explain(map, a, b, options) {
    return this.#withScene(map, options, ['misses', 'tests', 'mirrorDepth'],
      (scene, how) => scene.explain(a, b, how))
  }

  /** What one point sees, with its measures. */
  isovist(map, x, y, options) {
    return this.#withScene(map, options, ['heading', 'fov', 'range', 'tolerance'],
      (scene, how) => scene.isovist(x, y, how))
  }

  /** Leaks, gaps, overlaps, crossings and thin cells of a map. */
  check(map, asked) {
    const { gap = 0, thin = 0, ...options } = this.#configure(asked, 'gap', 'thin')
    numberOf('gap', gap, 0)
    numberOf('thin', thin, 0)
    return this.withMap(map, options, (name, at, size, items) => {
      const status = this.watched(options, () =>
        this.run((core) => core.map_check(name, at, size, gap, thin)))
      if (status) throw this.failure(items)
      const found = JSON.parse(this.writtenText())
      if (items) for (const fault of found.faults) fault.items = fault.lines.map((line) => items[line] ?? '')
      return found
    })
  }

  /** A map as map text ('text', the default) or as an ASCII plan ('plan'). */
  writeMap(map, asked) {
    const { format = 'text', ...options } = this.#configure(asked, 'format')
    return this.withMap(map, options, (name, at, size, items) =>
      this.withBytes([textOf('format', format)], (formatAt) => {
        if (this.run((core) => core.map_write(name, at, size, formatAt))) throw this.failure(items)
        return this.writtenText()
      }))
  }

  /** The cells that an eye in an open scene sees. */
  eye(scene, x, y, options) {
    return sceneOf(scene).look(x, y, options)
  }

  /** The stab tree of a cell of an open scene. */
  stabTree(scene, cell, options) {
    return sceneOf(scene).stabTree(cell, options)
  }

  /** Places portals, each [left x, left y, right x, right y], for dual() and conflict(). */
  #withPortals(portals, call) {
    const list = Array.isArray(portals) ? portals.map((ends) => (Array.isArray(ends) ? ends : [])) : []
    const flat = Float64Array.from(list.flat())
    if (!list.length || list.some((ends) => ends.length !== 4 || !ends.every(Number.isFinite)))
      throw new SightlineError('portals: a list of [left x, left y, right x, right y] is needed')
    return this.withBytes([new Uint8Array(flat.buffer)], (at) => call(at))
  }

  /**
   * The lines through a portal sequence as a polygon of the dual plane: to be shown. Corners are
   * slope and height, in the frame that origin, along and scale give.
   */
  dual(portals, options) {
    return this.#withPortals(portals, (at) => {
      const { cutting = portals.length } = optionsOf(options, 'cutting')
      wholeOf('cutting', cutting, portals.length)
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

const core = loadedOnce(load)

export const bake = async (map, options) => (await core()).bake(map, options)
export const describe = async (map, options) => (await core()).describe(map, options)
export const explain = async (map, a, b, options) => (await core()).explain(map, a, b, options)
export const isovist = async (map, x, y, options) => (await core()).isovist(map, x, y, options)
export const check = async (map, options) => (await core()).check(map, options)
/** Bakes or opens a map and keeps it for questions: a Scene. Close it. */
export const query = async (map, options) => (await core()).open(map, options)
