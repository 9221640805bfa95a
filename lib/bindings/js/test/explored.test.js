/** Explored areas: unions against counted squares, saved and read. */
import assert from 'node:assert/strict'
import test from 'node:test'
import { load, random } from './help.js'

const { load: loadExplored, open, read, SightlineError } = await load('explored.js')
const { open: openWorld } = await load('world.js')
const core = await loadExplored()

const square = (x, y, size = 1) => [x, y, x + size, y, x + size, y + size, x, y + size]

test('unions of squares have the area of the squares that they cover', () => {
  for (const resolution of [0, 0.25]) {
    const explored = core.open({ resolution }), next = random(5), seen = new Set()
    for (let i = 0; i < 80; i++) {
      const x = Math.floor(10 * next()), y = Math.floor(10 * next())
      explored.add(i % 2 ? Float64Array.from(square(x, y, 2)) : square(x, y, 2))
      for (const [dx, dy] of [[0, 0], [1, 0], [0, 1], [1, 1]]) seen.add(`${x + dx} ${y + dy}`)
    }
    assert.equal(explored.area, seen.size)
    for (let x = 0; x < 12; x++)
      for (let y = 0; y < 12; y++) assert.equal(explored.holds([x + 0.5, y + 0.5]), seen.has(`${x} ${y}`))
    const again = core.read(explored.text())
    assert.deepEqual(again.loops(), explored.loops())
    assert.equal(again.text(), explored.text())
    again.close()
    explored.close()
  }
})

test('areas have holes, and grow by what a world sees', async () => {
  const explored = await open()
  assert.deepEqual([explored.area, explored.loops()], [0, []])
  explored.add([square(0, 0, 4), [1, 1, 1, 2, 2, 2, 2, 1]])
  assert.equal(explored.area, 15)
  assert.deepEqual([explored.holds([1.5, 1.5]), explored.holds({ x: 1, y: 1 }), explored.loops().length], [false, true, 2])
  const world = await openWorld('sightline 1\nwalls 0 0 8 0 8 4 0 4 0 0\nwall 4 0 4 3\n')
  const seen = await open()
  for (const x of [1, 7]) seen.add(world.visiblePolygon(x, 1))
  assert.deepEqual([seen.area.toFixed(9), seen.loops().length, seen.holds([7, 1])], ['32.000000000', 1, true]) // each sees its room
  const same = await read(seen.text())
  assert.equal(same.area, seen.area)
  for (const each of [explored, seen, same, world]) each.close()
  assert.throws(() => seen.area, /closed/)
})

test('what cannot be is refused with its reason', () => {
  const explored = core.open()
  for (const [call, message] of [
    [() => core.open({ resolution: -1 }), /resolution/], [() => core.read('fog'), /the text:1|line 1|sightline-explored/],
    [() => explored.add([1, 2, 3]), /x, y/], [() => explored.add([0, 0, 1, 0, NaN, 1]), /number/], [() => explored.add(7), /add/],
    [() => explored.holds([1]), /holds/], [() => core.read(5), /text/],
  ]) assert.throws(call, (error) => error instanceof SightlineError && message.test(error.message), String(message))
  assert.equal(explored.area, 0)
  explored.close()
})
