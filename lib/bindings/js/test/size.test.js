/** What a page loads stays small: gzip of all files that an import brings, by the zlib of Node. */
import assert from 'node:assert/strict'
import { readFileSync, readdirSync } from 'node:fs'
import { join } from 'node:path'
import test from 'node:test'
import { gzipSync } from 'node:zlib'
import { folder, load } from './help.js'

const size = (...names) =>
  names.reduce((sum, name) => sum + gzipSync(readFileSync(join(folder, name)), { level: 9 }).length, 0)

const said = (bytes) => `${bytes} bytes, by zlib ${process.versions.zlib}`

test('the runtime is at most 25 kB', () => {
  const bytes = size('sightline.js', 'arguments.js', 'host.js', 'level.wasm')
  assert.ok(bytes <= 25000, said(bytes))
})

test('a level with boxes that move is at most 36 kB', () => {
  const bytes = size('sightline.js', 'arguments.js', 'host.js', 'boxes.wasm')
  assert.ok(bytes <= 36000, said(bytes))
})

test('the whole library is at most 215 kB', () => {
  const bytes = size('bake.js', 'arguments.js', 'maptext.js', 'scene.js', 'host.js', 'module.js', 'core.wasm')
  assert.ok(bytes <= 215000, said(bytes))
})

test('visibility graph analysis is at most 137 kB', () => {
  const bytes = size('graph.js', 'arguments.js', 'maptext.js', 'host.js', 'module.js', 'graph.wasm')
  assert.ok(bytes <= 137000, said(bytes))
})

test('placement is at most 149 kB', () => {
  const bytes = size('place.js', 'coverage.js', 'floor.js', 'arguments.js', 'maptext.js', 'host.js', 'module.js', 'place.wasm')
  assert.ok(bytes <= 149000, said(bytes))
})

test('the choice of cameras is at most 158 kB', () => {
  const bytes = size('cameras.js', 'coverage.js', 'floor.js', 'arguments.js', 'maptext.js', 'host.js', 'module.js', 'cameras.wasm')
  assert.ok(bytes <= 158000, said(bytes))
})

test('lines, areas and ways are at most 148 kB', () => {
  const bytes = size('ways.js', 'floor.js', 'arguments.js', 'maptext.js', 'host.js', 'module.js', 'ways.wasm')
  assert.ok(bytes <= 148000, said(bytes))
})

test('worlds are at most 142 kB', () => {
  const bytes = size('world.js', 'arguments.js', 'maptext.js', 'host.js', 'module.js', 'world.wasm')
  assert.ok(bytes <= 142000, said(bytes))
})

test('explored areas are at most 45 kB', () => {
  const bytes = size('explored.js', 'arguments.js', 'maptext.js', 'host.js', 'module.js', 'explored.wasm')
  assert.ok(bytes <= 45000, said(bytes))
})

test('the package needs no other, and has what it says', async () => {
  const about = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'))
  assert.equal(about.license, 'MIT')
  assert.equal(about.version, (await (await load('bake.js')).load()).version)
  assert.equal(about.dependencies, undefined)
  const there = readdirSync(folder)
  // Bundlers for pages stop at a module of node.
  for (const name of there.filter((each) => each.endsWith('.js')))
    assert.doesNotMatch(readFileSync(join(folder, name), 'utf8'), /(from|import)[ (]*['"]node:/, name)
  for (const entry of Object.values(about.exports).flatMap((each) => Object.values(typeof each === 'string' ? [each] : each)))
    assert.ok(there.includes(entry.slice(2)), entry)
  assert.ok(there.includes('LICENSE'))
})
