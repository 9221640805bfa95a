/** Walls that break and building sites, and the small game of lib/runtime/examples with them. */
import assert from 'node:assert/strict'
import { writeFileSync } from 'node:fs'
import test from 'node:test'
import { load, maps, nativeBake, place } from './help.js'
import { Game } from '../../../runtime/examples/fort_rules.mjs'

const { Level, SightlineError } = await load('sightline.js')

test('walls break and are built once, and rows settle', async () => {
  const file = place('kinds.map')
  writeFileSync(file, 'sightline 1\nwalls 0 0 9 0 9 9 0 9 0 0\ndoor wall 3 0 3 9 breakable\ndoor site 6 0 6 9 site\n' +
    'door plain 6 3 9 3 shut\n')
  const level = await Level.open(nativeBake(file).bytes)
  assert.deepEqual(level.doors.map(({ kind, open }) => [kind, open]), [['breakable', false], ['site', true], ['door', false]])
  assert.equal(level.walls.length, 4)
  assert.deepEqual(level.walls.flat().reduce((sum, each) => sum + each, 0), 72)
  const left = level.locate(1, 1), middle = level.locate(4, 1), right = level.locate(8, 1)
  const rows = () => [level.canSee(left, middle), level.canSee(middle, right), level.canSee(left, right)]
  assert.ok(level.settle(1) > 0)
  assert.equal(level.settle(), 0)
  assert.deepEqual(rows(), [false, true, false])
  assert.equal(level.setDoor('wall', true), true)
  assert.equal(level.setDoor('wall', false), false)
  assert.ok(level.doors[0].open && level.settle(0) > 0)
  assert.equal(level.settle(), 0)
  assert.deepEqual(rows(), [true, true, true])
  assert.equal(level.setDoor('site', false), true)
  assert.equal(level.setDoor('site', true), false)
  assert.equal(level.settle(), 0)
  assert.deepEqual(rows(), [true, false, false])
  assert.deepEqual([...level.row(middle)].sort(), [...level.row(left)].sort())
  assert.throws(() => level.settle(-1), SightlineError)
  level.close()
  assert.throws(() => level.settle(), /closed/)
  assert.throws(() => level.walls, /closed/)
})

test('a guard sees through a broken wall and not before', async () => {
  const { bytes } = nativeBake(maps.find((path) => path.endsWith('fort.map')))
  const rounds = [[[10, 5], [10, 11]], [[20, 7], [20, 3.5], [22.5, 3.5], [22.5, 7]]]
  const toWall = 'd'.repeat(13), wait = '.'.repeat(420)
  const game = new Game(await Level.open(bytes), rounds)
  game.play(toWall + wait)
  assert.deepEqual(game.events, [])
  game.play(`e${wait}`)
  assert.deepEqual(game.events.map((event) => event.replace(/\d+: /, '')), ['plaster breaks', 'guard 0 sees you'])
  assert.equal(game.events[0], `${toWall.length + wait.length + 1}: plaster breaks`)
  game.play('eee')
  assert.equal(game.events.length, 2)
  const builder = new Game(await Level.open(bytes), rounds)
  builder.play(`aaaaaae${'a'.repeat(40)}`)
  assert.deepEqual(builder.events, ['7: palisade is built'])
  assert.ok(builder.x > 3.3 && builder.x < 3.5)
})
