#!/usr/bin/env python3
"""The core library as two files: the same bytes as the library under users' flags, and flags that it refuses.

    python3 tests/amalgamation/amalgamation.py STUDY LIBRARY [COMPILER FLAGS]

STUDY and LIBRARY are the archives that `same_bytes` is linked with. Without a COMPILER with its FLAGS, in
one word, those of `USERS` are tried, and those of `QUIET` must have no warning. A compiler that is missing
is passed over, and so is a flag that a compiler does not take here; the exit status is 77 when all compilers are missing.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
USERS = ["gcc -O0", "gcc -O3", "clang -O2 -march=native"]
QUIET = [f"{compiler} -O{level}" for compiler in ("gcc", "clang") for level in range(4)]
REFUSED = {"-ffast-math": "compile it without -ffast-math", "-Ofast": "compile it without -ffast-math",
           "-ffinite-math-only": "compile it without -ffast-math", "-std=c99": "compile it as C11", "-xc++": "compile it as C11"}
CONTRACTED = "clang -O1 -march=native -ffp-contract=fast"


def run(*command, folder):
    """What a command says, and its exit status."""
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.stdout, done.returncode


def must(*command, folder):
    said, status = run(*command, folder=folder)
    if status:
        sys.exit(f"{' '.join(map(str, command))}\n{said}")
    return said


def same_bytes(folder, core, study):
    """What the program prints that bakes all maps of the project, and generated ones."""
    must("cc", "-O1", "-D_XOPEN_SOURCE=700", f"-I{SOURCE}/lib/include", f"-I{SOURCE}/lib/runtime",
         SOURCE / "tests/everywhere/same_bytes.c", study, core, "-pthread", "-lm", "-o", "same_bytes", folder=folder)
    maps = sorted([*SOURCE.glob("maps/*.map"), *SOURCE.glob("maps/*/*.map")])
    lines = must("./same_bytes", *maps, folder=folder)
    if len(lines.splitlines()) <= len(maps):
        sys.exit(f"same_bytes has too few lines:\n{lines}")
    return lines


def compiles(compiler, flag):
    """Whether a compiler takes a flag: gcc without g++ is no compiler of C++."""
    return not run(compiler, flag, "-fsyntax-only", os.devnull, folder=SOURCE)[1]


def has_fma():
    """Whether clang has an instruction here that multiplies and adds at once."""
    processor = Path("/proc/cpuinfo")
    return processor.exists() and " fma " in processor.read_text()


def program(folder):
    """The program of the README, with the one header."""
    text = (SOURCE / "README.md").read_text()
    found = re.search(r"```c\n([^`]+)```\n\n```text\n([^`]+)```", text)
    (folder / "program.c").write_text(found.group(1).replace("<sightline/sightline.h>", '"sightline.h"'))
    return found.group(2)


def warnings(folder, user):
    """What a compiler warns of with these flags; nothing else may fail either."""
    said, status = run(*user.split(), "-Wall", "-Wextra", "-Werror", "-c", "sightline.c", "-o", "quiet.o", folder=folder)
    return [f"{user} warns:\n{said}"] if status or said else []


def main(study, library, *given):
    users, quiet = ([user for user in each if shutil.which(user.split()[0])] for each in (given or USERS, given or QUIET))
    if not users:
        return 77
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "new"
        must(sys.executable, "-B", SOURCE / "tools/packages/amalgamation/amalgamate.py", folder, folder=scratch)
        expected, printed = same_bytes(folder, library, study), program(folder)
        faults = [fault for user in quiet if user not in users for fault in warnings(folder, user)]
        untried = []
        for user in users:
            must(*user.split(), "-Wall", "-Wextra", "-Werror", "-c", "sightline.c", folder=folder)
            if same_bytes(folder, "sightline.o", study) != expected:
                faults.append(f"{user}: other bytes")
            must(*user.split(), "program.c", "sightline.o", "-pthread", "-lm", "-o", "program", folder=folder)
            said, _ = run(folder / "program", folder=SOURCE)
            if said != printed:
                faults.append(f"{user}: the README's program says: {said}")
            compiler = user.split()[0]
            for flag, why in REFUSED.items():
                if not compiles(compiler, flag):
                    untried.append(f"not tried, for {compiler} does not take it here: {flag}")
                    continue
                said, status = run(compiler, flag, "-fsyntax-only", "sightline.c", folder=folder)
                if not status or why not in said:
                    faults.append(f"{user} with {flag} is not refused")
        if has_fma() and shutil.which("clang"):
            must(*CONTRACTED.split(), "program.c", "sightline.c", "-pthread", "-lm", "-o", "program", folder=folder)
            said, status = run(folder / "program", folder=SOURCE)
            if not status or "compile it with -ffp-contract=off" not in said:
                faults.append(f"{CONTRACTED} is not refused: {said}")
    if untried:
        print(*dict.fromkeys(untried), sep="\n")
    print("\n".join(faults) or f"the same bytes by {', '.join(users)}")
    return 1 if faults else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("usage: amalgamation.py STUDY LIBRARY [COMPILER FLAGS]")
    sys.exit(main(*map(os.path.abspath, sys.argv[1:3]), *sys.argv[3:]))
