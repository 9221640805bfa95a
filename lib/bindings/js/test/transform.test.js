/** A level in other coordinates answers what it answers in those of the map; and files before 2.0 open. */
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import test from 'node:test'
import { load, maps, nativeBake, random, root } from './help.js'

const { Level, SightlineError } = await load('sightline.js')

const area = (points) => {
  let sum = 0
  for (let i = 0, j = points.length - 2; i < points.length; j = i, i += 2)
    sum += points[j] * points[i + 1] - points[i] * points[j + 1]
  return sum / 2
}

/** Asks both levels the same; `to` turns a place of the first into one of the second. All is exact. */
function compare(plain, turned, to) {
  const { scale, yDown } = turned.transform, next = random(7)
  const heading = (degrees) => (yDown ? 0 - degrees : degrees)
  const all = (points) => Array.from(points, (_, i) => to(points[i & ~1], points[i | 1])[i & 1])
  const { minX, minY, maxX, maxY } = plain.bounds
  const corners = [...to(minX, minY), ...to(maxX, maxY)]
  const wanted = { minX: corners[0], minY: Math.min(corners[1], corners[3]), maxX: corners[2], maxY: Math.max(corners[1], corners[3]) }
  assert.deepEqual({ ...turned.bounds }, wanted)
  assert.equal(turned.range, plain.range * scale)
  assert.deepEqual(turned.starts.map((s) => ({ ...s })), plain.starts.map((s) => {
    const [x, y] = to(s.x, s.y)
    return { x, y, heading: heading(s.heading) }
  }))
  assert.deepEqual(turned.doors, plain.doors.map((d) => ({ ...d, segments: d.segments.map(all) })))
  turned.cells.forEach((cell, i) => {
    assert.deepEqual([...cell.corners], all(plain.cells[i].corners))
    cell.portals.forEach((portal, k) => {
      assert.deepEqual([...portal.left, ...portal.right], all([...plain.cells[i].portals[k].left, ...plain.cells[i].portals[k].right]))
    })
  })
  for (let i = 0; i < 300; i++) {
    const place = () => [minX + Math.floor(next() * (maxX - minX) * 4) / 4, minY + Math.floor(next() * (maxY - minY) * 4) / 4]
    const [x, y] = place(), b = place(), [tx, ty] = to(x, y), angle = Math.floor(next() * 24) * 15
    assert.equal(turned.locate(tx, ty), plain.locate(x, y))
    assert.equal(turned.canSee([tx, ty], to(...b)), plain.canSee([x, y], b))
    assert.equal(turned.canSee([tx, ty], to(...b), { mirrors: true }), plain.canSee([x, y], b, { mirrors: true }))
    assert.equal(turned.canWalk({ x: tx, y: ty }, to(...b)), plain.canWalk([x, y], b))
    const [u, v] = to(x + 1, y + 2)
    assert.deepEqual(turned.boxCells(Math.min(tx, u), Math.min(ty, v), Math.max(tx, u), Math.max(ty, v)), plain.boxCells(x, y, x + 1, y + 2))
    for (const fov of [60, 200, 360]) {
      const range = plain.range ? undefined : 8
      const view = { heading: angle, fov, range }
      const same = { heading: heading(angle), fov, range: range && range * scale }
      assert.deepEqual(turned.look(tx, ty, same), plain.look(x, y, view))
      const polygon = turned.visiblePolygon(tx, ty, same)
      assert.deepEqual([...polygon], all(plain.visiblePolygon(x, y, view)))
      // As it is seen, it goes counter-clockwise.
      if (polygon.length > 4) assert.ok(area(polygon) * (yDown ? -1 : 1) >= 0)
    }
  }
  const { x, y } = plain.starts[0] ?? { x: (minX + maxX) / 2, y: (minY + maxY) / 2 }, [tx, ty] = to(x, y)
  for (const [dx, dy] of [[1, 0], [0, 1], [0, -1], [-1, 0]])
    assert.deepEqual(turned.look({ x: tx, y: ty, dx, dy: yDown ? -dy : dy, fov: 60 }), plain.look({ x, y, dx, dy, fov: 60 }))
}

test('a level of Tiled answers in the pixels of its file', async () => {
  const { bytes } = nativeBake(join(root, 'maps/keep.tmx'))
  const plain = await Level.open(bytes), turned = await Level.open(bytes, { transform: 'file' })
  assert.deepEqual(plain.transform.yDown, false)
  assert.deepEqual({ ...turned.transform, origin: { ...turned.transform.origin } }, { origin: { x: 0, y: 17 * 16 }, scale: 1, yDown: true })
  compare(plain, turned, (x, y) => [x, 17 * 16 - y])
})

test('a level answers in any coordinates', async () => {
  for (const [name, origin, scale, yDown] of [
    ['doors.map', [0, 20], 16, true], ['mirrors.map', { x: -3, y: 7 }, 0.25, true],
    ['office.map', [1000, -64], 4, false], ['chapel.map', [0, 0], 1, true],
  ]) {
    const { bytes } = nativeBake(maps.find((path) => path.endsWith(name)))
    const plain = await Level.open(bytes), turned = await Level.open(bytes, { transform: { origin, scale, yDown } })
    const [left, top] = Array.isArray(origin) ? origin : [origin.x, origin.y]
    compare(plain, turned, (x, y) => [scale * (x - left), scale * (yDown ? top - y : y - top)])
  }
})

test('a map text has its own coordinates, and what is wrong says so', async () => {
  const { bytes } = nativeBake(maps.find((path) => path.endsWith('flat.map')))
  const plain = await Level.open(bytes), own = await Level.open(bytes, { transform: 'file' })
  assert.deepEqual(own.bounds, plain.bounds)
  assert.deepEqual(own.transform, plain.transform)
  for (const transform of ['files', 3, [], { scale: 0 }, { scale: -1 }, { scale: Infinity }, { scale: '2' }, { yDown: 1 }, { origin: [1] }, { origin: 'a' }, { down: true }])
    await assert.rejects(Level.open(bytes, { transform }), SightlineError, JSON.stringify(transform))
  await assert.rejects(Level.open(bytes, { transfrom: 'file' }), /no option 'transfrom'/)
  assert.throws(() => { plain.transform = 3 }, TypeError)
})

test('a file before 2.0 opens with its names', async () => {
  const bytes = readFileSync(join(root, 'tests/old_files/effects.slv'))
  const described = JSON.parse(readFileSync(join(root, 'tests/old_files/effects.json'), 'utf8'))
  const level = await Level.open(bytes)
  assert.deepEqual(level.doors.map((door) => door.name), described.doors.map((door) => door.name))
  assert.equal(level.range, described.range)
  assert.equal(level.starts.length, described.starts.length)
  assert.equal(level.mirrors, 'baked')
  await assert.rejects(Level.open(bytes, { transform: 'file' }), { name: 'SightlineError', code: 'bad argument', message: /bake the map again/ })
  const damaged = Uint8Array.from(bytes)
  damaged[100] ^= 1
  await assert.rejects(Level.open(damaged), { code: 'bad input', message: /checksum/ })
})

test('a door is not shut by a word that is missing', async () => {
  const { bytes } = nativeBake(maps.find((path) => path.endsWith('doors.map')))
  const level = await Level.open(bytes), { name } = level.doors[0]
  level.setDoor(name, true)
  assert.throws(() => level.setDoor(name), /open: true or false is needed, not undefined/)
  assert.equal(level.doors[0].open, true)
})
