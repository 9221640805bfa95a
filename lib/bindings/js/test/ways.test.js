/** Sight from lines and areas, reach and shortest ways, beside the native command. */
import assert from 'node:assert/strict'
import { readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import test from 'node:test'
import { command, load, nativeBake, place, random, root } from './help.js'

const { load: loadWays, open, SightlineError } = await load('ways.js')
const { load: loadBake } = await load('bake.js')
const core = await loadWays(), bakes = await loadBake()

// A wall with a gap beside its end, and a door in it. Upright, and turned.
const turn = (degrees) => {
  const c = Math.cos((degrees * Math.PI) / 180), s = Math.sin((degrees * Math.PI) / 180)
  return ([x, y]) => [c * x - s * y, s * x + c * y]
}
const hall = (degrees = 0) => {
  const line = (...points) => points.map(turn(degrees)).flat().join(' ')
  return `sightline 1\nwalls ${line([0, 0], [8, 0], [8, 4], [0, 4], [0, 0])}\nwall ${line([4, 0], [4, 2])}\n` +
    `door gap ${line([4, 2], [4, 3])} shut\n`
}

const areaOf = (loops) => loops.reduce((sum, p) => {
  for (let i = 0, n = p.length; i < n; i += 2) sum += (p[i] * p[(i + 3) % n] - p[(i + 2) % n] * p[i + 1]) / 2
  return sum
}, 0)

test('regions are what eyes on the line see, some of them or all', () => {
  for (const degrees of [0, 17.3]) {
    const at = turn(degrees), floor = core.open(hall(degrees)), scene = bakes.open(hall(degrees)), next = random(1)
    const line = [at([1, 1]), at([3, 3.5])]
    const some = floor.regionFrom(line), all = floor.regionFrom(line, { seen: 'all' })
    assert.ok(all.area < some.area && some.area < 32 && !some.walled)
    for (const region of [some, all]) assert.ok(Math.abs(areaOf(region.loops) - region.area) < 1e-9)
    const places = Array.from({ length: 200 }, () => at([8 * next(), 4 * next()]))
    const eyes = Array.from({ length: 60 }, (_, i) => [0, 1].map((k) => line[0][k] + (i / 59) * (line[1][k] - line[0][k])))
    const bySome = floor.seenFrom(line, places), byAll = floor.seenFrom(line, places, { seen: 'all' })
    places.forEach((point, i) => {
      const seen = eyes.map((eye) => scene.canSee(eye, point))
      if (seen.some(Boolean)) assert.ok(bySome[i], `some ${point}`)
      if (byAll[i]) assert.ok(seen.every(Boolean), `all ${point}`)
    })
    assert.ok(byAll.some(Boolean) && bySome.some((seen, i) => seen && !byAll[i]) && bySome.includes(false))
    floor.close()
    scene.close()
  }
})

test('an area sees what it holds, and regions have the areas of the command', () => {
  const floor = core.open(hall()), path = place('hall.map'), corners = [[1, 1], [2, 1], [2, 2], [1, 2]]
  writeFileSync(path, hall())
  const [some, all] = command('isovist', path, '--from-line', '1,1,3,3.5', '-o', '-').split('\n').slice(1).map((row) => Number(row.split(',')[1]))
  assert.deepEqual([floor.regionFrom([[1, 1], [3, 3.5]]).area, floor.regionFrom([[1, 1], [3, 3.5]], { seen: 'all' }).area], [some, all])
  assert.deepEqual(floor.seenFrom(corners, [[1.5, 1.5], [7, 0.5]], { area: true }), [true, false])
  assert.ok(floor.regionFrom(corners, { area: true }).area > floor.regionFrom(corners, { area: true, seen: 'all' }).area)
  assert.equal(floor.regionFrom([[3, 1], [5, 1]]).walled, true)
  assert.equal(floor.regionFrom([[3, 1], [5, 1]], { seen: 'all' }).area, 0)
  floor.close()
})

test('discs and ranges are those of the command, and what eyes in them see', () => {
  const floor = core.open(hall()), scene = bakes.open(hall()), path = place('hall.map'), next = random(3), middle = [1.5, 1.5]
  writeFileSync(path, hall())
  const areas = (...words) => command('isovist', path, ...words, '-o', '-').split('\n').slice(1, 3).map((row) => Number(row.split(',')[1]))
  const both = (points, options) => ['some', 'all'].map((seen) => floor.regionFrom(points, { ...options, seen }).area)
  const free = both([middle], { radius: 0.75 }), near = both([middle], { radius: 0.75, range: 3 })
  // Sines of the two are rounded in their own ways.
  const close = (one, other) => one.forEach((area, i) => assert.ok(Math.abs(area - other[i]) < 1e-12 * area, `${one} ${other}`))
  close(free, areas('--from-area', '1.5,1.5,0.75'))
  close(near, areas('--from-area', '1.5,1.5,0.75', '--range', '3'))
  assert.deepEqual(both([[1, 1], [3, 3.5]], { range: 2.5 }), areas('--from-line', '1,1,3,3.5', '--range', '2.5'))
  assert.ok(near[0] < free[0] && near[1] < near[0])
  assert.equal(floor.regionFrom([middle], { radius: 0.75 }).area, free[0], 'a range lasts for one question')
  const places = Array.from({ length: 150 }, () => [8 * next(), 4 * next()])
  // Between the disc and the polygon in it, of which chords are within a thousandth of the radius.
  const eyes = (radius) => Array.from({ length: 48 }, (_, i) => [1.5 + radius * Math.cos(i * Math.PI / 24), 1.5 + radius * Math.sin(i * Math.PI / 24)])
  const bySome = floor.seenFrom([middle], places, { radius: 0.75, range: 3 }), byAll = floor.seenFrom([middle], places, { radius: 0.75, range: 3, seen: 'all' })
  places.forEach((point, i) => {
    const seen = eyes(0.749).map((eye) => scene.canSee(eye, point, { range: 3 }))
    if (seen.some(Boolean)) assert.ok(bySome[i], `some ${point}`)
    if (byAll[i]) assert.ok(seen.every(Boolean), `all ${point}`)
  })
  assert.ok(byAll.some(Boolean) && bySome.some((seen, i) => seen && !byAll[i]) && bySome.includes(false))
  floor.close()
  const ranged = core.open(`${hall()}range 2\n`), at = [[1, 1], [3, 3.5]]
  assert.equal(ranged.regionFrom(at).area, ranged.regionFrom(at, { range: 2 }).area)
  assert.equal(ranged.regionFrom(at, { range: 0 }).area, areas('--from-line', '1,1,3,3.5')[0])
  ranged.close()
  scene.close()
})

test('a walker with a radius stays away from walls, and passes no gap that is too narrow', () => {
  const floor = core.open(hall()), path = place('walk.map')
  writeFileSync(path, hall())
  const told = Number(/^length ([\d.]+)/.exec(command('path', path, '--from', '1,1', '--to', '7,1', '--radius', '0.25'))[1])
  const way = floor.path([1, 1], [7, 1], { radius: 0.25 })
  assert.ok(way.length > floor.path([1, 1], [7, 1]).length && Math.abs(way.length - told) < 1e-12 * told, `${way.length} ${told}`)
  assert.equal(floor.path([1, 1], [7, 1], { radius: 0.6 }), null)
  floor.setDoor('gap', true)
  assert.ok(floor.path([1, 1], [7, 1], { radius: 0.6 }).length > way.length - 1)
  assert.throws(() => floor.path([0.1, 1], [7, 1], { radius: 0.25 }), /too near to the wall/)
  assert.throws(() => floor.path([1, 1], [7, 1], { radius: 0.25, loss: 1 }), SightlineError)
  assert.equal(floor.path([1, 1], [7, 1]).length, 2 * Math.hypot(3, 1), 'the next question is of a point again')
  floor.close()
})

test('ways turn at the ends of walls, and doors are in the way', () => {
  const floor = core.open(hall()), way = floor.path([1, 1], { x: 7, y: 1 })
  assert.deepEqual([...way.points], [1, 1, 4, 3, 7, 1])
  assert.ok(Math.abs(way.length - 2 * Math.hypot(3, 2)) < 1e-12)
  const lossy = floor.path([1, 1], [7, 1], { loss: 0.25 })
  assert.deepEqual([...lossy.points], [1, 1, 4, 2, 7, 1])
  assert.ok(Math.abs(lossy.length - 2 * Math.hypot(3, 1) - 0.25) < 1e-12)
  floor.setDoor('gap', true)
  assert.deepEqual([...floor.path([1, 1], [7, 1]).points], [1, 1, 4, 2, 7, 1])
  floor.close()
  const shut = core.open('sightline 1\nwalls 0 0 4 0 4 4 0 4 0 0\nwall 2 0 2 4\n')
  assert.equal(shut.path([1, 1], [3, 1]), null)
  shut.close()
})

test('ways and reach on a plan of the project are those of the command', async () => {
  const path = join(root, 'maps/office.map'), floor = await open(nativeBake(path).bytes), table = place('pairs.csv')
  const scene = bakes.open(readFileSync(path, 'utf8')), { minX, minY, maxX, maxY } = scene.bounds, next = random(7)
  const pairs = Array.from({ length: 40 }, () => [0, 1].map(() => [minX + next() * (maxX - minX), minY + next() * (maxY - minY)]))
    .filter(([a, b]) => floor.path(a, b)) // the command's status is 3 where a pair has no way
  writeFileSync(table, `from_x,from_y,to_x,to_y\n${pairs.join('\n')}\n`)
  const told = command('path', path, '--pairs', table).split('\n').slice(1).map((row) => Number(row.split(',')[4] || NaN))
  pairs.forEach(([a, b], i) => {
    assert.equal(floor.path(a, b).length, told[i])
    if (scene.canSee(a, b)) assert.ok(floor.seesWithin(a, 0, b, 0) && floor.seesWithin(a, 0.1, b, 0.1, { onFoot: true }))
  })
  assert.ok(pairs.length > 10)
  floor.close()
  scene.close()
})

test('exposure is how much of a wall is seen, and from where', () => {
  const floor = core.open(hall()), [far, near] = floor.exposure([[1, 3.5], [7, 3.5]], [[[8, 0], [8, 4]], [[0, 0], [0, 4]]])
  for (const row of [far, near]) assert.ok(row.size === 4 && row.seen > 0 && row.seen <= 4 && row.pathSome <= 6)
  assert.equal(near.first, 0)
  assert.deepEqual(floor.exposure([[1, 1], [2, 1]], []), [])
  floor.close()
})

test('what cannot be is refused with its reason, and the module goes on', async () => {
  const floor = core.open(hall())
  for (const [call, message] of [
    [() => floor.regionFrom([[1, 1]], { seen: 'most' }), /'some' or 'all'/], [() => floor.regionFrom([1, 1]), /a point/],
    [() => floor.regionFrom([[1, 1], [2, 1]], { radius: 1 }), /radius.*one point/], [() => floor.regionFrom([[1, 1]], { radius: -1 }), /radius/],
    [() => floor.regionFrom([[1, 1], [2, 1]], { range: -1 }), /range/], [() => floor.seenFrom([], [], { radius: 1 }), /one point/],
    [() => floor.path([1, 1], [2, 1], { radius: '1' }), /radius/],
    [() => floor.regionFrom([[99, 1], [1, 1]]), /99/], [() => floor.regionFrom([[1, 1], [2, 1], [3, 1]], { area: true }), /area|convex/],
    [() => floor.path([1, 1], [2, NaN]), /a point/], [() => floor.path([1, 1], [2, 1], { loss: -1 }), /loss/],
    [() => floor.seesWithin([1, 1], -1, [2, 1], 0), /aRadius/], [() => floor.path([1, 1], [99, 1]), /99|bounds/],
    [() => floor.exposure([[1, 1]], [[[0, 0], [0, 4]]]), /path/], [() => floor.seenFrom([[1, 1]], 3), /a list/],
  ]) assert.throws(call, (error) => error instanceof SightlineError && message.test(error.message), String(message))
  floor.close()
  assert.throws(() => floor.path([1, 1], [2, 1]), /closed/)
  const mirrors = core.open('sightline 1\nwalls 0 0 4 0 4 4 0 4 0 0\nmirror 2 1 2 3\n')
  assert.throws(() => mirrors.regionFrom([[1, 1], [1, 2]]), /mirror/)
  assert.equal(mirrors.path([1, 2], [3, 2]).points.length, 6)
  mirrors.close()
  await assert.rejects(open('nonsense'), SightlineError)
})
