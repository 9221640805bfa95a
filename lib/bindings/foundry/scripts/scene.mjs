/**
 * The walls of a scene as a map of the npm package: pixels, with y up, so that -y stands for y. What `sight`, `move`,
 * `sound`, `dir`, `door` and `ds` mean is in Foundry's API, WallData.
 */
const SIGHT = { none: 0, limited: 10, normal: 20 }
const SIDE = { both: 0, left: 1, right: 2 }
const DOOR_OPEN = 1

/** Unset values are those of a plain wall. */
const sense = (value) => value ?? SIGHT.normal

/** What a wall stops. Sight or sound that ends by distance, or sound that is limited, passes: nothing seen is hidden. */
function stopsOf(wall) {
  const stops = []
  if (sense(wall.sight) === SIGHT.normal) stops.push('sight')
  if (sense(wall.sight) === SIGHT.limited && !wall.dir) stops.push('limited')
  if (sense(wall.move) !== SIGHT.none) stops.push('steps')
  if (sense(wall.sound) === SIGHT.normal) stops.push('sound')
  return stops
}

/** Whether a door stops sight while it is shut: then it is a door of the map, by its id. */
export const isDoor = (wall) => !!wall.door && sense(wall.sight) === SIGHT.normal

export const isOpen = (wall) => wall.ds === DOOR_OPEN

/** A window that opens stops no steps here, and nothing while it is open. */
function stopsOfWindow(wall) {
  return isOpen(wall) ? [] : stopsOf(wall).filter((stop) => stop !== 'steps')
}

/** Seams stop nothing: they say how large the scene is. */
function sidesOf({ x, y, width, height }) {
  const corners = [[x, -y], [x + width, -y], [x + width, -y - height], [x, -y - height]]
  return corners.map((corner, i) => [...corner, ...corners[(i + 1) % 4]])
}

/**
 * `walls`: documents of a scene, or what their toObject() gives. The result is what bake() takes. Walls of no length and
 * those that stop nothing are left out. A one-way wall that stops sight is one-way glass; of a door the side is not
 * kept: shut, it stops both. `edge`: { x, y, width, height } of the scene, or null.
 */
export function mapOf(walls, edge) {
  const map = { walls: [], doors: [], oneway: [], seams: edge ? sidesOf(edge) : [] }
  for (const wall of walls) {
    const [x0, y0, x1, y1] = wall.c
    const ends = { here: [x0, -y0, x1, -y1], back: [x1, -y1, x0, -y0] }
    if (x0 === x1 && y0 === y1) continue
    if (isDoor(wall)) {
      map.doors.push({ name: wall._id, segment: ends.here, open: isOpen(wall) })
      continue
    }
    const stops = wall.door ? stopsOfWindow(wall) : stopsOf(wall)
    if (wall.dir && stops.includes('sight')) map.oneway.push(wall.dir === SIDE.right ? ends.back : ends.here)
    else if (stops.length === 3 && !stops.includes('limited')) map.walls.push(ends.here)
    else if (stops.length) map.walls.push({ segment: ends.here, stops })
  }
  // A map needs a wall. Around what is convex, it hides nothing.
  if (!map.walls.length && !map.doors.length && !map.oneway.length) map.walls = map.seams.splice(0)
  return map
}
