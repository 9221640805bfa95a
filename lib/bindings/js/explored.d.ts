/** Explored areas: the union of what was seen, for fog that stays. */
import { SightlineError } from './sightline.js'
import type { Place } from './sightline.js'

export { SightlineError }

/** x, y, x, y ... of the corners of a loop; the last one joins the first. */
export type Loop = ArrayLike<number>

export interface ExploredOptions {
  /**
   * 0, the default: the area is exact, but for the rounding of places where outlines cross. Else all corners are
   * rounded to multiples of it, and the outline has no detail below it, however much is added.
   */
  resolution?: number
}

export class Explored {
  private constructor()
  /**
   * Adds what was seen: a loop, such as visiblePolygon() gives, or a list of loops, outer ones counter-clockwise and
   * holes clockwise.
   */
  add(shape: Loop | readonly Loop[]): void
  /** The area: outer loops counter-clockwise, holes clockwise. They meet in single points only. */
  loops(): Float64Array[]
  /** In square units of the map. */
  readonly area: number
  /** Whether a point is in the area, or on its border. */
  holds(point: Place): boolean
  /** The area as text, for a saved game; read() gives the same area. */
  text(): string
  close(): void
}

export interface ExploredCore {
  readonly version: string
  open(options?: ExploredOptions): Explored
  read(text: string, options?: { name?: string }): Explored
}

/** Loads the module, for calls without promises. `memory`: the most bytes that it may take. */
export function load(options?: { memory?: number }): Promise<ExploredCore>
/** An empty area. Close it. */
export function open(options?: ExploredOptions): Promise<Explored>
/** The area of a text. Close it. */
export function read(text: string, options?: { name?: string }): Promise<Explored>
