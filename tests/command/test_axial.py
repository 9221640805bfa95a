"""Axial and segment analysis beside plain oracles: test_axial.py PROGRAM

Who crosses whom is decided in whole numbers here. Choice is counted path by path.
"""
import csv
import heapq
import io
import itertools
import json
import math
import random
import re
import sys
import unittest

import sandbox
from case import MAPS

PROGRAM = None


def table(arguments, files=()):
    with sandbox.Sandbox(PROGRAM) as box:
        for name, text in files:
            box.path(name).write_text(text)
        result = box.run([*arguments, "--quiet"])
        if result.status:
            raise AssertionError(result.text())
        return list(csv.DictReader(io.StringIO(result.stdout)))


def line_of(row):
    return tuple(float(row[name]) for name in ("x1", "y1", "x2", "y2"))


def side(a, b, c):
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def touch(s, t):
    a, b, c, d = s[:2], s[2:], t[:2], t[2:]
    for k in range(2):
        if max(a[k], b[k]) < min(c[k], d[k]) or max(c[k], d[k]) < min(a[k], b[k]):
            return False
    return side(a, b, c) * side(a, b, d) <= 0 and side(c, d, a) * side(c, d, b) <= 0


def map_of(lines):
    return "sightline 1\n" + "".join("wall " + " ".join(map(str, line)) + "\n" for line in lines)


class NoValue(unittest.TestCase):
    def test_geojson_has_null(self):
        with sandbox.Sandbox(PROGRAM) as box:
            box.path("row.csv").write_text("x1,y1,x2,y2\n0,0,4,0\n4,0,4,4\n4,4,8,4\n")
            result = box.run(["axial", "row.csv", "--quiet", "-o", "row.geojson"])
            self.assertEqual(result.status, 0, result.text())
            found = json.loads(box.path("row.geojson").read_text(), parse_constant=self.fail)
        rows = [feature["properties"] for feature in found["features"]]
        self.assertEqual([row["integration_tekl"] for row in rows], [None] * 3)
        self.assertEqual([row["integration_hh"] is None for row in rows], [False, True, False])


class Drawn(unittest.TestCase):
    """Random lines with whole coordinates: many meet in ends, and many only just."""

    @classmethod
    def setUpClass(cls):
        random.seed(3)
        cls.lines = sorted({tuple(random.randrange(13) for _ in range(4)) for _ in range(40)})
        cls.lines = [line for line in cls.lines if line[:2] != line[2:]
                     and math.dist(line[:2], line[2:]) < 8] + [(50, 50, 51, 51)]
        text = "x1,y1,x2,y2\n" + "".join(",".join(map(str, line)) + "\n" for line in cls.lines)
        cls.rows = table(["axial", "lines.csv", "--radius", "n", "--radius", "2"],
                         [("lines.csv", text)])
        cls.graph = [[j for j, other in enumerate(cls.lines) if i != j and touch(line, other)]
                     for i, line in enumerate(cls.lines)]

    def depths(self, root):
        depths, level = {root: 0}, [root]
        while level:
            following = []
            for at in level:
                for other in self.graph[at]:
                    if other not in depths:
                        depths[other] = depths[at] + 1
                        following.append(other)
            level = following
        return depths

    def paths(self, depths, to):
        """All shortest paths from the root, as lists of what lies between."""
        if depths[to] == 0:
            return [[]]
        return [path + ([at] if depths[at] else []) for at in self.graph[to]
                if depths.get(at) == depths[to] - 1 for path in self.paths(depths, at)]

    def test_lines_are_those_of_the_file(self):
        self.assertEqual([line_of(row) for row in self.rows], self.lines)

    def test_steps(self):
        for i, row in enumerate(self.rows):
            self.assertEqual(int(row["connectivity"]), len(self.graph[i]))
            for ending, radius in (("", 99), ("_r2", 2)):
                depths = {k: d for k, d in self.depths(i).items() if d <= radius}
                n, total = len(depths), sum(depths.values())
                self.assertEqual(int(row["node_count" + ending]), n)
                self.assertEqual(int(row["total_depth" + ending]), total)
                if n < 3 or total == n - 1:
                    self.assertEqual(row["integration_hh" + ending], "")
                    continue
                ra = 2 * (total / (n - 1) - 1) / (n - 2)
                diamond = 2 * (n * (math.log2((n + 2) / 3) - 1) + 1) / ((n - 1) * (n - 2))
                self.assertAlmostEqual(float(row["integration_hh" + ending]), diamond / ra, 9)
                counts = [list(depths.values()).count(d) for d in range(1, max(depths.values()) + 1)]
                entropy = -sum(c / (n - 1) * math.log2(c / (n - 1)) for c in counts)
                self.assertAlmostEqual(float(row["entropy" + ending]), entropy, 9)

    def test_choice(self):
        for ending, radius in (("", 99), ("_r2", 2)):
            choice = [0.0] * len(self.lines)
            for root in range(len(self.lines)):
                depths = self.depths(root)
                for to in depths:
                    if to <= root or depths[to] > radius:
                        continue
                    every = self.paths(depths, to)
                    for path in every:
                        for at in path:
                            choice[at] += 1 / len(every)
            for row, value in zip(self.rows, choice, strict=True):
                self.assertAlmostEqual(float(row["choice" + ending]), value, 4)
            self.assertGreater(max(choice), 5)


PLANS = {
    "room": [(0, 0, 10, 0), (10, 0, 10, 6), (10, 6, 0, 6), (0, 6, 0, 0)],
    "bend": [(0, 0, 10, 0), (10, 0, 10, 3), (10, 3, 4, 3), (4, 3, 4, 8), (4, 8, 0, 8), (0, 8, 0, 0)],
    "rooms": [(0, 0, 12, 0), (12, 0, 12, 8), (12, 8, 0, 8), (0, 8, 0, 0), (4, 0, 4, 3), (4, 5, 4, 8),
              (4, 5, 7, 5), (9, 5, 12, 5), (8, 1, 9, 2), (9, 2, 8, 3), (8, 3, 8, 1)],
}


class AllLines(unittest.TestCase):
    """Each line beside the corners and walls of small plans."""

    def walls_at(self, walls, corner):
        return [w[2:] if w[:2] == corner else w[:2] for w in walls if corner in (w[:2], w[2:])]

    def sides(self, walls, corner, a, b):
        return {side(a, b, end) for end in self.walls_at(walls, corner)} - {0}

    def holds(self, walls, corner, other):
        """A line from other may graze a corner, or end in it where it is one of a room."""
        if len(self.sides(walls, corner, other, corner)) < 2:
            return True
        def angle(p):
            turn = math.atan2(p[1] - corner[1], p[0] - corner[0])
            turn -= math.atan2(other[1] - corner[1], other[0] - corner[0])
            return turn % (2 * math.pi)
        turns = sorted(angle(end) for end in self.walls_at(walls, corner))
        if turns[0] < 1e-9 or turns[-1] > 2 * math.pi - 1e-9:
            return True
        return turns[0] + 2 * math.pi - turns[-1] < math.pi - 1e-9

    def test_lines(self):
        for name, walls in PLANS.items():
            # The start keeps the inside of the small triangle outside.
            rows = table(["axial", "plan.map", "--lines", "all", "--start", "1,1"],
                         [("plan.map", map_of(walls))])
            lines = [line_of(row) for row in rows]
            self.assertEqual(len(lines), len(set(lines)), name)
            corners = sorted({w[:2] for w in walls} | {w[2:] for w in walls})
            for line in lines:
                self.check_line(walls, corners, line)
            expected = 0
            for a, b in itertools.combinations(corners, 2):
                if any(side(a, b, w[:2]) * side(a, b, w[2:]) < 0 and
                       side(w[:2], w[2:], a) * side(w[:2], w[2:], b) < 0 for w in walls):
                    continue
                if any(side(a, b, c) == 0 and a < c < b for c in corners):
                    continue
                if not self.holds(walls, a, b) or not self.holds(walls, b, a):
                    continue
                if name == "bend" and {a, b} == {(4, 8), (10, 3)}:
                    continue  # through solid ground
                expected += 1
                self.assertTrue(any(self.passes(line, a) and self.passes(line, b) for line in lines),
                                f"{name}: no line through {a} and {b}")
            self.assertGreaterEqual(expected, len(lines) / 2)

    def passes(self, line, point):
        a, b = line[:2], line[2:]
        return math.dist(a, point) + math.dist(point, b) < math.dist(a, b) + 1e-9

    def check_line(self, walls, corners, line):
        a, b = line[:2], line[2:]
        length = math.dist(a, b)
        self.assertGreaterEqual(sum(self.passes(line, c) for c in corners), 2, line)
        for w in walls:  # nothing but its ends may touch a wall from side to side
            p, q = w[:2], w[2:]
            cross = [(b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) for c in (p, q)]
            if min(cross) > -1e-9 * length or max(cross) < 1e-9 * length:
                continue
            share = cross[0] / (cross[0] - cross[1])
            at = [p[k] + (q[k] - p[k]) * share for k in (0, 1)]
            along = ((at[0] - a[0]) * (b[0] - a[0]) + (at[1] - a[1]) * (b[1] - a[1])) / length ** 2
            self.assertFalse(1e-9 < along < 1 - 1e-9, f"{line} crosses {w}")
        for end, other in ((a, b), (b, a)):  # it is as long as it can be
            beyond = [end[k] + (end[k] - other[k]) / length * 1e-3 for k in (0, 1)]
            self.assertTrue(self.is_shut(walls, end, beyond), f"{line} goes on at {end}")

    def is_shut(self, walls, end, beyond):
        near = [w for w in walls if self.passes(w, end)]
        marks = {side(end, beyond, c) for w in near for c in (w[:2], w[2:])
                 if math.dist(c, end) > 1e-9}
        along = any(side(w[:2], w[2:], beyond) == 0 for w in near)  # on the one side of this wall
        return {1, -1} <= marks or (along and len(marks - {0}) == 1)

    def test_fewer_lines_join_what_all_join(self):
        plan = str(MAPS / "gallery.map")
        every, subsets, fewest = (
            [line_of(row) for row in table(["axial", plan, "--lines", kind])]
            for kind in ("all", "subsets", "fewest"))
        self.assertLess(set(fewest), set(subsets))
        self.assertLess(set(subsets), set(every))
        self.assertLess(len(fewest), 60)
        self.assertEqual(self.parts(subsets), 1)
        self.assertEqual(self.parts(fewest), 1)

    def parts(self, lines):
        waiting, count = set(lines), 0
        while waiting:
            count, level = count + 1, [waiting.pop()]
            while level:
                at = level.pop()
                reached = {other for other in waiting if touch(at, other)}
                waiting -= reached
                level += reached
        return count


class Segments(unittest.TestCase):
    """A bent grid of streets with gaps, and two that cross without a common end."""

    @classmethod
    def setUpClass(cls):
        random.seed(8)
        places = {(i, j): (40 * i + random.randrange(-9, 10), 40 * j + random.randrange(-9, 10))
                  for i in range(5) for j in range(4)}
        lines = [places[p] + places[q] for p in places for q in ((p[0] + 1, p[1]), (p[0], p[1] + 1))
                 if q in places and random.random() < 0.85]
        lines += [(200, 0, 240, 40), (200, 40, 240, 0), (500, 0, 520, 0)]
        cls.text = map_of(lines)
        cls.rows = table(["segments", "streets.map", "--metric-radius", "n", "--metric-radius", "90",
                          "--angular-radius", "1"], [("streets.map", cls.text)])
        cls.segments = [line_of(row) for row in cls.rows]

    def ends(self, state):
        s = self.segments[state // 2]
        return (s[:2], s[2:]) if state % 2 == 0 else (s[2:], s[:2])

    def after(self, state):
        start, end = self.ends(state)
        for other in range(2 * len(self.segments)):
            begin, far = self.ends(other)
            if begin != end or other // 2 == state // 2:
                continue
            turn = math.atan2(far[1] - begin[1], far[0] - begin[0])
            turn -= math.atan2(end[1] - start[1], end[0] - start[0])
            turn = abs((turn + math.pi) % (2 * math.pi) - math.pi)
            yield other, round(turn / math.pi * 512)

    def search(self, root):
        """By state: (turn, steps) and all states before it on a best path."""
        keys, before, heap = {}, {}, [((0, 0), 2 * root, None), ((0, 0), 2 * root + 1, None)]
        while heap:
            key, state, last = heapq.heappop(heap)
            if state in keys:
                if key == keys[state] and last is not None:
                    before[state].append(last)
                continue
            keys[state], before[state] = key, [] if last is None else [last]
            for other, turn in self.next_states[state]:
                if other not in keys:
                    heapq.heappush(heap, ((key[0] + turn, key[1] + 1), other, state))
        return keys, before

    def middles(self):
        """Lengths along the network from middle to middle."""
        n = len(self.segments)
        corners = sorted({p for s in self.segments for p in (s[:2], s[2:])})
        far = {(a, b): 0 if a == b else math.inf for a in corners for b in corners}
        for s in self.segments:
            far[s[:2], s[2:]] = far[s[2:], s[:2]] = math.dist(s[:2], s[2:])
        for k in corners:
            for a in corners:
                for b in corners:
                    far[a, b] = min(far[a, b], far[a, k] + far[k, b])
        half = [math.dist(s[:2], s[2:]) / 2 for s in self.segments]
        return [[min(far[p, q] for p in (s[:2], s[2:]) for q in (t[:2], t[2:])) + half[i] + half[j]
                 for j, t in enumerate(self.segments)] for i, s in enumerate(self.segments)]

    def test_lines_are_cut_where_they_cross(self):
        self.assertEqual(sum(x1 >= 200 and x1 < 500 for x1, *_ in self.segments), 4)

    def test_all(self):
        n = len(self.segments)
        self.next_states = [list(self.after(state)) for state in range(2 * n)]
        far = self.middles()
        searches = [self.search(root) for root in range(n)]
        for ending, wanted in (
                ("", lambda i, j, turn: True),
                ("_r90_metric", lambda i, j, turn: far[i][j] <= 90),
                ("_r1_angular", lambda i, j, turn: turn <= 256)):
            choice = [0.0] * n
            for root, (keys, before) in enumerate(searches):
                nodes, total = 1, 0
                for to in range(n):
                    best = min((keys[s] for s in (2 * to, 2 * to + 1) if s in keys), default=None)
                    if to == root or best is None or not wanted(root, to, best[0]):
                        continue
                    nodes, total = nodes + 1, total + best[0] / 256
                    every = [path for s in (2 * to, 2 * to + 1) if keys.get(s) == best
                             for path in self.paths(before, s)]
                    if root < to:
                        for path in every:
                            for at in path:
                                choice[at // 2] += 1 / len(every)
                row = self.rows[root]
                self.assertEqual(int(row["t1024_node_count" + ending]), nodes)
                self.assertAlmostEqual(float(row["t1024_total_depth" + ending]), total, 9)
                if total:
                    self.assertAlmostEqual(float(row["t1024_integration" + ending]),
                                           nodes ** 2 / total, 6)
            for row, value in zip(self.rows, choice, strict=True):
                self.assertAlmostEqual(float(row["t1024_choice" + ending]), value, 4)
            self.assertGreater(max(choice), 1)

    def paths(self, before, state):
        """What lies between the root and a state, on all best paths."""
        if not before[state]:
            return [[]]
        return [path + ([last] if before[last] else [])
                for last in before[state] for path in self.paths(before, last)]

    def test_threads_do_not_matter(self):
        for command in (["segments", "streets.map"], ["axial", "streets.map", "--lines", "drawn"],
                        ["axial", str(MAPS / "gallery.map"), "--lines", "fewest"]):
            one, three = (table([*command, "--threads", threads], [("streets.map", self.text)])
                          for threads in ("1", "3"))
            self.assertEqual(one, three)

    def test_lines_without_a_value_are_drawn(self):
        with sandbox.Sandbox(PROGRAM) as box:
            box.path("one.csv").write_text("0,0,1,1\n")
            result = box.run(["axial", "one.csv", "--picture", "one.svg", "--quiet"])
            self.assertEqual(result.status, 0, result.text())
            picture = box.path("one.svg").read_text()
        self.assertEqual(len(re.findall(r'<path style="fill:none;[^>]*stroke:rgb', picture)), 1)


if __name__ == "__main__":
    PROGRAM = sandbox.program_argument()
    unittest.main()
