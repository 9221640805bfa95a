/** Cameras among given places, against the answers of the command. */
import assert from 'node:assert/strict'
import { writeFileSync } from 'node:fs'
import test from 'node:test'
import { command, load, place } from './help.js'

const { open, load: loadCameras, SightlineError } = await load('cameras.js')

const TWO = `sightline 1
walls 0 0 8 0 8 4 0 4 0 0
wall 4 0 4 3
door gap 4 3 4 4 open
`
const path = place('two.map')
writeFileSync(path, TWO)
const native = (...options) => JSON.parse(command('place', path, '--json', ...options))
const headings = (count, like) => ({ x, y }) => Array.from({ length: count }, (_, i) => ({ x, y, heading: 360 * i / count, ...like }))

test('points are those of the command, and so are bounds, areas and the set', async () => {
  const floor = await open(TWO, { doors: { gap: false } })
  for (const [from, step, word] of [['grid', 1, 'grid:1'], ['corners', 0, 'corners'], ['walls', 2, 'walls:2']]) {
    const places = floor.points(from, step).flatMap(headings(8, { fov: 90, range: 5 }))
    const found = floor.choose(places), told = native('--from', word, '--fov', '90', '--range', '5', '--shut', 'gap')
    assert.equal(places.length, told.places)
    assert.deepEqual([found.lower, found.upper, found.optimal], [told.lower, told.upper, told.optimal])
    assert.equal(found.viewpoints.length, found.upper)
    assert.ok(Math.abs(found.blindArea - told.hidden_area) < 1e-9)
    assert.match(found.proof, /^No fewer can, of these \d+ places and headings at \d+ points: \d+ points inside need \d+ viewpoints\.$/)
    const { areas } = floor.cover(found.viewpoints)
    assert.ok(Math.abs(areas[0] - found.blindArea) < 1e-6 * found.area, from)
  }
  floor.close()
})

test('the most that two see, several for each point, a network, and those that stand already', async () => {
  const floor = await open(TWO), places = floor.points('grid', 1).map((at) => ({ ...at, range: 3 }))
  const most = floor.choose(places, { count: 2 }), told = native('--from', 'grid:1', '--range', '3', '--count', '2')
  assert.deepEqual([most.viewpoints.length, most.seen, most.seenMost], [2, told.to_see_seen_area, told.seen_area_bound])
  assert.match(most.proof, /no 2 of these 45 places see more than/)
  assert.equal(floor.choose(places, { cover: 2 }).upper, native('--from', 'grid:1', '--range', '3', '--cover', '2').upper)
  assert.equal(floor.choose(places, { network: true }).upper, native('--from', 'grid:1', '--range', '3', '--network').upper)
  const fixed = { x: 1, y: 1, range: 3, name: 'there' }, beside = floor.choose(places, { fixed: [fixed] })
  assert.deepEqual(beside.viewpoints[0], fixed)
  assert.match(beside.proof, /1 of them stands already\.$/)
  const more = floor.choose(places, { fixed: [fixed], count: 1 })
  assert.deepEqual([more.viewpoints.length, more.viewpoints[0]], [2, fixed])
  floor.close()
})

test('it can be stopped, and says what is wrong', async () => {
  const floor = (await loadCameras()).open(TWO), places = floor.points('grid', 0.5).flatMap(headings(8, { fov: 60, range: 2 }))
  const stopped = floor.choose(places, { count: 3, progress: () => true })
  assert.equal(stopped.stopped, false)
  assert.throws(() => floor.choose(places, { progress: () => false }), /./)
  assert.throws(() => floor.choose([]), /there is no place to choose/)
  assert.throws(() => floor.choose([{ x: 1, y: 1 }], { count: 1, network: true }), /not the most/)
  assert.throws(() => floor.choose([{ x: 1, y: 1 }], { cover: 1.5 }), /cover: a whole number/)
  assert.throws(() => floor.choose([{ x: 1, y: 1 }], { network: 1 }), SightlineError)
  assert.throws(() => floor.choose([{ x: 1 }]), SightlineError)
  assert.throws(() => floor.points('anywhere'), /corners, walls, grid/)
  floor.close()
  assert.throws(() => floor.points('corners'), /closed/)
})
