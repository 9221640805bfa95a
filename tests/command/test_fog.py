"""The examples of lib/runtime/examples see the same: C with the runtime header, Python and JavaScript with
the JSON export. On levels with doors open and shut, among them a turned one and one with doors of one name.

test_fog.py PROGRAM

Cells must be equal, corners of the polygon up to 1e-9 of the level's size. Eyes are random, so that none
is in line with two corners; or they are on walls, doors and corners, where C may also see cells that a
line touches. Without node, JavaScript is left out, with a message.
"""
import math
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import sandbox

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "lib/runtime/examples"
WARNINGS = ["-std=c99", "-pedantic-errors", "-Wall", "-Wextra", "-Wshadow", "-Wconversion",
            "-Wsign-conversion", "-Werror"]
EYES = 4
# Maps, degrees to turn them by, and doors for them: name, place, state.
LEVELS = {
    "doors": ("maps/effects/doors.map", 0, []),
    "office": ("maps/office.map", 0, [("south", (8, 6.5, 9, 6.5), "open"),
                                      ("stair", (17, 9, 18, 9), "shut"),
                                      ("north", (8.5, 33.5, 9.5, 33.5), "open")]),
    "one name": ("maps/office.map", 0, [("west", (7, 9.5, 7, 10.5), "open"),
                                        ("west", (7, 11.5, 7, 12.5), "open"),
                                        ("west", (7, 18.5, 7, 19.5), "open"),
                                        ("east", (57, 10.5, 57, 11.5), "shut"),
                                        ("west", (7, 20.5, 7, 21.5), "open")]),
    "chapel": ("maps/oblique/chapel.map", 17.3, [("porch", (2, 9, 2, 15), "open"),
                                                 ("screen", (30, 11.5, 30, 12.5), "open")]),
    "glass": ("maps/effects/oneway.map", 0, []),
}
NUMBERS = {"wall": 4, "walls": None, "solid": None, "door": 4, "oneway": 4, "start": 2}


def turn(x, y, degrees):
    if not degrees:
        return x, y
    angle = math.radians(degrees)
    return (x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle))


def turned(line, degrees):
    """A statement of map text, turned about the origin."""
    words = line.split("#")[0].split()
    if not words or words[0] not in NUMBERS:
        return " ".join(words)
    first = 2 if words[0] == "door" else 1
    last = first + NUMBERS[words[0]] if NUMBERS[words[0]] else len(words)
    numbers = [float(word) for word in words[first:last]]
    points = [turn(x, y, degrees) for x, y in zip(numbers[::2], numbers[1::2])]
    words[first:last] = [repr(number) for point in points for number in point]
    return " ".join(words)


def bounds_of(text):
    numbers = [float(word) for line in re.findall(r"^walls? ([^#\n]*)", text, re.MULTILINE)
               for word in line.split()]
    return min(numbers[::2]), min(numbers[1::2]), max(numbers[::2]), max(numbers[1::2])


class Answer:
    def __init__(self, text, picture):
        lines = text.splitlines()
        head = [line.split() for line in lines[:4]]
        assert [words[0] for words in head] == ["cell", "row", "seen", "points"], text
        self.cell, self.row, self.seen = (list(map(int, words[1:])) for words in head[:3])
        self.points = [tuple(map(float, line.split())) for line in lines[4:]]
        assert len(self.points) == int(head[3][1])
        drawn = [shape.get("points").split() for shape in
                 xml.etree.ElementTree.parse(picture).iter("{http://www.w3.org/2000/svg}polygon")]
        # Cells come first, then what is seen.
        assert len(drawn[-1]) == len(self.points)

    def __eq__(self, other):
        return vars(self) == vars(other)


def without_flat(points):
    """Without corners where rounding alone bends a wall: C joins exactly what is in one line."""
    def is_flat(a, b, c):
        return abs((c[0] - a[0]) * (b[1] - a[1]) - (c[1] - a[1]) * (b[0] - a[0])) <= 1e-9 * math.dist(a, c) ** 2
    return [b for a, b, c in zip(points[-1:] + points[:-1], points, points[1:] + points[:1])
            if not is_flat(a, b, c)]


def same_corners(points, others, limit):
    """Whether two polygons have the same corners, whichever comes first."""
    points, others = without_flat(points), without_flat(others)
    if len(points) != len(others):
        return False
    if not points:
        return True
    first = min(range(len(others)), key=lambda i: math.dist(points[0], others[i]))
    return all(math.dist(p, q) <= limit for p, q in zip(points, others[first:] + others[:first]))


class Fog(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not shutil.which("cc"):
            raise unittest.SkipTest("no compiler is here")
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.at = pathlib.Path(cls.folder.name)
        subprocess.run(["cc", *WARNINGS, EXAMPLES / "fog.c", f"-I{ROOT / 'lib/runtime'}", "-o",
                        cls.at / "fog"], check=True)
        cls.programs = {"slv": [cls.at / "fog"],
                        "py": [sys.executable, "-B", EXAMPLES / "fog.py"]}
        if shutil.which("node"):
            cls.programs["mjs"] = ["node", EXAMPLES / "fog.mjs"]
        else:
            print("node is not here: fog.mjs is left out", file=sys.stderr)

    def bake(self, name, text):
        (self.at / "level.map").write_text(text, encoding="utf-8")
        level = self.at / name
        for command in (["bake", self.at / "level.map", "-o", f"{level}.slv", "--quiet"],
                        ["export", f"{level}.slv", "--format", "json", "-o", f"{level}.json"]):
            subprocess.run([PROGRAM, *command], check=True, stderr=subprocess.DEVNULL)
        return level

    def run_one(self, language, level, *arguments):
        file = f"{level}.slv" if language == "slv" else f"{level}.json"
        picture = self.at / f"{language}.svg"
        command = [*self.programs[language], file, picture, *arguments]
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              universal_newlines=True, check=False)

    def ask(self, level, eye, doors, limit, notes="", touching=False):
        """What all programs answer, which is the same."""
        answers = {}
        for language in self.programs:
            done = self.run_one(language, level, repr(eye[0]), repr(eye[1]), *doors)
            self.assertEqual((done.returncode, done.stderr), (0, notes))
            answers[language] = Answer(done.stdout, self.at / f"{language}.svg")
        of_c = answers["slv"]
        for language, answer in answers.items():
            where = f"{level.name}, {language}, eye {eye[0]!r} {eye[1]!r} {' '.join(doors)}"
            self.assertEqual(answer.cell, of_c.cell, where)
            self.assertEqual(answer.row, of_c.row, where)
            if touching:
                self.assertLessEqual(set(answer.seen), set(of_c.seen), where)
            else:
                self.assertEqual(answer.seen, of_c.seen, where)
            self.assertEqual(eye in answer.points, eye in of_c.points, where)
            self.assertTrue(same_corners(of_c.points, answer.points, limit), where)
            if not touching: # where cells meet, an eye stands in several, and sees by all their rows
                self.assertLessEqual(set(answer.seen), set(answer.row), where)
        return of_c

    def eyes(self, text, places):
        """Within the map, half of them near doors."""
        chance = random.Random(3)
        low_x, low_y, high_x, high_y = bounds_of(text)
        count = 0
        while count < EYES:
            x, y = chance.uniform(low_x, high_x), chance.uniform(low_y, high_y)
            if count % 2 and places:
                x0, y0, x1, y1 = places[count // 2 % len(places)]
                x, y = (x0 + x1) / 2 + chance.uniform(-4, 4), (y0 + y1) / 2 + chance.uniform(-4, 4)
            if low_x < x < high_x and low_y < y < high_y:
                count += 1
                yield x, y

    def test_mirrors_are_noted(self):
        """The programs see by no mirror, and say so."""
        level = self.bake("mirrors", (ROOT / "maps/effects/mirrors.map").read_text(encoding="utf-8"))
        answer = self.ask(level, (5.1, 25.03), [], 1e-8, "note: mirrors are walls here\n")
        self.assertLess(len(answer.seen), 4)

    def check_level(self, name):
        path, degrees, doors = LEVELS[name]
        text = (ROOT / path).read_text(encoding="utf-8")
        text += "".join(f"door {door} {' '.join(map(str, at))} {state}\n" for door, at, state in doors)
        text = "\n".join(turned(line, degrees) for line in text.splitlines()) + "\n"
        found = re.findall(r"^door (\S+) (.*) (?:open|shut)$", text, re.MULTILINE)
        places = [tuple(map(float, at.split())) for _, at in found]
        level = self.bake(name, text)
        names = sorted({door for door, _ in found})
        low_x, low_y, high_x, high_y = bounds_of(text)
        limit = 1e-9 * max(high_x - low_x, high_y - low_y)
        differ = 0
        for i, eye in enumerate(self.eyes(text, places)):
            states = [self.ask(level, eye, [word for n in names for word in (state, n)], limit)
                      for state in ("open", "shut")]
            self.assertLessEqual(set(states[1].row), set(states[0].row))
            differ += states[0].points != states[1].points
            if names and i == 0:
                mixed = [word for k, n in enumerate(names) for word in (["open", "shut"][k % 2], n)]
                self.ask(level, eye, mixed, limit)
                self.ask(level, eye, [], limit)
        self.assertEqual(differ > 0, bool(names), "doors make no difference")

    def test_doors(self):
        self.check_level("doors")

    def test_office(self):
        self.check_level("office")

    def test_doors_of_one_name(self):
        self.check_level("one name")

    def test_turned_chapel(self):
        self.check_level("chapel")

    def test_one_way_glass(self):
        self.check_level("glass")

    def check_borders(self, text, eyes, corners):
        """Eyes where tile collision puts players: each is in an open cell, and sees."""
        level = self.bake("borders", text)
        for i, eye in enumerate(eyes):
            answer = self.ask(level, eye, [("open", "shut")[i % 2], "gate"], 1e-8, touching=True)
            self.assertGreaterEqual(len(answer.points), corners, eye)

    def test_eyes_on_tiles_and_doors(self):
        """Sides and corners of tiles, and a door, in a room of 8 by 8 in rock."""
        tiles = ("sightline 1\nsolid 0 0 10 0 10 10 0 10\nopen 1 1 9 1 9 9 1 9\nsolid 3 3 4 3 4 4 3 4\n"
                 "solid 6 1 7 1 7 4 6 4\nsolid 6 5 7 5 7 9 6 9\ndoor gate 6.5 4 6.5 5 open\n")
        self.check_borders(tiles, [(3, 3), (6.5, 4.5), (6.5, 4.5), (4, 4), (3, 3.5), (3.5, 3), (6, 4), (9, 5),
                                   (5, 9)], 4)

    def test_eyes_on_slanted_rock(self):
        rock = ("sightline 1\nsolid 0 0 10 0 10 10 0 10\nopen 1 1 9 1 9 8 8 9 1 9\nsolid 3 3 5 3 4 5\n"
                "solid 6 1 7 1 7 4 6 4\nsolid 6 5 7 5 7 9 6 9\ndoor gate 6.5 4 6.5 5 open\n")
        self.check_borders(rock, [(3, 3), (6.5, 4.5), (6.5, 4.5), (4, 5), (3.5, 4), (8.5, 8.5)], 4)

    def test_wrong_use(self):
        level = self.bake("plain", (ROOT / "maps/effects/doors.map").read_text(encoding="utf-8"))
        ranged = self.bake("ranged", (ROOT / "maps/effects/range.map").read_text(encoding="utf-8"))
        for language in self.programs:
            wrong = [(level, "5", "5", "shut", "moon"), (level, "5", "5", "ajar", "west"),
                     (level, "500", "5"), (level, "5"), (self.at / "nothing", "5", "5")]
            if language != "slv":
                wrong.append((ranged, "5", "5"))
            for arguments in wrong:
                done = self.run_one(language, *arguments)
                self.assertEqual((done.returncode, done.stdout), (2, ""), (language, arguments))
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)


if __name__ == "__main__":
    PROGRAM = sandbox.program_argument()
    unittest.main()
