"""The plugin for QGIS, in QGIS: test_qgis.py PROGRAM SOURCE PACKAGE

Each algorithm is run by qgis_process on a layer of walls, and its fields and shapes are what the command says of the same
walls. Skipped (77) where QGIS is not installed. With the variable SIGHTLINE_PICTURE a map of the results is drawn to that file.
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
ENDS = "x1", "y1", "x2", "y2"
# Debian's qgis_process hands a word to the program that it does not know.
QGIS_PROCESS = shutil.which("qgis_process.bin") or shutil.which("qgis_process")


# Draws layers with the plugin's styles, as a map, and says how many colours the picture has.
DRAWER = """
import os, sys
from qgis.core import *
from qgis.PyQt.QtCore import QSize
from qgis.PyQt.QtGui import QColor
application = QgsApplication([], False)
application.initQgis()
picture, layers = sys.argv[1], []
for word in sys.argv[2:]:
    path, style = word.split("=")
    layer = QgsVectorLayer(path, "layer", "ogr")
    assert layer.isValid(), path
    if style:
        message, done = layer.loadNamedStyle(style)
        assert done, message
    else:
        layer.renderer().symbol().setColor(QColor("black"))
    layers.append(layer)
settings = QgsMapSettings()
settings.setLayers(layers)
settings.setDestinationCrs(layers[0].crs())
settings.setOutputSize(QSize(900, 600))
box = layers[0].extent()
box.scale(1.1)
settings.setExtent(box)
settings.setFlag(QgsMapSettings.Antialiasing, False)
job = QgsMapRendererParallelJob(settings)
job.start()
job.waitForFinished()
image = job.renderedImage()
assert not job.errors() and image.save(picture), picture
print(len({image.pixel(x, y) for x in range(0, 900, 3) for y in range(0, 600, 3)}))
sys.stdout.flush()
os._exit(0) # objects that outlive QGIS end it with a fault
"""

# Runs the visibility graph in PyQGIS: the distance of its points, and after how long another thread cancels it. Says how its
# layer is coloured.
RUNNER = """
import os, sys, threading, time
from qgis.core import *
application = QgsApplication([], False)
application.initQgis()
sys.path.insert(0, os.environ["QGIS_PLUGINPATH"])
import sightline_qgis
plugin = sightline_qgis.classFactory(None)
plugin.initProcessing()
algorithm = QgsApplication.processingRegistry().algorithmById("sightline:visibilitygraph")
context, feedback = QgsProcessingContext(), QgsProcessingFeedback()
begun = time.monotonic()
if float(sys.argv[2]):
    threading.Timer(float(sys.argv[2]), feedback.cancel).start()
values = {"WALLS": "walls.geojson", "GRID": float(sys.argv[1]), "MEASURES": [0, 2, 3], "OUTPUT": "memory:"}
found, done = algorithm.run(values, context, feedback)
if done:
    layer = context.takeResultLayer(found["OUTPUT"])
    print(layer.renderer().symbol().symbolLayer(0).dataDefinedProperties().property(3).expressionString())
print(done, feedback.isCanceled(), time.monotonic() - begun < 20)
sys.stdout.flush()
os._exit(0)
"""


def geojson(path, rows, crs=UTM):
    """A layer of (geometry type, coordinates, properties)."""
    path.write_text(json.dumps({
        "type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": f"urn:ogc:def:crs:{crs.replace(':', '::')}"}},
        "features": [{"type": "Feature", "properties": more, "geometry": {"type": kind, "coordinates": at}}
                     for kind, at, more in rows]}), encoding="utf-8")


def moved(x, y):
    return [x + AT[0], y + AT[1]]


def size(ring):
    # About its first corner: far from 0, products of coordinates lose digits.
    near = [(x - ring[0][0], y - ring[0][1]) for x, y in ring]
    return abs(sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(near, near[1:]))) / 2


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
        estimated, _ = self.run_it("visibilitygraph", WALLS="walls.geojson", GRID=1, ESTIMATE=5)
        self.same(estimated, table(self.said("vga", "plan.map", "--grid", 1, "--estimate", 5)))
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

    def test_lines(self):
        for name in "fewest", "all":
            got, _ = self.run_it("axiallines", WALLS="walls.geojson", LINES=["fewest", "subsets", "all"].index(name))
            wanted = table(self.said("axial", "plan.map", "--lines", name))
            self.same(got, [{k: v for k, v in row.items() if k not in ENDS} for row in wanted])
            ends = [[row[k] for k in ENDS] for row in wanted]
            self.assertEqual([sum(feature["geometry"]["coordinates"], []) for feature in got], ends)

    def test_segments(self):
        streets = ([(0, 0), (9, 0)], 5), ([(3, -3), (3, 4)], 2.5), ([(9, 0), (9, 4), (3, 4)], 7)
        geojson(self.at / "streets.geojson", [("LineString", [moved(*at) for at in line], {"trips": weight})
                                              for line, weight in streets])
        (self.at / "streets.csv").write_text("x1,y1,x2,y2,trips\n" + "".join(
            ",".join(map(str, [*moved(*a), *moved(*b), weight * math.dist(a, b) / sum(map(math.dist, line, line[1:]))])) + "\n"
            for line, weight in streets for a, b in zip(line, line[1:])), encoding="utf-8")
        got, _ = self.run_it("segments", WALLS="streets.geojson", METRIC_RADIUS=8)
        wanted = table(self.said("segments", "streets.csv", "--metric-radius", 8))
        self.same(got, [{k.replace("_r8_metric", ""): v for k, v in row.items() if k not in ENDS} for row in wanted],)
        got, _ = self.run_it("segments", WALLS="streets.geojson", WEIGHT="trips")
        wanted = table(self.said("segments", "streets.csv", "--weight", "trips"))
        ending = "_weighted"
        self.same(got, [{k.replace(ending, ""): v for k, v in row.items() if k + ending not in row and k not in ENDS}
                        for row in wanted])

    def test_cover(self):
        geojson(self.at / "cameras.geojson", [("Point", moved(1, 4), {"heading": 0, "fov": 90, "range": 9}),
                                              ("Point", moved(11, 7), {"heading": 225, "fov": 120, "range": None})])
        (self.at / "cameras.csv").write_text("x,y,heading,fov,range\n{},{},0,90,9\n{},{},225,120,\n".format(
            *moved(1, 4), *moved(11, 7)), encoding="utf-8")
        got, log = self.run_it("cover", WALLS="walls.geojson", POINTS="cameras.geojson")
        wanted = json.loads(self.said("cover", "plan.map", "cameras.csv", "--json"))
        for number, key in enumerate(("0", "1", "2", "3+")):
            area = sum(size(feature["geometry"]["coordinates"][0]) for feature in got
                       if min(feature["properties"]["count"], 3) == number)
            self.assertAlmostEqual(area, wanted["areas"][key], places=5)
        self.assertIn("Blind spot of area", log)

    def test_place(self):
        got, log = self.run_it("place", WALLS="walls.geojson")
        wanted = json.loads(self.said("place", "plan.map", "--json"))
        self.assertEqual(len(got), wanted["upper"])
        self.assertIn(f"{wanted['upper']} viewpoints see everything.", log)
        self.assertIn("No fewer", log)

    def test_kinds(self):
        """A shut door stops ways and sight; solid ground has a hole; what a field says falsely is refused by its feature."""
        lines = [("LineString", [moved(a, b), moved(c, d)], {"what": "wall"}) for a, b, c, d in ROOMS]
        door = ("LineString", [moved(5, 3), moved(5, 4)], {"what": "door", "name": "way", "open": False})
        geojson(self.at / "kinds.geojson", [*lines, door])
        got, log = self.run_it("ways", WALLS="kinds.geojson", KIND="what", ENDS="points.geojson",
                               START="{},{} [{}]".format(*moved(1, 7), UTM))
        self.assertEqual([(feature["geometry"] or {}).get("coordinates", []) == [] for feature in got], [False, True])
        self.assertIsNone(got[1]["properties"]["length"])
        self.assertIn("There is no way to point 1", log)
        geojson(self.at / "kinds.geojson", [*lines, (door[0], door[1], {"what": "gate"})])
        done = self.process("ways", WALLS="kinds.geojson", KIND="what", ENDS="points.geojson", START="1,1")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("Feature 7 of the walls: field 'what' says 'gate'", done.stdout + done.stderr)

        geojson(self.at / "kinds.geojson", [*lines, (door[0], door[1], {"what": "door", "open": "no"})])
        done = self.process("ways", WALLS="kinds.geojson", KIND="what", ENDS="points.geojson", START="1,1")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("Feature 7 of the walls: field 'open' must hold true or false, not 'no'", done.stdout + done.stderr)

        def square(a, b):
            return [moved(a, a), moved(b, a), moved(b, b), moved(a, b), moved(a, a)]
        geojson(self.at / "kinds.geojson", [("Polygon", [square(0, 10), square(2, 8)], {"what": None})])
        geojson(self.at / "inside.geojson", [("Point", moved(5, 5), {}), ("Point", moved(1, 1), {}), ("Point", moved(99, 1), {})])
        got, log = self.run_it("isovists", WALLS="kinds.geojson", KIND="what", POINTS="inside.geojson")
        self.assertEqual([feature["properties"]["area"] for feature in got], [36, 0, 0])
        for number in 1, 2:
            self.assertIn(f"Point {number} at", log)
        self.assertNotIn("Point 0 at", log)

    def test_inside(self):
        """A house with a gap: a warning says what to do. Of two houses, a start takes one."""
        def house(*sides):
            geojson(self.at / "house.geojson", [("LineString", [moved(a, b), moved(c, d)], {}) for a, b, c, d in sides])

        house((5, 0, 10, 0), (10, 0, 10, 8), (10, 8, 0, 8), (0, 8, 0, 0), (0, 0, 3, 0), (12, 0, 12, 8))
        _, log = self.run_it("visibilitygraph", WALLS="house.geojson", GRID=1)
        self.assertIn("(STARTS)", log)
        house(*((a + x, b, c + x, d) for x in (0, 10) for a, b, c, d in ((0, 0, 4, 0), (4, 0, 4, 4), (4, 4, 0, 4), (0, 4, 0, 0))))
        geojson(self.at / "start.geojson", [("Point", moved(1, 1), {})])
        counts = [len(self.run_it("visibilitygraph", WALLS="house.geojson", GRID=1, **more)[0])
                  for more in ({}, {"STARTS": "start.geojson"})]
        self.assertEqual(counts, [18, 9])

    def test_coordinate_systems(self):
        """Walls in degrees are refused; points in degrees are transformed."""
        geojson(self.at / "degrees.geojson", [("Point", [13.7, 51.0], {})], "EPSG:4326")
        geojson(self.at / "globe.geojson", [("LineString", [[13, 51], [14, 52]], {})], "EPSG:4326")
        done = self.process("isovists", output="none.geojson", WALLS="globe.geojson", POINTS="points.geojson")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("The walls are in degrees (EPSG:4326)", done.stdout + done.stderr)
        self.assertFalse((self.at / "none.geojson").exists())
        box = [[400000, 5640000], [420000, 5640000], [420000, 5660000], [400000, 5660000], [400000, 5640000]]
        geojson(self.at / "box.geojson", [("LineString", box, {})])
        got, _ = self.run_it("isovists", WALLS="box.geojson", POINTS="degrees.geojson")
        self.assertAlmostEqual(got[0]["properties"]["area"], 4e8, places=3)
        self.assertTrue(400000 < got[0]["properties"]["x"] < 420000)

    def test_without_the_package(self):
        environment = {**self.environment, "PYTHONPATH": ""}
        done = subprocess.run([QGIS_PROCESS, "run", "sightline:place", "--WALLS=walls.geojson", "--OUTPUT=none.geojson"],
                              env=environment, capture_output=True, text=True, cwd=self.at)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("The Python package sightline is missing", done.stdout + done.stderr)

    def test_in_a_session(self):
        """The layer has the plugin's style, and what takes a minute ends when it is cancelled."""
        def said(*words):
            done = subprocess.run([sys.executable, "-B", "-c", RUNNER, *words], env=self.environment, capture_output=True,
                                  text=True, cwd=self.at)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout.splitlines()

        self.assertIn("visual_integration_hh", said("1", "0")[-2])
        self.assertEqual(said("0.06", "0.5")[-1], "False True True")

    def test_styles(self):
        """A map of results is drawn with the plugin's styles."""
        layers = []
        for name, style, more in (("isovists", "isovists", {"POINTS": "points.geojson"}), ("axiallines", "axial", {"LINES": 2}),
                                  ("visibilitygraph", "graph", {"GRID": 0.25})):
            self.run_it(name, f"{name}.geojson", WALLS="walls.geojson", **more)
            layers.append(f"{name}.geojson={self.at}/plugins/sightline_qgis/styles/{style}.qml")
        for drawn, least in (layers[1:2], 10), (layers[::2], 50):
            picture = os.environ.get("SIGHTLINE_PICTURE", str(self.at / "map.png"))
            done = subprocess.run([sys.executable, "-B", "-c", DRAWER, picture, "walls.geojson=", *drawn],
                                  env=self.environment, capture_output=True, text=True, cwd=self.at)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreaterEqual(int(done.stdout.split()[-1]), least)


if __name__ == "__main__":
    if not QGIS_PROCESS:
        print("skipped: QGIS is not installed")
        sys.exit(77)
    PROGRAM, SOURCE, PACKAGE = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
