"""The progress line: on a terminal only, one line, written over, cleared at the end.

test_terminal.py PROGRAM
"""
import fcntl
import os
import re
import signal
import struct
import termios
import time
import unittest

import sandbox
from test_interrupt import endless

LINE = b"cell to cell: "


class Terminal(unittest.TestCase):
    def talk(self, *options, environment=None, shows=b"", columns=0):
        """What a bake says to a terminal, and its status, if it is interrupted at work and after it
        says something."""
        with sandbox.Sandbox(PROGRAM) as box:
            box.path("hall.map").write_text(endless())
            master, slave = os.openpty()
            fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
            process = box.start(["bake", "hall.map", "--method", "dfs", *options], stderr=slave,
                                environment=environment)
            os.close(slave)
            began, text = time.monotonic(), b""
            while shows not in text:
                text += os.read(master, 65536)
            sandbox.wait_for_work(process.pid)
            self.seconds = time.monotonic() - began
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=30)
            return (text + sandbox.read_terminal(master)).decode(), process.returncode

    def test_line(self):
        text, status = self.talk(shows=LINE)
        self.assertEqual(status, 1)
        shown = text.split("\r\x1b[K")
        lines = [line for line in shown if line.startswith("cell to cell: ")]
        self.assertTrue(lines, text)
        for line in lines:
            self.assertRegex(line, r"^cell to cell: \d+/\d+ cells, \d+ %, .*\d+ (s|min|h)( left)?$")
            self.assertLess(len(line), 80)
        # At most ten times a second, and the last thing before the message is to clear the line.
        self.assertLess(len(lines), self.seconds * 10 + 5)
        self.assertEqual(shown[-1], "sightline: interrupted\r\n")

    def test_segments(self):
        """A large network: the line moves on, and an interrupt ends the work at once, without a table."""
        streets = [f"wall {x} {y} {x + 1 - d} {y + d}" for x in range(60) for y in range(60) for d in (0, 1)]
        with sandbox.Sandbox(PROGRAM) as box:
            box.path("streets.map").write_text("sightline 1\n" + "\n".join(streets) + "\n")
            master, slave = os.openpty()
            process = box.start(["segments", "streets.map", "-o", "streets.csv"], stderr=slave)
            os.close(slave)
            text, done = b"", []
            while len(set(done)) < 3:
                text += os.read(master, 65536)
                done = [int(n) for n in re.findall(rb"segment measures: (\d+)/\d+ chains", text)]
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=30)
            self.assertEqual(process.returncode, 1)
            self.assertEqual(done, sorted(done))
            self.assertFalse(box.path("streets.csv").exists())
            shown = (text + sandbox.read_terminal(master)).decode().split("\r\x1b[K")
            self.assertEqual(shown[-1], "sightline: interrupted\r\n")

    def test_narrow_terminal(self):
        text, _ = self.talk(shows=LINE, columns=24)
        lines = [line for line in text.split("\r\x1b[K") if line.startswith("cell to cell: ")]
        self.assertTrue(lines, text)
        for line in lines:
            self.assertEqual(len(line), 23)

    def test_quiet(self):
        self.assertEqual(self.talk("--quiet")[0], "sightline: interrupted\r\n")

    def test_dumb_terminal(self):
        text, _ = self.talk(environment={"TERM": "dumb"})
        self.assertEqual(text, "sightline: interrupted\r\n")


if __name__ == "__main__":
    PROGRAM = sandbox.program_argument()
    unittest.main()
