/** Modules in workers answer as they do without. */
import assert from 'node:assert/strict'
import test from 'node:test'
import { load } from './help.js'

const { inWorker, SightlineError } = await load('worker.js')
const { bake } = await load('bake.js')
const { open } = await load('ways.js')
const ring = [[0, 0, 8, 0], [8, 0, 8, 4], [8, 4, 0, 4], [0, 4, 0, 0]]
const hall = { walls: [...ring, [4, 0, 4, 2]], doors: [{ name: 'gap', segment: [4, 2, 4, 3], open: false }] }

test('a bake in a worker has the same bytes, and tells of its progress', async () => {
  const far = await inWorker('bake'), stages = []
  try {
    const slv = await far.bake(hall, { progress: (stage) => stages.push(stage) })
    assert.deepEqual(slv, await bake(hall))
    assert.ok(stages.length > 0)
  } finally {
    far.terminate()
  }
})

test('what is open stays in the worker, and closes', async () => {
  const far = await inWorker('ways'), near = await open(hall)
  try {
    const floor = await far.open(hall)
    assert.deepEqual(await floor.path([1, 1], [7, 1]), near.path([1, 1], [7, 1]))
    await floor.close()
    await assert.rejects(floor.path([1, 1], [7, 1]), { name: 'SightlineError', message: /closed/ })
  } finally {
    far.terminate()
  }
})

test('values of an object are asked for by its name', async () => {
  const far = await inWorker('graph')
  try {
    const graph = await far.graph(hall, { grid: 1 })
    assert.equal((await graph.points()).length, 2 * (await graph.count()))
  } finally {
    far.terminate()
  }
})

test('errors come over with their codes, and the worker goes on', async () => {
  const far = await inWorker('bake')
  try {
    await assert.rejects(far.bake('sightline 1\nwall 0 0 1\n'), { name: 'SightlineError', code: 'bad input', line: 2 })
    await assert.rejects(far.bake({ walls: [[0, 0, 1, NaN]] }), { code: 'bad argument' })
    await assert.rejects(far.nothing(), /there is no 'nothing'/)
    assert.ok((await far.bake(hall)).length > 0)
  } finally {
    far.terminate()
  }
  await assert.rejects(inWorker('core'), SightlineError)
})

test('ending the worker ends those who wait, and calls after it', async () => {
  const far = await inWorker('bake')
  const waiting = far.bake(hall)
  far.terminate()
  await assert.rejects(waiting, { code: 'interrupted' })
  await assert.rejects(far.bake(hall), { code: 'interrupted' })
})
