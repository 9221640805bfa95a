"""REJECT of all levels of the Debian package `freedoom`, beside the one that each level comes with.

reject.py SIGHTLINE CHECK_REJECT CHECK_SIGHTLINES [-o DIR] [option...]

First `sightline reject` makes the REJECTs of each WAD, from reading it to the copy written, which is
timed by the clock: once with one thread, once with one a core. Then each level's REJECT is held
against its own, pair by pair, and against free sightlines of the level's walls. Pairs are unordered.
`right` is what both hide, `wrong` what the builder hides and a sightline that was found joins,
`ambiguous` what it hides and we do not, as lines of the map disagree about the sector that a cell is
in; `undecided` the rest of what the builder hides and we do not. Sightlines are looked
for by cells: those of the same bake (--sectors and open sight).

Writes DIR/reject.csv, DIR/reject.txt (the same as a table, with sums, and the ratio to the 12.3 s
that are stated for the builder in use today) and DIR/aimed.txt: sightlines across what the builder
hides on the levels of --aimed. With --time the REJECTs are made and timed, no more. Exit status: 0
all well, 1 where something was lost or failed, 77 where the WADs are not there.
"""
import argparse
import csv
import json
import os
import pathlib
import platform
import resource
import subprocess
import sys
import tempfile
import time

WADS = ["freedoom1.wad", "freedoom2.wad"]
BUILDER_SECONDS = 12.3
COLUMNS = ["machine", "wad", "map", "sectors", "cells", "theirs", "right", "wrong", "ambiguous",
           "undecided", "hidden", "sightlines", "lost", "result"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sightline", type=pathlib.Path)
    parser.add_argument("check_reject", type=pathlib.Path)
    parser.add_argument("check_sightlines", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("out"))
    parser.add_argument("--wads", type=pathlib.Path, default=pathlib.Path("/usr/share/games/doom"))
    parser.add_argument("--levels", help="only these, with commas between: E1M1,MAP07")
    parser.add_argument("--count", type=int, default=1000000, help="free sightlines a level")
    parser.add_argument("--aimed", default="E1M6,E3M6,E4M6,E4M7,MAP01,MAP27",
                        help="levels of which sightlines are written")
    parser.add_argument("--time", action="store_true", help="time the whole run, no more")
    return parser.parse_args()


def run(*command):
    done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True)
    if done.returncode not in (0, 1) or (done.returncode and not done.stdout):
        raise RuntimeError(done.stderr.strip().splitlines()[-1])
    return done.stdout


def make_all(options, folder, threads):
    """Seconds that the REJECTs of all WADs take, which are written into the folder: by the clock, and
    of the processor."""
    began, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    for name in WADS:
        run(options.sightline, "reject", options.wads / name, "-o", folder / name, "--threads",
            threads, "--quiet")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (time.monotonic() - began,
            after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def table_of(text):
    """The line of CSV at the end, as numbers."""
    names, values = (line.split(",") for line in text.splitlines()[-2:])
    return dict(zip(names, map(int, values)))


def levels(options):
    chosen = options.levels.upper().split(",") if options.levels else None
    for name in WADS:
        wad = options.wads / name
        for each in json.loads(run(options.sightline, "info", wad, "--json", "--quiet"))["maps"]:
            if not chosen or each["name"] in chosen:
                yield wad, each["name"]


def do_level(options, wad, level, folder, aimed):
    row = {"machine": platform.node(), "wad": wad.name, "map": level, "result": "written"}
    baked, made = folder / "level.slv", folder / wad.name
    try:
        told = json.loads(run(options.sightline, "bake", wad, "--map", level, "-o", baked,
                              "--sectors", "--sight", "open", "--json", "--quiet"))
        row.update(cells=told["cells"])
        shown = ["--aimed"] if level in options.aimed.upper().split(",") else []
        text = run(options.check_reject, wad, "--map", level, "--slv", baked, "--reject", made,
                   *shown)
        row.update(table_of(text))
        for line in text.splitlines()[:-2]:
            print(level, line, file=aimed)
        found = table_of(run(options.check_sightlines, wad, "--map", level, "--reject", made,
                             "--count", options.count))
        row.update(sightlines=found["checked"], lost=found["lost"])
        if found["lost"]:
            row["result"] = "LOST"
    except (RuntimeError, KeyError, ValueError) as fault:
        row["result"] = f"FAILED: {fault}"
    return row


def write_table(path, rows, times):
    shown = [name for name in COLUMNS if name != "machine"]
    lines = [shown] + [[str(row.get(name, "")) for name in shown] for row in rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(shown))]
    sums = {name: sum(row.get(name, 0) for row in rows) for name in COLUMNS[4:-1]}
    with open(path, "w", encoding="utf-8") as stream:
        print(f"machine {platform.node()}, {os.cpu_count()} cores; {len(rows)} levels", file=stream)
        for line in lines:
            print("  ".join(text.rjust(width) for text, width in zip(line, widths)), file=stream)
        print(f"the builder hides {sums['theirs']} pairs: {sums['right']} rightly, {sums['wrong']} "
              f"wrongly, {sums['ambiguous']} where lines disagree, {sums['undecided']} undecided; "
              f"we hide {sums['hidden']}, "
              f"{sums['lost']} of {sums['sightlines']} free sightlines across one", file=stream)
        print(times, file=stream)


def time_all(options, folder):
    """A line about both runs, whose copies must be the same."""
    others = folder / "others"
    others.mkdir()
    one, processor = make_all(options, others, 1)
    cores, _ = make_all(options, folder, 0)
    same = all((folder / name).read_bytes() == (others / name).read_bytes() for name in WADS)
    return (f"all REJECTs, from reading to written: {one:.2f} s with one thread, {processor:.2f} s of "
            f"the processor; {cores:.2f} s with {os.cpu_count()}; the builder's {BUILDER_SECONDS} s "
            f"are {BUILDER_SECONDS / one:.1f}, {BUILDER_SECONDS / processor:.1f} and "
            f"{BUILDER_SECONDS / cores:.1f} times that; "
            f"{'the same bytes' if same else 'DIFFERENT BYTES'}")


def main():
    options = arguments()
    if not all((options.wads / name).exists() for name in WADS):
        print(f"skipped: {options.wads} has no {' and '.join(WADS)} (Debian package freedoom)")
        return 77
    options.output.mkdir(parents=True, exist_ok=True)
    rows = []
    with open(options.output / "reject.csv", "w", newline="", encoding="utf-8") as stream, \
            open(options.output / "aimed.txt", "w", encoding="utf-8") as aimed, \
            tempfile.TemporaryDirectory(prefix="sightline-reject-") as scratch:
        times = time_all(options, pathlib.Path(scratch))
        print(times, flush=True)
        if options.time:
            return int("DIFFERENT" in times)
        writer = csv.DictWriter(stream, COLUMNS)
        writer.writeheader()
        for wad, level in levels(options):
            rows.append(do_level(options, wad, level, pathlib.Path(scratch), aimed))
            writer.writerow(rows[-1])
            stream.flush()
            print(" ".join(f"{name}={rows[-1][name]}" for name in COLUMNS[2:] if name in rows[-1]),
                  flush=True)
    write_table(options.output / "reject.txt", rows, times)
    print((options.output / "reject.txt").read_text(encoding="utf-8").splitlines()[-2])
    return int("DIFFERENT" in times or any(row["result"] != "written" for row in rows))


if __name__ == "__main__":
    sys.exit(main())
