"""Growth of `sightline segments` on generated cities: time and memory by number of segments.

segments.py SIGHTLINE [--segments N,N,...] [--pieces K] [OPTION...]

A city is a bent lattice of crossings. Of the streets between them 15 % are missing, and half are
curved. A street has K pieces on average (default 4), as digitized streets have: in between, two
segments meet. --pieces 1 makes straight streets. OPTION... go to `sightline segments`.
Prints a table with tabs between: segments read, seconds of the processor, microseconds a segment,
peak memory in MiB.
"""
import argparse
import math
import os
import pathlib
import random
import subprocess
import tempfile


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sightline", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--segments", default="1000,10000",
                        type=lambda text: [int(number) for number in text.split(",")])
    parser.add_argument("--pieces", type=float, default=4)
    return parser.parse_known_args()


def street(chance, a, b, pieces):
    """The corners of a street from a to b; a parabola where it is curved."""
    count = 1 if pieces <= 1 else max(1, round(chance.expovariate(1 / (pieces - 0.5)) + 0.5))
    bend = chance.choice((0, chance.uniform(-0.25, 0.25)))
    corners = []
    for i in range(count + 1):
        t = i / count
        aside = 4 * t * (1 - t) * bend
        corners.append((round(a[0] + (b[0] - a[0]) * t - (b[1] - a[1]) * aside, 3),
                        round(a[1] + (b[1] - a[1]) * t + (b[0] - a[0]) * aside, 3)))
    return corners


def write_city(path, segments, pieces):
    chance = random.Random(1)
    side = max(2, round(math.sqrt(segments / pieces / 1.7)))
    at = [[(100 * (x + chance.uniform(-0.3, 0.3)), 100 * (y + chance.uniform(-0.3, 0.3)))
           for y in range(side)] for x in range(side)]
    with open(path, "w", encoding="ascii") as out:
        out.write("x1,y1,x2,y2\n")
        for x in range(side):
            for y in range(side):
                for to in ((x + 1, y), (x, y + 1)):
                    if max(to) == side or chance.random() < 0.15:
                        continue
                    corners = street(chance, at[x][y], at[to[0]][to[1]], pieces)
                    for a, b in zip(corners, corners[1:]):
                        out.write(f"{a[0]},{a[1]},{b[0]},{b[1]}\n")


def main():
    plan, options = arguments()
    print("segments\tseconds\tmicroseconds a segment\tMiB")
    with tempfile.TemporaryDirectory() as folder:
        for segments in plan.segments:
            city, table = f"{folder}/city.csv", f"{folder}/out.csv"
            write_city(city, segments, plan.pieces)
            process = subprocess.Popen([plan.sightline, "segments", city, "-q", "-o", table,
                                        *options])
            _, status, used = os.wait4(process.pid, 0)
            if status:
                raise SystemExit(f"sightline segments: status {status}")
            with open(table, encoding="ascii") as lines:
                count = sum(not line.startswith("#") for line in lines) - 1
            seconds = used.ru_utime + used.ru_stime
            print(f"{count}\t{seconds:.2f}\t{seconds / count * 1e6:.0f}\t{used.ru_maxrss / 1024:.0f}",
                  flush=True)


main()
