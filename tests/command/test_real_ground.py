"""Solid ground of real input, held against what the files themselves say at random points: cells of
an LDtk level, pixels of a ROS map, sectors of Doom levels. Each map also turned by 17.3 degrees.

test_real_ground.py PROGRAM DATA WADS

Exit status: 0 nothing found, 1 faults found, 77 where no file is there.
"""
import json
import math
import pathlib
import random
import struct
import subprocess
import sys
import tempfile

POINTS = 3000
TURN = math.radians(17.3)


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{command}: ended with {done.returncode}\n{done.stderr}")
    return done.stdout


def turned(x, y):
    return (math.cos(TURN) * x - math.sin(TURN) * y, math.sin(TURN) * x + math.cos(TURN) * y)


def turn_text(text):
    """The map text, every point turned."""
    lines = []
    for line in text.splitlines():
        words = line.split()
        if not words or words[0] not in ("wall", "solid", "open", "door", "start"):
            lines.append(line)
            continue
        first = 2 if words[0] == "door" else 1
        count = {"wall": 4, "door": 4, "start": 2}.get(words[0], len(words) - first)
        numbers = [float(word) for word in words[first:first + count]]
        for x, y in zip(numbers[::2], numbers[1::2]):
            words[first:first + 2] = map(repr, turned(x, y))
            first += 2
        lines.append(" ".join(words))
    return "\n".join(lines) + "\n"


class Cells:
    """The cells of an export, found by place."""

    def __init__(self, export):
        self.cells = json.loads(export)["cells"]
        self.boxes = []
        for cell in self.cells:
            xs, ys = zip(*cell["polygon"])
            self.boxes.append((min(xs), min(ys), max(xs), max(ys)))

    def solid_at(self, x, y):
        """True, False, or None near a border of cells and outside of the bounds."""
        for cell, (x0, y0, x1, y1) in zip(self.cells, self.boxes):
            if not (x0 < x < x1 and y0 < y < y1):
                continue
            polygon = cell["polygon"]
            sides = [(b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
                     for a, b in zip(polygon, polygon[1:] + polygon[:1])]
            if min(sides) > 1e-9 * max(sides):
                return cell.get("solid", False)
        return None


def ldtk_truth(path, level_name):
    """What the collision layer of a level says of a point: y up, as the importer turns it."""
    project = json.loads(path.read_text())
    values = {v["value"] for layer in project["defs"]["layers"] if layer["identifier"] == "Collisions"
              for v in layer["intGridValues"] if "wall" in (v["identifier"] or "").lower()}
    level = next(level for level in project["levels"] if level["identifier"] == level_name)
    layer = next(one for one in level["layerInstances"] if one["__identifier"] == "Collisions")
    size, width, height = layer["__gridSize"], layer["__cWid"], layer["__cHei"]

    def solid(x, y):
        column, row = int(x // size), int((level["pxHei"] - y) // size)
        if not (0 <= column < width and 0 <= row < height):
            return True
        return layer["intGridCsv"][row * width + column] in (values or {1})
    return solid


def ros_truth(picture):
    """A pixel is open where it is free: lighter than the map's free_thresh of 0.196."""
    bytes_ = picture.read_bytes()
    lines = [line for line in bytes_[:200].split(b"\n") if not line.startswith(b"#")]
    width, height = map(int, lines[1].split())
    pixels = bytes_[-width * height:]

    def solid(x, y):
        column, row = math.floor((x + 10) / 0.05), height - 1 - math.floor((y + 10) / 0.05)
        if not (0 <= column < width and 0 <= row < height):
            return True
        return (255 - pixels[row * width + column]) / 255 >= 0.196
    return solid


def doom_truth(path, name):
    """Open is what lies in a sector: a ray crosses its border an odd number of times."""
    wad = path.read_bytes()
    count, at = struct.unpack_from("<ii", wad, 4)
    lumps = [struct.unpack_from("<ii8s", wad, at + 16 * i) for i in range(count)]
    names = [lump[2].rstrip(b"\0").decode("latin-1") for lump in lumps]
    header = names.index(name)
    parts = {}
    for i in range(header + 1, header + 11):
        parts[names[i]] = wad[lumps[i][0]:lumps[i][0] + lumps[i][1]]
    vertices = list(struct.iter_unpack("<hh", parts["VERTEXES"]))
    sides = [side[-1] for side in struct.iter_unpack("<hh8s8s8sH", parts["SIDEDEFS"])]
    borders = {}
    for a, b, _, _, _, right, left in struct.iter_unpack("<HHHHHHH", parts["LINEDEFS"]):
        sectors = [sides[s] for s in (right, left) if s != 0xffff]
        if len(sectors) == 2 and sectors[0] == sectors[1]:
            continue
        for sector in sectors:
            borders.setdefault(sector, []).append((vertices[a], vertices[b]))

    def solid(x, y):
        for lines in borders.values():
            inside = False
            for (x0, y0), (x1, y1) in lines:
                if (y0 > y) != (y1 > y) and x < x0 + (y - y0) * (x1 - x0) / (y1 - y0):
                    inside = not inside
            if inside:
                return False
        return True
    return solid


def check(program, folder, name, source, solid):
    """Counts the points at which cells and file differ; the map as it is, and turned."""
    text, faults = run(program, "convert", *source, "-q"), 0
    for turns in (False, True):
        path, baked = folder / "m.map", folder / "m.slv"
        path.write_text(turn_text(text) if turns else text)
        run(program, "bake", path, "-q", "-o", baked, "--method", "flood", "--without", "door")
        cells = Cells(run(program, "export", baked, "--format", "json", "-q"))
        numbers = [float(n) for line in text.splitlines()
                   if line.startswith(("wall", "solid", "open")) for n in line.split()[1:]
                   if n != "solid"]
        low, high = (min(numbers[::2]), min(numbers[1::2])), (max(numbers[::2]), max(numbers[1::2]))
        chance, seen, wrong, solids = random.Random(name), 0, 0, 0
        for _ in range(POINTS):
            x, y = chance.uniform(low[0], high[0]), chance.uniform(low[1], high[1])
            found = cells.solid_at(*(turned(x, y) if turns else (x, y)))
            if found is None:
                continue
            seen += 1
            solids += found
            if found != solid(x, y):
                wrong += 1
                if wrong < 4:
                    print(f"{name}: at {x:.9g} {y:.9g} the cell is {'' if found else 'not '}solid")
        print(f"{name}{', turned' if turns else ''}: {seen} points, {solids} in solid ground, "
              f"{wrong} wrong")
        # A check that sees nothing, or one kind of ground alone, is none.
        faults += wrong > 0 or seen < POINTS // 2 or not 0 < solids < seen
    return faults


def main():
    program, data, wads = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    maps = []
    ldtk, ros = data / "typical-topdown.ldtk", data / "turtlebot3-world.yaml"
    if ldtk.exists():
        for level in ("World_Level_0", "World_Level_1", "World_Level_2"):
            maps.append((level, [ldtk, "--map", level], ldtk_truth(ldtk, level)))
    if ros.exists():
        maps.append(("turtlebot3", [ros], ros_truth(ros.with_suffix(".pgm"))))
    for wad, names in (("freedoom1.wad", ("E1M1", "E1M8")), ("freedoom2.wad", ("MAP01", "MAP30"))):
        for name in names if (wads / wad).exists() else ():
            maps.append((name, [wads / wad, "--map", name], doom_truth(wads / wad, name)))
    if not maps:
        print("skipped: none of the files is there")
        return 77
    with tempfile.TemporaryDirectory(prefix="sightline-ground-") as folder:
        faults = sum(check(program, pathlib.Path(folder), *one) for one in maps)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
