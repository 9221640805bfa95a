"""All levels of the Debian package `freedoom`: read, checked, baked, and free sightlines of the input's
own walls looked for that the bake has lost.

freedoom.py SIGHTLINE CHECK_SIGHTLINES [-o DIR] [option...] [-- BAKE-OPTION...]

Writes DIR/freedoom.csv (a line a level, as soon as it is done) and DIR/freedoom.txt, the same as a
table. With --reject each level's REJECT is exported too, held against free sightlines, and so is the
one that came with the level. Exit status: 0 all well, 1 where something was lost or failed (a bake
that does not end in time is told, and is no failure), 77 where the WADs are not there.

With --nodes the cells are those that the node builder glbsp makes (its GL nodes, version 5): the
table then ends with the time of the sets alone, for the 67 levels that glVIS ends on, beside the
106.8 s that are stated for glVIS on such cells. (glVIS itself is in no package.)
"""
import argparse
import csv
import json
import os
import pathlib
import platform
import shutil
import subprocess
import sys
import tempfile
import time

WADS = ["freedoom1.wad", "freedoom2.wad"]
GLVIS_SECONDS, GLVIS_WITHOUT = 106.8, "MAP12"
COLUMNS = ["machine", "wad", "map", "walls", "oblique", "cleaned", "cells", "inside", "portals",
           "pairs", "read_s", "subdivide_s", "check_s", "see_s", "sightlines", "near",
           "lost", "result"]
REJECT_COLUMNS = ["sectors", "hidden", "hidden_lost", "builder_hidden", "builder_lost"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sightline", type=pathlib.Path)
    parser.add_argument("check", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("out"))
    parser.add_argument("--wads", type=pathlib.Path, default=pathlib.Path("/usr/share/games/doom"))
    parser.add_argument("--levels", help="only these, with commas between: E1M1,MAP07")
    parser.add_argument("--count", type=int, default=1000000, help="free sightlines a level")
    parser.add_argument("--seconds", type=float, default=600, help="for a bake at most")
    parser.add_argument("--import-only", action="store_true", help="read, and count what there is")
    parser.add_argument("--reject", action="store_true", help="export each REJECT and check it")
    parser.add_argument("--nodes", metavar="GLBSP", help="the program glbsp: bake its cells")
    parser.add_argument("--keep", action="store_true", help="keep the baked files in DIR")
    parser.add_argument("bake", nargs="*", metavar="BAKE-OPTION")
    options = parser.parse_intermixed_args()
    if options.nodes and not shutil.which(options.nodes):
        parser.error(f"--nodes {options.nodes}: there is no such program; the package is glbsp")
    return options


def run(command, seconds=None):
    """Status, stdout and the last line of stderr; the status None where time ran out."""
    try:
        done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return None, "", "out of time"
    said = done.stderr.strip().splitlines()
    return done.returncode, done.stdout, said[-1] if said else ""


def with_nodes(options, wad, folder):
    """The WAD, or a copy in the folder to which the node builder has added its cells."""
    if not options.nodes:
        return wad
    status, out, said = run([options.nodes, "-q", "-xp", "-xr", "-v5", wad, "-o", folder / wad.name])
    if status:
        sys.exit(f"{options.nodes}: {said or out}")
    return folder / wad.name


def levels(options, folder):
    chosen = options.levels.upper().split(",") if options.levels else None
    for name in WADS:
        wad = with_nodes(options, options.wads / name, folder)
        status, out, said = run([options.sightline, "info", wad, "--json", "--quiet"])
        if status:
            sys.exit(said)
        for each in json.loads(out)["maps"]:
            if not chosen or each["name"] in chosen:
                yield wad, each["name"]


def sightlines(options, wad, level, *what):
    """The line of CSV that check_sightlines prints, as numbers, or what it said."""
    status, out, said = run([options.check, wad, "--map", level, "--count", options.count, *what])
    if status not in (0, 1):
        raise RuntimeError(said)
    names, values = (line.split(",") for line in out.splitlines())
    return dict(zip(names, map(int, values)))


def bake(options, wad, level, baked, row):
    """Whether the level was baked; the row has the reason where it was not."""
    began = time.monotonic()
    status, out, said = run([options.sightline, "bake", wad, "--map", level, "-o", baked, "--json",
                             "--quiet", "--check", *(["--subdivide", "given"] if options.nodes else []),
                             *options.bake], options.seconds)
    if status is None:
        row["result"] = f"not baked in {time.monotonic() - began:.0f} s"
        return False
    if status:
        raise RuntimeError(said)
    told = json.loads(out)
    row.update({name: told[name] for name in ("cells", "portals", "pairs")})
    row["inside"] = told["inside_cells"]
    # What welding moved walls by, to the corners of the cells, is no sightline lost.
    row["apart"] = told["cleaning"].get("largest_move", 2.0**-10)
    for name, stage in (("read_s", "read"), ("subdivide_s", "subdivide"), ("check_s", "check"),
                        ("see_s", "cell_to_cell")):
        row[name] = f"{told['seconds'][stage]:.3f}"
    return True


def try_reject(options, wad, level, baked, folder, row):
    made = folder / f"{level}.wad"
    status, _, said = run([options.sightline, "export", baked, "--format", "reject", "--wad", wad,
                           "--map", level, "-o", made, "--quiet"])
    if status:
        raise RuntimeError(said)
    ours = sightlines(options, wad, level, "--reject", made)
    builder = sightlines(options, wad, level, "--reject", wad)
    row.update(sectors=ours["sectors"], hidden=ours["hidden_pairs"], hidden_lost=ours["lost_pairs"],
               builder_hidden=builder["hidden_pairs"], builder_lost=builder["lost_pairs"])
    if not options.keep:
        made.unlink()


def do_level(options, wad, level, folder):
    row = {"machine": platform.node(), "wad": wad.name, "map": level, "result": "read"}
    try:
        status, out, said = run([options.sightline, "info", wad, "--map", level, "--json", "--quiet"])
        if status:
            raise RuntimeError(said)
        told = json.loads(out)
        row.update(walls=told["walls"], oblique=told["oblique_walls"],
                   cleaned=told["cleaning"]["after"])
        baked = folder / f"{level}.slv"
        if options.import_only or not bake(options, wad, level, baked, row):
            return row
        apart = row.pop("apart")
        found = sightlines(options, wad, level, "--slv", baked,
                           *(["--apart", apart] if options.nodes else []))
        row.update(sightlines=found["checked"], near=found["near"], lost=found["lost"],
                   result="LOST" if found["lost"] else "baked")
        if options.reject:
            try_reject(options, wad, level, baked, folder, row)
            if row["hidden_lost"]:
                row["result"] = "HIDDEN"
        if not options.keep:
            baked.unlink()
    except (RuntimeError, KeyError, ValueError) as fault:
        row["result"] = f"FAILED: {fault}"
    return row


def write_table(path, columns, rows, nodes):
    shown = [name for name in columns if name != "machine"]
    cells = [shown] + [[str(row.get(name, "")) for name in shown] for row in rows]
    widths = [max(len(line[i]) for line in cells) for i in range(len(shown))]
    with open(path, "w", encoding="utf-8") as stream:
        print(f"machine {platform.node()}, {os.cpu_count()} cores; {len(rows)} levels", file=stream)
        for line in cells:
            padded = (text.ljust(width) if shown[i] in ("wad", "map", "result") else
                      text.rjust(width) for i, (text, width) in enumerate(zip(line, widths)))
            print("  ".join(padded).rstrip(), file=stream)
        seconds = {row["map"]: float(row["see_s"]) for row in rows if "see_s" in row}
        print(f"sets of {len(seconds)} levels: {sum(seconds.values()):.3f} s", file=stream)
        if nodes:
            without = sum(seconds.values()) - seconds.get(GLVIS_WITHOUT, 0)
            print(f"without {GLVIS_WITHOUT}: {without:.3f} s; {GLVIS_SECONDS} s stated for glVIS on 67 "
                  f"levels: {GLVIS_SECONDS / max(without, 1e-3):.0f} times as fast", file=stream)


def main():
    options = arguments()
    if not all((options.wads / name).exists() for name in WADS):
        print(f"skipped: {options.wads} has no {' and '.join(WADS)} (Debian package freedoom)")
        return 77
    options.output.mkdir(parents=True, exist_ok=True)
    columns = COLUMNS[:-1] + (REJECT_COLUMNS if options.reject else []) + COLUMNS[-1:]
    rows = []
    with open(options.output / "freedoom.csv", "w", newline="", encoding="utf-8") as stream, \
            tempfile.TemporaryDirectory(prefix="sightline-freedoom-") as scratch:
        writer = csv.DictWriter(stream, columns)
        writer.writeheader()
        folder = options.output if options.keep else pathlib.Path(scratch)
        for wad, level in levels(options, pathlib.Path(scratch)):
            rows.append(do_level(options, wad, level, folder))
            writer.writerow(rows[-1])
            stream.flush()
            print(" ".join(f"{name}={rows[-1][name]}" for name in columns[2:] if name in rows[-1]),
                  flush=True)
    write_table(options.output / "freedoom.txt", columns, rows, options.nodes)
    return int(any(row["result"].startswith(("LOST", "HIDDEN", "FAILED")) for row in rows))


if __name__ == "__main__":
    sys.exit(main())
