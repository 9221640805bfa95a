"""GeoJSON and CSV of `isovist`, `eye` and `viewcells`: valid, and the same as the tables and the JSON say.
Heat maps that say their unit. Exports cut off anywhere are refused with a line.

test_places.py PROGRAM
"""
import csv
import io
import json
import math
import pathlib
import re
import sys

import sandbox

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
import check_geojson  # noqa: E402

MAPS = ROOT / "maps"
OBLIQUE = ["gallery.map", "oblique/rotunda.map"]
DXF = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + "".join(
    f"0\nLINE\n10\n{x}\n20\n{y}\n11\n{p}\n21\n{q}\n" for x, y, p, q in
    [(0, 0, 9, 0), (9, 0, 9, 7), (9, 7, 0, 7), (0, 7, 0, 0), (4, 2, 5, 6)]) + "0\nENDSEC\n0\nEOF\n"


def area(geometry):
    """Of a polygon or of several, holes taken off."""
    if geometry is None:
        return 0
    polygons = geometry["coordinates"]
    if geometry["type"] == "Polygon":
        polygons = [polygons]
    return math.fsum(check_geojson.area(ring) / 2 for rings in polygons for ring in rings)


def holds(geometry, point):
    polygons = geometry["coordinates"]
    if geometry["type"] == "Polygon":
        polygons = [polygons]
    return any(check_geojson.inside(rings[0], point) >= 0 and
               all(check_geojson.inside(hole, point) <= 0 for hole in rings[1:])
               for rings in polygons)


class Places(sandbox.ProgramTest):
    def features(self, name, *arguments):
        """By kind: (geometry, properties) of each feature."""
        self.printed(*arguments, "-o", name, "-q")
        collection = json.loads(self.box.path(name).read_text(encoding="utf-8"),
                                parse_constant=check_geojson.refuse)
        self.assertEqual(check_geojson.faults(collection), [])
        kinds = {}
        for feature in collection["features"]:
            properties = feature["properties"]
            kinds.setdefault(properties.pop("kind"), []).append((feature["geometry"], properties))
        return kinds

    def same_rows(self, table, places):
        """The table's columns are properties of the features, in the same order."""
        rows = list(csv.DictReader(io.StringIO(table)))
        self.assertEqual(len(rows), len(places))
        for row, (_, properties) in zip(rows, places):
            properties = {key: value for key, value in properties.items() if key != "members"}
            self.assertEqual(list(row), list(properties))
            self.assertEqual([float(value) for value in row.values()],
                             list(map(float, properties.values())))

    def test_isovists(self):
        for name in ["office.map", *OBLIQUE, "effects/mirrors.map", "effects/range.map"]:
            for options in [], ["--range", "7", "--look", "30", "--fov", "100"]:
                with self.subTest(map=name, options=options):
                    what = ["isovist", MAPS / name, "--squares", "9", *options]
                    kinds = self.features("a.geojson", *what)
                    self.same_rows(self.printed(*what, "-q"), kinds["isovist"])
                    self.assertEqual(set(kinds) - {"mirrored"}, {"isovist"})
                    for geometry, properties in kinds["isovist"]:
                        exact = properties["area"]
                        # Arcs are chords: a little area is lost.
                        if options or "range" in name:
                            self.assertTrue(0.98 * exact - 0.01 <= area(geometry) <= exact + 1e-9)
                        else:
                            self.assertAlmostEqual(area(geometry), exact, delta=1e-9 * exact)
                        if not options and geometry:
                            self.assertTrue(holds(geometry, (properties["x"], properties["y"])))
                    for geometry, properties in kinds.get("mirrored", []):
                        self.assertEqual(list(properties), ["x", "y", "mirror", "reflections", "area"])
        self.assertTrue(self.features("m.geojson", "isovist", MAPS / "effects/mirrors.map", "--squares",
                                      "9")["mirrored"])

    def test_what_viewpoints_see_together(self):
        """Each place counts as often as regions hold it, so all areas add up to those of regions."""
        for name in ["office.map", *OBLIQUE]:
            with self.subTest(map=name):
                cone = ["--look", "30", "--fov", "200"]
                table = self.printed("isovist", MAPS / name, "--squares", "9", *cone, "-q")
                self.box.path("eyes.csv").write_text(table, encoding="utf-8")
                what = ["isovist", MAPS / name, "--points", "eyes.csv"]
                regions = self.features("a.geojson", *what)["isovist"]
                rows = list(csv.DictReader(io.StringIO(self.printed(*what, "--union", "-q"))))
                every = math.fsum(properties["area"] for _, properties in regions)
                self.assertAlmostEqual(math.fsum(float(row["area"]) for row in rows[1:]), every,
                                       delta=1e-9 * every)
                self.assertEqual([row["viewpoints"] for row in rows],
                                 [str(k) for k in range(len(rows))])
                pieces = self.features("b.geojson", *what, "--union")["seen"]
                self.assertAlmostEqual(math.fsum(p["area"] for _, p in pieces),
                                       float(rows[1]["area"]), delta=1e-9 * every)
                tried = [piece for piece in pieces if piece[1]["area"] > 1e-3][::7]
                self.assertGreater(len(tried), 20)
                for geometry, properties in tried:
                    corners = geometry["coordinates"][0][1:]
                    middle = [math.fsum(c[k] for c in corners) / len(corners) for k in range(2)]
                    self.assertEqual(sum(holds(region, middle) for region, _ in regions),
                                     properties["viewpoints"])

    def test_slits_and_needles(self):
        """A corner in line with the eye that hides nothing beside itself; a cone of no width."""
        self.box.path("m.map").write_text("sightline 1\nwalls 0 0 9 0 9 7 0 7 0 0\n"
                                          "walls 4 0 4 3 5 3 5 7\nwall 7 1 8 0\n", encoding="utf-8")
        for at in "5,3", "4,3", "1,0", "1,3", "4.5,3", "2,1.5", "0,0":
            self.features("a.geojson", "isovist", "m.map", "--at", at)
        kinds = self.features("b.geojson", "isovist", "m.map", "--at", "1,1", "--fov", "0")
        self.assertIsNone(kinds["isovist"][0][0])

    def test_eye(self):
        for name, at in (("office.map", "53,20"), ("gallery.map", "5,5"),
                         ("effects/mirrors.map", "2,2"), ("effects/doors.map", "5,5")):
            with self.subTest(map=name):
                self.printed("bake", MAPS / name, "-o", "m.slv", "-q")
                what = ["eye", "m.slv", "--at", at, "--look", "10", "--fov", "200", "--object",
                        "8,2,9,6,block"]
                kinds = self.features("a.geojson", *what)
                told = json.loads(self.printed(*what, "--json", "-q"))
                self.printed(*what, "-o", "a.csv", "-q")
                table = list(csv.DictReader(io.StringIO(self.box.path("a.csv").read_text())))
                self.assertEqual([(p["cell"], p["heading"], p["fov"]) for _, p in kinds["eye"]],
                                 [(told["cell"], 10, 200)])
                ((geometry, region),) = kinds["region"]
                self.assertEqual(region["area"], told["region"]["area"])
                self.assertAlmostEqual(area(geometry), region["area"], delta=1e-6)
                self.assertEqual(kinds["region_past_objects"][0][1]["area"],
                                 told["past_objects"]["region"]["area"])
                ((box, thing),) = kinds["object"]
                self.assertEqual((area(box), thing["blocks"], thing["name"]),
                                 (4, True, "8,2,9,6,block"))
                self.assertEqual(thing["seen"], told["objects_seen"]["8,2,9,6,block"])
                wanted = dict(told["methods"], past_objects=told["past_objects"]["cells"])
                for key, cells in told.get("mirrored", {}).items():
                    wanted["mirrored_" + key] = cells
                if "mirrored" in told:
                    wanted["mirrored_past_objects"] = told["past_objects"]["mirrored_cells"]
                for key, cells in wanted.items():
                    self.assertEqual([p["id"] for _, p in kinds["cell"] if p[key]], cells)
                    self.assertEqual([int(row["cell"]) for row in table if row[key] == "1"], cells)
                self.assertEqual({len(p) for _, p in kinds["cell"]}, {len(wanted) + 2})
                self.assertEqual(len(table), len(kinds["cell"]))

    def test_view_cells(self):
        for name in ["office.map", *OBLIQUE]:
            for method in "av-m", "bsp", "hybrid", "kd-casm":
                with self.subTest(map=name, method=method):
                    what = ["viewcells", MAPS / name, "--cells", "9", "--elementary", "60",
                            "--samples", "3000", "--evaluate", "0", "--method", method]
                    places = self.features("a.geojson", *what)["view_cell"]
                    self.same_rows(self.printed(*what, "-o", "-", "-q"), places)
                    members = [number for _, p in places for number in p["members"]]
                    self.assertEqual(sorted(members), list(range(len(members))))
                    for geometry, properties in places:
                        self.assertEqual(len(properties["members"]), properties["elementary_cells"])
                        self.assertTrue(holds(geometry, (properties["x"], properties["y"])))
                        others = [g for g, p in places if p is not properties and
                                  holds(g, (properties["x"], properties["y"]))]
                        self.assertEqual(others, [])

    def test_units(self):
        """The legend of a heat map says the unit, where the file does and the measure has one."""
        def heat(unit, measure):
            self.box.path("m.dxf").write_text(DXF.format(unit), encoding="utf-8")
            self.printed("isovist", "m.dxf", "--at", "1,1", "-q")
            result = self.box.run(["isovist", "m.dxf", "--squares", "9", "--measure", measure,
                                   "--picture", f"{measure}{unit}.png", "-q"])
            if "without pictures" in result.stderr:
                self.skipTest("a build without pictures")
            self.assertEqual(result.status, 0, result.stderr)
            return self.box.path(f"{measure}{unit}.png").read_bytes()
        for measure, tells in ("area", 3), ("perimeter", 3), ("compactness", 1), ("drift_angle", 1):
            self.assertEqual(len({heat(unit, measure) for unit in (0, 4, 6)}), tells, measure)

    def test_cut_exports(self):
        """An export that ends too soon is refused, with its line, and leaves no file."""
        self.printed("bake", MAPS / "effects/doors.map", "-o", "m.slv", "-q")
        text = self.printed("export", "m.slv", "-q").rstrip("\n")
        for length in {len(text) * i // 23 for i in range(23)} | {len(text) - 1}:
            self.box.path("cut.json").write_text(text[:length], encoding="utf-8")
            result = self.box.run(["bake", "cut.json", "-o", "cut.slv"])
            self.assertEqual(result.status, 2, length)
            self.assertTrue(re.match(r"sightline: cut\.json:\d+: ", result.stderr), result.stderr)
            self.assertFalse(self.box.path("cut.slv").exists())


if __name__ == "__main__":
    sandbox.main()
