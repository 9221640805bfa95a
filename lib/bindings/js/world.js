/**
 * Worlds: walls that change, and questions in between. The WebAssembly module is loaded by the first
 * call. An edit counts from commit() on.
 */
import { flagOf, listOf, numberOf, objectOf, optionsOf, pointOf, textOf, viewOf, wholeOf } from './arguments.js'
import { SightlineError } from './host.js'
import { isBaked } from './maptext.js'
import { Module, instantiable, loadedOnce } from './module.js'

export { SightlineError }

const KINDS = ['wall', 'door', 'oneway', 'seam', 'mirror']
const ROWS = ['none', 'now', 'later']
const STOPS = ['sight', 'steps', 'sound', 'limited'], ALL = 7, MOST_MIRRORS = 16
const MOST = 0xffffffff

/** Four numbers of a segment: [x0, y0, x1, y1]. */
function segmentOf(segment) {
  const numbers = listOf('segment', segment)
  if (numbers.length !== 4) throw new SightlineError('segment: four numbers are needed')
  return numbers.map((number) => numberOf('segment', number))
}

/** What a wall stops, as bits. */
const bitsOf = (stops) => listOf('stops', stops).reduce((bits, name) => {
  if (!STOPS.includes(name)) throw new SightlineError(`stops: one of ${STOPS.join(', ')} is needed, not ${name}`)
  return bits | (1 << STOPS.indexOf(name))
}, 0)

/** A map whose walls change. Close it. */
export class World {
  #core
  #at
  #generation
  /** By wall that was added: what the module does not tell of it. */
  #added = new Map()
  /** Calls that take back the edits since the last commit, and those of each commit before. */
  #edits = []
  #past = []

  /** Use open(). */
  constructor(core, at) {
    this.#core = core
    this.#at = at
    this.#generation = core.generation
  }

  get #place() {
    if (this.#at && this.#generation === this.#core.generation) return this.#at
    throw new SightlineError(this.#at ? 'the module stopped, and the world is lost' : 'the world is closed')
  }

  #ask(call) {
    const at = this.#place
    this.#core.ask((its) => call(its, at))
    return this.#core.given(6)
  }

  #integers(at, count) {
    return new Uint32Array(this.#core.memory.buffer, at, count).slice()
  }

  // --- edits

  #put({ kind, segment, name = '', open = false, stops = [], oneSided = false }, ground = false) {
    const bits = bitsOf(stops)
    const number = this.#core.withBytes([name], (nameAt) =>
      this.#ask((its, at) => its.world_add(at, KINDS.indexOf(kind), nameAt, +open, bits, +oneSided, ...segment))[0])
    this.#added.set(number, { ...(kind === 'door' && { name }), ...(kind === 'seam' && { stops: [...stops] }),
      ...(kind === 'mirror' && { oneSided }), ground })
    return number
  }

  /** Adds a wall; its number. */
  add(segment, given) {
    const options = optionsOf(given, 'kind', 'name', 'open', 'stops', 'oneSided')
    const { kind = options.stops ? 'seam' : 'wall', name = 'door', open = false, stops = [], oneSided = false } = options
    if (!KINDS.includes(kind)) throw new SightlineError(`kind: one of ${KINDS.join(', ')} is needed`)
    textOf('name', name)
    flagOf('open', open)
    flagOf('oneSided', oneSided)
    if (options.stops && kind !== 'seam') throw new SightlineError(`stops: a ${kind} has none`)
    const whole = bitsOf(stops) === ALL && kind === 'seam'
    const number = this.#put({ kind: whole ? 'wall' : kind, segment: segmentOf(segment), name, open, stops, oneSided })
    this.#edits.push(() => this.#takeBack(number))
    return number
  }

  /** Adds a polygon of solid ground; the numbers of its walls. */
  addSolid(corners) {
    const flat = Float64Array.from(listOf('corners', corners).flatMap((point) => pointOf('corners', point)))
    const count = flat.length / 2
    const numbers = this.#core.withBytes([new Uint8Array(flat.buffer), new Uint8Array(4 * count)], (cornersAt, numbersAt) => {
      this.#ask((its, at) => its.world_add_solid(at, cornersAt, count, numbersAt))
      return this.#integers(numbersAt, count)
    })
    for (const number of numbers) this.#added.set(number, { ground: true })
    this.#edits.push(() => numbers.forEach((number) => this.#takeBack(number)))
    return [...numbers]
  }

  /** Removes a wall. */
  remove(number) {
    const before = this.#known(number)
    this.#ask((its, at) => its.world_remove(at, number))
    this.#edits.push(() => this.#putBack(number, before))
  }

  /** Moves a wall; it keeps its number. */
  move(number, segment) {
    const before = this.#known(number), to = segmentOf(segment)
    this.#ask((its, at) => its.world_move(at, number, ...to))
    if (before) this.#edits.push(() => this.move(number, before.segment))
  }

  /** Opens or shuts a door. */
  setOpen(number, open) {
    const before = this.#known(number)
    flagOf('open', open)
    this.#ask((its, at) => its.world_set_open(at, number, +open))
    if (before) this.#edits.push(() => this.setOpen(number, before.open))
  }

  /** A wall as it was at the last commit; null for one that was added since. */
  #known(number) {
    wholeOf('wall', number, MOST)
    return this.#core.run((its) => its.world_wall(this.#place, number)) ? this.#told(number) : null
  }

  /** A wall that was added, if it is still there. */
  #takeBack(number) {
    if (this.#known(number)) this.remove(number)
  }

  /** A wall that was removed, with its number: others that are free are taken, and left. */
  #putBack(number, before) {
    if (!before) return
    if (before.ground) throw new SightlineError(
      'undo: the last commit removed a wall of solid ground; add the polygon again', { code: 'unsupported' })
    const others = []
    for (let found; (found = this.#put(before)) !== number;) others.push(found)
    for (const other of others) this.#ask((its, at) => its.world_remove(at, other))
    this.#edits.push(() => this.remove(number))
  }

  /** Makes the edits; what cells changed. If it throws, the edits are forgotten. */
  commit() {
    const edits = this.#edits
    this.#edits = []
    const table = this.#ask((its, at) => its.world_commit(at))
    const [gone, came, rows] = [0, 2, 4].map((i) => [table[i + 1], table[i]])
    if (edits.length) this.#past.push(edits)
    return { gone: this.#integers(...gone), came: this.#integers(...came), rows: this.#integers(...rows) }
  }

  /** Forgets the edits since the last commit. */
  discard() {
    this.#core.core.world_discard(this.#place)
    this.#edits = []
  }

  /** Takes back the last commit that made edits; what cells changed, or null: there is none. */
  undo() {
    this.discard()
    const commits = this.#past.length, past = this.#past[commits - 1]
    if (!past) return null
    try {
      for (const edit of [...past].reverse()) edit()
    } catch (error) {
      this.discard()
      throw error
    }
    const changes = this.commit()
    this.#past.length = commits - 1
    return changes
  }

  // --- what there is

  /** The wall that world_wall() found. */
  #told(number) {
    const [kind, open, stops, ground, nameAt, oneSided] = this.#core.given(6), added = this.#added.get(number)
    const source = { ground: ground !== 0, ...(kind === 1 && { name: nameAt ? this.#core.textAt(nameAt) : 'door' }),
      ...(kind === 3 && { stops: STOPS.filter((_, i) => stops & (1 << i)) }), ...(kind === 4 && { oneSided: oneSided === 1 }) }
    return { number, kind: KINDS[kind], segment: [...this.#core.givenNumbers(4)], ...(kind === 1 && { open: open === 1 }),
      ...(added ?? source) }
  }

  /** A wall; null if there is none of that number. */
  wall(number) {
    const found = this.#known(number)
    if (found) delete found.ground
    return found
  }

  /** All walls. */
  get walls() {
    const found = []
    for (let i = 0, count = this.#core.core.world_wall_count(this.#place); i < count; i++) {
      const wall = this.wall(i)
      if (wall) found.push(wall)
    }
    return found
  }

  get cellCount() {
    return this.#core.core.world_cell_count(this.#place)
  }

  /** The corners of a cell: x, y ...; none if there is no such cell. */
  cell(number) {
    this.#core.core.world_cell(this.#place, wholeOf('cell', number, MOST))
    const [count, at] = this.#core.given(2)
    return new Float64Array(this.#core.memory.buffer, at, 2 * count).slice()
  }

  // --- questions

  /** The cell that holds a point; -1 outside the bounds. */
  locate(x, y) {
    return this.#core.core.world_locate(this.#place, numberOf('x', x), numberOf('y', y))
  }

  /** Whether a point sees another. */
  canSee(a, b) {
    const [from, to] = [pointOf('canSee', a), pointOf('canSee', b)]
    return this.#ask((its, at) => its.world_can_see(at, ...from, ...to))[0] === 1
  }

  /** The polygon that an eye sees: x, y ... counter-clockwise; arcs as chords. */
  visiblePolygon(x, y, options) {
    const { tolerance = 0, ...rest } = optionsOf(options, 'heading', 'fov', 'range', 'tolerance')
    const { heading, fov, range } = viewOf(rest), eye = [numberOf('x', x), numberOf('y', y)]
    numberOf('tolerance', tolerance, 0)
    const [count, cornersAt] = this.#ask((its, at) => its.world_region(at, ...eye, heading, fov, range, tolerance))
    return new Float64Array(this.#core.memory.buffer, cornersAt, 2 * count).slice()
  }

  /** The polygons that an eye sees by mirror: the mirror's wall and the number of reflections of each. */
  mirroredPolygons(x, y, options) {
    const { tolerance = 0, depth = 1, ...rest } = optionsOf(options, 'heading', 'fov', 'range', 'tolerance', 'depth')
    const { heading, fov, range } = viewOf(rest), eye = [numberOf('x', x), numberOf('y', y)]
    numberOf('tolerance', tolerance, 0)
    wholeOf('depth', depth, MOST_MIRRORS)
    const [parts] = this.#ask((its, at) => its.world_mirrored(at, ...eye, heading, fov, range, depth))
    return Array.from({ length: parts }, (_, part) => {
      const [count, cornersAt, wall, reflections] = this.#ask((its, at) => its.world_mirror_part(at, part, tolerance))
      return { wall, depth: reflections, polygon: new Float64Array(this.#core.memory.buffer, cornersAt, 2 * count).slice() }
    })
  }

  /** The visible set of a cell, where the world keeps them. */
  row(cell) {
    wholeOf('cell', cell, MOST)
    const [count, at] = this.#ask((its, world) => its.world_row(world, cell))
    return this.#integers(at, count)
  }

  /** Makes visible sets exact for so many milliseconds; how many are left. */
  settle(milliseconds = Infinity) {
    const time = milliseconds === Infinity ? Number.MAX_VALUE : numberOf('milliseconds', milliseconds, 0)
    return this.#ask((its, at) => its.world_settle(at, time))[0]
  }

  /** Gives back the memory. */
  close() {
    if (this.#at && this.#generation === this.#core.generation) this.#core.core.world_close(this.#at)
    this.#at = 0
  }
}

/** The loaded module, for calls without promises. */
class WorldCore extends Module {
  /** Opens a map for edits. Close the world. */
  open(map, given) {
    const { bounds, rows = 'none', sight = 'closed', name } = optionsOf(given, 'bounds', 'rows', 'sight', 'name')
    if (!ROWS.includes(rows)) throw new SightlineError(`rows: one of ${ROWS.join(', ')} is needed`)
    if (sight !== 'closed' && sight !== 'open') throw new SightlineError("sight: 'closed' or 'open' is needed")
    if (isBaked(map)) throw new SightlineError('map: a world is of a map; of a .slv, open the map that was baked')
    const { minX, minY, maxX, maxY } = bounds ? objectOf('bounds', bounds) : {}
    const box = bounds ? Float64Array.of(...[minX, minY, maxX, maxY].map((v) => numberOf('bounds', v))) : new Float64Array(0)
    return this.withBytes([new Uint8Array(box.buffer)], (boxAt) => this.withMap(map, { name }, (nameAt, at, size, items) => {
      const world = this.run((core) =>
        core.world_open(nameAt, at, size, ROWS.indexOf(rows), +(sight === 'open'), bounds ? boxAt : 0))
      if (!world) throw this.failure(items)
      return new World(this, world)
    }))
  }
}

/** Loads the module. `memory`: the most bytes that it may take, 4 GiB by default. */
export async function load(options) {
  return new WorldCore(...(await instantiable('world', options)))
}

const loaded = loadedOnce(load)

/** Opens a map for edits. Close the world. */
export async function open(map, options) {
  return (await loaded()).open(map, options)
}
