"""Processes that share a bake write the same bytes as one, and fail as one.

test_mpi.py PROGRAM MPI_PROGRAM
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SHARED = (os.path.abspath(sys.argv.pop(1)) for _ in range(2))
MAPS = [["office", "--walls", "1000"], ["city", "--walls", "600", "--turned", "20"],
        ["city", "--walls", "600", "--turned-exact", "20"]]


class Shared(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sightline-mpi-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_one(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True,
                              text=True, timeout=120)

    def run_all(self, count, *arguments):
        # A processor need not be there for each; the checks may run as root, in a container.
        start = ["mpirun", "-n", str(count), "--oversubscribe", "--allow-run-as-root"]
        environment = dict(os.environ, OMPI_MCA_btl_vader_single_copy_mechanism="none")
        return subprocess.run([*start, SHARED, *arguments], cwd=self.folder, capture_output=True,
                              text=True, timeout=120, env=environment)

    def done(self, result):
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result

    def test_same_bytes(self):
        for number, kind in enumerate(MAPS):
            self.done(self.run_one("generate", *kind, "-o", f"{number}.map", "-q"))
            for how in [], ["--sight", "open"], ["--method", "dfs"], ["--inside"]:
                self.done(self.run_one("bake", f"{number}.map", "-o", "one.slv", "-q", *how))
                for count in (3,) if how else (1, 3, 4):
                    self.done(self.run_all(count, "bake", f"{number}.map", "-o", "all.slv", "-q",
                                           "--threads", "1", *how))
                    with self.subTest(kind=kind, how=how, count=count):
                        self.assertEqual((self.folder / "one.slv").read_bytes(),
                                         (self.folder / "all.slv").read_bytes())
                        (self.folder / "all.slv").unlink()

    def test_stopped_and_gone_on_with(self):
        self.done(self.run_one("generate", *MAPS[0], "-o", "a.map", "-q"))
        self.done(self.run_one("bake", "a.map", "-o", "one.slv", "-q"))
        stopped = self.done(self.run_all(4, "bake", "a.map", "-o", "part.slv", "--time-limit", "1e-9"))
        self.assertIn("what is not decided counts as seen", stopped.stdout)
        self.done(self.run_all(4, "bake", "a.map", "-o", "part.slv", "--resume", "part.slv", "-q"))
        self.assertEqual((self.folder / "one.slv").read_bytes(),
                         (self.folder / "part.slv").read_bytes())

    def test_one_report(self):
        self.done(self.run_one("generate", *MAPS[0], "-o", "a.map", "-q"))
        report = self.done(self.run_all(4, "bake", "a.map", "-o", "a.slv")).stdout
        self.assertEqual(report.count("baked from a.map"), 1)

    def test_failures_are_told_once(self):
        for arguments, says in ((["bake", "none.map"], "none.map"), (["bake"], "MAP is missing"),
                                (["info", "none.map"], "'bake' alone")):
            result = self.run_all(3, *arguments)
            self.assertEqual(result.returncode, 2, result.stderr)
            told = [line for line in result.stderr.splitlines() if line.startswith("sightline: ")]
            self.assertEqual(len(told), 1, result.stderr)
            self.assertIn(says, told[0])


if __name__ == "__main__":
    unittest.main()
