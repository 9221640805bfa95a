/** A level answers as the runtime header and the library do in native code, to the last bit. */
import assert from 'node:assert/strict'
import { basename } from 'node:path'
import test from 'node:test'
import { answers, load, maps, nativeBake, random } from './help.js'

const { Level, SightlineError } = await load('sightline.js')
const { direction } = await load('host.js')

/** Points of a level: anywhere, on a grid, on corners, and on sides of cells. */
function points(level, next, count) {
  const { minX, minY, maxX, maxY } = level.bounds
  return Array.from({ length: count }, (_, i) => {
    const x = minX + next() * (maxX - minX), y = minY + next() * (maxY - minY)
    const { corners } = level.cells[Math.floor(next() * level.cellCount)]
    const corner = 2 * Math.floor((next() * corners.length) / 2)
    const after = (corner + 2) % corners.length
    if (i % 4 === 1) return { x: Math.round(x), y: Math.round(y) }
    if (i % 4 === 2) return { x: corners[corner], y: corners[corner + 1] }
    if (i % 4 === 3) return { x: (corners[corner] + corners[after]) / 2, y: (corners[corner + 1] + corners[after + 1]) / 2 }
    return { x, y }
  })
}

const text = (numbers) => Array.from(numbers, (n) => (Object.is(n, -0) ? '-0' : String(n))).join(' ')

test('answers are the native ones', async () => {
  let asked = 0
  const sees = [0, 0]
  for (const path of maps) {
    const { bytes, path: slv } = nativeBake(path)
    const level = await Level.open(bytes)
    const next = random(basename(path).length)
    const questions = [], got = []
    const ask = (question, answer) => {
      questions.push(question)
      got.push(answer)
    }
    for (let turn = 0; turn < 3; turn++) {
      const places = points(level, next, 60)
      for (const { x, y } of places) {
        ask(`l ${x} ${y}`, String(level.locate(x, y)))
        const b = places[Math.floor(next() * places.length)]
        const seen = +level.canSee({ x, y }, b)
        sees[seen]++
        ask(`p ${x} ${y} ${b.x} ${b.y}`, String(seen))
        const from = Math.floor(next() * level.cellCount), to = Math.floor(next() * level.cellCount)
        ask(`c ${from} ${to}`, String(+level.canSee(from, to)))
        const angle = Math.floor(next() * 360), width = [360, 45, 90, 270][Math.floor(next() * 4)]
        const range = level.range || next() < 0.5 ? 0 : 7
        const options = { direction: angle, fieldOfView: width, range }
        const view = [x, y, +(width >= 360), ...direction(angle - width / 2), ...direction(angle + width / 2), range].join(' ')
        ask(`k ${view}`, text(level.look(x, y, options)))
        ask(`v ${view}`, text(level.visiblePolygon(x, y, options)))
      }
      level.doors.forEach((door, i) => {
        const open = next() < 0.5
        level.setDoor(door.name, open)
        questions.push(`d ${i} ${+!open}`)
      })
      // Doors of one name go together.
      level.doors.forEach((door, i) => questions.push(`d ${i} ${+!door.open}`))
    }
    const want = answers(slv, questions)
    assert.equal(want.length, got.length)
    const asking = questions.filter((question) => question[0] !== 'd')
    want.forEach((line, i) => {
      const native = asking[i][0] === 'v' ? text(line ? line.split(' ').map(Number) : []) : line
      assert.equal(got[i], native, `${path}: ${asking[i]}`)
    })
    asked += want.length
    level.close()
  }
  assert.ok(asked > 10000)
  assert.ok(sees[0] > 500 && sees[1] > 500, String(sees))
})

test('a level tells its cells, doors and starts', async () => {
  const { bytes } = nativeBake(maps.find((path) => path.endsWith('doors.map')))
  const level = await Level.open(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length))
  assert.equal(level.cells.length, level.cellCount)
  assert.ok(level.doors.some((door) => !door.open))
  const { name } = level.doors[0]
  level.setDoor(name, false)
  assert.equal(level.doors[0].open, false)
  assert.throws(() => level.setDoor('no such door', true), SightlineError)
  for (const cell of level.cells) for (const portal of cell.portals) assert.ok(portal.cell < level.cellCount)
  assert.ok(level.starts.length > 0)
  assert.equal(level.locate(1e6, 0), -1)
  assert.ok(level.row(0).includes(0))
  level.close()
  assert.throws(() => level.locate(0, 0), /closed/)
})
