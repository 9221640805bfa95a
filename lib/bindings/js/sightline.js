/**
 * A baked level (.slv) in a game: where is a point, what sees what, what does an eye see.
 *
 * One WebAssembly instance holds one level. Its memory has the file, then doors, scratch memory and
 * answers, each at a fixed place; only the polygon may grow. Answers are copies and stay valid. A level with
 * boxes that move has a module of its own; where their memory becomes too small, the polygon moves.
 */
import { flagOf, indexOf, listOf, need, numberOf, optionsOf, pointOf, textOf, viewOf, wholeOf } from './arguments.js'
import { SightlineError, bytesOf, compile, direction, textAt } from './host.js'

export { SightlineError }

const PAGE = 65536
const MIRRORS = ['none', 'baked', 'not baked']
const KINDS = ['door', 'breakable', 'site']
// The status of a file before 2.0 (SL_RUNTIME_OLD).
const OLD = 11

function checkBox(minX, minY, maxX, maxY) {
  numberOf('maxX', maxX, numberOf('minX', minX))
  numberOf('maxY', maxY, numberOf('minY', minY))
}

/** An eye's x, y and view. One object may hold all; there `dx` and `dy` may stand for the heading. */
function eyeOf(x, y, options, ...known) {
  if (typeof x !== 'object' || !x) return [numberOf('x', x), numberOf('y', y), optionsOf(options, ...known)]
  if (y !== undefined || options !== undefined) throw new SightlineError('x: one object holds all, the view too')
  const { x: left, y: up, dx, dy, ...view } = optionsOf(x, 'x', 'y', 'dx', 'dy', ...known)
  if (dx !== undefined || dy !== undefined) {
    if (!Number.isFinite(dx) || !Number.isFinite(dy) || !(dx || dy))
      throw new SightlineError('heading: a number is needed, or dx and dy, not 0, 0, as a vector')
    view.heading ??= (Math.atan2(dy, dx) * 180) / Math.PI
  }
  return [numberOf('x', left), numberOf('y', up), view]
}

/** A transform; `ofFile` is origin, scale (0: not known) and y down of the file. */
function transformOf(wanted, [left, top, unit, down]) {
  if (wanted === 'file' && !unit) throw new SightlineError('transform: the file does not say it: bake the map again')
  const told = wanted === 'file' ? { origin: [left, top], scale: unit, yDown: !!down } : wanted
  const { origin = [0, 0], scale = 1, yDown = false } = optionsOf(told, 'origin', 'scale', 'yDown')
  const [x, y] = pointOf('origin', origin)
  need(numberOf('scale', scale) > 0, 'scale', 'a number above 0', scale)
  return Object.freeze({ origin: Object.freeze({ x, y }), scale, yDown: flagOf('yDown', yDown) })
}

export class Level {
  #core
  #shut
  #scratch
  #list
  #points
  #room
  #seen
  #view
  #bytes = new Uint8Array(0)
  #doubles
  #doors
  #cells
  #walls
  #range

  /**
   * Opens a baked file, which is checked wholly. Places and headings, given and taken, are in the
   * coordinates of `transform`. `boxes`: how many boxes may move in it.
   *
   * @param {ArrayBuffer | Uint8Array} bytes
   * @param {{transform?: 'file' | object, boxes?: number}} [options]
   * @returns {Promise<Level>}
   */
  static async open(bytes, options) {
    const file = bytesOf(bytes)
    const { transform, boxes = 0 } = optionsOf(options, 'transform', 'boxes')
    const module = await (wholeOf('boxes', boxes, 1e6)
      ? compile('boxes', new URL('./boxes.wasm', import.meta.url))
      : compile('level', new URL('./level.wasm', import.meta.url)))
    const make = async (data) => new Level((await WebAssembly.instantiate(module, {})).exports, data, transform, boxes)
    return make(file).catch(async (error) => {
      if (error.status !== OLD) throw error
      const scene = (await (await import('./bake.js')).load()).open(file)
      return make(scene.slv()).finally(() => scene.close())
    })
  }

  /** Use Level.open(). */
  constructor(core, file, transform, boxes) {
    this.#core = core
    core._initialize()
    this.#points = core.__heap_base.value
    this.#view = core.view_place()
    const data = this.#place(file.length)
    new Uint8Array(this.#core.memory.buffer).set(file, data)
    const status = core.open(data, file.length)
    if (status) {
      const message = textAt(this.#core.memory, core.status_text(status))
      throw Object.assign(new SightlineError(message, { code: 'bad input' }), { status })
    }
    core.describe()
    const [cells, down, doors, starts, scratch, mirrors, unfinished, state] = this.#integers
    const [, , , , range, ...ofFile] = this.#numbers
    const tell = (name, value) => Object.defineProperty(this, name, { value, enumerable: true })
    tell('transform', transformOf(transform, [...ofFile, down]))
    const [minX, y0, maxX, y1] = this.#places(4), minY = Math.min(y0, y1), maxY = Math.max(y0, y1)
    this.#shut = core.start_doors(this.#place(4 * state))
    this.#scratch = this.#place(4 * scratch)
    this.#list = this.#place(4 * cells + cells)
    if (boxes) this.#startBoxes(boxes)
    this.#grow(256)
    this.#doors = Array.from({ length: doors }, (_, i) => this.#readDoor(i))
    const known = {
      bounds: Object.freeze({ minX, minY, maxX, maxY }), range: range * this.transform.scale, unfinished: !!unfinished, mirrors: MIRRORS[mirrors],
      cellCount: cells, boxCount: boxes, starts: Object.freeze(Array.from({ length: starts }, (_, i) => this.#readStart(i))),
    }
    this.#range = range
    for (const name in known) tell(name, known[name])
  }

  #reserve(end) {
    const missing = end - this.#core.memory.buffer.byteLength
    if (missing <= 0) return
    try {
      this.#core.memory.grow(Math.ceil(missing / PAGE))
    } catch {
      throw new SightlineError('out of memory', { code: 'out of memory' })
    }
  }

  /** Where so many bytes are; the polygon is after them from then on. */
  #place(bytes) {
    const at = (this.#points + 15) & ~15
    this.#points = at + bytes
    this.#reserve(this.#points)
    return at
  }

  #grow(points) {
    this.#place(0)
    this.#reserve(this.#points + 16 * points)
    this.#room = points
  }

  /** All memory, as numbers. Memory that grows is a new buffer. */
  #refresh() {
    const { buffer } = this.#core.memory
    if (this.#bytes.buffer === buffer) return
    this.#bytes = new Uint8Array(buffer)
    this.#doubles = new Float64Array(buffer)
  }

  get #open() {
    if (!this.#core) throw new SightlineError('the level is closed')
    return this.#core
  }

  /** What the last call gave. */
  get #integers() {
    return new Uint32Array(this.#core.memory.buffer, this.#core.integers_place(), 8)
  }

  get #numbers() {
    return new Float64Array(this.#core.memory.buffer, this.#core.numbers_place(), 8)
  }

  /** A place in the map. */
  #toMap(x, y) {
    const { origin, scale, yDown } = this.transform
    return [origin.x + x / scale, origin.y + (yDown ? -y : y) / scale]
  }

  /** Places x, y, x, y ... of the map become those of the caller: from memory at `at`, or where they are. */
  #fromMap(places, count = places.length, from = places, at = 0) {
    const { origin, scale, yDown } = this.transform
    for (let i = 0; i < count; i += 2) {
      const y = from[at + i + 1] - origin.y
      places[i] = scale * (from[at + i] - origin.x)
      places[i + 1] = scale * (yDown ? 0 - y : y)
    }
    return places
  }

  /** The first of the numbers, as places. */
  #places(count) {
    return this.#fromMap(this.#numbers.slice(0, count))
  }

  /** A heading in the map, and back. */
  #turned(heading) {
    return this.transform.yDown ? 0 - heading : heading
  }

  #readDoor(number) {
    const core = this.#core
    const count = core.door(number, this.#points, 0)
    this.#grow(Math.max(this.#room, 2 * count))
    core.door(number, this.#points, count)
    const [name, length, kind] = this.#integers
    const ends = this.#fromMap(new Float64Array(this.#core.memory.buffer, this.#points, 4 * count))
    const segments = Array.from({ length: count }, (_, i) => Object.freeze([...ends.subarray(4 * i, 4 * i + 4)]))
    return { name: textAt(this.#core.memory, name, length), kind: KINDS[kind], segments: Object.freeze(segments) }
  }

  #readStart(number) {
    this.#core.start(number)
    const [x, y] = this.#places(2)
    return Object.freeze({ x, y, heading: this.#turned(this.#numbers[2]) })
  }

  /** The doors as they stand: name, kind, open, and segments [x0, y0, x1, y1]. setDoor() changes them. */
  get doors() {
    this.#open
    const shut = new Uint8Array(this.#core.memory.buffer, this.#shut, this.#doors.length)
    return Object.freeze(this.#doors.map((door, i) => Object.freeze({ ...door, open: !shut[i] })))
  }

  /**
   * Opens or shuts all doors of a name, breaks a wall or builds one. False, and nothing changes, to
   * shut a broken wall or to open what was built.
   *
   * @param {string} name
   * @param {boolean} open
   */
  setDoor(name, open) {
    this.#open
    textOf('name', name)
    flagOf('open', open)
    const number = this.#doors.findIndex((door) => door.name === name)
    if (number < 0) throw new SightlineError(`there is no door '${name}'`)
    return !!this.#core.set_door(number, open ? 0 : 1)
  }

  /**
   * Makes rows (canSee of two cells, row, seenFrom) exact for the doors as they stand, through up to so
   * many portals; about 0.1 microseconds each. Gives how many rows are left.
   *
   * @param {number} [portals]
   */
  settle(portals = 10000) {
    return this.#open.settle(indexOf('portals', portals, 2 ** 32)) >>> 0
  }

  /** All walls: [x0, y0, x1, y1]. Doors are none. */
  get walls() {
    const core = this.#open
    if (this.#walls) return this.#walls
    this.#walls = []
    for (let i = 0; core.wall(i); i++) this.#walls.push(Object.freeze([...this.#places(4)]))
    return Object.freeze(this.#walls)
  }

  /** All cells: corners counter-clockwise, portals, inside, solid, and whether they have a row. */
  get cells() {
    const core = this.#open
    if (this.#cells) return this.#cells
    this.#cells = Object.freeze(Array.from({ length: this.cellCount }, (_, cell) => {
      core.cell(cell)
      const [first, count, firstPortal, portals, inside, solid, hasRow] = this.#integers
      const corners = new Float64Array(2 * count)
      for (let i = 0; i < count; i++) {
        core.vertex(first + i)
        corners.set(this.#numbers.subarray(0, 2), 2 * i)
      }
      return Object.freeze({
        corners: this.#fromMap(corners),
        portals: Array.from({ length: portals }, (_, i) => this.#readPortal(firstPortal + i)),
        inside: !!inside,
        solid: !!solid,
        hasRow: !!hasRow,
      })
    }))
    return this.#cells
  }

  #readPortal(directed) {
    this.#core.directed_portal(directed)
    const [portal, cell] = this.#integers
    const [leftX, leftY, rightX, rightY] = this.#places(4)
    return { portal, cell, left: [leftX, leftY], right: [rightX, rightY] }
  }

  /** The cell that holds a point; -1 outside the bounds. */
  locate(x, y) {
    return this.#open.locate(...this.#toMap(numberOf('x', x), numberOf('y', y)))
  }

  /**
   * Of two cells: whether something in b can be seen from somewhere in a. Of two points: whether an
   * eye at a sees b. With the doors as they stand. `mirrors`: or by mirror; of two points the answer
   * is then whether a may see b.
   *
   * @param {number | {x: number, y: number} | [number, number]} a
   * @param {number | {x: number, y: number} | [number, number]} b
   * @param {{mirrors?: boolean}} [options]
   */
  canSee(a, b, options) {
    const core = this.#open
    const mirrors = this.#mirrorsOf(options)
    if (typeof a === 'number' && typeof b === 'number')
      return !!core.can_see(this.#cellOf(a), this.#cellOf(b), +mirrors)
    if (typeof a !== 'object' || typeof b !== 'object')
      throw new SightlineError('canSee: two cells or two points are needed')
    const from = this.#placeOf('canSee', a), to = this.#placeOf('canSee', b)
    return !!core.sees(...from, ...to, this.#shut, this.#scratch) || (mirrors && this.#mayMirror(from, to))
  }

  #placeOf(call, point) {
    return this.#toMap(...pointOf(call, point))
  }

  #cellOf(cell) {
    return indexOf('cell', cell, this.cellCount)
  }

  #mirrorsOf(options) {
    const { mirrors = false } = optionsOf(options, 'mirrors')
    return flagOf('mirrors', mirrors)
  }

  /** A cell that the eye sees directly in part can have the point where only a mirror shows it. */
  #mayMirror([x, y], [toX, toY]) {
    const core = this.#open
    if (this.#range > 0 && Math.hypot(toX - x, toY - y) > this.#range) return false
    const cells = [...this.#cellsOfBox(toX, toY, toX, toY)]
    return cells.some((cell) => !!core.may_mirror(x, y, cell, this.#shut, this.#scratch))
  }

  /**
   * Whether one may walk straight from one point to another: no point of the way, ends included, is
   * on a wall, a mirror, one-way glass or a shut door, in solid ground or outside the map, or in or on a box
   * that blocks. Who is put exactly on a wall cannot leave it.
   *
   * @param {{x: number, y: number} | [number, number]} from
   * @param {{x: number, y: number} | [number, number]} to
   * @param {number} [box] that of who walks, which does not count
   */
  canWalk(from, to, box) {
    const core = this.#open, own = box === undefined ? -1 : this.#boxOf(box)
    return !!core.can_walk(...this.#placeOf('canWalk', from), ...this.#placeOf('canWalk', to), this.#shut, own)
  }

  #boxOf(box) {
    if (!this.boxCount) throw new SightlineError('box: open the level with the option boxes')
    return indexOf('box', box, this.boxCount)
  }

  /** Again: the same boxes, with twice the room. */
  #startBoxes(boxes) {
    this.#seen = this.#core.boxes_start(this.#place(this.#core.boxes_size(boxes)), boxes)
  }

  /**
   * Puts a box at a place. One that blocks hides what is behind it and stops steps. Outside the bounds it is nowhere.
   *
   * @param {number} box
   * @param {number} minX
   * @param {number} minY
   * @param {number} maxX
   * @param {number} maxY
   * @param {boolean} [blocks]
   */
  moveBox(box, minX, minY, maxX, maxY, blocks = true) {
    const core = this.#open, { origin, scale, yDown } = this.transform
    this.#boxOf(box)
    flagOf('blocks', blocks)
    checkBox(minX, minY, maxX, maxY)
    while (!core.move_box(box, origin.x + minX / scale, origin.y + (yDown ? -maxY : minY) / scale, origin.x + maxX / scale,
      origin.y + (yDown ? -minY : maxY) / scale, +blocks)) {
      this.#startBoxes(this.boxCount)
      this.#grow(this.#room)
    }
  }

  /**
   * Which boxes an eye sees, into an array of the caller: 1 or 0 for each. Gives how many.
   *
   * @param {Uint8Array} seen
   * @param {number | object} x as for look()
   * @param {number} [y]
   * @param {{heading?: number, fov?: number, range?: number}} [options]
   */
  boxesSeenInto(seen, x, y, options) {
    const core = this.#open
    this.#boxOf(0)
    if (!(seen instanceof Uint8Array && seen.length >= this.boxCount))
      throw new SightlineError('seen: a Uint8Array is needed with a byte for each box')
    const count = core.boxes_seen(this.#shut, this.#setAnyView(x, y, options)) >>> 0
    for (let i = 0; i < this.boxCount; i++) seen[i] = this.#bytes[this.#seen + i]
    return count
  }

  /** The cells that a box lies in or touches. */
  boxCells(minX, minY, maxX, maxY) {
    this.#open
    checkBox(minX, minY, maxX, maxY)
    const [x0, y0, x1, y1] = [...this.#toMap(minX, minY), ...this.#toMap(maxX, maxY)]
    return this.#cellsOfBox(x0, Math.min(y0, y1), x1, Math.max(y0, y1))
  }

  #cellsOfBox(minX, minY, maxX, maxY) {
    return this.#listed(this.#core.box_cells(minX, minY, maxX, maxY, this.#list, this.cellCount) >>> 0)
  }

  #listed(count) {
    return new Uint32Array(this.#core.memory.buffer, this.#list, count).slice()
  }

  /** Puts an eye that looks all round into memory, as an sl_runtime_view. */
  #setEye(x, y) {
    const { origin, scale, yDown } = this.transform, at = this.#view / 8
    this.#refresh()
    this.#doubles[at] = origin.x + x / scale
    this.#doubles[at + 1] = origin.y + (yDown ? -y : y) / scale
    this.#bytes[8 * at + 16] = 1
  }

  /** The same for any view. Gives its range in the map; 0 for the map's own. */
  #setView(x, y, view) {
    const { heading: turn, fov, range } = viewOf(view)
    const heading = this.#turned(turn)
    this.#setEye(x, y)
    if (fov < 360) {
      this.#bytes[this.#view + 16] = 0
      this.#doubles.set([...direction(heading - fov / 2), ...direction(heading + fov / 2)], this.#view / 8 + 3)
    }
    return Math.max(range / this.transform.scale, 0)
  }

  /** The same for an eye as callers give it. */
  #setAnyView(x, y, options) {
    if (typeof x === 'number' && options === undefined) {
      this.#setEye(numberOf('x', x), numberOf('y', y))
      return 0
    }
    const [left, up, view] = eyeOf(x, y, options, 'heading', 'fov', 'range')
    return this.#setView(left, up, view)
  }

  /**
   * The cells that an eye sees; its own first, if it looks into it. `heading` and `fov` are in degrees.
   * `mirrors`: after the `direct` cells that it sees directly, those that are seen by mirror alone.
   * No cell is missed there, but some may be added.
   *
   * @param {number | object} x or one object with all: { x, y, dx, dy, fov, range, mirrors }
   * @param {number} [y]
   * @param {{heading?: number, fov?: number, range?: number, mirrors?: boolean}} [options]
   */
  look(x, y, options) {
    const core = this.#open
    const [left, up, { mirrors = false, ...view }] = eyeOf(x, y, options, 'heading', 'fov', 'range', 'mirrors')
    const range = this.#setView(left, up, view)
    if (flagOf('mirrors', mirrors)) {
      const count = core.look_mirrored(this.#shut, range, this.#scratch, this.#list) >>> 0
      const [direct] = this.#integers
      return Object.assign(this.#listed(count), { direct })
    }
    return this.#listed(core.look(this.#shut, range, this.#scratch, this.#list) >>> 0)
  }

  /**
   * The polygon that an eye sees: x, y, x, y ... counter-clockwise as it is seen, also with y down.
   *
   * @param {number | object} x as for look()
   * @param {number} [y]
   * @param {{heading?: number, fov?: number, range?: number}} [options]
   */
  visiblePolygon(x, y, options) {
    const count = this.#polygon(x, y, options)
    return this.#copied(new Float64Array(count), count)
  }

  /** The polygon in memory. */
  #copied(points, count) {
    this.#refresh()
    return this.#fromMap(points, count, this.#doubles, this.#points / 8)
  }

  /** Puts the polygon of an eye into memory. Gives how many numbers it has. */
  #polygon(x, y, options) {
    const core = this.#open, range = this.#setAnyView(x, y, options)
    for (;;) {
      const count = core.polygon(this.#shut, range, this.#scratch, this.#points, this.#room) >>> 0
      if (count <= this.#room) return 2 * count
      this.#grow(2 * count)
    }
  }

  /**
   * The same into an array of the caller; nothing is made for the answer. Gives how many numbers the polygon has. If
   * the array has fewer, nothing is written: call again with a longer one.
   *
   * @param {Float64Array} points
   * @param {number | object} x as for look()
   * @param {number} [y]
   * @param {{heading?: number, fov?: number, range?: number}} [options]
   */
  visiblePolygonInto(points, x, y, options) {
    if (!(points instanceof Float64Array)) throw new SightlineError('points: a Float64Array is needed')
    const count = this.#polygon(x, y, options)
    if (count <= points.length) this.#copied(points, count)
    return count
  }

  /** The cells seen from anywhere in a cell, with the doors as they stand. `mirrors`: or by mirror. */
  row(cell, options) {
    return this.seenFrom([cell], options)
  }

  /**
   * The cells seen from anywhere in some cells, with the doors as they stand: what to wake up.
   * `mirrors`: or by mirror.
   *
   * @param {ArrayLike<number>} cells
   * @param {{mirrors?: boolean}} [options]
   */
  seenFrom(cells, options) {
    const core = this.#open
    const mirrors = this.#mirrorsOf(options)
    // Each once: there is room for all cells.
    const own = [...new Set(listOf('cells', cells).map((cell) => this.#cellOf(cell)))]
    new Uint32Array(this.#core.memory.buffer, this.#list, own.length).set(own)
    return this.#listed(core.seen_from(this.#list, own.length, this.#scratch, +mirrors) >>> 0)
  }

  /** The view cell of a cell; -1 for none. */
  viewCell(cell) {
    return this.#open.view_cell(this.#cellOf(cell))
  }

  /** Gives back the memory. */
  close() {
    this.#core = this.#bytes = this.#doubles = this.#cells = this.#walls = undefined
  }
}
