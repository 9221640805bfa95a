/** The game loop of the README runs as it stands there, on a canvas that keeps what is drawn. */
import assert from 'node:assert/strict'
import { readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import test from 'node:test'
import { pathToFileURL } from 'node:url'
import { folder, load, maps, nativeBake, place } from './help.js'

test('the game loop of the README', async () => {
  const source = readFileSync(join(folder, 'README.md'), 'utf8').match(/```js game\n([^]*?)```/)[1]
  assert.ok(source.trim().split('\n').length <= 40)
  const path = place('game.mjs')
  writeFileSync(path, source.replace("'sightline'", JSON.stringify(pathToFileURL(join(folder, 'sightline.js')).href)))
  const { bytes } = nativeBake(maps.find((map) => map.endsWith('office.map')))

  const fills = []
  let points = []
  const pen = {
    beginPath: () => (points = []), lineTo: (x, y) => points.push([x, y]), closePath() {}, fillRect() {},
    fill() { fills.push({ style: this.fillStyle, points }) },
  }
  const frames = []
  globalThis.requestAnimationFrame = (frame) => frames.push(frame)
  globalThis.fetch = async () => new Response(bytes)
  const keys = new Set(['ArrowRight'])
  const { play } = await import(pathToFileURL(path).href)
  const { level, player, known } = await play({ width: 640, height: 480, getContext: () => pen }, keys, 'office.slv')

  const from = { ...player }
  const seenFirst = known.size
  for (let i = 0; i < 400; i++) frames.shift()()
  assert.ok(player.x > from.x && player.x < level.bounds.maxX, 'a wall stops the player')
  assert.ok(known.size >= seenFirst && seenFirst > 0)
  const last = fills.at(-1)
  assert.equal(last.style, '#ffd')
  assert.equal(last.points.length, level.visiblePolygon(player.x, player.y, { range: 12 }).length / 2)
  for (const [x, y] of last.points) assert.ok(x >= -1e-6 && x <= 640 && y >= -1e-6 && y <= 480)
})

test('types name all that the classes have', async () => {
  const { Level } = await load('sightline.js')
  const { Graph } = await load('graph.js')
  const { Core, Scene } = { ...(await load('bake.js')), ...(await load('scene.js')) }
  const own = ['constructor', 'run', 'ask', 'failure', 'given', 'givenNumbers', 'written', 'writtenText', 'withBytes', 'textAt']
  for (const [type, file] of [[Level, 'sightline.d.ts'], [Core, 'bake.d.ts'], [Scene, 'bake.d.ts'], [Graph, 'graph.d.ts']]) {
    const text = readFileSync(join(folder, file), 'utf8')
    const declared = text.slice(text.indexOf(`class ${type.name} {`))
    for (const name of Object.getOwnPropertyNames(type.prototype))
      if (!own.includes(name)) assert.match(declared, new RegExp(`\\b${name}\\b`), `${file}: ${name}`)
  }
})
