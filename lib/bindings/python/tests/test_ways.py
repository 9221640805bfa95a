"""Shortest ways and distances, against straight lines, and against each other."""
import math
import unittest

import numpy as np

import sightline
import support

ROOMS = [(0, 0, 10, 0), (10, 0, 10, 10), (10, 10, 0, 10), (0, 10, 0, 0), (5, 0, 5, 4), (5, 6, 5, 10)]


class Ways(unittest.TestCase):
    def setUp(self):
        self.plan = sightline.Plan.from_segments(ROOMS)
        self.plan.add_door("front", (5, 4, 5, 6), is_open=False)

    def test_doors(self):
        shut = self.plan.path((2, 5), (8, 5))
        self.assertEqual((shut.length, shut.points.shape), (math.inf, (0, 2)))
        self.assertEqual(self.plan.path((2, 5), (8, 5), loss=4).length, 10)
        level = self.plan.space()
        level.doors["front"] = True
        way = level.path((2, 5), (8, 5), loss=4)
        self.assertEqual((way.length, way.points.tolist()), (6, [[2, 5], [8, 5]]))

    def test_distances(self):
        level = self.plan.space()
        there = level.locate((8, 5))
        self.assertEqual(level.distances((2, 5), arrays=True)["distance"][there], math.inf)
        far = level.distances((2, 5), loss=4, arrays=True)
        self.assertEqual([float(far[name][there]) for name in ("distance", "x", "y")], [7, 5, 5])
        near = level.distances((2, 5), loss=4, limit=6.5, arrays=True)
        self.assertEqual(near["distance"][there], math.inf)
        self.assertTrue(np.isnan(near["x"][there]))

    def test_office(self):
        level = sightline.Plan.from_file(support.MAPS / "office.map").space()
        places = support.inside_points(level, 40, 2)
        far = level.distances(places[0], loss=3, arrays=True)["distance"][level.locate(places)]
        for place, least in zip(places, far):
            length = level.path(places[0], place, loss=3).length
            self.assertGreaterEqual(length, least - 1e-9)
            self.assertGreaterEqual(length, np.hypot(*(place - places[0])) - 1e-9)

    def test_places(self):
        plan = sightline.Plan.from_file(support.MAPS / "office.map")
        places = support.inside_points(plan.space(), 40, 3)
        far = plan.distances_to(places[0], places, arrays=True)
        for place, length, *root in zip(places, far["distance"], far["root_x"], far["root_y"]):
            way = plan.path(places[0], place)
            self.assertAlmostEqual(way.length, length, places=9)
            self.assertEqual(root, way.points[-2 if length else 0].tolist())
        shut = self.plan.distances_to((2, 5), [(8, 5), (2, 7)], limit=3, arrays=True)
        self.assertEqual(shut["distance"].tolist(), [math.inf, 2])
        self.assertTrue(np.isnan(shut["root_x"][0]))

    def test_refusals(self):
        for ask in (lambda: self.plan.path((2, 5), (12, 5)), lambda: self.plan.distances((12, 5)),
                    lambda: self.plan.path((2, 5), (8, 5), loss=-1), lambda: self.plan.distances((2, 5), limit=-1),
                    lambda: self.plan.distances([(2, 5), (3, 5)])):
            with self.assertRaises(ValueError):
                ask()


if __name__ == "__main__":
    unittest.main()
