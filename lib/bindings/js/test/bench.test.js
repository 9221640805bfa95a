/** bench.js compares the bytes of bakes, prints its table, and says what it leaves out. */
import assert from 'node:assert/strict'
import { spawnSync } from 'node:child_process'
import { copyFileSync, mkdirSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import test from 'node:test'
import { folder, maps, place, root } from './help.js'

const bench = (...words) => spawnSync(process.execPath, [join(root, 'lib/bindings/js/bench.js'), ...words], { encoding: 'utf8' })
const { SIGHTLINE_COMMAND, SIGHTLINE_ANSWERS } = process.env

test('a folder of maps has the native bytes and its table', () => {
  mkdirSync(place('benched'))
  copyFileSync(maps.find((map) => map.endsWith('courtyard.map')), place('benched/yard.map'))
  writeFileSync(place('benched/notes.md'), 'no map')
  const { status, stdout, stderr } = bench(folder, SIGHTLINE_COMMAND, SIGHTLINE_ANSWERS, place('benched'))
  assert.equal(status, 0, stderr)
  assert.match(stderr, /^left out: .*notes\.md: .*sightline 1/)
  const table = stdout.split('\n').filter((line) => line.startsWith('| yard')).map((line) => line.split(' | '))
  assert.equal(table.length, 5)
  for (const line of table.slice(0, 4)) assert.ok(parseFloat(line[2]) > 0 && parseFloat(line[3]) > 0 && parseFloat(line[4]) > 0, line)
  assert.match(stdout, /Bytes as the native bake has them: 1 of 1 bakes/)
})

test('bytes that differ are named, by status 1', () => {
  const other = place('other.sh') // bakes another map than it is given
  writeFileSync(other, `#!/bin/sh\n[ "$1" != bake ] || { shift 2; set -- bake '${maps.find((map) => map.endsWith('office.map'))}' "$@"; }\nexec '${SIGHTLINE_COMMAND}' "$@"\n`, { mode: 0o755 })
  const { status, stderr } = bench(folder, other, SIGHTLINE_ANSWERS, maps.find((map) => map.endsWith('courtyard.map')))
  assert.equal(status, 1)
  assert.match(stderr, /Bytes differ: courtyard \(Node\)/)
  assert.equal(bench().status, 2)
})
