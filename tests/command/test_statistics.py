"""Numbers agree: the statistics of bake, what info says, and what export writes.

test_statistics.py PROGRAM
"""
import json
import os

import sandbox
from case import MAPS

# Effects that the maps call for are left out: what is compared is one bake with itself.
WITHOUT = ["--without", "door,mirror,oneway,range"]


def area(polygon):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(polygon, polygon[1:] + polygon[:1])) / 2


class Statistics(sandbox.ProgramTest):
    def json(self, *arguments):
        return json.loads(self.printed(*arguments))

    def bake(self, path, *options):
        statistics = self.json("bake", str(path), "-o", "out.slv", "--json", *WITHOUT, *options)
        return statistics, self.json("export", "out.slv"), self.json("info", "out.slv", "--json")

    def agree(self, statistics, export, info):
        pvs = export["pvs"]
        self.assertEqual(statistics["walls"], len(export["walls"]))
        self.assertEqual(statistics["cells"], len(export["cells"]))
        self.assertEqual(statistics["portals"], len(export["portals"]))
        self.assertEqual(statistics["pairs"], sum(map(len, pvs)))
        self.assertEqual(statistics["sight"], export["sight"])
        self.assertEqual(statistics["cleaning"]["after"], statistics["walls"])
        self.assertEqual(statistics["cleaning"]["welded"], statistics["welded"])
        self.assertEqual(statistics["file_bytes"], self.box.path("out.slv").stat().st_size)
        self.assertGreater(statistics["peak_memory_bytes"], 100000)
        for stage in ("read", "subdivide", "cell_to_cell", "write"):
            self.assertGreaterEqual(statistics["seconds"][stage], 0)
        for key in ("walls", "cells", "portals", "pairs", "doubtful_pairs", "inside_cells",
                    "tree_depth", "sight", "method", "solver", "guarantee", "file_bytes",
                    "mean_pvs_over", "mean_pvs_cells", "mean_pvs_share_of_cells",
                    "mean_pvs_share_of_area"):
            self.assertEqual(statistics[key], info[key], key)
        self.assertEqual(info["bounds"], export["bounds"])

    def test_maps(self):
        maps = sorted(path for folder in (MAPS, MAPS / "oblique") for path in folder.iterdir()
                      if path.suffix in (".map", ".txt"))
        self.assertTrue(maps)
        for path in maps:
            for sight in ("closed", "open"):
                with self.subTest(map=path.name, sight=sight):
                    self.agree(*self.bake(path, "--sight", sight))

    def test_no_work_for_effects_that_are_not_there(self):
        for method in ("sweep", "dfs", "prune", "multipass"):
            with self.subTest(method=method):
                statistics, _, _ = self.bake(MAPS / "office.map", "--method", method)
                self.assertFalse(any(statistics["effects"].values()))
                self.assertTrue(statistics["effect_work"])
                self.assertEqual(set(statistics["effect_work"].values()), {0})

    def means(self, statistics, export, sources):
        """The means by their definition, of source cells each weighted equally."""
        areas = [area(cell["polygon"]) for cell in export["cells"]]
        total = sum(areas[cell] for cell in sources)
        rows = [[cell for cell in export["pvs"][source] if cell in sources] for source in sources]
        count = sum(map(len, rows)) / len(sources)
        share = sum(sum(areas[cell] for cell in row) for row in rows) / total / len(sources)
        self.assertAlmostEqual(statistics["mean_pvs_cells"], count)
        self.assertAlmostEqual(statistics["mean_pvs_share_of_cells"], count / len(sources))
        self.assertAlmostEqual(statistics["mean_pvs_share_of_area"], share)

    def test_means_over_all_cells(self):
        statistics, export, _ = self.bake(MAPS / "maze.map")
        self.assertEqual(statistics["mean_pvs_over"], "all cells")
        self.means(statistics, export, set(range(statistics["cells"])))

    def test_means_over_inside_cells(self):
        statistics, export, _ = self.bake(MAPS / "courtyard.map", "--inside")
        inside = {cell for cell, row in enumerate(export["pvs"]) if row}
        self.assertEqual(len(inside), statistics["inside_cells"])
        self.assertLess(len(inside), statistics["cells"])
        self.assertEqual(statistics["mean_pvs_over"], "inside cells")
        self.means(statistics, export, inside)
        # The outside cells' own rows make no difference to it.
        with_outside, _, _ = self.bake(MAPS / "courtyard.map")
        self.assertGreater(with_outside["pairs"], statistics["pairs"])
        for key in ("mean_pvs_cells", "mean_pvs_share_of_cells", "mean_pvs_share_of_area"):
            self.assertEqual(with_outside[key], statistics[key])

    def test_baked_map_bakes_again(self):
        """The map of a baked file gives the same file."""
        self.bake(MAPS / "office.map")
        first = self.box.path("out.slv").read_bytes()
        self.assertEqual(self.box.run(["convert", "out.slv", "-o", "again.map"]).status, 0)
        statistics, _, _ = self.bake("again.map")
        self.assertEqual(self.box.path("out.slv").read_bytes(), first)
        cleaning = statistics["cleaning"]
        self.assertEqual(cleaning["before"], cleaning["after"])

    def test_check_is_timed(self):
        statistics, _, _ = self.bake(MAPS / "flat.map", "--check")
        self.assertGreater(statistics["seconds"]["check"], 0)

    def test_stab_trees(self):
        statistics, _, info = self.bake(MAPS / "flat.map", "--stab-trees")
        self.assertEqual(statistics["tree_nodes_kept"], statistics["tree_nodes"])
        self.assertEqual(info["stab_tree_nodes"], statistics["tree_nodes"])
        statistics, _, info = self.bake(MAPS / "flat.map", "--stab-trees", "--tree-memory", "1K")
        self.assertLess(statistics["tree_nodes_kept"], statistics["tree_nodes"])
        self.assertEqual(info["stab_trees_left_out"], statistics["trees_left_out"])
        self.assertGreater(statistics["trees_left_out"], 0)

    def test_slice_of_a_model(self):
        """A UniGrafix model: a room of four walls from z = 0 to 2, cut between."""
        corners = [(0, 0), (4, 0), (4, 3), (0, 3)]
        lines = [f"v {level}{i} {x} {y} {z};" for level, z in (("a", 0), ("b", 2))
                 for i, (x, y) in enumerate(corners)]
        lines += [f"f (a{i} a{(i + 1) % 4} b{(i + 1) % 4} b{i});" for i in range(4)]
        self.box.path("room.ug").write_text("\n".join(lines) + "\n")
        result = self.box.run(["bake", "room.ug", "-o", "out.slv", "--json", "--quiet",
                               "--slice", "1"])
        self.assertEqual(result.status, 0, result.text())
        statistics = json.loads(result.stdout)
        self.assertEqual((statistics["walls"], statistics["cells"]), (4, 1))
        result = self.box.run(["bake", "room.ug", "-o", "out.slv"])
        self.assertEqual(result.status, 2)
        self.assertIn("--slice", result.stderr)

    def test_name_that_is_no_utf8(self):
        name = b"caf\xe9.map"
        try:
            with open(os.path.join(os.fsencode(self.box.folder), name), "w") as stream:
                stream.write("sightline 1\nwalls 0 0 4 0 4 3 0 3 0 0\n")
        except OSError:
            self.skipTest("this file system takes no such name")
        statistics = self.json("bake", os.fsdecode(name), "-o", "out.slv", "--json")
        self.assertEqual(statistics["map"], "caf?.map")

    def test_soda_hall(self):
        path = MAPS.parent.parent / "shared" / "data" / "soda-hall-floor5.ug"
        if not path.exists():
            self.skipTest(f"{path} is not there")
        result = self.box.run(["bake", str(path), "--slice", "1040", "--inside", "--json",
                               "--quiet", "-o", "out.slv"])
        self.assertEqual(result.status, 0, result.text())
        statistics = json.loads(result.stdout)
        self.assertEqual(statistics["cleaning"]["before"], 871)
        self.agree(statistics, self.json("export", "out.slv"),
                   self.json("info", "out.slv", "--json"))

    def test_reader_that_goes_away(self):
        self.bake(MAPS / "office.map")
        process = self.box.start(["export", "out.slv"])
        process.stdout.close()
        process.stdout = None
        stderr = process.communicate(timeout=30)[1]
        self.assertEqual(process.returncode, 1)
        self.assertEqual(stderr, b"")  # as with `| head`: no mistake, and nothing to say


if __name__ == "__main__":
    sandbox.main()
