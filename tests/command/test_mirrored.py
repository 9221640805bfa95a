"""What cells see by oblique mirrors with open sight, held against sequences of portals in rationals.

test_mirrored.py PROGRAM [--count N]    by default 5 random maps

The program places portals behind oblique mirrors in floating point. The reflection of a rational point in a
mirror with rational ends is rational, so this test decides all signs without rounding. It takes the
cells and portals of the JSON export, and knows nothing else of the program.

A sequence of portals has a sightline with open sight if some line has all left ends strictly on its left, all
right ends strictly on its right. By Kirchberger's theorem that is so unless the hulls of up to four of the
ends touch.
"""
import argparse
import json
import random
from fractions import Fraction

import sandbox

DEPTH = 2
# An end of a mirror in line with portals; and a mirror seen from one side.
MAPS = ["walls 0 0 4 0 4 7 0 7 0 0\nmirror 1 7 2 4\nmirror 4 1 3 2 one\n",
        "walls 0 0 5 0 5 12 0 12 0 0\nmirror 1 5 3 6 one\n"]


def turn(a, b, c):
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (area > 0) - (area < 0)


def is_on(p, a, b):
    return (turn(a, b, p) == 0 and min(a[0], b[0]) <= p[0] <= max(a[0], b[0])
            and min(a[1], b[1]) <= p[1] <= max(a[1], b[1]))


def segments_touch(a, b, c, d):
    if turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0:
        return True
    return is_on(a, c, d) or is_on(b, c, d) or is_on(c, a, b) or is_on(d, a, b)


def is_in(p, a, b, c):
    turns = {turn(a, b, p), turn(b, c, p), turn(c, a, p)}
    return turn(a, b, c) != 0 and not {1, -1} <= turns


def hulls_touch(points, others):
    """Whether the hulls of two sets touch, where those without the last point of `points` do not."""
    last, rest = points[-1], points[:-1]
    return (any(last == q for q in others)
            or any(is_on(last, a, b) for a in others for b in others if a < b)
            or any(is_in(last, a, b, c) for a in others for b in others for c in others if a < b < c)
            or any(segments_touch(last, p, a, b) for p in rest for a in others for b in others if a <= b)
            or any(is_in(q, last, a, b) for q in others for a in rest for b in rest if a < b))


def reflect(mirror, p):
    (ax, ay), (bx, by) = mirror
    dx, dy = bx - ax, by - ay
    share = 2 * (dx * (p[1] - ay) - dy * (p[0] - ax)) / (dx * dx + dy * dy)
    return p[0] + dy * share, p[1] - dx * share


def exact(numbers):
    values = [Fraction(number) for number in numbers]
    return tuple(zip(values[0::2], values[1::2]))


class Level:
    def __init__(self, level):
        self.cells = [[exact(p)[0] for p in cell["polygon"]] for cell in level["cells"]]
        one_sided = set(level.get("one_sided_mirrors", []))
        mirrors = [(exact(at), i in one_sided) for i, at in enumerate(level["mirrors"])]
        self.out = [[] for _ in self.cells]  # of each cell: ends as crossed, the cell behind, a mirror
        for portal in level["portals"]:
            a, b = portal["cells"]
            left, right = exact(portal["segment"])
            self.out[a].append((left, right, b, None))
            self.out[b].append((right, left, a, None))
        for number, polygon in enumerate(self.cells):
            for a, b in zip(polygon, polygon[1:] + polygon[:1]):  # the cell is on the left
                for (p, q), one in mirrors:
                    self.add_mirror(number, a, b, p, q, one)

    def add_mirror(self, number, a, b, p, q, one):
        if turn(p, q, a) or turn(p, q, b):
            return
        same_way = (b[0] - a[0]) * (q[0] - p[0]) + (b[1] - a[1]) * (q[1] - p[1]) > 0
        if one and not same_way:
            return
        low, high = (p, q) if same_way else (q, p)
        right = low if is_on(low, a, b) else a
        left = high if is_on(high, a, b) else b
        if left != right and is_on(left, p, q) and is_on(right, p, q):
            self.out[number].append((left, right, number, (p, q)))

    def mirrored_from(self, cell):
        seen = set()
        self.go_on(cell, [], [], [], None, seen)
        return sorted(seen)

    def go_on(self, cell, lefts, rights, mirrors, last, seen):
        """Mirrors: those passed, the last one first."""
        if mirrors:
            seen.add(cell)
        for left, right, behind, mirror in self.out[cell]:
            if mirror and (len(mirrors) == DEPTH or mirror == last):
                continue
            for at in mirrors:
                left, right = reflect(at, left), reflect(at, right)
            if len(mirrors) % 2:
                left, right = right, left
            if hulls_touch(lefts + [left], rights) or hulls_touch(rights + [right], lefts + [left]):
                continue
            more = [mirror] + mirrors if mirror else mirrors
            self.go_on(behind, lefts + [left], rights + [right], more, mirror, seen)


def random_map(numbers):
    """A room with oblique walls and mirrors between points of a grid."""
    def segment():
        a, b = [(numbers.randrange(1, 10), numbers.randrange(1, 10)) for _ in range(2)]
        return segment() if a == b else "{} {} {} {}".format(*a, *b)

    lines = ["walls 0 0 10 0 10 10 0 10 0 0"]
    lines += [f"wall {segment()}" for _ in range(numbers.randrange(3))]
    lines += [f"mirror {segment()}{numbers.choice(['', ' one'])}" for _ in range(2)]
    return "\n".join(lines) + "\n"


def check(box, text):
    """Compares one map; gives how many pairs are seen by mirror."""
    box.path("m.map").write_text("sightline 1\n" + text)
    sandbox.check(box.run(["bake", "m.map", "-o", "m.slv", "--sight", "open", "-q", "--mirror-depth",
                           str(DEPTH)]).status == 0, "is baked")
    level = json.loads(box.run(["export", "m.slv", "--format", "json"]).stdout)
    rational = Level(level)
    for cell, seen in enumerate(level["mirrored"]):
        truth = rational.mirrored_from(cell)
        sandbox.check(seen == truth, f"{text}\ncell {cell} sees by mirror {seen}, not {truth}")
        sandbox.check(all(cell in level["mirrored"][other] for other in seen),
                      f"{text}\ncell {cell} is not seen by all that it sees by mirror")
    return sum(map(len, level["mirrored"]))


def main():
    program = sandbox.program_argument()
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=5)
    count = parser.parse_args().count
    pairs = 0
    with sandbox.Sandbox(program) as box:
        for text in MAPS:
            pairs += check(box, text)
        for seed in range(count):
            pairs += check(box, random_map(random.Random(seed)))
    sandbox.check(pairs > 20 * count, f"only {pairs} pairs are seen by mirror")
    print(f"{count + len(MAPS)} maps, {pairs} pairs seen by mirror")


if __name__ == "__main__":
    main()
