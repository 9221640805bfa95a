/** What place.d.ts and cameras.d.ts share: what viewpoints see together. */
import type { OpenFloor } from './floor.js'

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

export class CoverFloor extends OpenFloor {
  protected constructor()
  /** What viewpoints see together. */
  cover(viewpoints: readonly Viewpoint[]): Coverage
}
