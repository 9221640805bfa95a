"""The plugin for QGIS, in QGIS: test_qgis.py PROGRAM SOURCE PACKAGE

Each algorithm is run by qgis_process on a layer of walls, and its fields and shapes are what the command says of the same
walls. Skipped (77) where QGIS or numpy is not here. With the variable SIGHTLINE_PICTURE a map of the results is drawn to that file.
"""
import csv
import io
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

# Metres of UTM zone 33: far from 0, as layers are.
AT = 412000, 5652000
ROOMS = [(0, 0, 12, 0), (12, 0, 12, 8), (12, 8, 0, 8), (0, 8, 0, 0), (5, 0, 5, 3), (5, 4, 5, 8), (8, 2, 10, 3)]
POINTS = [(2, 2, "a", 0, 360), (9, 6, "b", 180, 90)]
UTM = "EPSG:32633"
# Debian's qgis_process hands a word to the program that it does not know.
QGIS_PROCESS = shutil.which("qgis_process.bin") or shutil.which("qgis_process")


def geojson(path, rows, crs=UTM):
    """A layer of (geometry type, coordinates, properties)."""
    path.write_text(json.dumps({
        "type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": f"urn:ogc:def:crs:{crs.replace(':', '::')}"}},
        "features": [{"type": "Feature", "properties": more, "geometry": {"type": kind, "coordinates": at}}
                     for kind, at, more in rows]}), encoding="utf-8")


def moved(x, y):
    return [x + AT[0], y + AT[1]]


def table(text):
    return [{name: float(value) if value else None for name, value in row.items()}
            for row in csv.DictReader(io.StringIO(text))]


class Qgis(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.at = at = pathlib.Path(cls.folder.name)
        os.chmod(at, 0o700)
        plugins = at / "plugins"
        shutil.copytree(SOURCE / "lib/bindings/qgis", plugins / "sightline_qgis")
        cls.environment = {**os.environ, "HOME": str(at), "XDG_RUNTIME_DIR": str(at), "QT_QPA_PLATFORM": "offscreen",
                           "QGIS_PLUGINPATH": str(plugins), "PYTHONPATH": str(PACKAGE), "PYTHONDONTWRITEBYTECODE": "1"}
        subprocess.run([QGIS_PROCESS, "plugins", "enable", "sightline_qgis"], env=cls.environment, check=True,
                       capture_output=True)
        lines = [("LineString", [moved(a, b), moved(c, d)], {"what": None}) for a, b, c, d in ROOMS]
        geojson(at / "walls.geojson", lines)
        geojson(at / "points.geojson", [("Point", moved(x, y), {"label": label, "heading": heading, "fov": fov})
                                        for x, y, label, heading, fov in POINTS])
        text = "".join("wall {} {} {} {}\n".format(*moved(a, b), *moved(c, d)) for a, b, c, d in ROOMS)
        (at / "plan.map").write_text("sightline 1\n" + text, encoding="utf-8")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def said(self, *words):
        return subprocess.run([PROGRAM, *map(str, words), "-q"], check=True, capture_output=True, text=True, cwd=self.at).stdout

    def process(self, name, output="out.geojson", **parameters):
        """What qgis_process prints; it fails where the algorithm fails."""
        words = [f"--{key}={value}" for key, value in parameters.items()]
        return subprocess.run([QGIS_PROCESS, "run", f"sightline:{name}", *words, f"--OUTPUT={self.at / output}"],
                              env=self.environment, capture_output=True, text=True, cwd=self.at)

    def run_it(self, name, output="out.geojson", **parameters):
        done = self.process(name, output, **parameters)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        layer = json.loads((self.at / output).read_text(encoding="utf-8"))
        self.assertIn("32633", json.dumps(layer["crs"]))
        return layer["features"], done.stdout + done.stderr

    def same(self, got, wanted, names=None):
        """Properties of features are the values of a table; a table has up to 9 digits."""
        self.assertEqual(len(got), len(wanted))
        self.assertTrue(wanted)
        for feature, row in zip(got, wanted):
            for name in names or row:
                value = feature["properties"][name]
                if row[name] is None:
                    self.assertIsNone(value, name)
                else:
                    self.assertTrue(math.isclose(value, row[name], rel_tol=1e-6, abs_tol=1e-9), (name, value, row[name]))

    def test_isovists(self):
        got, _ = self.run_it("isovists", WALLS="walls.geojson", POINTS="points.geojson", HEADING="heading", FOV="fov")
        for feature, (x, y, label, heading, fov) in zip(got, POINTS):
            x, y = moved(x, y)
            self.said("isovist", "plan.map", "--at", f"{x},{y}", *(["--look", heading, "--fov", fov] if fov < 360 else []),
                      "-o", "seen.geojson")
            wanted, = json.loads((self.at / "seen.geojson").read_text(encoding="utf-8"))["features"]
            self.same([feature], [wanted["properties"]], ["x", "y", "area", "perimeter", "corners"])
            self.assertEqual(feature["properties"]["label"], label)
            ring, = feature["geometry"]["coordinates"]
            self.assertEqual(len(ring), len(wanted["geometry"]["coordinates"][0]))

    def test_visibility_graph(self):
        got, _ = self.run_it("visibilitygraph", WALLS="walls.geojson", GRID=1, MEASURES="0,1")
        wanted = table(self.said("vga", "plan.map", "--grid", 1, "--measures", "visual,through"))
        self.same(got, wanted)
        ring, = got[0]["geometry"]["coordinates"]
        self.assertEqual(sorted({x for x, _ in ring}), [wanted[0]["x"] - 0.5, wanted[0]["x"] + 0.5])

    def test_ways(self):
        start = moved(1, 7)
        got, _ = self.run_it("ways", WALLS="walls.geojson", ENDS="points.geojson", RADIUS=0.25,
                             START=f"{start[0]},{start[1]} [{UTM}]")
        for feature, (x, y, label, *_) in zip(got, POINTS):
            wanted = json.loads(self.said("path", "plan.map", "--from", "{},{}".format(*start), "--to",
                                          "{},{}".format(*moved(x, y)), "--radius", 0.25, "--json"))
            self.assertTrue(math.isclose(feature["properties"]["length"], wanted["length"], rel_tol=1e-9))
            self.assertEqual(feature["properties"]["label"], label)
            self.assertEqual(len(feature["geometry"]["coordinates"]), len(wanted["points"]))


if __name__ == "__main__":
    if not QGIS_PROCESS:
        print("QGIS is not here")
        sys.exit(77)
    PROGRAM, SOURCE, PACKAGE = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
