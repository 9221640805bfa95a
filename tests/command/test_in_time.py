"""No command takes much longer for a map because of where its walls lie: test_in_time.py PROGRAM

Rooms with doors, and the same: with one wall far away, as a spot in a large frame, with all walls
in one place many times, with walls that meet at one point. Also combs, walls at random, a wall
through all others, and many walls within the width of a gap. Times are those of the processor, so
other programs do no harm. A limit is ten times the bake of the map, and a second.
"""
import math
import resource
import unittest

import sandbox

PROGRAM = None
WALLS = 5000


def rooms(count=WALLS):
    side = int(math.sqrt(count / 5))
    walls = [(0, 0, 10 * side, 0), (0, 0, 0, 10 * side), (10 * side, 0, 10 * side, 10 * side),
             (0, 10 * side, 10 * side, 10 * side)]
    for i in range(side):
        for k in range(side):
            x, y = 10 * i, 10 * k
            walls.append((x + 3 + i % 3, y + 3 + k % 4, x + 4 + i % 3, y + 3 + k % 4))
            if k:
                walls += [(x, y, x + 4, y), (x + 6, y, x + 10, y)]
            if i:
                walls += [(x, y, x, y + 4), (x, y + 6, x, y + 10)]
    return walls


def turned(walls):
    return [(x * 0.8 - y * 0.6, x * 0.6 + y * 0.8, u * 0.8 - v * 0.6, u * 0.6 + v * 0.8)
            for x, y, u, v in walls]


def frame(size):
    return [(-size, -size, size, -size), (size, -size, size, size), (size, size, -size, size),
            (-size, size, -size, -size)]


def spokes():
    angles = [2 * math.pi * i / (WALLS // 4) for i in range(WALLS // 4)]
    return [(0, 0, 100 * math.cos(a), 100 * math.sin(a)) for a in angles] + frame(120)


def growing():
    """Walls at growing distances: many lie within the width of a gap from the ends of the first."""
    return [(1.002 ** i, 0, 1.002 ** i, 1.002 ** i) for i in range(WALLS)]


def scattered(count):
    walls, number = [], 1
    for _ in range(count):
        values = []
        for _ in range(3):
            number = number * 6364136223846793005 + 1442695040888963407 & (1 << 64) - 1
            values.append((number >> 11) / (1 << 53))
        x, y, angle = values[0] * count / 10, values[1] * count / 10, values[2] * 7
        walls.append((x, y, x + 10 * math.cos(angle), y + 10 * math.sin(angle)))
    return walls + frame(count)


def diagonal():
    """One long wall through many short ones."""
    short = [(i, i + 0.3, i + 0.6, i - 0.3) for i in range(2 * WALLS)]
    return [*short, (-5, -5.1, 2 * WALLS + 5, 2 * WALLS + 5.2)]


FAR = [(1e7, 1e7, 1e7 + 1, 1e7)]
MAPS = {
    "rooms": rooms(),
    "far": rooms() + FAR,
    "turned": turned(rooms()),
    "turned_far": turned(rooms()) + FAR,
    "spot": rooms() + frame(1e7),
    "stack": [(5, 5, 6, 5)] * WALLS + frame(10),
    "nested": [(0, 0, i + 1, 0) for i in range(WALLS)],
    "spokes": spokes(),
    "parallel": [(0, i, 1000, i) for i in range(WALLS // 2)] + frame(WALLS),
    "comb": [*((i, 0, i, 1) for i in range(2 * WALLS)), (-1, 1.5, 2 * WALLS, 1.5),
             (-1, -1, 2 * WALLS, -1), (-1, -1, -1, 1.5), (2 * WALLS, -1, 2 * WALLS, 1.5)],
    "scattered": scattered(2 * WALLS),
    "diagonal": diagonal(),
    "growing": growing(),
    "few": rooms(600),
    "few_far": rooms(600) + FAR,
}
MANY = "comb", "scattered", "diagonal", "growing"


class InTime(unittest.TestCase):
    def seconds(self, box, *arguments):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        result = box.run([*arguments, "--quiet"] if arguments[0] == "bake" else arguments)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertEqual(result.status, 0, result.text())
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, result

    def write(self, box, name, start=(1.5, 1.25)):
        lines = [f"wall {a!r} {b!r} {c!r} {d!r}" for a, b, c, d in MAPS[name]]
        text = "\n".join(["sightline 1", *lines, f"start {start[0]} {start[1]} 0", ""])
        box.path(f"{name}.map").write_text(text)

    def test_check(self):
        for name in MAPS.keys() - {"parallel", "few", "few_far", *MANY}:
            with self.subTest(name), sandbox.Sandbox(PROGRAM) as box:
                self.write(box, name)
                bake, _ = self.seconds(box, "bake", f"{name}.map", "-o", f"{name}.slv")
                for command in (["check", f"{name}.map"], ["info", f"{name}.map"],
                                ["check", f"{name}.map", "--gap", "0.01", "--snap", "o.map"],
                                ["convert", f"{name}.map", "--clean", "-o", "c.map"]):
                    took, _ = self.seconds(box, *command)
                    self.assertLess(took, 10 * bake + 1, f"{command}: a bake takes {bake}")

    def test_check_of_many(self):
        """Maps that are slow to bake: check takes no longer than 20 bakes of rooms."""
        with sandbox.Sandbox(PROGRAM) as box:
            self.write(box, "rooms")
            bake, _ = self.seconds(box, "bake", "rooms.map", "-o", "rooms.slv")
            for name in MANY:
                with self.subTest(name):
                    self.write(box, name)
                    took, _ = self.seconds(box, "check", f"{name}.map")
                    self.assertLess(took, 20 * bake + 1, f"a bake of rooms takes {bake}")

    def test_a_corner_of_many_portals(self):
        """Each gap between the lines is a portal of the one cell beside them."""
        with sandbox.Sandbox(PROGRAM) as box:
            self.write(box, "parallel", (-10, -10))
            bake, _ = self.seconds(box, "bake", "parallel.map", "-o", "parallel.slv")
            for command in ["eye", "isovist"]:
                took, _ = self.seconds(box, command, "parallel.slv", "--at", "1.5,1.25")
                self.assertLess(took, 10 * bake + 1, f"{command}: a bake takes {bake}")

    def test_a_wall_far_away(self):
        """The same work in the same rooms, whether there is a wall far away or not."""
        for command in (["walk"], ["axial", "-o", "lines.csv"]):
            with self.subTest(command), sandbox.Sandbox(PROGRAM) as box:
                self.write(box, "few")
                self.write(box, "few_far")
                alone, _ = self.seconds(box, command[0], "few.map", *command[1:])
                far, _ = self.seconds(box, command[0], "few_far.map", *command[1:])
                self.assertLess(far, 4 * alone + 1)

    def test_it_is_named(self):
        with sandbox.Sandbox(PROGRAM) as box:
            self.write(box, "far")
            text = box.run(["check", "far.map"]).stdout
        line = len(MAPS["far"]) + 1
        self.assertIn("1 stray (", text)
        self.assertIn(f"    line {line}, at (10000001,10000000), 1.41", text)
        self.assertIn("correct or remove it in far.map", text)
        self.assertTrue(text.endswith("next: sightline check far.map\n"), text)


if __name__ == "__main__":
    PROGRAM = sandbox.program_argument()
    unittest.main()
