/** A scene that answers who sees whom. Places are those of the canvas, in pixels. */
import { isDoor, isOpen, mapOf } from './scene.mjs'

/** What changes a scene's walls otherwise than by a door that opens or shuts. */
const SHAPE = ['c', 'sight', 'move', 'sound', 'dir', 'door']

export class Watch {
  #level

  constructor(level) {
    this.#level = level
  }

  /**
   * `walls`: those of the scene; `edge`: its rectangle, or null for that of its walls, beyond which nothing is seen.
   * `sightline`: { Level, bake } of the npm package. It rejects with an error that names the wall where a map is bad.
   */
  static async of(walls, edge, sightline) {
    const map = mapOf(walls, edge)
    const level = await sightline.Level.open(await sightline.bake(map), { transform: { origin: [0, 0], yDown: true } })
    return new Watch(level)
  }

  /** Whether a change of a wall needs no new bake: a door opened or shut, which is then so here, or nothing that counts. */
  update(wall, change) {
    if (SHAPE.some((key) => key in change)) return false
    if (!('ds' in change)) return true
    if (isDoor(wall)) this.#level.setDoor(wall._id, isOpen(wall))
    return isDoor(wall) || !wall.door
  }

  /** Whether an eye at a sees b: exact, whatever their range and light. */
  sees(a, b) {
    return this.#level.canSee({ x: a.x, y: a.y }, { x: b.x, y: b.y })
  }

  /** Whether one may walk straight from a to b. */
  canWalk(a, b) {
    return this.#level.canWalk({ x: a.x, y: a.y }, { x: b.x, y: b.y })
  }

  /** What is seen from a place: x, y, x, y ... */
  polygon(at, view = {}) {
    return this.#level.visiblePolygon(at.x, at.y, view)
  }

  /** The pairs [a, b] of places in which a sees b. */
  pairs(places) {
    return places.flatMap((a) => places.filter((b) => a !== b && this.sees(a, b)).map((b) => [a, b]))
  }

  close() {
    this.#level.close()
  }
}
