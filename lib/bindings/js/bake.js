/**
 * The whole library: bakes maps, and answers what only a bake or its space can. The WebAssembly
 * module is loaded by the first call. `load()` gives the calls without promises, for programs that
 * ask within a frame.
 *
 * Where a call fails, SightlineError tells the line. Where the module itself stops (a stack that
 * overflows), its scenes are lost: the instance is replaced, and calls about them say so.
 */
import { SightlineError, bytesOf, compile } from './host.js'
import { isBaked, mapText, rename } from './maptext.js'
import { Scene } from './scene.js'

export { SightlineError, mapText }

const PAGE = 65536
const CODES = ['ok', 'bad argument', 'bad input', 'unsupported', 'out of memory', 'interrupted',
  'input/output error']

/** Memory up to a number of pages, or to what the browser grants of them. */
function memoryOf(maximum) {
  try {
    return new WebAssembly.Memory({ initial: 64, maximum })
  } catch {
    if (maximum > 64) return memoryOf(Math.max(64, maximum >> 1))
    throw new SightlineError('out of memory', { code: 'out of memory' })
  }
}

/** A loaded module. All calls are synchronous; scenes stay until they are closed. */
export class Core {
  /** @internal */
  constructor(module, maximum) {
    this.module = module
    this.maximum = maximum
    this.generation = 0
    this.watch = null
    this.#start()
  }

  #start() {
    this.memory = memoryOf(this.maximum)
    const instance = new WebAssembly.Instance(this.module, {
      env: { memory: this.memory },
      host: {
        progress: (stage, done, total) => this.#progress(stage, done, total),
        cancelled: () => (this.watch?.stop() ? 1 : 0),
      },
      wasi_snapshot_preview1: {
        clock_time_get: (clock, precision, at) => {
          const now = BigInt(Math.round(performance.now() * 1e6))
          new DataView(this.memory.buffer).setBigUint64(at, now, true)
          return 0
        },
        // The C library mentions these, but nothing is read or written through them.
        ...Object.fromEntries(['fd_close', 'fd_fdstat_get', 'fd_prestat_get', 'fd_prestat_dir_name',
          'fd_read', 'fd_seek', 'fd_write', 'fd_fdstat_set_flags', 'path_filestat_get', 'path_open',
        ].map((name) => [name, () => 8])),
        proc_exit: () => {
          throw new SightlineError('the module stopped', { code: 'internal' })
        },
      },
    })
    this.core = instance.exports
    this.core._initialize()
    if (!this.core.begin()) throw new SightlineError('out of memory', { code: 'out of memory' })
    this.integers = this.core.integers_place()
    this.numbers = this.core.numbers_place()
    this.generation++
  }

  #progress(stage, done, total) {
    this.watch?.report(this.textAt(stage), done, total)
    return 0
  }

  /** The version of the library. */
  get version() {
    return this.textAt(this.core.version())
  }

  /** @internal */
  textAt(at) {
    const bytes = new Uint8Array(this.memory.buffer)
    return new TextDecoder().decode(bytes.slice(at, bytes.indexOf(0, at)))
  }

  /** Calls, and replaces the instance where it stops. @internal */
  run(call) {
    try {
      return call(this.core)
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error
      this.#start()
      const deep = /stack|memory access out of bounds/i.test(error.message)
      const why = deep ? 'the map goes too deep: the stack is full' : `the module stopped: ${error.message}`
      throw new SightlineError(why, { code: deep ? 'out of memory' : 'internal' })
    }
  }

  /** What failed, as an error. @internal */
  failure(items) {
    const message = rename(this.textAt(this.core.message()), items)
    return new SightlineError(message.text, { ...message, code: CODES[this.core.status()] })
  }

  /** Calls what returns a status. @internal */
  ask(call) {
    if (this.run(call)) throw this.failure()
  }

  /** Numbers that the last call gave. @internal */
  given(count = 16) {
    return new Uint32Array(this.memory.buffer, this.integers, count)
  }

  /** @internal */
  givenNumbers(count = 16) {
    return new Float64Array(this.memory.buffer, this.numbers, count)
  }

  /** A copy of the bytes that the last call wrote. @internal */
  written() {
    const at = this.core.written()
    return new Uint8Array(this.memory.buffer, at, this.given(1)[0]).slice()
  }

  /** @internal */
  writtenText() {
    const at = this.core.written()
    return new TextDecoder().decode(new Uint8Array(this.memory.buffer, at, this.given(1)[0]).slice())
  }

  /** Calls with texts and bytes in the module's memory, each with a 0 behind it. @internal */
  withBytes(blocks, call) {
    const places = []
    try {
      for (const block of blocks) {
        const bytes = typeof block === 'string' ? new TextEncoder().encode(block) : block
        const at = this.run((core) => core.take(bytes.length + 1))
        if (!at) throw new SightlineError('out of memory', { code: 'out of memory' })
        places.push(at)
        const memory = new Uint8Array(this.memory.buffer)
        memory.set(bytes, at)
        memory[at + bytes.length] = 0
      }
      const before = this.generation
      try {
        return call(...places)
      } finally {
        if (before !== this.generation) places.length = 0
      }
    } finally {
      for (const at of places) this.core.give(at)
    }
  }

  #configure(options = {}) {
    const known = ['method', 'subdivide', 'sight', 'boundary', 'stabTrees', 'check', 'weld', 'mirrorDepth',
      'doorLimit', 'samples', 'seed', 'name', 'progress', 'timeLimit', 'version', 'misses', 'tests',
      'gap', 'thin', 'direction', 'fieldOfView', 'range', 'tolerance', 'format']
    for (const name of Object.keys(options))
      if (!known.includes(name)) throw new SightlineError(`there is no option '${name}'`)
    const { method = '', subdivide = '', sight = 'closed', boundary = 'all', stabTrees = false,
      check = false, weld = -1, mirrorDepth = -1, doorLimit = -1, samples = -1, seed = -1 } = options
    if (!['closed', 'open'].includes(sight)) throw new SightlineError("sight: 'closed' or 'open' is needed")
    if (!['all', 'inside'].includes(boundary)) throw new SightlineError("boundary: 'all' or 'inside' is needed")
    if (mirrorDepth > 16) throw new SightlineError('mirrorDepth: 0 to 16 is needed')
    this.withBytes([method, subdivide], (a, b) =>
      this.ask((core) => core.options(a, b, +(sight === 'open'), +(boundary === 'inside'), +stabTrees,
        +check, weld, mirrorDepth, doorLimit, samples, seed)))
  }

  /** Sets what hears of progress and stops long work. */
  #watched(options, call) {
    const { progress, timeLimit } = options ?? {}
    if (!progress && !(timeLimit > 0)) return call()
    const until = timeLimit > 0 ? performance.now() + 1000 * timeLimit : Infinity
    let stopped = false
    this.watch = {
      report: (stage, done, total) => {
        if (progress && progress(stage, done, total) === false) stopped = true
      },
      stop: () => stopped || performance.now() > until,
    }
    this.core.watch(1)
    try {
      return call()
    } finally {
      this.watch = null
      this.core.watch(0)
    }
  }

  #withMap(map, options, call) {
    const { text, items, name } = mapText.prepare(map, options?.name)
    return this.withBytes([name, text], (nameAt, at) => call(nameAt, at, this.#size(text), items))
  }

  #size(text) {
    return typeof text === 'string' ? new TextEncoder().encode(text).length : text.length
  }

  /** Bakes a map, or opens a baked file, and keeps it for questions. Close it. */
  open(map, options = {}) {
    this.#configure(options)
    if (isBaked(map)) {
      const bytes = bytesOf(map)
      return this.withBytes([options.name ?? 'map.slv', bytes], (name, at) =>
        this.#scene(this.run((core) => core.scene_open(name, at, bytes.length))))
    }
    return this.#withMap(map, options, (name, at, size, items) =>
      this.#watched(options, () =>
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
    return this.#withMap(map, options, (name, at, size, items) => {
      const status = this.#watched(options, () =>
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
    return this.#withMap(map, options, (name, at, size, items) =>
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
export async function load({ memory = 65536 * PAGE } = {}) {
  const pages = Math.min(65536, Math.max(64, Math.floor(memory / PAGE)))
  return new Core(await compile('core', new URL('./core.wasm', import.meta.url)), pages)
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
