/** Boxes that move: answers are the native ones of the runtime header, to the last bit, and make nothing to be collected. */
import assert from 'node:assert/strict'
import test from 'node:test'
import { setFlagsFromString } from 'node:v8'
import { runInNewContext } from 'node:vm'
import { answers, load, maps, nativeBake, random } from './help.js'

const { Level, SightlineError } = await load('sightline.js')
const { direction } = await load('host.js')
const COUNT = 12

const text = (numbers) => Array.from(numbers, (n) => (Object.is(n, -0) ? '-0' : String(n))).join(' ')
const office = maps.find((path) => path.endsWith('office.map'))

/** A place in a level, now and then one on whole numbers. */
function someplace({ minX, minY, maxX, maxY }, next) {
  const round = next() < 0.5 ? Math.round : (value) => value
  return [round(minX + next() * (maxX - minX)), round(minY + next() * (maxY - minY))]
}

test('past boxes that move, answers are the native ones', async () => {
  const said = { see: [0, 0], walk: [0, 0], boxes: [0, 0] }
  let hidden = 0
  for (const path of maps) {
    const { bytes, path: slv } = nativeBake(path)
    const level = await Level.open(bytes, { boxes: COUNT }), bare = await Level.open(bytes)
    const next = random(path.length), questions = [`b ${COUNT}`], asked = [], got = [], seen = new Uint8Array(COUNT)
    const ask = (question, answer) => {
      questions.push(question)
      asked.push(question)
      got.push(answer)
    }
    assert.equal(level.boxCount, COUNT)
    for (let frame = 0; frame < 4; frame++) {
      for (let box = 0; box < COUNT; box++) {
        const [x, y] = someplace(level.bounds, next), width = Math.round(4 * next()), height = 3 * next()
        const place = [x, y, x + width, y + height], blocks = next() < 0.8
        level.moveBox(box, ...place, blocks)
        questions.push(`bm ${box} ${place.join(' ')} ${+blocks}`)
      }
      for (let i = 0; i < 15; i++) {
        const a = someplace(level.bounds, next), b = someplace(level.bounds, next), box = Math.floor(next() * (COUNT + 1)) - 1
        const see = level.canSee(a, b), walk = level.canWalk(a, b, box < 0 ? undefined : box)
        said.see[+see]++
        said.walk[+walk]++
        ask(`bp ${a.join(' ')} ${b.join(' ')}`, String(+see))
        ask(`bw ${a.join(' ')} ${b.join(' ')} ${box}`, String(+walk))
        const [x, y] = a, heading = Math.floor(360 * next()), fov = [360, 90][i % 2], range = level.range || i % 3 ? 0 : 9
        const options = { heading, fov, range }
        const view = [x, y, +(fov >= 360), ...direction(heading - fov / 2), ...direction(heading + fov / 2), range].join(' ')
        const cells = level.look(x, y, options)
        hidden += bare.look(x, y, options).length - cells.length
        ask(`bk ${view}`, text(cells))
        ask(`bv ${view}`, text(level.visiblePolygon(x, y, options)))
        const count = level.boxesSeenInto(seen, x, y, options)
        assert.equal(count, seen.reduce((sum, one) => sum + one, 0))
        for (const one of seen) said.boxes[one]++
        ask(`bs ${view}`, text(seen))
      }
    }
    answers(slv, questions).forEach((line, i) => {
      const native = asked[i].startsWith('bv') ? text(line ? line.split(' ').map(Number) : []) : line
      assert.equal(got[i], native, `${path}: ${asked[i]}`)
    })
    level.close()
    bare.close()
  }
  for (const [what, [no, yes]] of Object.entries(said)) assert.ok(no > 50 && yes > 50, `${what}: ${no} ${yes}`)
  assert.ok(hidden > 500, String(hidden))
})

test('boxes that lie in very many cells find room, and stay where they are', async () => {
  const { bytes, path } = nativeBake(office), level = await Level.open(bytes, { boxes: 2 })
  const { minX, minY, maxX, maxY } = level.bounds, into = new Float64Array(4000)
  const before = level.visiblePolygonInto(into, 53, 20)
  assert.ok(before > 0)
  level.moveBox(0, 50, 21, 52, 22)
  level.moveBox(1, minX, minY, maxX, maxY, false)    // all cells
  const view = '53 20 1 1 0 1 0 0'
  const [polygon, seen] = answers(path, ['b 2', 'bm 0 50 21 52 22 1', `bm 1 ${minX} ${minY} ${maxX} ${maxY} 0`, `bv ${view}`, `bs ${view}`])
  assert.equal(text(level.visiblePolygon(53, 20)), text(polygon.split(' ').map(Number)))
  const count = level.visiblePolygonInto(into, 53, 20)
  assert.equal(text(into.subarray(0, count)), text(polygon.split(' ').map(Number)))
  const bits = new Uint8Array(2)
  assert.equal(level.boxesSeenInto(bits, { x: 53, y: 20 }), 2)
  assert.equal(text(bits), seen)
  level.moveBox(0, maxX + 5, 0, maxX + 6, 1)         // nowhere
  level.moveBox(1, maxX + 5, 0, maxX + 6, 1)
  assert.equal(level.boxesSeenInto(bits, 53, 20), 0)
  assert.equal(level.visiblePolygonInto(into, 53, 20), before)
})

test('with y down, a box is the same one', async () => {
  const { bytes } = nativeBake(office), own = { origin: [8, 32], scale: 16, yDown: true }
  const level = await Level.open(bytes, { boxes: 1 }), down = await Level.open(bytes, { boxes: 1, transform: own })
  level.moveBox(0, 50, 21, 52, 22)
  down.moveBox(0, 16 * (50 - 8), 16 * (32 - 22), 16 * (52 - 8), 16 * (32 - 21))
  const eye = [16 * (53 - 8), 16 * (32 - 20)], turned = level.visiblePolygon(53, 20)
  for (let i = 0; i < turned.length; i += 2) [turned[i], turned[i + 1]] = [16 * (turned[i] - 8), 16 * (32 - turned[i + 1])]
  assert.deepEqual(down.visiblePolygon(...eye), turned)
})

/** The bytes that one of many calls leaves to be collected, once the compiler is done. */
function left(call) {
  setFlagsFromString('--expose-gc')
  const collect = runInNewContext('gc')
  return Math.min(...Array.from({ length: 6 }, () => {
    collect()
    const before = process.memoryUsage().heapUsed
    for (let i = 0; i < 2000; i++) call(i)
    const grown = process.memoryUsage().heapUsed - before
    return grown < 0 ? Infinity : grown / 2000       // it was collected meanwhile
  }))
}

test('a frame makes nothing to be collected', async () => {
  const level = await Level.open(nativeBake(office).bytes, { boxes: 8 })
  const into = new Float64Array(4000), seen = new Uint8Array(8)
  const calls = {
    move: (i) => level.moveBox(i % 8, 45 + (i % 16), 18, 46 + (i % 16), 18.5),
    polygon: () => level.visiblePolygonInto(into, 53, 20),
    seen: () => level.boxesSeenInto(seen, 53, 20),
  }
  // The engine may box a number, in up to 24 bytes; a list, an object or a view of memory takes more.
  for (const [name, call] of Object.entries(calls)) assert.ok(left(call) <= 24, `${name}: ${left(call)} bytes`)
  assert.ok(left(() => level.visiblePolygon(53, 20)) > 100, 'this one makes a copy')
})

test('arguments that are wrong say so', async () => {
  const { bytes } = nativeBake(office), level = await Level.open(bytes, { boxes: 3 }), bare = await Level.open(bytes)
  for (const [call, message] of [
    [() => level.moveBox(3, 0, 0, 1, 1), /box: a whole number, 0 to 2/], [() => level.moveBox(0, 2, 0, 1, 1), /maxX: a number, 2 or more, is needed, not 1/],
    [() => level.moveBox(0, 0, 0, 1), /maxY: a number/], [() => level.moveBox(0, 0, NaN, 1, 1), /minY: a number/],
    [() => level.moveBox(0, 0, 0, 1, 1, 1), /blocks: true or false/], [() => bare.moveBox(0, 0, 0, 1, 1), /option boxes/],
    [() => level.canWalk([1, 1], [2, 2], 7), /box: a whole number/], [() => bare.canWalk([1, 1], [2, 2], 0), /option boxes/],
    [() => level.boxesSeenInto(new Uint8Array(2), 1, 1), /a byte for each box/], [() => level.boxesSeenInto([], 1, 1), /a Uint8Array/],
  ]) assert.throws(call, (error) => error instanceof SightlineError && message.test(error.message), String(call))
  await assert.rejects(Level.open(bytes, { boxes: -1 }), /boxes: a whole number/)
  await assert.rejects(Level.open(bytes, { boxes: 2 ** 21 }), /boxes: a whole number/)
  assert.throws(() => bare.boxesSeenInto(new Uint8Array(0), 53, 20), /option boxes/)
  level.close()
  assert.throws(() => level.moveBox(0, 0, 0, 1, 1), /closed/)
})
