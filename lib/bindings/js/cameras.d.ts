/** Cameras: which of given places see everything, the most that a number of them see, and coverage. */
import { SightlineError } from './sightline.js'
import type { MapInput } from './bake.js'
import type { CoverFloor, Coverage, SeenViewpoint, Viewpoint } from './coverage.js'
import type { FloorCore, OpenOptions } from './floor.js'

export { SightlineError }
export type { Coverage, OpenOptions, SeenViewpoint, Viewpoint }

export interface ChooseOptions {
  /** Cameras that stand already. */
  fixed?: readonly Viewpoint[]
  /** How many must see each point; 1 by default. */
  cover?: number
  /** See as much as so many can beside the fixed ones, in place of everything. */
  count?: number
  /** Lines of sight join all cameras, up to their ranges. */
  network?: boolean
  /** Hears how far the work is. Return false to stop and keep the best set. */
  progress?: (stage: string, done: number, total: number) => boolean | void
  /** Is asked often while the work goes on. Return true to stop and keep the best set. */
  stop?: () => boolean
  /** Seconds after which to stop and keep the best set. */
  timeLimit?: number
}

export interface Choice {
  /** No fewer of the places can do it. Exact. */
  lower: number
  upper: number
  optimal: boolean
  /** Whether it ended early. */
  stopped: boolean
  /** To be seen, and what of that is seen. */
  area: number
  seen: number
  /** With `count`: no set of so many sees more. */
  seenMost?: number
  /** What no choice of the places sees. */
  blindArea: number
  /** Those that were chosen, the fixed ones among them. */
  viewpoints: Viewpoint[]
  /** What is proven, in a sentence. */
  proof: string
}

export class Floor extends CoverFloor {
  private constructor()
  /** Points where cameras may stand: at corners, along walls, on a grid. */
  points(from: 'corners' | 'walls' | 'grid', step?: number): { x: number; y: number }[]
  /** The fewest of the places that see all that they can see. It may take long: ask in a worker. */
  choose(places: readonly Viewpoint[], options?: ChooseOptions): Choice
}

/** Loads the module, for calls without promises. `memory`: the most bytes that it may take. */
export function load(options?: { memory?: number }): Promise<FloorCore<Floor>>
/** Reads a map for questions about cameras. Close it. */
export function open(map: MapInput, options?: OpenOptions): Promise<Floor>
