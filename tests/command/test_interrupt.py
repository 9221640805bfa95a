"""Ctrl-C and SIGTERM during a long bake: status 1, one line, no file and nothing left beside it.

test_interrupt.py PROGRAM
"""
import json
import resource
import signal
import time
import unittest

import sandbox


def pillars(count, wide=1):
    """A hall of pillars, none quite in line: portal sequences without end."""
    side = 4 * count
    lines = ["sightline 1", f"walls 0 0 {side} 0 {side} {side} 0 {side} 0 0"]
    for i in range(count):
        for j in range(count):
            x, y = 4 * i + 1 + j % 3 / 4, 4 * j + 1 + i % 3 / 4
            lines.append(f"walls {x} {y} {x + wide} {y} {x + wide} {y + wide} {x} {y + wide} {x} {y}")
    return "\n".join(lines) + "\n"


def endless():
    """Slim pillars: to look from all cells takes minutes of a processor. To read the map and to
    write the little that is found takes a moment."""
    return pillars(20, 1 / 16)


def seconds_to_begin(run, bake):
    """Time of processors after which a bake looks from cells: it takes less to do all but that."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run([*bake, "--shard", "1/2", "--time-limit", "1e-9", "-o", "begin.slv"])
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime + 0.2


class Interrupt(unittest.TestCase):
    def interrupted(self, number, *options, old=None):
        with sandbox.Sandbox(PROGRAM) as box:
            box.path("hall.map").write_text(endless())
            if old:
                box.path("hall.slv").write_text(old)
            before = box.files()
            process = box.start(["bake", "hall.map", "-o", "hall.slv", "--method", "dfs", *options])
            sandbox.wait_for_work(process.pid)
            asked = time.monotonic()
            process.send_signal(number)
            result = box.finish(process, before, timeout=30)
            self.assertLess(time.monotonic() - asked, 10)
            self.assertEqual((result.status, result.stdout), (1, ""))
            self.assertEqual(result.stderr, "sightline: interrupted\n")
            self.assertEqual(box.files(), before)

    def test_ctrl_c(self):
        self.interrupted(signal.SIGINT)

    def test_terminate(self):
        self.interrupted(signal.SIGTERM, "--threads", "1")

    def test_old_file_stays(self):
        self.interrupted(signal.SIGINT, "--threads", "3", "--stab-trees", old="an older file")

    def test_kept(self):
        """With --keep-partial the first Ctrl-C writes what there is, which can be gone on with."""
        with sandbox.Sandbox(PROGRAM) as box:
            box.path("hall.map").write_text(endless())
            bake = ["bake", "hall.map", "--method", "dfs", "--threads", "2", "--json"]
            enough = seconds_to_begin(box.run, bake)
            before = box.files()
            process = box.start([*bake, "--keep-partial", "-o", "part.slv"])
            sandbox.wait_for_work(process.pid, enough)
            process.send_signal(signal.SIGINT)
            result = box.finish(process, before, timeout=60)
            self.assertEqual((result.status, result.new_files), (0, ["part.slv"]))
            told = json.loads(result.stdout)
            self.assertEqual((told["finished"], told["guarantee"]), (False, "conservative"))
            self.assertLess(told["work"]["done"], told["work"]["count"])
            result = box.run(["info", "part.slv"])
            self.assertIn("what is not decided counts as seen", result.stdout)

    def test_killed_shard(self):
        """A part that is killed leaves nothing; run again it gives the whole all the same."""
        with sandbox.Sandbox(PROGRAM) as box:
            box.path("hall.map").write_text(pillars(14))
            bake = ["bake", "hall.map", "--method", "dfs", "--threads", "1", "-q"]
            self.assertEqual(box.run([*bake, "-o", "whole.slv"]).status, 0)
            for part in "1", "2", "3":
                if part == "2":
                    before = box.files()
                    process = box.start([*bake, "--shard", "2/3", "-o", "2.slv"])
                    sandbox.wait_for_work(process.pid, 0.02)
                    process.kill()
                    process.communicate()
                    self.assertEqual(box.files(), before)
                    result = box.run(["merge", "1.slv", "-o", "merged.slv"])
                    self.assertEqual(result.stderr,
                                     "sightline: of 3 shards 2 are missing: 2, 3\n")
                result = box.run([*bake, "--shard", f"{part}/3", "-o", f"{part}.slv"])
                self.assertEqual(result.status, 0)
            result = box.run(["merge", "1.slv", "3.slv", "2.slv", "-o", "merged.slv"])
            self.assertEqual(result.status, 0)
            self.assertEqual(box.path("merged.slv").read_bytes(),
                             box.path("whole.slv").read_bytes())

    def test_kept_stops_at_the_second(self):
        with sandbox.Sandbox(PROGRAM) as box:
            box.path("hall.map").write_text(endless())
            bake = ["bake", "hall.map", "--method", "dfs"]
            enough = seconds_to_begin(box.run, bake)
            before = box.files()
            process = box.start([*bake, "--keep-partial"])
            sandbox.wait_for_work(process.pid, enough)
            process.send_signal(signal.SIGINT)
            sandbox.wait_for_signal(process.pid, signal.SIGINT)
            process.send_signal(signal.SIGINT)
            result = box.finish(process, before, timeout=60)
            self.assertEqual((result.status, result.stdout), (1, ""))
            self.assertEqual(result.stderr, "sightline: interrupted\n")
            self.assertEqual(box.files(), before)

    def test_compare_eye(self):
        with sandbox.Sandbox(PROGRAM) as box:
            box.path("hall.map").write_text(pillars(3))
            before = box.files()
            process = box.start(["compare", "hall.map", "--eye", "--viewpoints", "10000000",
                                 "-o", "out"])
            sandbox.wait_for_work(process.pid)
            process.send_signal(signal.SIGINT)
            result = box.finish(process, before, timeout=30)
            self.assertEqual((result.status, result.stdout), (1, ""))
            self.assertEqual(result.stderr, "sightline: interrupted\n")
            self.assertEqual(box.files(), before)

    def test_ignored_signal_stays_ignored(self):
        """As under nohup, or in the background of a shell script."""
        with sandbox.Sandbox("/bin/sh") as box:
            box.path("flat.map").write_text("sightline 1\nwalls 0 0 4 0 4 3 0 3 0 0\n")
            result = box.run(["-c", f'trap "" INT; kill -INT $$; "{PROGRAM}" bake flat.map -q'])
            self.assertEqual(result.status, 0)


if __name__ == "__main__":
    PROGRAM = sandbox.program_argument()
    unittest.main()
