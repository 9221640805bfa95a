/** Bad maps, hostile files and memory that runs out give errors, and the module stays usable. */
import assert from 'node:assert/strict'
import test from 'node:test'
import { load, maps, nativeBake, random } from './help.js'

const { Level, SightlineError } = await load('sightline.js')
const { bake, load: loadCore } = await load('bake.js')
const core = await loadCore()
const room = { walls: [[0, 0, 9, 0], [9, 0, 9, 9], [9, 9, 0, 9], [0, 9, 0, 0]] }

/** What a call throws. */
function thrown(call) {
  try {
    call()
  } catch (error) {
    assert.ok(error instanceof SightlineError, String(error.stack))
    return error
  }
  assert.fail('nothing was thrown')
}

test('errors name the line or the item', async () => {
  const error = thrown(() => core.bake('sightline 1\nwall 0 0 1'))
  assert.equal(error.line, 2)
  assert.equal(error.code, 'bad input')
  assert.match(error.message, /^map:2: expected 'wall x0 y0 x1 y1/)
  assert.equal(thrown(() => core.bake({ walls: [[0, 0, 1, 0], [0, NaN, 1, 1]] })).item, 'walls[1]')
  assert.equal(thrown(() => core.bake({ ...room, solid: [[0, 0, 1, 1, 2, 2]] })).item, 'solid[0]')
  for (const stops of ['', [], 'light', ['steps', 'steps'], 'steps ', true, 7, {}]) {
    assert.equal(thrown(() => core.bake({ walls: [...room.walls, { segment: [1, 1, 2, 1], stops }] })).item, 'walls[4]')
    assert.equal(thrown(() => core.bake({ ...room, solid: [{ points: [1, 1, 2, 1, 2, 2], stops }] })).item, 'solid[0]')
  }
  await assert.rejects(bake('nothing'), SightlineError)
  for (const call of [
    () => core.bake(room, { method: 'magic' }), () => core.bake(room, { metod: 'dfs' }),
    () => core.bake({ wals: [] }), () => core.bake({ walls: [] }), () => core.bake(null),
    () => core.bake(room, { sight: 'half' }), () => core.bake(room, { mirrorDepth: 17 }),
    () => core.bake({ ...room, doors: [{ name: 'a b', segment: [1, 1, 2, 1] }] }),
    () => core.explain(room, 0, 99), () => core.dual([]),
    () => core.writeMap(room, { format: 'dxf' }),
  ]) thrown(call)
  assert.ok(core.bake(room).length > 0)
})

test('files of other formats are for the command', async () => {
  for (const text of ['<?xml version="1.0"?><map/>', '{"defs":{}}'])
    assert.match(thrown(() => core.bake(text)).message, /bake Tiled files .* with the sightline command\)$/)
  assert.match(thrown(() => core.bake('<map/>', { name: 'level.tmx' })).message, /^[^(]* \(bake Tiled files/)
})

test('calls stop by progress and by a time limit', () => {
  assert.equal(thrown(() => core.bake(room, { progress: () => false })).code, 'interrupted')
  assert.equal(thrown(() => core.bake(room, { timeLimit: 1e-9 })).code, 'interrupted')
  const stages = new Set()
  core.bake(room, { progress: (stage) => void stages.add(stage) })
  assert.ok(stages.has('subdivide'))
})

test('scenes that are closed say so, and views are checked', () => {
  const scene = core.open(room)
  thrown(() => scene.look(1, 1, { heading: NaN }))
  thrown(() => scene.look(1, 1, { range: -1 }))
  thrown(() => scene.look(1, 1, { method: 'magic' }))
  thrown(() => scene.row(99))
  thrown(() => scene.setDoor('none', true))
  scene.close()
  scene.close()
  assert.match(thrown(() => scene.row(0)).message, /closed/)
})

test('broken files are refused or safe', async () => {
  const next = random(5)
  for (const name of ['office.map', 'doors.map', 'chapel.map', 'mirrors.map']) {
    const { bytes } = nativeBake(maps.find((path) => path.endsWith(name)))
    let refused = 0
    for (let i = 0; i < 150; i++) {
      const broken = Uint8Array.from(bytes.subarray(0, i % 3 ? bytes.length : Math.floor(next() * bytes.length)))
      for (let j = 0; j <= i % 4; j++) broken[Math.floor(next() * broken.length)] ^= 1 << Math.floor(next() * 8)
      if (i % 2) repair(broken)
      await Level.open(broken).then((level) => level.look(1, 1), (error) => {
        assert.ok(error instanceof SightlineError, String(error.stack))
        refused++
      })
      try {
        core.open(broken).close()
      } catch (error) {
        assert.ok(error instanceof SightlineError, String(error.stack))
        assert.notEqual(error.code, 'internal')
      }
    }
    assert.ok(refused > 70, `${name}: ${refused}`)
  }
  await assert.rejects(Level.open(new Uint8Array(0)), SightlineError)
  await assert.rejects(Level.open('text'), SightlineError)
  assert.ok(core.bake(room).length > 0)
})

/** Makes the checksum right (CRC-32 at byte 28, counted as 0), so that what lies behind it is read. */
function repair(file) {
  const at = 28
  if (file.length < 32) return
  file.fill(0, at, at + 4)
  let sum = ~0
  for (const byte of file) {
    sum ^= byte
    for (let bit = 0; bit < 8; bit++) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0)
  }
  new DataView(file.buffer).setUint32(at, ~sum >>> 0, true)
}

test('a map of 10^6 walls in little memory gives an error', async () => {
  const small = await loadCore({ memory: 96 * 2 ** 20 })
  const lines = ['sightline 1']
  for (let i = 0; i < 1e6; i++) {
    const x = 2 * (i % 1000), y = 2 * Math.floor(i / 1000)
    lines.push(`wall ${x} ${y} ${x + 1} ${y + (i % 2)}`)
  }
  const error = thrown(() => small.bake(lines.join('\n')))
  assert.equal(error.code, 'out of memory')
  assert.deepEqual(small.bake(room), core.bake(room))
})
