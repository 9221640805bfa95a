/** What the tests share: the package, the native programs, maps, random numbers. */
import { execFileSync } from 'node:child_process'
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { pathToFileURL } from 'node:url'
import { after } from 'node:test'

const needed = (name) => process.env[name] ?? (() => { throw new Error(`${name} is not set: use run.sh`) })()

export const folder = needed('SIGHTLINE_PACKAGE')
export const root = join(import.meta.dirname ?? new URL('.', import.meta.url).pathname, '../../../..')
export const load = (name) => import(pathToFileURL(join(folder, name)).href)

const scratch = mkdtempSync(join(tmpdir(), 'sightline-js-'))
after(() => rmSync(scratch, { recursive: true, force: true }))

/** Runs the native command; what it prints. */
export const command = (...words) =>
  execFileSync(needed('SIGHTLINE_COMMAND'), words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'], maxBuffer: 2 ** 28 })

export const place = (name) => join(scratch, name)

/** The bytes of a native bake, and where they are. */
export function nativeBake(map, ...options) {
  const path = place('native.slv')
  command('bake', map, '-o', path, ...options)
  return { bytes: readFileSync(path), path }
}

/** Answers of native code to questions, a line each. */
export const answers = (path, questions) =>
  execFileSync(needed('SIGHTLINE_ANSWERS'), [path], { encoding: 'utf8', input: questions.join('\n') + '\n', maxBuffer: 2 ** 28 })
    .split('\n').slice(0, -1)

/** The maps of this project. */
export const maps = ['maps', 'maps/effects', 'maps/oblique'].flatMap((name) =>
  readdirSync(join(root, name)).filter((file) => /\.(map|txt)$/.test(file)).map((file) => join(root, name, file)))

/** A room of 10 by 8 with an opening of 2, and a wall beside it: what is inside depends on the width of entrances. */
export const house = 'sightline 1\nwalls 5 0 10 0 10 8 0 8 0 0 3 0\nwall 12 0 12 8\n'

/** Random numbers from 0 to 1, the same each time. */
export function random(seed) {
  let state = seed >>> 0
  return () => {
    state = (state + 0x6d2b79f5) >>> 0
    let t = Math.imul(state ^ (state >>> 15), state | 1)
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61)
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296
  }
}
