"""Processes that share a bake write the same bytes as one, and fail as one.

test_mpi.py PROGRAM MPI_PROGRAM
"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from test_interrupt import pillars

PROGRAM, SHARED = (os.path.abspath(sys.argv.pop(1)) for _ in range(2))
MAPS = [["office", "--walls", "1000"], ["city", "--walls", "600", "--turned", "20"],
        ["city", "--walls", "600", "--turned-exact", "20"]]


class Processes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sightline-mpi-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_one(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True,
                              text=True, timeout=120)

    def start_all(self, count, *arguments):
        # A processor need not be there for each; the checks may run as root, in a container.
        start = ["mpirun", "-n", str(count), "--oversubscribe", "--allow-run-as-root"]
        environment = dict(os.environ, OMPI_MCA_btl_vader_single_copy_mechanism="none")
        return subprocess.Popen([*start, SHARED, *arguments], cwd=self.folder, env=environment,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def run_all(self, count, *arguments):
        started = self.start_all(count, *arguments)
        out, told = started.communicate(timeout=120)
        return subprocess.CompletedProcess(started.args, started.returncode, out, told)

    def done(self, result):
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result


class Shared(Processes):
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


def ranks(mpirun, count):
    """The processes that mpirun started, by their rank, once all are there."""
    wanted, found = {str(rank) for rank in range(count)}, {}
    while set(found) != wanted:
        time.sleep(0.01)
        children = pathlib.Path(f"/proc/{mpirun.pid}/task/{mpirun.pid}/children").read_text()
        for child in children.split():
            try:
                words = pathlib.Path(f"/proc/{child}/environ").read_bytes().split(b"\0")
            except OSError:
                continue
            found |= {word[21:].decode(): int(child) for word in words
                      if word.startswith(b"OMPI_COMM_WORLD_RANK=")}
    return [found[str(rank)] for rank in range(count)]


def status(process):
    """The fields of its status from its state on."""
    return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()


def runs(process):
    try:
        return status(process)[0] != "Z"
    except OSError:
        return False


def seconds(process):
    """The time of a processor that a process has used."""
    fields = status(process)
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


@unittest.skipUnless(os.path.exists("/proc/self/environ"), "processes are not listed here")
class Interrupted(Processes):
    """One signal, to any process or to mpirun, stops all of them."""

    def setUp(self):
        super().setUp()
        (self.folder / "hall.map").write_text(pillars(24))

    def interrupted(self, count, to, number, after, *options):
        """Signals a rank, or mpirun itself where `to` is None, once the bake is `after` seconds old."""
        bake = self.start_all(count, "bake", "hall.map", "--method", "dfs", "--threads", "1",
                              "-o", "part.slv", *options)
        processes = ranks(bake, count)
        time.sleep(after)
        self.assertIsNone(bake.poll(), "the bake is over too soon to be interrupted")
        asked = time.monotonic()
        os.kill(bake.pid if to is None else processes[to], number)
        out, told = bake.communicate(timeout=60)
        self.assertLess(time.monotonic() - asked, 10, told)
        while any(map(runs, processes)):
            self.assertLess(time.monotonic() - asked, 10, "processes still run")
            time.sleep(0.01)
        return bake.returncode, out, told

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_one_signal_stops_all(self):
        for count, to, number, after in ((2, 1, signal.SIGTERM, 1), (3, 0, signal.SIGINT, 1.5),
                                         (4, 2, signal.SIGTERM, 2), (4, 3, signal.SIGINT, 1),
                                         (3, None, signal.SIGTERM, 1), (2, None, signal.SIGINT, 2)):
            with self.subTest(count=count, to=to, number=number):
                status, out, told = self.interrupted(count, to, number, after)
                self.assertNotEqual(status, 0)
                self.assertEqual(out, "")
                if to is not None:
                    self.assertEqual(told.count("sightline: interrupted"), 1, told)
                self.assertEqual(self.files(), ["hall.map"])

    def test_one_signal_keeps_what_was_found(self):
        for count, to, number, after in ((2, 1, signal.SIGTERM, 1), (4, 0, signal.SIGINT, 2),
                                         (4, 3, signal.SIGTERM, 1.5), (3, 1, signal.SIGINT, 1),
                                         (3, None, signal.SIGTERM, 1.5), (2, None, signal.SIGINT, 1)):
            with self.subTest(count=count, to=to, number=number):
                status, _, told = self.interrupted(count, to, number, after, "--keep-partial")
                if to is not None:
                    self.assertEqual(status, 0, told)
                self.assertEqual(self.files(), ["hall.map", "part.slv"])
                told = self.done(self.run_one("info", "part.slv")).stdout
                self.assertIn("what is not decided counts as seen", told)
                (self.folder / "part.slv").unlink()

    def test_a_second_signal_keeps_nothing(self):
        bake = self.start_all(3, "bake", "hall.map", "--method", "dfs", "--threads", "1",
                              "-o", "part.slv", "--keep-partial")
        processes = ranks(bake, 3)
        time.sleep(1)
        os.kill(processes[0], signal.SIGSTOP)  # so that it learns of both at once
        os.kill(processes[2], signal.SIGTERM)
        time.sleep(0.2)
        os.kill(processes[2], signal.SIGTERM)
        time.sleep(0.2)
        os.kill(processes[0], signal.SIGCONT)
        bake.communicate(timeout=60)
        self.assertNotEqual(bake.returncode, 0)
        self.assertEqual(self.files(), ["hall.map"])

    def test_early_signals(self):
        """While the map is read, or the others are not there yet."""
        for after in 0, 0.05, 0.1, 0.2, 0.4:
            for options in [], ["--keep-partial"]:
                with self.subTest(after=after, options=options):
                    self.interrupted(3, 1, signal.SIGTERM, after, *options)
                    self.assertLessEqual(set(self.files()), {"hall.map", "part.slv"})
                    if "part.slv" in self.files():
                        self.assertTrue(options)
                        self.done(self.run_one("info", "part.slv"))
                        (self.folder / "part.slv").unlink()

    def test_waiting_takes_no_core(self):
        self.done(self.run_one("generate", *MAPS[0], "-o", "a.map", "-q"))
        self.done(self.run_one("bake", "a.map", "-o", "one.slv", "-q"))
        for held in 0, 2:
            bake = self.start_all(3, "bake", "a.map", "-o", "all.slv", "-q", "--threads", "1")
            processes = ranks(bake, 3)
            os.kill(processes[held], signal.SIGSTOP)
            time.sleep(3)  # the others come to wait
            before = [seconds(each) for each in processes]
            time.sleep(2)
            used = [seconds(each) - start for each, start in zip(processes, before)]
            os.kill(processes[held], signal.SIGCONT)
            _, told = bake.communicate(timeout=60)
            self.assertEqual(bake.returncode, 0, told)
            self.assertLess(max(used), 0.4, used)
            self.assertEqual((self.folder / "one.slv").read_bytes(),
                             (self.folder / "all.slv").read_bytes())


if __name__ == "__main__":
    unittest.main()
