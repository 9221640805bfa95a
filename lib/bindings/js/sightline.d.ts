/**
 * A baked level (.slv) in a game. Angles are in degrees, counter-clockwise from +x, and y grows upwards,
 * unless a transform turns y down: then they are clockwise.
 */

/** What the package throws. */
export class SightlineError extends Error {
  /** The line of the map text; 0 for none. */
  line: number
  /** The item of a map that was an object, such as `walls[3]`; '' for none. */
  item: string
  code: 'bad argument' | 'bad input' | 'unsupported' | 'out of memory' | 'interrupted' | 'input/output error' | 'internal'
}

export interface Point {
  x: number
  y: number
}

export interface Bounds {
  readonly minX: number
  readonly minY: number
  readonly maxX: number
  readonly maxY: number
}

/** [x0, y0, x1, y1] */
export type Segment = readonly [number, number, number, number]

/**
 * Parts of one name open and shut together, by setDoor(). A wall that is `breakable` stays open once broken, a `site`
 * stays shut once built.
 */
export interface Door {
  readonly name: string
  readonly open: boolean
  readonly segments: readonly Segment[]
}

/** { x, y } or [x, y] */
export type Place = Point | readonly [number, number]

export interface Start extends Point {
  heading: number
}

/** A portal as a cell crosses it on the way out; `cell` is the one behind it. */
export interface DirectedPortal {
  portal: number
  cell: number
  left: [number, number]
  right: [number, number]
}

/**
 * How the places of a map stand in your coordinates. The place (x, y) of the map is
 * scale * (x - origin.x), scale * (y - origin.y) there, or scale * (origin.y - y) with `yDown`.
 */
export interface Transform {
  readonly origin: Readonly<Point>
  readonly scale: number
  readonly yDown: boolean
}

export interface OpenOptions {
  /**
   * The coordinates of all places, boxes, lengths and headings that the level takes and gives. By default
   * those of the map. 'file': those of the file that was baked, such as pixels of Tiled with y down; it
   * throws if the baked file does not say them, as those before 2.0. By default `origin` is 0, 0, `scale` 1
   * and `yDown` false. Exact for whole numbers if the scale is a power of 2; else places are rounded.
   */
  transform?: 'file' | { origin?: Place; scale?: number; yDown?: boolean }
  /**
   * How many boxes may move in the level, up to 1,000,000; 0 by default. Such a level loads boxes.wasm in place of
   * level.wasm. The boxes are nowhere until moveBox() puts them somewhere.
   */
  boxes?: number
}

export interface Cell {
  /** x, y, x, y ... counter-clockwise as it is seen, also with y down. */
  corners: Float64Array
  portals: DirectedPortal[]
  inside: boolean
  solid: boolean
}

export interface View {
  /** Without it the view is all round. */
  heading?: number
  /** 90 by default. It needs a heading, unless it is 360. */
  fov?: number
  /** The map's own by default; 0 likewise. */
  range?: number
}

/** An eye and its view in one. A heading may also be given as the vector `dx`, `dy`, which is not 0, 0. */
export interface Eye extends Point, View {
  dx?: number
  dy?: number
}

export interface Mirrors {
  /** Count what is seen by mirror, too. Without it mirrors are walls. */
  mirrors?: boolean
}

export class Level {
  private constructor()
  /** Opens a baked file, which is checked wholly. */
  static open(bytes: ArrayBuffer | ArrayBufferView, options?: OpenOptions): Promise<Level>
  readonly transform: Transform
  readonly bounds: Bounds
  /** The view range of the map; 0 for no limit. */
  readonly range: number
  /** The bake was stopped: cells that were not decided count as seen. */
  readonly unfinished: boolean
  /**
   * What the file holds of what is seen by mirror: the map has no mirrors, or it was baked, or the bake
   * did not look into the mirrors, and with the option `mirrors` every cell counts as seen.
   */
  readonly mirrors: 'none' | 'baked' | 'not baked'
  readonly cellCount: number
  readonly boxCount: number
  readonly cells: readonly (Cell & { hasRow: boolean })[]
  readonly starts: readonly Start[]
  /** As they stand. */
  readonly doors: readonly (Door & { readonly kind: 'door' | 'breakable' | 'site' })[]
  readonly walls: readonly Segment[]
  /**
   * Opens or shuts all doors of a name, breaks a wall or builds one. Both arguments are needed. False, and nothing
   * changes, to shut a broken wall or to open what was built. An error for a name that no door has.
   */
  setDoor(name: string, open: boolean): boolean
  /**
   * Makes rows (canSee of two cells, row, seenFrom) exact for the doors as they stand, through up to `portals` portals
   * (10,000), of about 0.1 microseconds each. Gives how many rows are left. Before that no row misses anything.
   */
  settle(portals?: number): number
  /** The cell that holds a point; -1 outside the bounds, which other calls do not take for a cell. */
  locate(x: number, y: number): number
  /** Whether something in cell b can be seen from somewhere in cell a. */
  canSee(a: number, b: number, options?: Mirrors): boolean
  /**
   * Whether an eye at a sees the point b. A point on a wall or a shut door is seen from both sides,
   * but an eye there sees the side of its cell (locate) only, and all around at the wall's end. If
   * neither point is on a wall or a shut door, and no one-way glass is between them, each sees the
   * other or none does. With `mirrors`: whether it may, and boxes hide nothing; false is sure.
   */
  canSee(a: Place, b: Place, options?: Mirrors): boolean
  /**
   * Whether one may walk straight from one point to another: no point of the way, ends included, is
   * on a wall, a mirror, one-way glass, a shut door or the side of a box that blocks, in such a box, in solid ground
   * or outside the map. `box` is that of who walks, and does not count.
   */
  canWalk(from: Place, to: Place, box?: number): boolean
  /**
   * Puts a box at a place. One that blocks, as by default, hides what is behind it from look(), visiblePolygon() and
   * canSee() of two points. The bake stays as it is, and rows do not know of boxes. A box outside the bounds is
   * nowhere. Makes no objects.
   */
  moveBox(box: number, minX: number, minY: number, maxX: number, maxY: number, blocks?: boolean): void
  /**
   * Which boxes an eye sees, into an array of the caller: 1 or 0 for each. Gives how many. None is missed; of boxes
   * that overlap, a hidden one may count as seen. Else it is exact.
   */
  boxesSeenInto(seen: Uint8Array, x: number, y: number, view?: View): number
  boxesSeenInto(seen: Uint8Array, eye: Eye): number
  /**
   * The cells that an eye sees; its own first, if it looks into it. With `mirrors`, the first `direct` of them are seen
   * directly. The others are seen by mirror: none is missed, some may be added, and boxes hide nothing.
   */
  look(x: number, y: number, view: View & { mirrors: true }): Uint32Array & { direct: number }
  look(x: number, y: number, view?: View & Mirrors): Uint32Array
  look(eye: Eye & { mirrors: true }): Uint32Array & { direct: number }
  look(eye: Eye & Mirrors): Uint32Array
  /** x, y, x, y ... counter-clockwise about the eye as it is seen, also with y down. It ends at mirrors. */
  visiblePolygon(x: number, y: number, view?: View): Float64Array
  visiblePolygon(eye: Eye): Float64Array
  /**
   * The same into an array of the caller, so that a frame makes nothing to be collected. Gives how many numbers the
   * polygon has. If the array has fewer, nothing is written: call again with a longer one.
   */
  visiblePolygonInto(points: Float64Array, x: number, y: number, view?: View): number
  visiblePolygonInto(points: Float64Array, eye: Eye): number
  /** The cells seen from anywhere in a cell. */
  row(cell: number, options?: Mirrors): Uint32Array
  /** The cells seen from anywhere in some cells; of none, none. */
  seenFrom(cells: ArrayLike<number>, options?: Mirrors): Uint32Array
  /** The cells that a box lies in or touches. */
  boxCells(minX: number, minY: number, maxX: number, maxY: number): Uint32Array
  /** The view cell of a cell; -1 for none. */
  viewCell(cell: number): number
  close(): void
}
