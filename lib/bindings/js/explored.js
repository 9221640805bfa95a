/**
 * Explored areas: the union of what was seen, for fog that stays. The WebAssembly module is loaded by
 * the first call.
 */
import { listOf, numberOf, optionsOf, pointOf, textOf } from './arguments.js'
import { SightlineError } from './host.js'
import { Module, instantiable, loadedOnce } from './module.js'

export { SightlineError }

const isLoop = (shape) => ArrayBuffer.isView(shape) || typeof shape[0] === 'number'

/** The x, y ... of a loop. */
function loopOf(loop) {
  const numbers = listOf('add', loop)
  if (numbers.length % 2) throw new SightlineError('add: a loop is x, y, x, y ...')
  return numbers.map((number) => numberOf('add', number))
}

/** An area that grows. Close it. */
export class Explored {
  #core
  #at
  #generation

  /** Use open(). */
  constructor(core, at) {
    this.#core = core
    this.#at = at
    this.#generation = core.generation
  }

  #ask(call) {
    if (!this.#at || this.#generation !== this.#core.generation)
      throw new SightlineError(this.#at ? 'the module stopped, and the area is lost' : 'the area is closed')
    this.#core.ask((its) => call(its, this.#at))
    return this.#core.given(3)
  }

  /** Adds a loop, x, y ..., or a list of loops. */
  add(shape) {
    const loops = (isLoop(listOf('add', shape)) ? [shape] : Array.from(shape)).map(loopOf).filter((loop) => loop.length)
    const points = Float64Array.from(loops.flat()), ends = new Uint32Array(loops.length)
    loops.reduce((end, loop, i) => (ends[i] = end + loop.length / 2), 0)
    this.#core.withBytes([new Uint8Array(points.buffer), new Uint8Array(ends.buffer)], (pointsAt, endsAt) =>
      this.#ask((its, at) => its.explored_add(at, pointsAt, endsAt, ends.length)))
  }

  /** The loops of the area, x, y ...: outer ones counter-clockwise, holes clockwise. */
  loops() {
    const [count, endsAt, pointsAt] = this.#ask((its, at) => its.explored_area(at))
    const { buffer } = this.#core.memory, ends = new Uint32Array(buffer, endsAt, count)
    const points = new Float64Array(buffer, pointsAt, count ? 2 * ends[count - 1] : 0)
    return Array.from(ends, (end, i) => points.slice(i ? 2 * ends[i - 1] : 0, 2 * end))
  }

  /** How large it is. */
  get area() {
    let sum = 0
    for (const p of this.loops())
      for (let i = 0, n = p.length; i < n; i += 2) {
        const [x, y, nextX, nextY] = [p[i] - p[0], p[i + 1] - p[1], p[(i + 2) % n] - p[0], p[(i + 3) % n] - p[1]]
        sum += (x * nextY - nextX * y) / 2
      }
    return sum
  }

  /** Whether a point is in the area, or on its border. */
  holds(point) {
    const [x, y] = pointOf('holds', point)
    return this.#ask((its, at) => its.explored_holds(at, x, y))[0] === 1
  }

  /** The area as text, for a saved game. */
  text() {
    const [size, textAt] = this.#ask((its, at) => its.explored_write(at))
    const bytes = new Uint8Array(this.#core.memory.buffer, textAt, size).slice()
    this.#core.core.explored_drop(textAt)
    return new TextDecoder().decode(bytes)
  }

  /** Gives back the memory. */
  close() {
    if (this.#at && this.#generation === this.#core.generation) this.#core.core.explored_close(this.#at)
    this.#at = 0
  }
}

/** The loaded module, for calls without promises. */
class ExploredCore extends Module {
  #made(at) {
    if (!at) throw this.failure()
    return new Explored(this, at)
  }

  /** An empty area. Close it. */
  open(given) {
    const { resolution = 0 } = optionsOf(given, 'resolution')
    numberOf('resolution', resolution, 0)
    return this.#made(this.run((its) => its.explored_open(resolution)))
  }

  /** The area of a text. Close it. */
  read(text, given) {
    const { name = 'the text' } = optionsOf(given, 'name')
    const bytes = new TextEncoder().encode(textOf('text', text))
    return this.withBytes([textOf('name', name), bytes], (nameAt, at) =>
      this.#made(this.run((its) => its.explored_read(nameAt, at, bytes.length))))
  }
}

/** Loads the module. `memory`: the most bytes that it may take, 4 GiB by default. */
export async function load(options) {
  return new ExploredCore(...(await instantiable('explored', options)))
}

const loaded = loadedOnce(load)

/** An empty area. Close it. */
export async function open(options) {
  return (await loaded()).open(options)
}

/** The area of a text. Close it. */
export async function read(text, options) {
  return (await loaded()).read(text, options)
}
