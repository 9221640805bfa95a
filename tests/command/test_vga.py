"""Visibility graph analysis beside other programs' and brute force: test_vga.py PROGRAM [REFERENCE PLAN]

REFERENCE has depthmapX' values for PLAN, on a grid of 0.04. Where they are missing, that part is
skipped with a message. The values of depthmapX have eight digits, and it adds up in single precision.
"""
import csv
import gzip
import heapq
import itertools
import json
import math
import pathlib
import sys
import tempfile
import unittest

import sandbox
from case import MAPS

PROGRAM = REFERENCE = PLAN = None

# How far values may differ, relatively. By default 1e-6.
SINGLE = 1e-5  # sums of thousands of numbers in single precision
ALLOWED = {"visual_control": SINGLE, "metric_mean_shortest_path_distance": SINGLE,
           "metric_mean_straight_line_distance": SINGLE, "metric_mean_shortest_path_angle": SINGLE,
           "angular_mean_depth": SINGLE, "angular_total_depth": SINGLE}
# A line that runs exactly between two squares passes both. depthmapX adds up rounded steps, and
# then misses some of these ties: it counts less, and here by up to this share.
TIES = {"through_vision": 0.25}


def column(name):
    """The name of depthmapX, as a column here."""
    name = name.lower().removeprefix("isovist ")
    for old, new in (("[", ""), ("]", ""), ("p-value", "pvalue"), (" ", "_"), ("-", "_")):
        name = name.replace(old, new)
    return name


class Reference(unittest.TestCase):
    def setUp(self):
        if not REFERENCE or not REFERENCE.exists() or not PLAN.exists():
            self.skipTest("the reference values of depthmapX are missing")

    def test_all_columns_agree(self):
        with gzip.open(REFERENCE, "rt") as file:
            expected = list(csv.DictReader(file))
        with tempfile.TemporaryDirectory() as folder, sandbox.Sandbox(PROGRAM) as box:
            table = pathlib.Path(folder) / "all.csv"
            result = box.run(["vga", str(PLAN), "--grid", "0.04", "--at", "3,6", "--measures", "all",
                              "--quiet", "-o", str(table)], timeout=600)
            self.assertEqual(result.status, 0, result.text())
            with open(table) as file:
                rows = list(csv.DictReader(file))
        self.compare(expected, rows)

    def compare(self, expected, rows):
        def place(row):
            return round(float(row["x"]) / 0.04), round(float(row["y"]) / 0.04)
        ours = {place(row): row for row in rows}
        self.assertEqual(len(rows), len(expected))
        self.assertEqual(set(ours), {place(row) for row in expected})
        compared = 0
        for name in expected[0]:
            measure = column(name)
            if measure not in rows[0]:
                self.assertEqual(name, "Ref")
                continue
            worst, example, beyond = 0, "", 0
            for row in expected:
                theirs, mine = float(row[name]), float(ours[place(row)][measure])
                off = abs(theirs - mine) / max(abs(theirs), abs(mine), 1e-12)
                if measure == "drift_angle":  # of a circle; small drifts have a direction of noise
                    off = abs((theirs - mine + 180) % 360 - 180) / 360
                beyond += off > 1e-6
                if off > worst:
                    worst, example = off, f"at {row['x']},{row['y']}: {theirs:g}, here {mine:.9g}"
            print(f"{measure}: largest difference {worst:.1e}, {beyond} beyond 1e-6 {example}")
            if measure in TIES:
                self.assertLessEqual(worst, TIES[measure], f"{measure} {example}")
                self.assertTrue(all(float(ours[place(row)][measure]) >= float(row[name])
                                    for row in expected), f"{measure}: less than there")
            else:
                self.assertLessEqual(worst, ALLOWED.get(measure, 1e-6), f"{measure} {example}")
            compared += 1
        self.assertGreaterEqual(compared, 30)


# Walls lie at quarters, so that no point is on one. No line passes where walls meet.
SMALL = [(0.25, 0.25, 8.75, 0.25), (8.75, 0.25, 8.75, 5.75), (8.75, 5.75, 0.25, 5.75),
         (0.25, 5.75, 0.25, 0.25), (3.25, 0.25, 3.25, 2.25), (3.25, 3.75, 3.25, 5.75),
         (6.25, 1.75, 6.25, 5.75), (4.25, 3.75, 5.25, 4.25)]


def side(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def crosses(p, q, wall):
    """Properly: to touch a wall's end is not to be stopped. All numbers are exact."""
    a, b = wall[:2], wall[2:]
    return side(p, q, a) * side(p, q, b) < 0 and side(a, b, p) * side(a, b, q) < 0


def beside_wall(point):
    """Whether a wall touches one of the nine squares about a point."""
    x, y = point
    return any(min(w[0], w[2]) <= x + 1.5 and max(w[0], w[2]) >= x - 1.5 and
               min(w[1], w[3]) <= y + 1.5 and max(w[1], w[3]) >= y - 1.5 for w in SMALL)


def steps(graph, place, start):
    """Depths by point. `place`: the points that count as one with a point, itself included."""
    depths, level = dict.fromkeys(place[start], 0), place[start]
    while level:
        seen = {r for p in level for q in graph[p] for r in place[q]} - set(depths)
        depths.update(dict.fromkeys(seen, depths[next(iter(level))] + 1))
        level = seen
    return depths


def lengths(points, graph, place, turns, start):
    """Shortest paths, which turn where `turns` says so."""
    found, heap = {}, [(0.0, start)]
    while heap:
        length, p = heapq.heappop(heap)
        if p in found:
            continue
        found[p] = length
        for q in place[p] - {p}:
            heapq.heappush(heap, (length, q))
        if p == start or turns(p):
            for q in graph[p]:
                heapq.heappush(heap, (length + math.dist(points[p], points[q]), q))
    return found


class NoValue(unittest.TestCase):
    """What a formula does not define is a blank in CSV and null in GeoJSON."""

    def properties(self, *arguments):
        with tempfile.TemporaryDirectory() as folder, sandbox.Sandbox(PROGRAM) as box:
            plan, out = (pathlib.Path(folder) / name for name in ("corner.map", "all.geojson"))
            plan.write_text("sightline 1\nwalls 0.75 0.75 2.25 0.75 2.25 2.25 1.75 2.25 1.75 1.25 "
                            "0.75 1.25 0.75 0.75\n")
            result = box.run(["vga", str(plan), "--grid", "1", *arguments, "--quiet", "-o", str(out)])
            self.assertEqual(result.status, 0, result.text())
            found = json.loads(out.read_text(), parse_constant=self.fail)
        return [feature["properties"] for feature in found["features"]]

    def test_geojson_has_null(self):
        rows = self.properties()
        self.assertEqual([row["visual_integration_tekl"] for row in rows], [None] * 3)
        self.assertEqual([row["visual_integration_hh"] is None for row in rows], [False, True, False])

    def test_geojson_of_a_change_has_null(self):
        for row in self.properties("--compare", str(MAPS / "office.map")):
            for ending in ("", "_change"):
                self.assertIsNone(row["visual_integration_tekl" + ending])
            self.assertIn("visual_integration_hh_other", row)


class BruteForce(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder, sandbox.Sandbox(PROGRAM) as box:
            plan, table = pathlib.Path(folder) / "small.map", pathlib.Path(folder) / "all.csv"
            plan.write_text("sightline 1\n" + "".join(
                "wall " + " ".join(map(str, wall)) + "\n" for wall in SMALL))
            result = box.run(["vga", str(plan), "--grid", "1", "--measures", "all", "--from", "1,1",
                              "--quiet", "-o", str(table)])
            if result.status:
                raise AssertionError(result.text())
            with open(table) as file:
                cls.rows = list(csv.DictReader(file))
        cls.points = [(float(row["x"]), float(row["y"])) for row in cls.rows]
        cls.graph = [[j for j, q in enumerate(cls.points) if i != j and
                      not any(crosses(p, q, wall) for wall in SMALL)]
                     for i, p in enumerate(cls.points)]
        cls.place = {i: {i} for i in range(len(cls.points))}

    def check(self, measure, expected):
        for row, value in zip(self.rows, expected, strict=True):
            self.assertAlmostEqual(float(row[measure]), value, delta=1e-6 * max(1, abs(value)),
                                   msg=f"{measure} at {row['x']},{row['y']}")

    def steps(self, start):
        return steps(self.graph, self.place, start)

    def shortest(self, start):
        return lengths(self.points, self.graph, self.place,
                       lambda p: beside_wall(self.points[p]), start)

    def test_grid(self):
        self.assertEqual(self.points, [(x, y) for x in range(1, 9) for y in range(1, 6)])

    def test_local(self):
        graph, points = self.graph, self.points
        self.check("connectivity", map(len, graph))
        self.check("visual_control", (sum(1 / len(graph[q]) for q in row) for row in graph))
        self.check("visual_controllability", (
            len(row) / len(set(itertools.chain(*(graph[q] for q in row)))) for row in graph))
        self.check("visual_clustering_coefficient", (
            sum(b in graph[a] for a in row for b in row) / len(row) / (len(row) - 1)
            for row in graph))
        self.check("point_first_moment", (sum(math.dist(p, points[q]) for q in row)
                                          for p, row in zip(points, graph)))
        self.check("point_second_moment", (sum(math.dist(p, points[q]) ** 2 for q in row)
                                           for p, row in zip(points, graph)))

    def test_global(self):
        n, means = len(self.points), []
        for start in range(n):
            depths = self.steps(start)
            self.assertEqual(len(depths), n)
            means.append(sum(depths.values()) / (n - 1))
        self.check("visual_mean_depth", means)
        diamond = 2 * (n * (math.log2((n + 2) / 3) - 1) + 1) / ((n - 1) * (n - 2))
        self.check("visual_integration_hh", (diamond * (n - 2) / (2 * (m - 1)) for m in means))
        from_first = self.steps(self.points.index((1, 1)))
        self.check("visual_step_depth", (from_first[p] for p in range(n)))

    def test_paths(self):
        every = [self.shortest(p) for p in range(len(self.points))]
        self.check("metric_mean_shortest_path_distance",
                   (sum(each.values()) / len(each) for each in every))
        self.check("metric_node_count", map(len, every))


class Linked(unittest.TestCase):
    """Two floors side by side. Stairs link two points, which count as one place."""
    FLOORS = SMALL + [(a + 20, b, c + 20, d) for a, b, c, d in SMALL[:6]]
    LINKS = [((8, 5), (21, 5)), ((21, 5), (28, 1)), ((1, 1), (23, 3))]

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder, sandbox.Sandbox(PROGRAM) as box:
            plan, table, links = (pathlib.Path(folder) / name for name in
                                  ("floors.map", "all.csv", "links.csv"))
            plan.write_text("sightline 1\n" + "".join(
                "wall " + " ".join(map(str, wall)) + "\n" for wall in cls.FLOORS))
            links.write_text("x1\ty1\tx2\ty2\n" + "".join(
                f"{a[0]}\t{a[1]}\t{b[0]}\t{b[1]}\n" for a, b in cls.LINKS))
            result = box.run(["vga", str(plan), "--grid", "1", "--measures", "visual,metric,angular",
                              "--from", "24,3", "--links", str(links), "--quiet", "-o", str(table)])
            if result.status:
                raise AssertionError(result.text())
            with open(table) as file:
                cls.rows = list(csv.DictReader(file))
        cls.points = [(float(row["x"]), float(row["y"])) for row in cls.rows]
        cls.number = {p: i for i, p in enumerate(cls.points)}
        cls.graph = [[j for j, q in enumerate(cls.points) if i != j and
                      not any(crosses(p, q, wall) for wall in cls.FLOORS)]
                     for i, p in enumerate(cls.points)]
        # One link shares a point with another: three points are one place.
        groups = [{cls.number[p] for p in cls.LINKS[0] + cls.LINKS[1]},
                  {cls.number[p] for p in cls.LINKS[2]}]
        cls.place = {i: next((g for g in groups if i in g), {i}) for i in range(len(cls.points))}

    def beside(self, i):
        x, y = self.points[i]
        return any(min(w[0], w[2]) <= x + 1.5 and max(w[0], w[2]) >= x - 1.5 and
                   min(w[1], w[3]) <= y + 1.5 and max(w[1], w[3]) >= y - 1.5 for w in self.FLOORS)

    def steps(self, start):
        return steps(self.graph, self.place, start)

    def lengths(self, start):
        return lengths(self.points, self.graph, self.place,
                       lambda p: self.beside(p) or len(self.place[p]) > 1, start)

    def mean(self, depths, more):
        one_each = {min(self.place[p]): value for p, value in depths.items()}
        return sum(one_each.values()) / (len(one_each) - more)

    def test_steps(self):
        nodes = len({min(place) for place in self.place.values()})
        for i, row in enumerate(self.rows):
            self.assertEqual(int(row["visual_node_count"]), nodes)
            self.assertAlmostEqual(float(row["visual_mean_depth"]), self.mean(self.steps(i), 1), 9)
        from_one = self.steps(self.number[24, 3])
        self.assertEqual([float(row["visual_step_depth"]) for row in self.rows],
                         [from_one[i] for i in range(len(self.rows))])
        self.assertEqual([int(row["connectivity"]) for row in self.rows], list(map(len, self.graph)))

    def test_paths(self):
        for i, row in enumerate(self.rows):
            self.assertAlmostEqual(float(row["metric_mean_shortest_path_distance"]),
                                   self.mean(self.lengths(i), 0), 5)
        from_one = self.lengths(self.number[24, 3])
        for i, row in enumerate(self.rows):
            self.assertAlmostEqual(float(row["metric_step_shortest_path_length"]), from_one[i], 5)


class Random:
    """SplitMix64"""
    MASK = (1 << 64) - 1

    def __init__(self, seed):
        self.state = seed & self.MASK

    def next(self):
        self.state = z = (self.state + 0x9e3779b97f4a7c15) & self.MASK
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9 & self.MASK
        z = (z ^ z >> 27) * 0x94d049bb133111eb & self.MASK
        return z ^ z >> 31


class Agents(BruteForce):
    """The same walks, on the plan and the graph of brute force."""
    test_grid = test_local = test_global = test_paths = None

    def walk(self, seed, agent, steps, counts):
        random = Random(seed ^ (agent + 1) * 0xbf58476d1ce4e5b9)
        random = Random(random.next())
        number = {p: i for i, p in enumerate(self.points)}
        at, heading = random.next() % len(self.points), None
        while steps:
            def ahead(q, origin=self.points[at], heading=heading):
                way = [self.points[q][k] - origin[k] for k in (0, 1)]
                if heading is None:
                    return True
                turn = math.atan2(heading[0] * way[1] - heading[1] * way[0],
                                  heading[0] * way[0] + heading[1] * way[1])
                return abs(turn) <= math.radians(85)
            seen = [q for q in self.graph[at] if ahead(q)] or self.graph[at]
            goal = seen[random.next() % len(seen)]
            origin = at
            heading = [self.points[goal][k] - self.points[at][k] for k in (0, 1)]
            length = max(abs(heading[0]), abs(heading[1]))
            for k in range(1, int(min(3, length)) + 1):
                place = tuple(self.points[origin][i] + math.floor(k * heading[i] / length + 0.5)
                              for i in (0, 1))
                if not steps or number.get(place) not in self.graph[origin]:
                    break
                at, steps = number[place], steps - 1
                counts[at] += 1
            if at == origin:
                heading, steps = None, steps - 1

    def test_walks(self):
        counts = [0] * len(self.points)
        for agent in range(25):
            self.walk(7, agent, 40, counts)
        with sandbox.Sandbox(PROGRAM) as box:
            box.path("small.map").write_text("sightline 1\n" + "".join(
                "wall " + " ".join(map(str, wall)) + "\n" for wall in SMALL))
            for threads in "1", "3":
                result = box.run(["vga", "small.map", "--grid", "1", "--agents", "25", "--seed", "7",
                                  "--agent-steps", "40", "--measure", "gate_counts", "--quiet",
                                  "--threads", threads])
                rows = list(csv.DictReader(result.stdout.splitlines()))
                self.assertEqual([int(row["gate_counts"]) for row in rows], counts)
        self.assertGreater(len(set(counts)), 5)


class Scale(sandbox.ProgramTest):
    """A court that nobody looks into, with a pillar, in a hall with side rooms."""

    def test_small_parts_do_not_set_it(self):
        self.box.path("court.map").write_text(
            "sightline 1\nwalls 0 0 40 0 40 30 0 30 0 0\nwalls 18 13 22 13 22 17 18 17 18 13\n"
            "walls 19.9 15.1 20.1 15.1 20.1 15.3 19.9 15.3 19.9 15.1\n"
            "wall 10 0 10 12\nwall 10 14 10 30\nwall 30 0 30 12\nwall 30 14 30 30\n")
        note = (r"note: the colour scale leaves out 9 points in 1 small part, not seen from the rest; .*"
                r"add --start X,Y there\n")
        grey = (r"note: 2 parts that no sightline joins, numbered in the column 'part': the largest has "
                r"1050 of 1059 points\nnote: the colours are those of the largest part; the other is grey")
        for command, measure, *options in (("vga", "visual_integration_hh"), ("isovist", "area"),
                                           ("vga", "area", "--measures", "isovist")):
            with self.subTest(command=command, measure=measure):
                arguments = [command, "court.map", "--grid", "1", "--measure", measure, *options]
                told = self.run_well(*arguments, "--picture", "a.svg").stderr
                self.assertRegex(told, note if command == "vga" and measure == "area" else
                                 "the colour scale leaves out" if command == "isovist" else grey)
                told = self.run_well(*arguments, "--picture", "b.svg", "--start", "5,5").stderr
                self.assertNotRegex(told, "the colour|parts")
                told = self.run_well(*arguments, "--picture", "c.svg", "--scale", "0,9").stderr
                self.assertNotIn("the colour", told)
        tables = [self.printed("vga", "court.map", "--grid", "1", "-o", "-", "-q", *picture)
                  for picture in ([], ["--picture", "d.svg"])]
        self.assertEqual(*tables)

    def test_parts_have_their_own_figures(self):
        """A court of its own is grey, has its own mean, and changes no figure of the hall."""
        walls = ("sightline 1\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 6\nwall 4 4 8 4\n")
        court = ("walls 30 0 36 0 36 6 30 6 30 0\nwall 33 0 33 4\nstart 31 1 0\n")
        self.box.path("hall.map").write_text(walls + "start 1 1 0\n")
        self.box.path("both.map").write_text(walls + court + "start 1 1 0\n")
        arguments = ["--grid", "1", "-o", "t.csv", "--picture", "p.svg"]
        alone = self.run_well("vga", "hall.map", *arguments).stdout
        rows = [row.split(",") for row in self.box.path("t.csv").read_text().split()]
        self.assertNotIn("part", rows[0])
        both = self.run_well("vga", "both.map", *arguments).stdout
        # The same means, deviations and ranks, then the line of the court.
        figures, others = both.split("other parts:\n")
        self.assertEqual(figures.split("\n", 1)[1], alone.split("\n", 1)[1])
        self.assertRegex(figures, r"^181 points in 2 parts that no sightline joins; .* largest, 160 points\n")
        self.assertRegex(others, r"\A +part .*\n +2 +21 +31 +1 +[\d.]+\n\Z")
        with_part = [row.split(",") for row in self.box.path("t.csv").read_text().split()]
        self.assertEqual(with_part[0], rows[0] + ["part"])
        self.assertEqual([row[:-1] for row in with_part[1:] if row[-1] == "1"], rows[1:])
        self.assertEqual(len([row for row in with_part if row[-1] == "2"]), 21)
        # Steps from a point of the court are the court's.
        steps = self.run_well("vga", "both.map", *arguments, "--from", "31,1", "--measure",
                              "visual_step_depth").stdout
        self.assertRegex(steps, r"highest visual_step_depth:\n.*\n +3[1-5] ")


if __name__ == "__main__":
    sandbox.ProgramTest.program = PROGRAM = sys.argv[1]
    if len(sys.argv) > 3:
        REFERENCE, PLAN = map(pathlib.Path, sys.argv[2:4])
    unittest.main(argv=sys.argv[:1])
