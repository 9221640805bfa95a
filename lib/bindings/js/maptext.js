/**
 * Maps that a caller gives: map text, an ASCII plan, the bytes of either, or an object. An object
 * becomes map text, which reads back to the same doubles; each line remembers the item it is from,
 * so that messages name the item.
 */
import { textOf } from './arguments.js'
import { SightlineError, bytesOf } from './host.js'

/** Whether these are the bytes of a baked file. */
export function isBaked(map) {
  if (!(map instanceof ArrayBuffer || ArrayBuffer.isView(map))) return false
  const bytes = bytesOf(map)
  return [0x89, 0x53, 0x4c, 0x56].every((byte, i) => bytes[i] === byte)
}

/** Numbers of one item, checked. */
function numbers(list, item, least, even = false) {
  const flat = Array.isArray(list) || ArrayBuffer.isView(list) ? Array.from(list).flat() : []
  const right = flat.length >= least && (even ? flat.length % 2 === 0 : flat.length === least)
  if (!right || flat.some((n) => typeof n !== 'number' || !Number.isFinite(n)))
    throw new SightlineError(`${item}: ${even ? `${least} or more` : least} numbers are needed`, { item })
  return flat
}

/** A flag of one item, checked; a missing one is `otherwise`. */
function flag(value, item, name, otherwise) {
  if (value === undefined || value === null) return otherwise
  if (typeof value === 'boolean') return value
  throw new SightlineError(`${item}: ${name}: true or false is needed`, { item })
}

/** What walls stop that do not stop all, checked. The library knows the names. */
function stopped({ stops }, item) {
  if ((stops ?? null) === null) return ''
  if (/^[a-z]+(,[a-z]+)*$/.test(stops)) return ` stops ${stops}`
  throw new SightlineError(`${item}: stops: sight, steps, sound or a list of these is needed`, { item })
}

const segment = (thing, item) => numbers(thing.segment ?? thing, item, 4).join(' ')

function name(thing, item) {
  if (typeof thing.name === 'string' && /^[^\s#]+$/.test(thing.name)) return thing.name
  throw new SightlineError(`${item}: a name of one word without '#' is needed`, { item })
}

function kind({ kind = 'door' }, item) {
  if (['door', 'breakable', 'site'].includes(kind)) return kind === 'door' ? '' : ` ${kind}`
  throw new SightlineError(`${item}: kind: door, breakable or site is needed`, { item })
}

/** The statement of one item, by the member that it is in. */
const statements = {
  walls: (wall, item) => `wall ${segment(wall, item)}${flag(wall.solid, item, 'solid', false) ? ' solid' : ''}${stopped(wall, item)}`,
  doors: (door, item) =>
    `door ${name(door, item)} ${segment(door, item)} ${flag(door.open, item, 'open', door.kind !== 'breakable') ? 'open' : 'shut'}${kind(door, item)}`,
  mirrors: (mirror, item) => `mirror ${segment(mirror, item)}${flag(mirror.oneSided, item, 'oneSided', false) ? ' one' : ''}`,
  oneway: (glass, item) => `oneway ${segment(glass, item)}`,
  seams: (seam, item) => `seam ${segment(seam, item)}`,
  solid: (polygon, item) => `solid ${numbers(polygon.points ?? polygon, item, 6, true).join(' ')}${stopped(polygon, item)}`,
  open: (polygon, item) => `open ${numbers(polygon, item, 6, true).join(' ')}`,
  starts: (start, item) => {
    const [x, y, heading = 0] = Array.isArray(start) ? start : [start.x, start.y, start.heading]
    return `start ${numbers([x, y, heading], item, 3).join(' ')}`
  },
  paths: (path, item) => `path ${name(path, item)} ${numbers(path.points, item, 2, true).join(' ')}`,
  objects: (box, item) => `object ${name(box, item)} ${numbers(box.box, item, 4).join(' ')}`,
  cells: (cell, item) => `cell ${numbers(cell, item, 6, true).join(' ')}`,
}

/** Members of one number; 0: none. */
const settings = ['range', 'entrance', 'snap']

function fromObject(map) {
  if (!map || typeof map !== 'object' || Array.isArray(map))
    throw new SightlineError('map: a text, bytes or an object with walls is needed')
  const lines = ['sightline 1']
  const items = ['', '']
  for (const member of Object.keys(map))
    if (!(member in statements) && !settings.includes(member))
      throw new SightlineError(`map: there is no member '${member}'`, { item: member })
  for (const [member, statement] of Object.entries(statements)) {
    const list = map[member] ?? []
    if (!Array.isArray(list)) throw new SightlineError(`${member}: a list is needed`, { item: member })
    for (let i = 0; i < list.length; i++) {
      const item = `${member}[${i}]`
      if (typeof list[i] !== 'object' || !list[i])
        throw new SightlineError(`${item}: an object or a list is needed`, { item })
      lines.push(statement(list[i], item))
      items.push(item)
    }
  }
  for (const member of settings)
    if (map[member] !== undefined && map[member] !== null) {
      const [value] = numbers([typeof map[member] === 'number' ? map[member] : NaN], member, 1)
      if (!value) continue
      lines.push(`${member} ${value}`)
      items.push(member)
    }
  return { text: lines.join('\n') + '\n', items }
}

/** An object of walls and all else as map text. */
export function mapText(map) {
  return fromObject(map).text
}

/** The text of a map, its name in messages, and for an object the items by line. @internal */
mapText.prepare = function (map, given = undefined) {
  if (given !== undefined) textOf('name', given)
  if (typeof map === 'string' || map instanceof ArrayBuffer || ArrayBuffer.isView(map)) {
    const text = typeof map === 'string' ? map : bytesOf(map)
    const bytes = typeof map === 'string' ? map : new TextDecoder().decode(text.slice(0, 4096))
    const lines = bytes.slice(0, 4096).split('\n')
    const isPlan = !lines.some((line) => /^\uFEFF?\s*sightline\b/.test(line)) &&
      /^[#.+@ \t\r]+$/.test(lines[0])
    return { text, name: given ?? (isPlan ? 'map.txt' : 'map') }
  }
  return { ...fromObject(map), name: given ?? 'map' }
}

/**
 * A message of the library, with its line; and for a map from an object with its item.
 *
 * @param {string} message
 * @param {string[]} [items]
 */
export function rename(message, items) {
  const plain = message.replace(/ \(read as map text: .*\)$/, '')
  const foreign = plain.includes('as the first statement')
  const text = foreign ? `${plain} (bake Tiled files and other formats with the sightline command)` : plain
  const found = /^([^:]*):(\d+): /.exec(text)
  if (!found) return { text, line: 0, item: '' }
  const line = Number(found[2])
  if (!items?.[line]) return { text, line, item: '' }
  return { text: `${items[line]}: ${text.slice(found[0].length)}`, line: 0, item: items[line] }
}
