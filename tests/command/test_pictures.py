"""Pictures as plans: what is solid, and that no doubt about it goes without a word.

test_pictures.py PROGRAM
"""
import struct
import zlib

import sandbox

WIDTH, HEIGHT = 200, 150


class Picture:
    """Pixels of grey and opacity."""

    def __init__(self, ground, opacity=255):
        self.grey = [[ground] * WIDTH for _ in range(HEIGHT)]
        self.alpha = [[opacity] * WIDTH for _ in range(HEIGHT)]

    def fill(self, x0, y0, x1, y1, grey, opacity=255):
        for y in range(y0, y1):
            self.grey[y][x0:x1] = [grey] * (x1 - x0)
            self.alpha[y][x0:x1] = [opacity] * (x1 - x0)
        return self

    def rooms(self, ink, thick=2, at=20):
        """Two rooms with a gap between."""
        right, lower, middle = WIDTH - at, HEIGHT - at, WIDTH // 2
        for box in ((at, at, right, at + thick), (at, lower - thick, right, lower), (at, at, at + thick, lower),
                    (right - thick, at, right, lower), (middle, at, middle + thick, 60),
                    (middle, 80, middle + thick, lower)):
            self.fill(*box, ink)
        return self

    def png(self):
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        rows = b"".join(b"\0" + bytes(v for pixel in zip(grey, alpha) for v in pixel)
                        for grey, alpha in zip(self.grey, self.alpha))
        return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 4, 0, 0, 0))
                + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Pictures(sandbox.ProgramTest):
    def converted(self, picture, *options):
        """The walls, and what is said."""
        self.box.path("a.png").write_bytes(picture.png() if isinstance(picture, Picture) else picture)
        result = self.box.run(["convert", "a.png", *options])
        self.assertEqual(result.status, 0, result.text())
        return sorted(line for line in result.stdout.splitlines() if line[:1] != "#"), result.stderr

    def assert_same(self, picture, *options, as_options=()):
        """The same walls as those of dark lines on white."""
        walls, said = self.converted(picture, *options)
        self.assertEqual(walls, self.converted(Picture(255).rooms(0), *as_options)[0])
        return said

    def test_dark_lines(self):
        said = self.assert_same(Picture(255).rooms(0))
        self.assertEqual(said.count("a.png"), 1, said)
        self.assertIn("(darkness from 0.5); 16 walls; --layers light takes the light ones", said)

    def test_light_lines(self):
        said = self.assert_same(Picture(20).rooms(235))
        self.assertIn("(light on a dark ground: lightness from 0.5)", said)
        self.assertIn("--layers dark takes the dark ones", said)
        self.assertNotIn("--layers", self.assert_same(Picture(20).rooms(235), "--layers", "light"))
        self.assertNotEqual(self.converted(Picture(20).rooms(235), "--layers", "dark")[0],
                            self.converted(Picture(255).rooms(0))[0])

    def test_rock_stays_rock(self):
        """Light rooms in dark rock are no lines."""
        rock = Picture(0).fill(20, 20, 80, 90, 255).fill(80, 50, 120, 56, 255).fill(120, 30, 180, 130, 255)
        walls, said = self.converted(rock)
        self.assertIn("(darkness from 0.5)", said)
        self.assertEqual(walls, self.converted(rock, "--layers", "dark")[0])

    def test_transparent_ground(self):
        for grey in (255, 0):
            said = self.assert_same(Picture(grey, 0).rooms(255))
            self.assertIn("opaque on a transparent ground: opacity from 0.5", said)
        self.assert_same(Picture(0, 0).rooms(0))
        self.assert_same(Picture(0, 0).rooms(128), "--layers", "opaque")
        # Opaque floors are no walls.
        said = self.assert_same(Picture(0, 0).fill(20, 20, WIDTH - 20, HEIGHT - 20, 255).rooms(0))
        self.assertIn("(darkness from 0.5)", said)

    def test_faint_lines(self):
        said = self.assert_same(Picture(255).rooms(180))
        self.assertIn("(darkness from 0.15, as the lines are faint)", said)
        self.assertIn("no pixel is solid", self.converted(Picture(255).rooms(180), "--threshold", "0.5")[1])
        self.assert_same(Picture(30).rooms(90))  # faint and light

    def test_grey_beside_black(self):
        furniture = Picture(255).rooms(0).fill(40, 40, 60, 42, 150)
        said = self.assert_same(furniture)
        self.assertIn("40 grey pixels (darkness about 0.41) are open; if walls are among them: --threshold 0.21",
                      said)
        walls, _ = self.converted(furniture, "--threshold", "0.21")
        self.assertEqual(len(walls), len(self.converted(Picture(255).rooms(0))[0]) + 1)  # an outline
        # Soft edges of lines are not lost.
        soft = Picture(255).rooms(150, 3, 19).rooms(0)
        self.assertNotIn("grey", self.assert_same(soft))

    def test_small_pieces(self):
        lettering = Picture(255).rooms(0)
        for x in (40, 48, 56):
            lettering.fill(x, 40, x + 1, 46, 0).fill(x, 40, x + 4, 41, 0)
        walls, said = self.converted(lettering)
        self.assertIn("3 small pieces of up to 4 x 6 pixels touch nothing", said)
        self.assertEqual(len(walls), len(self.converted(Picture(255).rooms(0))[0]) + 3)
        self.assertIn("left out", self.assert_same(lettering, "--layers", "large"))
        # Pixels that meet at a corner are of one piece.
        self.assertNotIn("small", self.converted(Picture(255).rooms(0).fill(22, 22, 24, 24, 0))[1])

    def test_photograph(self):
        noise = Picture(255)
        state = 1
        for row in noise.grey:
            for x in range(WIDTH):
                state = state * 1103515245 + 12345 & 0x7fffffff
                row[x] = state >> 16 & 255
        said = self.converted(noise)[1]
        self.assertRegex(said, r"a\.png: \d+ % of the pixels are neither ground nor lines: a photograph or a map")

    def test_nothing(self):
        for grey in (255, 0):
            self.converted(Picture(grey))
            self.converted(Picture(grey, 0))
        self.assertIn("no pixel is solid: --threshold T", self.converted(Picture(255))[1])
        for text in (b"P1 1 1 1", b"P1 1 1 0", b"P1 1 9 010101010", b"P1 9 1 010101010"):
            self.converted(text)

    def test_wrong_layers(self):
        self.box.path("a.png").write_bytes(Picture(255).rooms(0).png())
        for layers, message in (("walls", "there is no layer 'walls' in the file; it has dark, light, opaque, large"),
                                ("dark,light", "one of dark, light and opaque is solid")):
            result = self.box.run(["convert", "a.png", "--layers", layers])
            self.assertEqual(result.status, 2, result.text())
            self.assertIn(message, result.stderr)

    def test_unknown_ground_of_ros(self):
        """map_server: occupied above one threshold, free below the other, else unknown."""
        self.box.path("m.pgm").write_text("P2 3 1 255 0 205 254")
        for keys, said in (("", "; unknown ground is solid: --threshold 0.65 takes it as free"),
                           ("occupied_thresh: 0.7\n", "; unknown ground is solid: --threshold 0.7 takes"),
                           ("mode: scale\n", "; partly occupied ground is solid: --threshold 0.65 takes"),
                           ("free_thresh: 0.25\n", "m.yaml: 33.3 % of the picture has the grey that map savers write for"),
                           ("occupied_thresh: 0.19\n", None)):
            self.box.path("m.yaml").write_text("image: m.pgm\nresolution: 0.5\n" + keys)
            text = self.box.run(["convert", "m.yaml"]).stderr
            self.assertIn(said or "walls\n", text, keys)
            if not said:
                self.assertNotIn("ground", text)


if __name__ == "__main__":
    sandbox.main()
