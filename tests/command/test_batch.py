"""Many plans, one table: rows as the command itself gives them, plans that fail, what is resumed,
Ctrl-C, and names of files.

test_batch.py PROGRAM
"""
import contextlib
import csv
import io
import json
import os
import pathlib
import signal
import statistics

import sandbox
from test_interrupt import endless

ROOM = "sightline 1\nwalls 0 0 {w} 0 {w} 4 0 4 0 0\n"


class Batch(sandbox.ProgramTest):
    def setUp(self):
        super().setUp()
        for width in 4, 6, 8:
            self.box.path(f"room {width}.map").write_text(ROOM.format(w=width))
        self.write_list("room 4.map", "# a comment", "", "room 6.map\r", "room 8.map")

    def write_list(self, *lines):
        self.box.path("list").write_text("\n".join(lines) + "\n")

    def run_batch(self, *words, status=0):
        """Not as other commands: where a plan fails, the table is written all the same."""
        return self.finish(self.box.start(["batch", *words]), status)

    def finish(self, process, status):
        stdout, stderr = (text.decode() for text in process.communicate(timeout=60))
        result = sandbox.Result(process.returncode, stdout, stderr, [])
        self.assertEqual(result.status, status, result.text())
        told = [line for line in stderr.splitlines() if not line.startswith("note: ")]
        self.assertEqual(len(told), status in (1, 2), result.text())
        return result

    def rows(self, text=None, path="t.csv"):
        text = self.box.path(path).read_text() if text is None else text
        rows = list(csv.reader(io.StringIO(text)))
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        return [dict(zip(rows[0], row)) for row in rows[1:]]

    def test_rows_are_the_commands_json(self):
        rows = self.rows(self.run_batch("info", "list", "--jobs", "2").stdout)
        self.assertEqual([row["plan"] for row in rows], ["room 4.map", "room 6.map", "room 8.map"])
        for row in rows:
            told = json.loads(self.box.run(["info", row["plan"], "--json"]).stdout)
            self.assertEqual(row["walls"], str(told["walls"]))
            self.assertEqual(row["cleaning.after"], str(told["cleaning"]["after"]))
            self.assertEqual(row["effects.door"], "false")
            self.assertEqual(float(row["range"]), told["range"])
            flat = [key for key, value in told.items() if not isinstance(value, (list, dict))]
            self.assertEqual([key for key in flat if key not in row], [])

    def test_rows_are_means_of_the_commands_table(self):
        self.run_batch("vga", "list", "-o", "t.csv", "--", "--grid", "1")
        for row in self.rows():
            table = self.box.run(["vga", row["plan"], "--grid", "1", "-q"]).stdout
            points = list(csv.DictReader(io.StringIO(table)))
            self.assertEqual(int(row["rows"]), len(points))
            for name in "x", "connectivity", "point_first_moment":
                values = [float(point[name]) for point in points]
                self.assertAlmostEqual(float(row[name + "_mean"]), statistics.fmean(values), 12)
                self.assertAlmostEqual(float(row[name + "_deviation"]) ** 2,
                                       statistics.pvariance(values), 9)

    def test_figures_of_a_grid_in_parts_are_those_of_the_summary(self):
        self.box.path("two.map").write_text(
            "sightline 1\nwalls 0 0 8 0 8 8 0 8 0 0\nwalls 10 0 13 0 13 3 10 3 10 0\n")
        self.write_list("two.map")
        options = ["--grid", "1", "--measures", "visual,isovist"]
        row, = self.rows(self.run_batch("vga", "list", "--", *options).stdout)
        told = self.box.run(["vga", "two.map", *options, "-o", "two.csv"]).stdout
        self.assertIn("in 2 parts", told)
        means = {words[0]: words[1:] for words in map(str.split, told.splitlines())
                 if len(words) == 3 and row.get(words[0] + "_mean")}
        self.assertGreater(len(means), 10)
        for name, figures in means.items():
            self.assertEqual([f"{float(row[name + end]):.6g}" for end in ("_mean", "_deviation")],
                             figures, name)
        points = list(csv.DictReader(io.StringIO(self.box.path("two.csv").read_text())))
        self.assertEqual((int(row["rows"]), row["parts"]), (len(points), "2"))
        self.assertEqual(int(row["largest_part_rows"]),
                         sum(point["part"] == "1" for point in points))
        self.assertNotIn("part_mean", row)

    def test_a_plan_that_fails_is_passed_over(self):
        self.box.path("bad.map").write_text('sightline 1\nwalls 1 2 "x,y"\n')
        self.write_list("room 4.map", "bad.map", "no such.map", "room 8.map")
        result = self.run_batch("bake", "list", "-o", "t.csv", "--", "-o", "{}.slv", status=2)
        self.assertIn("sightline: 2 of 4 plans failed; the table says why\n", result.stderr)
        rows = self.rows()
        self.assertEqual([row["exit_status"] for row in rows], ["0", "2", "2", "0"])
        self.assertRegex(rows[1]["message"], "^bad.map:2: ")
        self.assertRegex(rows[2]["message"], "^no such.map: ")
        self.assertEqual((rows[0]["output"], rows[1]["output"]), ("room 4.slv", ""))
        self.assertEqual(sorted(name for name in self.box.files() if name.endswith(".slv")),
                         ["room 4.slv", "room 8.slv"])
        self.write_list("room 8.map")
        result = self.run_batch("bake", "list", "--", "-o", "nowhere/{}.slv", status=1)
        self.assertEqual([row["exit_status"] for row in self.rows(result.stdout)], ["1"])
        self.write_list("room 8.map")
        self.assertEqual(self.rows(self.run_batch("info", "list", "--", "--help", status=2).stdout)[0]
                         ["message"], "the command has printed no JSON object")

    def test_a_fault_that_a_check_finds_is_an_answer(self):
        self.box.path("open.map").write_text("sightline 1\nwalls 0 0 9 0 9 9 0 9 0 0.01\nstart 4 4 0\n")
        self.write_list("open.map", "room 4.map")
        rows = self.rows(self.run_batch("check", "list", "--", "--strict", status=3).stdout)
        self.assertEqual(rows[0]["exit_status"], "3")
        self.assertGreater(int(rows[0]["counts.leak"]) + int(rows[0]["counts.gap"]), 0)

    def test_resume_runs_what_is_missing_or_has_changed(self):
        command = ["bake", "list", "-o", "t.csv", "--resume", "--", "-o", "{}.slv", "-q"]
        self.run_batch(*command)
        whole = self.box.path("t.csv").read_text()
        lines = whole.splitlines(keepends=True)

        def made_again(*given):
            for path in self.box.folder.glob("*.slv"):
                path.unlink()
            self.run_batch(*(given or command))
            return sorted(path.name for path in self.box.folder.glob("*.slv"))

        self.assertEqual(made_again(), [])
        self.assertEqual(self.box.path("t.csv").read_text(), whole)
        self.box.path("t.csv").write_text(lines[0] + lines[2])
        self.assertEqual(made_again(), ["room 4.slv", "room 8.slv"])
        self.assertEqual(self.rows()[1]["plan"], "room 6.map")
        self.box.path("room 6.map").write_text(ROOM.format(w=7))
        self.assertEqual(made_again(), ["room 6.slv"])
        self.assertEqual(made_again(*command, "--inside"),
                         ["room 4.slv", "room 6.slv", "room 8.slv"])
        self.assertEqual(len(made_again(*command[:3], "t.csv", *command[5:])), 3)

    def test_a_table_of_another_kind_is_not_replaced(self):
        for text, place in ("x,y\n1,2\n", "t.csv:1: "), ("made_from,plan\na\n", "t.csv:2: "):
            self.box.path("t.csv").write_text(text)
            result = self.run_batch("info", "list", "-o", "t.csv", "--resume", status=2)
            self.assertTrue(result.stderr.startswith("sightline: " + place), result.stderr)
            self.assertEqual(self.box.path("t.csv").read_text(), text)

    def test_refused(self):
        self.box.path("other").mkdir()
        for words, reason in [
                (["draw", "list"], "there is no command 'draw'"),
                (["info", "list", "--resume"], "--resume is of no use without -o"),
                (["info", "list", "-o", "list.csv", "--jobs", "0"], "-j 0: at least 1 is needed"),
                (["vga", "list", "--", "--grid", "1", "-o", "x.csv"], "leave it out"),
                (["info", "list", "--", "--json"], "leave it out"),
                (["info", "nothing"], "nothing: ")]:
            self.assertIn(reason, self.run_batch(*words, status=2).stderr)
        for lines, reason in [(["# none"], "no plan is listed"), (["a.map", "-"], "list:2: "),
                              (["a.map", "other/a.map"], "have one name")]:
            self.write_list(*lines)
            self.assertIn(reason, self.run_batch("bake", "list", status=2).stderr)
        self.write_list("room 4.map", "room 6.csv")
        self.box.path("room 6.csv").write_text("0,0,1,1\n")
        self.assertIn("-o", self.run_batch("info", "list", "-o", "room 6.csv", status=2).stderr)

    @staticmethod
    def words_of(process):
        with contextlib.suppress(OSError):
            return pathlib.Path(f"/proc/{process}/cmdline").read_text().split("\0")
        return []

    def test_ctrl_c_keeps_what_is_done(self):
        self.box.path("hall.map").write_text(endless())
        self.write_list("room 4.map", "hall.map", "room 8.map")
        process = self.box.start(["batch", "bake", "list", "-o", "t.csv", "--jobs", "1", "--",
                                  "-o", "{}.slv", "--method", "dfs"])
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
        if not children.exists():
            self.skipTest("the system does not list the processes that a process has started")
        sandbox.wait_until(lambda: any("hall.map" in self.words_of(child)
                                       for child in children.read_text().split()), "the hall is baked")
        child, = children.read_text().split()
        process.send_signal(signal.SIGINT)
        result = self.finish(process, 1)
        self.assertEqual(result.stderr,
                         "sightline: interrupted: t.csv has 1 of 3 plans; --resume goes on\n")
        self.assertNotIn("hall.map", self.words_of(child))
        self.assertEqual([row["plan"] for row in self.rows()], ["room 4.map"])
        self.assertNotIn("hall.slv", self.box.files())

    def test_progress_counts_what_is_run(self):
        command = ["batch", "bake", "list", "-o", "t.csv", "--resume", "--", "-o", "{}.slv", "--method", "dfs"]
        self.write_list("room 4.map", "room 8.map")
        self.box.run(command)
        self.box.path("hall.map").write_text(endless())
        self.write_list("room 4.map", "hall.map", "room 8.map")
        master, slave = os.openpty()
        process = self.box.start(command, stderr=slave)
        os.close(slave)
        text = b""
        while b"plans" not in text:
            text += os.read(master, 65536)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        self.assertIn(b"batch: 0/1 plans", text)
        self.assertIn(b"t.csv has 2 of 3 plans", text + sandbox.read_terminal(master))


if __name__ == "__main__":
    sandbox.main()
