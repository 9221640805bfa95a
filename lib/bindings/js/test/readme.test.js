/** The game loop of the README runs as it stands there, on a canvas that keeps what is drawn. */
import assert from 'node:assert/strict'
import { readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import test from 'node:test'
import { pathToFileURL } from 'node:url'
import { folder, load, maps, nativeBake, place } from './help.js'

test('the game loop of the README', async () => {
  const source = readFileSync(join(folder, 'README.md'), 'utf8').match(/```js game\n([^]*?)```/)[1]
  assert.ok(source.trim().split('\n').length <= 45)
  const path = place('game.mjs')
  writeFileSync(path, source.replace("'sightline'", JSON.stringify(pathToFileURL(join(folder, 'sightline.js')).href)))
  const { bytes } = nativeBake(maps.find((map) => map.endsWith('office.map')))

  const fills = [], shown = []
  const penOf = (on) => {
    let points = []
    return {
      beginPath: () => (points = []), lineTo: (x, y) => points.push([x, y]), fillRect() {},
      canvas: on, drawImage: (from) => shown.push(from),
      fill() { fills.push({ on, style: this.fillStyle, points }) },
    }
  }
  const fog = {}
  globalThis.OffscreenCanvas = function (...size) {
    return Object.assign(fog, { size, getContext: () => penOf(fog) })
  }
  const frames = []
  globalThis.requestAnimationFrame = (frame) => frames.push(frame)
  globalThis.fetch = async () => new Response(bytes)
  const keys = new Set(['ArrowRight'])
  const { play } = await import(pathToFileURL(path).href)
  const canvas = { width: 640, height: 480, getContext: () => penOf('canvas') }
  const { level, player } = await play(canvas, keys, 'office.slv')
  assert.deepEqual(fog.size, [640, 480])

  const from = { ...player }
  for (let i = 0; i < 400; i++) {
    const before = { ...player }
    frames.shift()(1000 + 1000 * i)                     // slow frames: a step is 0.6 long at most
    assert.ok(player.x - before.x <= 0.6 + 1e-9 && level.canWalk(before, player))
  }
  assert.ok(player.x > from.x && player.x < level.bounds.maxX, 'a wall stops the player')
  const [remembered, seen, figure] = fills.slice(-3)
  assert.deepEqual([remembered.on, seen.on, figure.on], [fog, 'canvas', 'canvas'])
  assert.deepEqual([remembered.style, seen.style, figure.style], ['#333', '#ffd', '#c33'])
  assert.deepEqual(remembered.points, seen.points)
  assert.equal(shown.length, 400)
  assert.equal(shown[0], fog)
  assert.equal(seen.points.length, level.visiblePolygon(player.x, player.y, { range: 12 }).length / 2)
  for (const [x, y] of seen.points) assert.ok(x >= -1e-6 && x <= 640 && y >= -1e-6 && y <= 480)
})

test('modules have all that their types export', async () => {
  const { exports } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'))
  for (const { types, default: file } of Object.values(exports).filter((each) => each.types)) {
    const text = readFileSync(join(folder, types), 'utf8')
    const names = [...text.matchAll(/^export (?:class|function) (\w+)/gm)].map((found) => found[1])
    assert.ok(names.length > 0, types)
    const module = await load(file.slice(2))
    for (const name of names) assert.equal(typeof module[name], 'function', `${file}: ${name}`)
  }
})

test('types name all that the classes have', async () => {
  const { Level } = await load('sightline.js')
  const { Graph } = await load('graph.js')
  const { World } = await load('world.js')
  const { Explored } = await load('explored.js')
  const { Core, Scene } = { ...(await load('bake.js')), ...(await load('scene.js')) }
  const own = ['constructor', 'run', 'ask', 'failure', 'given', 'givenNumbers', 'written', 'writtenText', 'withBytes', 'textAt']
  for (const [type, file] of [[Level, 'sightline.d.ts'], [Core, 'bake.d.ts'], [Scene, 'bake.d.ts'], [Graph, 'graph.d.ts'], [World, 'world.d.ts'], [Explored, 'explored.d.ts']]) {
    const text = readFileSync(join(folder, file), 'utf8')
    const declared = text.slice(text.indexOf(`class ${type.name} {`))
    for (const name of Object.getOwnPropertyNames(type.prototype))
      if (!own.includes(name)) assert.match(declared, new RegExp(`\\b${name}\\b`), `${file}: ${name}`)
  }
})
