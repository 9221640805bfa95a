"""What each command takes on maps of many walls, as a multiple of a bake: with a wall far away, and without.

commands.py SIGHTLINE [--walls N,...] [--limit SECONDS]

The maps are the rooms of the command test `program_in_time`, and the same with one wall 10^7 away.
Prints CSV: by command, the seconds of the processor, all threads together, of each map, over those of
its bake. Each command runs once, for at most --limit seconds by the clock; "over" is longer.
"""
import argparse
import pathlib
import platform
import resource
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "command"))
import test_in_time  # noqa: E402

COMMANDS = """
check a.map
info a.map
convert a.map --clean -o c.map
eye a.slv --at 1.5,1.25
explain a.slv 1,1 30,30
export a.slv --format json -o a.json
draw a.slv -o a.svg
isovist a.map --at 1.5,1.25
isovist a.map --squares 40 -o i.csv
vga a.map --grid 5 -o v.csv
axial a.map -o x.csv
regions a.map
viewcells a.map
walk a.map
compare a.map --methods sweep
compare a.map --methods dfs,prune,multipass --solvers funnel
""".strip().splitlines()


def seconds(program, folder, words, limit):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run([program, *words], cwd=folder, timeout=limit, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, check=False)
    except subprocess.TimeoutExpired:
        return "over"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        return "refused"
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(program, walls, limit):
    """The time of a bake, and of each command as a multiple of it."""
    with tempfile.TemporaryDirectory() as folder:
        lines = [f"wall {a!r} {b!r} {c!r} {d!r}" for a, b, c, d in walls]
        text = "\n".join(["sightline 1", *lines, "start 1.5 1.25 0", ""])
        pathlib.Path(folder, "a.map").write_text(text, encoding="utf-8")
        bake = seconds(program, folder, ["bake", "a.map", "-o", "a.slv"], limit)
        yield f"{bake:.3f}"
        for command in COMMANDS:
            took = seconds(program, folder, command.split(), limit)
            yield took if isinstance(took, str) else f"{took / bake:.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sightline", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--walls", default="5000,10000")
    parser.add_argument("--limit", type=float, default=60)
    options = parser.parse_args()
    columns = {}
    for count in map(int, options.walls.split(",")):
        rooms = test_in_time.rooms(count)
        for name, walls in (("rooms", rooms), ("far", rooms + test_in_time.FAR)):
            columns[f"{name}_{len(walls)}"] = list(measure(options.sightline, walls, options.limit))
    print(",".join(["machine", "command", *columns]))
    for i, command in enumerate(["bake (s)", *COMMANDS]):
        print(",".join([platform.node(), f'"{command}"', *(column[i] for column in columns.values())]))


if __name__ == "__main__":
    main()
