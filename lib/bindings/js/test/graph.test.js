/** Graphs have the values of the native command: to the last bit, but for logarithms of the C library. */
import assert from 'node:assert/strict'
import { readFileSync, writeFileSync } from 'node:fs'
import { basename, join } from 'node:path'
import test from 'node:test'
import { command, folder, house, load, maps, place } from './help.js'

const { graph, load: loadCore, SightlineError } = await load('graph.js')
const core = await loadCore()
const measures = core.measures.map(({ name }) => name), depths = core.depths.map(({ name }) => name)
const textOf = (path) => readFileSync(path, 'utf8')

/** The command's table: names and rows of numbers, NaN where it is empty. */
function native(path, grid, ...options) {
  const out = place('vga.csv')
  command('vga', path, '--grid', String(grid), '-o', out, ...options)
  const [head, ...lines] = readFileSync(out, 'utf8').trim().split('\n').map((line) => line.split(','))
  return { names: head, rows: lines.map((line) => line.map((word) => (word === '' ? NaN : Number(word)))) }
}

function compare(made, { names, rows }, what) {
  assert.equal(made.count, rows.length, what)
  for (const [k, name] of names.entries()) {
    const got = name === 'x' || name === 'y' ? made.points.filter((_, i) => i % 2 === (name === 'y' ? 1 : 0))
      : measures.includes(name) ? made.values(name) : null
    if (!got) continue
    const want = rows.map((row) => row[k]), hasLogs = /entropy|integration/.test(name)
    const same = (a, b) => Object.is(a, b) || a === b || (hasLogs && Math.abs(a - b) <= 1e-13 * Math.abs(b))
    const at = want.findIndex((value, i) => !same(got[i], value))
    assert.equal(at, -1, `${what} ${name}: ${got[at]} for ${want[at]}`)
  }
}

/** A step that gives some hundred points. Points of 700 squares do not all lie on walls. */
function stepFor(path) {
  const { minX, minY, maxX, maxY } = boundsOf(textOf(path))
  return Math.sqrt(((maxX - minX) * (maxY - minY)) / 700)
}

function boundsOf(text) {
  const xs = [], ys = []
  for (const line of text.split('\n')) {
    const words = line.split(/\s+/)
    if (!/^(walls?|solid|open)$/.test(words[0])) continue
    const numbers = words.slice(1).map(Number).filter(Number.isFinite)
    numbers.forEach((n, i) => (i % 2 ? ys : xs).push(n))
  }
  return { minX: Math.min(...xs), maxX: Math.max(...xs), minY: Math.min(...ys), maxY: Math.max(...ys) }
}

test('measures and depths are the columns of the command, and so are their types', async () => {
  const path = place('room.map')
  writeFileSync(path, 'sightline 1\nwalls 0 0 6 0 6 6 0 6 0 0\n')
  const { names } = native(path, 1, '--measures', 'visual,through,metric,angular', '--from', '3,3')
  assert.deepEqual(names, ['x', 'y', ...measures, ...depths])
  const types = readFileSync(join(folder, 'measures.d.ts'), 'utf8')
  assert.deepEqual([...types.matchAll(/\| '(\w+)'/g)].map((found) => found[1]), [...measures, ...depths])
  const regions = (await (await load('bake.js')).load()).measures
  const snake = (member) => member.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`)
  assert.deepEqual([...types.matchAll(/^  (\w+): number$/gm)].map((found) => snake(found[1])), regions)
  const nodes = core.measures.find(({ name }) => name === 'metric_node_count')
  assert.deepEqual(nodes, { name: 'metric_node_count', group: 'metric', unit: 'none' })
})

test('every map text of the project has the native values', () => {
  let refused = 0
  const texts = maps.filter((path) => path.endsWith('.map'))
  for (const path of texts) {
    const step = stepFor(path), name = basename(path)
    if (/^mirror /m.test(textOf(path))) {
      assert.throws(() => core.graph(textOf(path), { grid: step }), /mirror/, path)
      refused++
      continue
    }
    const made = core.graph(readFileSync(path), { grid: step, name })
    compare(made, native(path, step, '--measures', 'visual,through,metric,angular'), name)
    made.close()
  }
  assert.ok(refused > 0 && texts.length - refused > 8, `${refused} of ${texts.length}`)
})

test('doors, glass, a range and depths are those of the command', () => {
  const text = 'sightline 1\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n' +
    'door middle 10 4 10 6 open\noneway 4 0 4 10\nstart 2 5 0\nrange 12\n'
  const path = place('effects.map')
  command('convert', place2(text), '-o', path)
  for (const [doors, words] of [[{}, []], [{ middle: false }, ['--shut', 'middle']]]) {
    const made = core.graph(text, { grid: 1, doors })
    compare(made, native(path, 1, '--measures', 'visual,metric', ...words), JSON.stringify(doors))
    assert.equal(made.directed, true)
    const { names, rows } = native(path, 1, '--measures', 'metric,angular', '--from', '2,5', ...words)
    for (const name of ['visual_step_depth', 'metric_step_shortest_path_length', 'angular_step_depth']) {
      if (names.includes(name))
        assert.deepEqual([...made.depth(2, 5, name)], rows.map((row) => row[names.indexOf(name)]), name)
    }
    const a = made.find(6, 5), b = made.find(2, 5)
    assert.equal(made.sees(a, b), !made.sees(b, a))
    assert.equal(made.sees(b, made.find(12, 5)), false)
    assert.equal(made.sees(made.find(8, 5), made.find(12, 5)), doors.middle !== false && made.sees(made.find(8, 5), made.find(11, 5)))
    assert.equal(made.depth(100, 100), null)
    made.close()
    assert.throws(() => made.find(1, 1), /closed/)
  }
})

test('the grid and paths go by steps, and the rest by sight, also of a baked file', () => {
  const text = 'sightline 1\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4 stops sight\nwall 10 6 10 10 stops steps\n' +
    'door middle 10 4 10 6 shut\nsolid 2.25 2.25 4.25 2.25 4.25 4.25 stops steps\nstart 6 5 0\n'
  const path = place2(text), slv = place('stops.slv')
  command('bake', path, '-o', slv)
  const lengths = []
  for (const [doors, words] of [[{}, []], [{ middle: true }, ['--open', 'middle']]])
    for (const [map, file] of [[text, path], [readFileSync(slv), slv]]) {
      const made = core.graph(map, { grid: 1, doors })
      compare(made, native(file, 1, '--measures', 'visual,through,metric,angular', ...words), file)
      const { names, rows } = native(file, 1, '--measures', 'metric,angular', '--from', '6,5', ...words)
      for (const name of depths) assert.deepEqual([...made.depth(6, 5, name)], rows.map((row) => row[names.indexOf(name)]), name)
      assert.equal(made.find(4, 3), -1)
      assert.equal(made.sees(made.find(6, 2), made.find(14, 2)), false)
      assert.equal(made.sees(made.find(6, 8), made.find(14, 8)), true)
      lengths.push(made.depth(6, 8, 'metric_step_shortest_path_length')[made.find(14, 8)])
      made.close()
    }
  assert.ok(lengths[0] > lengths[2] && lengths[2] > 8, String(lengths))
})

function place2(text) {
  const path = place('given.map')
  writeFileSync(path, text)
  return path
}

test('the width of entrances says where points are', () => {
  const path = place('house.map')
  writeFileSync(path, house)
  const counts = [1, 2].map((width) => {
    const made = core.graph(house, { grid: 1, entrance: width })
    const count = made.count
    made.close()
    return count
  })
  assert.ok(counts[0] > counts[1])
  compare(core.graph(house, { grid: 1, entrance: 2 }), native(path, 1, '--entrance', '2'), 'house')
})

test('a measure that is not defined is NaN, as it is empty in the table', () => {
  const text = 'sightline 1\nwalls 0.75 0.75 2.25 0.75 2.25 2.25 1.75 2.25 1.75 1.25 0.75 1.25 0.75 0.75\n'
  const path = place('corner.map')
  writeFileSync(path, text)
  const made = core.graph(text, { grid: 1 })
  compare(made, native(path, 1), 'corner')
  assert.deepEqual([...made.values('visual_integration_tekl')], [NaN, NaN, NaN])
  for (const name of measures) assert.ok([...made.values(name)].every((value) => Math.abs(value) !== Infinity), name)
  made.close()
})

test('what cannot be is refused with its reason, and the module goes on', async () => {
  const room = { walls: [[0, 0, 9, 0], [9, 0, 9, 9], [9, 9, 0, 9], [0, 9, 0, 0]] }
  for (const [options, message] of [
    [{}, /grid/], [{ grid: 0 }, /over 0/], [{ grid: 0.001 }, /more than 20000; choose a coarser/],
    [{ grid: 100 }, /choose a finer|inside/], [{ grid: 1, measures: ['magic'] }, /no measure 'magic'/],
    [{ grid: 1, doors: { none: true } }, /no door 'none'/], [{ grid: 1, step: 2 }, /no option 'step'/],
    [{ grid: 1, progress: () => false }, /./],
  ]) await assert.rejects(graph(room, options), (error) => error instanceof SightlineError && message.test(error.message), String(message))
  const made = await graph(room, { grid: 1, measures: ['connectivity'] })
  assert.equal(made.count, 64)
  assert.ok(made.values('connectivity').every((value) => value === 63))
  assert.ok(made.depth(4, 4).every((value) => value <= 1))
  assert.throws(() => made.sees(0, 64), /point: a whole number, 0 to 63, is needed, not 64/)
  made.close()
})
