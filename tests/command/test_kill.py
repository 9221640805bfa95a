"""kill -9 at any moment of what writes a file: the target is the old file or the new one, the next
run works, and what may be left beside it has a name of its own that no program takes for a file.

test_kill.py PROGRAM [--count N] [--seed S]

Half of the kills come at a random time of the run; half as soon as a file appears beside the
target, or a little later: so most of them hit the writing itself.
"""
import argparse
import os
import random
import re
import subprocess
import sys
import time
import unittest

import sandbox
from test_interrupt import pillars

OLDER = b"what was there before\n"


class Work:
    """A command that writes `target`. `old`: what lies there before; `news`: what may be after."""

    def __init__(self, name, words, target, old=OLDER):
        self.name, self.words, self.target, self.old = name, words, target, old
        self.new, self.seconds = None, None


class Kill(unittest.TestCase):
    def setUp(self):
        self.box = sandbox.Sandbox(PROGRAM)
        self.box.__enter__()
        self.addCleanup(self.box.__exit__)
        self.chance = random.Random(SEED)
        self.tally = {"killed": 0, "too late": 0, "old": 0, "new": 0, "left": 0}

    def run_well(self, *words):
        result = self.box.run([*words])
        self.assertEqual(result.status, 0, result.text())

    def bytes_of(self, name):
        return self.box.path(name).read_bytes()

    def prepare(self):
        """The inputs, and all work that is done on them."""
        box = self.box
        box.path("hall.map").write_text(pillars(7))
        bake = ["bake", "hall.map", "-q", "--threads", "1"]
        self.run_well(*bake, "-o", "whole.slv")
        for part in "12":
            self.run_well(*bake, "--shard", f"{part}/2", "-o", f"{part}.slv")
        # A shard is a bake that was begun. To go on with a finished one is to write it again.
        self.run_well(*bake, "--time-limit", "0.002", "-o", "begun.slv")
        begun = self.bytes_of("begun.slv")
        self.assertNotEqual(begun, self.bytes_of("whole.slv"), "the bake is over too soon")
        text = self.bytes_of("hall.map")
        box.path("own.map").write_bytes(text)
        return [
            Work("bake", [*bake, "-o", "out.slv"], "out.slv"),
            Work("bake without an older file", [*bake, "-o", "out.slv"], "out.slv", None),
            Work("shard", [*bake, "--shard", "1/2", "-o", "out.slv"], "out.slv"),
            Work("resume", [*bake, "--resume", "begun.slv", "-o", "begun.slv"], "begun.slv", begun),
            Work("merge", ["merge", "1.slv", "2.slv", "-q", "-o", "out.slv"], "out.slv"),
            Work("in place", ["convert", "own.map", "--in-place", "--clean"], "own.map", text),
            Work("export", ["export", "whole.slv", "-o", "out.json"], "out.json"),
        ]

    def put_older(self, work):
        path = self.box.path(work.target)
        if work.old is None:
            path.unlink(missing_ok=True)
        else:
            path.write_bytes(work.old)

    def start(self, work):
        self.put_older(work)
        return subprocess.Popen([PROGRAM, *work.words], cwd=self.box.folder,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def run_whole(self, work):
        began = time.monotonic()
        process = self.start(work)
        self.assertEqual(process.wait(timeout=60), 0, work.name)
        work.seconds = time.monotonic() - began
        new = self.bytes_of(work.target)
        if work.new is not None:
            self.assertEqual(new, work.new, f"{work.name}: other bytes after a kill")
        work.new = new

    def wait_for_a_file(self, process, names):
        while process.poll() is None and set(os.listdir(self.box.folder)) <= names:
            pass

    def kill_once(self, work):
        names = set(os.listdir(self.box.folder)) | {work.target}
        process = self.start(work)
        if self.chance.random() < 0.5:
            time.sleep(self.chance.uniform(0, work.seconds))
        else:
            self.wait_for_a_file(process, names)
            if self.chance.random() < 0.5:
                time.sleep(self.chance.uniform(0, work.seconds / 20))
        process.kill()
        self.tally["killed" if process.wait() < 0 else "too late"] += 1
        self.look(work, names)

    def look(self, work, names):
        path = self.box.path(work.target)
        there = path.read_bytes() if path.exists() else None
        self.assertIn(there, (work.old, work.new), f"{work.name}: neither the old file nor the new")
        self.tally["old" if there == work.old else "new"] += 1
        left = set(os.listdir(self.box.folder)) - names
        self.tally["left"] += len(left)
        for name in left:
            self.assertTrue(re.fullmatch(re.escape(work.target) + r"\.[A-Za-z0-9]{6}", name), name)

    def test_any_moment(self):
        works = self.prepare()
        for work in works:
            self.run_whole(work)
        # Twice: the first run of a program is slow.
        for work in works:
            self.run_whole(work)
        for i in range(COUNT):
            self.kill_once(works[i % len(works)])
        # What is left changes nothing; each gives its bytes.
        for work in works:
            self.run_whole(work)
        whole = self.bytes_of("whole.slv")
        for name in "resume", "merge":
            self.assertEqual(next(w.new for w in works if w.name == name), whole, name)
        self.assertGreater(self.tally["killed"], COUNT // 5, "kills come too late")
        if COUNT > 100:
            print(f"kills: {self.tally}", file=sys.stderr)


if __name__ == "__main__":
    PROGRAM = sandbox.program_argument()
    PARSER = argparse.ArgumentParser()
    PARSER.add_argument("--count", type=int, default=21)
    PARSER.add_argument("--seed", type=int, default=1)
    KNOWN, REST = PARSER.parse_known_args()
    COUNT, SEED = KNOWN.count, KNOWN.seed
    unittest.main(argv=[sys.argv[0], *REST])
