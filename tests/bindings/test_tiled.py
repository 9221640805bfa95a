"""The extension for Tiled, in Tiled: test_tiled.py PROGRAM SOURCE

A script beside the extension opens a map, selects an object, looks from it and saves; what the extension drew is what the
command says. Skipped (77) where Tiled is not here.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as xml

DRIVER = """
tiled.assetOpened.connect((map) => {
  const eyes = map.layerAt(map.layerCount - 1)
  map.selectedObjects = eyes.objects
  tiled.trigger('SightlineSeen')
  tiled.trigger('SightlineSeen')
  tiled.trigger('Save')
  const done = new TextFile('DONE', TextFile.WriteOnly)
  done.commit()
})
"""


def area(points):
    return abs(sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]))) / 2


class Tiled(unittest.TestCase):
    def test_what_is_seen(self):
        with tempfile.TemporaryDirectory() as folder:
            self.look(pathlib.Path(folder))

    def look(self, at):
        def said(*words):
            return subprocess.run([PROGRAM, *words], check=True, capture_output=True, text=True, cwd=at).stdout

        said("convert", SOURCE / "maps/office.map", "-o", "office.tmx", "-q")
        told = json.loads(said("info", "office.tmx", "--json", "-q"))["transform"]
        eye = (53.0, 20.0)
        x, y = told["scale"] * (eye[0] - told["x"]), told["scale"] * (told["y"] - eye[1])
        file = xml.parse(at / "office.tmx")
        properties = file.getroot().find("properties")
        if properties is None:
            properties = xml.Element("properties")
            file.getroot().insert(0, properties)
        for name, kind, value in (("sightline", "string", str(PROGRAM)), ("sightline_bake", "bool", "true")):
            xml.SubElement(properties, "property", name=name, type=kind, value=value)
        group = xml.SubElement(file.getroot(), "objectgroup", id="900", name="eyes")
        # Turned by a quarter about its place, its middle is the eye.
        xml.SubElement(group, "object", id="901", x=str(x + 1), y=str(y - 2), width="4", height="2", rotation="90")
        file.write(at / "office.tmx")
        plain = json.loads(said("info", "office.tmx", "--json", "-q"))

        extensions = at / "config/tiled/extensions"
        extensions.mkdir(parents=True)
        shutil.copy(SOURCE / "lib/bindings/tiled/sightline.js", extensions)
        (extensions / "try.js").write_text(DRIVER.replace("DONE", str(at / "done")), encoding="utf-8")
        os.chmod(at, 0o700)
        environment = {**os.environ, "HOME": str(at), "XDG_CONFIG_HOME": str(at / "config"), "XDG_RUNTIME_DIR": str(at),
                       "QT_QPA_PLATFORM": "offscreen"}
        with open(at / "log", "w", encoding="utf-8") as log, subprocess.Popen(
                ["tiled", "--disable-opengl", at / "office.tmx"], env=environment, stdout=log, stderr=log) as tiled:
            for _ in range(600):
                if (at / "done").exists() or tiled.poll() is not None:
                    break
                time.sleep(0.1)
            tiled.kill()
        self.assertTrue((at / "done").exists(), (at / "log").read_text(encoding="utf-8"))

        layers = [layer for layer in xml.parse(at / "office.tmx").getroot() if layer.get("name") == "seen (Sightline)"]
        self.assertEqual(len(layers), 1) # of two looks, the last
        drawn, = layers[0]
        points = [tuple(map(float, point.split(","))) for point in drawn.find("polygon").get("points").split()]
        said("isovist", "office.slv", "--at", f"{eye[0]},{eye[1]}", "-o", "seen.geojson", "-q") # of the map as saved
        region, = json.loads((at / "seen.geojson").read_text(encoding="utf-8"))["features"]
        wanted = region["properties"]["area"] * told["scale"] ** 2
        self.assertGreater(wanted, 100)
        self.assertAlmostEqual(area(points) / wanted, 1, places=4) # Tiled writes six digits
        self.assertEqual(len(points), len(region["geometry"]["coordinates"][0]) - 1)
        self.assertEqual(sorted(path.name for path in at.glob("office.*")), ["office.slv", "office.tmx"])
        again = json.loads(said("info", "office.tmx", "--json", "-q"))
        self.assertEqual(again, plain) # what is drawn is no wall


if __name__ == "__main__":
    if not shutil.which("tiled"):
        print("Tiled is not here")
        sys.exit(77)
    PROGRAM, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    unittest.main(argv=sys.argv[:1])
