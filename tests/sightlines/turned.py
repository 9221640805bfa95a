"""Maps turned and moved as people do it, in doubles: baked, read back, and held against programs
that share nothing with the library.

turned.py SIGHTLINE CHECKS INPUT... [-o FILE.csv] [option...]

SIGHTLINE is the command, CHECKS the folder of check_sightlines and check_regions. An INPUT is a map
of any format, or WAD:NAME for one level of a WAD (WAD:all for each); @FILE names a file with an
input a line. Each map is turned by each of --angles about the origin, and moved by --move along
both axes once; for each of these:

  bake --check, info      exit status 0: what is written can be read back
  tiling                  areas of the exported cells, summed as rationals, are the bounds' area, and
                          each side of a cell has one other side, or is on the border
  methods                 all exact methods give the same visible sets
  check_sightlines        --count free sightlines of the walls as read; none is lost
  check_regions           --regions visible regions agree to 1e-9

Writes a line of CSV for each; exit status 1 where anything failed.
"""
import argparse
import collections
import csv
import fractions
import json
import math
import pathlib
import subprocess
import sys
import tempfile

COLUMNS = ["input", "angle", "move", "walls", "welded", "crossings", "largest_move", "cells", "portals",
           "pairs", "read_s", "subdivide_s", "see_s", "lost", "regions_worst", "result"]
PLACES = {"wall": 4, "walls": None, "mirror": 4, "oneway": 4, "seam": 4, "cell": None,
          "solid": None, "open": None}
METHODS = ["dfs", "prune", "multipass"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, fromfile_prefix_chars="@",
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sightline", type=pathlib.Path)
    parser.add_argument("checks", type=pathlib.Path)
    parser.add_argument("inputs", nargs="+")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("--angles", default="0,17.3,33,45,0.001")
    parser.add_argument("--move", type=float, default=1e6, help="0 for none")
    parser.add_argument("--count", type=int, default=1000000)
    parser.add_argument("--regions", type=int, default=1000)
    parser.add_argument("--methods-below", type=int, default=3000, help="cells, for all methods")
    parser.add_argument("--tiling-below", type=int, default=20000, help="cells, for rationals")
    parser.add_argument("bake", nargs="*", metavar="-- BAKE-OPTION")
    return parser.parse_intermixed_args()


def run(*command, fine=(0,)):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode not in fine:
        raise RuntimeError(f"{pathlib.Path(command[0]).name} {command[1]}: exit status "
                           f"{done.returncode}: {(done.stderr.strip().splitlines() or [''])[-1]}")
    return done.stdout


def turned(text, angle, move):
    cosine, sine = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    same = angle == 0 and move == 0

    def place(x, y):
        x, y = float(x), float(y)
        return [repr(x), repr(y)] if same else [repr(cosine * x - sine * y + move),
                                                repr(sine * x + cosine * y + move)]

    for line in text.splitlines():
        words = line.split("#")[0].split()
        if not words:
            continue
        if words[0] in PLACES:
            count = PLACES[words[0]] or len(words) - 1
            first = 1
        elif words[0] == "door":
            first, count = 2, 4
        elif words[0] == "start":
            first, count = 1, 2
        elif words[0] in ("object", "path", "snap"):
            continue
        else:
            yield " ".join(words)
            continue
        out = words[:first]
        for i in range(first, first + count, 2):
            out += place(words[i], words[i + 1])
        yield " ".join(out + words[first + count:])


def inputs(options, folder):
    """Name and map text of each input."""
    for number, name in enumerate(options.inputs):
        path, _, level = name.partition(":")
        names = [level]
        if level == "all":
            told = json.loads(run(options.sightline, "info", path, "--json", "--quiet"))
            names = [each["name"] for each in told["maps"]]
        for level in names:
            out = folder / f"{number}.map"
            choice = ["--map", level] if level else []
            choice += ["--slice", "1040"] if path.endswith(".ug") else []
            try:
                run(options.sightline, "convert", path, *choice, "-o", out, "--quiet")
            except RuntimeError as fault:
                print(f"{path} {level}: {fault}", file=sys.stderr)
                continue
            yield f"{pathlib.Path(path).name} {level}".strip(), out.read_text()


def check_tiling(told):
    """Of an export: what is wrong with it, or None."""
    box = [fractions.Fraction(v) for v in told["bounds"]]
    area = fractions.Fraction(0)
    sides = collections.Counter()
    for cell in told["cells"]:
        points = [tuple(map(fractions.Fraction, p)) for p in cell["polygon"]]
        for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]):
            area += ax * by - ay * bx
            sides[ax, ay, bx, by] += 1
    if area != 2 * (box[2] - box[0]) * (box[3] - box[1]):
        return f"areas add up to {float(area) / 2!r}"
    for (ax, ay, bx, by), count in sides.items():
        border = ax == bx and ax in (box[0], box[2]) or ay == by and ay in (box[1], box[3])
        if count != 1 or (sides[bx, by, ax, ay] if (bx, by, ax, ay) in sides else 0) != (not border):
            return f"the side {float(ax)!r} {float(ay)!r} {float(bx)!r} {float(by)!r} has no other side"
    return None


def sets_of(options, text, method, folder):
    baked, out = folder / f"{method}.slv", folder / f"{method}.json"
    run(options.sightline, "bake", text, "-o", baked, "--method", method, "--quiet", *options.bake)
    run(options.sightline, "export", baked, "--format", "json", "-o", out, "--quiet")
    return json.loads(out.read_text())


def check(options, text, folder, row):
    source, baked = folder / "turned.map", folder / "turned.slv"
    source.write_text("\n".join(text) + "\n")
    report = json.loads(run(options.sightline, "bake", source, "-o", baked, "--json", "--quiet",
                            "--check", "--threads", "1", *options.bake))
    row.update({k: report[k] for k in ("walls", "cells", "portals", "pairs")})
    row.update({k: report["cleaning"].get(k, "") for k in ("welded", "crossings", "largest_move")})
    for name, stage in ("read_s", "read"), ("subdivide_s", "subdivide"), ("see_s", "cell_to_cell"):
        row[name] = f"{report['seconds'][stage]:.4f}"
    run(options.sightline, "info", baked, "--quiet")
    exported = None
    if row["cells"] <= options.tiling_below:
        out = folder / "turned.json"
        run(options.sightline, "export", baked, "--format", "json", "-o", out, "--quiet")
        exported = json.loads(out.read_text())
        fault = check_tiling(exported) if exported["cells"][0]["polygon"] and "kd" != report["subdivide"] else None
        if fault:
            raise RuntimeError(fault)
    if exported and row["cells"] <= options.methods_below:
        for method in METHODS:
            if sets_of(options, source, method, folder)["pvs"] != exported["pvs"]:
                raise RuntimeError(f"{method} sees something else")
    if options.count:
        out = run(options.checks / "check_sightlines", source, "--slv", baked, "--count",
                  options.count, fine=(0, 1))
        names, values = (line.split(",") for line in out.splitlines())
        row["lost"] = dict(zip(names, values))["lost"]
        if row["lost"] != "0":
            raise RuntimeError("sightlines are lost")
    if options.regions:
        out = run(options.checks / "check_regions", baked, "--count", options.regions, fine=(0, 1))
        row["regions_worst"], wrong = out.splitlines()[1].rsplit(",", 2)[1:]
        if wrong != "0":
            raise RuntimeError(f"{wrong} regions differ")


def main():
    options = arguments()
    output = options.output.open("w", newline="") if options.output else sys.stdout
    table = csv.DictWriter(output, COLUMNS)
    table.writeheader()
    failed = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for source, text in inputs(options, folder):
            ways = [(float(a), 0.0) for a in options.angles.split(",")]
            ways += [(0.0, options.move)] if options.move else []
            for angle, move in ways:
                row = {"input": source, "angle": angle, "move": move, "result": "well"}
                try:
                    check(options, list(turned(text, angle, move)), folder, row)
                except (RuntimeError, ValueError, KeyError) as fault:
                    row["result"] = str(fault)
                    failed += 1
                table.writerow(row)
                output.flush()
    print(f"{failed} failed", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
