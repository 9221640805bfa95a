/** Coverage and placement are those of the native command. */
import assert from 'node:assert/strict'
import { readFileSync, writeFileSync } from 'node:fs'
import test from 'node:test'
import { command, load, nativeBake, place } from './help.js'

const { open, load: loadCore, SightlineError } = await load('place.js')
const core = await loadCore()

// A comb: each tooth needs a viewpoint of its own. Upright, and turned.
const corners = [[0, 0], [12, 0], [12, 9], [11, 9], [10, 1], [7, 1], [6.5, 9], [5.5, 9], [5, 1], [2, 1], [1, 9], [0, 9], [0, 0]]
const comb = (degrees) => {
  const c = Math.cos((degrees * Math.PI) / 180), s = Math.sin((degrees * Math.PI) / 180)
  const turned = ([x, y]) => `${c * x - s * y} ${s * x + c * y}`
  return `sightline 1\nwalls ${corners.map(turned).join(' ')}\nstart ${turned([6, 0.5])} 0\n`
}
const two = 'sightline 1\nwalls 0 0 8 0 8 4 0 4 0 0\nwall 4 0 4 3\ndoor gap 4 3 4 4 open\n'

function native(name, text, ...words) {
  const path = place('place.map')
  writeFileSync(path, text)
  return JSON.parse(command(name, path, ...words, '--json'))
}

test('what viewpoints see is what the command says', () => {
  const table = place('cameras.csv')
  writeFileSync(table, 'x,y,heading,fov,range\n1,1,,,\n6,0.5,120,70,6\n11.5,8.5,250,90,3\n')
  const viewpoints = [{ x: 1, y: 1 }, { x: 6, y: 0.5, heading: 120, fov: 70, range: 6 },
    { x: 11.5, y: 8.5, heading: 250, fov: 90, range: 3, name: 'corner' }]
  const told = native('cover', comb(0), table), floor = core.open(comb(0)), seen = floor.cover(viewpoints)
  assert.deepEqual(seen.areas, ['0', '1', '2', '3+'].map((name) => told.areas[name]))
  assert.deepEqual(seen.viewpoints.map((each) => [each.seen, each.alone, each.spare]),
    told.viewpoints.map((each) => [each.seen_area, each.alone_area, each.spare]))
  assert.equal(seen.viewpoints[2].name, 'corner')
  assert.deepEqual(seen.blindSpots.map((spot) => [spot.area, spot.x, spot.y]),
    told.blind_spots.map((spot) => [spot.area, spot.x, spot.y]))
  const areas = [0, 0, 0, 0]
  for (const { count, points } of seen.pieces)
    for (let i = 0, n = points.length; i < n; i += 2)
      areas[Math.min(count, 3)] += (points[i] * points[(i + 3) % n] - points[(i + 2) % n] * points[i + 1]) / 2
  areas.forEach((area, k) => assert.ok(Math.abs(area - seen.areas[k]) < 1e-9, `${k}: ${area}`))
  floor.close()
  assert.throws(() => floor.cover([]), /closed/)
})

test('the work stops where it is asked to, and keeps the best set', () => {
  const floor = core.open(comb(0)), found = floor.place({ stop: () => true })
  assert.ok(found.stopped && found.lower < found.upper && found.viewpoints.length === found.upper)
  assert.equal(floor.cover(found.viewpoints).areas[0], 0)
  assert.throws(() => floor.place({ stop: true }), /stop: a function is needed/)
  floor.close()
})

test('the fewest have the bounds of the command, also turned and of a baked file', async () => {
  for (const degrees of [0, 17.3]) {
    const told = native('place', comb(degrees)), floor = await open(comb(degrees)), found = floor.place()
    assert.deepEqual([found.lower, found.upper, found.optimal, found.stopped], [3, 3, true, false])
    assert.deepEqual([told.lower, told.upper, told.witnesses], [found.lower, found.upper, found.witnesses.length])
    assert.equal(found.viewpoints.length, 3)
    assert.equal(floor.cover(found.viewpoints).areas[0], 0)
    assert.match(found.proof, /No fewer can: \d+ witnesses inside need 3 viewpoints, wherever they stand/)
    floor.close()
  }
  const path = place('comb.map')
  writeFileSync(path, comb(0))
  const floor = core.open(nativeBake(path).bytes)
  assert.equal(floor.place({ from: 'corners' }).upper, 3)
  floor.close()
})

test('doors count as they are set', () => {
  const floor = core.open(two)
  assert.equal(floor.cover([{ x: 4, y: 3.5 }]).areas[0], 0)
  floor.setDoor('gap', false)
  assert.deepEqual(floor.cover([{ x: 2, y: 2 }]).areas, [16, 16, 0, 0])
  floor.close()
  const shut = core.open(two, { doors: { gap: false } })
  assert.deepEqual(shut.cover([]).areas, [32, 0, 0, 0])
  shut.close()
})

test('stopped, placement keeps the best set and both bounds', () => {
  const floor = core.open(readFileSync(new URL('../../../../maps/office.map', import.meta.url), 'utf8'))
  const heard = []
  const found = floor.place({ progress: (stage, lower, upper) => {
    if (stage === 'place') heard.push([lower, upper])
    return stage !== 'place'
  } })
  assert.ok(found.stopped && heard.length > 0)
  assert.ok(found.lower >= 1 && found.lower <= found.upper && found.viewpoints.length === found.upper)
  assert.ok(floor.cover(found.viewpoints).areas[0] === 0)
  floor.close()
})

test('what cannot be is refused with its reason, and the module goes on', async () => {
  const floor = core.open(two)
  for (const [call, message] of [
    [() => floor.cover([{ x: 1 }]), /y/], [() => floor.cover([{ x: 1, y: 1, fov: 400 }]), /viewpoint|cone|fov/],
    [() => floor.cover([{ x: 1, y: 1, zoom: 2 }]), /zoom/], [() => floor.cover(3), /a list/],
    [() => floor.place({ from: 'roof' }), /anywhere, corners/], [() => floor.place({ from: 'grid' }), /step/],
    [() => floor.setDoor('none', true), /no door 'none'/], [() => core.open(two, { doors: { none: true } }), /no door/],
  ]) assert.throws(call, (error) => error instanceof SightlineError && message.test(error.message), String(message))
  assert.equal(floor.place().upper, 1)
  floor.close()
  await assert.rejects(open('nonsense'), SightlineError)
})
