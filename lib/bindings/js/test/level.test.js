/** A level answers as the runtime header and the library do in native code, to the last bit. */
import assert from 'node:assert/strict'
import { writeFileSync } from 'node:fs'
import { basename } from 'node:path'
import test from 'node:test'
import { answers, load, maps, nativeBake, place, random } from './help.js'

const { Level, SightlineError } = await load('sightline.js')
const { direction } = await load('host.js')

/** Points of a level: anywhere, on a grid, on corners, and on sides of cells. */
function points(level, next, count) {
  const { minX, minY, maxX, maxY } = level.bounds
  return Array.from({ length: count }, (_, i) => {
    const x = minX + next() * (maxX - minX), y = minY + next() * (maxY - minY)
    const { corners } = level.cells[Math.floor(next() * level.cellCount)]
    const corner = 2 * Math.floor((next() * corners.length) / 2)
    const after = (corner + 2) % corners.length
    if (i % 4 === 1) return { x: Math.round(x), y: Math.round(y) }
    if (i % 4 === 2) return { x: corners[corner], y: corners[corner + 1] }
    if (i % 4 === 3) return { x: (corners[corner] + corners[after]) / 2, y: (corners[corner + 1] + corners[after + 1]) / 2 }
    return { x, y }
  })
}

const text = (numbers) => Array.from(numbers, (n) => (Object.is(n, -0) ? '-0' : String(n))).join(' ')

test('answers are the native ones', async () => {
  let asked = 0
  const sees = [0, 0]
  const mirrored = []
  let byMirror = 0
  for (const path of maps) {
    const { bytes, path: slv } = nativeBake(path)
    const level = await Level.open(bytes)
    const next = random(basename(path).length)
    level.mirrors === 'none' || mirrored.push(basename(path))
    const questions = [], got = []
    const ask = (question, answer) => {
      questions.push(question)
      got.push(answer)
    }
    ask('m', String(['none', 'baked', 'not baked'].indexOf(level.mirrors)))
    for (let turn = 0; turn < 3; turn++) {
      const places = points(level, next, 60)
      for (const { x, y } of places) {
        ask(`l ${x} ${y}`, String(level.locate(x, y)))
        const b = places[Math.floor(next() * places.length)]
        const seen = +level.canSee({ x, y }, b)
        sees[seen]++
        ask(`p ${x} ${y} ${b.x} ${b.y}`, String(seen))
        const from = Math.floor(next() * level.cellCount), to = Math.floor(next() * level.cellCount)
        ask(`c ${from} ${to}`, String(+level.canSee(from, to)))
        ask(`C ${from} ${to}`, String(+level.canSee(from, to, { mirrors: true })))
        ask(`s ${from} ${to}`, text(level.seenFrom([from, to])))
        ask(`S ${from} ${to}`, text(level.seenFrom([from, to], { mirrors: true })))
        const angle = Math.floor(next() * 360), width = [360, 45, 90, 270][Math.floor(next() * 4)]
        const range = level.range || next() < 0.5 ? 0 : 7
        const options = { heading: angle, fov: width, range }
        const view = [x, y, +(width >= 360), ...direction(angle - width / 2), ...direction(angle + width / 2), range].join(' ')
        ask(`k ${view}`, text(level.look(x, y, options)))
        const both = level.look(x, y, { ...options, mirrors: true })
        ask(`K ${view}`, text([both.direct, ...both]))
        byMirror += both.length - both.direct
        ask(`v ${view}`, text(level.visiblePolygon(x, y, options)))
      }
      level.doors.forEach((door, i) => {
        const open = next() < 0.5
        level.setDoor(door.name, open)
        questions.push(`d ${i} ${+!open}`)
      })
      // Doors of one name go together.
      level.doors.forEach((door, i) => questions.push(`d ${i} ${+!door.open}`))
    }
    const want = answers(slv, questions)
    assert.equal(want.length, got.length)
    const asking = questions.filter((question) => question[0] !== 'd')
    want.forEach((line, i) => {
      const native = asking[i][0] === 'v' ? text(line ? line.split(' ').map(Number) : []) : line
      assert.equal(got[i], native, `${path}: ${asking[i]}`)
    })
    asked += want.length
    level.close()
  }
  assert.ok(asked > 10000)
  assert.ok(mirrored.includes('mirrors.map') && byMirror > 500, `${mirrored} ${byMirror}`)
  assert.ok(sees[0] > 500 && sees[1] > 500, String(sees))
})

test('a polygon into an array of the caller is the same, and is whole or not there', async () => {
  const into = new Float64Array(20000), own = { origin: [3, 7], scale: 16, yDown: true }
  for (const path of maps)
    for (const transform of [undefined, own]) {
      const level = await Level.open(nativeBake(path).bytes, { transform }), next = random(basename(path).length)
      for (const { x, y } of points(level, next, 24))
        for (const view of [undefined, { heading: 360 * next(), fov: 70, range: 9 }]) {
          const wanted = level.visiblePolygon(x, y, view)
          into.fill(-1)
          assert.equal(level.visiblePolygonInto(into, x, y, view), wanted.length)
          assert.equal(text(into.subarray(0, wanted.length)), text(wanted), `${path} ${x} ${y}`)
          assert.equal(into[wanted.length], -1)
          const short = new Float64Array(Math.max(wanted.length - 1, 0)).fill(-1)
          assert.equal(level.visiblePolygonInto(short, x, y, view), wanted.length)
          assert.ok(!wanted.length || short.every((value) => value === -1))
        }
      for (const wrong of [undefined, null, [], new Float32Array(9)])
        assert.throws(() => level.visiblePolygonInto(wrong, 1, 1), SightlineError)
      level.close()
    }
})

test('a level tells its cells, doors and starts', async () => {
  const { bytes } = nativeBake(maps.find((path) => path.endsWith('doors.map')))
  const level = await Level.open(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length))
  assert.equal(level.cells.length, level.cellCount)
  assert.ok(level.doors.some((door) => !door.open))
  const { name } = level.doors[0]
  level.setDoor(name, false)
  assert.equal(level.doors[0].open, false)
  assert.throws(() => level.setDoor('no such door', true), SightlineError)
  for (const cell of level.cells) for (const portal of cell.portals) assert.ok(portal.cell < level.cellCount)
  assert.ok(level.starts.length > 0)
  assert.equal(level.locate(1e6, 0), -1)
  assert.ok(level.row(0).includes(0))
  level.close()
  assert.throws(() => level.locate(0, 0), /closed/)
})

/** A hall with a thin wall and a shut door in it, at x = 4. */
async function hall() {
  const path = place('hall.map')
  writeFileSync(path, 'sightline 1\nwalls 0 0 8 0 8 4 0 4 0 0\nwall 4 0 4 1\nwall 4 3 4 4\ndoor front 4 1 4 3 shut\n')
  return Level.open(nativeBake(path).bytes)
}

test('whole steps go through no shut door and no wall', async () => {
  const level = await hall()
  const walk = (y, by) => {
    let x = by > 0 ? 1 : 7
    for (let i = 0; i < 6; i++) if (level.canWalk([x, y], { x: x + by, y })) x += by
    return x
  }
  for (const by of [1, 2]) {
    assert.deepEqual([walk(2, by), walk(2, -by)], [3, 5])
    assert.deepEqual([walk(0.5, by), walk(0.5, -by)], [3, 5])
  }
  level.setDoor('front', true)
  assert.deepEqual([walk(2, 1), walk(2, -1)], [7, 1])
  assert.deepEqual([walk(0.5, 1), walk(0.5, -1), walk(1, 1)], [3, 5, 3])
  assert.equal(level.canWalk([1, 2], [9, 2]), false)
  assert.throws(() => level.canWalk([1, 2], [9, NaN]), SightlineError)
})

test('a shut door is seen from both sides, and an eye on it looks from one', async () => {
  const level = await hall()
  const on = { x: 4, y: 2 }, right = [5, 2], left = [3, 2]
  assert.deepEqual([level.canSee(left, on), level.canSee(right, on)], [true, true])
  assert.deepEqual([level.canSee(on, left), level.canSee(on, right)], [false, true])
  assert.equal(level.locate(4, 2), level.locate(5, 2))
  assert.deepEqual([level.canSee(left, right), level.canSee(right, left)], [false, false])
})

test('arguments that are wrong say so', async () => {
  const level = await hall()
  const cell = level.locate(1, 1)
  for (const [call, message] of [
    [() => level.canSee([1], [2, 2]), /canSee: a point/], [() => level.canSee(cell, [2, 2]), /two cells or two points/],
    [() => level.canSee(null, null), /canSee: a point/], [() => level.canSee(0.5, 1), /cell: a whole number, 0 to \d+, is needed, not 0.5/],
    [() => level.canSee(cell, cell, { mirror: true }), /no option 'mirror'/],
    [() => level.look(1, 1, { direction: 90 }), /no option 'direction'/], [() => level.visiblePolygon(1, 1, { angle: 60 }), /no option 'angle'/],
    [() => level.look(undefined, 3), /x: a number/], [() => level.visiblePolygon(3, NaN), /y: a number/],
    [() => level.look(1, 1, { fov: 60 }), /a heading is needed/], [() => level.row(cell, { mirros: 1 }), /no option/],
  ]) assert.throws(call, (error) => error instanceof SightlineError && message.test(error.message), String(call))
  for (const call of ['look', 'visiblePolygon']) {
    const view = { fov: 60, range: 3 }
    assert.deepEqual(level[call]({ x: 1, y: 1, dx: 0, dy: 2, ...view }), level[call](1, 1, { heading: 90, ...view }))
    assert.deepEqual(level[call]({ x: 1, y: 1 }), level[call](1, 1))
    assert.throws(() => level[call]({ x: 1, y: 1, dx: 1 }), /heading: a number/)
    assert.throws(() => level[call]({ x: 1, y: 1, dx: 0, dy: 0 }), /heading: a number/)
    assert.throws(() => level[call]({ x: 1, y: 1 }, view), /one object holds all/)
  }
  assert.ok(level.visiblePolygon(1, 1, null).length && level.look(1, 1, { fov: 360 }).length)
  assert.throws(() => { level.doors[0].open = true }, TypeError)
  assert.throws(() => { level.doors[0].segments[0][0] = 1 }, TypeError)
})

/** CRC-32 of a baked file, as its header has it: its own four bytes count as 0. */
function checksum(bytes) {
  let sum = ~0
  for (let i = 0; i < bytes.length; i++) {
    sum ^= i >= 28 && i < 32 ? 0 : bytes[i]
    for (let bit = 0; bit < 8; bit++) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0)
  }
  return ~sum >>> 0
}

/** The file without its rows of mirrors: sections of other names are skipped. */
function withoutMirrorRows(bytes) {
  const file = Buffer.from(bytes)
  for (let i = 0; i < file.readUInt32LE(24); i++)
    if (/^M(IR|DO)[OB]$/.test(file.toString('latin1', 32 + 24 * i, 36 + 24 * i))) file.write('X', 32 + 24 * i)
  file.writeUInt32LE(checksum(file), 28)
  return file
}

test('mirrors are walls until they are asked for', async () => {
  const hall = 'sightline 1\nwalls 0 0 30 0 30 10 0 10 0 0\nwall 10 0 10 8\nwall 20 0 20 10\ndoor high 10 8 10 10 open\n'
  const here = { x: 5, y: 2 }, there = { x: 15, y: 2 }, beyond = { x: 25, y: 5 }
  const mirrors = true
  const file = place('hall.map')
  writeFileSync(file, `${hall}mirror 1 10 19 10\n`)
  const { bytes } = nativeBake(file)
  const level = await Level.open(bytes)
  assert.equal(level.mirrors, 'baked')
  const from = level.locate(here.x, here.y), to = level.locate(there.x, there.y)
  assert.equal(level.canSee(here, there), false)
  assert.equal(level.canSee(here, there, { mirrors }), true)
  assert.equal(level.canSee(here, beyond, { mirrors }), false)
  assert.equal(level.canSee(here, { x: 99, y: 5 }, { mirrors }), false)
  const seen = level.look(here.x, here.y, { mirrors })
  assert.deepEqual([...seen.slice(0, seen.direct)], [...level.look(here.x, here.y)])
  assert.ok(seen.includes(to) && level.canSee(from, to, { mirrors }) && level.row(from, { mirrors }).includes(to))
  level.setDoor('high', false)
  assert.equal(level.canSee(here, there, { mirrors }), false)
  assert.ok(!level.look(here.x, here.y, { mirrors }).includes(to))

  const blind = await Level.open(withoutMirrorRows(bytes))
  assert.equal(blind.mirrors, 'not baked')
  assert.equal(blind.canSee(here, beyond), false)
  assert.equal(blind.canSee(here, beyond, { mirrors }), true)
  assert.equal(blind.look(here.x, here.y, { mirrors }).length, blind.cells.filter((cell) => !cell.solid).length)
  assert.equal(blind.row(from, { mirrors }).length, blind.cellCount)

  writeFileSync(file, hall)
  const plain = await Level.open(nativeBake(file).bytes)
  assert.equal(plain.mirrors, 'none')
  const all = plain.look(here.x, here.y, { mirrors })
  assert.equal(all.direct, all.length)
  assert.equal(plain.canSee(here, there, { mirrors }), false)
})

test('nothing that the library sees by mirror is missed', async () => {
  const { bytes } = nativeBake(maps.find((path) => path.endsWith('mirrors.map')))
  const level = await Level.open(bytes)
  const scene = (await (await load('bake.js')).load()).open(bytes)
  const hidden = [0, 0]
  for (const eye of points(level, random(5), 60)) {
    const both = level.look(eye.x, eye.y, { mirrors: true })
    for (const cell of scene.look(eye.x, eye.y, { mirrored: true })) {
      const { corners } = level.cells[cell]
      const middle = { x: 0, y: 0 }
      for (let i = 0; i < corners.length; i += 2) {
        middle.x += (2 * corners[i]) / corners.length
        middle.y += (2 * corners[i + 1]) / corners.length
      }
      assert.ok(both.includes(cell) && level.canSee(eye, middle, { mirrors: true }), `${eye.x} ${eye.y} ${cell}`)
      hidden[+level.canSee(eye, middle)]++
    }
  }
  assert.ok(hidden[0] > 20, String(hidden))
  scene.close()
})
