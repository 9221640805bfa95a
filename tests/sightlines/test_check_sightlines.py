"""check_sightlines finds nothing lost on our own maps, and what is lost where something is.

test_check_sightlines.py SIGHTLINE CHECK MAPS
"""
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

import turned

WITHOUT = ["--without", "door,mirror,oneway,range"]


def wad(reject):
    """Two rooms with a doorway between them: sectors 0, 1 (the doorway) and 2."""
    vertices = [(0, 0), (0, 64), (64, 64), (64, 40), (72, 40), (72, 64), (136, 64), (136, 0),
                (72, 0), (72, 24), (64, 24), (64, 0)]
    sides = [0, 0, 0, 1, 2, 2, 2, 2, 2, 1, 0, 0]
    lines = [(i, (i + 1) % 12, 1, 0, 0, side, 0xffff) for i, side in enumerate(sides)]
    lines += [(3, 10, 4, 0, 0, 0, 1), (9, 4, 4, 0, 0, 2, 1)]
    sector = struct.pack("<hh18xhH", 0, 128, 0, 0)
    lumps = [("MAP01", b""), ("THINGS", struct.pack("<5h", 32, 32, 90, 1, 7)),
             ("LINEDEFS", b"".join(struct.pack("<7H", *line) for line in lines)),
             ("SIDEDEFS", b"".join(struct.pack("<28xH", side) for side in (0, 1, 2))),
             ("VERTEXES", b"".join(struct.pack("<hh", *vertex) for vertex in vertices)),
             ("SECTORS", 3 * sector), ("REJECT", reject)]
    body, directory = b"", b""
    for name, lump in lumps:
        directory += struct.pack("<II8s", 12 + len(body), len(lump), name.encode())
        body += lump
    return struct.pack("<4sII", b"PWAD", len(lumps), 12 + len(body)) + body + directory


class CheckSightlines(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sightline-lost-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def bake(self, path, *options):
        baked = self.folder / "map.slv"
        subprocess.run([SIGHTLINE, "bake", path, "-o", baked, "-q", *WITHOUT, *options], check=True)
        return baked

    def check(self, path, *options, count=20000):
        done = subprocess.run([CHECK, path, "--count", str(count), *options],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        names, values = (line.split(",") for line in done.stdout.splitlines())
        return done.returncode, dict(zip(names, map(int, values)))

    def test_own_maps(self):
        paths = sorted([*MAPS.glob("*.map"), *MAPS.glob("*.txt")])
        self.assertTrue(paths)
        for path in paths:
            with self.subTest(path=path.name):
                status, result = self.check(path, "--slv", self.bake(path))
                self.assertEqual((status, result["lost"]), (0, 0))
                self.assertEqual(result["checked"], 20000)

    def test_wall_too_many(self):
        """A file baked from a map with one wall more has lost what that wall hides."""
        room = "sightline 1\nwalls 0 0 9 0 9 9 0 9 0 0\nwall 3 0 3 4\n"
        (self.folder / "room.map").write_text(room)
        (self.folder / "more.map").write_text(room + "wall 6 0 6 9\n")
        baked = self.bake(self.folder / "more.map")
        status, result = self.check(self.folder / "room.map", "--slv", baked)
        self.assertEqual(status, 1)
        self.assertGreater(result["lost"], 0)

    def test_reject(self):
        path = self.folder / "rooms.wad"
        for reject, hidden, lost in ((b"\0\0", 0, 0), (b"", 0, 0), (b"\x44\0", 2, 1),
                                     (b"\x40\0", 1, 1), (b"\x11\1", 0, 3)):
            with self.subTest(reject=reject):
                path.write_bytes(wad(reject))
                status, result = self.check(path, "--map", "map01", "--reject", path)
                self.assertEqual((result["hidden_pairs"], result["lost_pairs"]), (hidden, lost))
                self.assertEqual(status, int(lost > 0))

    def test_turned_places(self):
        """turned.py turns all that has a place, and an open polygon with the walls in it."""
        told = ["walls 0 0 8 0 8 6", "wall 4 0 4 3 solid", "solid 1 1 2 1 2 2",
                "open 0 0 8 0 8 6 0 6", "door front 4 3 4 6 open", "mirror 8 1 8 2 one", "oneway 0 1 0 2",
                "seam 0 0 4 3", "start 1 5 90"]
        wanted = ["walls 10.0 10.0 18.0 10.0 18.0 16.0", "wall 14.0 10.0 14.0 13.0 solid",
                  "solid 11.0 11.0 12.0 11.0 12.0 12.0",
                  "open 10.0 10.0 18.0 10.0 18.0 16.0 10.0 16.0",
                  "door front 14.0 13.0 14.0 16.0 open", "mirror 18.0 11.0 18.0 12.0 one",
                  "oneway 10.0 11.0 10.0 12.0", "seam 10.0 10.0 14.0 13.0", "start 11.0 15.0 90"]
        self.assertEqual(list(turned.turned("\n".join(told), 0, 10)), wanted)
        text = ["sightline 1", "open 0 0 8 0 8 6 0 6", "wall 4 0 4 3", "start 1 5 0"]
        path = self.folder / "open.map"
        path.write_text("\n".join(turned.turned("\n".join(text), 33, 0)) + "\n")
        status, result = self.check(path, "--slv", self.bake(path), count=2000)
        self.assertEqual((status, result["lost"]), (0, 0))


if __name__ == "__main__":
    SIGHTLINE, CHECK, MAPS = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    unittest.main(argv=sys.argv[:1])
