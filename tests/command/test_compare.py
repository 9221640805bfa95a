"""What compare tells, against bake and export; a map that rounding decides; giving up and stopping.

test_compare.py PROGRAM [--brief]
--brief: against bakes with one choice of options, not with two.
"""
import csv
import io
import json
import os
import signal
import sys
import time

import sandbox
from case import MAPS
from test_interrupt import pillars

# Walls that end a hair's breadth (1e-10) past a line along which the doors between them lie: GLPK's
# simplex, which works with a tolerance, sees through; nothing else may.
HAIR = """sightline 1
walls 0 0 40 0 40 40 0 40 0 0
wall 10 0 10 20.0000000001
wall 10 24 10 40
wall 20 0 20 18
wall 20 20 20 40
wall 30 0 30 20.00000000005
wall 30 23 30 40
"""
FILES = ["compare.csv", "compare.png", "compare.svg", "pairs.csv"]


def holds(polygon, x, y):
    """Whether a point is strictly inside a convex polygon, counter-clockwise."""
    return all((b[0] - a[0]) * (y - a[1]) > (b[1] - a[1]) * (x - a[0])
               for a, b in zip(polygon, polygon[1:] + polygon[:1]))


class Compare(sandbox.ProgramTest):
    def compare(self, name, *options):
        """The runs as JSON and as CSV has them, and the pairs on which they disagree."""
        told = json.loads(self.run_well("compare", name, "-o", "out", "--json", *options).stdout)
        rows = self.table("compare.csv")
        for row, run in zip(rows, told["runs"]):
            self.assertEqual(list(row), list(run))
        self.assertEqual(len(rows), len(told["runs"]))
        return told, rows, self.table("pairs.csv")

    def table(self, name):
        return list(csv.DictReader(io.StringIO(self.box.path("out/" + name).read_text())))

    def export(self, name, run, *options):
        method, solver = run
        options = ["--method", method, *(["--solver", solver] if solver else []), *options]
        self.run_well("bake", name, "-o", "out.slv", "-q", *options)
        return json.loads(self.run_well("export", "out.slv").stdout)

    def agrees_with_bakes(self, name, *options):
        """Pairs, pairs too many and too few, and each pair told, from bakes of the same map."""
        told, rows, pairs = self.compare(name, "--repeat", "1", *options)
        done = [row for row in rows if row["outcome"] == "done"]
        self.assertTrue(done)
        exports = {(row["method"], row["solver"]):
                   self.export(name, (row["method"], row["solver"]), *options) for row in done}
        seen = {run: {(a, b) for a, row in enumerate(export["pvs"]) for b in row}
                for run, export in exports.items()}
        exact = seen[tuple((told["reference"] + " with ").split(" with ")[:2])]
        for row in done:
            mine = seen[row["method"], row["solver"]]
            self.assertEqual(int(row["pairs"]), len(mine))
            self.assertEqual(int(row["pairs_too_many"]), len(mine - exact))
            self.assertEqual(int(row["pairs_too_few"]), len(exact - mine))
        disputed = set.union(*seen.values()) - set.intersection(*seen.values())
        self.assertEqual({(int(row["a"]), int(row["b"])) for row in pairs}, disputed)
        cells = next(iter(exports.values()))["cells"]
        for row in pairs:
            a, b = int(row["a"]), int(row["b"])
            for run in seen:
                told_so = row["/".join(filter(None, run))]
                self.assertEqual(told_so, str(int((a, b) in seen[run])))
            self.assertTrue(holds(cells[a]["polygon"], float(row["ax"]), float(row["ay"])))
            self.assertTrue(holds(cells[b]["polygon"], float(row["bx"]), float(row["by"])))
        return rows, pairs

    def test_gallery(self):
        (self.box.path("gallery.map")).write_bytes((MAPS / "gallery.map").read_bytes())
        for options in [["--sight", "open", "--inside"], ["--sight", "closed"]][:1 if BRIEF else 2]:
            with self.subTest(options=options):
                rows, pairs = self.agrees_with_bakes("gallery.map", *options)
                self.assertGreater(len(rows), 1)

    def test_rounding_decides(self):
        self.box.path("hair.map").write_text(HAIR)
        rows, pairs = self.agrees_with_bakes("hair.map")
        rounded, = [row for row in rows if (row["method"], row["solver"]) == ("dfs", "glpk")]
        self.assertGreater(int(rounded["pairs_too_many"]), 0)
        self.assertGreaterEqual(int(rounded["doubtful_pairs"]), int(rounded["pairs_too_many"]))
        self.assertTrue(pairs)

    def test_figures(self):
        """Of one run fit each other, and the times are those of the clock."""
        self.box.path("office.map").write_bytes((MAPS / "office.map").read_bytes())
        start = time.monotonic()
        told, rows, _ = self.compare("office.map", "--repeat", "3", "--time-limit", "20",
                                     "--solvers", "funnel,glpk,hybrid")
        elapsed = time.monotonic() - start
        done = [run for run in told["runs"] if run["outcome"] == "done"]
        self.assertGreater(len(done), 1)
        self.assertLess(sum(run["timings"] * run["seconds_low"] for run in done) / 3, elapsed)
        fastest = min(run["seconds"] for run in done if run["guarantee"] == "exact")
        for run in done:
            self.assertEqual(run["timings"], 3)
            self.assertGreater(run["seconds_low"], 0)
            self.assertLessEqual(run["seconds_low"], run["seconds"])
            self.assertLessEqual(run["seconds"], run["seconds_high"])
            self.assertAlmostEqual(run["ratio"], run["seconds"] / fastest, delta=1e-9)
            if run["tests"]:
                self.assertAlmostEqual(run["seconds_per_test"], run["seconds"] / run["tests"],
                                       delta=1e-15)
            if run["orientations"]:
                self.assertAlmostEqual(
                    run["filter_share"], 1 - run["exact_orientations"] / run["orientations"])
            else:
                self.assertIsNone(run["filter_share"])
        statistics = json.loads(self.run_well("bake", "office.map", "-o", "o.slv", "--json",
                                            "--solver", "glpk").stdout)
        rounded, = [run for run in done if (run["method"], run["solver"]) == ("dfs", "glpk")]
        for key in ("tests", "tree_nodes", "longest_sequence", "pairs", "doubtful_pairs"):
            self.assertEqual(rounded[key], statistics[key])
        self.assertTrue(any(run["frontier"] for run in done))

    def test_time_limit(self):
        """Runs that take too long are given up and listed; without an exact one nothing is judged."""
        self.box.path("hall.map").write_text(pillars(24))
        start = time.monotonic()
        told, rows, pairs = self.compare("hall.map", "--time-limit", "0.3", "--methods", "dfs",
                                         "--solvers", "funnel,glpk")
        self.assertLess(time.monotonic() - start, 20)
        self.assertEqual([run["outcome"] for run in told["runs"]], ["not done", "not done"])
        self.assertIsNone(told["reference"])
        for row in rows:
            self.assertEqual((row["seconds"], row["pairs"], row["pairs_too_many"]), ("", "", ""))
        self.assertEqual(pairs, [])
        table = self.run_well("compare", "hall.map", "--time-limit", "0.3", "--methods", "dfs",
                            "--solvers", "funnel")
        self.assertRegex(table.stdout, r"dfs +funnel +exact +not done in 0\.3 s\n")
        self.assertIn("no exact run is done", table.stdout)

    def test_one_solver_refuses(self):
        """Coordinates that are multiples of no power of two near enough: refused by name."""
        self.box.path("hair.map").write_text(HAIR)
        told, rows, _ = self.compare("hair.map", "--repeat", "1")
        refused = [run for run in told["runs"] if run["outcome"] == "refused"]
        if not refused:
            self.skipTest("no solver refuses such a map")
        table = self.run_well("compare", "hair.map", "--repeat", "1").stdout
        for run in refused:
            self.assertIsNone(run["pairs"])
            self.assertRegex(table, rf"{run['method']} +{run['solver']} .* refused: \S")
            alone = self.box.run(["compare", "hair.map", "--methods", run["method"],
                                  "--solvers", run["solver"]])
            self.assertEqual(alone.status, 2)

    def test_repeats_until_enough(self):
        self.box.path("flat.map").write_bytes((MAPS / "flat.map").read_bytes())
        told, _, _ = self.compare("flat.map", "--methods", "dfs", "--solvers", "funnel")
        run, = told["runs"]
        self.assertGreater(run["timings"], 3)

    def stop(self, number, *options):
        self.box.path("hall.map").write_text(pillars(24))
        before = self.box.files()
        process = self.box.start(["compare", "hall.map", *options])
        sandbox.wait_for_work(process.pid)
        asked = time.monotonic()
        process.send_signal(number)
        result = self.box.finish(process, before, timeout=30)
        self.assertLess(time.monotonic() - asked, 10)
        self.assertEqual((result.status, result.stdout, result.stderr),
                         (1, "", "sightline: interrupted\n"))
        self.assertEqual(self.box.files(), before)

    def test_ctrl_c(self):
        self.stop(signal.SIGINT, "-o", "out")

    def test_terminate_with_older_files(self):
        self.box.path("out").mkdir()
        for name in FILES:
            self.box.path("out/" + name).write_text("older")
        self.stop(signal.SIGTERM, "-o", "out")

    def test_folder_is_as_any(self):
        """Readable as the user's other files are, made or replaced."""
        self.box.path("flat.map").write_bytes((MAPS / "flat.map").read_bytes())
        mask = os.umask(0o022)
        try:
            for _ in range(2):
                self.compare("flat.map", "--repeat", "1", "--solvers", "funnel")
                self.assertEqual(self.box.path("out").stat().st_mode & 0o777, 0o755)
                self.assertEqual(sorted(os.listdir(self.box.path("out"))), FILES)
                for name in FILES:
                    self.assertEqual(self.box.path("out/" + name).stat().st_mode & 0o777, 0o644)
        finally:
            os.umask(mask)

    def test_progress_names_the_run(self):
        self.box.path("hall.map").write_text(pillars(14))
        master, slave = os.openpty()
        process = self.box.start(["compare", "hall.map", "--time-limit", "1", "--methods", "dfs",
                                  "--solvers", "funnel,glpk"], stderr=slave)
        os.close(slave)
        text = sandbox.read_terminal(master).decode()
        process.communicate(timeout=30)
        self.assertRegex(text, r"\r\x1b\[K1/2 dfs with funnel: \d+/\d+ cells, ")
        self.assertRegex(text, r"\r\x1b\[K2/2 dfs with glpk: \d+/\d+ cells, ")


if __name__ == "__main__":
    BRIEF = "--brief" in sys.argv
    if BRIEF:
        sys.argv.remove("--brief")
    sandbox.main()
