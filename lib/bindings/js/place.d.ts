/** Viewpoints: what given ones see together, and where the fewest must stand. */
import { SightlineError } from './sightline.js'
import type { MapInput } from './bake.js'
import type { CoverFloor, Coverage, SeenViewpoint, Viewpoint } from './coverage.js'
import type { FloorCore, OpenOptions } from './floor.js'

export { SightlineError }
export type { Coverage, OpenOptions, SeenViewpoint, Viewpoint }

export interface PlaceOptions {
  /** Where viewpoints may stand; 'anywhere' by default. */
  from?: 'anywhere' | 'corners' | 'walls' | 'grid'
  /** Between points of a grid, or along walls. */
  step?: number
  /** Both bounds so far, as done and total. Return false to stop and keep the best set. */
  progress?: (stage: string, lower: number, upper: number) => boolean | void
  /** Is asked often while the work goes on. Return true to stop and keep the best set. */
  stop?: () => boolean
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

export class Floor extends CoverFloor {
  private constructor()
  /** The fewest viewpoints that see all that is inside. It may take long: ask in a worker. */
  place(options?: PlaceOptions): Placement
}

/** Loads the module, for calls without promises. `memory`: the most bytes that it may take. */
export function load(options?: { memory?: number }): Promise<FloorCore<Floor>>
/** Reads a map for questions about viewpoints. Close it. */
export function open(map: MapInput, options?: OpenOptions): Promise<Floor>
