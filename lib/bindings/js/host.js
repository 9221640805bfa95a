/**
 * What both halves of the package share: the error, loading a module, text in its memory.
 */

/** What the package throws: a message, the line of the map (0 for none) and a code. */
export class SightlineError extends Error {
  /**
   * @param {string} message
   * @param {{line?: number, item?: string, code?: string}} [where]
   */
  constructor(message, { line = 0, item = '', code = 'bad argument' } = {}) {
    super(message)
    this.name = 'SightlineError'
    this.line = line
    this.item = item
    this.code = code
  }
}

/** @type {Map<string, Promise<WebAssembly.Module>>} */
const modules = new Map()

/**
 * Compiles a module of the package once.
 *
 * @param {string} name
 * @param {URL} address
 */
export function compile(name, address) {
  if (typeof WebAssembly !== 'object')
    return Promise.reject(new SightlineError('WebAssembly is not there', { code: 'unsupported' }))
  let module = modules.get(name)
  if (!module) {
    module = compileFrom(address)
    modules.set(name, module)
    module.catch(() => modules.delete(name))
  }
  return module
}

/** @param {URL} address */
async function compileFrom(address) {
  if (address.protocol === 'file:' && typeof process === 'object') {
    // By a name that bundlers do not follow: no page has this module.
    const { readFile } = await import(/* @vite-ignore */ ['node:fs', 'promises'].join('/'))
    return WebAssembly.compile(await readFile(address))
  }
  const answer = await fetch(address)
  if (!answer.ok) throw new SightlineError(`${address}: ${answer.status}`, { code: 'input/output error' })
  // Some file servers do not know the type that compileStreaming() asks for.
  return WebAssembly.compile(await answer.arrayBuffer())
}

const decoder = new TextDecoder()

/**
 * The text at a place in memory, up to a 0 or of a given length.
 *
 * @param {WebAssembly.Memory} memory
 * @param {number} at
 * @param {number} [length]
 */
export function textAt(memory, at, length) {
  const bytes = new Uint8Array(memory.buffer)
  return decoder.decode(bytes.slice(at, length === undefined ? bytes.indexOf(0, at) : at + length))
}

/**
 * Bytes that a caller gave, as an array.
 *
 * @param {ArrayBuffer | ArrayBufferView} bytes
 */
export function bytesOf(bytes) {
  if (bytes instanceof Uint8Array) return bytes
  if (ArrayBuffer.isView(bytes)) return new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength)
  if (bytes instanceof ArrayBuffer) return new Uint8Array(bytes)
  throw new SightlineError('bytes: an ArrayBuffer or a Uint8Array is needed')
}

/**
 * The unit vector of an angle in degrees; exact along the axes.
 *
 * @param {number} degrees
 * @returns {[number, number]}
 */
export function direction(degrees) {
  const turn = ((degrees % 360) + 360) % 360
  if (turn % 90 === 0) return [[1, 0], [0, 1], [-1, 0], [0, -1]][turn / 90]
  const angle = (turn * Math.PI) / 180
  return [Math.cos(angle), Math.sin(angle)]
}
