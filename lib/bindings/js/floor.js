/**
 * A map or a baked file that is open for questions, and the module that opens it. What may be asked,
 * place.js, cameras.js and ways.js say.
 */
import { flagOf, numberOf, objectOf, optionsOf, textOf } from './arguments.js'
import { SightlineError, bytesOf } from './host.js'
import { isBaked } from './maptext.js'
import { Module, instantiable, loadedOnce } from './module.js'

/** Close it. */
export class OpenFloor {
  #at
  #generation

  /** @internal */
  constructor(core, at) {
    /** @internal */
    this.core = core
    this.#at = at
    this.#generation = core.generation
  }

  /** Its place in the module. @internal */
  get at() {
    if (this.#at && this.#generation === this.core.generation) return this.#at
    throw new SightlineError(this.#at ? 'the module stopped, and the floor is lost' : 'the floor is closed')
  }

  /** A copy of numbers that the module gave. @internal */
  numbers(at, count) {
    return new Float64Array(this.core.memory.buffer, at, count).slice()
  }

  /** The points that begin rows of `stride` numbers. @internal */
  placesAt(at, count, stride) {
    const rows = this.numbers(at, stride * count)
    return Array.from({ length: count }, (_, i) => ({ x: rows[stride * i], y: rows[stride * i + 1] }))
  }

  /** Opens or shuts a door. */
  setDoor(name, open) {
    const { at } = this
    flagOf(`door '${textOf('door', name)}'`, open)
    this.core.withBytes([name], (nameAt) => this.core.ask((its) => its.floor_set_door(at, nameAt, +open)))
  }

  /** Gives back the memory. */
  close() {
    if (this.#at && this.#generation === this.core.generation) this.core.core.floor_close(this.#at)
    this.#at = 0
  }
}

/** The loaded module, for calls without promises. */
class FloorCore extends Module {
  #Floor

  constructor(Floor, module, pages) {
    super(module, pages)
    this.#Floor = Floor
  }

  #read(map, { name, entrance = 0 }) {
    if (!isBaked(map))
      return this.withMap(map, { name }, (nameAt, at, size, items) => {
        const floor = this.run((core) => core.floor_open(nameAt, at, size, 0, entrance))
        if (!floor) throw this.failure(items)
        return floor
      })
    const bytes = bytesOf(map)
    return this.withBytes([textOf('name', name ?? 'map.slv'), bytes], (nameAt, at) => {
      const floor = this.run((core) => core.floor_open(nameAt, at, bytes.length, 1, 0))
      if (!floor) throw this.failure()
      return floor
    })
  }

  /** Reads a map. Close the floor. */
  open(map, given) {
    const options = optionsOf(given, 'doors', 'entrance', 'name')
    numberOf('entrance', options.entrance ?? 0, 0)
    const doors = Object.entries(objectOf('doors', options.doors ?? {}))
    const floor = new this.#Floor(this, this.#read(map, options))
    try {
      for (const [name, open] of doors) floor.setDoor(name, open)
      return floor
    } catch (error) {
      floor.close()
      throw error
    }
  }
}

/** load() and open() of the module of that name, whose floors are of a class. */
export function floorsOf(name, Floor) {
  const load = async (options) => new FloorCore(Floor, ...(await instantiable(name, options)))
  const loaded = loadedOnce(load)
  return { load, open: async (map, options) => (await loaded()).open(map, options) }
}
