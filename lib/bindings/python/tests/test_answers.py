"""Answers of the package against exact arithmetic in Python and against the command line."""
import pathlib
import tempfile
import unittest
import warnings

import numpy as np

import sightline
import support

warnings.simplefilter("ignore", sightline.SightlineWarning)


def office():
    return sightline.Plan.from_file(support.MAPS / "office.map")


class Points(unittest.TestCase):
    def test_points_see_as_exact_segments_say(self):
        for name in ("office.map", "gallery.map", "oblique/rotunda.map"):
            with self.subTest(name):
                plan = sightline.Plan.from_file(support.MAPS / name)
                level = plan.space(without=("door", "mirror", "oneway", "range"))
                eyes = support.inside_points(level, 150, 1)
                places = np.roll(eyes, 1, axis=0)
                walls = level.walls
                wanted = [support.plainly_sees(walls, p, q) for p, q in zip(eyes, places)]
                self.assertEqual(level.can_see(eyes, places).tolist(), wanted)
                self.assertTrue(any(wanted) and not all(wanted))

    def test_points_broadcast_to_a_matrix(self):
        level = sightline.Plan.from_segments(support.TWO_ROOMS).bake()
        points = support.random_points(level, 9, 2)
        matrix = level.can_see(points[:, None, :], points)
        self.assertEqual(matrix.shape, (9, 9))
        self.assertTrue((matrix == matrix.T).all() and matrix.diagonal().all())
        self.assertEqual(bool(matrix[2, 5]), level.can_see(points[2], points[5]))

    def test_located_cells_hold_their_points(self):
        level = office().space()
        points = support.random_points(level, 200, 3)
        found = level.cell_arrays()
        for point, cell in zip(points, level.locate(points)):
            corners = found["corners"][found["offsets"][cell]:found["offsets"][cell + 1]]
            for a, b in zip(corners, np.roll(corners, -1, axis=0)):
                self.assertGreaterEqual(support.turn(a, b, point), 0)
        self.assertEqual(level.locate((-5, -5)), -1)
        self.assertEqual(level.locate((np.nan, 1)), -1)

    def test_any_number_of_threads_gives_the_same(self):
        level = office().bake()
        eyes = support.inside_points(level, 600, 4)
        one = level.isovists(eyes, arrays=True, threads=1)
        two = level.isovists(eyes, arrays=True, threads=5)
        for name in one:
            np.testing.assert_array_equal(one[name], two[name])
        self.assertTrue((level.look(eyes, threads=1) == level.look(eyes, threads=3)).all())


class Regions(unittest.TestCase):
    def test_regions_hold_what_is_seen(self):
        shapely = self.need("shapely.geometry")
        level = office().space()
        eyes = support.inside_points(level, 5, 5)
        places = support.inside_points(level, 200, 6)
        for eye in eyes:
            region = level.region(eye)
            sees = level.can_see(eye, places)
            holds = [region.contains(shapely.Point(*place)) for place in places]
            self.assertEqual(sees.tolist(), holds)
            area = level.isovists([eye], arrays=True)["area"][0]
            self.assertAlmostEqual(region.area, area, delta=1e-9 * area)

    def need(self, name):
        try:
            import importlib
            return importlib.import_module(name)
        except ImportError:
            self.skipTest(f"{name} is not installed")

    def test_a_range_ends_regions_in_arcs(self):
        level = sightline.Plan.from_segments(support.TWO_ROOMS).space()
        level.range = 0.5
        self.assertEqual(level.range, 0.5)
        area = level.isovists([(1, 2)], arrays=True)["area"][0]
        self.assertAlmostEqual(area, np.pi / 4)
        corners = level.region((1, 2), tolerance=1e-3, as_array=True)
        self.assertLess(np.abs(np.hypot(*(corners - (1, 2)).T) - 0.5).max(), 1e-9)
        self.assertFalse(level.can_see((1, 2), (2, 2)))

    def test_a_region_that_ends_where_the_map_ends_is_warned_of(self):
        plan = sightline.Plan.from_polygons([[(0, 0), (10, 0), (10, 10), (0, 10)], [(20, 0), (30, 0), (30, 10), (20, 10)]])
        plan.add_start((15, 5))
        with self.assertWarnsRegex(sightline.SightlineWarning,
                                   "1 of 2 points sees the border .* the first from 15,5: .* add_seams"):
            plan.isovists([(5, 5), (15, 5)], range=6)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            self.assertEqual(plan.isovists([(15, 5)], range=4, arrays=True)["corners"].tolist(), [0])
            plan.add_seams([(0, -20, 30, -20), (0, 30, 30, 30)])
            self.assertGreater(plan.isovists([(15, 5)], range=6, arrays=True)["area"][0], 100)
        self.assertFalse([one for one in said if "border" in str(one.message)])

    def test_a_range_of_one_question_is_forgotten(self):
        plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        areas = [plan.isovists([(1, 2)], range=limit, arrays=True)["area"][0] for limit in (0.5, None)]
        self.assertAlmostEqual(areas[0], np.pi / 4)
        self.assertGreater(areas[1], 1)
        self.assertEqual(plan.range, 0)
        for wrong in (-1, np.nan, np.inf):
            with self.assertRaisesRegex(ValueError, "range"):
                plan.isovists([(1, 2)], range=wrong)

    def test_a_plan_is_read_in_part_and_as_plain_units(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.geojson"
            path.write_text('{"type": "LineString", "coordinates": '
                            '[[7.00001, 50.00001], [7.00101, 50.00001], [7.00101, 50.00101]]}',
                            encoding="utf-8")
            flat = sightline.Plan.from_file(path, planar=True)
            np.testing.assert_array_equal(flat.walls[0], [7.00001, 50.00001, 7.00101, 50.00001])
            metres = sightline.Plan.from_file(path, degrees=True)
            self.assertAlmostEqual(float(np.ptp(metres.walls[0, ::2])), 71.7, delta=0.1)
            part = sightline.Plan.from_file(path, planar=True, crop=(7, 50, 7.0005, 50.0005))
            np.testing.assert_array_equal(part.walls, [[7.00001, 50.00001, 7.0005, 50.00001]])
            with self.assertRaises(ValueError):
                sightline.Plan.from_file(path, crop=(1, 0, 0, 1))

    def test_layers_are_a_list_or_a_text(self):
        pairs = "0 SECTION 2 ENTITIES" + "".join(
            f" 0 LINE 8 {layer} 10 0 20 {y} 11 9 21 {y}" for y, layer in enumerate("ABC")) + " 0 ENDSEC 0 EOF"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "plan.dxf"
            path.write_text("\n".join(pairs.split()) + "\n")
            for layers, walls in (("A,B", 2), (["A", "B"], 2), (("C",), 1), (None, 3)):
                self.assertEqual(len(sightline.Plan.from_file(path, layers=layers).walls), walls)
            for wrong, error in ((["A", 1], TypeError), (["A,B"], ValueError)):
                with self.assertRaises(error):
                    sightline.Plan.from_file(path, layers=wrong)

    def test_the_advice_about_a_start_can_be_followed(self):
        plan = sightline.Plan.from_segments([(0, 0, 9, 0), (0, 0, 0, 9), (4, 4, 5, 4), (5, 4, 5, 5),
                                             (5, 5, 4, 5), (4, 5, 4, 4)])
        with self.assertWarnsRegex(sightline.SightlineWarning, r"plan\.add_start\(\(x, y\)\)"):
            plan.isovists([(1, 1)])
        plan.add_start((1, 1))
        with self.assertWarnsRegex(sightline.SightlineWarning, "leads out"):
            plan.isovists([(1, 1)])

    def test_a_window_is_no_seam(self):
        plan = sightline.Plan.from_text("sightline 1\nwalls 0 0 9 0 9 6 0 6 0 0\n"
                                        "wall 3 0 3 6 stops steps\nseam 6 0 6 6\n")
        for map_ in (plan, plan.bake()):
            self.assertEqual(map_.seams.tolist(), [[6, 0, 6, 6]])

    def test_the_width_of_entrances_says_what_is_inside(self):
        def inside(plan):
            found = plan.space().cell_arrays()
            return found["area"][found["inside"]].sum()

        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "house.map"
            path.write_text(support.HOUSE)
            found = sightline.Plan.from_file(path)
            narrow = sightline.Plan.from_file(path, entrance=1)
            self.assertEqual((found.entrance, narrow.entrance), (0, 1))
            self.assertEqual((inside(found), inside(narrow)), (80, 96))
            for width, area in ((1.5, 96), (2, 80), (1, 96), (0, 80)):
                narrow.entrance = width
                self.assertEqual((narrow.entrance, inside(narrow)), (width, area))
            narrow.entrance = 2.5
            narrow.save(path)
            self.assertIn("entrance 2.5", path.read_text().splitlines())
            self.assertEqual(sightline.Plan.from_file(path).entrance, 2.5)
            self.assertEqual(sightline.Plan.from_file(path, entrance=3).entrance, 3)

    def test_the_advice_about_entrances_can_be_followed(self):
        plan = sightline.Plan.from_text(support.HOUSE)
        with self.assertWarnsRegex(sightline.SightlineWarning, r"for another width, set plan\.entrance$"):
            plan.space()
        plan.entrance = 2
        with warnings.catch_warnings():
            warnings.simplefilter("error", sightline.SightlineWarning)
            plan.space()

    def test_mirrors_show_more(self):
        plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        plan.add_mirrors([(1, 4, 3.9, 4)])
        level = plan.bake()
        regions = level.region((2, 1), mirrors=True, as_array=True)
        self.assertGreater(len(regions), 1)
        self.assertGreater(level.isovists([(2, 1)], arrays=True)["mirrored_area"][0], 0)
        level.mirror_depth = 0
        self.assertEqual(level.mirror_depth, 0)
        self.assertEqual(len(level.look((2, 1), mirrored=True)), 0)

    def test_an_eye_outside_sees_nothing(self):
        level = sightline.Plan.from_segments(support.TWO_ROOMS).bake()
        self.assertEqual(len(level.region((99, 99), as_array=True)), 0)
        self.assertEqual(len(level.look((99, 99))), 0)
        self.assertFalse(level.can_see((99, 99), (1, 1)))


class Sets(unittest.TestCase):
    def test_eyes_see_what_their_cells_see(self):
        level = office().bake()
        offsets, cells = level.sets()
        eyes = support.inside_points(level, 60, 7)
        for eye, cell in zip(eyes, level.locate(eyes)):
            row = cells[offsets[cell]:offsets[cell + 1]]
            self.assertLessEqual(set(level.look(eye)), set(row))
        self.assertTrue(level.cell_sees(np.arange(len(level)), np.arange(len(level))).all())
        counts = np.diff(offsets)
        self.assertTrue(counts.min() < counts.max())

    def test_shut_doors_hide(self):
        plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        plan.add_door("gap", (4, 3, 4, 4))
        level = plan.bake()
        a, b = level.locate((1, 1)), level.locate((7, 1))
        self.assertTrue(level.can_see((1, 3.5), (7, 3.5)) and level.can_see(a, b))
        before = level.sets()[0][-1]
        region = level.isovists([(1, 3.5)], arrays=True)["area"][0]
        level.doors["gap"] = False
        self.assertEqual(dict(level.doors), {"gap": False})
        self.assertFalse(level.can_see((1, 3.5), (7, 3.5)) or level.can_see(a, b))
        self.assertLess(level.sets()[0][-1], before)
        self.assertLess(level.isovists([(1, 3.5)], arrays=True)["area"][0], region)
        self.assertEqual(level.explain(a, b).decides, ("door",))
        level.doors["gap"] = True
        self.assertTrue(level.can_see((1, 3.5), (7, 3.5)))

    def test_a_shut_door_hides_in_a_plan_without_sets(self):
        plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        plan.add_door("gap", (4, 3, 4, 4), is_open=False)
        self.assertFalse(plan.can_see((1, 3.5), (7, 3.5)))
        self.assertEqual(plan.doors, {"gap": False})
        self.assertLess(plan.vga(0.5, seeds=[(1, 1)], arrays=True)["x"].max(), 4)

    def test_explanations_name_portals(self):
        level = sightline.Plan.from_segments(support.TWO_ROOMS).bake()
        near = level.explain((1, 1), (7, 3.5))
        self.assertTrue(near.seen and near.sequence.portals and near.line is not None)
        level = office().bake()
        offsets, cells = level.sets()
        hidden = np.setdiff1d(np.arange(len(level)), cells[offsets[0]:offsets[1]])[0]
        far = level.explain(0, int(hidden))
        self.assertFalse(far.seen)
        self.assertEqual(far.verdict, "hidden")
        self.assertTrue(far.misses and far.misses[0].reason and len(far.misses[0].ends))
        self.assertIn("does not see", str(far))


@unittest.skipUnless(support.COMMAND, "SIGHTLINE_COMMAND names no program")
class CommandLine(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = pathlib.Path(scratch.name)

    def test_baked_files_are_those_of_the_command(self):
        ours, theirs = self.scratch / "a.slv", self.scratch / "b.slv"
        paths = sorted([*support.MAPS.glob("*.map"), *support.MAPS.glob("*/*.map"),
                        *support.MAPS.glob("*.txt"), *support.MAPS.glob("*.tmx")])
        self.assertGreater(len(paths), 10)
        for path in paths:
            with self.subTest(path.name):
                support.command("bake", path, "-o", theirs, "--quiet")
                sightline.Plan.from_file(path).bake().save(ours)
                self.assertEqual(ours.read_bytes(), theirs.read_bytes())
                with sightline.Level.open(theirs) as level:
                    self.assertGreater(len(level), 0)
        house = self.scratch / "house.map"
        house.write_text(support.HOUSE)
        support.command("bake", house, "--entrance", "1", "-o", theirs, "--quiet")
        sightline.Plan.from_file(house, entrance=1).bake().save(ours)
        self.assertEqual(ours.read_bytes(), theirs.read_bytes())

    def test_isovists_are_those_of_the_command(self):
        paths = [support.MAPS / "office.map", *sorted((support.MAPS / "effects").glob("*.map")),
                 *sorted((support.MAPS / "oblique").glob("*.map"))]
        for path in paths:
            with self.subTest(path.name):
                theirs = support.table(support.command("isovist", path, "--grid", "2"))
                eyes = np.column_stack([theirs["x"], theirs["y"]])
                ours = sightline.Plan.from_file(path).isovists(eyes, arrays=True)
                self.assertGreater(len(eyes), 10)
                for name in set(theirs) & set(ours):
                    np.testing.assert_array_equal(ours[name], theirs[name], name)
                self.assertLessEqual({"area", "corners", "drift_angle"}, set(theirs) & set(ours))

    def test_parts_of_a_door_may_stand_differently(self):
        path = self.scratch / "parts.map"
        path.write_text("sightline 1\nwalls 0 0 30 0 30 10 0 10 0 0\nwalls 10 0 10 4\nwalls 10 6 10 10\nwalls 20 0 20 4\n"
                        "walls 20 6 20 10\ndoor gate 10 4 10 6 open\ndoor gate 20 4 20 6 shut\n")
        eyes = [(5, 5), (15, 5), (25, 5)]
        theirs = support.table(support.command("isovist", path, *(f"--at={x},{y}" for x, y in eyes)))
        self.assertEqual(len(set(theirs["area"])), 2)
        plan = sightline.Plan.from_file(path)
        for level in plan, plan.bake():
            np.testing.assert_array_equal(level.isovists(eyes, arrays=True)["area"], theirs["area"])
        level.doors["gate"] = False
        self.assertEqual(level.isovists(eyes, arrays=True)["area"].tolist(), [100, 100, 100])

    def test_isovists_behind_shut_doors_are_those_of_the_command(self):
        path = support.MAPS / "effects/doors.map"
        level = sightline.Plan.from_file(path).bake()
        names = list(level.doors)
        self.assertEqual([level.doors[name] for name in names].count(False), 1)
        for shut in (names[0], "none", ",".join(names)):
            theirs = support.table(support.command("isovist", path, "--grid", "1", "--shut", shut))
            for name in names:
                level.doors[name] = name not in shut.split(",")
            ours = level.isovists(np.column_stack([theirs["x"], theirs["y"]]), arrays=True)
            for column in ("area", "corners", "perimeter"):
                np.testing.assert_array_equal(ours[column], theirs[column], column)

    def test_vga_is_that_of_the_command(self):
        groups = ("visual", "through", "metric", "angular", "isovist")
        for name, grid in (("office.map", 2), ("effects/stops.map", 0.5)): # the other: paths by steps
            path = support.MAPS / name
            theirs = support.table(support.command("vga", path, "--grid", str(grid), "--measures", "all"))
            ours = sightline.Plan.from_file(path).vga(grid, measures=groups, arrays=True)
            for column in theirs:
                np.testing.assert_array_equal(ours[column], theirs[column], f"{name}: {column}")

    def test_estimates_are_those_of_the_command(self):
        path = support.MAPS / "office.map"
        plan, exact = sightline.Plan.from_file(path), sightline.Plan.from_file(path).vga(1, arrays=True)
        for seed in (1, 7):
            theirs = support.table(support.command("vga", path, "--grid", "1", "--estimate", "20", "--seed", str(seed)))
            ours = plan.vga(1, estimate=20, seed=seed, arrays=True)
            self.assertEqual({*ours}, {*theirs})
            for column in theirs:
                np.testing.assert_array_equal(ours[column], theirs[column], column)
            self.assertTrue((ours["visual_mean_depth"] != exact["visual_mean_depth"]).any())
        everything = plan.vga(1, estimate=10**6, arrays=True)
        for end in ("", "_least", "_most"):
            np.testing.assert_array_equal(everything[f"visual_mean_depth{end}"], exact["visual_mean_depth"])

    def test_measures_are_those_of_the_command_in_its_order(self):
        path = support.MAPS / "office.map"
        plan, table = sightline.Plan.from_file(path), sightline.measures()
        of_region = [measure.name for measure in table if measure.group == "isovist"]
        of_graph = [measure.name for measure in table if measure.group != "isovist"]
        theirs = support.table(support.command("isovist", path, "--grid", "9"))
        self.assertEqual([name for name in theirs if name not in ("x", "y", "heading", "fov")],
                         [*of_region, "corners"])
        self.assertEqual(list(plan.isovists([(53, 20)], arrays=True)), ["x", "y", *of_region, "corners"])
        theirs = support.table(support.command("vga", path, "--grid", "9", "--measures",
                                               "visual,through,metric,angular"))
        self.assertEqual(list(theirs), ["x", "y", *of_graph, "part"])
        groups = {measure.group for measure in table} - {"isovist"}
        self.assertEqual(list(plan.vga(9, measures=groups, arrays=True)), list(theirs))
        self.assertTrue(all(measure.meaning for measure in table))
        self.assertEqual(next(each.unit for each in table if each.name == "area"), "unit\u00b2")

    def test_a_measure_that_is_not_defined_is_nan(self):
        path = self.scratch / "corner.map"
        path.write_text("sightline 1\nwalls 0.75 0.75 2.25 0.75 2.25 2.25 1.75 2.25 1.75 1.25 "
                        "0.75 1.25 0.75 0.75\n")
        theirs = support.table(support.command("vga", path, "--grid", "1"))
        ours = sightline.Plan.from_file(path).vga(1, arrays=True)
        for name in theirs.keys() - {"part"}:
            np.testing.assert_array_equal(ours[name], theirs[name], name)
        self.assertTrue(np.isnan(ours["visual_integration_tekl"]).all())
        self.assertFalse(any(np.isinf(column).any() for column in ours.values()))

    def test_vga_through_one_way_glass_is_that_of_the_command(self):
        path = support.MAPS / "effects" / "oneway.map"
        groups = ("visual", "through", "metric", "angular", "isovist")
        for seen_from, option in ((True, ["--seen-from"]), (False, [])):
            theirs = support.table(support.command("vga", path, "--grid", "1", "--measures", "all",
                                                   *option))
            ours = sightline.Plan.from_file(path).vga(1, measures=groups, arrays=True,
                                                      seen_from=seen_from)
            for name in theirs.keys() - {"part"}:
                np.testing.assert_array_equal(ours[name], theirs[name], f"{name} {option}")
        walls = sightline.Plan.from_file(path).space(without=("oneway",)).vga(1, arrays=True)
        self.assertTrue((walls["connectivity"] != ours["connectivity"]).any())

    def test_exports_are_those_of_the_command(self):
        baked = self.scratch / "a.slv"
        level = office().bake()
        level.save(baked)
        for ending in ("json", "geojson", "csv"):
            support.command("export", baked, "--format", ending, "-o", self.scratch / "theirs")
            level.export(self.scratch / f"ours.{ending}")
            self.assertEqual((self.scratch / f"ours.{ending}").read_bytes(),
                             (self.scratch / "theirs").read_bytes())


if __name__ == "__main__":
    unittest.main()
