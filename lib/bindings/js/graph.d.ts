/** Visibility graph analysis: a grid of points, which of them see each other, and measures. */
import { SightlineError } from './sightline.js'
import type { MapInput } from './bake.js'
import type { Depth, Measure, MeasureRow } from './measures.js'

export { SightlineError }

export type { Depth, Measure }

export interface Progress {
  /** Return false to stop. */
  progress?: (stage: string, done: number, total: number) => boolean | void
  /** Seconds after which to stop with an error. */
  timeLimit?: number
}

export interface GraphOptions extends Progress {
  /** The distance between neighbouring points. */
  grid: number
  /** Measures to compute at once; values() computes the others. */
  measures?: readonly Measure[]
  /** Doors that do not stand as the map says, by name: whether they are open. */
  doors?: Record<string, boolean>
  /** Points see no farther than this; 0: no limit; by default the map's own range. */
  range?: number
  /**
   * The most points, 20000 by default. The graph of n points takes at most about n * n bytes: of
   * 20000, 400 MB, but 7 MB in a hall of pillars.
   */
  most?: number
  /** How wide openings to the outside are at most; by default, and for 0, as the map says. */
  entrance?: number
  /** The name of the map in messages. */
  name?: string
}

export class Graph {
  private constructor()
  readonly step: number
  readonly count: number
  /** Of the squares around all points; the first ones lie at left * step and bottom * step. */
  readonly columns: number
  readonly rows: number
  readonly left: number
  readonly bottom: number
  /** Whether one-way glass makes a difference between seeing and being seen: values are of what a point sees. */
  readonly directed: boolean
  /** x, y ... of all points. */
  readonly points: Float64Array
  /** By point: column * rows + row. */
  readonly squares: Uint32Array
  /** All measures of points, and all depths from a point. */
  readonly measures: readonly MeasureRow<Measure>[]
  readonly depths: readonly MeasureRow<Depth>[]
  /** A measure by point; NaN where it is not defined. */
  values(name: Measure, options?: Progress): Float64Array
  /** The point in whose square a place lies, or -1. */
  find(x: number, y: number): number
  /** How far points are from the point at a place; null without a point there. */
  depth(x: number, y: number, name?: Depth): Float64Array | null
  sees(a: number, b: number): boolean
  close(): void
}

export interface GraphCore {
  readonly version: string
  readonly measures: readonly MeasureRow<Measure>[]
  readonly depths: readonly MeasureRow<Depth>[]
  graph(map: MapInput, options: GraphOptions): Graph
}

/** Loads the module, for calls without promises. `memory`: the most bytes that it may take. */
export function load(options?: { memory?: number }): Promise<GraphCore>
/** Makes a graph of a map and measures it. Close it. */
export function graph(map: MapInput, options: GraphOptions): Promise<Graph>
