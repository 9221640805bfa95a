/** Worlds: walls that change, and questions in between. An edit costs what it touches, and no bake. */
import { SightlineError } from './sightline.js'
import type { Bounds, Place, Segment, View } from './sightline.js'
import type { MapInput } from './bake.js'

export { SightlineError }

/** 'seam': what does not stop all of sight, steps and sound. */
export type WallKind = 'wall' | 'door' | 'oneway' | 'seam' | 'mirror'
/** 'limited': sight passes one such wall, not two. */
export type Stop = 'sight' | 'steps' | 'sound' | 'limited'

export interface WallOptions {
  /** 'wall' by default. Glass is seen through from its right to its left, going along it. */
  kind?: WallKind
  /** Of a door. */
  name?: string
  open?: boolean
  /** What alone a wall stops; it is a seam then. */
  stops?: readonly Stop[]
  /** Of a mirror: it reflects on its left alone, going along it. */
  oneSided?: boolean
}

export interface Wall {
  number: number
  kind: WallKind
  segment: [number, number, number, number]
  /** Of a door. */
  name?: string
  open?: boolean
  /** Of a seam. */
  stops?: Stop[]
  /** Of a mirror. */
  oneSided?: boolean
}

/** What a commit did to the cells. A number may be in both: it then stands for another cell. */
export interface Changes {
  gone: Uint32Array
  came: Uint32Array
  /** Cells whose visible sets may have changed, those that came among them; where the world keeps sets. */
  rows: Uint32Array
}

export interface WorldOptions {
  /** Walls lie within; by default the bounds of the map and an eighth of their size more on each side. */
  bounds?: Bounds
  /** Visible sets: none (by default), exact after each commit, or conservative until settle(). */
  rows?: 'none' | 'now' | 'later'
  /** Whether sightlines that only touch a wall count in visible sets: 'closed', by default, if so. */
  sight?: 'closed' | 'open'
  /** The name of the map in messages. */
  name?: string
}

/**
 * Walls have numbers, from when they are added until they are removed: first the map's walls, then
 * its doors, its one-way glass, its seams and its mirrors. Answers are those of a map that is opened anew, but
 * nothing is welded: where ends of walls meet but for rounding, slits stay that a bake closes. Edits count from the next
 * commit on.
 */
export class World {
  private constructor()
  /** Adds a wall; its number. */
  add(segment: Segment, options?: WallOptions): number
  /** Adds a polygon of solid ground; the numbers of its walls. It goes when they are removed. */
  addSolid(corners: readonly Place[]): number[]
  remove(wall: number): void
  /** It keeps its number. */
  move(wall: number, segment: Segment): void
  setOpen(door: number, open: boolean): void
  /** Makes the edits. If it throws, they are forgotten, and all is as it was. */
  commit(): Changes
  /** Forgets the edits since the last commit. */
  discard(): void
  /**
   * Takes back the last commit that made edits: walls come back with their numbers. null: there is
   * none. It throws where that commit removed walls of solid ground.
   */
  undo(): Changes | null

  /** A wall as it was at the last commit; null if there is none of that number. */
  wall(number: number): Wall | null
  readonly walls: Wall[]
  readonly cellCount: number
  /** The corners of a cell: x, y ...; none if there is no such cell. Numbers have gaps. */
  cell(number: number): Float64Array
  /** The cell that holds a point; -1 outside the bounds. */
  locate(x: number, y: number): number
  /** Whether a point sees another, within the map's range. Exact. */
  canSee(a: Place, b: Place): boolean
  /** The polygon that an eye sees: x, y ... counter-clockwise; arcs as chords. */
  visiblePolygon(x: number, y: number, options?: View & { tolerance?: number }): Float64Array
  /**
   * The polygons that an eye sees by mirror, after up to `depth` reflections (1 by default): the number of the mirror
   * last looked into and how many reflections lead there. The first call after a commit takes time that grows with
   * the world.
   */
  mirroredPolygons(x: number, y: number, options?: View & { tolerance?: number, depth?: number }):
    { wall: number, depth: number, polygon: Float64Array }[]
  /** The visible set of a cell. It knows nothing of mirrors, and takes limited walls as open. */
  row(cell: number): Uint32Array
  /** Makes visible sets exact, for about so many milliseconds; how many are left. */
  settle(milliseconds?: number): number
  close(): void
}

export interface WorldCore {
  readonly version: string
  open(map: MapInput, options?: WorldOptions): World
}

/** Loads the module, for calls without promises. `memory`: the most bytes that it may take. */
export function load(options?: { memory?: number }): Promise<WorldCore>
/** Opens a map for edits. Close the world. */
export function open(map: MapInput, options?: WorldOptions): Promise<World>
