/**
 * Arguments that callers give: one checked conversion for each kind, which all calls use. What is no
 * such thing is refused with a SightlineError that names it. Nothing is converted by chance: 'shut'
 * is not true, '1' is no number, and 0.5 is no cell. In options, undefined and null mean: not given.
 */
import { SightlineError } from './host.js'

/** The value, if it is right. Texts that say what is needed are put together only where it is not. */
export function need(right, name, what, value) {
  if (right) return value
  const shown = value && typeof value === 'object' ? 'an object' : String(value).slice(0, 40)
  throw new SightlineError(`${name}: ${what} is needed, not ${typeof value === 'string' ? `'${shown}'` : shown}`)
}

const isList = (value) => Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView))

/** A finite number, of `least` or more. */
export const numberOf = (name, value, least = -Infinity) =>
  Number.isFinite(value) && value >= least ? value : need(false, name, least > -Infinity ? `a number, ${least} or more,` : 'a number', value)

/** A whole number from 0 to `most`. */
export const wholeOf = (name, value, most) =>
  Number.isInteger(value) && value >= 0 && value <= most ? value : need(false, name, `a whole number, 0 to ${most},`, value)

/** The number of one of `count` things of a kind. */
export const indexOf = (kind, value, count) => wholeOf(kind, value, count - 1)

/** True or false. */
export const flagOf = (name, value) => need(typeof value === 'boolean', name, 'true or false', value)

export const textOf = (name, value) => need(typeof value === 'string', name, 'a text', value)

/** The items of a list; typed arrays are lists too. */
export const listOf = (name, value) => Array.from(need(isList(value), name, 'a list', value))

/** An object that is no list. */
export const objectOf = (name, value) =>
  need(value && typeof value === 'object' && !Array.isArray(value) && !ArrayBuffer.isView(value), name, 'an object', value)

/** A point as x and y: { x, y } or [x, y]. */
export function pointOf(call, point) {
  const at = Array.isArray(point) ? point : [point?.x, point?.y]
  return need(at.length === 2 && at.every(Number.isFinite), call, 'a point { x, y } or [x, y]', at)
}

/** Options, if all of them are known. Those that are null are left out. */
export function optionsOf(options, ...known) {
  if ((options ?? null) === null) return {}
  const found = {}
  for (const name of Object.keys(objectOf('options', options))) {
    if (!known.includes(name)) throw new SightlineError(`there is no option '${name}'`)
    if ((options[name] ?? null) !== null) found[name] = options[name]
  }
  return found
}

/** Some of the options, for a call that gets those of two calls. */
export const pick = (options, ...names) =>
  Object.fromEntries(names.filter((name) => options?.[name] !== undefined).map((name) => [name, options[name]]))

/** What is not given is below 0 for the module; else it is checked. */
export const given = (value, check) => (value === undefined ? -1 : check(value))

/** A view as heading and width in degrees; all round without a heading. */
export function viewOf({ heading, range, fov = heading === undefined ? 360 : 90 }) {
  numberOf('fov', fov, 0)
  if (heading === undefined && fov < 360) throw new SightlineError('fov: a heading is needed, too')
  numberOf('heading', heading ?? 0)
  return { heading: heading ?? 0, fov, range: given(range, (value) => numberOf('range', value, 0)) }
}
