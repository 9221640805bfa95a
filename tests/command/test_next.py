"""The command that check prints at its end can be run as it is, from any source, up to a bake.
Walls have the names that their source gives them.

test_next.py PROGRAM
"""
import json
import math
import random
import re
import shlex
import subprocess

import sandbox
from wad import make_wad, rooms

# Two rooms with a doorway; the wall between them ends a little before the lower wall.
PLAN = [(0, 0, 10, 0), (10, 0, 10, 6), (10, 6, 0, 6), (0, 6, 0, 0), (5, 0.02, 5, 2), (5, 3, 5, 6)]
# The same with a hole in the border, which a larger --gap closes.
HOLE = [(0, 0, 9.9, 0)] + PLAN[1:]


def turned(lines, degrees, move=(0, 0)):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [tuple(value for x, y in ((a, b), (d, e))
                  for value in (c * x - s * y + move[0], s * x + c * y + move[1]))
            for a, b, d, e in lines]


def jittered(lines, most, seed=1):
    chance = random.Random(seed)
    return [tuple(value + most * (2 * chance.random() - 1) for value in line) for line in lines]


def map_text(lines):
    return "sightline 1\n" + "".join("wall %.17g %.17g %.17g %.17g\n" % line for line in lines)


def dxf(lines, decimals, layer="WALLS"):
    text = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
    for i, line in enumerate(lines):
        text += "0\nLINE\n5\n%X\n8\n%s\n" % (0x1F + i, layer)
        for code, value in zip((10, 20, 11, 21), line):
            text += "%d\n%.*f\n" % (code, decimals, value)
    text += "0\nLINE\n5\nFF\n8\nROOF\n10\n-500\n20\n-500\n11\n90000\n21\n-500\n"
    return text + "0\nENDSEC\n0\nEOF\n"


def svg(lines, between):
    return "<svg>" + between + "<g id='walls'>" + between.join(
        "<line id='w%d' x1='%.6f' y1='%.6f' x2='%.6f' y2='%.6f'/>" % (i, *line)
        for i, line in enumerate(lines)) + "</g></svg>"


def uvtt(lines):
    return json.dumps({"format": 0.3, "resolution": {"map_size": {"x": 10, "y": 6}},
                       "line_of_sight": [[{"x": a, "y": b}, {"x": c, "y": d}]
                                         for a, b, c, d in lines]})


def foundry(lines):
    return json.dumps({"walls": [{"c": [100 * value for value in line], "_id": "id%d" % i,
                                  "sight": 20, "move": 20, "dir": 0, "door": 0, "ds": 0}
                                 for i, line in enumerate(lines)]})


def pgm():
    rows = ["#" * 16] + ["#" + "." * 6 + "#" + "." * 7 + "#"] * 4 + ["#" + "." * 14 + "#"] * 3
    pixels = "".join(rows + ["#" * 16])
    return "P2 16 9 255\n" + " ".join("90" if pixel == "#" else "250" for pixel in pixels)


def tmx():
    rows = ["1" * 8] + ["10010001"] * 2 + ["10000001"] * 2 + ["1" * 8]
    return ("<map orientation='orthogonal' width='8' height='6' tilewidth='16' tileheight='16'>"
            "<layer name='Walls' width='8' height='6'><data encoding='csv'>"
            + ",".join("".join(rows)) + "</data></layer></map>")


def tmx_objects(lines):
    return ("<map orientation='orthogonal' width='8' height='6' tilewidth='16' tileheight='16'>\n"
            "<objectgroup name='Walls'>\n" + "\n".join(
                "<object id='%d' name='w%d' x='%f' y='%f'><polyline points='0,0 %f,%f'/></object>"
                % (i + 7, i, a, b, c - a, d - b) for i, (a, b, c, d) in enumerate(lines))
            + "</objectgroup></map>")


class Next(sandbox.ProgramTest):
    def write(self, name, content):
        binary = isinstance(content, bytes)
        self.box.path(name).write_bytes(content if binary else content.encode())
        return name

    def go_on(self, *arguments, most=6):
        """Runs check, then what it says, up to a bake. Gives the commands and the first text."""
        command, commands, first = ["check", *arguments], [], None
        while command[0] == "check":
            commands.append(command)
            self.assertLess(len(commands), most, commands)
            text = self.printed(*command)
            first = first or text
            last = text.splitlines()[-1]
            self.assertTrue(last.startswith("next: sightline "), text)
            words = shlex.split(last)[2:]
            # The shell reads the same words.
            told = subprocess.run(["sh", "-c", "printf '%s\\n' " + last.split(" ", 2)[2]],
                                  stdout=subprocess.PIPE, check=True).stdout.decode()
            self.assertEqual(told.split("\n")[:-1], words)
            self.assertNotIn(words, commands, "it says the same again")
            command = words
        commands.append(command)
        self.assertEqual(command[0], "bake")
        self.printed(*command)
        return commands, first

    def test_plan(self):
        name = self.write("it's a plan.map", map_text(PLAN))
        commands, text = self.go_on(name, "--gap", "0.05", "--kd-rules=cleaving,median", "--thin",
                                    "1e-3")
        self.assertIn("lines 6 and 2", text)
        self.assertEqual(commands[1], ["check", name, "--gap", "0.05", "--thin", "1e-3",
                                       "--kd-rules", "cleaving,median", "--snap",
                                       "it's a plan-fixed.map"])
        self.assertEqual(commands[-1], ["bake", "it's a plan-fixed.map", "--start",
                                        "2.5,3", "--kd-rules", "cleaving,median"])

    def test_option_like_name(self):
        self.write("-x.map", map_text(PLAN))
        commands, _ = self.go_on("--gap", "0.05", "--", "-x.map")
        self.assertEqual(commands[1][1], "./-x.map")

    def test_start_and_leak(self):
        name = self.write("hole.map", map_text(HOLE))
        commands, _ = self.go_on(name, "--start", "1,1", "--gap", "0.001")
        self.assertEqual(commands[1], ["check", name, "--start", "1,1", "--gap", "0.1", "--snap",
                                       "hole-fixed.map"])
        self.assertEqual(commands[2], ["bake", "hole-fixed.map"])

    def test_start_is_suggested(self):
        name = self.write("open.map", map_text(PLAN[1:4] + [(0, 0, 10, 0)]))
        commands, _ = self.go_on(name)
        self.assertEqual(commands, [["check", name], ["check", name, "--start", "5,3"],
                                    ["bake", name, "--start", "5,3"]])

    def test_leak_that_nothing_closes(self):
        """After the picture the map is baked as it is, or mended by hand."""
        name = self.write("wide.map", map_text(PLAN[1:4] + [(0, 0, 4, 0)]))
        commands, _ = self.go_on(name, "--start", "5,3")
        self.assertEqual(commands, [["check", name, "--start", "5,3"],
                                    ["check", name, "--start", "5,3", "-o", "wide-check.png"],
                                    ["bake", name, "--start", "5,3"]])

    def test_entrance_goes_first(self):
        """Where inside hangs on a wide opening, that is what to say first, and then the gap."""
        plan = [(0, 0, 20, 0), (20, 0, 20, 10), (20, 10, 0, 10), (0, 10, 0, 6), (0, 3.5, 0, 0),
                (10, 0.02, 10, 4), (10, 6, 10, 10)]
        name = self.write("hall.map", map_text(plan) + "unit m\n")
        commands, _ = self.go_on(name, "--gap", "0.05")
        self.assertEqual(commands[1], ["check", name, "--gap", "0.05", "--entrance", "2.5"])
        self.assertEqual(commands[2][-2:], ["--snap", "hall-fixed.map"])

    def test_dxf(self):
        millimetres = [tuple(1000 * value for value in line) for line in PLAN]
        drawn = turned(millimetres, 17.3, (500, 900))
        name = self.write("a.dxf", dxf(drawn, 2))
        options = ["--layers", "WALLS", "--unit", "m", "--gap", "0.05"]
        commands, text = self.go_on(name, *options)
        self.assertIn("(layer WALLS, handle 23) and ", text)
        self.assertIn("(layer WALLS, handle 1F)", text)
        self.assertEqual(sorted(commands[1][2:]), sorted(options + ["--snap", "a-fixed.map"]))
        self.assertEqual(commands[-1][:2], ["bake", "a-fixed.map"])
        found = json.loads(self.printed("check", name, *options, "--json"))
        gap = [fault for fault in found["faults"] if fault["kind"] == "gap"][0]
        self.assertEqual(gap["label"], "layer WALLS, handle 23")

    def test_closed_on_import(self):
        """Gaps within the digits of a drawing are no faults, unless nothing is welded."""
        frame = [tuple(1000 * value for value in line) for line in PLAN[:4]]
        name = self.write("a.dxf", dxf(jittered(turned(frame, 17.3), 0.004), 2))
        found = json.loads(self.printed("check", name, "--layers", "WALLS", "--json"))
        self.assertEqual(found["counts"]["gap"], 0)
        self.assertGreater(found["closed_on_import"], 0)
        text = self.printed("check", name, "--layers", "WALLS")
        self.assertRegex(text, r"[1-9]+ gaps? up to 0\.05 wide (is|are) closed on import")
        found = json.loads(self.printed("check", name, "--layers", "WALLS", "--weld", "0",
                                        "--json"))
        self.assertGreater(found["counts"]["gap"], 0)
        self.assertEqual(found["closed_on_import"], 0)
        self.go_on(name, "--layers", "WALLS", "--weld", "0")

    def test_svg(self):
        for between, named in (("\n", r"line 6 \(line, id w4, layer walls\)"),
                               ("", r"line 1, line, id w4")):
            name = self.write("a.svg", svg(PLAN, between))
            _, text = self.go_on(name, "--gap", "0.05")
            self.assertRegex(text, named)

    def test_commands_in_notes(self):
        """Commands that notes print work as they are, whatever the file is called."""
        def room(at):
            return [(at, at, at + 4, at), (at + 4, at, at + 4, at + 4),
                    (at + 4, at + 4, at, at + 4), (at, at + 4, at, at)]
        name = self.write("it's a plan.svg", svg(room(0) + room(50) + room(100), "\n"))
        told = self.run_well("bake", name, "-o", "plan.slv").stderr
        commands = re.findall(r"sightline ((?:info|check) .*?)(?: shows where| lists|\n)", told)
        self.assertEqual([command.split()[0] for command in commands], ["check", "info", "check"],
                         told)
        self.assertIn("--start ", commands[2])
        for command in commands:
            self.printed(*shlex.split(command))

    def test_parts_apart(self):
        """A crate in a room is ground, too, until a start says where one walks."""
        crate = [(7, 2, 8, 2), (8, 2, 8, 3), (8, 3, 7, 3), (7, 3, 7, 2)]
        for name, content in (("a.uvtt", uvtt(PLAN[:4] + crate)),
                              ("a.tmx", tmx_objects(PLAN[:4] + crate))):
            self.write(name, content)
            told = self.run_well("bake", name, "-o", "a.slv").stderr
            command = re.search(r"the map has no start, so parts .*; 1\.7 % .*: sightline "
                                r"(check .*) keeps the largest", told)
            self.assertTrue(command, told)
            self.assertRegex(told, r"keeps the largest, which reaches the map's edge as rock and "
                                   r"sea do, or with \S+ the largest that does not")
            kept = shlex.split(command[1])
            self.printed("bake", *kept[1:], "-o", "a.slv")
            self.assertIn("1 unreachable room", self.printed(*kept))
            self.assertNotIn("no start", self.run_well(*kept).stderr)
        # Rock around a hall: the hall comes first.
        hall = [(1, 1, 9, 1), (9, 1, 9, 4), (9, 4, 1, 4), (1, 4, 1, 1)]
        self.write("a.uvtt", uvtt(PLAN[:4] + hall))
        told = self.run_well("bake", "a.uvtt", "-o", "a.slv").stderr
        command = re.search(r"not joined to the largest part, which reaches the map's edge as rock "
                            r"and sea do: sightline (check a.uvtt --start (\S+)) keeps the largest "
                            r"that does not, or with \S+ the other one\n", told)
        self.assertTrue(command, told)
        x, y = map(float, command[2].split(","))
        self.assertTrue(1 < x < 9 and 2 < y < 5, command[2])
        # A room of a sixth of the map is still rooms in rock.
        hall = [(1, 1, 3, 1), (3, 1, 3, 4), (3, 4, 1, 4), (1, 4, 1, 1)]
        self.write("a.uvtt", uvtt(PLAN[:4] + hall))
        told = self.run_well("bake", "a.uvtt", "-o", "a.slv").stderr
        self.assertIn(" keeps the largest that does not, ", told)
        # A pocket is no rooms: the parts that count both reach the edge.
        pocket = [(7, 2, 7.4, 2), (7.4, 2, 7.4, 2.4), (7.4, 2.4, 7, 2.4), (7, 2.4, 7, 2)]
        self.write("a.uvtt", uvtt(PLAN[:4] + [(6, 0, 6, 6)] + pocket))
        told = self.run_well("bake", "a.uvtt", "-o", "a.slv").stderr
        command = re.search(r"not joined to the largest part: sightline (check \S+ --start (\S+)) "
                            r"keeps the largest, or with (\S+) the next one\n", told)
        self.assertTrue(command, told)
        self.assertLess(float(command[2].split(",")[0]), 6)
        self.assertGreater(float(command[3].split(",")[0]), 6)
        self.write("a.uvtt", uvtt(PLAN[:4]))
        self.assertNotIn("no start", self.run_well("bake", "a.uvtt", "-o", "a.slv").stderr)

    def test_tabletop(self):
        _, text = self.go_on(self.write("a.uvtt", uvtt(PLAN)), "--gap", "0.05")
        self.assertIn("line_of_sight[4] and line_of_sight[0]", text)
        _, text = self.go_on(self.write("a.json", foundry(PLAN)), "--gap", "5")
        self.assertIn("walls[4], id id4 and walls[0], id id0", text)

    def test_wad(self):
        name = self.write("a.wad", make_wad(rooms("MAP01", 3), rooms("MAP02", 3, skew=2)))
        commands, _ = self.go_on(name, "--map", "map02", "--sectors", "--subdivide", "mesh")
        self.assertEqual(commands[-1], ["bake", name, "--map", "map02", "--sectors",
                                        "--subdivide", "mesh"])
        found = json.loads(self.printed("check", name, "--map", "MAP02", "--gap", "20",
                                        "--json"))
        labels = [fault["label"] for fault in found["faults"] if "label" in fault]
        self.assertTrue(labels and all(label.startswith("linedef ") for label in labels))
        self.assertFalse(any("line" in fault for fault in found["faults"]))

    def test_pictures_and_tiles(self):
        self.go_on(self.write("a.pgm", pgm()), "--threshold", "0.6")
        self.go_on(self.write("a.tmx", tmx()), "--layers", "Walls")

    def test_objects(self):
        _, text = self.go_on(self.write("a.tmx", tmx_objects(PLAN)), "--gap", "0.05")
        self.assertIn("layer Walls, object 11 'w4', line 7 and layer Walls, object 7 'w0', line 3",
                      text)

    def test_snap_from_any_source(self):
        for name, content in (("a.pgm", pgm()), ("a.tmx", tmx()), ("a.dxf", dxf(PLAN, 3)),
                              ("a.svg", svg(PLAN, "\n")), ("a.uvtt", uvtt(PLAN)),
                              ("a.json", foundry(PLAN)), ("a.wad", make_wad(rooms("MAP01", 3)))):
            self.write(name, content)
            self.printed("check", name, "--snap", name + ".map")
            self.printed("check", name + ".map")

    def test_baked(self):
        self.write("a.map", map_text(PLAN))
        self.printed("bake", "a.map", "-o", "a.slv")
        commands, _ = self.go_on("a.slv", "--gap", "0.05")
        self.assertEqual(commands, [["check", "a.slv", "--gap", "0.05"],
                                    ["check", "a.slv", "--gap", "0.05", "--snap", "a-fixed.map"],
                                    ["check", "a-fixed.map", "--gap", "0.05", "--start", "2.5,3"],
                                    ["bake", "a-fixed.map", "--start", "2.5,3"]])
        self.assertIn("next: sightline info a.slv",
                      self.printed("check", "a.slv", "--gap", "1e-5", "--start", "1,1"))

    def test_widths(self):
        """Far from the origin, and tiny."""
        far = [tuple(100 * v + m for v, m in zip(line, 2 * (531577, 184242))) for line in PLAN]
        text = self.printed("check", self.write("far.map", map_text(far)), "--gap", "3")
        self.assertIn("2 wide, from (532077,184244) to (532077,184242)", text)
        tiny = [tuple(1e-7 * v for v in line) for line in PLAN]
        text = self.printed("check", self.write("tiny.map", map_text(tiny)), "--gap", "3e-9")
        self.assertIn("2e-09 wide, from (5e-07,2e-09) to (5e-07,0)", text)
        self.go_on("far.map", "--gap", "3")
        self.go_on("tiny.map", "--gap", "3e-9")


if __name__ == "__main__":
    sandbox.main()
