#!/usr/bin/env python3
"""What each effect costs, alone and together: a generated office with 30 doors, 4 mirrors, 2 panes
of glass and a view range.

effects.py PROGRAM [--method NAME] [--size N] [--repeat N] [--pictures FOLDER]
effects.py PROGRAM --mirrors    stabbing tests on three maps with 6 mirrors, by the sweep and depth-first

CSV on stdout: machine, method, effects, seconds for the visible sets (the least of the runs, one
thread), times the seconds without effects, pairs, pairs by mirror, bytes of door sets, size of the
file. --pictures writes a picture of each map too.
"""
import argparse
import itertools
import json
import pathlib
import platform
import subprocess
import tempfile

DOORS, MIRRORS, PANES, RANGE = 30, 4, 2, 30
MIRRORED = {"office": 12, "city": 9, "pillars": 10}  # kinds of maps and their sizes
EFFECTS = ("doors", "mirrors", "glass", "range")


def run(program, *arguments):
    """Runs a command and gives back what it prints."""
    return subprocess.run([program, *map(str, arguments)], check=True, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout


def spread(items, count):
    """So many of the items, evenly from the first to the last."""
    return [items[i * len(items) // count] for i in range(count)]


def length(at):
    return abs(at[2] - at[0]) + abs(at[3] - at[1])


def statements(program, plan, folder):
    """For each effect the lines of map text that add it. Doors and glass stand in gaps of walls,
    mirrors on long walls."""
    baked = folder / "walls.slv"
    run(program, "bake", plan, "-o", baked)
    level = json.loads(run(program, "export", baked, "--format", "json"))
    gaps = [p["segment"] for p in level["portals"] if length(p["segment"]) == 1]
    long_walls = [w for w in level["walls"] if length(w) >= 5]
    panes = spread(gaps, PANES)
    doors = spread([gap for gap in gaps if gap not in panes], DOORS)
    return {
        "doors": [f"door d{i} {put(at)} open" for i, at in enumerate(doors)],
        "mirrors": [f"mirror {put(at)}" for at in spread(long_walls[1:], MIRRORS)],
        "glass": [f"oneway {put(at)}" for at in panes],
        "range": [f"range {RANGE}"],
    }


def put(at):
    return " ".join(f"{value:g}" for value in at)


def write_maps(plan, lines):
    """A map for each combination of effects, the one without any first."""
    maps = {}
    for count in range(len(EFFECTS) + 1):
        for chosen in itertools.combinations(EFFECTS, count):
            label = "+".join(chosen) or "none"
            maps[label] = plan.with_name(f"{label}.map")
            added = sum((lines[effect] for effect in chosen), [])
            maps[label].write_text("\n".join([plan.read_text(), *added, ""]))
    return maps


def bake(program, method, plan):
    chosen = ["--method", method] if method else []
    return json.loads(run(program, "bake", plan, "-o", plan.with_suffix(".slv"), "--threads", 1,
                          "--json", *chosen))


def print_mirror_tests(program, folder):
    plan = folder / "mirrored.map"
    print("map,cells,sweep,dfs")
    for kind, size in MIRRORED.items():
        run(program, "generate", kind, "--size", size, "-o", plan)
        cells = bake(program, None, plan)["cells"]
        walls = json.loads(run(program, "export", plan.with_suffix(".slv"), "--format", "json"))["walls"]
        mirrors = [f"mirror {put(at)}" for at in spread(walls, 6)]
        plan.write_text("\n".join([plan.read_text(), *mirrors, ""]))
        tests = [bake(program, method, plan)["tests"] for method in ("sweep", "dfs")]
        print(kind, cells, *tests, sep=",")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--method")
    parser.add_argument("--size", type=int, default=3)
    parser.add_argument("--repeat", type=int, default=15)
    parser.add_argument("--pictures", type=pathlib.Path)
    parser.add_argument("--mirrors", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if options.mirrors:
            print_mirror_tests(options.program, folder)
            return
        plan = folder / "office.map"
        run(options.program, "generate", "office", "--size", options.size, "-o", plan)
        maps = write_maps(plan, statements(options.program, plan, folder))
        least = dict.fromkeys(maps, float("inf"))
        reports = {}
        for _ in range(options.repeat):  # all maps by turns, so that all meet the same load
            for label, file in maps.items():
                reports[label] = bake(options.program, options.method, file)
                least[label] = min(least[label], reports[label]["seconds"]["cell_to_cell"])
        print("machine,method,effects,seconds,times_none,pairs,mirrored_pairs,door_bytes,file_bytes")
        for label, report in reports.items():
            work = report["effect_work"]
            print(f"{platform.machine()},{report['method']},{label},{least[label]:.5f},"
                  f"{least[label] / least['none']:.2f},{report['pairs']},{work['mirrored_pairs']},"
                  f"{work['door_bytes']},{report['file_bytes']}")
        for label, file in maps.items() if options.pictures else ():
            options.pictures.mkdir(parents=True, exist_ok=True)
            run(options.program, "draw", file.with_suffix(".slv"), "-o",
                options.pictures / f"{label}.png")


if __name__ == "__main__":
    main()
