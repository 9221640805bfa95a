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
        lines = [("LineString", [moved(*a), moved(*b)], {}) for a, b in (((0, 0), (9, 0)), ((3, -3), (3, 4)), ((9, 0), (3, 4)))]
        geojson(self.at / "streets.geojson", lines)
        (self.at / "streets.csv").write_text("x1,y1,x2,y2\n" + "".join(
            ",".join(map(str, a + b)) + "\n" for _, (a, b), _ in lines), encoding="utf-8")
        got, _ = self.run_it("segments", WALLS="streets.geojson", METRIC_RADIUS=8)
        wanted = table(self.said("segments", "streets.csv", "--metric-radius", 8))
        self.same(got, [{k.replace("_r8_metric", ""): v for k, v in row.items() if k not in ENDS} for row in wanted],)

    def test_weights_and_unlinks(self):
        """A line of two sides shares its weight by length, as two lines do; a bridge is no junction."""
        sides = [((0, 0), (9, 0), 6), ((3, -3), (3, 4), 14), ((3, 4), (9, 4), 12)]
        (self.at / "streets.csv").write_text("x1,y1,x2,y2,lanes\n" + "".join(
            f"{a[0]},{a[1]},{b[0]},{b[1]},{w}\n" for a, b, w in sides), encoding="utf-8")
        (self.at / "bridges.csv").write_text("x,y\n3,0\n", encoding="utf-8")
        geojson(self.at / "streets.geojson", [("LineString", [moved(0, 0), moved(9, 0)], {"lanes": 6}),
                                              ("LineString", [moved(3, -3), moved(3, 4), moved(9, 4)], {"lanes": 26})])
        geojson(self.at / "bridges.geojson", [("Point", moved(3, 0), {})])
        for here, there in (({}, []), ({"UNLINKS": "bridges.geojson"}, ["--unlinks", "bridges.csv"])):
            got, _ = self.run_it("segments", WALLS="streets.geojson", WEIGHT="lanes", **here)
            wanted = table(self.said("segments", "streets.csv", "--weight", "lanes", *there))
            self.assertIn("t1024_choice_weighted", wanted[0])
            self.same(got, [{k: v for k, v in row.items() if k not in ENDS and k != "lanes"} for row in wanted])
        geojson(self.at / "streets.geojson", [("LineString", [moved(0, 0), moved(9, 0)], {"lanes": 6}),
                                              ("LineString", [moved(3, -3), moved(3, 4)], {"lanes": None})])
        done = self.process("segments", WALLS="streets.geojson", WEIGHT="lanes")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("Feature 1 of the walls: field 'lanes' must hold a number", done.stdout + done.stderr)

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
        self.assertEqual({feature["properties"]["count"] == 0 for feature in got if feature["properties"]["blind_spot"] is None},
                         {False})
        self.assertNotIn("sees nothing of the inside", log)
        geojson(self.at / "cameras.geojson", [("Point", moved(1, 4), {}), ("Point", moved(99, 4), {})])
        self.assertRegex(self.run_it("cover", WALLS="walls.geojson", POINTS="cameras.geojson")[1],
                         r"Viewpoint 1 at [0-9,]* sees nothing of the inside")

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
        self.assertEqual([feature["properties"]["area"] for feature in got[:2]], [36, 0])
        self.assertIn("Point 1 at", log)
        for number in 0, 2:
            self.assertNotIn(f"Point {number} at", log)
        self.assertIn("1 of 3 points sees the border of the map", log)

    def test_doors_without_names(self):
        """Each stands as its own field says."""
        walls = [(0, 0, 30, 0), (30, 0, 30, 10), (30, 10, 0, 10), (0, 10, 0, 0),
                 *((x, y, x, y + 4) for x in (10, 20) for y in (0, 6))]
        doors = [("LineString", [moved(x, 4), moved(x, 6)], {"what": "door", "open": x == 10}) for x in (10, 20)]
        geojson(self.at / "doors.geojson", [("LineString", [moved(a, b), moved(c, d)], {}) for a, b, c, d in walls] + doors)
        geojson(self.at / "rooms.geojson", [("Point", moved(x, 5), {}) for x in (5, 15, 25)])
        got, _ = self.run_it("isovists", WALLS="doors.geojson", KIND="what", POINTS="rooms.geojson")
        self.assertEqual([feature["properties"]["area"] > 100 for feature in got], [True, True, False])

    def test_open_ground(self):
        """Buildings without anything around them: sight goes as far as its range, ways around them, and what is cut is said."""
        def square(x):
            return [moved(x, 0), moved(x + 10, 0), moved(x + 10, 10), moved(x, 10), moved(x, 0)]

        def numbers(corners):
            return " ".join(str(number) for corner in corners for number in corner)

        geojson(self.at / "houses.geojson", [("Polygon", [square(x)], {}) for x in (0, 20)])
        houses = "sightline 1\n" + "".join(f"solid {numbers(square(x)[:4])}\n" for x in (0, 20))
        ground = [moved(-30, -30), moved(50, -30), moved(50, 40), moved(-30, 40), moved(-30, -30)]
        (self.at / "houses.map").write_text(houses + f"seam {numbers(ground[:2])}\nseam {numbers(ground[2:4])}\n",
                                            encoding="utf-8")
        (self.at / "fenced.map").write_text(houses + f"walls {numbers(ground)}\n", encoding="utf-8")
        at = [(15, 5), (-5, 5), (5, 5)]
        look = ["--at={},{}".format(*moved(x, y)) for x, y in at[:2]]
        geojson(self.at / "eyes.geojson", [("Point", moved(x, y), {}) for x, y in at])
        got, log = self.run_it("isovists", WALLS="houses.geojson", POINTS="eyes.geojson", RANGE=12)
        self.assertNotIn("border", log)
        self.assertNotIn("STARTS", log)
        self.assertRegex(log, "Point 2 at [0-9,]* sees nothing: it is in solid ground")
        wanted = table(self.said("isovist", "houses.map", *look, "--range", 12))
        self.same(got[:2], wanted, ["area", "perimeter", "corners"])
        self.assertGreater(wanted[0]["area"], 100)
        _, log = self.run_it("isovists", WALLS="houses.geojson", POINTS="eyes.geojson")
        self.assertRegex(log, "2 of 3 points see the border of the map .* set a range")

        got, log = self.run_it("ways", WALLS="houses.geojson", ENDS="eyes.geojson", RADIUS=0.5,
                               START="{},{} [{}]".format(*moved(40, 5), UTM))
        self.assertRegex(log, "There is no way to point 2 at [0-9,]*: to [0-9,]* is in solid ground")
        wanted = json.loads(self.said("path", "houses.map", "--from", "{},{}".format(*moved(40, 5)), "--to",
                                      "{},{}".format(*moved(-5, 5)), "--radius", 0.5, "--json"))
        self.assertTrue(math.isclose(got[1]["properties"]["length"], wanted["length"], rel_tol=1e-9))
        self.assertIsNone(got[2]["properties"]["length"])
        done = self.process("ways", WALLS="houses.geojson", ENDS="eyes.geojson", START="{},{} [{}]".format(*moved(5, 5), UTM))
        self.assertNotEqual(done.returncode, 0)

        geojson(self.at / "fence.geojson", [("LineString", ground, {})])
        got, log = self.run_it("isovists", WALLS="fence.geojson", MORE="houses.geojson", POINTS="eyes.geojson")
        self.assertNotIn("border", log)
        self.same(got[:2], table(self.said("isovist", "fenced.map", *look)), ["area", "perimeter", "corners"])

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
