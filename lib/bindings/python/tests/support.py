"""What the tests share: maps, exact geometry, the command line."""
import csv
import io
import os
import pathlib
import subprocess
from fractions import Fraction

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[4]
MAPS = ROOT / "maps"
# The program `sightline`; None: tests that compare with it are skipped.
COMMAND = os.environ.get("SIGHTLINE_COMMAND")

# A room of 10 by 8 with an opening of 2, and a wall beside it.
HOUSE = "sightline 1\nwalls 5 0 10 0 10 8 0 8 0 0 3 0\nwall 12 0 12 8\n"
TWO_ROOMS = [(0, 0, 8, 0), (8, 0, 8, 4), (8, 4, 0, 4), (0, 4, 0, 0), (4, 0, 4, 3)]


def command(*arguments):
    done = subprocess.run([COMMAND, *map(str, arguments)], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)
    if done.returncode:
        raise AssertionError(done.stderr)
    return done.stdout


def table(text):
    """The columns of a CSV table."""
    rows = list(csv.DictReader(io.StringIO(text)))
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0]}


def turn(a, b, c):
    """The sign of the turn a, b, c, exact."""
    (ax, ay), (bx, by), (cx, cy) = ([Fraction(float(v)) for v in p] for p in (a, b, c))
    value = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (value > 0) - (value < 0)


def crosses(p, q, a, b):
    """Whether the segments have a point in common, exact."""
    t = [turn(p, q, a), turn(p, q, b), turn(a, b, p), turn(a, b, q)]
    if t[0] != t[1] and t[2] != t[3]:
        return True
    return any(turn(u, v, w) == 0 and min(u[0], v[0]) <= w[0] <= max(u[0], v[0]) and
               min(u[1], v[1]) <= w[1] <= max(u[1], v[1])
               for u, v, w in ((p, q, a), (p, q, b), (a, b, p), (a, b, q)))


def plainly_sees(walls, p, q):
    """Whether no wall is met between two points that are on none: the slow, exact way."""
    return not any(crosses(p, q, wall[:2], wall[2:]) for wall in walls)


def random_points(handle, count, seed):
    x0, y0, x1, y1 = handle.bounds
    return np.random.default_rng(seed).uniform((x0, y0), (x1, y1), (count, 2))


def inside_points(level, count, seed):
    points = random_points(level, 4 * count, seed)
    inside = np.append(level.cell_arrays()["inside"], False)
    return points[inside[level.locate(points)]][:count]
