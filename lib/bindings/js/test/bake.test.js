/** Bakes and exports are those of the native command, byte for byte. */
import assert from 'node:assert/strict'
import { readFileSync, writeFileSync } from 'node:fs'
import { basename } from 'node:path'
import test from 'node:test'
import { command, house, load, maps, nativeBake, place } from './help.js'

const { bake, check, describe, explain, isovist, query, load: loadCore, mapText } = await load('bake.js')
const core = await loadCore()

test('every map of the project has the native bytes', () => {
  assert.ok(maps.length > 15)
  for (const path of maps) {
    const got = core.bake(readFileSync(path), { name: basename(path) })
    assert.ok(nativeBake(path).bytes.equals(got), path)
  }
})

test('200 generated maps have the native bytes', () => {
  const path = place('generated.map')
  for (let i = 0; i < 200; i++) {
    const kind = ['maze', 'office', 'city', 'pillars', 'tunnels'][i % 5]
    const size = { maze: 5, office: 1, city: 2, pillars: 3, tunnels: 0 }[kind] + (i % 2)
    const small = kind === 'tunnels' ? ['--walls', '100'] : ['--size', String(size)]
    const turned = i % 7 === 3 ? ['--turned', String(i)] : []
    command('generate', kind, ...small, '--seed', String(i), '-o', path, ...turned)
    const options = [[], ['--inside'], ['--method', 'dfs'], ['--sight', 'open']][i % 4]
    const own = [{}, { insideOnly: true }, { method: 'dfs' }, { sight: 'open' }][i % 4]
    const got = core.bake(readFileSync(path), own)
    assert.ok(nativeBake(path, ...options).bytes.equals(got), `${kind} ${i}`)
  }
})

test('options of the map are those of the command', () => {
  const path = place('parts.map')
  const text = `sightline 1
walls 0 0 20 0 20 10 0 10 0 0
wall 10 0 10 4
door front 10 4 10 6 shut
wall 10 6 10 10
wall 14 0 14 5 stops steps
mirror 3 0 6 0
range 50
`
  writeFileSync(path, text)
  const cases = [[{ start: { x: 5, y: 5 } }, ['--start', '5,5']],
    [{ stops: 'steps' }, ['--stops', 'steps']], [{ without: ['door', 'range'] }, ['--without', 'door,range']],
    [{ start: [12, 5], without: ['mirror'], stops: 'sound' }, ['--start', '12,5', '--without', 'mirror', '--stops', 'sound']], [{}, []]]
  const seen = new Set()
  for (const [own, options] of cases) {
    const got = core.bake(text, own)
    assert.ok(nativeBake(path, ...options).bytes.equals(got), options.join(' '))
    seen.add(Buffer.from(got).toString('latin1'))
  }
  assert.equal(seen.size, cases.length)
  assert.throws(() => core.bake(text, { start: [50, 5] }), /start: outside the map/)
  assert.throws(() => core.bake(text, { stops: 'light' }), /stops:/)
  assert.throws(() => core.bake(text, { without: ['doors'] }), /there is no effect 'doors'/)
})

test('describe() is the JSON export, explain() the command', () => {
  for (const path of maps) {
    const { path: slv, bytes } = nativeBake(path)
    const json = place('native.json')
    command('export', slv, '--format', 'json', '-o', json)
    assert.deepEqual(core.describe(bytes), JSON.parse(readFileSync(json, 'utf8')), path)
    const scene = core.open(bytes)
    const cells = Array.from({ length: scene.cellCount }, (_, i) => i).filter((i) => !scene.cell(i).solid)
    for (let i = 0; i < 4; i++) {
      const a = cells[(7 * i) % cells.length], b = cells[(13 * i + cells.length - 1) % cells.length]
      if (/ stops \S*limited/.test(readFileSync(path, 'latin1'))) {
        assert.throws(() => scene.explain(a, b), /limited/)
        continue
      }
      const want = JSON.parse(command('explain', slv, String(a), String(b), '--json'))
      assert.deepEqual(scene.explain(a, b), want, `${path} ${a} ${b}`)
    }
    assert.ok(Buffer.from(bytes).equals(scene.slv()), path)
    scene.close()
  }
})

test('an object is its map text', async () => {
  const map = {
    walls: [[0, 0, 20, 0], [20, 0, 20, 10], [20, 10, 0, 10], [0, 10, 0, 0], [10, 0, 10, 4], [10, 6, 10, 10]],
    doors: [{ name: 'middle', segment: [10, 4, 10, 6], open: false }],
    mirrors: [[19.5, 0.1, 19.5, 9.9]], starts: [{ x: 5, y: 5, heading: 90 }], range: 30,
  }
  const slv = await bake(map)
  assert.deepEqual(slv, await bake(mapText(map)))
  assert.deepEqual((await describe(slv)).doors, [{ name: 'middle', segments: [[10, 4, 10, 6]], open: false }])
  assert.equal((await explain(map, { x: 5, y: 5 }, { x: 15, y: 5 })).seen, false)
  const { area, edges } = await isovist(map, 5, 5)
  assert.equal(area, 100)
  assert.ok(edges.every((edge) => edge === 'wall'))
  const scene = await query(map)
  assert.equal(scene.canSee({ x: 5, y: 5 }, { x: 15, y: 5 }), false)
  scene.setDoor('middle', true)
  assert.equal(scene.canSee({ x: 5, y: 5 }, { x: 15, y: 5 }), true)
  assert.ok(scene.isovist(5, 5).area > 100)
  assert.ok(scene.mirroredParts(15, 5).length > 0)
  assert.equal(scene.wall(0).item.startsWith('walls['), true)
  scene.close()
})

test('walls of an object stop what they say', () => {
  const map = {
    walls: [[0, 0, 20, 0], [20, 0, 20, 10], [20, 10, 0, 10], [0, 10, 0, 0],
      { segment: [10, 0, 10, 4], stops: 'sight' }, { segment: [10, 4, 10, 10], stops: ['steps', 'sound'] }],
    solid: [{ points: [2, 2, 4, 2, 4, 4], stops: 'steps' }, [[6, 2], [8, 2], [8, 4]]], starts: [[5, 5, 0]],
  }
  assert.match(mapText(map), /^wall 10 0 10 4 stops sight\nwall 10 4 10 10 stops steps,sound$/m)
  assert.match(mapText(map), /^solid 2 2 4 2 4 4 stops steps\nsolid 6 2 8 2 8 4$/m)
  const path = place('stops.map')
  writeFileSync(path, mapText(map))
  assert.ok(nativeBake(path).bytes.equals(core.bake(map)))
  const scene = core.open(map)
  assert.equal(scene.canSee([5, 7], [15, 7]), true)
  assert.equal(scene.canSee([5, 1], [15, 1]), false)
  assert.equal(scene.canSee([1, 3], [5, 3]), true)
  scene.close()
})

test('the width of entrances says what is inside', () => {
  const path = place('house.map')
  writeFileSync(path, house)
  for (const [width, area] of [[1, 96], [1.5, 96], [2, 80], [3, 80]]) {
    const got = core.bake(house, { entrance: width })
    assert.ok(nativeBake(path, '--entrance', String(width)).bytes.equals(got), `${width}`)
    assert.deepEqual(core.bake(`${house}entrance 0.5\n`, { entrance: width }), got)
    assert.equal(core.check(house, { entrance: width }).inside, area / 96)
    const object = { walls: [[5, 0, 10, 0], [10, 0, 10, 8], [10, 8, 0, 8], [0, 8, 0, 0], [0, 0, 3, 0], [12, 0, 12, 8]] }
    assert.equal(core.check({ ...object, entrance: width }).inside, area / 96)
  }
  // One bake does not change the next.
  assert.ok(nativeBake(path).bytes.equals(core.bake(house)))
  assert.deepEqual(core.bake(house, { entrance: 0 }), core.bake(house))
  assert.match(core.writeMap(house, { entrance: 2.5 }), /^entrance 2.5$/m)
  assert.equal(mapText({ walls: [], entrance: 2.5 }), 'sightline 1\nentrance 2.5\n')
})

test('check() finds a leak and names its walls', async () => {
  const found = await check({ walls: [[0, 0, 20, 0], [20, 0, 20, 10], [20, 10, 0, 10], [0, 10, 0, 0.25]], starts: [[5, 5]] })
  assert.equal(found.doubt, 'leaks')
  const leak = found.faults.find((fault) => fault.kind === 'leak')
  assert.deepEqual(leak.at, [0, 0, 0, 0.25])
  assert.deepEqual(leak.items, ['walls[0]', 'walls[3]'])
})

test('a stab tree has the cells of the visible set', () => {
  const scene = core.open(readFileSync(maps.find((path) => path.endsWith('office.map'))))
  for (let cell = 0; cell < scene.cellCount; cell += 9) {
    const { nodes, complete } = scene.stabTree(cell)
    assert.ok(complete)
    assert.deepEqual([...new Set(nodes.map((node) => node.cell))].sort((a, b) => a - b), [...scene.row(cell)])
    nodes.forEach((node, i) => assert.ok(i === 0 ? node.parent === -1 : node.parent < i))
  }
  scene.close()
})
