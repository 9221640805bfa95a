"""Plans on paper: what a report says is what the other commands compute, and its letters are text.

test_paper.py PROGRAM

Needs pdftotext, of poppler; without it the text of PDFs is skipped, with a message.
"""
import csv
import itertools
import json
import math
import re
import shutil
import subprocess
import unittest

import sandbox
from case import MAPS
from test_rooms import corridor

TURN = math.radians(17.3)


def turned(x, y):
    return 30 + x * math.cos(TURN) - y * math.sin(TURN), x * math.sin(TURN) + y * math.cos(TURN)


def plan(place=lambda x, y: (x, y)):
    """Two rooms with a gap between them, 24 x 10 m."""
    def line(*numbers):
        return " ".join(f"{number!r}" for k in range(0, len(numbers), 2)
                        for number in place(numbers[k], numbers[k + 1]))
    return ("sightline 1\nunit m\nwalls " + line(0, 0, 24, 0, 24, 10, 0, 10, 0, 0) + "\n"
            + "wall " + line(12, 0, 12, 4) + "\nwall " + line(12, 6, 12, 10) + "\n"
            + "door entry " + line(12, 4, 12, 6) + " open\n")


class Paper(sandbox.ProgramTest):
    def text_of(self, name):
        if not shutil.which("pdftotext"):
            self.skipTest("pdftotext is missing (tools/setup.sh --ci brings it)")
        return subprocess.run(["pdftotext", "-layout", str(self.box.path(name)), "-"], check=True,
                              capture_output=True, text=True).stdout

    def row(self, text, name):
        """The cells of the first table's row."""
        lines = re.findall(rf"^ *{name}  +(-?\d.*)$", text, re.MULTILINE)  # other lines are names on a plan
        self.assertTrue(lines, name)
        return re.split(r"  +", lines[0].strip())

    def check_report(self, place):
        self.box.path("rooms.map").write_text(plan(place))
        self.run_well("report", "rooms.map", "--grid", "0.5", "-o", "a.pdf", "--quiet")
        self.run_well("vga", "rooms.map", "--grid", "0.5", "--measures", "visual,through,isovist", "-o",
                      "a.csv", "--quiet")
        text = self.text_of("a.pdf")
        with open(self.box.path("a.csv")) as file:
            rows = list(csv.DictReader(file))
        for measure in ("connectivity", "visual_mean_depth", "through_vision", "area", "occlusivity", "max_radial"):
            values = [float(row[measure]) for row in rows]
            said = self.row(text, measure.replace("_", " "))
            for cell, value in zip(said, (sum(values) / len(values), None, min(values), max(values))):
                if value is not None:
                    self.assertAlmostEqual(float(cell), value, delta=max(5e-4 * abs(value), 0.5 * (abs(value) > 999)),
                                           msg=measure)
        self.assertIn(f"{len(rows)} points of a grid with a step of 0.5 m", text)
        self.assertEqual(self.row(text, "area inside")[0][:14], "240 square m, ")
        self.assertEqual(self.row(text, "doors")[0], "1, 1 of them open")
        self.assertIn("Method and exactness", text)
        self.assertRegex(text, "area, m²  .*mean of isovist area, m²")
        self.run_well("rooms", "rooms.map", "--grid", "0.5", "-o", "rooms.csv", "--quiet")
        with open(self.box.path("rooms.csv")) as file:
            for row in csv.DictReader(file):
                said = self.row(text, row["room"])
                for cell, value in zip(said, (float(row["area"]), None, float(row["visual_integration_hh"]))):
                    if value is not None:
                        self.assertAlmostEqual(float(cell), value, delta=5e-4 * value)

    def test_figures_are_those_of_other_commands(self):
        self.check_report(lambda x, y: (x, y))

    def test_turned_plans_have_the_same_area(self):
        self.check_report(turned)

    def cameras(self, place):
        """Two at one place in the west, where the gap hides much of the east, and one beside them."""
        self.box.path("rooms.map").write_text(plan(place))
        rows = (("Gate", place(3, 5)), ("Hall", place(3, 5)), ("Lift", place(3.1, 5)))
        self.box.path("cameras.csv").write_text(
            "name,x,y\n" + "".join(f"{name},{x!r},{y!r}\n" for name, (x, y) in rows))

    def test_cameras_of_a_report_are_those_of_cover(self):
        for place in (lambda x, y: (x, y)), turned:
            self.cameras(place)
            self.run_well("report", "rooms.map", "--grid", "2", "--cameras", "cameras.csv", "-o", "a.pdf", "--quiet")
            text = self.text_of("a.pdf")
            said = json.loads(self.printed("cover", "rooms.map", "cameras.csv", "--rooms", "--json", "--quiet"))
            for name, key in ("not seen", "0"), ("seen by 1", "1"), ("seen by 3 or more", "3+"):
                area, share = self.row(text, name)
                self.assertAlmostEqual(float(area.split()[0]), said["areas"][key], delta=5e-4 * said["areas"][key])
                self.assertAlmostEqual(float(share.split()[0]), 100 * said["areas"][key] / 240, delta=0.051)
            parts = text[text.index("What share of each room"):]
            for room in said["rooms"]:
                cells = self.row(parts, room["name"])
                self.assertAlmostEqual(float(cells[1].split()[0]), 100 - 100 * room["seen_area"] / room["inside_area"],
                                       delta=0.051)
                self.assertEqual(int(cells[-1]), room["viewpoints"])
            blind = text[text.index("blind spots. The picture"):]
            for i, spot in enumerate(said["blind_spots"]):
                area, x, y, room = self.row(blind, i + 1)
                self.assertAlmostEqual(float(area.split()[0]), spot["area"], delta=5e-4 * spot["area"])
                self.assertAlmostEqual(float(x), spot["x"], places=4)
                self.assertEqual(room, "Room 2")
            self.assertEqual(len(said["blind_spots"]), 2)

    def test_doubts_about_cameras_are_those_of_cover(self):
        """A heading without a field of view, and a camera that looks at the wall it hangs on."""
        self.box.path("rooms.map").write_text(plan())
        self.box.path("cameras.csv").write_text("x,y,heading,fov\n3,5,90,360\n12,2,90,20\n0,5,180,90\n")
        said = [[line for line in result.stderr.splitlines() if line.startswith("note: cameras.csv:")] for result in (
            self.run_well("cover", "rooms.map", "cameras.csv"),
            self.run_well("report", "rooms.map", "--grid", "2", "--cameras", "cameras.csv", "-o", "a.pdf"))]
        self.assertEqual(len(said[0]), 2)
        # A report has no option of that name.
        self.assertEqual(said[1], [line.replace("--fov or a column fov", "a column fov") for line in said[0]])
        self.assertNotEqual(said[1], said[0])

    def test_rooms_of_a_report_end_at_drawn_doors(self):
        """The rooms of a drawing are those that `rooms` and `cover --rooms` list."""
        self.box.path("plan.svg").write_text(corridor())
        self.box.path("cameras.csv").write_text("x,y\n5,0.5\n")
        self.run_well("report", "plan.svg", "--grid", "0.5", "--cameras", "cameras.csv", "-o", "a.pdf", "--quiet")
        text = self.text_of("a.pdf")
        self.assertIn("once doors are shut", " ".join(text.split()))
        cameras = text[text.index("What share of each room"):]
        for name, area in ("Hall", 10), ("Den", 25), ("Bath", 25):
            self.assertEqual(float(self.row(text, name)[0]), area)
            self.assertEqual(float(self.row(cameras, name)[0].split()[0]), area)

    def test_marks_at_one_place_stand_apart(self):
        """Words on paper have boxes: none of the names lies on another, and each is on the sheet."""
        self.cameras(turned)
        self.run_well("cover", "rooms.map", "cameras.csv", "--picture", "a.pdf", "--paper", "A3", "--quiet")
        self.text_of("a.pdf")
        words = subprocess.run(["pdftotext", "-bbox", str(self.box.path("a.pdf")), "-"], check=True,
                               capture_output=True, text=True).stdout
        boxes = {name: [float(number) for number in numbers] for *numbers, name in re.findall(
            r'<word xMin="(.*?)" yMin="(.*?)" xMax="(.*?)" yMax="(.*?)">(Gate|Hall|Lift)<', words)}
        self.assertEqual(set(boxes), {"Gate", "Hall", "Lift"})
        for one, other in itertools.combinations(boxes, 2):
            a, b = boxes[one], boxes[other]
            self.assertTrue(a[2] < b[0] or b[2] < a[0] or a[3] < b[1] or b[3] < a[1], (one, other, a, b))

    def test_bytes_do_not_depend_on_threads(self):
        for name, threads in (("a.pdf", 1), ("b.pdf", 2)):
            self.run_well("report", MAPS / "flat.map", "-o", name, "--threads", threads, "--quiet")
        self.assertEqual(self.box.path("a.pdf").read_bytes(), self.box.path("b.pdf").read_bytes())

    def test_sheets_have_text(self):
        self.box.path("rooms.map").write_text(plan())
        self.run_well("bake", "rooms.map", "-o", "rooms.slv", "--quiet")
        self.run_well("draw", "rooms.slv", "-o", "a.pdf", "--paper", "A3", "--plot-scale", "1:100", "--title",
                      "Zwei Räume", "--note", "first floor", "--north", "0,1")
        text = self.text_of("a.pdf")
        for word in ("Zwei Räume", "first floor", "1:100", "on A3", "door", "N"):
            self.assertIn(word, text)


if __name__ == "__main__":
    sandbox.main()
