/**
 * A module of the package in a worker of its own, so that long work does not stop the page.
 *
 * Both ends are this file. A call goes over as a message: an object of the worker by its number, the
 * name of what is called, and the arguments. What can be copied comes back as it is. Anything else,
 * such as an open floor, stays in the worker, and its number comes back.
 */
import { SightlineError } from './host.js'

export { SightlineError }

const MODULES = ['sightline', 'bake', 'cameras', 'explored', 'graph', 'place', 'ways', 'world']
const START = 'sightline-worker'

const threads = () => import(/* @vite-ignore */ ['node:worker', 'threads'].join('_'))
const inNode = typeof Worker === 'undefined' && typeof process === 'object'

/** Whether a message can hold a value: neither a function nor an object with methods. */
function isPlain(value) {
  if (typeof value !== 'object' || value === null) return typeof value !== 'function'
  if (ArrayBuffer.isView(value) || value instanceof ArrayBuffer) return true
  if (Array.isArray(value)) return value.every(isPlain)
  const kind = Object.getPrototypeOf(value)
  return (kind === Object.prototype || kind === null) && Object.values(value).every(isPlain)
}

// --- in the worker

/** Answers messages: { module } first, then { id, at, name, list, progress }. */
function serve(post, listen) {
  const kept = new Map()
  let next = 1, ready
  const answer = async ({ id, module, at, name, list, progress }) => {
    if (module) return (ready = import(`./${module}.js`).then((all) => kept.set(0, all)))
    await ready
    const target = kept.get(at)
    if (!target) throw new SightlineError('the object is closed')
    const hear = (...values) => post({ id, progress: values })
    const given = list.map((value, i) => (i === progress ? { ...value, progress: hear } : value))
    const what = target[name]
    if (what === undefined) throw new SightlineError(`there is no '${name}'`)
    const result = await (typeof what === 'function' ? what.apply(target, given) : what)
    if (name === 'close' && at) kept.delete(at)
    if (isPlain(result)) return { result }
    kept.set(next, result)
    return { kept: next++ }
  }
  listen((data) => {
    answer(data).then(
      (back) => data.id && post({ id: data.id, ...back }),
      ({ message, line, item, code }) => data.id && post({ id: data.id, error: { message, line, item, code } }),
    )
  })
}

// --- in the page

class Remote {
  #waiting = new Map()
  #next = 1
  #worker
  #gone

  async start(module) {
    const file = new URL('./worker.js', import.meta.url)
    if (inNode) {
      this.#worker = new (await threads()).Worker(file, { workerData: START })
      this.#worker.on('message', (data) => this.#receive(data))
      this.#worker.on('error', (error) => this.stop(error.message))
    } else {
      this.#worker = new Worker(file, { type: 'module', name: START })
      this.#worker.onmessage = ({ data }) => this.#receive(data)
      this.#worker.onerror = (event) => this.stop(event.message)
    }
    this.#worker.postMessage({ module })
  }

  #receive({ id, progress, error, result, kept }) {
    const call = this.#waiting.get(id)
    if (progress) return call?.hear(...progress)
    this.#waiting.delete(id)
    if (error) call?.reject(new SightlineError(error.message, error))
    else call?.resolve(kept ? this.object(kept) : result)
  }

  /** What is kept in the worker at a place: each property is a function that gives a promise. */
  object(at) {
    return new Proxy({}, {
      get: (none, name) => {
        if (typeof name === 'symbol' || name === 'then') return undefined
        if (name === 'terminate' && !at) return () => this.stop('the worker was ended')
        return (...list) => this.#call(at, name, list)
      },
    })
  }

  #call(at, name, list) {
    return new Promise((resolve, reject) => {
      if (this.#gone) throw new SightlineError(this.#gone, { code: 'interrupted' })
      const id = this.#next++, progress = list.findIndex((value) => typeof value?.progress === 'function')
      const hear = list[progress]?.progress
      const sent = list.map((value, i) => (i === progress ? { ...value, progress: undefined } : value))
      this.#worker.postMessage({ id, at, name, list: sent, progress })
      this.#waiting.set(id, { resolve, reject, hear })
    })
  }

  /** Ends the worker. Those who wait are told why. */
  stop(why) {
    this.#gone = why
    this.#worker.terminate()
    for (const { reject } of this.#waiting.values()) reject(new SightlineError(why, { code: 'interrupted' }))
    this.#waiting.clear()
  }
}

/**
 * Loads a module of the package in a new worker.
 *
 * @param {string} module
 */
export async function inWorker(module) {
  if (!MODULES.includes(module)) throw new SightlineError(`there is no module '${module}': ${MODULES.join(', ')}`)
  const remote = new Remote()
  await remote.start(module)
  return remote.object(0)
}

if (inNode) {
  const { isMainThread, parentPort, workerData } = await threads()
  if (!isMainThread && workerData === START)
    serve((data) => parentPort.postMessage(data), (hear) => parentPort.on('message', hear))
} else if (typeof document === 'undefined' && globalThis.name === START) {
  serve((data) => globalThis.postMessage(data), (hear) => { globalThis.onmessage = ({ data }) => hear(data) })
}
