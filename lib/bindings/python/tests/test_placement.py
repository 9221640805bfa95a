"""Viewpoints: what they see together, and the fewest that see everything."""
import json
import os
import tempfile
import time
import unittest

import numpy as np

import sightline
import support
from test_tables import need, without

# A comb: each tooth needs a viewpoint of its own.
COMB = [(0, 0), (12, 0), (12, 9), (11, 9), (10, 1), (7, 1), (6.5, 9), (5.5, 9), (5, 1), (2, 1), (1, 9), (0, 9)]


class Coverage(unittest.TestCase):
    def setUp(self):
        self.plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        self.plan.add_door("gap", (4, 3, 4, 4))

    def test_areas_are_those_of_regions(self):
        level = self.plan.space()
        points = [(1, 1), (7, 1), (2, 3.5)]
        seen = level.cover(points)
        np.testing.assert_allclose(seen.areas.sum(), 32)
        areas = np.asarray(level.isovists(points, arrays=True)["area"])
        np.testing.assert_allclose(seen.viewpoints["seen"], areas)
        # By hand: random places are in the piece that says how many see them.
        places = support.inside_points(level, 400, 3)
        count = sum(np.asarray(level.can_see(point, places), int) for point in points)
        pieces = seen.pieces(arrays=True)
        checked = 0
        for place, wanted in zip(places, count):
            for corners, got in zip(pieces["polygon"], pieces["count"]):
                ahead = np.roll(corners, -1, axis=0) - corners
                side = ahead[:, 0] * (place[1] - corners[:, 1]) - ahead[:, 1] * (place[0] - corners[:, 0])
                if (side > 0).all():
                    self.assertEqual(got, wanted, place)
                    checked += 1
        self.assertGreater(checked, 0.9 * len(places))

    def test_doors_count_as_they_are(self):
        self.assertEqual(self.plan.cover([(4, 3.5)]).areas[0], 0)
        level = self.plan.space()
        level.doors["gap"] = False
        shut = level.cover([(2, 2)])
        np.testing.assert_allclose(shut.areas, [16, 16, 0, 0])
        self.assertAlmostEqual(np.asarray(shut.blind_spots["area"])[0], 16)
        self.assertEqual(shut.share, 0.5)

    def test_all_forms_of_a_table_are_the_same(self):
        rows = [{"name": 'the "first", ü', "x": 1, "y": 1, "heading": 30, "fov": 60, "range": 2.5},
                {"x": 7.1, "y": 1 / 3}]
        plain = self.plan.cover(rows, fov=90, arrays=True)
        self.assertEqual(plain.viewpoints["name"].tolist(), ['the "first", ü', ""])
        self.assertEqual(plain.viewpoints["fov"].tolist(), [60, 90])
        self.assertEqual(plain.viewpoints["y"].tolist(), [1, 1 / 3])
        columns = {"x": [1, 7.1], "y": [1, 1 / 3], "heading": [30, None], "fov": [60, np.nan],
                   "range": [2.5, None], "name": [rows[0]["name"], None], "colour": [1, 2]}
        forms = [{k: np.array(v, object) for k, v in columns.items()}]
        try:
            forms.append(need("pandas").DataFrame(columns))
        except unittest.SkipTest:
            pass
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "cameras.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write('name,x,y,heading,fov,range\n"the ""first"", ü",1,1,30,60,2.5\n'
                           f",7.1,{1 / 3!r},,,\n")
            for form in [*forms, path]:
                again = self.plan.cover(form, fov=90, arrays=True)
                for name, column in plain.viewpoints.items():
                    np.testing.assert_array_equal(again.viewpoints[name], column, name)
                np.testing.assert_array_equal(again.areas, plain.areas)

    def test_a_tilted_camera_has_a_dead_zone(self):
        table = self.plan.cover([{"x": 2, "y": 2, "fov": 60, "height": 1, "tilt": 60}], arrays=True).viewpoints
        self.assertGreater(table["nearest"][0], 0)
        self.assertGreater(table["range"][0], table["nearest"][0])

    def test_signs_and_a_path(self):
        hall = sightline.Plan.from_segments([(0, 0, 40, 0), (40, 0, 40, 20), (40, 20, 0, 20), (0, 20, 0, 0)])
        rows = [{"x": 0, "y": 10, "letters": 0.08}, {"x": 28, "y": 10, "sign": 1, "range": 6}]
        seen = hall.cover(rows, path=[(1, 10), (39, 10), (39, 19)], arrays=True)
        self.assertEqual(seen.viewpoints["sign"].tolist(), [True, True])
        self.assertEqual(seen.viewpoints["range"].tolist(), [8, 6])
        np.testing.assert_allclose(seen.viewpoints["seen"], [np.pi * 16, np.pi * 9], rtol=2e-4)
        np.testing.assert_allclose(seen.unseen["from"], [7, 33])
        np.testing.assert_allclose(seen.unseen["to"], [27, 47])
        np.testing.assert_allclose(seen.unseen["to_x"], [28, 39])
        again = hall.cover([(0, 10)], signs=True, range=8, arrays=True)
        self.assertIsNone(again.unseen)
        self.assertEqual(again.viewpoints["seen"][0], seen.viewpoints["seen"][0])
        with self.assertRaisesRegex(sightline.BadInput, "a sign needs letters"):
            hall.cover([(0, 10)], signs=True)
        with self.assertRaisesRegex(ValueError, "point 2 of the path"):
            hall.cover([(2, 10)], path=[(1, 10), (50, 10)])

    def test_what_is_no_table_is_refused(self):
        for given, kind, words in (
                ([], ValueError, "no viewpoint"), ([(1, 2, 3)], ValueError, "viewpoints"),
                ({"x": [1]}, ValueError, "columns x and y"),
                ([{"x": 1, "y": 1, "zoom": 2}], ValueError, "zoom"),
                ([{"x": 1, "y": 1, "fov": 400}], sightline.BadInput, "viewpoints:2"),
                ([{"x": 1, "y": None}], sightline.BadInput, "viewpoints:2"),
                ("/no/such/file.csv", FileNotFoundError, "file.csv")):
            with self.assertRaisesRegex(kind, words):
                self.plan.cover(given)
        with self.assertRaisesRegex(ValueError, "fov"):
            self.plan.cover([(1, 1)], fov=0)

    def test_tables_and_pictures(self):
        geopandas = need("geopandas")
        seen = self.plan.cover([(1, 1), (7, 1)])
        pieces = seen.pieces()
        self.assertIsInstance(pieces, geopandas.GeoDataFrame)
        for count in range(3):
            area = pieces.geometry.area[pieces["count"] == count].sum()
            self.assertAlmostEqual(area, seen.areas[count])
        self.assertEqual(len(seen.plot().collections), len(self.plan.plot().collections) + 1)
        with without("pandas", "geopandas", "shapely.geometry"):
            self.assertIsInstance(self.plan.cover([(1, 1)]).pieces(), dict)


class Placement(unittest.TestCase):
    def comb(self, degrees=0.0):
        turn = np.radians(degrees)
        matrix = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        plan = sightline.Plan.from_polygons([np.array(COMB) @ matrix], solid=False)
        plan.add_start((np.array((6, 0.5)) @ matrix))
        return plan

    def test_the_fewest_see_everything(self):
        for degrees in (0, 17.3):
            plan = self.comb(degrees)
            found = plan.place()
            self.assertEqual((found.lower, found.upper, found.optimal), (3, 3, True))
            self.assertIn("No fewer can", found.proof)
            eyes = np.stack([found.viewpoints["x"], found.viewpoints["y"]], axis=1)
            places = support.inside_points(plan.space(), 500, 5)
            self.assertTrue(plan.can_see(eyes[:, None], places).any(axis=0).all())
            self.assertEqual(found.coverage.areas[0], 0)
            # No one sees two of the witnesses that prove it, when they are as many as the bound.
            self.assertGreaterEqual(len(found.witnesses), 3)

    def test_given_places(self):
        plan = self.comb()
        corners = plan.place(places="corners", arrays=True)
        xy = np.stack([corners.viewpoints["x"], corners.viewpoints["y"]], axis=1).tolist()
        self.assertTrue(all(tuple(each) in COMB for each in xy), xy)
        self.assertIn("at these places", corners.proof)
        given = plan.place(places=[*xy, (6, 0.5)], arrays=True)
        self.assertEqual(given.upper, corners.upper)
        with self.assertRaisesRegex(sightline.BadArgument, "."):
            plan.place(places=[(6, 0.5)])

    def test_doors_count_as_they_are(self):
        plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        plan.add_door("gap", (4, 3, 4, 4))
        level = plan.space()
        self.assertEqual(level.place().upper, 1)
        level.doors["gap"] = False
        found = level.place()
        self.assertEqual((found.lower, found.upper, found.coverage.areas[0]), (2, 2, 0))

    def test_a_time_limit_keeps_what_there_is(self):
        plan = sightline.Plan.from_file(support.MAPS / "office.map")
        start = time.monotonic()
        try:
            found = plan.place(time_limit=1)
            self.assertLessEqual(found.lower, found.upper)
            self.assertEqual(found.upper, len(found.viewpoints["x"]))
            self.assertLess(found.coverage.areas[0], 1e-6 * found.coverage.areas.sum())
        except sightline.Cancelled as stopped:
            self.assertIn("time_limit", str(stopped))
        self.assertLess(time.monotonic() - start, 60)
        # The level goes on.
        self.assertEqual(len(plan.cover([(5, 3)]).viewpoints["x"]), 1)

    def test_what_cannot_be_is_refused(self):
        plan = self.comb()
        for options, words in (({"places": "roof"}, "places"), ({"places": "grid"}, "step"),
                               ({"step": 1}, "step"), ({"places": []}, "no place"),
                               ({"time_limit": 0}, "time_limit"), ({"places": [(1, 0.5)], "step": 1}, "step")):
            with self.assertRaisesRegex(ValueError, words):
                plan.place(**options)
        plan.add_mirrors([(2, 0.5, 4, 0.5)])
        with self.assertRaisesRegex(sightline.Unsupported, "mirror"):
            plan.place()

    @unittest.skipUnless(support.COMMAND, "without the command")
    def test_it_is_that_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "comb.map")
            plan = self.comb(17.3)
            plan.save(path)
            plan = sightline.Plan.from_file(path)
            told = json.loads(support.command("place", path, "--json"))
            found = plan.place(arrays=True)
            self.assertEqual((told["lower"], told["upper"]), (found.lower, found.upper))
            table = os.path.join(folder, "cameras.csv")
            with open(table, "w", encoding="utf-8") as file:
                file.write("x,y\n" + "".join(f"{x!r},{y!r}\n" for x, y in
                                             zip(found.viewpoints["x"].tolist(), found.viewpoints["y"].tolist())))
            told = json.loads(support.command("cover", path, table, "--json"))
            seen = [row["seen_area"] for row in told["viewpoints"]]
            np.testing.assert_array_equal(seen, found.viewpoints["seen"])


if __name__ == "__main__":
    unittest.main()
