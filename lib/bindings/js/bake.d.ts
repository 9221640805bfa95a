/** The whole library: bakes maps and answers about them. */
import type { Bounds, Cell, DirectedPortal, Door, Point, Segment, Start, View } from './sightline.js'
import type { RegionMeasures } from './measures.js'
import { SightlineError } from './sightline.js'

export { SightlineError }

type Line = Segment | number[] | { segment: Segment | number[] }
type Polygon = number[] | [number, number][]

/**
 * What walls stop; by default all. Windows are seen through, curtains are walked through. Of limited walls sight passes
 * one, not two.
 */
type Stopped = 'sight' | 'limited' | 'steps' | 'sound'
type Stops = { stops?: Stopped | Stopped[] }

/** A map as an object. All members may be left out but for walls. */
export interface MapObject {
  walls: (Line & { solid?: boolean } & Stops)[]
  doors?: { name: string; segment: Segment | number[]; open?: boolean; kind?: 'door' | 'breakable' | 'site' }[]
  mirrors?: (Line & { oneSided?: boolean })[]
  /** Seen through from the right to the left, going from the first end to the second. */
  oneway?: Line[]
  seams?: Line[]
  solid?: (Polygon | ({ points: Polygon } & Stops))[]
  open?: Polygon[]
  starts?: (Start | { x: number; y: number } | number[])[]
  paths?: { name: string; points: Polygon }[]
  objects?: { name: string; box: number[] }[]
  cells?: Polygon[]
  range?: number
  /** How wide openings to the outside are at most: it says what is inside if there is no start. */
  entrance?: number
  snap?: number
}

/** Map text, an ASCII plan, the bytes of either, the bytes of a .slv, or an object. */
export type MapInput = string | ArrayBuffer | ArrayBufferView | MapObject

export interface BakeOptions {
  method?: 'sweep' | 'dfs' | 'prune' | 'multipass' | 'sampling' | 'flood' | (string & {})
  subdivide?: 'kd' | 'mesh' | 'given'
  sight?: 'closed' | 'open'
  /** Look from inside cells only. */
  insideOnly?: boolean
  stabTrees?: boolean
  check?: boolean
  weld?: number
  mirrorDepth?: number
  doorLimit?: number
  samples?: number
  seed?: number
  /** How wide openings to the outside are at most; by default, and for 0, as the map says. */
  entrance?: number
  /** One more start: inside is all that starts reach. */
  start?: { x: number; y: number } | [number, number]
  /** Which walls count: those that stop this; 'sight' by default. */
  stops?: 'sight' | 'steps' | 'sound'
  /** Effects of the map that are left out. */
  without?: ('door' | 'mirror' | 'oneway' | 'range')[]
  /** The name of the map in messages; with the ending .txt it is an ASCII plan. */
  name?: string
  /** Return false to stop. */
  progress?: (stage: string, done: number, total: number) => boolean | void
  /** Seconds after which to stop with an error. */
  timeLimit?: number
}

export interface ExplainOptions {
  /** Sequences to tell of a hidden pair; 3 by default. */
  misses?: number
  /** Stabbing tests after which to give up; 0 for no limit. */
  tests?: number
  mirrorDepth?: number
}

/** The JSON of `sightline explain`. */
export interface Explanation {
  from: number
  to: number
  seen: boolean
  verdict: 'hidden' | 'grazing' | 'stabbed'
  complete: boolean
  /** Portals on the shortest way; null where there is none. */
  distance: number | null
  sequence?: DirectedPortal[]
  /** A line through the sequence. */
  line?: Segment
  /** The part of it to be drawn. */
  shown?: Segment
  misses: {
    sequence: DirectedPortal[]
    stopped_by: DirectedPortal
    reason: 'conflict' | 'turn'
    missing: number
    ends: { portal: number; side: 'left' | 'right'; point: [number, number] }[]
  }[]
  [member: string]: unknown
}

export type Edge = 'wall' | 'border' | 'occluding' | 'cone' | 'mirror' | 'arc'

export interface Region {
  cell: number
  /** x, y ... counter-clockwise; edge i leads from point i to the next one. */
  points: Float64Array
  /** The same with arcs as chords. */
  polygon: Float64Array
  edges: Edge[]
  /** The wall of each edge; -1 for none. */
  walls: number[]
}

/** A region with the measures of depthmapX. */
export interface Isovist extends Region, RegionMeasures {}

export interface Fault {
  kind: 'leak' | 'gap' | 'overlap' | 'crossing' | 'thin' | 'unreachable'
  at: Segment
  size: number
  /** Lines of the walls at it; for an object its items. */
  lines: number[]
  items?: string[]
  cell: number | null
  cells: number
  needsDecision: boolean
  /** Of a leak: the way to it, x, y ... */
  way: number[]
}

export interface Faults {
  /** Whether it is in doubt what is inside; 'opening': an opening is a little wider than entrances. */
  doubt: 'sure' | 'leaks' | 'small' | 'few' | 'none' | 'opening'
  /** The same for people; '' where it is plain. */
  said: string
  /** Shares of the area. */
  inside: number
  outside: number
  solid: number
  welded: number
  faults: Fault[]
}

export interface Step {
  kind: 'enter' | 'backwards' | 'hidden' | 'leave'
  directed: number
  cell: number
  parent: number
  depth: number
  node: number
  seen: number
  first: boolean
  grazing: boolean
}

/** An open map. Members that are arrays are views: they hold until the next call. */
export class Scene {
  private constructor()
  readonly bounds: Bounds
  readonly range: number
  readonly cellCount: number
  readonly portalCount: number
  readonly wallCount: number
  readonly insideCount: number
  readonly sight: 'closed' | 'open'
  readonly guarantee: 'exact' | 'conservative' | 'aggressive' | 'rounded'
  readonly method: string
  /** x, y ... of all cells. */
  readonly vertices: Float64Array
  /** Six numbers a cell: first vertex, vertices, first directed portal, directed portals, inside, solid. */
  readonly cellTable: Uint32Array
  /** Five numbers a portal; the last four are its left and right end. */
  readonly portalEnds: Float64Array
  /** Ten integers a portal; the first two are its cells. */
  readonly portalCells: Uint32Array
  /** As portalEnds, of directed portals. */
  readonly directedEnds: Float64Array
  /** Ten integers a directed portal; the first two are its portal and the cell behind it. */
  readonly directedCells: Uint32Array
  /** Five numbers a wall; the first four are its ends. */
  readonly wallEnds: Float64Array
  /** Ten integers a wall; the ninth is its line. */
  readonly wallLines: Uint32Array
  readonly nodes: { position: number; axis: number; below: number; above: number }[]
  readonly root: number
  readonly starts: Start[]
  readonly doors: Door[]
  readonly mirrors: { segment: Segment; oneSided: boolean }[]
  readonly oneway: { segment: Segment; oneSided: boolean }[]
  readonly account: {
    cleaning: { before: number; after: number; welded: number; split: number; crossings: number; largestMove: number; tolerance: number }
    seconds: { clean: number; subdivide: number; check: number; see: number }
    pairs: number
    tests: number
    nodes: number
    pieces: number
    deepest: number
  }
  /** A view. */
  corners(cell: number): Float64Array
  cell(cell: number): Cell
  directed(number: number): DirectedPortal
  wall(number: number): { segment: Segment; line: number; item: string }
  setDoor(name: string, open: boolean): void
  /** What is inside, for people, where that is not plain: what is in doubt, or which openings count as entrances. */
  insideText(): string
  locate(x: number, y: number): number
  row(cell: number): Uint32Array
  mirroredRow(cell: number): Uint32Array
  canSee(a: number, b: number): boolean
  canSee(a: Point, b: Point, options?: { range?: number }): boolean
  look(x: number, y: number, options?: View & { method?: string; mirrored?: boolean }): Uint32Array
  visiblePolygon(x: number, y: number, options?: View & { tolerance?: number }): Float64Array
  isovist(x: number, y: number, options?: View & { tolerance?: number }): Isovist
  mirroredParts(x: number, y: number, options?: View & { depth?: number; tolerance?: number }):
    (Region & { mirror: number; parent: number; depth: number; image: Float64Array })[]
  explain(a: number | Point, b: number | Point, options?: ExplainOptions): Explanation
  steps(cell: number | Point, options?: { most?: number }): { steps: Step[]; complete: boolean }
  stabTree(cell: number | Point, options?: { most?: number }):
    { nodes: { parent: number; cell: number; directed: number; depth: number; grazing: boolean }[]; complete: boolean }
  slv(): Uint8Array
  describe(): any
  export(format: 'json' | 'geojson' | 'csv', options?: { version?: number }): string
  close(): void
}

/** [left x, left y, right x, right y] as crossed. */
export type PortalEnds = [number, number, number, number]

/** A loaded module: the same calls without promises. */
export class Core {
  private constructor()
  readonly version: string
  /** The measures of an isovist. Its members have these names in camel case. */
  readonly measures: readonly string[]
  /** Bakes a map, or opens a .slv, and keeps it. Close the scene. */
  open(map: MapInput, options?: BakeOptions): Scene
  bake(map: MapInput, options?: BakeOptions): Uint8Array
  describe(map: MapInput, options?: BakeOptions): any
  explain(map: MapInput, a: number | Point, b: number | Point, options?: BakeOptions & ExplainOptions): Explanation
  isovist(map: MapInput, x: number, y: number, options?: BakeOptions & View): Isovist
  check(map: MapInput, options?: BakeOptions & { gap?: number; thin?: number }): Faults
  writeMap(map: MapInput, options?: BakeOptions & { format?: 'text' | 'plan' }): string
  eye(scene: Scene, x: number, y: number, options?: View & { method?: string; mirrored?: boolean }): Uint32Array
  stabTree(scene: Scene, cell: number | Point, options?: { most?: number }): ReturnType<Scene['stabTree']>
  dual(portals: PortalEnds[], options?: { cutting?: number }): {
    origin: [number, number]
    along: [number, number]
    scale: number
    best: { slope: number; height: number }
    margin: number
    corners: Float64Array
  }
  conflict(portals: PortalEnds[]): {
    verdict: 'hidden' | 'grazing' | 'stabbed'
    turns: boolean
    ends: { portal: number; side: 'left' | 'right' }[]
  }
}

/** Loads the module. `memory`: the most bytes that it may take, 4 GiB by default. */
export function load(options?: { memory?: number }): Promise<Core>
/** An object as map text. */
export function mapText(map: MapObject): string
/** The bytes of the baked file. */
export function bake(map: MapInput, options?: BakeOptions): Promise<Uint8Array>
/** The JSON export, version 2, as an object. */
export function describe(map: MapInput, options?: BakeOptions): Promise<any>
export function explain(map: MapInput, a: number | Point, b: number | Point, options?: BakeOptions & ExplainOptions): Promise<Explanation>
export function isovist(map: MapInput, x: number, y: number, options?: BakeOptions & View): Promise<Isovist>
export function check(map: MapInput, options?: BakeOptions & { gap?: number; thin?: number }): Promise<Faults>
export function query(map: MapInput, options?: BakeOptions): Promise<Scene>
