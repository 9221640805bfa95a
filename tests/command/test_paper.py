"""Plans on paper: what a report says is what the other commands compute, and its letters are text.

test_paper.py PROGRAM

Needs pdftotext, of poppler; without it the text of PDFs is skipped, with a message.
"""
import csv
import math
import re
import shutil
import subprocess
import unittest

import sandbox
from case import MAPS

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
