"""Compares what the command reads of other programs' files with own readers (own_readers.py).

check_readers.py PROGRAM              files written here, of each format, must agree
check_readers.py PROGRAM FOLDER       all files of a folder, and what was found of each, as CSV

A sightline is a short segment over a wall, at a random angle. Of a layer that the program takes (most
of its length lies on walls of the map) no wall may be lost: what crosses it is blocked in the map. The
other way round, what the map blocks crosses a wall of the author. Layers that the program says are not solid
do not count. Of drawings (DXF, SVG) all lines of all layers must be there with --layers '*'. Without it,
layers count that the program names as those of walls, where it names no gaps and no shapes in them
that it passed over. Of tiles, squares that the program
takes as solid are those behind the outlines of the map; a tile of a layer is solid everywhere or nowhere.

Exit status: 0 nothing is lost, 1 something is.
"""
import collections
import csv
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile

import own_files
import own_grounds
import own_readers
import own_svg

READERS = {".uvtt": own_readers.uvtt, ".dd2vtt": own_readers.uvtt, ".df2vtt": own_readers.uvtt,
           ".db": own_readers.foundry, ".tmx": own_readers.tiled, ".tmj": own_readers.tiled,
           ".ldtk": own_readers.ldtk, ".dxf": own_readers.dxf, ".svg": own_svg.svg,
           ".geojson": own_readers.geojson, ".wad": own_grounds.wad, ".yaml": own_grounds.ros}
PLANS = (own_readers.dxf, own_svg.svg)
SIGHTLINES = 1500
MAPS = 3  # of a file that holds several
NEAR = 2e-4  # of the larger side: chords and welded ends
OPEN = ("open", "seen through")  # doors and walls of tabletops that stop no sight
NOT_SOLID = re.compile(r"not (?:solid|taken): (.*)")
CHOICE = re.compile(r": layers(?:, and looks [^:]*)?: (.*) \(--layers A,B chooses")
TAKEN = re.compile(r"(?:walls|seen through,) from ([^;]*)")
PARTS = re.compile(r"\b(gaps?|no walls)\b")
NAMED = re.compile(r"'((?:[^']|'(?! \())*)' \(\d+ ")
EARTH = re.compile(r"^earth (\S+) (\S+)", re.MULTILINE)
FLIPPED = re.compile(r"y = (-?[\d.e+-]+) - the file's y")


def reader_of(path):
    if path.suffix == ".json":
        text = path.read_text(encoding="utf-8", errors="replace")
        for word, reader in (('"tilesets"', own_readers.tiled), ('"line_of_sight"', own_readers.uvtt),
                             ('"walls"', own_readers.foundry), ('"defs"', own_readers.ldtk)):
            if word in text:
                return reader
    return READERS.get(path.suffix.lower())


class Grid:
    """Segments in squares, to find those near a place."""

    def __init__(self, segments):
        self.segments = segments
        xs = [x for s in segments for x in s[::2]] or [0]
        ys = [y for s in segments for y in s[1::2]] or [0]
        self.box = min(xs), min(ys), max(xs), max(ys)
        self.side = max(self.box[2] - self.box[0], self.box[3] - self.box[1], 1e-9)
        self.step = self.side / 100
        self.squares = collections.defaultdict(list)
        for segment in segments:
            if segment[:2] == segment[2:]:
                continue  # files have walls of no length, which stop nothing
            for square in self.under(segment):
                self.squares[square].append(segment)

    def under(self, s):
        count = max(1, math.ceil(max(abs(s[2] - s[0]), abs(s[3] - s[1])) / self.step * 2))
        found = set()
        for i in range(count + 1):
            x, y = s[0] + (s[2] - s[0]) * i / count, s[1] + (s[3] - s[1]) * i / count
            column, row = math.floor(x / self.step), math.floor(y / self.step)
            found.update((column + a, row + b) for a in (-1, 0, 1) for b in (-1, 0, 1))
        return found

    def near(self, segment):
        return {s for square in self.under(segment) for s in self.squares.get(square, ())}


def cross(ax, ay, bx, by, px, py):
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax)


def crosses(sight, wall, slack):
    """Whether a wall made longer by slack at both ends, or touched within slack, stops a sightline."""
    length = math.hypot(wall[2] - wall[0], wall[3] - wall[1])
    ux, uy = (wall[2] - wall[0]) / length * slack, (wall[3] - wall[1]) / length * slack
    wall = (wall[0] - ux, wall[1] - uy, wall[2] + ux, wall[3] + uy)
    a, b = cross(*sight, *wall[:2]), cross(*sight, *wall[2:])
    c, d = cross(*wall, *sight[:2]), cross(*wall, *sight[2:])
    return (a > 0) != (b > 0) and (c > 0) != (d > 0)


def blocked(grid, sight, slack):
    return any(crosses(sight, wall, slack) for wall in grid.near(sight))


def over_walls(segments, side, random_numbers):
    """Sightlines over walls chosen by length, well inside them."""
    lengths = [math.hypot(s[2] - s[0], s[3] - s[1]) for s in segments]
    for s in random_numbers.choices(segments, lengths, k=SIGHTLINES):
        length = math.hypot(s[2] - s[0], s[3] - s[1])
        half = side * random_numbers.uniform(10, 40) * NEAR  # beyond what chords are off by
        if length < 4 * side * NEAR:
            continue
        t = random_numbers.uniform(0.2, 0.8)
        turn = math.atan2(s[3] - s[1], s[2] - s[0]) + random_numbers.uniform(0.6, math.pi - 0.6)
        x, y = s[0] + (s[2] - s[0]) * t, s[1] + (s[3] - s[1]) * t
        c, d = math.cos(turn) * half, math.sin(turn) * half
        yield x - c, y - d, x + c, y + d


def read_map(text):
    """Segments that stop sight, those that stop anything, and outlines of ground, of a map text."""
    sight, any_wall, outlines = [], [], []
    for line in text.splitlines():
        words = line.split("#")[0].split()
        if not words or words[0] not in ("wall", "walls", "door", "mirror", "oneway", "solid", "open"):
            continue
        stops = words[words.index("stops") + 1] if "stops" in words else "sight"
        values = [float(w) for w in words[1:] if re.fullmatch(r"-?[\d.]+(e[+-]?\d+)?", w)]
        points = list(zip(values[::2], values[1::2]))
        if words[0] in ("solid", "open"):
            points.append(points[0])
        segments = [(*a, *b) for a, b in zip(points, points[1:]) if a != b]
        if words[0] in ("solid", "open"):
            outlines.append(segments)
        any_wall += segments
        if "sight" in stops or "limited" in stops:
            sight += segments
    return sight, any_wall, outlines


def flipped(segments, top):
    return [(a, top - b, c, top - d) if top is not None else (a, b, c, d) for a, b, c, d in segments]


def solid_squares(drawing, outlines, top):
    """Squares on the other side of an odd number of outlines than the ground beyond them."""
    columns, rows = drawing.extent
    left, top_row = drawing.origin
    size, crossed = drawing.size, collections.Counter()
    for a, b, c, d in (s for outline in outlines for s in flipped(outline, top)):
        if a == c and a % size == 0:
            for row in range(round(min(b, d) / size), round(max(b, d) / size)):
                crossed[round(a / size), row] += 1
    inner = set()
    for row in range(top_row, top_row + rows):
        odd = False
        for column in range(left, left + columns):
            odd ^= crossed[column, row] % 2 == 1
            if odd:
                inner.add((column, row))
    everything = {(left + x, top_row + y) for x in range(columns) for y in range(rows)}
    return inner, everything - inner


def compare_tiles(drawing, outlines, top, left_out=()):
    """(squares lost, squares too many, of how many): by the tiles that lie in solid squares alone."""
    best = None
    for solid in solid_squares(drawing, outlines, top):
        layers = collections.defaultdict(set)
        for (layer, tile), places in drawing.squares.items():
            if tile:
                layers[layer] |= places
        kinds = {**{(layer,): places for layer, places in layers.items()}, **drawing.squares}
        said, lost = set(), set()
        for kind, places in kinds.items():
            outside = places - solid
            if kind[0] in left_out and outside:
                continue
            if not outside:
                said |= places
            elif len(places) >= 20 and len(outside) <= len(places) / 50:
                lost |= outside
        result = (len(lost), 0 if drawing.unread or drawing.walls else len(solid - said), len(solid))
        if solid and (best is None or result[:2] < best[:2]):
            best = result
    return best or (0, 0, 0)


def laid(segments, text):
    """Segments in degrees in the plane of the map, if its text says where on the earth that lies."""
    place = EARTH.search(text)
    if not place:
        return segments
    longitude, latitude = map(float, place.groups())
    return [(*own_readers.metres(longitude, latitude, *s[:2]),
             *own_readers.metres(longitude, latitude, *s[2:])) for s in segments]


def taken(segments, grid):
    """Which part of the length of segments lies on walls of the map."""
    total = on = 0.0
    for a, b, c, d in segments:
        length = math.hypot(c - a, d - b)
        half = 3 * NEAR * grid.side / (length or 1)
        for t in (0.2, 0.5, 0.8):
            x, y = a + (c - a) * t, b + (d - b) * t
            over = (x - (d - b) * half, y + (c - a) * half, x + (d - b) * half, y - (c - a) * half)
            total += length
            on += length if blocked(grid, over, grid.side * NEAR) else 0
    return on / total if total else 0.0


def beside_gaps(gaps, sight, side):
    """Whether an opening, or a wall beside it that it cuts, may be what a sightline crosses."""
    for x0, y0, x1, y1 in gaps:
        reach = math.hypot(x1 - x0, y1 - y0) * 0.85 + side * 40 * NEAR
        if math.hypot(sight[0] - (x0 + x1) / 2, sight[1] - (y0 + y1) / 2) < reach:
            return True
    return False


def passed_over(drawing, said):
    """Layers that may have lost walls, by what the program says that it chose."""
    choice = CHOICE.search(said)
    if not choice or choice.group(1).startswith("all are walls"):
        return ()
    lists = () if PARTS.search(choice.group(1)) else TAKEN.findall(choice.group(1))
    return set(drawing.walls) - {name for names in lists for name in names.split(", ")}


def compare_walls(drawing, text, top, random_numbers, left_out=(), part=0.5):
    """(lost, of how many, too many, of how many, layers taken, layers left)

    Layers count of whose length the map has this part or more.
    """
    sight, any_wall, outlines = read_map(text)
    every, on_map = Grid(any_wall), Grid(sight)
    layers = {layer: laid(flipped(walls, top), text) for layer, walls in drawing.walls.items() if walls}
    gaps = laid(flipped(drawing.gaps, top), text)
    took = {layer: walls for layer, walls in layers.items()
            if not layer.endswith(OPEN) and layer.rsplit(" (", 1)[0] not in left_out
            and taken(walls, every) >= part}
    chosen = [s for walls in took.values() for s in walls]
    lost = trials = extra = others = 0
    if chosen and any_wall:
        for line in over_walls(chosen, every.side, random_numbers):
            if beside_gaps(gaps, line, every.side):
                continue
            trials += 1
            lost += not blocked(every, line, every.side * NEAR)
    if layers and not drawing.squares and any_wall:
        own = Grid([s for walls in layers.values() for s in walls])
        for line in over_walls(any_wall, every.side, random_numbers):
            others += 1
            extra += not blocked(own, line, every.side * NEAR)
    return lost, trials, extra, others, sorted(took), sorted(set(layers) - set(took)), outlines


def run(*command):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, errors="replace",
                          timeout=120)
    return done.returncode, done.stdout, done.stderr


def check(program, path, random_numbers):
    """Rows (map, lost, of, too many, of, squares lost, too many, of, taken, left, unread)."""
    reader = reader_of(path)
    drawings = [drawing for drawing in reader(path) if drawing.walls or drawing.squares]
    status, listed, _ = run(program, "info", path)
    names = [line.strip() for line in listed.splitlines()[1:] if line.startswith("  ")] \
        if re.search(r": \d+ maps", listed.split("\n")[0]) else []
    every = [["--layers", "*"]] if reader in PLANS else []
    for i, drawing in enumerate(drawings[:MAPS] if names else drawings[:1]):
        choice = ["--map", drawing.name if drawing.name in names else names[i]] if names else []
        for layers in [[], *every]:
            name = " ".join([drawing.name or "", *layers]).strip()
            status, text, said = run(program, "convert", path, *choice, *layers)
            if status:
                yield [name, "refused", said.strip()[-200:]]
                continue
            top = FLIPPED.search(said)
            top = float(top.group(1)) if top else drawing.top
            not_solid = NOT_SOLID.search(said)
            left_out = set(NAMED.findall(not_solid.group(1))) if not_solid else set()
            if every:
                left_out.update(passed_over(drawing, said))
            part = 0 if layers or reader is own_readers.geojson else 0.95 if drawing.size else 0.5
            result = compare_walls(drawing, text, top, random_numbers, left_out, part)
            tiles = compare_tiles(drawing, result[6], top, left_out) if drawing.squares else (0, 0, 0)
            yield [name, *result[:4], *tiles, ";".join(result[4]), ";".join(result[5]),
                   dict(drawing.unread)]


def can_fail(program, path):
    """A map with a wall too few and one with a wall too many are found."""
    drawing = next(reader_of(path)(path))
    text = run(program, "convert", path)[1]
    walls = [line for line in text.splitlines() if line.startswith("wall")]
    assert len(walls) > 4
    for other, place in ((text.replace(walls[0] + "\n", ""), 0), (text + "\nwall 11 7 24 51\n", 2)):
        result = compare_walls(drawing, other, drawing.top, random.Random(1))
        assert result[place] > 0, f"a wall too {'many' if place else 'few'} was not found"


def main():
    program, folder = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else None
    out, bad, count = csv.writer(sys.stdout), 0, 0
    with tempfile.TemporaryDirectory(prefix="sightline-own-") as own:
        if not folder:
            for name, text in own_files.FILES.items():
                pathlib.Path(own, name).write_bytes(text if isinstance(text, bytes) else text.encode())
            can_fail(program, pathlib.Path(own, "plan.dxf"))
        for path in sorted(p for p in pathlib.Path(folder or own).rglob("*") if reader_of(p)):
            try:
                for row in check(program, path, random.Random(1)):
                    out.writerow([path.relative_to(folder or own), *row])
                    sys.stdout.flush()
                    count += 1
                    bad += row[1] == "refused" or bool(row[1] or row[3] or row[5] or row[6])
            except (ValueError, KeyError, OSError, SyntaxError, subprocess.TimeoutExpired) as error:
                out.writerow([path.relative_to(folder or own), "", "not read", repr(error)[:200]])
    print(f"{count} maps, {bad} of them with a difference")
    sys.exit(1 if bad or not count else 0)


if __name__ == "__main__":
    main()
