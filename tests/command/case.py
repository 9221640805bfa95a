"""Runs a command-line case: case.py PROGRAM FILE.case

A case is lines; # starts a comment. What is there before the runs:
  file NAME              with the lines that follow it, each led by "| "
  map NAME               a copy of a map of the project's maps/ or of a folder in it
  old NAME               a copy of a file of tests/old_files
  noise NAME COUNT       bytes without sense, the same each time
  folder NAME
  cut NAME COUNT         the file's first COUNT bytes are kept
  flip NAME OFFSET       one bit of the byte there changes
A run, and how it goes:
  run ARGUMENTS          as a shell splits them
  run-full ARGUMENTS     with a stdout to a full disk
  run-closed ARGUMENTS   with a closed stdout
  run-fed NAME ARGUMENTS with a file as its stdin
  run-limited N ARGUMENTS  where no file may grow beyond N bytes
What must hold after the run (all that is not named must not be there):
  status N
  stdout PATTERN         a regular expression found in it; no line of this kind: nothing is there
  stderr PATTERN         the same
  makes NAME [START]     a new or changed file, not empty, which starts with the characters START
  same NAME NAME         both files hold the same
After every run: a failure has changed no file and said one line; see sandbox.py.
"""
import pathlib
import random
import re
import shlex
import shutil
import sys

import sandbox

TESTS = pathlib.Path(__file__).resolve().parents[1]
MAPS = TESTS.parent / "maps"


class Malformed(Exception):
    """The case itself is wrong."""


class Case:
    def __init__(self, box, text):
        self.box = box
        self.lines = [(number, line) for number, line in enumerate(text.splitlines(), 1)
                      if line.strip() and not line.startswith("#")]

    def play(self):
        runs = 0
        while self.lines:
            number, line = self.lines.pop(0)
            word, _, rest = line.partition(" ")
            step = getattr(self, "do_" + word.replace("-", "_"), None)
            if not step:
                raise Malformed(f"line {number}: unknown word {word}")
            runs += word.startswith("run")
            try:
                step(rest.strip())
            except sandbox.Fault as fault:
                raise sandbox.Fault(f"line {number}: {line}\n{fault}")
        if not runs:
            raise Malformed("runs nothing")

    def do_file(self, name):
        content = []
        while self.lines and self.lines[0][1].startswith("|"):
            content.append(self.lines.pop(0)[1][2:] + "\n")
        self.box.path(name).write_text("".join(content), encoding="utf-8")

    def do_map(self, name):
        shutil.copyfile(MAPS / name, self.box.path(pathlib.Path(name).name))

    def do_old(self, name):
        shutil.copyfile(TESTS / "old_files" / name, self.box.path(name))

    def do_noise(self, rest):
        name, count = rest.split()
        numbers = random.Random(1)
        self.box.path(name).write_bytes(bytes(numbers.randrange(256) for _ in range(int(count))))

    def do_folder(self, name):
        self.box.path(name).mkdir()

    def do_cut(self, rest):
        name, count = rest.split()
        path = self.box.path(name)
        path.write_bytes(path.read_bytes()[:int(count)])

    def do_flip(self, rest):
        name, offset = rest.split()
        content = bytearray(self.box.path(name).read_bytes())
        content[int(offset)] ^= 4
        self.box.path(name).write_bytes(content)

    def do_run(self, rest):
        self._run(rest)

    def do_run_full(self, rest):
        with open("/dev/full", "wb") as full:
            self._run(rest, stdout=full)

    def do_run_closed(self, rest):
        self._run(rest, stdout=None)

    def do_run_fed(self, rest):
        name, _, rest = rest.partition(" ")
        with open(self.box.path(name), "rb") as stdin:
            self._run(rest, stdin=stdin)

    def do_run_limited(self, rest):
        limit, _, rest = rest.partition(" ")
        self._run(rest, file_limit=int(limit))

    def _run(self, rest, **how):
        status, makes = None, {}
        patterns = {"stdout": [], "stderr": []}
        while self.lines and self.lines[0][1].split()[0] in ("status", "stdout", "stderr", "makes"):
            word, _, value = self.lines.pop(0)[1].partition(" ")
            if word == "status":
                status = int(value)
            elif word == "makes":
                name, _, start = value.partition(" ")
                makes[name] = start
            else:
                patterns[word].append(value)
        if status is None:
            raise Malformed(f"no status after: run {rest}")
        before = self.box.files()
        result = self.box.run(shlex.split(rest), **how)
        try:
            self._check(result, status, patterns, makes, before)
        except sandbox.Fault as fault:
            raise sandbox.Fault(f"{fault}\n{result.text()}")

    def _check(self, result, status, patterns, makes, before):
        sandbox.check(result.status == status, f"status {status} is due")
        for stream, wanted in patterns.items():
            text = getattr(result, stream)
            for pattern in wanted:
                sandbox.check(re.search(pattern, text, re.MULTILINE), f"{stream} lacks {pattern}")
            sandbox.check(wanted or not text, f"{stream} should be empty")
        after = self.box.files()
        for name, start in makes.items():
            sandbox.check(after.get(name), f"{name} is not there, or empty")
            sandbox.check(start.encode() in after[name][:256], f"{name} does not start with {start}")
        changed = {name for name in after if name not in before or after[name] != before[name]}
        sandbox.check(changed <= set(makes), f"also wrote {sorted(changed - set(makes))}")

    def do_same(self, rest):
        first, second = rest.split()
        sandbox.check(self.box.path(first).read_bytes() == self.box.path(second).read_bytes(),
                      f"{first} and {second} differ")


def main():
    program = sandbox.program_argument()
    path, = sys.argv[1:]
    try:
        with sandbox.Sandbox(program) as box:
            Case(box, pathlib.Path(path).read_text(encoding="utf-8")).play()
    except (sandbox.Fault, Malformed) as fault:
        sys.exit(f"{path}: {fault}")


if __name__ == "__main__":
    main()
