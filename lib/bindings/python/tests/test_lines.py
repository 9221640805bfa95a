"""Axial lines and segments, against the command line."""
import pathlib
import re
import tempfile
import unittest

import numpy as np

import sightline
import support

GALLERY = support.MAPS / "gallery.map"


@unittest.skipUnless(support.COMMAND, "the program is not here")
class Lines(unittest.TestCase):
    def same(self, got, text):
        wanted = support.table(text)
        self.assertEqual([name.split("_r")[0] for name in wanted], list(got))
        for name, values in zip(got, wanted.values()):
            np.testing.assert_allclose(got[name], values, rtol=1e-8, atol=1e-12, err_msg=name)

    def test_axial(self):
        plan = sightline.Plan.from_file(GALLERY)
        for lines in ("all", "subsets", "fewest"):
            self.same(plan.axial(lines, arrays=True), support.command("axial", GALLERY, "--lines", lines, "-q"))
        self.same(plan.axial(radius=2, arrays=True), support.command("axial", GALLERY, "--radius", 2, "-q"))

    def test_segments(self):
        lines = sightline.Plan.from_file(GALLERY).axial(arrays=True)
        drawn = np.column_stack([lines[name] for name in ("x1", "y1", "x2", "y2")])
        network = sightline.Plan.from_segments(drawn)
        with tempfile.TemporaryDirectory() as folder:
            table = pathlib.Path(folder) / "lines.csv"
            table.write_text("x1,y1,x2,y2\n" + "".join(",".join(map(repr, row)) + "\n" for row in drawn.tolist()),
                             encoding="utf-8")
            self.same(network.segments(arrays=True), support.command("segments", table, "-q"))
            with self.assertRaises(sightline.BadInput) as refused:
                sightline.Plan.from_file(table)
            step = re.search(r"Plan.from_segments\(.*\)$", str(refused.exception)).group()
            asked = eval(step, {"Plan": sightline.Plan, "numpy": np, "path": table})
            self.same(asked.segments(arrays=True), support.command("segments", table, "-q"))
            self.same(network.segments(metric_radius=20, arrays=True),
                      support.command("segments", table, "--metric-radius", 20, "-q"))
            self.same(network.segments(angular_radius=1.5, arrays=True),
                      support.command("segments", table, "--angular-radius", 1.5, "-q"))
        self.assertEqual(len(sightline.Plan().segments(arrays=True)["x1"]), 0)

    def test_weights_and_unlinks(self):
        roads = [(0, 0, 4, 0), (1, -1, 1, 2), (3, -1, 3, 3)]
        plan = sightline.Plan.from_segments(roads)
        with tempfile.TemporaryDirectory() as folder:
            table, bridge = pathlib.Path(folder) / "roads.csv", pathlib.Path(folder) / "bridge.csv"
            table.write_text("x1,y1,x2,y2,lanes\n" + "".join(f"{','.join(map(str, road))},{lanes}\n"
                             for road, lanes in zip(roads, (2, 3, 1))), encoding="utf-8")
            bridge.write_text("x,y\n1,0.1\n", encoding="utf-8")
            wanted = support.table(support.command("segments", table, "--weight", "lanes", "--unlinks", bridge, "-q"))
        got = plan.segments(weights=[2, 3, 1], unlinks=[(1, 0.1)], arrays=True)
        for name in ("t1024_choice", "t1024_integration", "t1024_node_count", "t1024_total_depth"):
            np.testing.assert_allclose(got[name], wanted[f"{name}_weighted"], rtol=1e-8, err_msg=name)
        self.assertRaises(sightline.SightlineError, plan.segments, unlinks=[(2, 0)])
        for weights in ([1, 2], [1, 2, -1], [[1, 2, 3]]):
            self.assertRaises((ValueError, sightline.SightlineError), plan.segments, weights=weights)

    def test_doors(self):
        plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        plan.add_door("way", (4, 3, 4, 4), is_open=True)
        level = plan.space()
        longest = level.axial(arrays=True)["line_length"].max()
        level.doors["way"] = False
        self.assertLess(level.axial(arrays=True)["line_length"].max(), longest)

    def test_refusals(self):
        plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        for ask in (lambda: plan.axial("most"), lambda: plan.axial(radius=-1), lambda: plan.segments(metric_radius=-1),
                    lambda: plan.segments(angular_radius=float("nan"))):
            self.assertRaises(ValueError, ask)
        plan.add_mirrors([(0, 1, 0, 2)])
        self.assertRaises(sightline.Unsupported, plan.axial)


if __name__ == "__main__":
    unittest.main()
