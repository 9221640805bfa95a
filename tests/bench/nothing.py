"""What effects cost a map that has none: the command built with them beside one built without.

nothing.py MAP [option...] [-- BAKE-OPTION...]

Builds the command twice, or brings both builds up to date (BUILDS/on and BUILDS/off, by
-DSIGHTLINE_EFFECTS), and bakes the map by each of --methods with one as with the other, in turn, so
that a busy machine is busy for both. Prints CSV with a line for each method:

time           processor time of a whole bake: the median ratio of with to without, over --rounds
               pairs of runs; time_noise: the same of the build without to itself
memory         the least peak of a run, as a ratio; memory_noise: the same as above
instructions   of a whole bake by callgrind, as a ratio; empty where there is no valgrind
bytes          equal or differ: the baked files
effect_work    the sum of all counters of effect work in the reports of both

Exit status: 0 where files are equal, instructions within 1 % and counters 0, else 1.
"""
import argparse
import csv
import json
import os
import pathlib
import platform
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = ["machine", "map", "method", "time", "time_noise", "memory", "memory_noise",
           "instructions_with", "instructions", "bytes", "effect_work"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("map", type=pathlib.Path)
    parser.add_argument("bake", nargs="*", metavar="BAKE-OPTION")
    parser.add_argument("--methods", default="sweep,dfs,prune,multipass")
    parser.add_argument("--rounds", type=int, default=101)
    parser.add_argument("--builds", type=pathlib.Path, default=ROOT / "build" / "nothing")
    return parser.parse_intermixed_args()


def build(folder, effects):
    """The command, built with effects or without."""
    configure = ["cmake", "-G", "Ninja", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
                 f"-DSIGHTLINE_EFFECTS={effects}", "-DSIGHTLINE_TESTS=OFF",
                 "-DSIGHTLINE_VIEWER=OFF"]
    make = ["cmake", "--build", folder, "--target", "sightline_command"]
    for command in (configure, make):
        subprocess.run(list(map(str, command)), check=True, stdout=sys.stderr)
    return folder / "tools" / "sightline"


def run(command):
    """Processor seconds and peak memory of one run."""
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = status
    if status:
        raise SystemExit(f"{command[0]} failed")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss


def instructions(command):
    """Of a whole run, or None where they cannot be counted."""
    if not shutil.which("valgrind"):
        return None
    done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                           *map(str, command)], stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, check=True)
    return int(re.search(r"Collected : (\d+)", done.stderr)[1])


def effect_work(command):
    done = subprocess.run([*map(str, command), "--json"], stdout=subprocess.PIPE, check=True)
    return sum(json.loads(done.stdout)["effect_work"].values())


def measure(programs, options, method, folder):
    """A line of the table."""
    outputs = {name: folder / f"{name}.slv" for name in programs}
    commands = {name: [program, "bake", options.map, "-o", outputs[name], "--method", method,
                       "--threads", "1", "--quiet", *options.bake]
                for name, program in programs.items()}
    runs = {name: [] for name in programs}
    order = list(programs)
    for _ in range(options.rounds):
        order = order[1:] + order[:1]
        for name in order:
            runs[name].append(run(commands[name]))

    def compare(a, b):
        time = statistics.median(x[0] / y[0] for x, y in zip(runs[a], runs[b]))
        memory = min(x[1] for x in runs[a]) / min(y[1] for y in runs[b])
        return round(time, 4), round(memory, 4)

    counts = {name: instructions(commands[name]) for name in ("with", "without")}
    line = {"machine": platform.node(), "map": options.map.name, "method": method}
    line["time"], line["memory"] = compare("with", "without")
    line["time_noise"], line["memory_noise"] = compare("again", "without")
    line["instructions_with"] = counts["with"]
    if counts["with"]:
        line["instructions"] = round(counts["with"] / counts["without"], 5)
    same = outputs["with"].read_bytes() == outputs["without"].read_bytes()
    line["bytes"] = "equal" if same else "differ"
    line["effect_work"] = sum(effect_work(commands[name]) for name in ("with", "without"))
    return line


def main():
    options = arguments()
    programs = {"with": build(options.builds / "on", "ON"),
                "without": build(options.builds / "off", "OFF")}
    programs["again"] = programs["without"]
    table = csv.DictWriter(sys.stdout, COLUMNS, lineterminator="\n")
    table.writeheader()
    well = True
    with tempfile.TemporaryDirectory() as folder:
        for method in options.methods.split(","):
            line = measure(programs, options, method, pathlib.Path(folder))
            table.writerow(line)
            sys.stdout.flush()
            well &= line["bytes"] == "equal" and line["effect_work"] == 0
            well &= abs(line.get("instructions", 1) - 1) <= 0.01
    return 0 if well else 1


if __name__ == "__main__":
    sys.exit(main())
