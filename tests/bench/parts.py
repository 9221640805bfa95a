"""Threads and shards: what two threads, and four shards with their merge, take beside one run.

parts.py SIGHTLINE [--walls N,...] [--rounds N] [--wad FILE.wad --map NAME]

Bakes generated cities, and a level of a WAD where one is given, by the clock: with one thread and
with two, and in four shards, one after the other with one thread each, which `merge` joins. The runs
of a round follow each other, and the least of some rounds counts. Prints CSV: seconds of one run,
and what the others take of that, 1 being as long:
  two_threads_stage   two threads, the stage cell to cell alone
  two_threads         two threads, all from reading to written
  shards_all          four shards and the merge, all added up
  shards_longest      the longest of four machines: the longest shard and the merge
All files must have the same bytes. Exit status: 0, or 1 where they have not. Means something on an
idle machine only.
"""
import argparse
import json
import pathlib
import platform
import subprocess
import sys
import tempfile
import time

SHARDS = 4
COLUMNS = ["machine", "map", "walls", "cells", "one_run_s", "two_threads_stage", "two_threads",
           "shards_all", "shards_longest"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sightline", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--walls", default="10000,100000", help="sizes of cities")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--wad", type=pathlib.Path)
    parser.add_argument("--map")
    return parser.parse_args()


def timed(*command):
    """Seconds by the clock, and what the command printed."""
    began = time.monotonic()
    done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, text=True, check=True)
    return time.monotonic() - began, done.stdout


def do_round(program, source, folder):
    """Seconds of each way, and what a bake told."""
    bake = [program, "bake", *source, "--json", "--quiet"]
    one, told = timed(*bake, "--threads", 1, "-o", folder / "one.slv")
    two, of_two = timed(*bake, "--threads", 2, "-o", folder / "two.slv")
    told, of_two = json.loads(told), json.loads(of_two)
    names = [folder / f"{i}.slv" for i in range(1, SHARDS + 1)]
    shards = [timed(*bake, "--threads", 1, "--shard", f"{i}/{SHARDS}", "-o", name)[0]
              for i, name in enumerate(names, 1)]
    merge, _ = timed(program, "merge", *names, "-o", folder / "merged.slv", "--quiet")
    whole = (folder / "one.slv").read_bytes()
    same = all((folder / name).read_bytes() == whole for name in ("two.slv", "merged.slv"))
    return told, same, {"one": one, "two": two, "one_stage": told["seconds"]["cell_to_cell"],
                        "two_stage": of_two["seconds"]["cell_to_cell"],
                        "all": sum(shards) + merge, "longest": max(shards) + merge}


def do_map(options, name, source, folder):
    least, all_same = {}, True
    for _ in range(options.rounds):
        told, same, seconds = do_round(options.sightline, source, folder)
        all_same &= same
        least = {way: min(took, least.get(way, took)) for way, took in seconds.items()}
    ratios = [least["two_stage"] / least["one_stage"], least["two"] / least["one"],
              least["all"] / least["one"], least["longest"] / least["one"]]
    print(platform.node(), name, told["walls"], told["cells"], f"{least['one']:.3f}",
          *(f"{ratio:.2f}" for ratio in ratios), sep=",", flush=True)
    if not all_same:
        print(f"{name}: other bytes than those of one run", file=sys.stderr)
    return all_same


def main():
    options = arguments()
    print(",".join(COLUMNS), flush=True)
    well = True
    with tempfile.TemporaryDirectory(prefix="sightline-parts-") as scratch:
        folder = pathlib.Path(scratch)
        for walls in options.walls.split(","):
            city = folder / "city.map"
            timed(options.sightline, "generate", "city", "--walls", walls, "-o", city, "--quiet")
            well &= do_map(options, f"city {walls}", [city], folder)
        if options.wad:
            source = [options.wad, "--map", options.map or "MAP01"]
            well &= do_map(options, options.map or "MAP01", source, folder)
    return int(not well)


if __name__ == "__main__":
    sys.exit(main())
