/** Between places: what is seen from a line or an area, what may be seen within reach, the shortest way. */
import { SightlineError } from './sightline.js'
import type { MapInput } from './bake.js'
import type { FloorCore, OpenFloor, OpenOptions } from './floor.js'
import type { Place } from './sightline.js'

export { SightlineError }
export type { OpenOptions }

export interface SetOptions {
  /** The points are the corners of a convex area; else those of a line. */
  area?: boolean
  /** From some point of it ('some', by default: weak visibility), or from all (complete visibility). */
  seen?: 'some' | 'all'
  /** Of a disc about one point: as a polygon in it, with chords within a thousandth of this. */
  radius?: number
  /** Sees no farther than this; 0: no limit; by default the map's own range. */
  range?: number
}

export interface SetRegion {
  area: number
  /** A wall crosses the set, so nothing is seen from all of it. */
  walled: boolean
  /** Simple loops, x, y ... each: outer ones counter-clockwise, holes clockwise. */
  loops: Float64Array[]
}

/** How a thing is seen from a path. */
export interface Exposure {
  /** The length of a line, or what of an area is inside. */
  size: number
  /** What of that is seen from some point of the path. */
  seen: number
  /** How much of the path sees some of it, and all of it, as lengths. */
  pathSome: number
  pathAll: number
  /** How far along the path it is seen first; null: never. */
  first: number | null
}

export interface Path {
  length: number
  /** x, y ... from a, by the corners where the way turns, to b. */
  points: Float64Array
}

export class Floor extends OpenFloor {
  private constructor()
  /**
   * What is seen from a line, an area or a disc. Corners that are no ends of walls are rounded. Within
   * a range, bent borders are chords: what is seen from as far as 255/256 of it is in the region.
   */
  regionFrom(points: readonly Place[], options?: SetOptions): SetRegion
  /** Which places are seen from it. Exact. */
  seenFrom(points: readonly Place[], places: readonly Place[], options?: SetOptions): boolean[]
  /** What of each thing, a line or a convex area, is seen from a path of two points or more. */
  exposure(path: readonly Place[], things: readonly (readonly Place[])[], options?: { area?: boolean }): Exposure[]
  /**
   * Whether some place up to so far from a may see some place near b. It never misses. `onFoot`:
   * places that a way of that length leads to, through doors as they stand.
   */
  seesWithin(a: Place, aRadius: number, b: Place, bRadius: number, options?: { onFoot?: boolean }): boolean
  /**
   * The shortest way; null: none leads there. `loss`: how much longer the way counts for each shut
   * door that it passes; without it, none is passed. `radius`: of a walker, whose middle stays farther
   * than that from all walls: no longer than the shortest way for 1.0013 times the radius. Both ends need that room.
   */
  path(a: Place, b: Place, options?: { loss?: number; radius?: number }): Path | null
}

/** Loads the module, for calls without promises. `memory`: the most bytes that it may take. */
export function load(options?: { memory?: number }): Promise<FloorCore<Floor>>
/** Reads a map. Close the floor. */
export function open(map: MapInput, options?: OpenOptions): Promise<Floor>
