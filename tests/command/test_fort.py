"""The small game of lib/runtime/examples, played by keys without a window.

test_fort.py PROGRAM

A wall hides the player from a guard until he breaks it, a wall that he builds stops him, a gate opens and shuts. Without SDL2 or a compiler it is skipped.
"""
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "lib/runtime/examples/fort.c"
WARNINGS = ["-std=c99", "-pedantic-errors", "-Wall", "-Wextra", "-Wshadow", "-Wconversion", "-Werror"]
TO_WALL = 13 * "d"          # to the wall named plaster, at x = 8
ROUND = 420 * "."           # a guard of the keep is back: 12 units of the map, by 0.06


def setUpModule():
    if not shutil.which("cc") or not shutil.which("sdl2-config"):
        raise unittest.SkipTest("no compiler or no SDL2 is here")


class Fort(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.at = pathlib.Path(folder.name)
        flags = subprocess.run(["sdl2-config", "--cflags", "--libs"], check=True, stdout=subprocess.PIPE,
                               universal_newlines=True).stdout.split()
        subprocess.run(["cc", *WARNINGS, EXAMPLE, f"-I{ROOT / 'lib/runtime'}", *flags, "-lm", "-o",
                        cls.at / "fort"], check=True)
        subprocess.run([PROGRAM, "bake", ROOT / "maps/effects/fort.map", "-o", cls.at / "fort.slv", "--quiet"],
                       check=True)

    def play(self, keys):
        """What happens, the place at the end, the tiles explored, and the picture."""
        picture = self.at / "fort.bmp"
        said = subprocess.run([self.at / "fort", self.at / "fort.slv", keys, picture], check=True,
                              stdout=subprocess.PIPE, universal_newlines=True,
                              env={**os.environ, "SDL_VIDEODRIVER": "dummy"}).stdout.splitlines()
        end = re.fullmatch(r"(\d+) frames, at (\S+) (\S+), (\d+) of (\d+) tiles explored, (\d+) rows unsettled",
                           said.pop())
        frames, explored, tiles, unsettled = (int(end[i]) for i in (1, 4, 5, 6))
        self.assertEqual((frames, tiles, unsettled), (len(keys), 96 * 64, 0))
        events = [re.fullmatch(r"frame (\d+): (.*)", line).groups() for line in said]
        return [(int(frame), what) for frame, what in events], (float(end[2]), float(end[3])), explored, \
            picture.read_bytes()

    def test_a_guard_sees_through_a_broken_wall_and_not_before(self):
        before, place, explored, _ = self.play(TO_WALL + ROUND)
        self.assertEqual(before, [])
        self.assertAlmostEqual(place[0], 6.95)
        events, _, more, _ = self.play(TO_WALL + ROUND + "e" + ROUND)
        broken = len(TO_WALL + ROUND) + 1
        self.assertEqual(events[0], (broken, "plaster breaks"))
        self.assertEqual([what for _, what in events[1:]], ["guard 0 sees you"])
        self.assertGreater(more, explored)

    def test_what_is_broken_stays_broken(self):
        events, _, _, _ = self.play(TO_WALL + "e...e..e" + 9 * "d" + "ee")
        self.assertEqual([what for _, what in events if "plaster" in what], ["plaster breaks"])

    def test_what_is_built_stops_and_stays(self):
        events, place, _, _ = self.play(6 * "a" + "e" + 30 * "a" + "eee")
        self.assertEqual(events, [(7, "palisade is built")])
        self.assertAlmostEqual(place[0], 3.3, 6)      # one radius off
        _, place, _, _ = self.play(36 * "a")
        self.assertAlmostEqual(place[0], 0.3, 6)      # nothing was built: up to the outer wall

    def test_a_gate_opens_and_shuts(self):
        to_gate = 36 * "s" + 54 * "d"                 # below the keep
        events, _, _, _ = self.play(to_gate + "e" + "." + "e")
        self.assertEqual([what for _, what in events if "gate" in what], ["gate opens", "gate shuts"])

    def test_fog_stays(self):
        away = 13 * "a"
        _, _, near, _ = self.play(TO_WALL)
        _, place, later, _ = self.play(TO_WALL + away)
        self.assertAlmostEqual(place[0], 5)
        self.assertGreaterEqual(later, near)

    def test_the_picture_has_fog_and_light(self):
        _, _, explored, picture = self.play(TO_WALL + "e" + 10 * ".")
        start, = struct.unpack("<I", picture[10:14])
        width, height = struct.unpack("<ii", picture[18:26])
        depth, = struct.unpack("<H", picture[28:30])
        self.assertEqual((width, abs(height)), (24 * 36, 16 * 36))
        size = depth // 8
        pixels = [picture[i:i + 3] for i in range(start, len(picture) - size + 1, size)]
        black = sum(pixel == b"\0\0\0" for pixel in pixels) / len(pixels)
        self.assertAlmostEqual(black, 1 - explored / (96 * 64), delta=0.02)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
