"""Tables, shapes and pictures, with the packages that make them and without."""
import doctest
import importlib
import os
import re
import sys
import unittest
import unittest.mock
import xml.etree.ElementTree

import numpy as np

import sightline
import sightline.drawing
import sightline.level
import sightline.plan
import sightline.tables
import support


def need(*names):
    """The modules of these names; a test is skipped where one is not installed."""
    found = []
    for name in names:
        try:
            found.append(importlib.import_module(name))
        except ImportError:
            raise unittest.SkipTest(f"{name} is not installed")
    return found if len(found) > 1 else found[0]


def without(*names):
    """As if modules were not installed."""
    return unittest.mock.patch.dict(sys.modules, {name: None for name in names})


class Tables(unittest.TestCase):
    def setUp(self):
        self.plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        self.plan.add_door("gap", (4, 3, 4, 4))
        self.level = self.plan.bake()

    def test_tables_of_geopandas(self):
        geopandas, _ = need("geopandas", "pandas")
        cells = self.level.cells
        self.assertIsInstance(cells, geopandas.GeoDataFrame)
        np.testing.assert_allclose(cells.geometry.area, cells["area"])
        self.assertTrue(cells.geometry.is_valid.all())
        portals = self.level.portals
        self.assertEqual(portals["door"].tolist().count("gap"), 1)
        np.testing.assert_array_equal(portals.geometry.length[portals["door"] == "gap"], [1.0])
        seen = self.level.isovists([(1, 1), (7, 1)], polygons=True)
        np.testing.assert_allclose(seen.geometry.area, seen["area"])
        squares = self.level.vga(0.5, geometry=True)
        np.testing.assert_allclose(squares.geometry.area, 0.25)

    def test_tables_of_pandas(self):
        pandas = need("pandas")
        with without("geopandas"):
            cells = self.level.cells
        self.assertIs(type(cells), pandas.DataFrame)
        self.assertEqual(cells["polygon"][0].shape[1], 2)
        self.assertEqual(list(self.level.isovists([(1, 1)]))[:3], ["x", "y", "area"])

    def test_arrays_where_nothing_is_installed(self):
        with without("pandas", "geopandas", "shapely.geometry", "scipy.sparse", "matplotlib"):
            self.assertIsInstance(self.level.cells, dict)
            self.assertEqual(self.level.region((1, 1)).shape[1], 2)
            offsets, cells = self.level.pvs
            self.assertEqual(offsets[-1], len(cells))
            table = self.level.isovists([(1, 1)], polygons=True)
            self.assertEqual(table["polygon"][0].shape[1], 2)
            self.assertIsInstance(self.plan.vga(grid=1), dict)
            self.assertIn("<svg", self.level._repr_svg_())

    def test_visible_sets_are_a_sparse_matrix(self):
        need("scipy.sparse")
        pvs = self.level.pvs
        self.assertEqual(pvs.shape, (len(self.level),) * 2)
        self.assertTrue(pvs.diagonal().all() and (pvs != pvs.T).nnz == 0)
        for a in range(len(self.level)):
            for b in range(len(self.level)):
                self.assertEqual(bool(pvs[a, b]), self.level.can_see(a, b))

    def test_step_depth_and_groups(self):
        table = self.level.vga(0.5, measures=("visual", "metric"), depth_from=[(1, 1)], arrays=True)
        self.assertEqual(table["visual_step_depth"].min(), 0)
        self.assertIn("metric_node_count", table)
        self.assertNotIn("through_vision", table)
        self.assertTrue(all(len(column) == len(table["x"]) for column in table.values()))
        np.testing.assert_array_equal(self.level.grid(0.5)[:, 0], table["x"])


    def test_parts_are_numbered_from_the_largest(self):
        self.assertNotIn("part", self.level.vga(0.5, arrays=True))
        rooms = [(0, 0, 9, 0), (9, 0, 9, 4), (9, 4, 0, 4), (0, 4, 0, 0), (3, 0, 3, 4)]
        for options in ({}, {"measures": (), "depth_from": [(1, 1)]}):
            table = sightline.Plan.from_segments(rooms).bake().vga(0.5, arrays=True, **options)
            np.testing.assert_array_equal(table["part"], np.where(table["x"] < 3, 2, 1))
        self.assertNotIn("part", sightline.Plan.from_segments(rooms).bake().vga(
            0.5, measures=(), arrays=True))


class Plans(unittest.TestCase):
    def test_polygons_with_holes_are_solid_but_for_the_holes(self):
        shapely = need("shapely.geometry")
        ring = shapely.Polygon([(2, 2), (8, 2), (8, 8), (2, 8)], [[(4, 4), (6, 4), (6, 6), (4, 6)]])
        plan = sightline.Plan.from_polygons([ring], boundary=(0, 0, 10, 10))
        found = plan.space().cell_arrays()
        self.assertAlmostEqual(found["area"][found["solid"]].sum(), 32)
        self.assertAlmostEqual(found["area"][~found["solid"]].sum(), 68)
        self.assertFalse(plan.can_see((1, 5), (9, 5)) or plan.can_see((1, 5), (5, 5)))
        self.assertTrue(plan.can_see((4.5, 5), (5.5, 5)) and plan.can_see((1, 1), (9, 1)))
        outlines = sightline.Plan.from_polygons([ring], solid=False, boundary=(0, 0, 10, 10))
        self.assertTrue(outlines.can_see((3, 3), (3, 7)))

    def test_a_geodataframe_gives_a_plan(self):
        geopandas, shapely = need("geopandas", "shapely.geometry")
        line, point = shapely.LineString, shapely.Point
        frame = geopandas.GeoDataFrame(
            {"kind": ["wall", None, "door", "solid", None, "mirror"],
             "name": [None, None, "gap", None, None, None],
             "open": [None, None, False, None, None, None]},
            geometry=[line([(0, 0), (8, 0), (8, 4), (0, 4), (0, 0)]), line([(4, 0), (4, 3)]),
                      line([(4, 3), (4, 4)]), shapely.box(1, 1, 2, 2), point(3, 3),
                      line([(5, 0), (6, 0)])], crs="EPSG:32633")
        plan = sightline.Plan.from_geodataframe(frame)
        self.assertEqual(plan.doors, {"gap": False})
        self.assertEqual((len(plan.walls), len(plan.starts), len(plan.mirrors)), (9, 1, 1))
        level = plan.bake()
        self.assertFalse(level.can_see((3, 3.5), (7, 3.5)))
        self.assertEqual(level.cells.crs, frame.crs)
        again = sightline.Plan.from_geodataframe(level.cells.geometry, solid=False)
        self.assertGreater(len(again.walls), 4)
        with self.assertRaisesRegex(ValueError, "kind 'door'"):
            sightline.Plan.from_geodataframe(geopandas.GeoDataFrame(
                {"kind": ["door"]}, geometry=[shapely.box(0, 0, 1, 1)]))
        with self.assertRaisesRegex(ValueError, "no kind 'portal'"):
            sightline.Plan.from_geodataframe(geopandas.GeoDataFrame(
                {"kind": ["portal"]}, geometry=[line([(0, 0), (1, 1)])]))

    def test_a_plan_can_change_after_it_was_asked(self):
        plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        self.assertTrue(plan.can_see((1, 3.5), (7, 3.5)))
        plan.add_walls((4, 3, 4, 4))
        self.assertFalse(plan.can_see((1, 3.5), (7, 3.5)))
        self.assertEqual(plan.locate((99, 99)), -1)


class Pictures(unittest.TestCase):
    def test_notebooks_get_svg(self):
        plan = sightline.Plan.from_file(support.MAPS / "office.map")
        for handle in (plan, plan.bake()):
            root = xml.etree.ElementTree.fromstring(handle._repr_svg_())
            self.assertTrue(root.tag.endswith("svg") and len(root))
            image = xml.etree.ElementTree.fromstring(handle._repr_html_().replace(">", "/>"))
            self.assertIn(repr(handle), image.get("alt"))

    def test_plots(self):
        matplotlib = need("matplotlib")
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        level = sightline.Plan.from_file(support.MAPS / "office.map").bake()
        ax = level.plot(cells=True, portals=True)
        self.assertGreaterEqual(len(ax.collections), 3)
        table = level.vga(2.0)
        image = sightline.heat_map(table, "connectivity", ax)
        shown = image.get_array()
        self.assertEqual(np.isfinite(shown.filled(np.nan)).sum(), len(table["x"]))
        plt.close("all")


def load_tests(loader, tests, pattern):
    for module in (sightline, sightline.plan, sightline.level, sightline.ways, sightline.drawing):
        tests.addTests(doctest.DocTestSuite(module))
    try:
        need("pandas")
    except unittest.SkipTest:
        return tests
    readme = support.ROOT / "lib/bindings/python/README.md"
    blocks = re.findall(r"^```python\n(.*?)^```", readme.read_text(encoding="utf-8"),
                        re.MULTILINE | re.DOTALL)
    examples = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, "README", str(readme), 0)
    tests.addTest(doctest.DocTestCase(examples, setUp=lambda test: os.chdir(support.ROOT)))
    return tests


if __name__ == "__main__":
    unittest.main()
