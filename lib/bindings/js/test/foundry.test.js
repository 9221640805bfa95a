/** The module for Foundry: its answers are those of the command's own reader of the same scene. */
import assert from 'node:assert/strict'
import { cpSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import { pathToFileURL } from 'node:url'
import test from 'node:test'
import { folder, load, nativeBake, place, random, root } from './help.js'
import { mapOf } from '../../foundry/scripts/scene.mjs'
import { Watch } from '../../foundry/scripts/watch.mjs'

const { Level } = await load('sightline.js')
const { bake } = await load('bake.js')
const sightline = { Level, bake }

const edge = { x: 0, y: 0, width: 2000, height: 1500 }
const frame = [[0, 0, 2000, 0], [2000, 0, 2000, 1500], [2000, 1500, 0, 1500], [0, 1500, 0, 0]].map((c) => ({ c }))

/** Walls of all kinds, at random places. */
function wallsOf(next, count) {
  const one = (list) => list[Math.floor(next() * list.length)]
  return Array.from({ length: count }, (_, i) => ({
    _id: `w${i}`, c: [next() * 2000, next() * 1500, next() * 2000, next() * 1500].map(Math.round),
    sight: one([20, 20, 0, 10, 30, 40, undefined]), move: one([20, 0, undefined]), sound: one([20, 0, 10]),
    dir: one([0, 0, 1, 2]), door: one([0, 0, 1, 2]), ds: one([0, 1, 2]),
  }))
}

test('random scenes: sight and steps as the command has them, whatever the walls stop', async () => {
  const next = random(71)
  let seen = 0, walked = 0
  for (let round = 0; round < 25; round++) {
    const walls = [...frame, ...wallsOf(next, 14)]
    writeFileSync(place('scene.json'), JSON.stringify({ name: 'scene', ...edge, padding: 0, walls }))
    const native = await Level.open(nativeBake(place('scene.json'), '--layers', 'walls').bytes, { transform: 'file' })
    const watch = await Watch.of(walls, edge, sightline)
    for (let i = 0; i < 400; i++) {
      const [a, b] = [0, 0].map(() => ({ x: next() * 2000, y: next() * 1500 }))
      assert.equal(watch.sees(a, b), native.canSee(a, b), `round ${round}: ${JSON.stringify([a, b])}`)
      assert.equal(watch.canWalk(a, b), native.canWalk(a, b), `round ${round}: ${JSON.stringify([a, b])}`)
      seen += watch.sees(a, b)
      walked += watch.canWalk(a, b)
    }
    native.close()
    watch.close()
  }
  assert.ok(seen > 1000 && walked > 1000 && seen < 9000 && walked < 9000, `${seen}, ${walked}`)
})

test('doors open without a bake; walls that change their kind ask for one', async () => {
  const door = { _id: 'd', c: [1000, 0, 1000, 1500], door: 1, ds: 0 }
  const watch = await Watch.of([...frame, door], edge, sightline)
  const a = { name: 'A', x: 100, y: 100 }, b = { name: 'B', x: 1900, y: 100 }, c = { name: 'C', x: 100, y: 900 }
  assert.deepEqual(watch.pairs([a, b, c]).map((pair) => pair.map(({ name }) => name).join('')), ['AC', 'CA'])
  assert.equal(watch.update({ ...door, ds: 1 }, { ds: 1 }), true)
  assert.equal(watch.sees(a, b), true)
  assert.equal(watch.update({ ...door, ds: 2 }, { ds: 2 }), true) // locked
  assert.equal(watch.sees(a, b), false)
  assert.equal(watch.update(door, { flags: {} }), true)
  assert.equal(watch.update({ ...door, sight: 0 }, { sight: 0 }), false)
  assert.equal(watch.update({ ...door, sight: 0, ds: 1 }, { ds: 1 }), false) // a window that opens
  watch.close()
})

test('a scene without walls is seen all over, up to its edge', async () => {
  const watch = await Watch.of([], edge, sightline)
  assert.equal(watch.sees({ x: 10, y: 10 }, { x: 1990, y: 1490 }), true)
  assert.equal(watch.polygon({ x: 1000, y: 750 }).length, 8)
  watch.close()
})

test('one-way walls keep their side, and points are left out', () => {
  const map = mapOf([{ _id: 'a', c: [0, 0, 10, 0], dir: 1 }, { _id: 'b', c: [0, 0, 10, 0], dir: 2 }, { _id: 'c', c: [3, 3, 3, 3] }], null)
  assert.deepEqual(map, { walls: [], doors: [], oneway: [[0, -0, 10, -0], [10, -0, 0, -0]], seams: [] })
})

test('what talks to Foundry, against objects that stand in for it', async (context) => {
  const hooks = {}, said = [], controls = [{ name: 'token', tools: [] }]
  const module = {}
  const token = (name, x, y) => ({ name, center: { x, y }, x: x - 50, y: y - 50 })
  let walls = [...frame.map((wall, i) => ({ _id: `f${i}`, ...wall })), { _id: 'd', c: [1000, 0, 1000, 1500], door: 1, ds: 0 }]
  const stand = {
    Hooks: { once: (name, call) => (hooks[name] = call), on: (name, call) => (hooks[name] = call) },
    game: { modules: new Map([['sightline', module]]), user: { id: 'me', isGM: true } },
    canvas: {
      scene: { get walls() { return walls.map((wall) => ({ toObject: () => wall })) } },
      dimensions: { sceneRect: edge }, tokens: { placeables: [token('<A>', 100, 100), token('B', 1900, 100)] },
    },
    ChatMessage: { create: (message) => said.push(message) },
    ui: { notifications: { error: (text) => said.push(text) } },
  }
  Object.assign(globalThis, stand)
  context.after(() => Object.keys(stand).forEach((name) => delete globalThis[name]))
  await moduleFolder()
  hooks.init()
  hooks.getSceneControlButtons(controls)
  const [a, b] = stand.canvas.tokens.placeables, { api } = module
  assert.equal(await api.sees(a, b), false)
  walls = walls.map((wall) => (wall.door ? { ...wall, ds: 1 } : wall))
  await hooks.updateWall({ toObject: () => walls.at(-1) }, { ds: 1 })
  assert.equal(await api.sees(a, b), true)
  assert.deepEqual(await api.watchers(b), [a])
  await controls[0].tools[0].onClick()
  assert.match(said[0].content, /<b>&#60;A&#62;<\/b> sees B/)
  assert.deepEqual(said[0].whisper, ['me'])
  walls = walls.slice(0, 4)
  walls.push({ _id: 'w', c: [1000, 0, 1000, 1500] })
  hooks.createWall()
  assert.equal(await api.sees(a, b), false)
  assert.equal(await api.canWalk(a, { x: 300, y: 300 }), true)
  walls[4] = { _id: 'w', c: [1000, 0, NaN, 1500] }
  hooks.updateWall({ toObject: () => walls[4] }, { c: walls[4].c })
  hooks.canvasReady()
  await controls[0].tools[0].onClick()
  assert.match(said.at(-1), /^Sightline: .*walls/)
})

/** Loads the module as it is installed: its scripts, with the package beside them. */
async function moduleFolder() {
  const to = place('foundry')
  cpSync(join(root, 'lib/bindings/foundry'), to, { recursive: true })
  cpSync(folder, join(to, 'scripts/package'), { recursive: true })
  await import(pathToFileURL(join(to, 'scripts/main.mjs')).href)
}
