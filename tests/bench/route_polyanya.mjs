// Shortest ways beside Polyanya for JavaScript, in one run: is each as long, and how long do they take?
//
//   node route_polyanya.mjs POLYANYA SIGHTLINE BENCH_ROUTE FILE...
//
// POLYANYA: a program made of the authors' C++ and route_polyanya.cpp, or the module of
// zalo/polyanya-ts (dist/index.js, with its package cdt2d beside it, or any module of that name: it
// is not called). FILE: a mesh of the Polyanya benchmarks (.mesh, version 2), whose border becomes a
// map's walls, or a map, whose cells become a mesh. So both search the same ground, each on its own
// cells where the file is a mesh. Ours are cut by --subdivide mesh. 200 random pairs of places each,
// or the scenario that lies beside a mesh: FILE.mesh and FILE.map.scen, the middles of its cells,
// evenly thinned to 200.
//
// CSV: file, walls, polygons of the mesh, cells of ours, pairs, how many ways are equally long (to a
// relative 1e-9), how many are longer in Polyanya or not found there, how many are longer in ours,
// the mean times in microseconds, and their ratio.
import { execFileSync } from 'node:child_process'
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { basename, join, resolve } from 'node:path'
import { pathToFileURL } from 'node:url'

const PAIRS = 200
const [dist, sightline, bench, ...files] = process.argv.slice(2)
const { Mesh, SearchInstance } = /\.m?js$/.test(dist) ? await import(pathToFileURL(resolve(dist))) : {}
const box = mkdtempSync(join(tmpdir(), 'route'))

/** The polygons of a mesh: corners, and the neighbour at the side that ends at each. */
function readMesh(text) {
  const n = text.trim().split(/\s+/).slice(2).map(Number)
  const [vertices, polygons] = n
  let at = 2
  const corners = Array.from({ length: vertices }, () => {
    const p = [n[at], n[at + 1]]
    at += 3 + n[at + 2]
    return p
  })
  return Array.from({ length: polygons }, () => {
    const count = n[at++], ids = n.slice(at, at + count), next = n.slice(at + count, at + 2 * count)
    at += 2 * count
    return { points: ids.map(i => corners[i]), next }
  })
}

/** A map whose walls are the sides without a neighbour. */
function mapOf(polygons) {
  const lines = ['sightline 1']
  for (const { points, next } of polygons)
    next.forEach((other, i) => {
      if (other < 0) lines.push(`wall ${points.at(i - 1).join(' ')} ${points[i].join(' ')}`)
    })
  const first = polygons[0].points
  lines.push(`start ${first.reduce((a, p) => a + p[0], 0) / first.length} ` +
             `${first.reduce((a, p) => a + p[1], 0) / first.length} 0`)
  return lines.join('\n') + '\n'
}

/** The polygons of our cells, with the ends of portals as corners. */
function readCells(map) {
  const { cells, portals } = JSON.parse(map), ends = new Map(), across = new Map()
  for (const { cells: [a, b], segment: [x0, y0, x1, y1] } of portals)
    for (const [one, other] of [[a, b], [b, a]]) {
      ends.set(one, [...(ends.get(one) ?? []), [x0, y0], [x1, y1]])
      across.set(`${one} ${x0} ${y0} ${x1} ${y1}`, other).set(`${one} ${x1} ${y1} ${x0} ${y0}`, other)
    }
  const inside = cells.filter(c => c.inside !== false), number = new Map(inside.map((c, i) => [c.id, i]))
  return inside.map(({ id, polygon }) => {
    const points = []
    polygon.forEach((p, i) => {
      const q = polygon[(i + 1) % polygon.length], way = [q[0] - p[0], q[1] - p[1]]
      const share = e => ((e[0] - p[0]) * way[0] + (e[1] - p[1]) * way[1]) / (way[0] ** 2 + way[1] ** 2)
      const on = (ends.get(id) ?? []).filter(e => share(e) > 0 && share(e) < 1 &&
        Math.abs((e[0] - p[0]) * way[1] - (e[1] - p[1]) * way[0]) <= 1e-9 * (way[0] ** 2 + way[1] ** 2))
      on.sort((a, b) => share(a) - share(b))
      for (const e of [p, ...on])
        if (!points.length || points.at(-1)[0] !== e[0] || points.at(-1)[1] !== e[1]) points.push(e)
    })
    const next = points.map((p, i) =>
      number.get(across.get(`${id} ${points.at(i - 1).join(' ')} ${p.join(' ')}`)) ?? -1)
    return { points, next }
  })
}

/** The text of a mesh; around each corner its polygons, and -1 where something else is between. */
function meshOf(polygons) {
  const ids = new Map(), around = []
  polygons.forEach(({ points, next }, polygon) => points.forEach((p, i) => {
    const key = p.join(' ')
    if (!ids.has(key)) ids.set(key, ids.size), around.push({ p, list: [] })
    const before = points.at(i - 1), after = points[(i + 1) % points.length]
    around[ids.get(key)].list.push({
      polygon, angle: Math.atan2(after[1] - p[1], after[0] - p[0]),
      left: next[i], right: next[(i + 1) % points.length], before })
  }))
  const lines = ['mesh', '2', `${ids.size} ${polygons.length}`]
  for (const { p, list } of around) {
    list.sort((a, b) => a.angle - b.angle)
    const ring = list.flatMap((e, i) =>
      e.left === list[(i + 1) % list.length].polygon && list.length > 1 ? [e.polygon] : [e.polygon, -1])
    lines.push(`${p.join(' ')} ${ring.length} ${ring.join(' ')}`)
  }
  for (const { points, next } of polygons)
    lines.push([points.length, ...points.map(p => ids.get(p.join(' '))), ...next].join(' '))
  return lines.join('\n') + '\n'
}

/** The same numbers each time. */
function randoms(seed) {
  return () => {
    seed = Math.imul(seed ^ seed >>> 15, 0x2c1b3c6d) + 0x9e3779b9 | 0
    return ((seed ^ seed >>> 12) >>> 0) / 2 ** 32
  }
}

/** A place within a random polygon. */
function place(polygons, random) {
  const { points } = polygons[Math.floor(random() * polygons.length)]
  const weights = points.map(() => 0.05 + random()), sum = weights.reduce((a, b) => a + b)
  return [0, 1].map(k => points.reduce((a, p, i) => a + p[k] * weights[i] / sum, 0))
}

function run(program, ...args) {
  return execFileSync(program, args, { encoding: 'utf8', maxBuffer: 2 ** 30, stdio: ['ignore', 'pipe', 'inherit'] })
}

function waysOf(map, pairs) {
  const table = join(box, 'pairs.csv')
  writeFileSync(table, pairs.map(p => p.join(',')).join('\n') + '\n')
  const cells = run(bench, map, '-', '0', table, 'mesh').trim().split('\n')[1].split(',')
  let lengths
  try {
    lengths = run(sightline, 'path', map, '--subdivide', 'mesh', '--pairs', table)
  } catch (e) {
    lengths = e.stdout // a way is missing
  }
  return { walls: cells[2], cells: cells[3], time: +cells[7],
           lengths: lengths.trim().split('\n').slice(1).map(l => +(l.split(',')[4] || NaN)) }
}

/** The program: length and microseconds of each pair, a line each. */
function askProgram(meshText, pairs) {
  const mesh = join(box, 'plan.mesh'), table = join(box, 'pairs.csv')
  writeFileSync(mesh, meshText)
  writeFileSync(table, pairs.map(p => p.join(',')).join('\n') + '\n')
  const rows = run(dist, mesh, table).trim().split('\n').map(l => l.split(',').map(Number))
  return { lengths: rows.map(r => r[0] < 0 ? NaN : r[0]), time: rows.reduce((a, r) => a + r[1], 0) / rows.length }
}

function askModule(meshText, pairs) {
  const search = new SearchInstance(Mesh.fromString(meshText))
  search.timeLimitMs = 10000
  const ask = ([x, y, X, Y]) => {
    search.setStartGoal({ x, y }, { x: X, y: Y })
    return search.search() ? search.getCost() : NaN
  }
  for (const pair of pairs.slice(0, 50)) ask(pair) // the compiler warms up
  const before = process.cpuUsage(), lengths = pairs.map(ask), used = process.cpuUsage(before)
  return { lengths, time: (used.user + used.system) / pairs.length }
}

/** The pairs of a scenario of a grid: middles of its cells. */
function readScenario(text) {
  const rows = text.trim().split('\n').slice(1), step = Math.max(1, Math.floor(rows.length / PAIRS))
  return rows.filter((_, i) => i % step === 0).slice(0, PAIRS)
    .map(l => l.split(/\s+/).slice(4, 8).map(n => +n + 0.5))
}

console.log('file,walls,polygons,cells,pairs,equal,polyanya_longer,ours_longer,us_polyanya,us_ours,ratio')
for (const file of files) {
  const map = join(box, 'plan.map')
  let polygons
  if (file.endsWith('.mesh')) {
    polygons = readMesh(readFileSync(file, 'utf8'))
    writeFileSync(map, mapOf(polygons))
  } else {
    const slv = join(box, 'plan.slv')
    run(sightline, 'convert', file, '-o', map)
    run(sightline, 'bake', map, '--subdivide', 'mesh', '-o', slv, '--quiet')
    polygons = readCells(run(sightline, 'export', slv, '--format', 'json'))
  }
  const meshText = file.endsWith('.mesh') ? readFileSync(file, 'utf8') : meshOf(polygons)
  const random = randoms(7), scenario = file.replace(/\.mesh$/, '.map.scen')
  const pairs = scenario !== file && existsSync(scenario)
    ? readScenario(readFileSync(scenario, 'utf8'))
    : Array.from({ length: PAIRS }, () => [...place(polygons, random), ...place(polygons, random)])
  const ours = waysOf(map, pairs), { lengths, time } = Mesh ? askModule(meshText, pairs) : askProgram(meshText, pairs)
  let equal = 0, theirs = 0, mine = 0
  lengths.forEach((l, i) => {
    const o = ours.lengths[i]
    if (isNaN(l) && isNaN(o) || Math.abs(l - o) <= 1e-9 * o) equal++
    else if (isNaN(l) || l > o) theirs++
    else mine++
  })
  console.log([basename(file), ours.walls, polygons.length, ours.cells, pairs.length, equal, theirs, mine,
               time.toFixed(1), ours.time.toFixed(1), (time / ours.time).toFixed(2)].join(','))
}
rmSync(box, { recursive: true })
