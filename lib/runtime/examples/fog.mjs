// Fog of war in JavaScript: what an eye sees of a level, with doors opened and shut by name.
//
//     sightline export LEVEL.slv --format json -o LEVEL.json
//     node fog.mjs LEVEL.json PICTURE.svg X Y [open NAME | shut NAME]...
//
// It prints and draws what fog.c does, from the JSON export, without packages.
//
// The view spreads from the eye's cell through portals. Behind a portal it is a sector between two
// directions, which each further portal narrows. A wall or a shut door ends it, and its part in the
// sector is an edge of the polygon. An eye on a border looks from all cells there that open portals at
// the eye join with its own. It counts in doubles: an eye in line with two corners may see a cell more
// or less than by the exact answer, and none that it only touches.
import { readFileSync, writeFileSync } from "node:fs";

const to = (a, b) => [b[0] - a[0], b[1] - a[1]];
const cross = (u, v) => u[0] * v[1] - u[1] * v[0];
const dot = (u, v) => u[0] * v[0] + u[1] * v[1];
const same = (a, b) => a[0] === b[0] && a[1] === b[1];

/** Whether a point is on the line from a to b, but for rounding. */
const isOn = (a, b, point) =>
  Math.abs(cross(to(a, b), to(a, point))) <= 1e-9 * dot(to(a, b), to(a, b));

/** Whether a point is on the segment from a to b. */
const touches = (a, b, point) =>
  cross(to(point, a), to(point, b)) === 0 && dot(to(point, a), to(point, b)) <= 0;

/** The boundary of a cell, counter-clockwise: walls { a, b } and portals { a, b, portal }. */
function boundary(corners, portals) {
  return corners.flatMap((a, i) => {
    const b = corners[(i + 1) % corners.length], pieces = [];
    const middle = (p) => [(p.a[0] + p.b[0]) / 2, (p.a[1] + p.b[1]) / 2];
    const place = (p) => dot(to(a, b), to(a, middle(p))) / dot(to(a, b), to(a, b));
    const here = portals.filter((p) => isOn(a, b, p.a) && isOn(a, b, p.b) && place(p) > 0 && place(p) < 1);
    let at = a;
    for (const p of here.sort((p, q) => place(p) - place(q))) {
      pieces.push({ a: at, b: p.a }, p);
      at = p.b;
    }
    return [...pieces, { a: at, b }].filter((piece) => !same(piece.a, piece.b));
  });
}

class Level {
  constructor(data) {
    if (data.format !== "sightline" || data.version !== 2) throw Error("not a JSON export of version 2");
    if (data.range !== null) throw Error("the level has a view range, which this example does not draw");
    this.data = data;
    this.doors = data.doors ?? [];
    this.shut = new Set(this.doors.filter((door) => !door.open).map((door) => door.name));
    this.needs = new Map((data.door_sets ?? []).map((item) => [item.cells.join(), item.needs]));
    const portals = data.cells.map(() => []);
    for (const portal of data.portals) {
      const left = portal.segment.slice(0, 2), right = portal.segment.slice(2);
      portals[portal.cells[0]].push({ a: right, b: left, portal });
      portals[portal.cells[1]].push({ a: left, b: right, portal });
    }
    this.isAxial = data.cells.every(({ polygon }) =>
      polygon.every((a, i) => a[0] === polygon.at(i - 1)[0] || a[1] === polygon.at(i - 1)[1]));
    this.pieces = data.cells.map((cell) => boundary(cell.polygon, portals[cell.id]));
  }

  setDoor(state, name) {
    if (state !== "open" && state !== "shut") throw Error(`${state} is neither open nor shut`);
    if (!this.doors.some((door) => door.name === name)) throw Error(`there is no door ${name}`);
    if (state === "shut") this.shut.add(name);
    else this.shut.delete(name);
  }

  /**
   * The cell of the eye, as the runtime header has it: one that is not solid, if the eye is on its
   * border. If all cells are boxes, the one over the eye and right of it comes first.
   */
  locate(eye) {
    const holds = (pieces) => pieces.every(({ a, b }) => cross(to(a, b), to(a, eye)) >= 0);
    const rank = (cell) => {
      const { polygon, solid } = this.data.cells[cell];
      const ends = [0, 1].map((axis) => Math.max(...polygon.map((corner) => corner[axis])) <= eye[axis]);
      return 4 * !!solid + (this.isAxial ? 2 * ends[1] + ends[0] : 0);
    };
    const here = [...this.pieces.keys()].filter((cell) => holds(this.pieces[cell]));
    if (!here.length) throw Error("the eye is outside");
    return here.sort((a, b) => rank(a) - rank(b) || a - b)[0];
  }

  /** The eye's cell, and those that open portals at the eye join with it. */
  around(eye) {
    const cells = new Set([this.locate(eye)]);
    for (const cell of cells)
      for (const { a, b, portal } of this.pieces[cell])
        if (portal && touches(a, b, eye) && this.isOpen(portal, cell)) portal.cells.forEach((next) => cells.add(next));
    return cells;
  }

  /** What the cell sees past the doors, by the visible sets. */
  row(cell) {
    return this.data.pvs[cell].filter((other) => {
      const needs = this.needs.get([cell, other].join());
      return !needs || needs.some((doors) => !doors.some((door) => this.shut.has(door)));
    });
  }

  isOpen(portal, cell) {
    const [a, b] = portal.cells;
    const ways = { from: [a], to: [b], none: [] }[portal.oneway] ?? portal.cells;
    return !this.shut.has(portal.door) && ways.includes(cell);
  }

  /** The cells that the eye sees, and the ends of the polygon's edges, counter-clockwise. */
  look(eye) {
    const seen = new Set(), edges = [];
    const meet = (direction, a, b) => {
      const share = cross(to(eye, a), to(a, b)) / cross(direction, to(a, b));
      return [eye[0] + share * direction[0], eye[1] + share * direction[1]];
    };
    const spread = (cell, pieces, right, left) => {
      seen.add(cell);
      for (const { a, b, portal } of pieces) {
        const fromA = to(eye, a), toB = to(eye, b);
        const cutRight = right && cross(right, fromA) < 0, cutLeft = left && cross(toB, left) < 0;
        if (cross(fromA, toB) <= 0 || (cutRight && cross(right, toB) <= 0) || (cutLeft && cross(fromA, left) <= 0)) continue;
        if (portal && this.isOpen(portal, cell)) {
          const ahead = portal.cells[portal.cells[0] === cell ? 1 : 0], around = this.pieces[ahead];
          const entry = around.findIndex((piece) => piece.portal === portal);
          spread(ahead, [...around.slice(entry + 1), ...around.slice(0, entry)],
            cutRight ? right : fromA, cutLeft ? left : toB);
        } else {
          edges.push([cutRight ? meet(right, a, b) : a, cutLeft ? meet(left, a, b) : b]);
        }
      }
    };
    const direction = ([a, b]) => Math.atan2(a[1] + b[1] - 2 * eye[1], a[0] + b[0] - 2 * eye[0]);
    for (const cell of this.around(eye))
      if (!this.data.cells[cell].solid) spread(cell, this.pieces[cell], null, null);
    edges.sort((a, b) => direction(a) - direction(b));
    const ends = edges.flatMap(([a, b], i) => {
      const u = to(eye, b), v = to(eye, edges[(i + 1) % edges.length][0]);
      const inLine = Math.abs(cross(u, v)) <= 1e-9 * dot(u, v);
      return inLine ? [a, b] : [a, b, eye]; // the eye is on a wall
    });
    return { seen: [...seen].sort((a, b) => a - b), ends };
  }
}

/** The corners of a polygon, without those in line with their neighbours, but for the eye. */
function cornersOf(points, eye) {
  for (let before = -1; points.length !== before;) {
    before = points.length;
    points = points.filter((b, i) => !same(points.at(i - 1), b));
    points = points.filter((b, i) => b === eye || !isOn(points.at(i - 1), points[(i + 1) % points.length], b));
  }
  return points;
}

function picture(level, eye, points) {
  const [left, low, right, high] = level.data.bounds;
  const polygon = (corners, style) => `<polygon points='${corners.map(([x, y]) => `${x},${-y}`).join(" ")}' ${style}/>`;
  const line = (s, colour) => `<line x1='${s[0]}' y1='${-s[1]}' x2='${s[2]}' y2='${-s[3]}' stroke='${colour}'/>`;
  return [
    `<svg xmlns='http://www.w3.org/2000/svg' viewBox='${left} ${-high} ${right - left} ${high - low}' ` +
      `stroke-width='${(right - left) / 300}'>`,
    ...level.data.cells.map((cell) => polygon(cell.polygon, cell.solid ? "fill='#000'" : "fill='#777' stroke='#000'")),
    ...level.data.portals.map((portal) => line(portal.segment, "#777")),
    polygon(points, "fill='#fe9'"),
    ...level.doors.flatMap((door) => door.segments.map((at) => line(at, level.shut.has(door.name) ? "red" : "green"))),
    `<circle cx='${eye[0]}' cy='${-eye[1]}' r='${(right - left) / 150}'/>`, "</svg>", "",
  ].join("\n");
}

const [path, picturePath, x, y, ...doors] = process.argv.slice(2);
try {
  if (y === undefined || doors.length % 2) throw Error("usage: LEVEL.json PICTURE.svg X Y [open NAME | shut NAME]...");
  const level = new Level(JSON.parse(readFileSync(path, "utf8")));
  if (level.data.mirrors?.length) console.error("note: mirrors are walls here");
  for (let i = 0; i < doors.length; i += 2) level.setDoor(doors[i], doors[i + 1]);
  const eye = [Number(x), Number(y)], cell = level.locate(eye), { seen, ends } = level.look(eye);
  const points = cornersOf(ends, eye);
  console.log(["cell", cell].join(" "));
  console.log(["row", ...level.row(cell)].join(" "));
  console.log(["seen", ...seen].join(" "));
  console.log([`points ${points.length}`, ...points.map((point) => point.join(" "))].join("\n"));
  writeFileSync(picturePath, picture(level, eye, points));
} catch (error) {
  console.error(`fog.mjs: ${error.message}`);
  process.exitCode = 2;
}
