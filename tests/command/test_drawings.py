"""Results as DXF: our own reader reads the same places back, and so does ezdxf.

test_drawings.py PROGRAM

Needs the Python package ezdxf for the second part; without it, that is skipped with a message.
"""
import csv
import json
import math

import sandbox

try:
    import ezdxf
except ImportError:
    ezdxf = None

TURN = math.radians(17.3)
WALLS = [(0, 0, 10, 0), (10, 0, 10, 5), (10, 5, 0, 5), (0, 5, 0, 0), (6, 0, 6, 2), (6, 3, 6, 5)]


def plan(turned, unit):
    def at(x, y):
        if turned:
            return 3 + x * math.cos(TURN) - y * math.sin(TURN), x * math.sin(TURN) + y * math.cos(TURN)
        return float(x), float(y)
    lines = ["sightline 1"] + ([f"unit {unit}"] if unit else [])
    for x0, y0, x1, y1 in WALLS:
        lines.append("wall {!r} {!r} {!r} {!r}".format(*at(x0, y0), *at(x1, y1)))
    return "\n".join(lines), at(3, 2.5)


class Drawings(sandbox.ProgramTest):
    def each(self):
        for turned in False, True:
            for unit in "m", "":
                text, eye = plan(turned, unit)
                self.box.path("plan.map").write_text(text)
                with self.subTest(turned=turned, unit=unit):
                    yield unit, eye

    def axial(self):
        self.run_well("axial", "plan.map", "--lines", "all", "-o", "lines.csv", "--quiet")
        self.run_well("axial", "plan.map", "--lines", "all", "-o", "lines.dxf", "--quiet")
        with open(self.box.path("lines.csv")) as file:
            return {tuple(float(row[name]) for name in ("x1", "y1", "x2", "y2")) for row in csv.DictReader(file)}

    def isovist(self, eye):
        at = f"{eye[0]!r},{eye[1]!r}"
        self.run_well("isovist", "plan.map", "--at", at, "-o", "seen.dxf", "--quiet")
        self.run_well("isovist", "plan.map", "--at", at, "-o", "seen.geojson", "--quiet")
        feature, = json.loads(self.box.path("seen.geojson").read_text())["features"]
        ring, = feature["geometry"]["coordinates"]
        return [tuple(point) for point in ring[:-1]]

    def test_our_reader_reads_the_same(self):
        for _, eye in self.each():
            lines = self.axial()
            self.run_well("axial", "lines.dxf", "--lines", "drawn", "-o", "again.csv", "--quiet")
            with open(self.box.path("again.csv")) as file:
                again = {tuple(float(row[name]) for name in ("x1", "y1", "x2", "y2")) for row in csv.DictReader(file)}
            self.assertEqual(lines, again)
            self.assertGreater(len(lines), 1)
            ring = self.isovist(eye)
            text = self.printed("convert", "seen.dxf", "--layers", "ISOVIST", "--quiet", "-o", "-")
            ends = set()
            for line in text.splitlines():
                words = line.split()
                if words[:1] in (["wall"], ["walls"]):
                    numbers = [float(word) for word in words[1:9999] if word[0] in "-.0123456789"]
                    ends |= set(zip(numbers[::2], numbers[1::2]))
            self.assertEqual(ends, set(ring))

    def test_ezdxf_reads_the_same(self):
        if not ezdxf:
            self.skipTest("the Python package ezdxf is missing (tools/setup.sh --ci brings it)")
        for unit, eye in self.each():
            lines, ring = self.axial(), self.isovist(eye)
            drawing = ezdxf.readfile(self.box.path("lines.dxf"))
            self.assertEqual(drawing.header.get("$INSUNITS", 0), 6 if unit else 0)
            self.assertEqual({(*each.dxf.start.vec2, *each.dxf.end.vec2) for each in drawing.modelspace()}, lines)
            self.assertEqual({each.dxf.layer for each in drawing.modelspace()}, {"AXIAL"})
            self.assertIn("AXIAL", drawing.layers)
            drawing = ezdxf.readfile(self.box.path("seen.dxf"))
            outline, = drawing.modelspace()
            self.assertTrue(outline.is_closed)
            self.assertEqual([tuple(vertex.dxf.location.vec2) for vertex in outline.vertices], ring)
            self.assertFalse(drawing.audit().has_errors)

    def test_what_a_drawing_does_not_have(self):
        for _, eye in self.each():
            result = self.box.run(["isovist", "plan.map", "--at", "3,2.5", "--at", "4,2.5", "--union", "-o", "a.dxf"])
            self.assertEqual(result.status, 2, result.text())
            self.assertIn("single viewpoints", result.stderr)


if __name__ == "__main__":
    sandbox.main()
