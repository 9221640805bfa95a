/** Wrong values in place of each argument of each call: a SightlineError, and no answer. */
import assert from 'node:assert/strict'
import test from 'node:test'
import { load } from './help.js'

const { Level, SightlineError } = await load('sightline.js')
const bake = await load('bake.js')
const graph = await load('graph.js')
const core = await bake.load()
const graphs = await graph.load()
const room = {
  walls: [[0, 0, 9, 0], [9, 0, 9, 9], [9, 9, 0, 9], [0, 9, 0, 0], [4, 0, 4, 4], [4, 6, 4, 9]],
  doors: [{ name: 'front', segment: [4, 4, 4, 6] }], starts: [[1, 1]],
}
const slv = core.bake(room)
const level = await Level.open(slv)
const scene = core.open(room)
const points = graphs.graph(room, { grid: 1 })
const cells = level.cellCount

const noObjects = [1, 0, -1, 0.5, NaN, Infinity, true, false, 'x', '', '1', 1n, Symbol('s'), () => 1]
const others = [{}, [], [[]], [1, 2, 3], new Date(), new Map(), Object.create(null), new Uint8Array(2)]
const nothing = [undefined, null]
const noNumbers = [NaN, Infinity, -Infinity, true, false, '1', 'x', '', 1n, Symbol('s'), () => 1, ...others]
const noCounts = [-1, 0.5, 2 ** 53, ...noNumbers]
const noCells = [-1, 0.5, cells, 2 ** 31, 2 ** 32, 2 ** 32 + 1, -(2 ** 32), 1e300, ...noNumbers]
const noFlags = [0, 1, -1, NaN, 'shut', '', 'false', 1n, Symbol('s'), () => 1, ...others]
const noTexts = [0, 1, NaN, true, 1n, Symbol('s'), () => 1, ...others]
const noPoints = [...noObjects.filter((value) => typeof value !== 'number'), ...nothing, {}, [], [1], [1, 2, 3], [1, '2'], [NaN, 1],
  [Infinity, 1], { x: 1 }, { x: '1', y: 1 }, { x: 1, y: null }, { x: 1, y: NaN }, new Map(), Object.create(null)]
const noOptions = [...noObjects, [], [1], new Uint8Array(2), { nonsense: 1 }]
const noView = [{ heading: 1, fov: -1 }, { fov: 60 }, { range: -1 },
  ...noNumbers.flatMap((value) => [{ heading: value }, { heading: 1, fov: value }, { range: value }])]

const show = (value) => {
  try {
    return typeof value === 'object' && value ? JSON.stringify(value) : String(value)
  } catch {
    return typeof value
  }
}

/** Each of the calls with each of the values. */
function refuse(wrong, calls) {
  for (const [name, call] of Object.entries(calls))
    for (const value of wrong)
      assert.throws(() => call(value), (error) => {
        assert.ok(error instanceof SightlineError, `${name} of ${show(value)}: ${error.stack}`)
        assert.ok(error.message.length > 8 && error.code === 'bad argument', `${name} of ${show(value)}: ${error.message}`)
        return true
      }, `${name} of ${show(value)} gives an answer`)
}

async function reject(wrong, calls) {
  for (const [name, call] of Object.entries(calls))
    for (const value of wrong)
      await assert.rejects(async () => call(value), (error) => {
        assert.ok(error instanceof SightlineError, `${name} of ${show(value)}: ${error.stack}`)
        return true
      }, `${name} of ${show(value)} gives an answer`)
}

test('of a level', async () => {
  await reject([...noObjects, ...nothing, ...others], { open: (v) => Level.open(v) })
  refuse([...noNumbers, ...nothing], {
    'locate x': (v) => level.locate(v, 1), 'locate y': (v) => level.locate(1, v),
    'look y': (v) => level.look(1, v), 'polygon y': (v) => level.visiblePolygon(1, v),
    'look x of one': (v) => level.look({ x: v, y: 1 }), 'polygon y of one': (v) => level.visiblePolygon({ x: 1, y: v }),
    box: (v) => level.boxCells(1, 1, v, 9), 'box minX': (v) => level.boxCells(v, 1, 9, 9),
  })
  refuse([...noNumbers, ...nothing].filter((v) => v !== undefined && v !== null), {
    dx: (v) => level.look({ x: 1, y: 1, dx: v, dy: 1 }), dy: (v) => level.look({ x: 1, y: 1, dx: 1, dy: v }),
  })
  refuse([...noNumbers, ...nothing], { 'look x': (v) => level.look(v, 1), 'polygon x': (v) => level.visiblePolygon(v, 1) })
  refuse([...noCells, ...nothing], {
    row: (v) => level.row(v), viewCell: (v) => level.viewCell(v), seenFrom: (v) => level.seenFrom([0, v]),
    canSee: (v) => level.canSee(v, 1), 'canSee b': (v) => level.canSee(0, v),
  })
  refuse([...noObjects, ...nothing, {}, new Map(), [[0]]], { seenFrom: (v) => level.seenFrom(v) })
  refuse([...noFlags, ...nothing], { setDoor: (v) => level.setDoor('front', v) })
  refuse([...noTexts, ...nothing, 'none'], { 'setDoor name': (v) => level.setDoor(v, true) })
  refuse(noPoints, {
    canWalk: (v) => level.canWalk(v, [1, 1]), 'canWalk to': (v) => level.canWalk([1, 1], v),
    'canSee point': (v) => level.canSee(v, [1, 1]), 'canSee to point': (v) => level.canSee([1, 1], v),
  })
  refuse(noOptions, {
    look: (v) => level.look(1, 1, v), polygon: (v) => level.visiblePolygon(1, 1, v), row: (v) => level.row(0, v),
    canSee: (v) => level.canSee(0, 0, v), seenFrom: (v) => level.seenFrom([0], v),
  })
  refuse(noView, {
    look: (v) => level.look(1, 1, v), polygon: (v) => level.visiblePolygon(1, 1, v), eye: (v) => level.look({ x: 1, y: 1, ...v }),
  })
  refuse(noFlags, {
    'look mirrors': (v) => level.look(1, 1, { mirrors: v }), 'row mirrors': (v) => level.row(0, { mirrors: v }),
    'canSee mirrors': (v) => level.canSee(0, 0, { mirrors: v }),
  })
  assert.throws(() => level.boxCells(5, 1, 4, 9), /maxX: a number, 5 or more, is needed, not 4/)
  assert.throws(() => level.look('3', 4), /^SightlineError: x: a number is needed, not '3'$/)
  assert.throws(() => level.look('', 4), /not ''$/)
  assert.equal(level.doors[0].open, true)
})

test('more cells than there are fit', () => {
  const one = level.seenFrom([0]), polygon = level.visiblePolygon(1, 1)
  assert.deepEqual(level.seenFrom(new Array(1e5).fill(0)), one)
  assert.deepEqual(level.seenFrom(new Uint32Array(1e5)), one)
  assert.deepEqual(level.seenFrom([]), new Uint32Array(0))
  assert.deepEqual(level.visiblePolygon(1, 1), polygon)
})

test('null is as good as nothing in options', () => {
  assert.deepEqual(level.look(1, 1, { range: null, heading: null, mirrors: null }), level.look(1, 1))
  assert.deepEqual(level.look({ x: 1, y: 1, range: null }), level.look(1, 1))
  assert.deepEqual(core.bake({ ...room, range: null }, { weld: null, method: undefined }), slv)
  assert.deepEqual(scene.look(1, 1, null), scene.look(1, 1))
})

test('of a scene', () => {
  refuse([...noCells, ...nothing], {
    row: (v) => scene.row(v), mirroredRow: (v) => scene.mirroredRow(v), cell: (v) => scene.cell(v),
    corners: (v) => scene.corners(v), wall: (v) => scene.wall(typeof v === 'number' && v === cells ? 99 : v),
    directed: (v) => scene.directed(typeof v === 'number' && v === cells ? 99 : v), canSee: (v) => scene.canSee(v, 0),
    'canSee b': (v) => scene.canSee(0, v),
  })
  const places = noPoints.concat(noCells.filter((v) => typeof v === 'number'))
  refuse(places, { explain: (v) => scene.explain(v, 0), 'explain b': (v) => scene.explain(0, v), steps: (v) => scene.steps(v),
    stabTree: (v) => scene.stabTree(v) })
  refuse(noPoints, { canSee: (v) => scene.canSee(v, [1, 1]), 'canSee to': (v) => scene.canSee([1, 1], v) })
  refuse([...noNumbers, ...nothing], {
    locate: (v) => scene.locate(v, 1), look: (v) => scene.look(v, 1), 'look y': (v) => scene.look(1, v),
    polygon: (v) => scene.visiblePolygon(v, 1), isovist: (v) => scene.isovist(1, v), parts: (v) => scene.mirroredParts(v, 1),
  })
  refuse([...noFlags, ...nothing], { setDoor: (v) => scene.setDoor('front', v) })
  refuse([...noTexts, ...nothing, 'none'], { 'setDoor name': (v) => scene.setDoor(v, true), export: (v) => scene.export(v) })
  refuse([...noView, ...noOptions], {
    look: (v) => scene.look(1, 1, v), polygon: (v) => scene.visiblePolygon(1, 1, v), isovist: (v) => scene.isovist(1, 1, v),
    parts: (v) => scene.mirroredParts(1, 1, v),
  })
  refuse(noOptions, { explain: (v) => scene.explain(0, 1, v), steps: (v) => scene.steps(0, v), stabTree: (v) => scene.stabTree(0, v),
    canSee: (v) => scene.canSee([1, 1], [2, 2], v), export: (v) => scene.export('json', v) })
  refuse([-1, ...noNumbers], { tolerance: (v) => scene.visiblePolygon(1, 1, { tolerance: v }),
    isovist: (v) => scene.isovist(1, 1, { tolerance: v }), range: (v) => scene.canSee([1, 1], [2, 2], { range: v }) })
  refuse(noCounts, { depth: (v) => scene.mirroredParts(1, 1, { depth: v }), misses: (v) => scene.explain(0, 1, { misses: v }),
    mirrorDepth: (v) => scene.explain(0, 1, { mirrorDepth: v }), steps: (v) => scene.steps(0, { most: v }),
    version: (v) => scene.export('json', { version: v }) })
  refuse(noFlags, { mirrored: (v) => scene.look(1, 1, { mirrored: v }) })
  refuse(noTexts, { method: (v) => scene.look(1, 1, { method: v }) })
  assert.equal(scene.doors[0].open, true)
})

test('of a bake', async () => {
  const maps = [...noObjects.filter((v) => typeof v !== 'string'), ...nothing, [], [[0, 0, 1, 1]], { walls: 5 }, { walls: 'abcd' },
    { walls: {} }, { walls: [null] }, { walls: [5] }, { walls: ['0 0 1 1'] }, { walls: [[0, 0, 1]] }, { walls: [['0', 0, 1, 1]] },
    ...[NaN, '5', true, Infinity, [5]].map((range) => ({ ...room, range })),
    ...[NaN, '5', true, Infinity, [5]].map((entrance) => ({ ...room, entrance })), { ...room, starts: [null] }, { ...room, starts: [{ x: 1 }] },
    { ...room, doors: [{ name: 5, segment: [1, 1, 2, 1] }] }, { ...room, doors: { front: true } }]
  refuse(maps, { bake: (v) => core.bake(v), open: (v) => core.open(v), check: (v) => core.check(v), text: (v) => core.writeMap(v) })
  refuse(maps.slice(14), { mapText: (v) => bake.mapText(v) })
  refuse(noFlags, {
    'door of a map': (v) => core.bake({ ...room, doors: [{ name: 'a', segment: [1, 1, 2, 1], open: v }] }),
    'mirror of a map': (v) => core.bake({ ...room, mirrors: [{ segment: [1, 1, 2, 1], oneSided: v }] }),
    'wall of a map': (v) => core.bake({ walls: [...room.walls, { segment: [1, 1, 2, 1], solid: v }] }),
    insideOnly: (v) => core.bake(room, { insideOnly: v }), stabTrees: (v) => core.bake(room, { stabTrees: v }),
    check: (v) => core.bake(room, { check: v }),
  })
  refuse([-1, ...noNumbers], { weld: (v) => core.bake(room, { weld: v }), gap: (v) => core.check(room, { gap: v }),
    thin: (v) => core.check(room, { thin: v }), entrance: (v) => core.bake(room, { entrance: v }),
    timeLimit: (v) => core.bake(room, { timeLimit: v }) })
  refuse([1e200, 1e-200], { entrance: (v) => core.bake(room, { entrance: v }), graph: (v) => graphs.graph(room, { grid: 1, entrance: v }) })
  refuse(noCounts, { mirrorDepth: (v) => core.bake(room, { mirrorDepth: v }), doorLimit: (v) => core.bake(room, { doorLimit: v }),
    samples: (v) => core.bake(room, { method: 'sampling', samples: v }), seed: (v) => core.bake(room, { method: 'sampling', seed: v }),
    cutting: (v) => core.dual([[0, 1, 0, 0]], { cutting: v }) })
  refuse(noTexts, { method: (v) => core.bake(room, { method: v }), subdivide: (v) => core.bake(room, { subdivide: v }),
    sight: (v) => core.bake(room, { sight: v }), name: (v) => core.bake(room, { name: v }), named: (v) => core.open(slv, { name: v }),
    format: (v) => core.writeMap(room, { format: v }) })
  refuse([1, true, 'x', {}, []], { progress: (v) => core.bake(room, { progress: v }) })
  refuse(noOptions, { bake: (v) => core.bake(room, v), open: (v) => core.open(room, v), check: (v) => core.check(room, v),
    describe: (v) => core.describe(room, v), explain: (v) => core.explain(room, 0, 1, v), isovist: (v) => core.isovist(room, 1, 1, v),
    text: (v) => core.writeMap(room, v), dual: (v) => core.dual([[0, 1, 0, 0]], v) })
  refuse([...noObjects, ...nothing, ...others, [[1, 2, 3], [4, 5, 6, 7, 8]], [[1, 2, 3, NaN]], [[1, 2, 3, '4']], [null]], {
    dual: (v) => core.dual(v), conflict: (v) => core.conflict(v) })
  refuse([...noObjects, ...nothing, {}], { eye: (v) => core.eye(v, 1, 1), stabTree: (v) => core.stabTree(v, 0) })
  const memories = noNumbers.map((memory) => ({ memory }))
  await reject([...noOptions, ...memories], { load: bake.load, graphs: graph.load })
  await reject(noOptions, { bake: (v) => bake.bake(room, v), query: (v) => bake.query(room, v), check: (v) => bake.check(room, v) })
  assert.deepEqual(core.bake(room), slv)
})

test('of a graph', async () => {
  refuse([0, -1, ...noNumbers, ...nothing], { grid: (v) => graphs.graph(room, { grid: v }) })
  refuse([-1, ...noNumbers], { range: (v) => graphs.graph(room, { grid: 1, range: v }),
    entrance: (v) => graphs.graph(room, { grid: 1, entrance: v }), timeLimit: (v) => graphs.graph(room, { grid: 1, timeLimit: v }) })
  refuse(noCounts, { most: (v) => graphs.graph(room, { grid: 1, most: v }) })
  refuse([...noNumbers, ...nothing], { find: (v) => points.find(v, 1), depth: (v) => points.depth(1, v) })
  refuse([...noTexts, 'none'], { depth: (v) => points.depth(1, 1, v) })
  refuse([...noTexts, ...nothing, 'none'], { values: (v) => points.values(v), measures: (v) => graphs.graph(room, { grid: 1, measures: [v] }) })
  refuse([...noObjects, {}, new Map()], { measures: (v) => graphs.graph(room, { grid: 1, measures: v }) })
  refuse([...noObjects, [1], { none: true }], { doors: (v) => graphs.graph(room, { grid: 1, doors: v }) })
  refuse([...noFlags, ...nothing], { door: (v) => graphs.graph(room, { grid: 1, doors: { front: v } }) })
  refuse([points.count, ...noCounts, ...nothing, 2 ** 32], { sees: (v) => points.sees(v, 0), 'sees b': (v) => points.sees(0, v) })
  refuse(noOptions, { graph: (v) => graphs.graph(room, v), values: (v) => points.values('connectivity', v) })
  refuse(nothing, { graph: (v) => graphs.graph(room, v), map: (v) => graphs.graph(v, { grid: 1 }) })
})

test('of what is closed', async () => {
  const closed = await Level.open(slv), shut = core.open(room), gone = graphs.graph(room, { grid: 1 })
  for (const each of [closed, shut, gone]) each.close(), each.close()
  const calls = {
    locate: () => closed.locate(1, 1), canSee: () => closed.canSee(0, 0), points: () => closed.canSee([1, 1], [2, 2]), walk: () => closed.canWalk([1, 1], [2, 2]),
    look: () => closed.look(1, 1), polygon: () => closed.visiblePolygon(1, 1), row: () => closed.row(0), seenFrom: () => closed.seenFrom([0]),
    box: () => closed.boxCells(0, 0, 1, 1), viewCell: () => closed.viewCell(0), doors: () => closed.doors, setDoor: () => closed.setDoor('front', true),
    cells: () => closed.cells, 'scene row': () => shut.row(0), 'scene look': () => shut.look(1, 1), 'scene vertices': () => shut.vertices,
    'scene corners': () => shut.corners(0), 'scene slv': () => shut.slv(), 'scene export': () => shut.export('json'), 'scene doors': () => shut.doors,
    'scene wall': () => shut.wall(0), 'scene account': () => shut.account, 'scene setDoor': () => shut.setDoor('front', true),
    'scene explain': () => shut.explain(0, 1), 'scene steps': () => shut.steps(0), 'scene locate': () => shut.locate(1, 1),
    values: () => gone.values('connectivity'), find: () => gone.find(1, 1), depth: () => gone.depth(1, 1), sees: () => gone.sees(0, 1),
  }
  refuse([undefined], calls)
  for (const call of Object.values(calls)) assert.throws(call, /closed/)
})
