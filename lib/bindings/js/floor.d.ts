/** What place.d.ts and ways.d.ts share: a map that is open for questions. */
import type { MapInput } from './bake.js'

export class OpenFloor {
  protected constructor()
  /** Opens or shuts all doors of a name. */
  setDoor(name: string, open: boolean): void
  /** Gives back the memory. */
  close(): void
}

export interface OpenOptions {
  /** Doors that do not stand as the map says, by name: whether they are open. */
  doors?: Record<string, boolean>
  /** How wide openings to the outside are at most; by default, and for 0, as the map says. */
  entrance?: number
  /** The name of the map in messages. */
  name?: string
}

/** A loaded module, for calls without promises. */
export interface FloorCore<Floor> {
  readonly version: string
  /** Reads a map or the bytes of a .slv. Close the floor. */
  open(map: MapInput, options?: OpenOptions): Floor
}
