/**
 * An open map: its cells and portals, and all questions about it. Arrays named as members of a
 * Scene are views of the module's memory, made anew at each access: they hold until the next call.
 * What functions return is a copy and stays.
 */
import { flagOf, given, indexOf, numberOf, optionsOf, pointOf, textOf, viewOf, wholeOf } from './arguments.js'
import { SightlineError } from './host.js'

const NONE = 0xffffffff
export const MOST_MIRRORS = 16
const GUARANTEES = ['exact', 'conservative', 'aggressive', 'rounded']
const EDGES = ['wall', 'border', 'occluding', 'cone', 'mirror', 'arc']
const TABLE = ['cellCount', 'cells', 'vertexCount', 'vertices', 'portalCount', 'portals',
  'directedCount', 'directed', 'wallCount', 'walls', 'nodeCount', 'nodes', 'seamCount', 'seams',
  'seamPortalCount', 'seamPortals', 'neighbours', 'root', 'insideCount', 'doorCount', 'mirrorCount',
  'onewayCount', 'startCount', 'starts', 'sight', 'guarantee', 'method']

export class Scene {
  #core
  #at
  #generation
  #table = {}

  /** Use core.open(). */
  constructor(core, at, items) {
    this.#core = core
    this.#at = at
    this.#generation = core.generation
    this.items = items
    core.core.scene_describe(at)
    const given = core.given(TABLE.length)
    TABLE.forEach((name, i) => (this.#table[name] = given[i]))
    const [minX, minY, maxX, maxY, range] = core.givenNumbers(5)
    this.bounds = Object.freeze({ minX, minY, maxX, maxY })
    this.range = range
    this.cellCount = this.#table.cellCount
    this.portalCount = this.#table.portalCount
    this.wallCount = this.#table.wallCount
    this.insideCount = this.#table.insideCount
    this.sight = this.#table.sight ? 'open' : 'closed'
    this.guarantee = GUARANTEES[this.#table.guarantee]
    this.method = core.textAt(this.#table.method)
  }

  get #place() {
    if (this.#at && this.#generation === this.#core.generation) return this.#at
    throw new SightlineError(this.#at ? 'the module stopped, and the scene is lost' : 'the scene is closed')
  }

  #ask(call) {
    const at = this.#place
    this.#core.ask((core) => call(core, at))
  }

  #floats(at, count) {
    this.#place
    return new Float64Array(this.#core.memory.buffer, at, count)
  }

  #integers(at, count) {
    this.#place
    return new Uint32Array(this.#core.memory.buffer, at, count)
  }

  #given(count) {
    return this.#core.given(count)
  }

  // --- the space

  /** Corners of all cells: x, y, x, y ... */
  get vertices() {
    return this.#floats(this.#table.vertices, 2 * this.#table.vertexCount)
  }

  /** Six numbers a cell: first vertex, vertices, first directed portal, directed portals, inside, solid. */
  get cellTable() {
    return this.#integers(this.#table.cells, 6 * this.cellCount)
  }

  /** Five numbers a portal; the last four are its left and right end. */
  get portalEnds() {
    return this.#floats(this.#table.portals, 5 * this.portalCount)
  }

  /** Ten integers a portal; the first two are its cells. */
  get portalCells() {
    return this.#integers(this.#table.portals, 10 * this.portalCount)
  }

  /** Ten integers a directed portal; the first two are its portal and the cell behind it. */
  get directedCells() {
    return this.#integers(this.#table.directed, 10 * this.#table.directedCount)
  }

  /** Five numbers a directed portal; the last four are its left and right end on the way out. */
  get directedEnds() {
    return this.#floats(this.#table.directed, 5 * this.#table.directedCount)
  }

  /** Five numbers a wall; the first four are its ends. */
  get wallEnds() {
    return this.#floats(this.#table.walls, 5 * this.wallCount)
  }

  /** Ten integers a wall; the ninth is the line of the map, the tenth its ground. */
  get wallLines() {
    return this.#integers(this.#table.walls, 10 * this.wallCount)
  }

  /** Corners of one cell, counter-clockwise: a view. */
  corners(cell) {
    this.#checkCell(cell)
    const [first, count] = this.cellTable.subarray(6 * cell, 6 * cell + 2)
    return this.#floats(this.#table.vertices + 16 * first, 2 * count)
  }

  /** One cell as an object. */
  cell(cell) {
    this.#checkCell(cell)
    const [, , first, count, inside, solid] = this.cellTable.subarray(6 * cell, 6 * cell + 6)
    const portals = Array.from({ length: count }, (_, i) => this.directed(first + i))
    return { corners: this.corners(cell).slice(), portals, inside: !!inside, solid: !!solid }
  }

  /** One directed portal as an object. */
  directed(number) {
    indexOf('directed portal', number, this.#table.directedCount)
    const [portal, cell] = this.directedCells.subarray(10 * number, 10 * number + 2)
    const [lx, ly, rx, ry] = this.directedEnds.subarray(5 * number + 1, 5 * number + 5)
    return { portal, cell, left: [lx, ly], right: [rx, ry] }
  }

  /** One wall: its ends, and the line of the map or the item of the object that it is from. */
  wall(number) {
    indexOf('wall', number, this.wallCount)
    const line = this.wallLines[10 * number + 8]
    return { segment: Array.from(this.wallEnds.subarray(5 * number, 5 * number + 4)), line, item: this.items?.[line] ?? '' }
  }

  /** The nodes of the kd-tree: position, axis, below, above; a child below 0 is cell ~child. */
  get nodes() {
    const { nodes, nodeCount } = this.#table
    const numbers = this.#floats(nodes, 3 * nodeCount)
    const integers = new Int32Array(this.#core.memory.buffer, nodes, 6 * nodeCount)
    return Array.from({ length: nodeCount }, (_, i) => ({
      position: numbers[3 * i], axis: integers[6 * i + 2], below: integers[6 * i + 3], above: integers[6 * i + 4],
    }))
  }

  get root() {
    return this.#table.root | 0
  }

  get starts() {
    const numbers = this.#floats(this.#table.starts, 4 * this.#table.startCount)
    return Array.from({ length: this.#table.startCount }, (_, i) => {
      const [x, y, heading] = numbers.subarray(4 * i, 4 * i + 3)
      return { x, y, heading }
    })
  }

  get doors() {
    const at = this.#place
    return Array.from({ length: this.#table.doorCount }, (_, i) => {
      this.#core.core.scene_door(at, i)
      const [name, segments, count, shut] = this.#given(4)
      const ends = this.#floats(segments, 4 * count)
      return {
        name: this.#core.textAt(name), open: !shut,
        segments: Array.from({ length: count }, (_, j) => Array.from(ends.subarray(4 * j, 4 * j + 4))),
      }
    })
  }

  get mirrors() {
    return this.#glass(0, this.#table.mirrorCount)
  }

  get oneway() {
    return this.#glass(1, this.#table.onewayCount)
  }

  #glass(kind, count) {
    const at = this.#place
    return Array.from({ length: count }, (_, i) => {
      this.#core.core.scene_glass(at, kind, i)
      const [segment, oneSided] = this.#given(2)
      return { segment: Array.from(this.#floats(segment, 4)), oneSided: !!oneSided }
    })
  }

  /** Opens or shuts all doors of a name. */
  setDoor(name, open) {
    textOf('name', name)
    flagOf('open', open)
    this.#core.withBytes([name], (text) => this.#ask((core, at) => core.scene_set_door(at, text, +open)))
  }

  /** What the bake did: counts of cleaning, seconds of each stage, pairs and work. */
  get account() {
    this.#core.core.scene_account(this.#place)
    const [before, after, welded, split, crossings, largestMove, tolerance, clean, subdivide, check, see,
      pairs, tests, nodes, pieces, deepest] = this.#core.givenNumbers(16)
    return {
      cleaning: { before, after, welded, split, crossings, largestMove, tolerance },
      seconds: { clean, subdivide, check, see }, pairs, tests, nodes, pieces, deepest,
    }
  }

  // --- what sees what

  #checkCell(cell) {
    return indexOf('cell', cell, this.cellCount)
  }

  /** A cell, given as its number or as a point in it. */
  #cellOf(place) {
    if (typeof place === 'number') return this.#checkCell(place)
    const [x, y] = pointOf('cell', place)
    const cell = this.locate(x, y)
    if (cell < 0) throw new SightlineError(`(${x}, ${y}) is outside the map`)
    return cell
  }

  #cells() {
    const [count, at] = this.#given(2)
    return this.#integers(at, count).slice()
  }

  /** The cell that holds a point; -1 outside the bounds. */
  locate(x, y) {
    return this.#core.core.scene_locate(this.#place, numberOf('x', x), numberOf('y', y))
  }

  /** The visible set of a cell, with the doors as they stand. */
  row(cell) {
    this.#checkCell(cell)
    this.#ask((core, at) => core.scene_row(at, 0, cell))
    return this.#cells()
  }

  /** The cells that a cell sees by mirror. */
  mirroredRow(cell) {
    this.#checkCell(cell)
    this.#ask((core, at) => core.scene_row(at, 1, cell))
    return this.#cells()
  }

  /** Of two cells or two points, as Level.canSee(). */
  canSee(a, b, options) {
    const { range } = viewOf(optionsOf(options, 'range'))
    if (typeof a === 'number' && typeof b === 'number')
      this.#ask((core, at) => core.scene_cell_sees(at, this.#checkCell(a), this.#checkCell(b)))
    else if (typeof a === 'object' && typeof b === 'object')
      this.#ask((core, at) => core.scene_can_see(at, ...pointOf('canSee', a), ...pointOf('canSee', b), range))
    else throw new SightlineError('canSee: two cells or two points are needed')
    return !!this.#given(1)[0]
  }

  /** The cells that an eye sees, ascending. `method`: a culling method; `mirrored`: by mirror. */
  look(x, y, options) {
    const { method = '', mirrored = false, ...view } =
      optionsOf(options, 'heading', 'fov', 'range', 'method', 'mirrored')
    const eye = this.#eyeOf(x, y, view)
    flagOf('mirrored', mirrored)
    this.#core.withBytes([textOf('method', method)], (name) =>
      this.#ask((core, at) => core.scene_look(at, ...eye, name, +mirrored)))
    return this.#cells()
  }

  #region(table) {
    const [count, points, edges, cell, flatCount, flat] = table
    const bytes = new Uint8Array(this.#core.memory.buffer, edges, 8 * count)
    const walls = this.#integers(edges, 2 * count)
    return {
      cell: cell === NONE ? -1 : cell,
      points: this.#floats(points, 2 * count).slice(),
      polygon: this.#floats(flat, 2 * flatCount).slice(),
      edges: Array.from({ length: count }, (_, i) => EDGES[bytes[8 * i + 4]]),
      walls: Array.from({ length: count }, (_, i) => (walls[2 * i] === NONE ? -1 : walls[2 * i])),
    }
  }

  /** An eye and its view, as the module takes them. */
  #eyeOf(x, y, options) {
    const view = viewOf(options)
    return [numberOf('x', x), numberOf('y', y), view.heading, view.fov, view.range]
  }

  /** 0: not given. */
  #tolerance(tolerance) {
    const { minX, minY, maxX, maxY } = this.bounds
    return numberOf('tolerance', tolerance, 0) || Math.max(maxX - minX, maxY - minY) / 5000
  }

  #askRegion(x, y, options) {
    const { tolerance = 0, ...view } = optionsOf(options, 'heading', 'fov', 'range', 'tolerance')
    const eye = this.#eyeOf(x, y, view), chord = this.#tolerance(tolerance)
    this.#ask((core, at) => core.scene_region(at, ...eye, chord))
  }

  /** The polygon that an eye sees: x, y ... counter-clockwise; arcs as chords. */
  visiblePolygon(x, y, options) {
    this.#askRegion(x, y, options)
    const [, , , , count, points] = this.#given(6)
    return this.#floats(points, 2 * count).slice()
  }

  /** The visible region with what each edge lies on, and all measures (Benedikt 1979; depthmapX). */
  isovist(x, y, options) {
    this.#askRegion(x, y, options)
    const region = this.#region([...this.#given(6)])
    this.#core.core.scene_measures(this.#place)
    const { measures } = this.#core, numbers = this.#core.givenNumbers(measures.length)
    measures.forEach((name, i) => (region[name.replace(/_./g, (at) => at[1].toUpperCase())] = numbers[i]))
    return region
  }

  /** What is seen by mirror: a part for each piece of a mirror, with its points where they seem to be. */
  mirroredParts(x, y, options) {
    const { depth = 1, tolerance = 0, ...view } =
      optionsOf(options, 'heading', 'fov', 'range', 'depth', 'tolerance')
    const eye = this.#eyeOf(x, y, view), chord = this.#tolerance(tolerance)
    wholeOf('depth', depth, MOST_MIRRORS)
    this.#ask((core, at) => core.scene_mirrored_region(at, ...eye, depth))
    const count = this.#given(1)[0]
    return Array.from({ length: count }, (_, i) => {
      this.#ask((core, at) => core.scene_mirror_part(at, i, chord))
      const table = [...this.#given(10)]
      const [mirror, parent, reflections, image] = table.slice(6)
      return {
        ...this.#region(table), mirror, parent: parent === NONE ? -1 : parent, depth: reflections,
        image: this.#floats(image, 2 * table[0]).slice(),
      }
    })
  }

  /** Why cell a (or a point's cell) sees b or not, as `sightline explain --json` says it. */
  explain(a, b, options) {
    const { misses = 3, tests = 0, mirrorDepth = 1 } = optionsOf(options, 'misses', 'tests', 'mirrorDepth')
    wholeOf('misses', misses, NONE)
    wholeOf('tests', tests, Number.MAX_SAFE_INTEGER)
    wholeOf('mirrorDepth', mirrorDepth, MOST_MIRRORS)
    const from = this.#cellOf(a)
    const to = this.#cellOf(b)
    this.#ask((core, at) => core.scene_explain(at, from, to, misses, tests, mirrorDepth))
    return JSON.parse(this.#core.writtenText())
  }

  /** The depth-first search from a cell, step by step. */
  steps(cell, options) {
    const most = given(optionsOf(options, 'most').most, (value) => wholeOf('most', value, NONE))
    this.#ask((core, at) => core.scene_steps(at, this.#cellOf(cell), most))
    const [count, at, complete] = this.#given(3)
    const kinds = ['enter', 'backwards', 'hidden', 'leave']
    const numbers = this.#integers(at, 8 * count)
    const steps = Array.from({ length: count }, (_, i) => {
      const [kind, directed, cell, parent, depth, node, seen, flags] = numbers.subarray(8 * i, 8 * i + 8)
      return {
        kind: kinds[kind], directed: directed === NONE ? -1 : directed, cell, parent, depth, node, seen,
        first: !!(flags & 1), grazing: !!(flags & 256),
      }
    })
    return { steps, complete: !!complete }
  }

  /**
   * The stab tree of a cell: nodes with parent (a number in the tree; -1 for the root), cell, the
   * directed portal crossed last (-1 for the root) and depth.
   */
  stabTree(cell, options) {
    const { steps, complete } = this.steps(cell, options)
    const numbers = new Map()
    const nodes = []
    steps.forEach((step, i) => {
      if (step.kind !== 'enter') return
      numbers.set(i, nodes.length)
      const parent = nodes.length ? numbers.get(step.parent) : -1
      nodes.push({ parent, cell: step.cell, directed: step.directed, depth: step.depth, grazing: step.grazing })
    })
    return { nodes, complete }
  }

  // --- files

  /** The bytes of the baked file. */
  slv() {
    this.#ask((core, at) => core.scene_write(at))
    return this.#core.written()
  }

  /** What is inside, for people, where that is not plain: what is in doubt, or which openings count as entrances. */
  insideText() {
    this.#ask((core, at) => core.scene_inside(at))
    return this.#core.writtenText()
  }

  /** The JSON export, version 2, as an object. */
  describe() {
    return JSON.parse(this.export('json'))
  }

  /** An export as text: 'json', 'geojson' or 'csv'. */
  export(format, options) {
    const { version = 0 } = optionsOf(options, 'version')
    wholeOf('version', version, NONE)
    this.#core.withBytes([textOf('format', format)], (name) => this.#ask((core, at) => core.scene_export(at, name, version)))
    return this.#core.writtenText()
  }

  /** Gives back the memory. */
  close() {
    if (this.#at && this.#generation === this.#core.generation) this.#core.core.scene_close(this.#at)
    this.#at = 0
  }
}
