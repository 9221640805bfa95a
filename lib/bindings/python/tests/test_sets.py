"""Sight from lines and areas, against single eyes."""
import importlib.util
import unittest
import warnings

import numpy as np

import sightline
import support

warnings.simplefilter("ignore", sightline.SightlineWarning)


def area_of(loops):
    return sum(float(np.sum(loop[:, 0] * np.roll(loop[:, 1], -1) -
                            loop[:, 1] * np.roll(loop[:, 0], -1))) / 2 for loop in loops)


class Sets(unittest.TestCase):
    def setUp(self):
        self.plan = sightline.Plan.from_file(support.MAPS / "office.map")
        self.level = self.plan.space()

    def check(self, points, eyes, area):
        places = support.inside_points(self.level, 60, 1)
        by_eyes = self.level.can_see(eyes[:, None, :], places)
        some = self.level.seen_from(points, places, area=area)
        every = self.plan.seen_from(points, places, area=area, seen="all")
        self.assertTrue((some >= by_eyes.any(axis=0)).all() and (every <= by_eyes.all(axis=0)).all())
        self.assertLess((some != by_eyes.any(axis=0)).sum(), 3)
        loops = self.level.region_from(points, area=area, as_array=True)
        self.assertGreaterEqual(area_of(loops), area_of([self.level.region(eyes[0], as_array=True)]))
        within = self.plan.region_from(points, area=area, seen="all", as_array=True)
        self.assertLess(area_of(within), area_of(loops))

    def test_line(self):
        line = np.array([(8.0, 8.0), (50.0, 8.0)])
        self.check(line, line[0] + np.linspace(0, 1, 2000)[:, None] * (line[1] - line[0]), False)

    def test_area(self):
        corners = np.array([(31.0, 8.0), (33.0, 8.0), (33.0, 12.0), (31.0, 12.0)])
        weights = np.random.default_rng(3).dirichlet(np.ones(4), 4000)
        self.check(corners, weights @ corners, True)

    def test_range(self):
        hall = sightline.Plan.from_segments([(0, 0, 30, 0), (30, 0, 30, 20), (30, 20, 0, 20), (0, 20, 0, 0)])
        hall.range = 5
        line = [(10, 10), (16, 10)]
        area = area_of(hall.region_from(line, as_array=True))
        self.assertLess(area, 60 + 25 * np.pi)
        self.assertGreater(area, (60 + 25 * np.pi) * (1 - 1 / 128))
        seen = hall.seen_from(line, [(12, 15), (12, 15.001), (19, 14), (19, 14.001)])
        self.assertEqual(seen.tolist(), [True, False, True, False])

    def test_disc(self):
        hall = sightline.Plan.from_segments([(0, 0, 30, 0), (30, 0, 30, 20), (30, 20, 0, 20), (0, 20, 0, 0)])
        hall.range = 5
        area = area_of(hall.region_from((10, 10), radius=2, as_array=True))
        self.assertLess(area, 49 * np.pi)
        self.assertGreater(area, 48 * np.pi)
        self.assertEqual(hall.seen_from((10, 10), [(16.9, 10), (17.1, 10)], radius=2).tolist(), [True, False])
        self.assertEqual(hall.seen_from((10, 10), [(12.9, 10), (13.1, 10)], radius=2, seen="all").tolist(),
                         [True, False])
        with self.assertRaises(ValueError):
            hall.region_from([(1, 1), (2, 2)], radius=1)

    def test_shapes_of_shapely(self):
        if not importlib.util.find_spec("shapely"):
            self.skipTest("there is no shapely")
        shape = self.level.region_from([(8, 8), (50, 8)])
        loops = self.level.region_from([(8, 8), (50, 8)], as_array=True)
        self.assertTrue(shape.is_valid)
        self.assertAlmostEqual(shape.area, area_of(loops), places=6)

    def test_one_place(self):
        self.assertIs(self.level.seen_from([(8, 8), (50, 8)], (30, 8), seen="all"), True)

    def test_exposure(self):
        hall = sightline.Plan.from_segments([(0, 0, 20, 0), (20, 0, 20, 10), (20, 10, 0, 10), (0, 10, 0, 0),
                                             (0, 5, 9, 5), (11, 5, 20, 5)])
        path = [(2, 4), (18, 4)]
        seen = hall.exposure(path, {"line": [(10, 8), (12, 8)], "far": [(1, 5.1), (2, 5.1)]}, arrays=True)
        self.assertEqual(seen["name"].tolist(), ["line", "far"])
        np.testing.assert_allclose(seen["path_some"], [10 / 3, 0])
        np.testing.assert_allclose(seen["share"], [1, 0])
        self.assertAlmostEqual(seen["first"][0], 6)
        self.assertTrue(np.isnan(seen["first"][1]))
        room = hall.exposure(path, [[(0, 0), (20, 0), (20, 5), (0, 5)]], area=True, arrays=True)
        np.testing.assert_allclose([room["size"][0], room["seen"][0], room["path_all"][0]], [100, 100, 16])
        self.assertEqual(len(hall.exposure(path, [], arrays=True)["size"]), 0)
        for things, area in (([[(0, 0), (99, 0)]], False), ([[(1, 1), (9, 1), (4, 2), (1, 4)]], True), ([[]], False)):
            with self.assertRaises(ValueError):
                hall.exposure(path, things, area=area)

    def test_sees_within(self):
        level = self.level
        places = support.inside_points(level, 60, 5)
        for on_foot in (False, True):
            near = level.sees_within(places[:30], 0.5, places[30:], 0.5, on_foot=on_foot)
            self.assertTrue((near >= level.can_see(places[:30], places[30:])).all())
        some = level.sees_within(places[:30, None], 0, places[30:], 0)
        self.assertEqual(some.shape, (30, 30))
        self.assertTrue((some >= level.can_see(places[:30, None], places[30:])).all())
        self.assertLess(some.sum(), 900)
        with self.assertRaises(ValueError):
            level.sees_within((1, 1), -1, (2, 2), 0)

    def test_wrong_questions(self):
        with self.assertRaises(ValueError):
            self.level.region_from([(8, 8), (50, 8)], seen="most")
        with self.assertRaises(ValueError):
            self.level.region_from([(8, 8), (1e9, 8)])
        with self.assertRaises(ValueError):
            self.level.seen_from([(1, 1), (9, 1), (4, 2), (1, 9)], (3, 3), area=True)
        with self.assertRaises(ValueError):
            self.level.region_from([])
        self.assertEqual(len(self.level.seen_from([(8, 8)], np.empty((0, 2)))), 0)


if __name__ == "__main__":
    unittest.main()
