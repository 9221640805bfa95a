"""What a hostile user would try, on every command. Commands, operands and options are read from
--help, so that a new command is tried too; VALUES says what is given for the words that help uses.

test_hostile.py PROGRAM [--brief]
--brief: of options that are misused, and of bad inputs that several commands read, every third,
another third for each command.
"""
import itertools
import json
import os
import random
import re
import shlex
import sys

import sandbox
from case import MAPS
from wad import make_wad, rooms

VALUES = {"MAP": "flat.map", "IN": "flat.map", "MAP|FILE.slv": "flat.map", "FILE.slv": "flat.slv",
          "PART.slv": "part.slv", "A": "0", "B": "0", "X,Y": "1.25,1.5", "KIND": "tunnels",
          "IN.wad": "rooms.wad", "STEP": "1", "TABLE": "cameras.csv",
          "COMMAND": "info", "LIST": "list.txt"}
OUTPUTS = {"FILE.slv": "out.slv", "PICTURE": "out.png", "OUT": "out.map",
           "OUT.map": "out.map", "OUT.wad": "out.wad",
           "FILE": "out.json", "OUT.pdf": "out.pdf", "TABLE": "out.geojson", "PICTURE|TABLE": "out.geojson",
           "FILE.csv": "out.csv", "DIR": "out"}
# What makes a command that computes for long short, where nothing else is said.
SHORT = {"viewcells": {"--samples": "1000", "--evaluate": "1000"}, "walk": {"--steps": "20"}}
# What no number, point, size or share is; each option is given some of them, the next the next.
NO_NUMBERS = ["", "nan", "-1e999", "0x10", "1 2", "1,", "1\n", "9" * 600]
NUMBERS_EACH = 3
NUMBERS = {"N", "Z", "PX", "SIZE", "SHARE", "X,Y", "DEG", "PERCENT", "SECONDS",
           "STEP"}
NAMES = {"NAME", "closed|open", "RULE,...", "EFFECT,...", "LAYER,...", "GROUP,..."}


class Command:
    """A command as its --help tells of it."""

    def __init__(self, name, text):
        self.name = name
        usage, = re.findall(rf"^usage: sightline {name} (.*)$", text, re.MULTILINE)
        words = usage.split("[")[0].split()
        self.operands = [word for word in words if not word.startswith("-")]
        self.many = "...] -o" in usage  # operands
        self.options = re.findall(r"^  (?:-\w, )?--([\w-]+)(?: (\S+))?", text, re.MULTILINE)
        self.repeat = [each.split()[0] for each in re.split(r"^  (?:-\w, )?--", text, flags=re.MULTILINE)
                       if "may be given several times" in " ".join(each.split())]
        self.output = dict(self.options).get("output")
        if "-o" in words:  # what follows it is no operand
            self.operands.remove(words[words.index("-o") + 1])
        # Options that cannot be left out, with their arguments.
        self.needed = [(word, words[at + 1]) for at, word in enumerate(words)
                       if word.startswith("--")]
        for _, argument in self.needed:
            self.operands.remove(argument)
        self.defaults = SHORT.get(name, {}) | {
            option: VALUES[argument] for option, argument in self.needed}

    def call(self, *options, operands=None, output=None):
        """Its arguments, all that is not given put in."""
        given = [VALUES.get(word, word) for word in self.operands] if operands is None else operands
        arguments = [self.name, *options]
        for option, value in self.defaults.items():
            if option not in [each.split("=")[0] for each in options]:
                arguments += [option, value]
        if self.output and output is None and "--output" not in options:
            output = OUTPUTS.get(self.output, "out")
        if output is not None:
            arguments += ["--output", output]
        return [*arguments, *given]

    def reads(self):
        """What its first operand is called; None where that is no file."""
        value = VALUES.get(self.operands[0], "") if self.operands else ""
        return value if "." in value else None


def some(at, each):
    """Of what could be tried on command number `at` what is tried: all, or briefly a third."""
    return itertools.islice(each, at % 3, None, 3) if BRIEF else each


class Hostile(sandbox.ProgramTest):
    @classmethod
    def setUpClass(cls):
        with sandbox.Sandbox(cls.program) as box:
            names = [line.split("\t")[0] for line in box.run(["--help", "words"]).stdout.splitlines()]
            cls.commands = [Command(name, box.run([name, "--help", "all"]).stdout) for name in names]

    def setUp(self):
        super().setUp()
        self.box.path("flat.map").write_bytes((MAPS / "flat.map").read_bytes())
        self.box.path("rooms.wad").write_bytes(make_wad(rooms("MAP01", 3), rooms("MAP02", 2)))
        self.box.path("cameras.csv").write_text("x,y\n1,1\n")
        self.box.path("list.txt").write_text("flat.map\n")
        self.run_well("bake", "flat.map", "-o", "flat.slv", "--quiet")
        self.run_well("bake", "flat.map", "-o", "part.slv", "--quiet", "--shard", "1/1")

    def refused(self, arguments, *statuses, says="", **how):
        with self.subTest(" ".join(shlex.quote(word[:80]) for word in arguments), **how):
            result = self.box.run(arguments, timeout=20, **how)
            self.assertIn(result.status, statuses, result.text())
            self.assertEqual(result.stdout, "")
            self.assertIn(says, result.stderr)

    def test_good_calls(self):
        """What the other tests spoil is a call that is good."""
        for command in self.commands:
            with self.subTest(command.name):
                self.run_well(*command.call("--quiet"))

    # --- inputs

    def spoilt(self, good):
        """Names of inputs that are none, each with the statuses that are due."""
        box, ending = self.box, good[-4:]
        content = box.path(good).read_bytes()
        numbers = random.Random(7)
        noise = bytes(numbers.randrange(256) for _ in range(4000))
        contents = {"empty": b"", "noise": noise, "nul": content[:40] + bytes(400),
                    "wide": content.decode("latin-1").encode("utf-16"),
                    "line": content[:12] + b"wall " + b"1" * 100000, "cut7": content[:7],
                    "escape": content[:12] + b"\033[2J\033]0;x\007 1 2\n"}
        if ending != ".wad":  # where the directory says what counts
            contents["tail"] = content + b"\0\1\2"
        if ending == ".slv":
            for size in (8, 32, 200, len(content) - 1):
                contents[f"cut{size}"] = content[:size]
            contents["head"] = content[:32] + noise
        for name, some in contents.items():
            box.path(name + ending).write_bytes(some)
            yield name + ending, (2,)
        box.path("folder" + ending).mkdir(exist_ok=True)
        yield "folder" + ending, (2,)
        yield "missing" + ending, (2,)
        yield "new\nline \033[31m\u009b31m" + ending, (2,)
        yield good + "/within" + ending, (2,)
        yield "long" * 2000 + ending, (1, 2)
        yield "long" * 60 + "er" * 10 + ending, (1, 2)
        yield "", (2,)
        if os.geteuid():
            box.path("secret" + ending).touch(0o000)
            yield "secret" + ending, (1,)

    def test_inputs(self):
        readers = list(filter(Command.reads, self.commands))
        operands = [command.operands[0] for command in readers]
        for at, command in enumerate(readers):
            tried = some if operands.count(command.operands[0]) > 1 else lambda at, each: each
            for good in {"flat.map", "flat.slv"} if "|" in command.operands[0] else {
                    command.reads()}:
                others = [VALUES.get(word, word) for word in command.operands[1:]]
                for name, statuses in tried(at, self.spoilt(good)):
                    self.refused(command.call(operands=[name, *others]), *statuses)

    # --- outputs

    def test_outputs(self):
        for command in self.commands:
            if not command.output or command.output == "DIR":
                continue
            ending = os.path.splitext(OUTPUTS[command.output])[1]
            self.box.path("folder" + ending).mkdir(exist_ok=True)
            self.refused(command.call(output=f"folder{ending}"), 2, says="is a directory")
            self.refused(command.call(output=f"nowhere/out{ending}"), 1, says="No such file")
            self.refused(command.call(output=f"flat.map/out{ending}"), 1, says="Not a directory")
            self.refused(command.call(output="long" * 70 + ending), 1, says="too long")
            self.refused(command.call(output="long" * 2000 + ending), 1)
            self.refused(command.call(output=""), 2)
            self.refused(command.call(output=f"out{ending}"), 1, file_limit=16)
            full = self.box.path(f"full{ending}")
            full.symlink_to("/dev/full")
            self.refused(command.call(output=full.name), 1, says="No space left")
            full.unlink()

    def test_output_is_the_input(self):
        self.refused(["bake", "flat.map", "-o", "flat.map"], 2)
        self.refused(["draw", "flat.slv", "-o", "flat.slv"], 2)
        self.refused(["export", "flat.slv", "-o", "flat.slv"], 2, says="is the input itself")
        self.refused(["export", "flat.slv", "-o", "./flat.slv"], 2, says="is the input itself")
        self.box.path("zones.csv").write_text("name,x,y\na,1,1\na,2,1\na,2,2\n")
        self.run_well("place", "flat.map", "--proof", "proof.json", "--quiet")
        along = ["isovist", "flat.map", "--along", "cameras.csv", "--see", "zones.csv"]
        place = ["place", "flat.map"]
        for output, command in (("cameras.csv", ["cover", "flat.map", "cameras.csv"]),
                                ("zones.csv", ["cover", "flat.map", "cameras.csv", "--zones", "zones.csv"]),
                                ("zones.csv", along), ("cameras.csv", along),
                                ("cameras.csv", [*place, "--from", "cameras.csv"]),
                                ("cameras.csv", [*place, "--path", "cameras.csv"]),
                                ("zones.csv", [*place, "--see", "zones.csv"]),
                                ("zones.csv", [*place, "--forbid", "zones.csv"])):
            self.refused([*command, "-o", output], 2, says="is the input itself")
        self.refused([*place, "--verify", "proof.json", "--proof", "proof.json"], 2, says="is the input itself")
        self.run_well("convert", "flat.map", "-o", "flat.svg")
        for command in ("isovist", "vga"):
            self.refused([command, "flat.map", "--grid", "1", "--within", "flat.svg", "--picture", "flat.svg"], 2,
                         says="is the input itself")
        before = self.run_well("convert", "flat.map").stdout
        self.refused(["convert", "flat.map", "-o", "flat.map"], 2, says="--in-place")
        self.run_well("convert", "flat.map", "-o", "flat.map", "--in-place")
        self.assertEqual(self.box.path("flat.map").read_text(), before)

    # --- options

    def tried(self):
        """Each command with those of its options that are misused."""
        for at, command in enumerate(self.commands):
            yield command, list(some(at, command.options))

    def test_options_misused(self):
        for command, options in self.tried():
            for name, argument in options:
                option = "--" + name
                if argument:
                    self.refused([*command.call(), option], 2)
                    says = "" if name in command.repeat else "given twice"
                    self.refused(command.call(option, "1", option, "1"), 2, says=says)
                else:
                    self.refused(command.call(option + "=1"), 2, says="takes no argument")
                    self.refused(command.call(option, option), 2, says="given twice")
            for option in ("--xyzzy", "--xyzzy=1", "-Z", "-", "--=", "---", "--\n\033[2J"):
                self.refused([*command.call(), option], 2)
            says = "--quiet: cannot open" if command.many else "one argument too many"
            if command.name != "batch": # it takes options of another command there
                self.refused([*command.call(), "--", "--quiet"], 2, says=says)
            self.refused([command.name], 2, says="is missing")

    def test_options_values(self):
        no_number = itertools.cycle(NO_NUMBERS)
        for command, options in self.tried():
            for name, argument in options:
                if argument in NUMBERS:
                    positive = argument in ("N", "SIZE", "SHARE", "PX", "PERCENT")
                    values = list(itertools.islice(no_number, NUMBERS_EACH))
                    for value in values + ["-1"] * positive:
                        self.refused(command.call(f"--{name}={value}"), 2)
                elif argument in NAMES:
                    for value in ("", "x" * 5000, "none,none", "\033[2J"):
                        self.refused(command.call(f"--{name}={value}"), 2, says="--" + name)

    def test_commands(self):
        for name in ("", " ", "-", "bake ", "BAKE", "\n", "x" * 5000, "\033[2J", "--bake", "-x"):
            self.refused([name], 2)

    # --- maps that are odd, and yet maps

    ODD = {
        "one wall": "wall 0 0 4 0",
        "one line": "wall 0 0 0 4\nwall 0 5 0 9\nwall 0 9 0 12",
        "one point": "walls 0 0 4 0 4 3 0 3 0 0\nwall 1 1 1 1",
        "aspect": "walls 0 0 1e6 0 1e6 1 0 1 0 0\nwall 500000 0 500000 0.5",
        "far aspect": "walls 0 0 1e150 0 1e150 1e144 0 1e144 0 0\nwall 1 0 1 1",
        "tiny": "walls 1e-150 1e-150 1.0000000000000002e-150 1e-150 1.0000000000000002e-150 "
                "1.0000000000000002e-150 1e-150 1.0000000000000002e-150 1e-150 1e-150",
        "tiny in huge": "walls -1e150 -1e150 1e150 -1e150 1e150 1e150 -1e150 1e150 -1e150 -1e150\n"
                        "walls 0 0 1e-150 0 1e-150 1e-150 0 1e-150 0 0\nstart 0 0 0",
        "far line": "wall 1e150 -1e150 1e150 1e150",
        "short line": "wall 0 0 0 1e-150",
        "far start": "walls 0 0 4 0 4 3 0 3 0 0\nstart 1e150 -1e150 0",
        "far object": "walls 0 0 4 0 4 3 0 3 0 0\nobject o -1e150 -1e150 1e150 1e150",
        "names": "walls 0 0 4 0 4 3 0 3 0 0\nobject \u2713\u00e9 1 1 2 2\n"
                 "path " + "x" * 3000 + " 1 1 3 1",
    }

    def goes_all_the_way(self, path, folder=""):
        baked, export = f"{folder}a b.slv", f"{folder}a b.json"

        def no_constant(word):
            self.fail(f"{word} in JSON")

        for arguments in (["info", path], ["bake", path, "-o", baked, "--check", "--stab-trees"],
                          ["info", baked]):
            self.assertNotRegex(self.run_well(*arguments).stdout, r"\b(nan|inf)\b")
        for arguments in (["info", path], ["info", baked], ["bake", path, "-o", baked]):
            json.loads(self.run_well(*arguments, "--json").stdout, parse_constant=no_constant)
        self.run_well("export", baked, "-o", export)
        json.loads(self.box.path(export).read_text(), parse_constant=no_constant)
        for ending in (".png", ".svg", ".pdf"):
            self.run_well("draw", baked, "-o", f"{folder}a b{ending}", "--title", "\u2713 \u00e9")
        self.run_well("convert", baked, "-o", f"{folder}a b.map")

    def test_odd_maps(self):
        for name, text in self.ODD.items():
            with self.subTest(name):
                self.box.path("odd.map").write_text("sightline 1\n" + text + "\n", "utf-8")
                self.goes_all_the_way("odd.map")

    def test_odd_names(self):
        content = self.box.path("flat.map").read_bytes()
        self.box.path("d \u00e9\u2713").mkdir()
        for name, folder in (("d \u00e9\u2713/\u00e4 $(x) 'y'.map", "d \u00e9\u2713/"),
                             ("./-o.map", "./--"), ("%s%n.map", "%n")):
            with self.subTest(name):
                self.box.path(name).write_bytes(content)
                self.goes_all_the_way(name, folder)

    def test_notices_of_a_stranger(self):
        self.box.path("odd.map").write_text("sightline 1\n#! one \033[2J\u009b2J two\n"
                                            "walls 0 0 4 0 4 3 0 3 0 0\n", "utf-8")
        self.run_well("bake", "odd.map", "-o", "odd.slv")
        for path in ("odd.map", "odd.slv"):
            self.assertIn("    one ?[2J?2J two\n", self.run_well("info", path).stdout)

    # --- closed streams

    def test_closed_streams(self):
        """No file that is opened takes a stream's place and is written to in its stead."""
        before = self.box.files()
        for closed in ((1,), (0, 1, 2)):
            for command in self.commands:
                with self.subTest(command=command.name, closed=closed):
                    process = self.box.start(command.call("--quiet"), closed=closed)
                    stderr = process.communicate(timeout=20)[1].decode()
                    # Only what has something to say on stdout may fail for it.
                    statuses = (0, 1) if 1 in closed else (0,)
                    self.assertIn(process.returncode, statuses, stderr)
                    if process.returncode and 2 not in closed:
                        self.assertRegex(stderr, "^sightline: standard output: .*\n$")
                    after = self.box.files()
                    self.assertEqual({name: after[name] for name in before}, before)
                    for name in set(after) - set(before):
                        self.assertNotIn(b"sightline: ", after[name] or b"", name)


if __name__ == "__main__":
    BRIEF = "--brief" in sys.argv
    if BRIEF:
        sys.argv.remove("--brief")
        print("brief: of options that are misused, and of bad inputs, every third")
    sandbox.main()
