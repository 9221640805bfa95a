"""Files, pipes and links as Unix programs treat them: what goes in, what comes out, what stays.

test_files.py PROGRAM
"""
import os
import signal
import subprocess
import threading

import sandbox
from test_interrupt import endless

ROOM = "sightline 1\nwalls 0 0 4 0 4 3 0 3 0 0\nwall 2 0 2 2\nstart 1 1 0\n"


class Files(sandbox.ProgramTest):
    def setUp(self):
        super().setUp()
        self.box.path("room.map").write_text(ROOM)

    def baked(self):
        self.run_well("bake", "room.map", "-o", "room.slv", "-q")
        return self.box.path("room.slv").read_bytes()

    def fed(self, content, *arguments):
        """A run whose word FIFO is a named pipe with this content, and which then has to be done."""
        pipe = self.box.folder / "pipe"
        os.mkfifo(pipe)
        def feed():
            with open(pipe, "wb") as stream:
                try:
                    stream.write(content)
                except BrokenPipeError:
                    pass
        feeder = threading.Thread(target=feed, daemon=True)
        feeder.start()
        words = [self.program, *("pipe" if word == "FIFO" else word for word in arguments)]
        result = subprocess.run(words, cwd=self.box.folder, capture_output=True, timeout=20,
                                check=False)
        feeder.join(timeout=5)
        os.unlink(pipe)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    # --- input

    def test_pipe_is_read_like_a_file(self):
        for command in (["info"], ["check"], ["convert"], ["isovist", "--at", "1,1"],
                        ["viewcells"], ["walk", "--steps", "3", "--repeat", "1"]):
            with self.subTest(command):
                self.assertTrue(self.fed(ROOM.encode(), command[0], "FIFO", *command[1:]))

    def test_pipe_of_bytes(self):
        """A format that is told by its bytes."""
        picture = bytearray(b"P5 5 4 255\n" + bytes(5) + b"\0\xff\xff\xff\0" * 2 + bytes(5))
        self.box.path("room.pgm").write_bytes(picture)
        converted = self.run_well("convert", "room.pgm").stdout.splitlines()
        walls = [line for line in converted if not line.startswith("#")]
        out = self.fed(bytes(picture), "convert", "FIFO").decode().splitlines()
        self.assertEqual([line for line in out if not line.startswith("#")], walls)
        self.assertIn(b"a map", self.fed(bytes(picture), "info", "FIFO"))

    def test_pipe_of_a_baked_file(self):
        content = self.baked()
        self.assertIn(b"a baked file", self.fed(content, "info", "FIFO"))
        self.assertEqual(self.fed(content, "export", "FIFO"),
                         self.run_well("export", "room.slv").stdout.encode())
        self.assertEqual(self.fed(content, "convert", "FIFO"),
                         self.run_well("convert", "room.slv").stdout.encode())
        self.assertEqual(self.fed(content, "isovist", "FIFO", "--at", "1,1"),
                         self.run_well("isovist", "room.slv", "--at", "1,1").stdout.encode())
        self.fed(content, "check", "FIFO")

    def test_standard_input_by_its_device(self):
        with open(self.box.path("room.map"), "rb") as stdin:
            result = self.run_well("info", "/dev/stdin", stdin=stdin)
        self.assertIn("a map", result.stdout)
        content = self.baked()
        with open(self.box.path("room.slv"), "rb") as stdin:
            result = self.run_well("info", "-", stdin=stdin)
        self.assertIn("a baked file", result.stdout)
        self.assertIn(f"{len(content)}"[:1], result.stdout)

    def test_no_input_is_overwritten(self):
        os.symlink("room.map", self.box.path("room_link.map"))
        os.link(self.box.path("room.map"), self.box.path("room_hard.map"))
        self.baked()
        os.symlink("room.slv", self.box.path("picture.png"))
        self.box.path("eyes.csv").write_text("x,y\n1,1\n")
        for words in (["convert", "room.map", "-o", "room.map"],
                      ["convert", "room.map", "-o", "room_link.map"],
                      ["convert", "room_link.map", "-o", "room.map"],
                      ["convert", "room.map", "-o", "./room_hard.map"],
                      ["check", "room.map", "--snap", "room_link.map"],
                      ["draw", "room.slv", "-o", "picture.png"],
                      ["merge", "room.slv", "-o", "room.slv"],
                      ["isovist", "room.map", "--points", "eyes.csv", "-o", "eyes.csv"]):
            with self.subTest(words):
                result = self.box.run(words)
                self.assertEqual(result.status, 2)
                self.assertIn("is the input itself", result.stderr)
        with open(self.box.path("room.map"), "rb") as stdin:
            result = self.box.run(["convert", "-", "-o", "room.map"], stdin=stdin)
        self.assertEqual(result.status, 2)
        os.symlink("room.map", self.box.path("link.slv"))
        result = self.box.run(["bake", "room.map", "-o", "link.slv"])
        self.assertEqual(result.status, 2)
        self.assertIn("is the input itself", result.stderr)

    def test_two_outputs_with_one_name(self):
        result = self.box.run(["walk", "room.map", "--table", "a.csv", "--frames", "./a.csv"])
        self.assertEqual(result.status, 0)
        result = self.box.run(["walk", "room.map", "--table", "a.csv", "--frames", "./a.csv"])
        self.assertEqual((result.status, result.stdout), (2, ""))
        self.assertIn("both write to", result.stderr)

    def test_in_place(self):
        os.symlink("room.map", self.box.path("link.map"))
        os.chmod(self.box.path("room.map"), 0o640)
        self.run_well("convert", "link.map", "--in-place", "--clean")
        self.assertTrue(self.box.path("link.map").is_symlink())
        text = self.box.path("room.map").read_text()
        self.assertTrue(text.startswith("sightline 1\nwall "), text)
        self.assertEqual(self.box.path("room.map").stat().st_mode & 0o777, 0o640)
        self.run_well("convert", "room.map", "--in-place", "-o", "room.map")
        for words in (["convert", "room.map", "--in-place", "-o", "other.map"],
                      ["convert", "-", "--in-place"], ["convert", "missing.map", "--in-place"]):
            self.assertEqual(self.box.run(words).status, 2, words)

    # --- output

    def test_link_stays_a_link(self):
        (self.box.folder / "store").mkdir()
        real = self.box.folder / "store" / "real.map"
        link = self.box.folder / "link.map"
        os.symlink("store/real.map", link)
        for mode in 0o644, 0o600, 0o664:  # the first time the link leads to nothing
            self.run_well("convert", "room.map", "-o", "link.map")
            self.assertTrue(link.is_symlink())
            self.assertTrue(real.read_text().startswith("sightline 1"))
            os.chmod(real, mode)
            self.run_well("convert", "room.map", "-o", "link.map")
            self.assertEqual(real.stat().st_mode & 0o777, mode)
        self.assertEqual(sorted(os.listdir(self.box.folder / "store")), ["real.map"])

    def test_link_to_itself(self):
        os.symlink("loop.map", self.box.folder / "loop.map")
        result = subprocess.run([self.program, "convert", "room.map", "-o", "loop.map"],
                                cwd=self.box.folder, capture_output=True, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertTrue((self.box.folder / "loop.map").is_symlink())

    def test_links_in_a_folder_of_results(self):
        (self.box.folder / "store").mkdir()
        self.run_well("compare", "room.map", "--methods", "dfs", "--repeat", "1", "-o",
                      "out")
        names = sorted(os.listdir(self.box.folder / "out"))
        table = next(name for name in names if name.endswith(".csv"))
        os.rename(self.box.folder / "out" / table, self.box.folder / "store" / table)
        os.symlink("../store/" + table, self.box.folder / "out" / table)
        (self.box.folder / "store" / table).write_text("older")
        self.run_well("compare", "room.map", "--methods", "dfs", "--repeat", "1", "-o",
                      "out")
        self.assertTrue((self.box.folder / "out" / table).is_symlink())
        self.assertNotEqual((self.box.folder / "store" / table).read_text(), "older")
        self.assertEqual(sorted(os.listdir(self.box.folder / "out")), names)

    def test_pipe_as_output(self):
        pipe = self.box.folder / "pipe.map"
        os.mkfifo(pipe)
        process = subprocess.Popen([self.program, "convert", "room.map", "-o", "pipe.map"],
                                   cwd=self.box.folder)
        text = pipe.read_text()
        self.assertEqual(process.wait(timeout=20), 0)
        self.assertTrue(text.startswith("sightline 1"))
        self.assertTrue(pipe.is_fifo())

    def test_device_as_output(self):
        result = self.run_well("convert", "room.map", "-o", "/dev/stdout")
        self.assertTrue(result.stdout.startswith("sightline 1"))
        result = self.run_well("isovist", "room.map", "--at", "1,1", "-o", "/dev/null")
        result = self.box.run(["convert", "room.map", "-o", "/dev/full"])
        self.assertEqual((result.status, result.stdout), (1, ""))
        self.assertIn("/dev/full: cannot write: No space left on device", result.stderr)

    def test_read_only_file_is_not_replaced(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everything")
        target = self.box.path("kept.map")
        target.write_text("older")
        os.chmod(target, 0o444)
        result = self.box.run(["convert", "room.map", "-o", "kept.map"])
        self.assertEqual(result.status, 1)
        self.assertIn("kept.map: cannot write: Permission denied", result.stderr)

    # --- signals, and a reader that goes away

    def test_reader_goes_away(self):
        self.run_well("generate", "office", "--walls", "5000", "-o", "big.map", "-q")
        for words in (["convert", "big.map"], ["convert", "big.map", "-o", "/dev/stdout"]):
            process = subprocess.Popen([self.program, *words], cwd=self.box.folder,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertEqual(process.stdout.readline(), b"sightline 1\n")
            process.stdout.close()
            self.assertEqual(process.stderr.read(), b"")
            process.stderr.close()
            self.assertEqual(process.wait(timeout=20), 1)

    def test_hangup_counts_as_ctrl_c(self):
        self.box.path("hall.map").write_text(endless())
        before = self.box.files()
        process = self.box.start(["bake", "hall.map", "-o", "hall.slv", "--method", "dfs"])
        sandbox.wait_for_work(process.pid)
        process.send_signal(signal.SIGHUP)
        result = self.box.finish(process, before, timeout=30)
        self.assertEqual((result.status, result.stderr), (1, "sightline: interrupted\n"))
        self.assertEqual(self.box.files(), before)

    def test_waiting_for_a_pipe_is_interrupted(self):
        os.mkfifo(self.box.folder / "pipe")
        process = subprocess.Popen([self.program, "info", "pipe"], cwd=self.box.folder,
                                   stderr=subprocess.PIPE)
        sandbox.wait_for_sleep(process.pid, signal.SIGINT)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=5)
        self.assertEqual((process.returncode, said), (1, b"sightline: interrupted\n"))


if __name__ == "__main__":
    sandbox.main()
