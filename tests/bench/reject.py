"""REJECT of all levels of the Debian package `freedoom`, beside the one that each level comes with.

reject.py SIGHTLINE CHECK_REJECT CHECK_SIGHTLINES [-o DIR] [option...] [-- BAKE-OPTION...]

Each level is baked with cells that lie in one sector each (--sectors) and open sight, which is all
that a sightline that meets no wall asks for; the REJECT is exported and held against the level's
own, pair by pair, and against free sightlines of the level's walls. Pairs are unordered. `right` is
what both hide, `wrong` what the builder hides and a sightline that was found joins, `undecided` what
the builder hides, we do not, and no sightline was found for. Seconds are of the processor, of bake
and export together, reading and writing included.

Writes DIR/reject.csv, DIR/reject.txt (the same as a table, with sums, and the ratio to the 12.3 s
that are stated for the builder in use today) and DIR/aimed.txt: sightlines across what the builder
hides on the levels of --aimed. Exit status: 0 all well, 1 where something was lost or failed, 77
where the WADs are not there.
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

WADS = ["freedoom1.wad", "freedoom2.wad"]
BUILDER_SECONDS = 12.3
COLUMNS = ["machine", "wad", "map", "sectors", "cells", "theirs", "right", "wrong", "undecided",
           "hidden", "sightlines", "lost", "seconds", "result"]


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
    parser.add_argument("bake", nargs="*", metavar="BAKE-OPTION")
    return parser.parse_intermixed_args()


def run(*command):
    done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True)
    if done.returncode not in (0, 1) or (done.returncode and not done.stdout):
        raise RuntimeError(done.stderr.strip().splitlines()[-1])
    return done.stdout


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


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
    baked, made = folder / "level.slv", folder / "level.wad"
    try:
        began = processor_seconds()
        told = json.loads(run(options.sightline, "bake", wad, "--map", level, "-o", baked,
                              "--sectors", "--sight", "open", "--threads", 1, "--json", "--quiet",
                              *options.bake))
        run(options.sightline, "export", baked, "--format", "reject", "--wad", wad, "--map", level,
            "-o", made, "--quiet")
        row.update(cells=told["cells"], seconds=round(processor_seconds() - began, 3))
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


def write_table(path, rows):
    shown = [name for name in COLUMNS if name != "machine"]
    lines = [shown] + [[str(row.get(name, "")) for name in shown] for row in rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(shown))]
    sums = {name: sum(row.get(name, 0) for row in rows) for name in COLUMNS[4:-1]}
    with open(path, "w", encoding="utf-8") as stream:
        print(f"machine {platform.node()}, {os.cpu_count()} cores; {len(rows)} levels", file=stream)
        for line in lines:
            print("  ".join(text.rjust(width) for text, width in zip(line, widths)), file=stream)
        print(f"the builder hides {sums['theirs']} pairs: {sums['right']} rightly, {sums['wrong']} "
              f"wrongly, {sums['undecided']} undecided; we hide {sums['hidden']}, "
              f"{sums['lost']} of {sums['sightlines']} free sightlines across one", file=stream)
        print(f"{sums['seconds']:.2f} s of the processor; {BUILDER_SECONDS} s stated for the builder: "
              f"{BUILDER_SECONDS / max(sums['seconds'], 1e-3):.1f} times as fast", file=stream)


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
        writer = csv.DictWriter(stream, COLUMNS)
        writer.writeheader()
        for wad, level in levels(options):
            rows.append(do_level(options, wad, level, pathlib.Path(scratch), aimed))
            writer.writerow(rows[-1])
            stream.flush()
            print(" ".join(f"{name}={rows[-1][name]}" for name in COLUMNS[2:] if name in rows[-1]),
                  flush=True)
    write_table(options.output / "reject.txt", rows)
    print((options.output / "reject.txt").read_text(encoding="utf-8").splitlines()[-1])
    return int(any(row["result"] != "written" for row in rows))


if __name__ == "__main__":
    sys.exit(main())
