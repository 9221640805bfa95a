#!/usr/bin/env python3
"""Checks what `sightline export --format json` wrote, without any of Sightline's own code.

All of it in integers: coordinates are doubles, so one power of two makes integers of them.

  1. The graph: cells are convex, counter-clockwise, do not overlap and fill the bounds; no wall
     passes through a cell; the portals are exactly the longest wall-free pieces of boundary that
     two cells share; rows of the PVS are ascending, symmetric, and hold the cell and neighbours.
  2. Sightlines: random lines, many of them close to walls' ends and to the axes, are followed from
     cell to cell until a wall on either side. All cells on the way must see each other. A line that
     meets a corner or a wall's end exactly is let go there, so no rounding decides anything.
  3. Straight segments between cells, tried against every wall one by one, as a check on 2.

Exit status: 0 nothing found, 1 faults found, 2 the file cannot be read.
"""
import argparse
import json
import random
import sys
import time
from fractions import Fraction
from math import gcd

# Random points are sums of a cell's corners with integer weights that add up to this.
SCALE = 1 << 20
SHOWN = 10


class Faults:
    """What is wrong: how often, and the first few of each kind."""

    def __init__(self):
        self.counts = {}
        self.texts = []

    def add(self, kind, text):
        self.counts[kind] = self.counts.get(kind, 0) + 1
        if self.counts[kind] <= SHOWN:
            self.texts.append(f"{kind}: {text}")

    def __len__(self):
        return sum(self.counts.values())


class Export:
    """The file's contents in integers: a coordinate times `unit`."""

    def __init__(self, data):
        if data.get("format") != "sightline" or data.get("version") not in (1, 2):
            raise ValueError("not a sightline export of version 1 or 2")
        if data["sight"] not in ("closed", "open"):
            raise ValueError("sight is neither closed nor open")
        values = list(data["bounds"])
        for wall in data["walls"]:
            values += wall
        for cell in data["cells"]:
            for corner in cell["polygon"]:
                values += corner
        for portal in data["portals"]:
            values += portal["segment"]
        self.unit = max((Fraction(v).denominator for v in values), default=1)
        self.bounds = self.integers(data["bounds"])
        self.walls = [self.segment(wall) for wall in data["walls"]]
        self.ids = [cell["id"] for cell in data["cells"]]
        self.cells = [[tuple(self.integers(p)) for p in cell["polygon"]] for cell in data["cells"]]
        self.portals = [(tuple(p["cells"]), self.segment(p["segment"])) for p in data["portals"]]
        self.solid = [cell.get("solid", False) for cell in data["cells"]]
        self.pvs = data["pvs"]

    def integers(self, values):
        return [int(Fraction(v) * self.unit) for v in values]

    def segment(self, values):
        x0, y0, x1, y1 = self.integers(values)
        return (x0, y0), (x1, y1)

    def text(self, point, scale=1):
        return "(%.17g, %.17g)" % tuple(float(Fraction(v, self.unit * scale)) for v in point)


def side(a, b, p):
    """Positive where p is to the left of the line from a to b."""
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def edges(polygon):
    return zip(polygon, polygon[1:] + polygon[:1])


def doubled_area(polygon):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in edges(polygon))


def box(points):
    xs, ys = zip(*points)
    return min(xs), min(ys), max(xs), max(ys)


def overlapping(boxes, others):
    """Pairs (i, k) whose boxes share more than a border or touch: a sweep along x."""
    events = sorted([(b[0], b[2], 0, i) for i, b in enumerate(boxes)] +
                    [(b[0], b[2], 1, k) for k, b in enumerate(others)])
    live = ([], [])
    for low, high, kind, index in events:
        mine = (boxes, others)[kind][index]
        theirs = (others, boxes)[kind]
        kept = [k for k in live[1 - kind] if theirs[k][2] >= low]
        live[1 - kind][:] = kept
        for k in kept:
            if theirs[k][1] <= mine[3] and mine[1] <= theirs[k][3]:
                yield (index, k) if kind == 0 else (k, index)
        live[kind].append(index)


def separated(polygon, other):
    """Whether an edge of the first has all of the second on its outer side."""
    return any(all(side(a, b, p) <= 0 for p in other) for a, b in edges(polygon))


def enters(polygon, segment):
    """Whether a segment has a point in the inside of a convex polygon."""
    low, high = Fraction(0), Fraction(1)
    for a, b in edges(polygon):
        start, end = side(a, b, segment[0]), side(a, b, segment[1])
        if start <= 0 and end <= 0:
            return False
        if start < 0 or (start == 0 and end > 0):
            low = max(low, Fraction(-start, end - start))
        elif end <= 0:
            high = min(high, Fraction(start, start - end))
    return low < high


def check_cells(export, faults):
    x0, y0, x1, y1 = export.bounds
    if export.ids != list(range(len(export.cells))):
        faults.add("ids", "cells are not numbered from 0 up")
    total = 0
    for c, polygon in enumerate(export.cells):
        area = doubled_area(polygon)
        total += area
        if area <= 0:
            faults.add("area", f"cell {c} has no positive area")
        if len(set(polygon)) < len(polygon) or len(polygon) < 3:
            faults.add("convex", f"cell {c} repeats a corner")
        elif any(side(a, b, p) < 0 for a, b in edges(polygon) for p in polygon):
            faults.add("convex", f"cell {c} is not convex and counter-clockwise")
        if any(not (x0 <= x <= x1 and y0 <= y <= y1) for x, y in polygon):
            faults.add("bounds", f"cell {c} leaves the bounds")
    whole = 2 * (x1 - x0) * (y1 - y0)
    if total != whole:
        faults.add("area", "cells' areas do not add up to the bounds'")
    boxes = [box(polygon) for polygon in export.cells]
    for i, k in overlapping(boxes, boxes):
        if i < k and not (separated(export.cells[i], export.cells[k]) or
                          separated(export.cells[k], export.cells[i])):
            faults.add("overlap", f"cells {i} and {k}")
    for c, w in overlapping(boxes, [box(wall) for wall in export.walls]):
        if enters(export.cells[c], export.walls[w]):
            faults.add("wall inside", f"wall {w} passes through cell {c}")


def line_key(a, b):
    """The same for all segments of one line."""
    u, v = b[1] - a[1], a[0] - b[0]
    w = u * a[0] + v * a[1]
    divisor = gcd(gcd(u, v), w)
    if (u, v) < (0, 0):
        divisor = -divisor
    return u // divisor, v // divisor, w // divisor


def boundary(export, faults):
    """For each cell its boundary, as pieces that end at (x, y): [(x, y, neighbour or -1)], the
    first piece starting where the last ends; and the longest free pieces that two cells share."""
    sides, walls = {}, {}
    for c, polygon in enumerate(export.cells):
        for a, b in edges(polygon):
            sides.setdefault(line_key(a, b), []).append((min(a, b), max(a, b), c, a < b))
    for a, b in export.walls:
        if a != b:
            walls.setdefault(line_key(a, b), []).append((min(a, b), max(a, b)))
    rings, free = [], set()
    for c, polygon in enumerate(export.cells):
        ring = []
        for a, b in edges(polygon):
            low, high, key = min(a, b), max(a, b), line_key(a, b)
            others = [s for s in sides[key] if s[3] != (a < b) and s[0] < high and low < s[1]]
            blocks = [w for w in walls.get(key, ()) if w[0] < high and low < w[1]]
            stops = {p for s in others + blocks for p in s[:2] if low < p < high} | {low, high}
            stops = sorted(stops)
            pieces = []
            for p, q in zip(stops, stops[1:]):
                beyond = [s[2] for s in others if s[0] <= p and q <= s[1]]
                blocked = any(w[0] <= p and q <= w[1] for w in blocks)
                if not beyond and not on_border(export.bounds, p, q):
                    faults.add("gap", f"nothing lies beyond cell {c} from {export.text(p)}")
                pieces.append((p, q, -1 if blocked or not beyond else beyond[0]))
            free.update(longest(pieces, c))
            if a < b:
                ring += [(q[0], q[1], n) for p, q, n in pieces]
            else:
                ring += [(p[0], p[1], n) for p, q, n in reversed(pieces)]
        rings.append(ring)
    return rings, free


def on_border(bounds, p, q):
    x0, y0, x1, y1 = bounds
    return (p[0] == q[0] and p[0] in (x0, x1)) or (p[1] == q[1] and p[1] in (y0, y1))


def longest(pieces, cell):
    start = None
    for i, (p, q, n) in enumerate(pieces):
        start = p if start is None else start
        if i + 1 == len(pieces) or pieces[i + 1][2] != n:
            if n >= 0:
                yield min(cell, n), max(cell, n), start, q
            start = None


def check_portals(export, free, faults):
    listed = set()
    for i, ((a, b), (p, q)) in enumerate(export.portals):
        if not (0 <= a < len(export.cells) and 0 <= b < len(export.cells)) or a == b:
            faults.add("portal", f"portal {i} joins cells {a} and {b}")
            continue
        piece = (min(a, b), max(a, b), min(p, q), max(p, q))
        if piece in listed:
            faults.add("portal", f"portal {i} is there twice")
        listed.add(piece)
        if piece not in free:
            faults.add("portal", f"portal {i} from {export.text(p)} to {export.text(q)} is no "
                                 f"longest wall-free piece of the boundary of cells {a} and {b}")
    for a, b, p, q in sorted(free - listed):
        faults.add("portal", f"none between cells {a} and {b} from {export.text(p)} to "
                             f"{export.text(q)}")


def check_pvs(export, inside_only, faults):
    """The rows as bit sets."""
    count, rows = len(export.cells), []
    if len(export.pvs) != count:
        faults.add("pvs", f"{len(export.pvs)} rows for {count} cells")
    for c, row in enumerate(export.pvs[:count]):
        bits = 0
        if any(b <= a for a, b in zip(row, row[1:])):
            faults.add("pvs", f"row {c} is not ascending")
        for k in row:
            if 0 <= k < count:
                bits |= 1 << k
            else:
                faults.add("pvs", f"row {c} names cell {k}")
        if not bits >> c & 1 and not ((inside_only or export.solid[c]) and not row):
            faults.add("pvs", f"cell {c} does not see itself")
        if export.solid[c] and row:
            faults.add("pvs", f"cell {c} is solid and sees")
        for k in row:
            if 0 <= k < count and export.solid[k]:
                faults.add("pvs", f"cell {k} is solid and is seen")
        rows.append(bits)
    rows += [0] * (count - len(rows))
    for c in range(count):
        for k in range(count):
            if rows[c] >> k & 1 and not rows[k] >> c & 1:
                faults.add("pvs", f"cell {c} sees cell {k}, which does not see it")
    for (a, b), _ in export.portals:
        if 0 <= a < count and 0 <= b < count and export.solid[a] != export.solid[b]:
            faults.add("pvs", f"a portal joins cells {a} and {b}, of which one is solid")
        if 0 <= a < count and 0 <= b < count and rows[a] and rows[b] and not rows[a] >> b & 1:
            faults.add("pvs", f"cells {a} and {b} share a portal and do not see each other")
    return rows


def follow(rings, cell, p, d, out):
    """Appends the cells that the ray from p, inside a cell, along d enters, up to a wall or to
    where it meets a corner or a wall's end exactly."""
    dx, dy = d
    offset = dx * p[1] - dy * p[0]
    while True:
        ring = rings[cell]
        x, y, beyond = ring[-1]
        before = dx * y - dy * x
        for x, y, beyond in ring:
            now = dx * y - dy * x
            if before < offset < now:
                break
            before = now
        else:
            return
        if beyond < 0:
            return
        cell = beyond
        out.append(cell)


class Sampler:
    """Random points and directions, in integers SCALE times finer than the export's."""

    def __init__(self, export, seed):
        self.random = random.Random(seed)
        self.cells = export.cells
        self.corners = sorted({(x * SCALE, y * SCALE) for wall in export.walls for x, y in wall} |
                              {(x * SCALE, y * SCALE) for _, ends in export.portals
                               for x, y in ends})
        areas, total = [], 0
        for polygon in export.cells:
            total += doubled_area(polygon)
            areas.append(total)
        self.areas = areas
        x0, y0, x1, y1 = export.bounds
        self.size = max(x1 - x0, y1 - y0) * SCALE

    def cell(self):
        """Any cell as likely as any other, or by area."""
        if self.random.random() < 0.5:
            return self.random.randrange(len(self.cells))
        value, low, high = self.random.random() * self.areas[-1], 0, len(self.areas) - 1
        while low < high:
            middle = (low + high) // 2
            low, high = (low, middle) if value < self.areas[middle] else (middle + 1, high)
        return low

    def point(self, cell, near_corner):
        """Strictly inside the cell; close to one of its corners if asked to."""
        polygon, r = self.cells[cell], self.random
        weights = [r.random() + 1e-3 for _ in polygon]
        if near_corner:
            weights[r.randrange(len(polygon))] += 10.0 ** r.uniform(1, 5)
        total = sum(weights)
        weights = [1 + int(w / total * (SCALE - len(polygon) - 1)) for w in weights]
        weights[0] += SCALE - sum(weights)
        return (sum(w * p[0] for w, p in zip(weights, polygon)),
                sum(w * p[1] for w, p in zip(weights, polygon)))

    def direction(self, p):
        r, kind = self.random, self.random.random()
        if kind < 0.4:
            return r.randrange(-SCALE, SCALE), r.randrange(-SCALE, SCALE)
        if kind < 0.6:
            slope = r.choice((-1, 1)) * 10.0 ** r.uniform(-6, -1)
            d = r.choice((-SCALE, SCALE)), int(SCALE * slope)
            return d if r.random() < 0.5 else (d[1], d[0])
        return self.aim(p, r.choice(self.corners))

    def aim(self, p, q):
        """From p to somewhere near q."""
        r = self.random
        miss = max(1, int(self.size * 10.0 ** r.uniform(-9, -2)))
        return q[0] - p[0] + r.randint(-miss, miss), q[1] - p[1] + r.randint(-miss, miss)

    def line(self):
        cell = self.cell()
        p = self.point(cell, self.random.random() < 0.5)
        return cell, p, self.direction(p)


def report(done, total, what, started):
    if sys.stderr.isatty() or done == total:
        end = "\n" if done == total else "\r"
        sys.stderr.write(f"{what}: {done} of {total}, {time.time() - started:.1f} s{end}")
        sys.stderr.flush()


def check_sightlines(export, rings, rows, count, sampler, faults):
    """For each cell the cells that a sightline joined it to, as bit sets."""
    looked_from = sum(1 << c for c in range(len(rows)) if rows[c])
    bit = [1 << c & looked_from for c in range(len(rows))]
    joined = [0] * len(rows)
    started = time.time()
    for i in range(count):
        cell, p, d = sampler.line()
        if d == (0, 0):
            continue
        ahead, behind = [cell], []
        follow(rings, cell, p, d, ahead)
        follow(rings, cell, p, (-d[0], -d[1]), behind)
        ahead += behind
        mask = 0
        for c in ahead:
            mask |= bit[c]
        for c in ahead:
            if bit[c]:
                joined[c] |= mask
                if rows[c] & mask != mask:
                    missed = [k for k in ahead if bit[k] and not rows[c] >> k & 1]
                    for k in missed:
                        faults.add("missed", f"cell {c} does not see cell {k}, which is on the "
                                             f"sightline through {export.text(p, SCALE)} along "
                                             f"({d[0]}, {d[1]})")
        if (i + 1) % 20000 == 0 or i + 1 == count:
            report(i + 1, count, "sightlines", started)
    return joined


def meets(p, q, a, b):
    """Whether the segment from p to q touches the segment from a to b; True as well where one lies
    along the other's line."""
    s, t = side(p, q, a), side(p, q, b)
    if (s < 0 and t < 0) or (s > 0 and t > 0):
        return False
    s, t = side(a, b, p), side(a, b, q)
    return not ((s < 0 and t < 0) or (s > 0 and t > 0))


def check_segments(export, rings, rows, count, sampler, faults):
    """Straight from the definition: two points, every wall. Also a check on follow()."""
    walls = [tuple((x * SCALE, y * SCALE) for x, y in wall) for wall in export.walls]
    free, started = 0, time.time()
    for i in range(count):
        a = b = sampler.cell()
        for _ in range(sampler.random.randrange(8)):
            near = [n for _, _, n in rings[b] if n >= 0]
            b = sampler.random.choice(near) if near else b
        p, q = sampler.point(a, i % 2 == 1), sampler.point(b, i % 4 > 1)
        if p == q:
            continue
        way = [a]
        follow(rings, a, p, (q[0] - p[0], q[1] - p[1]), way)
        clear = not any(meets(p, q, *wall) for wall in walls)
        free += clear
        if b in way and not clear:
            faults.add("checker", f"followed from {export.text(p, SCALE)} to "
                                  f"{export.text(q, SCALE)} past a wall")
        if clear and b not in way and not touches_corner(export, p, q):
            faults.add("checker", f"lost the way from {export.text(p, SCALE)} to "
                                  f"{export.text(q, SCALE)}")
        if clear and rows[a] and rows[b] and not rows[a] >> b & 1:
            faults.add("missed", f"cell {a} does not see cell {b}, though nothing stands between "
                                 f"{export.text(p, SCALE)} and {export.text(q, SCALE)}")
        if (i + 1) % 200 == 0 or i + 1 == count:
            report(i + 1, count, "segments", started)
    return free


def touches_corner(export, p, q):
    """Whether a corner of a cell or a wall's end lies on the line, where follow() stops."""
    points = [v for polygon in export.cells for v in polygon] + [e for w in export.walls for e in w]
    return any(side(p, q, (x * SCALE, y * SCALE)) == 0 for x, y in points)


def other_cells(rows):
    """How many pairs of different cells."""
    return sum(bin(row & ~(1 << c)).count("1") for c, row in enumerate(rows))


def tightness(export, rings, rows, joined, count, sampler):
    """Of `count` random seen pairs, for how many a sightline is known or turned up by trying."""
    pairs = [(a, b) for a in range(len(rows)) for b in range(a) if rows[a] >> b & 1]
    if not pairs:
        return 0, 0
    found, started = 0, time.time()
    for i in range(count):
        a, b = sampler.random.choice(pairs)
        if joined[a] >> b & 1:
            found += 1
            continue
        x0, y0, x1, y1 = (v * SCALE for v in box(export.cells[a] + export.cells[b]))
        between = [c for c in sampler.corners if x0 <= c[0] <= x1 and y0 <= c[1] <= y1]
        for attempt in range(400):
            p, way = sampler.point(a, attempt % 4 > 0), []
            if attempt % 2 and between:
                d = sampler.aim(p, sampler.random.choice(between))
            else:
                q = sampler.point(b, attempt % 8 > 3)
                d = q[0] - p[0], q[1] - p[1]
            follow(rings, a, p, d, way)
            if b in way:
                found += 1
                break
    report(count, count, "seen pairs", started)
    return found, count


def check(data, sightlines, segments=0, tight=0, seed=1, inside_only=False):
    """Faults, and a line on what was done."""
    export, faults = Export(data), Faults()
    check_cells(export, faults)
    rings, free = [], set()
    if not faults:
        rings, free = boundary(export, faults)
        check_portals(export, free, faults)
    rows = check_pvs(export, inside_only, faults)
    done = (f"{len(export.cells)} cells, {len(export.portals)} portals, {len(export.walls)} walls, "
            f"{other_cells(rows)} ordered pairs of different cells seen ({data['sight']} sight)")
    if not rings or any(kind != "pvs" and kind != "portal" for kind in faults.counts):
        return faults, done + "; the cells are unsound: no sightlines tried"
    scaled = [[(x * SCALE, y * SCALE, n) for x, y, n in ring] for ring in rings]
    sampler = Sampler(export, seed)
    joined = check_sightlines(export, scaled, rows, sightlines, sampler, faults)
    clear = check_segments(export, scaled, rows, segments, sampler, faults)
    done += (f"\n{sightlines} sightlines joined {other_cells(joined)} ordered pairs of different "
             f"cells; {clear} of {segments} segments were free of walls; "
             f"{faults.counts.get('missed', 0)} times a pair was missed")
    if tight:
        found, tried = tightness(export, scaled, rows, joined, tight, sampler)
        share = 100 * found / tried if tried else 100
        done += f"\na sightline turned up for {found} of {tried} random seen pairs ({share:.1f} %)"
    return faults, done


def example():
    """Three columns with gaps in between, made by hand; its first and last cell see each other."""
    return {
        "format": "sightline", "version": 1, "sight": "closed", "bounds": [0, 0, 3.5, 4],
        "walls": [[0, 0, 3.5, 0], [3.5, 0, 3.5, 4], [3.5, 4, 0, 4], [0, 4, 0, 0],
                  [1, 0, 1, 0.5], [1, 2, 1, 4], [2.25, 0, 2.25, 1], [2.25, 3, 2.25, 4]],
        "cells": [{"id": 0, "polygon": [[0, 0], [1, 0], [1, 4], [0, 4]]},
                  {"id": 1, "polygon": [[1, 0], [2.25, 0], [2.25, 4], [1, 4]]},
                  {"id": 2, "polygon": [[2.25, 0], [3.5, 0], [3.5, 4], [2.25, 4]]}],
        "portals": [{"cells": [0, 1], "segment": [1, 0.5, 1, 2]},
                    {"cells": [1, 2], "segment": [2.25, 1, 2.25, 3]}],
        "pvs": [[0, 1, 2], [0, 1, 2], [0, 1, 2]]}


def spoil_pair(data):
    """Removes a pair that is not joined by a portal, both ways: only sightlines can tell. The pair
    must be easily seen, so one that the sightlines of a short run join."""
    export, faults = Export(data), Faults()
    rings = [[(x * SCALE, y * SCALE, n) for x, y, n in r] for r in boundary(export, faults)[0]]
    sampler, joined = Sampler(export, 7), {tuple(sorted(p[0])) for p in export.portals}
    while True:
        cell, p, d = sampler.line()
        way = []
        follow(rings, cell, p, d, way)
        for other in way:
            if other != cell and tuple(sorted((cell, other))) not in joined:
                data["pvs"][cell].remove(other)
                data["pvs"][other].remove(cell)
                return


def spoil_neighbours(data):
    a, b = data["portals"][0]["cells"]
    data["pvs"][a].remove(b)
    data["pvs"][b].remove(a)


def spoil_one_way(data):
    a = next(c for c, row in enumerate(data["pvs"]) if len(row) > 1)
    data["pvs"][a].remove(next(k for k in data["pvs"][a] if k != a))


def spoil_self(data):
    data["pvs"][0].remove(0)


def spoil_order(data):
    max(data["pvs"], key=len).reverse()


def spoil_range(data):
    data["pvs"][-1].append(len(data["cells"]))


def spoil_portal_place(data):
    x0, y0, x1, y1 = data["portals"][0]["segment"]
    data["portals"][0]["segment"] = [(3 * x0 + x1) / 4, (3 * y0 + y1) / 4, x1, y1]


def spoil_portal_cells(data):
    count = len(data["cells"])
    a, b = data["portals"][0]["cells"]
    data["portals"][0]["cells"] = [a, next(c for c in range(count) if c not in (a, b))]


def spoil_portal_lost(data):
    data["portals"].pop()


def spoil_wall_on_portal(data):
    data["walls"].append(data["portals"][0]["segment"])


def spoil_wall_in_cell(data):
    (x0, y0), (x1, y1), (x2, y2) = data["cells"][0]["polygon"][:3]
    x, y = (x0 + x1 + x2) / 3, (y0 + y1 + y2) / 3
    data["walls"].append([x, y, (x + x1) / 2, (y + y1) / 2])


def spoil_wall_lost(data):
    x0, y0, x1, y1 = data["bounds"]
    data["walls"] = [w for w in data["walls"]
                     if w[0] == w[2] and w[0] in (x0, x1) or w[1] == w[3] and w[1] in (y0, y1)]


def spoil_cell_lost(data):
    data["cells"].pop()
    data["pvs"].pop()


def spoil_cell_turned(data):
    data["cells"][0]["polygon"].reverse()


def spoil_cell_grown(data):
    polygon = data["cells"][0]["polygon"]
    cx = sum(x for x, y in polygon) / len(polygon)
    data["cells"][0]["polygon"] = [[x + (0.25 if x > cx else 0), y] for x, y in polygon]


def spoil_cell_bent(data):
    polygon = data["cells"][0]["polygon"]
    (x0, y0), (x1, y1), (x2, y2) = polygon[0], polygon[1], polygon[2]
    polygon.insert(1, [(x0 + x1 + x2) / 3, (y0 + y1 + y2) / 3])


SPOILERS = [(spoil_pair, "missed"), (spoil_neighbours, "pvs"), (spoil_one_way, "pvs"),
            (spoil_self, "pvs"), (spoil_order, "pvs"), (spoil_range, "pvs"),
            (spoil_portal_place, "portal"), (spoil_portal_cells, "portal"),
            (spoil_portal_lost, "portal"), (spoil_wall_on_portal, "portal"),
            (spoil_wall_in_cell, "wall inside"), (spoil_wall_lost, "portal"),
            (spoil_cell_lost, "area"), (spoil_cell_turned, "convex"), (spoil_cell_grown, "overlap"),
            (spoil_cell_bent, "convex")]


def self_test(text):
    """Spoils a sound export in every way the checker looks for; each must be found."""
    faults, _ = check(json.loads(text), 20000, 200)
    failed = len(faults)
    for line in faults.texts:
        print(f"in the sound export: {line}")
    for spoil, kind in SPOILERS:
        data = json.loads(text)
        spoil(data)
        found = check(data, 20000, 200)[0].counts
        print(f"{spoil.__name__}: {found if found else 'not found'}")
        failed += kind not in found
    print("self-test " + ("failed" if failed else "passed"))
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", nargs="?", help="what sightline export --format json wrote")
    parser.add_argument("--sightlines", type=int, default=1000000, metavar="N")
    parser.add_argument("--segments", type=int, default=2000, metavar="N",
                        help="segments tried against every wall")
    parser.add_argument("--tight", type=int, default=0, metavar="K",
                        help="look for sightlines for K random seen pairs")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--inside-only", action="store_true", help="rows may be empty")
    parser.add_argument("--self-test", action="store_true",
                        help="spoil the file (or an example) and expect each fault to be found")
    options = parser.parse_args()
    if not options.file and not options.self_test:
        parser.error("no file given")
    try:
        if options.file:
            with open(options.file, encoding="utf-8") as stream:
                text = stream.read()
        else:
            text = json.dumps(example())
        if options.self_test:
            return self_test(text)
        faults, done = check(json.loads(text), options.sightlines, options.segments, options.tight,
                             options.seed, options.inside_only)
    except (OSError, ValueError, LookupError, TypeError, AttributeError, OverflowError) as error:
        print(f"{options.file}: {error!r}", file=sys.stderr)
        return 2
    print(done)
    for line in faults.texts:
        print(line)
    for kind, count in faults.counts.items():
        print(f"{kind}: {count} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
