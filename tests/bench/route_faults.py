#!/usr/bin/env python3
"""Shortest ways that other programs are reported to find wrongly, asked there and here.

    route_faults.py SIGHTLINE [FOLDER...]

FOLDER: where `pyvisgraph` and `extremitypathfinder` can be imported from, which need tqdm and networkx; what is not
there is left out.
Each case is one of the reports of these projects that give their input, by its number. A table: the
length that each finds, and whether that way passes through solid ground, in rational numbers.
"""
import fractions
import subprocess
import sys
import tempfile
import warnings

warnings.simplefilter("ignore")

# name, boundary (or None: free around), holes, from, to
CASES = [
    ("pyvisgraph 28", None,
     [[(200, 50), (200, 100), (700, 100), (700, 50)],
      [(4, 200), (600, 200), (600, 150), (4, 150), (4, 0), (0, 0), (0, 150), (0, 200), (0, 800), (4, 800)]],
     (50, 400), (50, 20)),
    ("pyvisgraph 39", None, [[(3, 2), (6, 2), (6, 7), (3, 7)]], (3, 5), (8, 5)),
    ("pyvisgraph 51", None,
     [[(119.55624999999999, 16.48333333333367), (203.7872976182326, 81.64246915103985),
       (203.78733213720346, 112.326984303335), (189.70101758191677, 112.326984303335),
       (184.99113388465582, 75.10000000000025), (184.99113388465582, 103.01666666666668),
       (133.69454408285583, 103.01666666666668), (133.69454408285583, 75.10000000000025),
       (131.22787741618916, 75.10000000000025), (131.22787741618916, 103.0166666666666),
       (119.55624999999999, 103.01666666666759)]], (150, 110), (100, 50)),
    ("pyvisgraph 52", None, [[(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 0), (1, -1)]], (-1, 0.1), (2, 0.2)),
    ("extremitypathfinder 23", [(5, 5), (-5, 5), (-5, -5), (5, -5)], [[(-5, 1), (-5, 2), (5, 2), (5, 1)]],
     (0, 0), (0, 4)),
    ("extremitypathfinder 84",
     [(161, 47), (247, 47), (247, 7), (361, 7), (361, 441), (7, 441), (7, 7), (161, 7)],
     [[(272, 172), (272, 36), (136, 36), (136, 172), (155.6, 172), (155.6, 332.4), (252.4, 332.4), (252.4, 172)]],
     (50.004004, 44.004004), (318.004004, 44.004004)),
    ("extremitypathfinder 102",
     [(26142.0125, 17156.450879806518), (26132.83231862576, 17146.5984), (26035.535718075367, 17146.5984),
      (26032.27335014399, 17149.610679039914), (26027.229339666676, 17150.613995105043),
      (26021.2500801515, 17147.41801430944), (26019.282004894958, 17140.930139666674),
      (26022.47798569056, 17134.9508801515), (26028.8976, 17132.6966), (26033.28468137424, 17134.5984),
      (26135.3176, 17134.5984), (26139.12395970498, 17135.960337279823),
      (26150.150562720177, 17146.98694029502), (26151.483608360035, 17150.205197158022),
      (26149.0125, 17155.658574562734), (26148.8453, 17199.70631157258), (26148.8453, 17230.0991),
      (26151.163099999998, 17230.0991), (26151.163099999998, 17241.9101), (26139.352099999996, 17241.9101),
      (26139.352099999996, 17230.0991), (26141.8453, 17230.0991)], [],
     (26145.2576, 17236.0046), (26028.0976, 17141.7984)),
]


STEP = fractions.Fraction(1, 10 ** 12)


def turn(a, b, p):
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def exact(points):
    return [tuple(fractions.Fraction(float(v)) for v in p) for p in points]


def holds(polygon, p):
    """1 within, 0 on the border, -1 outside."""
    inside = -1
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        side = turn(a, b, p)
        if side == 0 and min(a[0], b[0]) <= p[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= p[1] <= max(a[1], b[1]):
            return 0
        if (a[1] > p[1]) != (b[1] > p[1]) and (side > 0) == (b[1] > a[1]):
            inside = -inside
    return inside


def is_blocked(boundary, holes, path):
    """Whether a way has solid ground on both of its sides: just beside the middles of its pieces."""
    walls = exact(boundary) if boundary else None
    solid = [exact(h) for h in holes]
    path = exact(path)
    for a, b in zip(path, path[1:]):
        shares = {fractions.Fraction(0), fractions.Fraction(1)}
        for polygon in solid + ([walls] if walls else []):
            for c, d in zip(polygon, polygon[1:] + polygon[:1]):
                at_c, at_d = turn(a, b, c), turn(a, b, d)
                ends = [c] if at_c == 0 else []
                if at_c * at_d < 0:
                    share = at_c / (at_c - at_d)
                    ends.append(tuple(c[k] + share * (d[k] - c[k]) for k in (0, 1)))
                for e in ends:
                    k = 0 if abs(b[0] - a[0]) > abs(b[1] - a[1]) else 1
                    share = (e[k] - a[k]) / (b[k] - a[k]) if b[k] != a[k] else fractions.Fraction(0)
                    if 0 < share < 1:
                        shares.add(share)
        shares = sorted(shares)
        for s, t in zip(shares, shares[1:]):
            p = tuple(a[k] + (s + t) / 2 * (b[k] - a[k]) for k in (0, 1))
            aside = ((a[1] - b[1]) * STEP, (b[0] - a[0]) * STEP)
            sides = [(p[0] + k * aside[0], p[1] + k * aside[1]) for k in (-1, 1)]
            if all(any(holds(h, q) >= 0 for h in solid) or walls and holds(walls, q) < 0 for q in sides):
                return True
    return False


def say(boundary, holes, path):
    if path is None:
        return "no way"
    length = sum(((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2) ** 0.5 for p, q in zip(path, path[1:]))
    return f"{length:.6g}" + (", through solid ground" if is_blocked(boundary, holes, path) else "")


def by_sightline(program, boundary, holes, start, goal):
    with tempfile.NamedTemporaryFile("w", suffix=".map") as file:
        file.write("sightline 1\n")
        points = [p for polygon in holes + [boundary or []] for p in polygon] + [start, goal]
        low, high = ([f(p[k] for p in points) for k in (0, 1)] for f in (min, max))
        frame = boundary or [(low[0] - 5, low[1] - 5), (high[0] + 5, low[1] - 5), (high[0] + 5, high[1] + 5),
                             (low[0] - 5, high[1] + 5)]
        file.write("walls " + " ".join(f"{x} {y}" for x, y in list(frame) + [frame[0]]) + "\n")
        for hole in holes:
            area = sum(turn((0, 0), a, b) for a, b in zip(hole, hole[1:] + hole[:1]))
            ring = hole if area > 0 else hole[::-1]
            file.write("solid " + " ".join(f"{x} {y}" for x, y in ring) + "\n")
        file.write(f"start {start[0]} {start[1]} 0\n")
        file.flush()
        done = subprocess.run([program, "path", file.name, "--from", f"{start[0]},{start[1]}", "--to",
                               f"{goal[0]},{goal[1]}", "-o", "-"], capture_output=True, text=True, check=False)
    if done.returncode == 3:
        return None
    if done.returncode:
        raise RuntimeError(done.stderr.strip())
    return [tuple(float(v) for v in line.split(",")) for line in done.stdout.splitlines()[1:]]


def by_pyvisgraph(boundary, holes, start, goal):
    import pyvisgraph
    if boundary:
        raise RuntimeError("knows no boundary (54)")
    graph = pyvisgraph.VisGraph()
    graph.build([[pyvisgraph.Point(float(x), float(y)) for x, y in h] for h in holes], status=False)
    path = graph.shortest_path(*(pyvisgraph.Point(float(x), float(y)) for x, y in (start, goal)))
    return [(p.x, p.y) for p in path]


def by_extremitypathfinder(boundary, holes, start, goal):
    import extremitypathfinder
    if not boundary:
        raise RuntimeError("needs a boundary")
    plan = extremitypathfinder.PolygonEnvironment()
    plan.store(boundary, holes)
    path, _ = plan.find_shortest_path(start, goal)
    return list(path) or None


def attempt(ask, *what):
    try:
        return say(what[0], what[1], ask(*what))
    except Exception as fault:  # pylint: disable=broad-except
        return f"{type(fault).__name__}: {fault}".replace("RuntimeError: ", "").splitlines()[0]


def main():
    program, *folders = sys.argv[1:]
    sys.path[:0] = folders
    print("| case | pyvisgraph | extremitypathfinder | here |\n| --- | --- | --- | --- |")
    for name, *case in CASES:
        here = attempt(lambda *what: by_sightline(program, *what), *case)
        print(f"| {name} | {attempt(by_pyvisgraph, *case)} | {attempt(by_extremitypathfinder, *case)} | {here} |")


if __name__ == "__main__":
    main()
