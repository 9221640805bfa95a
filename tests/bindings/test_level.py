"""The shared library sightline_level from other languages: test_level.py LIBRARY PROGRAM SOURCE

The examples of lib/bindings/level in LuaJIT, C#, Python and Godot print what lib/runtime/examples/fog.c
prints about the same levels, to the last digit; Godot, whose points are floats of 32 bits, to six of them. A
language whose program is not here is left out, with a message. For Godot the environment must name the folder
of its headers, GODOT_HEADERS: the repository godot-headers, branch 3.2.
"""
import ctypes
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

LEVELS = {
    "doors": ("maps/effects/doors.map", [(5.1, 5.03), (12.3, 7.1)], ["shut", "west", "open", "north-east"]),
    "office": ("maps/office.map", [(53, 20), (5, 3), (30.2, 11.1)], []),
    "chapel": ("maps/oblique/chapel.map", [(9.3, 12.1)], []),
}
TOOLS = {"Lua": ["luajit"], "C#": ["mcs", "mono"], "Python": [], "Godot": ["godot3-server"]}
# How many squares of a picture are as what is seen, the area of the polygon and the length of its outline.
PAINTED = """
import math, sys
sys.path.append(sys.argv[1])
import main, pygame
game, image = main.Game(sys.argv[2]), pygame.image.load(sys.argv[5])
seen = game.in_window(game.level.visible_polygon(float(sys.argv[3]), float(sys.argv[4])))
pairs = list(zip(seen, seen[1:] + seen[:1]))
print(sum(image.get_at((x, y))[:3] == (255, 237, 153) for x in range(main.SIZE[0]) for y in range(main.SIZE[1])),
      abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in pairs)) / 2, sum(map(math.dist, *zip(*pairs))))
"""
# Whether a picture has black squares in its lower half, and in its upper half.
BLACK = """
import sys, pygame
image = pygame.image.load(sys.argv[1])
width, height = image.get_size()
rows = [y for y in range(0, height, 2) for x in range(0, width, 2) if image.get_at((x, y))[:3] == (0, 0, 0)]
print(max(rows) > height / 2, min(rows) < height / 2)
"""
HEADERS = os.environ.get("GODOT_HEADERS")


def read(text):
    """The printed answer: numbers compared as numbers, for languages print the same double in two ways."""
    words = [line.split() for line in text.splitlines()]
    first = next((i for i, line in enumerate(words) if line[:1] == ["cell"]), 0) # after what an engine says of itself
    return [[word if i == 0 and word.isalpha() else float(word) for i, word in enumerate(line)]
            for line in words[first:]]


def are_alike(answer, wanted, limit):
    return [line[:1] if line[0] == "points" else len(line) for line in answer] == \
        [line[:1] if line[0] == "points" else len(line) for line in wanted] and \
        all(a == b or (isinstance(a, float) and abs(a - b) <= limit * max(1, abs(b)))
            for line, other in zip(answer, wanted) for a, b in zip(line, other))


class Level(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.at = pathlib.Path(folder.name)
        cls.environment = {**os.environ, "SIGHTLINE_LEVEL": str(LIBRARY), "LD_LIBRARY_PATH": str(LIBRARY.parent)}
        examples = SOURCE / "lib/bindings/level/examples"
        subprocess.run(["cc", "-std=c99", SOURCE / "lib/runtime/examples/fog.c", f"-I{SOURCE / 'lib/runtime'}",
                        "-o", cls.at / "fog"], check=True)
        cls.programs = {"Python": [sys.executable, "-B", examples / "seen.py"],
                        "Lua": ["luajit", "-e", f"package.path='{examples.parent}/?.lua'", examples / "seen.lua"],
                        "C#": ["mono", cls.at / "Seen.exe"],
                        "Godot": ["godot3-server", "--path", cls.at / "godot", "--script", "seen.gd"]}
        for language, tools in TOOLS.items():
            missing = [tool for tool in tools if not shutil.which(tool)]
            if missing:
                print(f"{', '.join(missing)} not here: {language} is left out", file=sys.stderr)
                del cls.programs[language]
        if not HEADERS and cls.programs.pop("Godot", None):
            print("GODOT_HEADERS names no folder: Godot is left out", file=sys.stderr)
        if "Godot" in cls.programs:
            shutil.copytree(examples / "godot", cls.at / "godot")
            subprocess.run(["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", cls.at / "godot/level.c",
                            f"-I{HEADERS}", f"-I{examples.parent}", f"-L{LIBRARY.parent}", "-lsightline_level",
                            "-o", cls.at / "godot/liblevel.so"], check=True)
        if "C#" in cls.programs:
            subprocess.run(["mcs", f"-out:{cls.at / 'Seen.exe'}", examples / "Seen.cs"], check=True)
            subprocess.run(["mcs", "-main:Picture", f"-out:{cls.at / 'Picture.exe'}", examples / "Picture.cs",
                            examples / "Seen.cs"], check=True)
            subprocess.run(["mcs", "-main:Calls", f"-out:{cls.at / 'Calls.exe'}", examples / "Seen.cs",
                            SOURCE / "tests/bindings/Calls.cs"], check=True)
        for name, (path, _, _) in LEVELS.items():
            subprocess.run([PROGRAM, "bake", SOURCE / path, "-o", cls.at / f"{name}.slv", "--quiet"], check=True)

    def run_one(self, command, *arguments):
        return subprocess.run([*command, *map(str, arguments)], env=self.environment, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, universal_newlines=True, check=False)

    def test_they_answer_alike(self):
        for name, (_, eyes, doors) in LEVELS.items():
            file = self.at / f"{name}.slv"
            for x, y in eyes:
                wanted = self.run_one([self.at / "fog"], file, self.at / "fog.svg", x, y, *doors)
                self.assertEqual(wanted.returncode, 0, wanted.stderr)
                self.assertGreater(len(read(wanted.stdout)), 6)
                for language, command in self.programs.items():
                    done = self.run_one(command, file, x, y, *doors)
                    self.assertEqual(done.returncode, 0, language)
                    if language != "Godot": # an engine says more
                        self.assertEqual(done.stderr, "", language)
                    self.assertTrue(are_alike(read(done.stdout), read(wanted.stdout), 1e-6 if language == "Godot" else 0),
                                    (language, name, x, y, done.stdout, wanted.stdout))

    def test_csharp_draws_what_is_seen(self):
        if "C#" not in self.programs:
            self.skipTest("no C#")
        picture = self.at / "seen.svg"
        for name, (_, eyes, _) in LEVELS.items():
            for eye in eyes:
                wanted = read(self.run_one([self.at / "fog"], self.at / f"{name}.slv", self.at / "fog.svg", *eye).stdout)
                done = self.run_one(["mono", self.at / "Picture.exe"], self.at / f"{name}.slv", *eye, picture)
                self.assertEqual(done.returncode, 0, done.stderr)
                found, = re.findall("fill='#ffed99' points='([^']*)'", picture.read_text())
                at = [number for line in wanted if len(line) == 2 and line[0] != "cell" and line[0] != "points" for number in line]
                self.assertEqual([float(number) for number in found.split()], at)
                self.assertIn("scale(1 -1)", picture.read_text())  # map text has y up

    def test_class_answers_as_c(self):
        if "C#" not in self.programs:
            self.skipTest("no C#")
        number, count = ctypes.c_double, ctypes.c_int32()
        library = ctypes.CDLL(str(LIBRARY))
        for name, result in (("open_file", ctypes.c_void_p), ("relevant", ctypes.POINTER(ctypes.c_ubyte)),
                             ("boxes_seen", ctypes.POINTER(ctypes.c_ubyte))):
            getattr(library, f"sl_level_{name}").restype = result
        level = ctypes.c_void_p(library.sl_level_open_file(str(self.at / "doors.slv").encode()))

        def call(name, *arguments):
            return getattr(library, f"sl_level_{name}")(
                level, *(number(a) if isinstance(a, float) else a for a in arguments))

        at = (number * 2)()
        eye = (5.1, 5.03)
        wanted = [bool(call("can_walk", *eye, 5.2, 5.03, -1)), bool(call("can_walk", *eye, 99., 5.03, -1)),
                  bool(call("walk", *eye, 99., 7., .25, -1, at)), *at]
        things = (number * 12)(5, 5, 5.5, 5.5, 12.3, 7.1, 12.5, 7.2, 90, 90, 91, 91)
        bits = call("relevant", (number * 8)(5, 5, 5.2, 5.2, 12.3, 7.1, 12.4, 7.2), 2, .25, things, 3)
        wanted += [bool(bits[p] >> t & 1) for p in range(2) for t in range(3)] + [2, 3, 0]
        self.assertGreater(len(set(wanted[-9:-3])), 1)
        self.assertGreater(call("settle", 0), 0)
        wanted.append(call("settle", 1000000))
        wanted.append(bool(call("set_box_count", 2)))
        call("move_box", 0, 5.3, 4.8, 5.4, 5.2, 1)
        call("move_box", 1, 5.6, 5., 5.7, 5.1, 0)
        seen = call("boxes_seen", *eye, 0., 360., 0., ctypes.byref(count))
        self.assertEqual(seen[:count.value], [1, 0])
        wanted += [bool(s) for s in seen[:2]] + [bool(call("can_walk", *eye, 5.5, 5.03, own)) for own in (-1, 0)]
        self.assertEqual(wanted[-2:], [False, True])
        library.sl_level_close(level)
        done = self.run_one(["mono", self.at / "Calls.exe"], self.at / "doors.slv")
        self.assertEqual(done.returncode, 0, done.stderr)
        words = [word == "True" if word in ("True", "False") else float(word) for word in done.stdout.split()]
        self.assertEqual(words, wanted)

    def test_pygame_paints_what_is_seen(self):
        python = ["/usr/bin/python3", "-B"]
        if self.run_one([*python, "-c", "import pygame"]).returncode:
            self.skipTest("no pygame")
        subprocess.run([PROGRAM, "bake", SOURCE / "maps/keep.tmx", "-o", self.at / "keep.slv", "--quiet"], check=True)
        folder, picture = SOURCE / "lib/bindings/level/examples/pygame", self.at / "seen.png"
        for eye in (100.3, 40.2), (200.7, 150.1):
            done = self.run_one([*python, folder / "main.py"], self.at / "keep.slv", *eye, picture)
            self.assertEqual(done.returncode, 0, done.stderr)
            done = self.run_one([*python, "-c", PAINTED, folder], self.at / "keep.slv", *eye, picture)
            self.assertEqual(done.returncode, 0, done.stderr)
            painted, area, outline = map(float, done.stdout.split()[-3:])
            self.assertGreater(area, 5000)
            self.assertLess(abs(painted - area), outline + 60)  # squares on the outline, and the eye

    def test_pictures_stand_upright(self):
        python = ["/usr/bin/python3", "-B"]
        if self.run_one([*python, "-c", "import pygame"]).returncode:
            self.skipTest("no pygame")
        examples, picture = SOURCE / "lib/bindings/level/examples", self.at / "upright.png"
        programs = {"pygame": [*python, examples / "pygame/main.py"]}
        if shutil.which("love") and shutil.which("xvfb-run"):
            programs["LÖVE"] = ["xvfb-run", "-a", "love", examples / "love"]
        else:
            print("love or xvfb-run not here: LÖVE is left out", file=sys.stderr)
        if "Godot" in self.programs and shutil.which("godot3-runner") and shutil.which("xvfb-run"):
            programs["Godot"] = ["xvfb-run", "-a", "-s", "-screen 0 1280x800x24", "godot3-runner", "--video-driver", "GLES2",
                                 "--audio-driver", "Dummy", "--path", self.at / "godot", "fog.tscn"]
        subprocess.run([PROGRAM, "bake", SOURCE / "maps/keep.tmx", "-o", self.at / "keep.slv", "--quiet"], check=True)
        # Map text has y up, Tiled y down. The eye is a black disc in the half of the window where it stands.
        for name, eye, is_low in (("doors", (5.1, 5.03), True), ("doors", (5.1, 16.2), False), ("keep", (100.3, 40.2), False)):
            for program, command in programs.items():
                if program == "Godot" and name != "keep":  # its example draws files that have y down
                    continue
                done = self.run_one(command, self.at / f"{name}.slv", *eye, picture)
                self.assertEqual(done.returncode, 0, done.stderr)
                done = self.run_one([*python, "-c", BLACK, picture])
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(done.stdout.split()[-2:], [str(is_low), str(not is_low)], (program, name, eye))

    def test_faults_are_told(self):
        broken = self.at / "broken.slv"
        broken.write_bytes((self.at / "doors.slv").read_bytes()[:-1])
        for language, command in self.programs.items():
            done = self.run_one(command, broken, 5, 5)
            self.assertNotEqual(done.returncode, 0, language)
            self.assertIn("cut short", done.stderr, language)
            done = self.run_one(command, self.at / "doors.slv", 5, 5, "shut", "moon")
            self.assertNotEqual(done.returncode, 0, language)
            self.assertIn("no door", done.stderr, language)

    def test_lua_takes_no_points_for_cells(self):
        if "Lua" not in self.programs:
            self.skipTest("no LuaJIT")
        command = [*self.programs["Lua"][:-1], "-e"]
        opened = f"level = require('sightline').open('{self.at / 'doors.slv'}') "
        done = self.run_one([*command, opened + "print(level:can_see(0, 0))"])
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "true\n", ""))
        done = self.run_one([*command, opened + "level:can_see(5.1, 5.03, 6, 6)"])
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("can_see takes two cells; sees takes two points", done.stderr)

    def test_lua_says_which_file(self):
        if "Lua" not in self.programs:
            self.skipTest("no LuaJIT")
        missing = self.at / "missing.slv"
        done = self.run_one([*self.programs["Lua"][:-1], "-e", f"assert(require('sightline').open('{missing}'))"])
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(f"{missing}: cannot be opened", done.stderr)


if __name__ == "__main__":
    LIBRARY, PROGRAM, SOURCE = map(pathlib.Path, sys.argv[1:4])
    unittest.main(argv=sys.argv[:1])
