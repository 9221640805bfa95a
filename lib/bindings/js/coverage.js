/** What viewpoints see together: for the floors of place.js and cameras.js. */
import { listOf, numberOf, objectOf, optionsOf } from './arguments.js'
import { OpenFloor } from './floor.js'

/** A viewpoint as six numbers. @internal */
export function rowOf(given) {
  const { x, y, heading = 0, fov = 360, range = 0, nearest = 0 } = optionsOf(objectOf('viewpoint', given), 'x', 'y',
    'heading', 'fov', 'range', 'nearest', 'name', 'seen', 'alone', 'spare')
  numberOf('x', x)
  numberOf('y', y)
  numberOf('heading', heading)
  for (const [what, value] of Object.entries({ fov, range, nearest })) numberOf(what, value, 0)
  return [x, y, heading, fov, range, nearest]
}

/** Close it. */
export class CoverFloor extends OpenFloor {
  /** What viewpoints see together. */
  cover(viewpoints) {
    const { at, core } = this
    const given = listOf('viewpoints', viewpoints), rows = Float64Array.from(given.flatMap(rowOf))
    core.withBytes([new Uint8Array(rows.buffer)], (rowsAt) => core.ask((its) => its.floor_cover(at, rowsAt, given.length)))
    const [count, corners, spots, piecesAt, cornersAt, rowsAt] = core.given(6)
    const pieces = new Uint32Array(core.memory.buffer, piecesAt, 3 * count), xy = this.numbers(cornersAt, 2 * corners)
    const table = this.numbers(rowsAt, 3 * given.length + 7 * spots)
    let from = 0
    return {
      areas: [...core.givenNumbers(4)],
      viewpoints: given.map((viewpoint, i) => {
        const [seen, alone, spare] = table.subarray(3 * i)
        return { ...viewpoint, seen, alone, spare: spare === 1 }
      }),
      blindSpots: Array.from({ length: spots }, (_, i) => {
        const [area, x, y, minX, minY, maxX, maxY] = table.subarray(3 * given.length + 7 * i)
        return { area, x, y, minX, minY, maxX, maxY }
      }),
      pieces: Array.from({ length: count }, (_, i) => {
        const end = from + 2 * pieces[3 * i], spot = pieces[3 * i + 2]
        const piece = { count: pieces[3 * i + 1], blindSpot: spot === 0xffffffff ? -1 : spot, points: xy.slice(from, end) }
        from = end
        return piece
      }),
    }
  }
}
