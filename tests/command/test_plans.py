"""Floor plans as they come out of CAD programs: what is said of them, and that no step goes wrong without a word.

test_plans.py PROGRAM
"""
import csv
import json
import math
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


class DoubtfulUnits(Plans):
    """The unit in a drawing's header is often that of the program, not that of the plan."""

    def told(self, text, *options):
        self.write("a.dxf", text)
        result = self.box.run(["convert", "a.dxf", *options, "-o", "a.map"])
        self.assertEqual(result.status, 0, result.text())
        return [line for line in result.stderr.splitlines() if "the drawing says" in line]

    @staticmethod
    def doors(unit, scale):
        """A plan of 12 m with two doors that are drawn open."""
        drawing = flat(unit, scale)
        for at in (2000, 7000):
            drawing.line("A-DOOR", *(value * scale for value in (at, 0, at, 900)))
            drawing.add("ARC", "A-DOOR", (10, at * scale), (20, 0), (40, 900 * scale), (50, 0), (51, 90))
        return drawing

    def test_by_its_doors(self):
        """In inches they are 23 m wide."""
        told = self.told(self.doors(1, 1))
        self.assertEqual(len(told), 1)
        self.assertIn("the drawing says inches, but its doors are 22.9 m wide then: in millimetres they are 0.9 m "
                      "wide, and the plan is 12 m long: --unit mm=m reads it so", told[0])
        self.assertEqual(self.told(self.doors(1, 1), "--unit", "mm=m"), [])
        self.assertEqual(self.told(self.doors(4, 1)), [])
        self.assertEqual(self.told(self.doors(0, 1)), [])
        # Plans are not drawn in yards.
        self.assertIn("in metres they are 0.9 m wide, and the plan is 12 m long: --unit m=m reads it so",
                      self.told(self.doors(1, 0.001))[0])

    def test_by_its_size(self):
        told = self.told(flat(4, 0.04))
        self.assertEqual(len(told), 1)
        self.assertIn("the drawing says millimetres, and is 0.48 m long then: if this is the plan of a building, "
                      "another unit is meant: in inches it is 12.2 m long (--unit in=m)", told[0])
        self.assertEqual(self.told(flat(4, 0.04), "--unit", "in=m"), [])
        self.assertEqual(self.told(flat(6, 0.001)), [])
        self.assertIn("in millimetres it is 50.4 m long (--unit mm=m)", self.told(flat(1, 4.2))[0])

    def test_where_no_unit_fits(self):
        told = self.told(flat(6, 0.00015))
        self.assertIn("is 1.8 m long then", told[0])
        self.assertIn("--entrance W says how wide its entrances are", told[0])

    def test_a_building_of_kilometres(self):
        """Towns are as large in metres, layers named as walls are those of a building."""
        self.assertIn("the drawing says metres, and is 1.2e+04 m long then", self.told(flat(6, 1))[0])
        self.assertIn("in millimetres it is 12 m long (--unit mm=m)", self.told(flat(6, 1))[0])
        self.assertEqual(self.told(str(flat(6, 0.5)).replace("A-WALL", "HOUSES")), [])


class Clips(Plans):
    def test_a_turned_plan_that_the_page_cuts(self):
        """Its walls leave the clip of the page side by side, as hatching leaves that of an area."""
        cos, sin = math.cos(math.radians(17.3)), math.sin(math.radians(17.3))
        ends = [((-700, y), (700, y)) for y in (-300, -290, 0, 300, 310)]
        ends += [((x, -500), (x, 500)) for x in (-400, -390, 0, 390, 400)]
        ends += [((x, -290), (x, -100)) for x in range(-300, 400, 100)]
        paths = "".join("<path d='M{} {}L{} {}'/>".format(
            *(round(v, 3) for x, y in pair for v in (500 + cos * x - sin * y, 400 + sin * x + cos * y)))
            for pair in ends)
        self.write("a.svg", "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 1000 800'>"
                   "<clipPath id='c'><path d='M0 0H1000V800H0Z'/></clipPath>"
                   f"<g clip-path='url(#c)' fill='none' stroke='black'>{paths}</g></svg>")
        result = self.run_well("convert", "a.svg", "-o", "a.map")
        self.assertIn(f"{len(ends)} shapes give {len(ends)} walls", result.stderr)
        self.assertNotIn("hatching", result.stderr)


class Entrances(Plans):
    def inside(self, width, *options):
        drawing = Drawing()
        for line in ((0, 0, 2000, 0), (2000 + width, 0, 12000, 0), (12000, 0, 12000, 8000),
                     (12000, 8000, 0, 8000), (0, 8000, 0, 0)):
            drawing.line("A-WALL", *line)
        drawing.line("A-WALL", -3000, 0, -3000, 100)
        self.write("a.dxf", drawing)
        result = self.run_well("bake", "a.dxf", "-o", "a.slv", "--json", *options)
        return result.stderr, json.loads(result.stdout)["inside_share"]

    def test_a_wide_entrance_of_a_drawing_counts(self):
        """A pair of doors, a garage: without it the street would count as inside, too."""
        told, share = self.inside(900)
        self.assertIn("(entrance 1200, as is usual)", told)
        for width in 2000, 2900:
            told, wide = self.inside(width)
            self.assertIn(f"inside ends at 1 opening up to {width} mm wide (entrance {width}, wider than "
                          "usual: without it, some rooms would be doubtful); for another width, add --entrance W", told)
            self.assertAlmostEqual(wide, share, delta=0.001)
            self.assertNotIn("doubtful: ", told)

    def test_an_open_side_is_none(self):
        told, _ = self.inside(6000)
        self.assertNotIn("wider than usual", told)


class Notes(Plans):
    def test_lists_end_behind_a_name(self):
        drawing = flat()
        for i in range(12):
            drawing.line(f"storage of things {i:02}", 100, 100 + i, 200, 100 + i)
        self.write("a.dxf", drawing)
        told = self.run_well("convert", "a.dxf", "-o", "a.map").stderr
        self.assertRegex(told, r"passed over: A-GRID \(grid\)(, storage of things \d\d)+, \.\.\. \(--layers A,B")

    def test_info_says_what_layers_are_taken_for(self):
        layers = json.loads(self.printed("info", "flat.dxf", "--json", "-q"))["layers"]
        self.assertEqual({layer["name"]: layer["taken"] for layer in layers}, {"A-WALL": "wall", "A-GRID": "ignore"})


class Furniture(Plans):
    @staticmethod
    def office(desks):
        """Two rows of three rooms by the faces of their walls, and desks with their chairs in them."""
        shapes = ["M100 100H720V520H100Z"]
        for i in range(6):
            x, y = 110 + 202 * (i % 3), 110 + 202 * (i // 3)
            shapes.append(f"M{x} {y}H{x + 192}V{y + 192}H{x}Z")
            for k in range(desks):
                shapes += [f"M{x + 8 + 46 * k} {y + 30}h36v18h-36z", f"M{x + 20 + 46 * k} {y + 48}l4 8h6l4 -8"]
        paths = "".join(f"<path d='{shape}'/>\n" for shape in shapes)
        return ("<svg xmlns='http://www.w3.org/2000/svg' width='820' height='620'>"
                f"<g fill='none' stroke='black' stroke-width='2'>{paths}</g>"
                "<path d='M0 20H820M0 40H820M0 600H820' stroke='#ddd'/></svg>")

    def test_much_furniture_is_left_out(self):
        """However many lines it has, beside walls that are drawn by their faces."""
        walls = []
        for desks in 0, 1:
            self.write("a.svg", self.office(desks))
            told = self.run_well("convert", "a.svg", "-o", "a.map").stderr
            self.assertEqual("42 lines that touch no wall" in told, desks > 0, told)
            walls.append(self.box.path("a.map").read_text(encoding="utf-8").count("\nwall"))
        self.assertEqual(*walls)


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
    def setUp(self):
        super().setUp()
        self.write("open.dxf", Drawing().line("A-WALL", 0, 0, 12000, 0).line("A-WALL", 12000, 0, 12000, 8000)
                   .line("A-WALL", 0, 8000, 0, 4).box("A-WALL", 5000, 0, 5120, 3000))

    def test_a_grid_of_wall_cores_is_refused(self):
        for command in (["vga", "--grid", "60"], ["isovist", "--grid", "60"], ["isovist", "--squares", "99"],
                        ["axial"]):
            told = self.refused(command[0], "open.dxf", *LAYERS, *command[1:])
            self.assertIn("walls enclose only 0.38 % of the area among them; say where a room is with --start X,Y",
                          told)
        self.run_well("vga", "open.dxf", *LAYERS, "--grid", "500", "--at", "1000,1000", "-o", "a.csv")
        self.run_well("isovist", "open.dxf", *LAYERS, "--at", "1000,1000", "-o", "a.csv")

    def test_a_start_is_proposed_in_the_room(self):
        """Not in the core of its wall."""
        report = self.printed("check", "open.dxf", *LAYERS).splitlines()[-1]
        x, y = map(float, re.search(r"--start (.*),(.*)$", report).groups())
        self.assertTrue(0 < x < 12000 and 0 < y < 8000 and not (4900 < x < 5220 and y < 3100), report)

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


class Drawings(Plans):
    LAYERS = (("A-WALL", 7), ("A-DIMS", -2), ("A-EMPTY", 3))

    def test_info_lists_layers_and_unit(self):
        self.write("a.dxf", flat(layers=self.LAYERS).line("A-DIMS", 0, -900, 9, -900))
        text = self.printed("info", "a.dxf")
        self.assertRegex(text, r"\n  unit      mm\n")
        self.assertRegex(text, r"\n +6  A-WALL\n +1  A-DIMS \(off: read only by --layers\)\n +1  A-GRID\n +1  empty layer \(--json lists all\)\n")
        report = json.loads(self.printed("info", "a.dxf", "--layers", "A-DIMS", "--json"))
        self.assertEqual(report["unit"], "mm")
        self.assertEqual([tuple(layer.values()) for layer in report["layers"]],
                         [("A-WALL", 6, True, "wall"), ("A-DIMS", 1, False, "ignore"), ("A-EMPTY", 0, True, "ignore"),
                          ("A-GRID", 1, True, "ignore")])

    def test_a_drawing_without_walls_is_listed(self):
        self.write("empty.svg", "<svg width='9' height='9'><text x='1' y='1'>A</text></svg>")
        self.assertRegex(self.printed("info", "empty.svg"), r"\n  walls     0, ")
        self.assertIn("the map has no walls", self.refused("check", "empty.svg"))

    def test_an_unknown_layer_names_all_and_an_empty_one_is_noted(self):
        self.write("a.dxf", flat(layers=self.LAYERS))
        self.assertIn("a.dxf: there is no layer 'WALLS' in the drawing; it has A-WALL, A-DIMS, A-EMPTY",
                      self.refused("info", "a.dxf", "--layers", "WALLS"))
        self.assertIn("a.dxf: nothing on the layers A-EMPTY is a wall; sightline info a.dxf lists all layers",
                      self.run_well("info", "a.dxf", "--layers", "A-EMPTY").stderr)

    def test_what_is_left_out_has_its_kind_and_layer(self):
        self.write("a.dxf", flat().add("HATCH", "A-WALL").add("HATCH", "A-WALL").add("TEXT", "A-TEXT"))
        self.assertIn("; left out: 2 HATCH on A-WALL, 1 TEXT on A-TEXT; unit: millimetres",
                      self.run_well("info", "a.dxf").stderr)

    def test_splines_become_chords(self):
        def spline(degree, points, *more):
            count = len(points)
            knots = [0] * degree + list(range(count - degree + 1)) + [count - degree] * degree
            return Drawing().box("W", -9, -9, 99, 99).add(
                "SPLINE", "W", (71, degree), *((40, knot) for knot in knots),
                *(pair for x, y in points for pair in ((10, x), (20, y))), *more)

        def chords():
            self.printed("convert", "a.dxf", "-o", "a.map", "--tolerance", "0.01")
            walls = [tuple(map(float, line.split()[1:])) for line in
                     self.box.path("a.map").read_text().splitlines() if line.startswith("wall ")]
            return walls[4:]
        # Of degree 2, with three points: (2 t, 2 t (1 - t)) by its points (0,0), (1,1), (2,0).
        self.write("a.dxf", spline(2, [(0, 0), (1, 1), (2, 0)]))
        self.assertGreater(len(chords()), 3)
        for x, y, _, _ in chords():
            self.assertAlmostEqual(y, x * (1 - x / 2), places=12)
        # Of degree 1: its points. Of degree 3 with inner knots: by de Boor's recursion.
        self.write("a.dxf", spline(1, [(0, 0), (3, 0), (3, 4)]))
        self.assertEqual(chords()[-1][2:], (3, 4))
        self.assertIn((3, 0), [wall[:2] for wall in chords()])
        # A knot too many at the beginning: the curve begins at the second point.
        self.write("a.dxf", str(spline(1, [(0, 0), (3, 0), (3, 4)])).replace("\n40\n1\n", "\n40\n0\n", 1))
        self.assertEqual((chords()[0][:2], chords()[-1][2:]), ((3, 0), (3, 4)))
        self.assertEqual({wall[0] for wall in chords()}, {3})
        points = [(0, 0), (1, 2), (3, 3), (5, 1), (6, 0), (8, 4)]
        self.write("a.dxf", spline(3, points))
        def at(t, i, degree):
            knots = [0, 0, 0, 0, 1, 2, 3, 3, 3, 3]
            if degree == 0:
                return knots[i] <= t < knots[i + 1] or (t == 3 and knots[i] < 3 == knots[i + 1])
            return sum(share * at(t, k, degree - 1) for k, share in (
                (i, (t - knots[i]) / ((knots[i + degree] - knots[i]) or 1)),
                (i + 1, (knots[i + degree + 1] - t) / ((knots[i + degree + 1] - knots[i + 1]) or 1))))
        ends = [wall[:2] for wall in chords()] + [chords()[-1][2:]]
        for t in (0, 1, 2, 3): # where pieces meet
            place = [sum(at(t, i, 3) * point[axis] for i, point in enumerate(points)) for axis in (0, 1)]
            self.assertTrue(any(max(abs(end[k] - place[k]) for k in (0, 1)) < 1e-12 for end in ends), (t, place))
        # With weights, or without knots, it is left out and said.
        self.write("a.dxf", spline(2, [(0, 0), (1, 1), (2, 0)], (41, 2)))
        self.assertIn("left out: 1 SPLINE on W", self.run_well("info", "a.dxf").stderr)

    def test_a_drawing_without_a_unit_is_read_in_the_one_that_is_said(self):
        self.write("a.dxf", flat(0))
        told = self.refused("info", "a.dxf", "--unit", "m")
        self.assertIn("own unit is unknown, so it cannot be turned into metres; if it is in mm, say --unit mm=m", told)
        self.assertRegex(self.printed("info", "a.dxf", "--unit", "mm=m", *LAYERS), r"bounds    0 0 to 12 8\n  unit      m\n")
        # What the drawing says itself does not count then.
        self.assertRegex(self.printed("info", "flat.dxf", "--unit", "cm=m", *LAYERS), "bounds    0 0 to 120 80\n")
        self.assertIn("there is no unit 'ell'", self.refused("info", "a.dxf", "--unit", "ell=m"))

    def test_drawings_and_ros_maps_are_known_by_their_bytes(self):
        text = "999\nmade by hand\n" + str(flat())
        for ends in (text, text.replace("\n", "\r")):
            self.write("drawing", ends)
            self.assertIn("drawing: 6 entities", self.run_well("info", "drawing", *LAYERS).stderr)
            with open(self.box.path("drawing"), encoding="utf-8") as stream:
                self.assertIn("-: 6 entities", self.run_well("info", "-", *LAYERS, stdin=stream).stderr)
        for name, text in (("plan.dwg", "AC1027"), ("plan", "AC1032....")):
            self.write(name, text)
            self.assertIn(f"{name}: a DWG drawing: save it as ASCII DXF in the program that it is from",
                          self.refused("bake", name, "-o", "a.slv"))
        self.write("map.pgm", "P2 3 1 255 0 205 254")
        for end in "\n\r":
            self.write("floor", f"image: map.pgm{end}resolution: 0.5{end}")
            self.assertIn("unit      m\n", self.printed("info", "floor"))

    def test_bounds_are_printed_without_noise(self):
        self.write("a.map", "sightline 1\nwall -2.8499999999999996 0 9 5\n")
        self.assertRegex(self.printed("info", "a.map"), "bounds    -2.85 0 to 9 5\n")


class Viewpoints(Plans):
    AT = ["isovist", "flat.dxf", *LAYERS, "--start", "1000,1000"]

    def picture(self, name, *arguments):
        result = self.box.run([*arguments, name])
        if "without pictures" in result.stderr:
            self.skipTest("a build without pictures")
        self.assertEqual(result.status, 0, result.text())
        return self.box.path(name).read_bytes()

    def test_a_table_names_its_columns(self):
        """Cameras: a name, and what the table has besides, may stand in any order."""
        self.write("cameras.csv", "name,fov,y,x,heading,price\nC1,90,1000,2000,45,5.5\nC2,,6000,3000,,\n")
        self.write("plain.csv", "2000,1000,45,90\n3000,6000\n")
        named, plain = (self.rows(*self.AT, "--points", name) for name in ("cameras.csv", "plain.csv"))
        self.assertEqual([(row["x"], row["y"], row["heading"], row["fov"]) for row in named],
                         [("2000", "1000", "45", "90"), ("3000", "6000", "0", "360")])
        self.assertEqual(named, plain)
        for text in ("x,y\n1\n", "x,y\n1,\n", "y,x\n1,b\n", "name,x,y\nC,1,2,\nC\n"):
            self.write("wrong.csv", text)
            self.assertRegex(self.refused(*self.AT, "--points", "wrong.csv"),
                             r"wrong\.csv:\d: (x and y are needed|[xy]: '.*' is no finite number)")

    def test_cameras_of_a_table_are_drawn_as_points_are(self):
        self.write("cameras.csv", "x,y,angle,fov\n2000,1000,45,90\n")
        drawn = self.picture("table.svg", *self.AT, "--points", "cameras.csv", "--picture")
        self.assertEqual(drawn, self.picture("point.svg", *self.AT, "--at", "2000,1000", "--look", "45", "--fov", "90",
                                             "--picture"))

    def test_a_picture_of_points_comes_with_their_measures(self):
        options = [*self.AT, "--at", "2000,1000"]
        self.picture("a.png", *options, "--picture")
        self.assertEqual(self.printed(*options, "--picture", "b.png"), self.printed(*options))
        self.assertEqual(self.printed(*options, "--picture", "c.png", "-o", "c.csv"), "")

    def test_pictures_say_the_unit(self):
        drawn = {"isovist": set(), "check": set()}
        for unit in (0, 4, 6):
            self.write("flat.dxf", flat(unit))
            drawn["isovist"].add(self.picture(f"i{unit}.png", *self.AT, "--at", "2000,1000", "--picture"))
            drawn["check"].add(self.picture(f"c{unit}.png", "check", "flat.dxf", *LAYERS, "-o"))
        self.assertEqual({command: len(pictures) for command, pictures in drawn.items()}, {"isovist": 3, "check": 3})


if __name__ == "__main__":
    sandbox.main()
