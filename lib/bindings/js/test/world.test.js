/** Worlds: after each edit, answers are those of a map that is opened anew. */
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import test from 'node:test'
import { load, random, root } from './help.js'

const { load: loadWorld, open, SightlineError } = await load('world.js')
const { load: loadBake } = await load('bake.js')
const core = await loadWorld(), bakes = await loadBake()

const room = 'sightline 1\nwalls 0 0 8 0 8 4 0 4 0 0\ndoor gap 4 2 4 4 shut\n'
const bounds = { minX: -1, minY: -1, maxX: 9, maxY: 5 }

/** The walls of a world as a map. */
const mapOf = (world) => {
  const of = (kind) => world.walls.filter((wall) => wall.kind === kind)
  return {
    walls: of('wall').map(({ segment }) => segment), oneway: of('oneway').map(({ segment }) => segment),
    doors: of('door').map(({ number, segment, open }) => ({ name: `d${number}`, segment, open })),
  }
}

test('walls are added, moved and removed, and doors open', () => {
  const world = core.open(room)
  assert.deepEqual(world.walls.map(({ number, kind }) => [number, kind]),
    [[0, 'wall'], [1, 'wall'], [2, 'wall'], [3, 'wall'], [4, 'door']])
  assert.deepEqual(world.wall(4), { number: 4, kind: 'door', segment: [4, 2, 4, 4], open: false, name: 'gap' })
  assert.equal(world.canSee([1, 1], [7, 1]), true)
  const wall = world.add([4, 0, 4, 2])
  assert.equal(world.canSee([1, 1], [7, 1]), true) // not before the commit
  const { gone, came } = world.commit()
  assert.ok(gone.length && came.length && came.every((cell) => world.cell(cell).length >= 6))
  assert.equal(world.canSee([1, 1], [7, 1]), false)
  assert.equal(area(world.visiblePolygon(1, 1)), 16)
  world.setOpen(4, true)
  world.commit()
  assert.equal(world.canSee([1, 3], { x: 7, y: 3 }), true)
  world.move(wall, [4, 2, 4, 4])
  world.commit()
  assert.deepEqual(world.wall(wall), { number: wall, kind: 'wall', segment: [4, 2, 4, 4] })
  assert.deepEqual([world.canSee([1, 1], [7, 1]), world.canSee([1, 3], [7, 3])], [true, false])
  world.remove(wall)
  world.discard()
  assert.equal(world.commit().came.length, 0)
  world.remove(wall)
  world.commit()
  assert.equal(world.wall(wall), null)
  assert.equal(world.canSee([1, 3], [7, 3]), true)
  world.close()
  assert.throws(() => world.canSee([1, 1], [2, 2]), /closed/)
})

test('glass, seams and solid ground are edits, too', () => {
  const world = core.open({ walls: [[0, 0, 8, 0], [8, 0, 8, 4], [8, 4, 0, 4], [0, 4, 0, 0]] })
  const glass = world.add([4, 0, 4, 4], { kind: 'oneway' }) // going up: seen through to the left
  world.commit()
  assert.deepEqual([world.canSee([7, 2], [1, 2]), world.canSee([1, 2], [7, 2])], [true, false])
  world.remove(glass)
  const pond = world.add([4, 0, 4, 4], { stops: ['steps'] })
  world.commit()
  assert.deepEqual(world.wall(pond).stops, ['steps'])
  assert.equal(world.canSee([1, 2], [7, 2]), true)
  const block = world.addSolid([[3, 1], [5, 1], [5, 3], [3, 3]])
  world.commit()
  assert.equal(block.length, 4)
  assert.equal(world.canSee([1, 2], [7, 2]), false)
  assert.ok(world.undo())
  assert.equal(world.canSee([1, 2], [7, 2]), true)
  world.close()
})

test('mirrors and limited walls are edits, too', () => {
  const walls = [[0, 0, 8, 0], [8, 0, 8, 4], [8, 4, 0, 4], [0, 4, 0, 0]]
  const world = core.open({ walls, mirrors: [[0, 1, 0, 3]] })
  assert.deepEqual(world.wall(4), { number: 4, kind: 'mirror', segment: [0, 1, 0, 3], oneSided: false })
  const scene = bakes.open({ walls, mirrors: [[0, 1, 0, 3]] }, { subdivide: 'mesh' })
  const [seen] = world.mirroredPolygons(2, 2), [part] = scene.mirroredParts(2, 2)
  assert.deepEqual([seen.wall, seen.depth], [4, 1])
  assert.equal(area(seen.polygon).toFixed(9), area(part.polygon).toFixed(9))
  scene.close()
  world.remove(4)
  world.commit()
  assert.deepEqual(world.mirroredPolygons(2, 2), [])
  assert.ok(world.undo())
  assert.equal(area(world.mirroredPolygons(2, 2)[0].polygon), area(seen.polygon))
  const mirror = world.add([4, 0, 4, 4], { kind: 'mirror', oneSided: true }) // going up: it reflects to the west
  world.commit()
  assert.deepEqual(world.mirroredPolygons(2, 2).map(({ wall }) => wall).sort(), [4, mirror])
  assert.deepEqual(world.mirroredPolygons(6, 2), [])
  assert.equal(world.wall(mirror).oneSided, true)
  assert.ok(world.mirroredPolygons(2, 2, { depth: 2 }).some(({ depth }) => depth === 2))
  world.remove(mirror)
  const low = [3, 5].map((x) => world.add([x, 0, x, 4], { stops: ['limited'] }))
  world.commit()
  assert.deepEqual([world.canSee([1, 2], [7, 2]), world.canSee([1, 2], [4, 2])], [false, true])
  assert.throws(() => world.mirroredPolygons(2, 2), /limit/)
  world.remove(low[0])
  world.commit()
  assert.equal(world.canSee([1, 2], [7, 2]), true)
  world.close()
})

test('undo brings walls back with their numbers, commit by commit', () => {
  const world = core.open(room, { bounds }), at = [JSON.stringify(world.walls)], next = random(3)
  for (let i = 0; i < 40; i++) {
    for (let k = 0; k < 3; k++) {
      const there = world.walls, { number, kind } = there[Math.floor(next() * there.length)] ?? {}
      const to = [8 * next(), 4 * next(), 8 * next(), 4 * next()], what = next()
      try {
        if (what < 0.4 || !there.length) world.add(to, { kind: next() < 0.7 ? 'wall' : 'door', name: `n${i}` })
        else if (what < 0.6) world.remove(number)
        else if (what < 0.7) world.remove(world.add(to))
        else if (kind === 'door') world.setOpen(number, next() < 0.5)
        else world.move(number, to)
      } catch (error) {
        assert.match(error.message, /there is no wall/) // removed by an edit before
      }
    }
    world.commit()
    at.push(JSON.stringify(world.walls))
  }
  for (let i = 40; i > 0; i--) {
    assert.equal(JSON.stringify(world.walls), at[i], `after ${i}`)
    assert.ok(world.undo())
  }
  assert.equal(JSON.stringify(world.walls), at[0])
  assert.equal(world.undo(), null)
  world.close()
})

test('after random edits, answers are those of a map that is opened anew', () => {
  for (const seed of [1, 2]) {
    const next = random(seed), world = core.open(room, { bounds, rows: seed === 1 ? 'now' : 'later' })
    const number = () => (seed === 1 ? Math.round(8 * next()) : 8 * next()) // touching, collinear, covering
    for (let i = 0; i < 25; i++) {
      const there = world.walls.filter(({ number: wall }) => wall > 4), { number: wall } = there[Math.floor(next() * there.length)] ?? {}
      const to = [number(), number() / 2, number(), number() / 2]
      if (to[0] === to[2] && to[1] === to[3]) continue
      if (!there.length || next() < 0.5) world.add(to)
      else if (next() < 0.5) world.move(wall, to)
      else world.remove(wall)
      world.commit()
      const fresh = bakes.open(mapOf(world), { subdivide: 'mesh' })
      for (let k = 0; k < 30; k++) {
        const [a, b] = [0, 1].map(() => [0.01 + 7.98 * next(), 0.01 + 3.98 * next()])
        assert.equal(world.canSee(a, b), fresh.canSee(a, b), `${a} ${b}`)
        if (world.canSee(a, b)) assert.ok(world.row(world.locate(...a)).includes(world.locate(...b)))
      }
      assert.deepEqual(area(world.visiblePolygon(1.37, 1.21)).toFixed(9), area(fresh.visiblePolygon(1.37, 1.21)).toFixed(9))
      fresh.close()
      assert.equal(world.settle(), 0)
    }
    world.close()
  }
})

function area(p) {
  let sum = 0
  for (let i = 0, n = p.length; i < n; i += 2) sum += (p[i] * p[(i + 3) % n] - p[(i + 2) % n] * p[i + 1]) / 2
  return sum
}

test('what cannot be is refused with its reason, and the world stays as it was', async () => {
  const world = core.open('sightline 1\nwalls 0 0 8 0 8 4 0 4 0 0\nsolid 2 1 4 1 4 3 2 3\n')
  for (const [call, message] of [
    [() => world.add([0, 0, 1]), /four numbers/], [() => world.add([1, 1, 1, 1]), /no length/], [() => world.add([1, 1, 99, 1]), /bounds/],
    [() => world.add([1, 1, 2, 1], { kind: 'hedge' }), /wall, door, oneway, seam/], [() => world.remove(99), /no wall 99/],
    [() => world.remove(-1), /a whole number/], [() => world.move(0, [0, 0, NaN, 1]), /a number/], [() => world.setOpen(0, true), /no door/],
    [() => world.add([1, 1, 2, 1], { stops: ['light'] }), /sight, steps, sound/], [() => world.row(0), /visible sets|row|cell/],
    [() => world.addSolid([[1, 1], [2, 2]]), /./], [() => core.open(room, { rows: 'soon' }), /none, now, later/],
    [() => core.open('sightline 1\nwall 0 0 1 0\ncell 0 0 1 0 1 1\n'), /cells/],
    [() => world.add([1, 1, 2, 1], { stops: ['sight', 'limited'] }), /limits/], [() => world.mirroredPolygons(1, 1, { depth: 99 }), /depth/],
    [() => world.add([1, 1, 2, 1], { kind: 'mirror', oneSided: 1 }), /oneSided/],
  ]) assert.throws(call, (error) => error instanceof SightlineError && message.test(error.message), String(message))
  world.commit()
  assert.equal(world.walls.length, 8)
  world.remove(5)
  world.commit()
  assert.throws(() => world.undo(), /solid ground/)
  assert.equal(world.walls.length, 7)
  world.close()
  const office = await open(readFileSync(join(root, 'maps/office.map'), 'utf8'))
  assert.ok(office.cellCount > 50 && office.visiblePolygon(...office.cell(office.locate(10, 10)).slice(0, 2)).length >= 0)
  office.close()
  await assert.rejects(open('nonsense'), SightlineError)
})
