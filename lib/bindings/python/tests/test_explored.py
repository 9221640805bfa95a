"""Explored areas: unions against counted squares, saved and read."""
import unittest
import warnings

import numpy as np

import sightline
import support

warnings.simplefilter("ignore", sightline.SightlineWarning)


def square(x, y, size=1):
    return np.array([(x, y), (x + size, y), (x + size, y + size), (x, y + size)], float)


class ExploredAreas(unittest.TestCase):
    def test_squares_of_a_grid(self):
        random = np.random.default_rng(3)
        for resolution in (0, 0.25):
            explored, seen = sightline.Explored(resolution), np.zeros((12, 12), bool)
            for _ in range(60):
                x, y = random.integers(0, 10, 2)
                explored.add(square(x, y, 2))
                seen[x:x + 2, y:y + 2] = True
            self.assertEqual(explored.area, seen.sum())
            middles = np.stack(np.meshgrid(np.arange(12), np.arange(12), indexing="ij"), -1) + 0.5
            self.assertTrue((explored.holds(middles) == seen).all())
            again = sightline.Explored.from_text(explored.to_text())
            self.assertEqual(again.to_text(), explored.to_text())
            for here, there in zip(again.outline(as_arrays=True), explored.outline(as_arrays=True)):
                self.assertTrue((here == there).all())

    def test_holes_and_what_a_level_sees(self):
        explored = sightline.Explored()
        self.assertEqual((explored.area, explored.outline()), (0, []))
        explored.add([square(0, 0, 4), square(1, 1)[::-1]])
        self.assertEqual(explored.area, 15)
        self.assertFalse(explored.holds((1.5, 1.5)))
        self.assertTrue(explored.holds((1, 1)))
        space = sightline.Plan.from_segments(support.TWO_ROOMS).space()
        seen = sightline.Explored()
        for eye in ((1, 1), (7, 1)):
            seen.add(space.region(eye))
            seen.add(space.region(eye, as_array=True))
        self.assertGreater(seen.area, 16)
        self.assertTrue(seen.holds([(1, 1), (7, 1)]).all())

    def test_what_is_refused(self):
        with self.assertRaises(ValueError):
            sightline.Explored(-1)
        with self.assertRaises(sightline.BadInput):
            sightline.Explored.from_text("sightline-explored 1\nresolution x\n", "fog.txt")
        with self.assertRaises(ValueError):
            sightline.Explored().add([(1, 2, 3)])


if __name__ == "__main__":
    unittest.main()
