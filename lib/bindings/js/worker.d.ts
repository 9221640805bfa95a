/** Modules of the package in workers, so that long work does not stop the page. */
import { SightlineError } from './sightline.js'

export { SightlineError }

export interface Modules {
  sightline: typeof import('./sightline.js')
  bake: typeof import('./bake.js')
  cameras: typeof import('./cameras.js')
  explored: typeof import('./explored.js')
  graph: typeof import('./graph.js')
  place: typeof import('./place.js')
  ways: typeof import('./ways.js')
  world: typeof import('./world.js')
}

/** What a call gives: an object with methods stays in the worker. */
export type Answer<T> = T extends object
  ? T extends readonly unknown[] | ArrayBufferView | ArrayBuffer ? T
    : Extract<T[keyof T], (...list: never[]) => unknown> extends never ? T : Far<T>
  : T

/** Calls and properties of an object in the worker, each as a function that gives a promise. */
export type Far<T> = {
  readonly [name in keyof T]: T[name] extends (...list: infer List) => infer Result
    ? (...list: List) => Promise<Answer<Awaited<Result>>>
    : () => Promise<T[name]>
}

/**
 * Loads a module in a new worker. Arguments and answers are copied, and what cannot be copied stays
 * there: `await floor.path(a, b)`, `await graph.count()`. `progress` of options is called, but what it
 * returns is not heard. terminate() ends the worker at once; calls that wait fail as 'interrupted'.
 */
export function inWorker<Name extends keyof Modules>(module: Name): Promise<Far<Modules[Name]> & { terminate(): void }>
