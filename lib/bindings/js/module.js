/**
 * What both modules that bake share: memory, progress, errors. Where a module itself stops (a stack
 * that overflows), the instance is replaced, and what was kept in it is lost.
 */
import { numberOf, optionsOf, pick } from './arguments.js'
import { SightlineError, compile, textAt } from './host.js'
import { mapText, rename } from './maptext.js'

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

/** A loaded module. All calls are synchronous. */
export class Module {
  #bytes

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
        __proto__: Math,
        progress: (stage, done, total) => this.#progress(stage, done, total),
        cancelled: () => (this.watch?.stop() ? 1 : 0),
        // As exact as C's; c_library.c says which others are those of Math.
        fmod: (a, b) => a % b,
        number: (at) => this.#numberAt(at),
      },
      wasi_snapshot_preview1: {
        // The C library mentions these, but nothing is read or written through them.
        ...Object.fromEntries(WebAssembly.Module.imports(this.module).map(({ name }) => [name, () => 8])),
        clock_time_get: (clock, precision, at) => {
          const now = BigInt(Math.round(performance.now() * 1e6))
          new DataView(this.memory.buffer).setBigUint64(at, now, true)
          return 0
        },
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

  /** For a few letters, a decoder of text takes longer. */
  #numberAt(at) {
    if (this.#bytes?.buffer !== this.memory.buffer) this.#bytes = new Uint8Array(this.memory.buffer)
    return Number(String.fromCharCode.apply(null, this.#bytes.subarray(at, this.#bytes.indexOf(0, at))))
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
    return textAt(this.memory, at)
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
    return new TextDecoder().decode(this.written())
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

  /** Sets what hears of progress and stops long work. @internal */
  watched(options, call) {
    const { progress, stop, timeLimit = 0 } = pick(options, 'progress', 'stop', 'timeLimit')
    for (const [name, heard] of Object.entries({ progress, stop }))
      if (heard !== undefined && typeof heard !== 'function') throw new SightlineError(`${name}: a function is needed`)
    numberOf('timeLimit', timeLimit, 0)
    if (!progress && !stop && !timeLimit) return call()
    const until = timeLimit > 0 ? performance.now() + 1000 * timeLimit : Infinity
    let stopped = false
    this.watch = {
      report: (stage, done, total) => {
        if (progress && progress(stage, done, total) === false) stopped = true
      },
      stop: () => stopped || performance.now() > until || stop?.() === true,
    }
    this.core.watch(1)
    try {
      return call()
    } finally {
      this.watch = null
      this.core.watch(0)
    }
  }

  /** Calls with the name and the text of a map in memory. @internal */
  withMap(map, options, call) {
    const { text, items, name } = mapText.prepare(map, options?.name)
    return this.withBytes([name, text], (nameAt, at) => call(nameAt, at, this.size(text), items))
  }

  size(text) {
    return typeof text === 'string' ? new TextEncoder().encode(text).length : text.length
  }
}

/**
 * The compiled module of that name, and the most pages of memory that it may take.
 *
 * @param {string} name
 * @param {{memory?: number}} [options]
 * @returns {Promise<[WebAssembly.Module, number]>}
 */
export async function instantiable(name, options) {
  const { memory = 65536 * PAGE } = optionsOf(options, 'memory')
  numberOf('memory', memory, 0)
  const pages = Math.min(65536, Math.max(64, Math.floor(memory / PAGE)))
  return [await compile(name, new URL(`./${name}.wasm`, import.meta.url)), pages]
}

/** A function that gives what `load` gives, which is called once; again where it failed. @internal */
export function loadedOnce(load) {
  let shared
  return () =>
    (shared ??= load().catch((error) => {
      shared = undefined
      throw error
    }))
}
