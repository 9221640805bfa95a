// The rules of the small game of fort.html: fort.c in JavaScript. A Level of the npm package is all they need.
//
// Who stands closer to a wall than his radius is not asked for here: a step is free if its middle line is, and so are
// the two lines beside it.

const RADIUS = 0.3, PACE = 0.15, GUARD_PACE = 0.06, REACH = 1.2
export const PLAYER_RANGE = 10, GUARD_RANGE = 9, CONE = 120
const SETTLE_PORTALS = 10000 // in a frame: about a millisecond

const distance = ([x0, y0, x1, y1], x, y) => {
  const ax = x1 - x0, ay = y1 - y0
  const t = Math.min(1, Math.max(0, ((x - x0) * ax + (y - y0) * ay) / (ax * ax + ay * ay)))
  return Math.hypot(x0 + t * ax - x, y0 + t * ay - y)
}

export class Game {
  frame = 0
  /** What happened: "12: plaster breaks". */
  events = []

  /** `rounds`: of each guard, places [x, y] that it walks to in turn. */
  constructor(level, rounds) {
    this.level = level
    const { x, y } = level.starts[0]
    Object.assign(this, { x, y })
    this.guards = rounds.map((round) => ({ x: round[0][0], y: round[0][1], heading: 0, round, next: 0, sees: false }))
  }

  #say(what) {
    this.events.push(`${this.frame}: ${what}`)
  }

  #isFree(x, y, toX, toY) {
    const length = Math.hypot(toX - x, toY - y), u = (toX - x) / length, v = (toY - y) / length
    return [-1, 0, 1].every((side) => {
      const beside = side * RADIUS, ahead = Math.sqrt(RADIUS * RADIUS - beside * beside)
      const from = [x - beside * v, y + beside * u]
      return this.level.canWalk(from, [toX - beside * v + ahead * u, toY + beside * u + ahead * v])
    })
  }

  /** Along x and along y, as far as that is free: so he slides along walls. */
  #walk(who, stepX, stepY) {
    if (stepX && this.#isFree(who.x, who.y, who.x + stepX, who.y)) who.x += stepX
    if (stepY && this.#isFree(who.x, who.y, who.x, who.y + stepY)) who.y += stepY
  }

  /** Opens, shuts, breaks or builds the nearest thing in reach that can be. Nobody may stand in it. */
  #act() {
    const far = (door, { x, y }) => Math.min(...door.segments.map((segment) => distance(segment, x, y)))
    const done = ({ kind, open }) => kind === (open ? 'breakable' : 'site')
    const near = this.level.doors.filter((door) => !done(door) && far(door, this) <= REACH)
    const [door] = near.sort((a, b) => far(a, this) - far(b, this))
    if (!door || (door.open && [this, ...this.guards].some((who) => far(door, who) <= RADIUS))) return
    this.level.setDoor(door.name, !door.open)
    const verbs = { door: ['opens', 'shuts'], breakable: ['breaks'], site: ['', 'is built'] }
    this.#say(`${door.name} ${verbs[door.kind][+door.open]}`)
  }

  /** The rows say no at once for most; the cone and the exact answer say the rest. */
  #sees(guard) {
    const { level, x, y } = this
    const turn = Math.abs(((Math.atan2(y - guard.y, x - guard.x) * 180) / Math.PI - guard.heading + 540) % 360 - 180)
    return level.canSee(level.locate(guard.x, guard.y), level.locate(x, y)) && turn <= CONE / 2 &&
      Math.hypot(x - guard.x, y - guard.y) <= GUARD_RANGE && level.canSee(guard, this)
  }

  #patrol(guard) {
    const [toX, toY] = guard.round[guard.next]
    const x = toX - guard.x, y = toY - guard.y, length = Math.hypot(x, y), step = Math.min(GUARD_PACE, length)
    if (length < GUARD_PACE) guard.next = (guard.next + 1) % guard.round.length
    if (!length) return
    guard.heading = (Math.atan2(y, x) * 180) / Math.PI
    this.#walk(guard, (step * x) / length, (step * y) / length)
  }

  /** A frame: the direction in which the player walks, and whether he acts. */
  step(x, y, acts) {
    this.frame++
    this.#walk(this, PACE * x, PACE * y)
    if (acts) this.#act()
    this.guards.forEach((guard, i) => {
      if (!guard.sees) this.#patrol(guard)
      const sees = this.#sees(guard)
      if (sees !== guard.sees) this.#say(`guard ${i} ${sees ? 'sees' : 'loses'} you`)
      guard.sees = sees
    })
    this.level.settle(SETTLE_PORTALS)
  }

  /** Plays keys, a frame for each: w a s d, e to act, others to wait. */
  play(keys) {
    for (const key of keys) this.step((key === 'd') - (key === 'a'), (key === 'w') - (key === 's'), key === 'e')
  }
}
