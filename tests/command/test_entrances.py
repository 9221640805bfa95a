"""A house with thick walls and an open entrance: what is inside, whatever the format and the command.

test_entrances.py PROGRAM
"""
import csv
import io
import json
import math
import re

import sandbox

TURNS = 0, 17.3
FORMATS = "map", "dxf", "svg"
WIDE = ["vga", "--grid", "0.5"], ["axial"], ["isovist", "--grid", "0.5"]


def turned(x, y, degrees):
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return (x * cos - y * sin, x * sin + y * cos) if degrees else (x, y)


def house(entrance):
    """Walls 0.3 thick, 10 by 8: a hall, a room behind a door, and one that is closed."""
    e = 3 + entrance
    return [[(e, 0), (10, 0), (10, 8), (0, 8), (0, 0), (3, 0), (3, 0.3), (0.3, 0.3), (0.3, 4)],
            [(e, 0), (e, 0.3), (9.7, 0.3), (9.7, 4)],
            [(0.3, 4), (2, 4), (2, 4.3)],
            [(2.9, 4.3), (2.9, 4), (9.7, 4)],
            [(2, 4.3), (0.3, 4.3), (0.3, 7.7), (4.85, 7.7), (4.85, 4.3), (2.9, 4.3)],
            [(5.15, 4.3), (5.15, 7.7), (9.7, 7.7), (9.7, 4.3), (5.15, 4.3)],
            [(-3, -3), (-2, -3)]]


def area_inside(entrance):
    return 9.4 * 3.7 + 2 * 4.55 * 3.4 + 0.3 * entrance + 0.3 * 0.9


def is_room(x, y):
    hall, rooms = 0.3 <= x <= 9.7 and 0.3 <= y <= 4, 4.3 <= y <= 7.7
    return (hall or rooms and (0.3 <= x <= 4.85 or 5.15 <= x <= 9.7) or
            2 <= x <= 2.9 and 4 <= y <= 4.3 or 3 <= x <= 5 and 0 <= y <= 0.3)


class Entrances(sandbox.ProgramTest):
    def write(self, name, entrance, degrees=0, first=()):
        lines = ["sightline 1", *first]
        for walls in house(entrance):
            numbers = (f"{value!r}" for point in walls for value in turned(*point, degrees))
            lines.append("walls " + " ".join(numbers))
        self.box.path(name).write_text("\n".join([*lines, ""]), encoding="utf-8")

    def inside(self, name, *options):
        """(cells inside, area inside)"""
        told = json.loads(self.printed("bake", name, "-o", "inside.slv", "--json", "-q", *options))
        x0, y0, x1, y1 = json.loads(self.printed("export", "inside.slv", "-q"))["bounds"]
        return told["inside_cells"], told["inside_share"] * (x1 - x0) * (y1 - y0)

    def same_inside(self, name, wanted, *options):
        cells, area = self.inside(name, *options)
        self.assertEqual(cells, wanted[0], name)
        self.assertAlmostEqual(area, wanted[1], delta=1e-9, msg=name)

    def statements(self, name):
        """What map text says of the unit and of entrances."""
        text = self.box.path(name).read_text(encoding="utf-8")
        return re.findall(r"^(?:unit|entrance) .*$", text, re.MULTILINE)

    def test_kept(self):
        """Converted and baked, a house keeps its inside, and what map text says of it."""
        for degrees in TURNS:
            for first in [], ["unit m"], ["entrance 1.125"], ["unit m", "entrance 1.125"]:
                with self.subTest(degrees=degrees, first=first):
                    self.write("a.map", 1, degrees, first)
                    wanted = self.inside("a.map")
                    self.assertAlmostEqual(wanted[1], area_inside(1), delta=1e-9)
                    self.printed("bake", "a.map", "-o", "a.slv", "-q")
                    for source, name in (("a.map", "b.map"), ("a.slv", "c.map"), ("b.map", "d.dxf"),
                                         ("b.map", "e.svg"), ("c.map", "f.dxf"), ("d.dxf", "g.map")):
                        self.printed("convert", source, "-o", name, "-q")
                        self.same_inside(name, wanted)
                        if source[0] in "ab" and name.endswith("map") or name == "c.map":
                            self.assertEqual(self.statements(name), first)
                    self.assertEqual(self.statements("g.map"), [s for s in first if "unit" in s])
                    # The option comes before what the file says.
                    self.printed("convert", "a.map", "--entrance", "1.5", "-o", "h.map", "-q")
                    self.assertIn("entrance 1.5", self.statements("h.map"))
                    self.same_inside("h.map", wanted)

    def test_what_is_lost(self):
        """Formats without a place for them say so."""
        self.write("a.map", 1, 0, ["unit m", "entrance 1.125"])
        for name, unit in ("a.dxf", False), ("a.svg", True), ("a.tmx", True):
            told = self.run_well("convert", "a.map", "-o", name).stderr
            self.assertEqual("has no place for the unit, which is left out" in told, unit, told)
            self.assertIn("has no place for the width of entrances, which is left out", told)
        told = self.run_well("convert", "a.map", "-o", "b.map").stderr
        self.assertNotIn("has no place", told)

    def test_too_wide(self):
        """An opening of 2 is doubtful. Messages name the option to type, which helps."""
        for degrees in TURNS:
            self.write("a.map", 2, degrees, ["unit m"])
            for ending in FORMATS:
                name = f"b.{ending}"
                self.printed("convert", "a.map", "-o", name, "-q")
                with self.subTest(degrees=degrees, format=ending):
                    told = self.run_well("bake", name, "-o", "b.slv").stderr
                    self.assertRegex(told, r"an opening 2( m)? wide, at .* so inside is doubtful: all "
                                     r"of the map counts as inside; a start in a room decides it, "
                                     r"or an entrance of 2 if the opening is one; if it is one, run: "
                                     rf"sightline check {name} --entrance 2\n")
                    for command, *options in WIDE:
                        self.refused_and_typed(command, name, options, degrees)
                    cells, area = self.inside(name, "--entrance", "2")
                    self.assertAlmostEqual(area, area_inside(2), delta=1e-9)

    def test_too_wide_beside_a_closed_room(self):
        """What is inside without the doubtful opening is no answer, until somebody decides."""
        self.write("a.map", 2, 0, ["unit m", "walls 20 0 24 0 24 4 20 4 20 0"])
        for command, *options in *WIDE, ["rooms"], ["report", "-o", "a.pdf"]:
            refused = self.box.run([command, "a.map", *options])
            self.assertEqual(refused.status, 2, refused.text())
            typed = re.search(r"; if the opening is an entrance, add (--entrance 2); else add a start",
                              refused.stderr)
            self.assertTrue(typed, refused.stderr)
            self.assertNotIn("--start", refused.stderr)  # it would keep the closed room alone
            self.run_well(command, "a.map", *options, *typed[1].split())

    def test_kept_of_drawings(self):
        """In a plan that is drawn, a wide entrance is found. Map text keeps it; doors stay narrow."""
        for entrance, kept in (2, ["entrance 200"]), (1, []):
            lines = "".join("<polyline points='" + " ".join(f"{100 * x} {100 * y}" for x, y in line) + "'/>"
                            for line in house(entrance))
            self.box.path("a.svg").write_text(
                "<svg xmlns='http://www.w3.org/2000/svg' fill='none' stroke='#000'>"
                f"<g id='walls'>{lines}</g><g id='table'><circle cx='500' cy='200' r='40'/></g></svg>",
                encoding="utf-8")
            self.printed("convert", "a.svg", "-o", "a.map", "-q")
            self.assertEqual(self.statements("a.map"), kept)
            wanted = self.inside("a.svg")
            self.assertAlmostEqual(wanted[1], 1e4 * area_inside(entrance), delta=1e-5)
            self.same_inside("a.map", wanted)

    def test_rooms_end_at_entrances(self):
        """A hall is a room, though its entrance is wider than doors."""
        self.write("a.map", 2, 0, ["unit m"])
        table = self.printed("rooms", "a.map", "--entrance", "2", "-q")
        areas = sorted(float(row["area"]) for row in csv.DictReader(io.StringIO(table)))
        for area, wanted in zip(areas, (4.55 * 3.4, 4.55 * 3.4, 9.4 * 3.7 + 0.3 * 2), strict=True):
            self.assertAlmostEqual(area, wanted, delta=1e-9)

    def refused_and_typed(self, command, name, options, degrees):
        refused = self.box.run([command, name, *options])
        self.assertEqual(refused.status, 2, refused.text())
        typed = re.search("if the opening is an entrance, add (--entrance 2)", refused.stderr)
        self.assertTrue(typed, refused.stderr)
        table = self.printed(command, name, *options, *typed[1].split(), "-o", "-", "-q")
        rows = list(csv.DictReader(io.StringIO(table)))
        self.assertTrue(rows)
        if command == "axial":
            return
        self.assertGreater(len(rows), 200)
        for row in rows:
            x, y = turned(float(row["x"]), float(row["y"]), -degrees)
            self.assertTrue(is_room(round(x, 9), round(y, 9)), (command, name, x, y))

    def test_next(self):
        """What check prints last is done as it stands, until the map is baked."""
        self.write("a.map", 2, 17.3, ["unit m"])
        for ending in FORMATS:
            name = f"b.{ending}"
            self.printed("convert", "a.map", "-o", name, "-q")
            told = self.printed("check", name)
            self.assertTrue(told.endswith(f"next: sightline check {name} --entrance 2\n"), told)
            told = self.printed("check", name, "--entrance", "2", "--strict")
            for word in "doubtful", "--start", "leak":
                self.assertNotIn(word, told)
            self.assertRegex(told, rf"next: sightline bake {name} --entrance 2\n\Z")

    def open_corridor(self, name, far=()):
        """Writes a map of rooms along a corridor that is open at one end, and lines far from it."""
        walls = ["unit m", "walls 0 0 -2.4 0 -2.4 10 4.4 10 4.4 0 2 0"]
        for x, wall in ((0, -2.4), (2, 4.4)):
            for y in (0, 2.5, 5, 7.5):
                walls += [f"walls {x} {y} {x} {y + 0.5}", f"walls {x} {y + 1.5} {x} {y + 2.5}"]
                walls += [f"walls {x} {y} {wall} {y}"] if y else []
        walls += [f"wall {x} -40 {x} 60" for x in far]
        self.box.path(name).write_text("\n".join(["sightline 1", *walls, ""]), encoding="utf-8")

    def test_next_keeps_rooms(self):
        """An open corridor is as wide as its opening: as an entrance, it would open its rooms."""
        self.open_corridor("rooms.map")
        told = self.printed("check", "rooms.map")
        self.assertIn("an opening 2 m wide", told)
        self.assertIn("  with the entrance of the next command, 70.6 % of the area is inside\n", told)
        self.assertTrue(told.endswith("next: sightline check rooms.map --entrance 1.2\n"), told)
        told = self.printed("check", "rooms.map", "--entrance", "1.2", "--strict")
        self.assertNotIn("doubtful", told)
        told = self.run_well("bake", "rooms.map", "-o", "rooms.slv").stderr
        self.assertTrue(told.endswith("; if rooms behind narrower openings are what is inside, run: "
                                      "sightline check rooms.map --entrance 1.2\n"), told)

    def test_next_beside_walls(self):
        """Rooms that few of the walls belong to are no building: all commands name the opening."""
        self.open_corridor("far.map", (-30, -20, 20, 30))
        told = self.printed("check", "far.map")
        self.assertTrue(told.endswith("next: sightline check far.map --entrance 2\n"), told)
        told = self.run_well("bake", "far.map", "-o", "far.slv").stderr
        self.assertTrue(told.endswith("; if it is one, run: sightline check far.map --entrance 2\n"), told)
        told = self.box.run(["rooms", "far.map"]).stderr
        self.assertIn("; if the opening is an entrance, add --entrance 2; else", told)

    def test_next_of_usual(self):
        """No start is proposed that would leak through an entrance of the usual width."""
        self.write("a.map", 1, 17.3, ["unit m"])
        told = self.printed("check", "a.map", "--strict")
        self.assertNotIn("--start", told)
        self.assertTrue(told.endswith("next: sightline bake a.map\n"), told)

    def test_starts_go_before(self):
        """A start leaks through an entrance. Without it, inside ends there."""
        self.write("a.map", 2, 17.3, ["unit m"])
        x, y = turned(5, 2, 17.3)
        start = f"--start={x!r},{y!r}"
        told = self.printed("check", "a.map", "--entrance", "2.5", start)
        self.assertIn("  1 leak (", told)
        self.assertIn("  the leak is an entrance up to 2.5 wide, but starts go before entrances: "
                      "without a start, inside ends there\n", told)
        self.assertTrue(told.endswith("next: sightline bake a.map --entrance 2.5\n"), told)
        told = self.printed("check", "a.map", "--entrance", "1.5", start)
        self.assertNotIn("entrances", told)
        self.write("b.map", 2, 17.3, ["unit m", f"start {x!r} {y!r} 0"])
        told = self.printed("check", "b.map", "--entrance", "2.5")
        self.assertIn("the leak is an entrance up to 2.5 wide", told)
        self.assertTrue(told.endswith("next: sightline check b.map --entrance 2.5 -o b-check.png\n"),
                        told)


if __name__ == "__main__":
    sandbox.main()
