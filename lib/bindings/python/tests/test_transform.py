"""Places in other coordinates, with y down."""
import pathlib
import tempfile
import unittest
import warnings

import numpy as np

import sightline
import support

warnings.simplefilter("ignore", sightline.SightlineWarning)
OLD = support.ROOT / "tests/old_files/effects.slv"


class Transforms(unittest.TestCase):
    def test_a_file_keeps_it(self):
        plan = sightline.Plan.from_file(support.MAPS / "keep.tmx")
        wanted = sightline.Transform((0, 272), 1, True)
        level = plan.bake()
        with tempfile.TemporaryDirectory() as folder:
            level.save(pathlib.Path(folder) / "keep.slv")
            opened = sightline.Level.open(pathlib.Path(folder) / "keep.slv")
            for handle in plan, level, opened:
                self.assertEqual(handle.transform, wanted)

    def test_what_has_none(self):
        self.assertIsNone(sightline.Plan.from_segments(support.TWO_ROOMS).transform)
        self.assertIsNone(sightline.Level.open(OLD).transform)
        self.assertEqual(sightline.Plan.from_file(support.MAPS / "flat.map").transform, sightline.Transform())

    def test_a_file_of_pixels(self):
        """A wall of a drawing comes back as it stands in the file."""
        wall = [30, 20, 50, 25]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "drawing.svg"
            path.write_text('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 -5 99 75">'
                            '<path d="M30 20L50 25"/></svg>')
            plan = sightline.Plan.from_file(path)
            back = plan.transform.from_map(plan.walls.reshape(-1, 2, 2)).reshape(-1, 4)
            self.assertIn(wall, back.tolist())

    def test_places_come_back(self):
        rng = np.random.default_rng(3)
        for scale in 0.25, 1, 16:
            for y_down in False, True:
                turn = sightline.Transform(tuple(rng.integers(-99, 99, 2).tolist()), scale, y_down)
                points = rng.integers(-1000, 1000, (50, 4, 2)).astype(float)
                there = turn.from_map(points)
                np.testing.assert_array_equal(turn.to_map(there), points)
                np.testing.assert_array_equal(there[..., 0], scale * (points[..., 0] - turn.origin[0]))
                away = points[..., 1] - turn.origin[1]
                np.testing.assert_array_equal(there[..., 1], scale * (-away if y_down else away))

    def test_a_region_on_the_screen(self):
        """It goes counter-clockwise as it is seen; a start looks the same way."""
        level = sightline.Plan.from_segments(support.TWO_ROOMS).bake()
        turn = sightline.Transform((0, 4), 8, True)
        region = level.region(turn.to_map((8, 24)), as_array=True)
        x, y = turn.from_map(region).T
        area = np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2
        self.assertLess(area, 0)
        self.assertAlmostEqual(-area, 64 * level.isovists([(1, 1)], arrays=True)["area"][0], places=9)
        eye, heading = turn.to_map((8, 24)), turn.heading(-45)
        self.assertEqual(level.look(eye, heading, 60).tolist(), level.look((1, 1), 45, 60).tolist())

    def test_what_is_wrong(self):
        for wrong in ({"scale": 0}, {"scale": -1}, {"scale": np.inf}, {"origin": (1,)}, {"origin": (1, np.nan)}):
            with self.assertRaises(ValueError, msg=str(wrong)):
                sightline.Transform(**wrong)
        for wrong in ({"scale": "2"}, {"y_down": 1}, {"origin": "ab"}):
            with self.assertRaises(TypeError, msg=str(wrong)):
                sightline.Transform(**wrong)
        with self.assertRaises(ValueError):
            sightline.Transform().to_map([1, 2, 3])


if __name__ == "__main__":
    unittest.main()
