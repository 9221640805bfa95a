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

import sandbox
from sandbox import process_status, processor_seconds
from test_interrupt import endless, seconds_to_begin

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

    def start_all(self, count, *arguments, **variables):
        # A processor need not be there for each; the checks may run as root, in a container.
        start = ["mpirun", "-n", str(count), "--oversubscribe", "--allow-run-as-root"]
        environment = dict(os.environ, OMPI_MCA_btl_vader_single_copy_mechanism="none", **variables)
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


def runs(process):
    try:
        return process_status(process)[0] != "Z"
    except OSError:
        return False


@unittest.skipUnless(os.path.exists("/proc/self/environ"), "processes are not listed here")
class Interrupted(Processes):
    """One signal, to any process or to mpirun, stops all of them."""

    BAKE = ["bake", "hall.map", "--method", "dfs", "--threads", "1"]

    def setUp(self):
        super().setUp()
        # The bake takes minutes of a processor. Whatever is asked of it here takes seconds.
        (self.folder / "hall.map").write_text(endless())

    def start_bake(self, count, *options, **variables):
        bake = self.start_all(count, *self.BAKE, "-o", "part.slv", *options, **variables)
        return bake, ranks(bake, count)

    def begin_bake(self, count, *options, **variables):
        """Until all look from cells. They begin together: none works before all have read the map."""
        enough = seconds_to_begin(lambda words: self.done(self.run_one(*words)), self.BAKE)
        (self.folder / "begin.slv").unlink()
        bake, processes = self.start_bake(count, *options, **variables)
        for process in processes:
            sandbox.wait_for_work(process, enough)
        return bake, processes

    def interrupted(self, bake, processes, to, number, seconds=10):
        """Signals a rank, or mpirun itself where `to` is None. All must end before so many seconds."""
        self.assertIsNone(bake.poll(), "the bake is over too soon to be interrupted")
        asked = time.monotonic()
        os.kill(bake.pid if to is None else processes[to], number)
        out, told = bake.communicate(timeout=60)
        self.assertLess(time.monotonic() - asked, seconds, told)
        while any(map(runs, processes)):
            self.assertLess(time.monotonic() - asked, seconds, "processes still run")
            time.sleep(0.01)
        return bake.returncode, out, told

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_one_signal_stops_all(self):
        for count, to, number in ((2, 1, signal.SIGTERM), (3, 0, signal.SIGINT), (4, 2, signal.SIGTERM),
                                  (4, 3, signal.SIGINT), (3, None, signal.SIGTERM),
                                  (2, None, signal.SIGINT)):
            with self.subTest(count=count, to=to, number=number):
                status, out, told = self.interrupted(*self.begin_bake(count), to, number)
                self.assertNotEqual(status, 0)
                self.assertEqual(out, "")
                if to is not None:
                    self.assertEqual(told.count("sightline: interrupted"), 1, told)
                self.assertEqual(self.files(), ["hall.map"])

    def test_one_signal_keeps_what_was_found(self):
        for count, to, number in ((2, 1, signal.SIGTERM), (4, 0, signal.SIGINT),
                                  (4, 3, signal.SIGTERM), (3, 1, signal.SIGINT)):
            with self.subTest(count=count, to=to, number=number):
                begun = self.begin_bake(count, "--keep-partial")
                status, _, told = self.interrupted(*begun, to, number, 30)
                self.assertEqual(status, 0, told)
                self.kept()

    def test_mpirun_lets_them_keep_what_was_found(self):
        """It waits for so many seconds before it asks the processes to end, and again before it
        kills them."""
        begun = self.begin_bake(2, "--keep-partial", OMPI_MCA_odls_base_sigkill_timeout="8")
        self.interrupted(*begun, None, signal.SIGINT, 30)
        self.kept()

    def kept(self):
        self.assertEqual(self.files(), ["hall.map", "part.slv"])
        told = self.done(self.run_one("info", "part.slv")).stdout
        self.assertIn("what is not decided counts as seen", told)
        (self.folder / "part.slv").unlink()

    def test_a_second_signal_keeps_nothing(self):
        bake, processes = self.begin_bake(3, "--keep-partial")
        os.kill(processes[0], signal.SIGSTOP)  # so that it learns of both at once
        for _ in range(2):
            os.kill(processes[2], signal.SIGTERM)
            sandbox.wait_for_signal(processes[2], signal.SIGTERM)
        os.kill(processes[0], signal.SIGCONT)
        bake.communicate(timeout=60)
        self.assertNotEqual(bake.returncode, 0)
        self.assertEqual(self.files(), ["hall.map"])

    def test_early_signals(self):
        """While the map is read, or the others are not there yet."""
        for after in 0, 0.05, 0.1, 0.2, 0.4:
            for options in [], ["--keep-partial"]:
                with self.subTest(after=after, options=options):
                    begun = self.start_bake(3, *options)
                    time.sleep(after)
                    self.interrupted(*begun, 1, signal.SIGTERM, 30)
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
            before = [processor_seconds(each) for each in processes]
            time.sleep(2)
            used = [processor_seconds(each) - start for each, start in zip(processes, before)]
            os.kill(processes[held], signal.SIGCONT)
            _, told = bake.communicate(timeout=60)
            self.assertEqual(bake.returncode, 0, told)
            self.assertLess(max(used), 0.4, used)
            self.assertEqual((self.folder / "one.slv").read_bytes(),
                             (self.folder / "all.slv").read_bytes())


if __name__ == "__main__":
    unittest.main()
