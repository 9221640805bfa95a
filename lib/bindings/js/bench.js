/**
 * WebAssembly against native code: bake, region and runtime, in one run.
 *
 *     node bench.js PACKAGE COMMAND ANSWERS [MAP...]
 *
 * Prints a table. PACKAGE is the folder of the package, COMMAND the native `sightline`, ANSWERS the
 * program of tests/bindings. Times are the least of several; compare the two of a line.
 */
import { execFileSync } from 'node:child_process'
import { mkdtempSync, readFileSync, rmSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { basename, join, resolve } from 'node:path'
import { pathToFileURL } from 'node:url'

const [folder, command, answers, ...maps] = process.argv.slice(2)
if (!answers) {
  console.error('usage: node bench.js PACKAGE COMMAND ANSWERS [MAP...]')
  process.exit(2)
}
const load = (name) => import(pathToFileURL(resolve(folder, name)).href)
const { Level } = await load('sightline.js')
const { load: loadCore } = await load('bake.js')
const core = await loadCore()
const scratch = mkdtempSync(join(tmpdir(), 'sightline-bench-'))
const native = (...words) => execFileSync(command, words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] })

/** The least of some times. */
function least(runs, time) {
  let best = Infinity
  for (let i = 0; i < runs; i++) best = Math.min(best, time())
  return best
}

/** Milliseconds of clean, subdivide and see. */
const stages = (seconds) => 1000 * (seconds.clean + seconds.subdivide + seconds.check + seconds.see)

function bakeTimes(path, slv) {
  const text = readFileSync(path)
  const wasm = least(25, () => {
    const scene = core.open(text, { name: basename(path) })
    const time = stages(scene.account.seconds)
    scene.close()
    return time
  })
  const own = least(25, () => {
    const { seconds } = JSON.parse(native('bake', path, '--threads', '1', '--json', '-o', slv))
    return 1000 * (seconds.read + seconds.subdivide + (seconds.check ?? 0) + seconds.cell_to_cell)
  })
  return [own, wasm]
}

/** Microseconds an eye: the native program's answers less the answers to nothing, and the level's. */
function lookTimes(level, slv, kind, ask) {
  const { minX, minY, maxX, maxY } = level.bounds
  const eyes = Array.from({ length: 2000 }, (_, i) => [
    minX + ((i * 0.618034) % 1) * (maxX - minX), minY + ((i * 0.414214) % 1) * (maxY - minY)])
  const wasm = least(25, () => {
    const from = performance.now()
    for (const [x, y] of eyes) ask(x, y)
    return performance.now() - from
  })
  const line = execFileSync(answers, [slv], { encoding: 'utf8', input: `t${kind} ${eyes.map((eye) => eye.join(' ')).join(' ')}\n`, maxBuffer: 2 ** 28 })
  return [Number(line) / eyes.length, (1000 * wasm) / eyes.length]
}

const rows = []
const chosen = maps.length ? maps : [['office', 1], ['office', 4], ['city', 4]].flatMap(([kind, size]) =>
  [[], ['--turned', '17']].map((turn) => {
    const path = join(scratch, `${kind}-${size}${turn.length ? '-turned' : ''}.map`)
    native('generate', kind, '--size', String(size), '-o', path, ...turn)
    return path
  }))
for (const path of chosen) {
  const slv = join(scratch, 'level.slv')
  const name = basename(path).replace(/\.[^.]*$/, '')
  const walls = core.open(readFileSync(path), { name: basename(path) })
  rows.push([name, `bake, ${walls.wallCount} walls`, ...bakeTimes(path, slv), 'ms'])
  walls.close()
  const level = await Level.open(readFileSync(slv))
  rows.push([name, 'runtime: cells of an eye', ...lookTimes(level, slv, 'k', (x, y) => level.look(x, y)), 'µs'])
  rows.push([name, 'runtime: polygon of an eye', ...lookTimes(level, slv, 'v', (x, y) => level.visiblePolygon(x, y)), 'µs'])
  const scene = core.open(readFileSync(slv))
  rows.push([name, 'library: region of an eye', ...lookTimes(level, slv, 'r', (x, y) => scene.visiblePolygon(x, y)), 'µs'])
  scene.close()
  level.close()
}
rmSync(scratch, { recursive: true })
console.log('| map | what | native | WebAssembly | ratio |\n| --- | --- | --- | --- | --- |')
for (const [name, what, own, wasm, unit] of rows)
  console.log(`| ${name} | ${what} | ${own.toPrecision(3)} ${unit} | ${wasm.toPrecision(3)} ${unit} | ${(wasm / own).toFixed(1)} |`)
