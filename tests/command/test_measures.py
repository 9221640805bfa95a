"""The rows of sightline/measures.h are what commands write, what help explains and what the documents name:
test_measures.py PROGRAM

The tests of Python, JavaScript and the viewer compare their lists with the library's table and these commands.
"""
import pathlib
import re

import sandbox

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROW = re.compile(r'row\((\w+),\s*(\w+),\s*(\w+),[\s\\]*"([^"]+)"\)')
MAP = "sightline 1\nwalls 0 0 6 0 6 6 0 6 0 0\nwall 3 0 3 4\nstart 1 1 0\n"


def rows(*lists):
    """(name, group, unit, meaning) of each row."""
    text = (ROOT / "lib/include/sightline/measures.h").read_text(encoding="utf-8")
    found = {name: ROW.findall(body) for name, body in re.findall(r"#define SL_(\w+)\(row\)([^#]*)", text)}
    return [row for name in lists for row in found[name]]


def names(*lists):
    return [row[0] for row in rows(*lists)]


ISOVIST = ["ISOVIST_MEASURES", "RADIAL_MEASURES"]
VGA = ["GRAPH_MEASURES", "ISOVIST_MEASURES", "GRAPH_COUNTS", "DEPTH_MEASURES", "AGENT_MEASURES"]


class Measures(sandbox.ProgramTest):
    def setUp(self):
        super().setUp()
        self.box.path("a.map").write_text(MAP)

    def columns(self, command, *arguments):
        return self.printed(command, "a.map", *arguments, "--quiet").split("\n", 1)[0].split(",")

    def test_rows_are_read(self):
        self.assertEqual([len(rows(*lists)) > 5 for lists in (ISOVIST, VGA, ["AXIAL_MEASURES"], ["SEGMENT_MEASURES"])],
                         [True] * 4)

    def test_isovist(self):
        self.assertEqual(self.columns("isovist"), ["x", "y", "heading", "fov", *names(*ISOVIST), "corners"])

    def test_vga(self):
        found = self.columns("vga", "--grid", "1", "--measures", "all", "--from", "1,1", "--agents", "2")
        self.assertEqual(found, ["x", "y", *names(*VGA)])

    def test_lines(self):
        for command, its, option, ending in (("axial", "AXIAL_MEASURES", "--radius", "_r3"),
                                             ("segments", "SEGMENT_MEASURES", "--metric-radius", "_r3_metric")):
            limited = [name + ending for name, group, _, _ in rows(its) if group == "NETWORK"]
            self.assertEqual(self.columns(command, option, "n", option, "3"),
                             ["x1", "y1", "x2", "y2", *names(its), *limited])

    def test_help_explains_each(self):
        for command, lists in (("isovist", ISOVIST), ("vga", VGA), ("axial", ["AXIAL_MEASURES"]),
                               ("segments", ["SEGMENT_MEASURES"])):
            text = self.printed(command, "--help", "all")
            text = " ".join(text[text.index("\nmeasures, for --measure"):].split())
            for name, _, _, meaning in rows(*lists):
                self.assertIn(f" {name} {meaning}", text)

    def test_the_guide_to_floor_plans_names_each_isovist(self):
        text = (ROOT / "maps/FLOOR-PLANS.md").read_text(encoding="utf-8")
        missing = [name for name in names(*ISOVIST) if not re.search(rf"(?m)^\|[^|]*`{name}`[^|]*\|", text)]
        self.assertEqual(missing, [], "add a row for each to the table of measures in maps/FLOOR-PLANS.md")

    def test_every_measure_can_be_drawn(self):
        for command, option, lists in (("isovist", ["--grid", "1"], ISOVIST),
                                       ("vga", ["--grid", "1", "--from", "1,1", "--agents", "2"], VGA)):
            for name in names(*lists):
                self.run_well(command, "a.map", *option, "--measure", name, "--picture", "a.svg", "--quiet")


if __name__ == "__main__":
    sandbox.main()
