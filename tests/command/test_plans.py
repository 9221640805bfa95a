"""Floor plans as they come out of CAD programs: what is said of them, and that no step goes wrong without a word.

test_plans.py PROGRAM
"""
import csv
import json
import re

import sandbox


class Drawing:
    """A small DXF drawing."""

    def __init__(self, unit=4, layers=()):
        """`unit` is $INSUNITS; a layer is its name and its colour, which is negative where it is off."""
        self.text = f"0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n"
        if layers:
            self.text += "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n9\n"
            for name, colour in layers:
                self.text += f"0\nLAYER\n2\n{name}\n70\n0\n62\n{colour}\n"
            self.text += "0\nENDTAB\n0\nENDSEC\n"
        self.text += "0\nSECTION\n2\nENTITIES\n"

    def add(self, kind, layer, *pairs):
        self.text += f"0\n{kind}\n8\n{layer}\n" + "".join(f"{code}\n{value}\n" for code, value in pairs)
        return self

    def line(self, layer, a, b, c, d):
        return self.add("LINE", layer, (10, a), (20, b), (11, c), (21, d))

    def box(self, layer, a, b, c, d):
        """A closed polyline."""
        return self.add("LWPOLYLINE", layer, (90, 4), (70, 1), (10, a), (20, b), (10, c), (20, b),
                        (10, c), (20, d), (10, a), (20, d))

    def __str__(self):
        return self.text + "0\nENDSEC\n0\nEOF\n"


def flat(unit=4, scale=1, layers=()):
    """A flat of 12 m by 8 m with an open entrance, in mm: its outer wall ends 4 mm beside a corner."""
    drawing = Drawing(unit, layers)
    for line in ((0, 0, 2000, 0), (2900, 0, 12000, 0), (12000, 0, 12000, 8000), (12000, 8000, 0, 8000),
                 (0, 8000, 0, 4)):
        drawing.line("A-WALL", *(value * scale for value in line))
    drawing.box("A-WALL", *(value * scale for value in (5000, 0, 5120, 3000)))
    return drawing.line("A-GRID", -500 * scale, 2222 * scale, 12500 * scale, 2222 * scale)


LAYERS = ["--layers", "A-WALL"]


class Plans(sandbox.ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("flat.dxf", flat())

    def write(self, name, text):
        self.box.path(name).write_text(str(text), encoding="utf-8")

    def refused(self, *arguments):
        result = self.box.run(list(arguments), timeout=60)
        self.assertEqual(result.status, 2, result.text())
        return result.stderr.splitlines()[-1]

    def rows(self, *arguments):
        return list(csv.DictReader(self.printed(*arguments).splitlines()))


class Units(Plans):
    def test_a_step_in_another_unit_is_refused_from_a_point_too(self):
        for place in ("--at", "--start"):
            told = self.refused("vga", "flat.dxf", *LAYERS, "--grid", "0.05", place, "1000,1000")
            self.assertRegex(told, "too many|choose a larger step")
            self.assertTrue(told.endswith("lengths are in mm: --unit m reads the drawing in metres"), told)

    def test_plans_in_two_units_are_not_compared(self):
        self.write("metres.dxf", flat(6, 0.001))
        told = self.refused("vga", "flat.dxf", *LAYERS, "--grid", "500", "--at", "1000,1000",
                            "--compare", "metres.dxf")
        self.assertIn("--compare metres.dxf: its lengths are in m, those of the first plan in mm", told)
        self.run_well("vga", "flat.dxf", *LAYERS, "--grid", "0.5", "--at", "1,1", "--unit", "m",
                      "--compare", "metres.dxf", "-o", "change.csv")

    def test_a_start_outside_names_the_unit_and_repeats_options(self):
        told = self.refused("axial", "flat.dxf", *LAYERS, "--unit", "m", "--start", "1000,1000")
        self.assertIn("outside the map, whose lengths are in m; to see its bounds, run: "
                      "sightline info flat.dxf --layers A-WALL --unit m", told)


class Closed(Plans):
    def test_what_is_closed_by_digits_stays_closed_in_map_text(self):
        def leaks(name, *options):
            report = json.loads(self.printed("check", name, *options, "--start", "1000,1000", "--json"))
            return report["counts"]["leak"]
        self.printed("convert", "flat.dxf", *LAYERS, "-o", "flat.map")
        self.assertIn("\nprecision 5\n", self.box.path("flat.map").read_text())
        self.assertEqual(leaks("flat.dxf", *LAYERS), 1)
        self.assertEqual(leaks("flat.map"), 1)
        self.assertEqual(leaks("flat.map", "--weld", "0"), 2)
        self.printed("convert", "flat.map", "-o", "again.map")
        self.assertEqual(self.box.path("again.map").read_text(), self.box.path("flat.map").read_text())

    def test_a_precision_is_over_0_and_given_once(self):
        for lines in ("precision 0", "precision -1", "precision 1\nprecision 1"):
            self.write("a.map", f"sightline 1\n{lines}\nwall 0 0 9 0\n")
            self.assertIn("precision", self.refused("info", "a.map"))


class Inside(Plans):
    def test_a_grid_of_wall_cores_is_refused(self):
        for command in (["vga", "--grid", "60"], ["isovist", "--grid", "60"], ["isovist", "--cells", "99"],
                        ["axial"]):
            told = self.refused(command[0], "flat.dxf", *LAYERS, *command[1:])
            self.assertIn("walls enclose only 0.38 % of the area; say where a room is with --start X,Y", told)
        self.run_well("vga", "flat.dxf", *LAYERS, "--grid", "500", "--at", "1000,1000", "-o", "a.csv")
        self.run_well("isovist", "flat.dxf", *LAYERS, "--at", "1000,1000", "-o", "a.csv")

    def test_notes_repeat_the_options_that_count(self):
        self.write("my flat.dxf", flat())
        result = self.run_well("vga", "my flat.dxf", *LAYERS, "--unit", "m", "--grid", "0.5", "--start", "1,1",
                               "-o", "a.csv")
        self.assertIn("run: sightline check 'my flat.dxf' --layers A-WALL --unit m --start 1,1\n", result.stderr)

    def test_isovists_within_outlines(self):
        self.write("zones.dxf", flat().box("ZONE", 500, 500, 3000, 3000))
        options = ["isovist", "zones.dxf", *LAYERS, "--start", "1000,1000", "--grid", "500"]
        every, part = self.rows(*options), self.rows(*options, "--within", "zones.dxf",
                                                           "--within-layers", "ZONE")
        self.assertEqual(part, [row for row in every if 500 < float(row["x"]) < 3000 and
                                500 < float(row["y"]) < 3000])
        self.assertEqual(len(part), 25)
        self.assertIn("--within is for a grid", self.refused("isovist", "flat.dxf", "--at", "1,1",
                                                             "--within", "zones.dxf"))


if __name__ == "__main__":
    sandbox.main()
