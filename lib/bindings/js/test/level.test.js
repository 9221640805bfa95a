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
        const options = { direction: angle, fieldOfView: width, range }
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
