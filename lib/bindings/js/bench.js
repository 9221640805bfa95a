/**
 * WebAssembly against native code, in one run: the bytes of bakes, and how long bakes and questions take.
 *
 *     node bench.js [--chromium] PACKAGE COMMAND ANSWERS [MAP|FOLDER...]
 *
 * Prints a table: native code beside Node and, with --chromium, beside that browser. PACKAGE is the folder
 * of the package, COMMAND the native `sightline`, ANSWERS the program of tests/bindings. Of a folder it takes
 * all files that COMMAND reads, and says what it leaves out; without maps it generates some. Times are the
 * least of several, in Node of the processor: compare those of one line. Exits with 1 where bytes differ.
 */
import { execFileSync, spawn } from 'node:child_process'
import { once } from 'node:events'
import { mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs'
import { createServer } from 'node:http'
import { tmpdir } from 'node:os'
import { basename, join, resolve } from 'node:path'
import { pathToFileURL } from 'node:url'
import { eyesOf, leastStages, measure } from './bench-times.js'

const words = process.argv.slice(2)
const browser = words[0] === '--chromium' && words.shift()
const [folder, command, answers, ...chosen] = words
if (!answers) {
  console.error('usage: node bench.js [--chromium] PACKAGE COMMAND ANSWERS [MAP|FOLDER...]')
  process.exit(2)
}
const scratch = mkdtempSync(join(tmpdir(), 'sightline-bench-'))
process.on('exit', () => rmSync(scratch, { recursive: true, force: true }))
const native = (...args) => execFileSync(command, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], maxBuffer: 2 ** 28 })

// ---- Maps ----

function generated() {
  return [['office', 1], ['office', 4], ['city', 4]].flatMap(([kind, size]) => [[], ['--turned', '17']].map((turn) => {
    const path = join(scratch, `${kind}-${size}${turn.length ? '-turned' : ''}.map`)
    native('generate', kind, '--size', String(size), '-o', path, ...turn)
    return path
  }))
}

const filesOf = (path) => !statSync(path).isDirectory() ? [path]
  : readdirSync(path, { withFileTypes: true }).filter((entry) => entry.isFile()).map((entry) => join(path, entry.name)).sort()

/** A file as map text, and its native bake; null, and why, where there is none. */
function prepared(path, number) {
  const map = join(scratch, `${number}.map`), slv = join(scratch, `${number}.slv`)
  try {
    if (/\.map$/.test(path)) writeFileSync(map, readFileSync(path))
    else native('convert', path, '-o', map)
    native('bake', map, '-o', slv)
    return { name: basename(path).replace(/\.(map|txt)$/, ''), map, slv, number }
  } catch (error) {
    console.error(`left out: ${path}: ${String(error.stderr ?? error.message).trim().split('\n').pop()}`)
    return null
  }
}

// ---- Times ----

/** Microseconds an eye, by the native program. */
function lookTime(slv, kind, eyes) {
  const input = `t${kind} ${eyes.map((eye) => eye.join(' ')).join(' ')}\n`
  return Number(execFileSync(answers, [slv], { encoding: 'utf8', input, maxBuffer: 2 ** 28 })) / eyes.length
}

const fromPackage = (name) => import(pathToFileURL(resolve(folder, name)).href)
const modules = { ...(await fromPackage('sightline.js')), ...(await fromPackage('bake.js')) }
const core = await modules.load()

/** Milliseconds of the processor, so that other programs count less. */
function processorTime() {
  const { user, system } = process.cpuUsage()
  return (user + system) / 1000
}

async function here({ map, slv }) {
  const eyes = eyesOf((await modules.Level.open(readFileSync(slv))).bounds)
  const scratchSlv = join(scratch, 'again.slv')
  const bake = leastStages(() => {
    const { write, ...seconds } = JSON.parse(native('bake', map, '--threads', '1', '--json', '-o', scratchSlv)).seconds
    return seconds
  })
  const own = { bake, cells: lookTime(slv, 'k', eyes), polygon: lookTime(slv, 'v', eyes), region: lookTime(slv, 'r', eyes) }
  return { native: own, Node: await measure(core, modules.Level, readFileSync(map), readFileSync(slv), processorTime) }
}

/** The same in a browser without a window: the page fetches the maps, and posts its times. */
async function inBrowser(maps) {
  const page = `<!doctype html><script type=module>
    import { measure } from '/bench-times.js'
    import { Level } from '/package/sightline.js'
    import { load } from '/package/bake.js'
    const core = await load(), bytes = async (name) => new Uint8Array(await (await fetch(name)).arrayBuffer())
    const times = []
    try {
      for (const number of ${JSON.stringify(maps.map((map) => map.number))})
        times.push(await measure(core, Level, await bytes('/' + number + '.map'), await bytes('/' + number + '.slv'), () => performance.now()))
      await fetch('/times', { method: 'POST', body: JSON.stringify(times) })
    } catch (error) {
      await fetch('/times', { method: 'POST', body: JSON.stringify({ error: error.message }) })
    }</script>`
  const types = { html: 'text/html', js: 'text/javascript', wasm: 'application/wasm' }
  let posted
  const answer = new Promise((resolve, reject) => (posted = { resolve, reject }))
  const server = createServer(async (request, response) => {
    const name = request.url.slice(1)
    if (request.method === 'POST') {
      const parts = []
      for await (const part of request) parts.push(part)
      posted.resolve(JSON.parse(Buffer.concat(parts)))
      return response.end()
    }
    const file = name === 'bench-times.js' ? new URL(name, import.meta.url)
      : name.startsWith('package/') ? join(folder, basename(name)) : /^\d+\.(map|slv)$/.test(name) ? join(scratch, name) : null
    if (!file && name !== '') return response.writeHead(404).end()
    // The two policies give the page a clock of microseconds.
    response.writeHead(200, { 'content-type': types[name.split('.')[1] ?? 'html'] ?? 'application/octet-stream',
      'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' })
    response.end(file ? readFileSync(file) : page)
  }).listen(0, '127.0.0.1')
  await once(server, 'listening')
  const program = spawn('chromium', ['--headless=new', '--no-sandbox', '--disable-gpu', `--user-data-dir=${join(scratch, 'browser')}`,
    `http://127.0.0.1:${server.address().port}/`], { stdio: 'ignore' })
  program.on('error', posted.reject)
  program.on('exit', () => posted.reject(new Error('the browser has ended by itself')))
  try {
    const times = await answer
    if (times.error) throw new Error(`in the browser: ${times.error}`)
    return times
  } finally {
    server.close()
    if (program.exitCode === null && program.kill()) await once(program, 'exit')
  }
}

// ---- The table ----

const files = chosen.length ? chosen.flatMap(filesOf) : generated()
const maps = files.map(prepared).filter(Boolean)
const rows = []
for (const map of maps) rows.push(await here(map))
if (browser) for (const [i, times] of (await inBrowser(maps)).entries()) rows[i].Chromium = times

const places = browser ? ['Node', 'Chromium'] : ['Node']
const questions = [
  ['bake', 'bake', 'ms'], ['cells', 'runtime: cells of an eye', 'µs'], ['polygon', 'runtime: polygon of an eye', 'µs'],
  ['region', 'library: region of an eye', 'µs'], ['step', 'bake, then cells and region of one eye', 'ms'],
]
console.log(`| map | what | native | ${places.join(' | ratio | ')} | ratio |\n| --- | --- | --- |${' --- | --- |'.repeat(places.length)}`)
for (const [i, row] of rows.entries())
  for (const [key, what, unit] of questions) {
    const cells = places.flatMap((place) => [`${row[place][key].toPrecision(3)} ${unit}`, row.native[key] ? (row[place][key] / row.native[key]).toFixed(1) : ''])
    const walls = key === 'bake' ? `, ${row.Node.walls} walls` : ''
    console.log(`| ${maps[i].name} | ${what}${walls} | ${row.native[key] ? `${row.native[key].toPrecision(3)} ${unit}` : ''} | ${cells.join(' | ')} |`)
  }
const differs = rows.flatMap((row, i) => places.filter((place) => !row[place].same).map((place) => `${maps[i].name} (${place})`))
console.log(`\nBytes as the native bake has them: ${rows.length * places.length - differs.length} of ${rows.length * places.length} bakes.`)
if (differs.length) console.error(`Bytes differ: ${differs.join(', ')}`)
process.exitCode = differs.length ? 1 : 0
