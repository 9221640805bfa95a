/** Viewpoints: what given ones see together, and where the fewest must stand. */
import { SightlineError } from './sightline.js'
import type { MapInput } from './bake.js'
import type { FloorCore, OpenFloor, OpenOptions } from './floor.js'

export { SightlineError }
export type { OpenOptions }

export interface Viewpoint {
  x: number
  y: number
  /** Degrees, counter-clockwise from +x. */
  heading?: number
  /** The width of the view cone in degrees; 360 by default: all round. */
  fov?: number
  /** Sees no farther; 0: no limit. */
  range?: number
  /** Sees nothing nearer: the dead zone below a camera. */
  nearest?: number
  name?: string
}

export interface SeenViewpoint extends Viewpoint {
  /** The area that it sees. */
  seen: number
  /** What of that no other sees. */
  alone: number
  /** Whether the others see all that it sees. */
  spare: boolean
}

export interface Coverage {
  /** What exactly 0, 1 and 2 see, and 3 or more. */
  areas: [number, number, number, number]
  viewpoints: SeenViewpoint[]
  /** The largest first. */
  blindSpots: { area: number; x: number; y: number; minX: number; minY: number; maxX: number; maxY: number }[]
  /** Convex pieces that tile the inside: x, y ..., how many see it, its blind spot or -1. */
  pieces: { count: number; blindSpot: number; points: Float64Array }[]
}

export interface PlaceOptions {
  /** Where viewpoints may stand; 'anywhere' by default. */
  from?: 'anywhere' | 'corners' | 'walls' | 'grid'
  /** Between points of a grid, or along walls. */
  step?: number
  /** Both bounds so far, as done and total. Return false to stop and keep the best set. */
  progress?: (stage: string, lower: number, upper: number) => boolean | void
  /** Seconds after which to stop and keep the best set. */
  timeLimit?: number
}

export interface Placement {
  /** No fewer can do it. Exact. */
  lower: number
  /** As many as there are viewpoints, which see everything. */
  upper: number
  optimal: boolean
  /** Whether it ended early. */
  stopped: boolean
  rounds: number
  /** Parts of borders beyond which something may be unseen, too thin to be found. */
  slivers: number
  unseenArea: number
  viewpoints: { x: number; y: number }[]
  /** Fewer viewpoints than `lower` do not see all of these. */
  witnesses: { x: number; y: number }[]
  /** What is proven, in a sentence. */
  proof: string
}

export class Floor extends OpenFloor {
  private constructor()
  /** What viewpoints see together. */
  cover(viewpoints: readonly Viewpoint[]): Coverage
  /** The fewest viewpoints that see all that is inside. It may take long: ask in a worker. */
  place(options?: PlaceOptions): Placement
}

/** Loads the module, for calls without promises. `memory`: the most bytes that it may take. */
export function load(options?: { memory?: number }): Promise<FloorCore<Floor>>
/** Reads a map for questions about viewpoints. Close it. */
export function open(map: MapInput, options?: OpenOptions): Promise<Floor>
