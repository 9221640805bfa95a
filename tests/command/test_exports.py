"""Many exports, each checked by the schema and by what the schema cannot say.

test_exports.py PROGRAM [--count N]    by default 12; `ninja hundred_exports` takes 120

Inputs: the maps of maps/ and tests/cases, and generated maps of several seeds with all effects added at
random places, some of them turned. Options of `bake` go round: subdivisions, methods, closed and open
sight, effects left out, mirrors, inside cells only, stab trees. What `bake` refuses is counted apart.
"""
import argparse
import collections
import itertools
import json
import math
import pathlib
import random
import re
import struct
import sys
import warnings
import zlib

import sandbox

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
import check_geojson  # noqa: E402

MAPS = sorted([*(ROOT / "maps").glob("*.map"), *(ROOT / "maps").glob("*/*.map"),
               *(ROOT / "maps").glob("*.txt"), *(ROOT / "tests/cases").glob("*.map")])
KINDS = ["maze --size 6", "office --size 1", "city --size 2", "pillars --size 4", "tower --size 1",
         "maze --size 5 --turned 17.3", "office --size 1 --turned 33",
         "pillars --size 3 --turned-exact 30"]
OPTIONS = ["", "--subdivide mesh", "--sight open", "--subdivide kd", "--method dfs", "--method prune",
           "--method multipass --without mirror,oneway,range", "--method flood",
           "--method sampling", "--subdivide given", "--inside",
           "--without mirror,door,oneway,range", "--mirror-depth 2", "--stab-trees --without mirror",
           "--subdivide mesh --sight open --method dfs", "--door-limit 1", "--weld 0.01",
           "--kd-rules median"]


def with_effects(text, numbers):
    """A map text with one of each effect more, at random places within its bounds."""
    values = [float(word) for line in text.splitlines() if line.startswith("wall")
              for word in line.split()[1:]]
    low = [min(values[0::2]), min(values[1::2])]
    size = [max(values[0::2]) - low[0], max(values[1::2]) - low[1]]

    def place():
        return [round(low[i] + size[i] * numbers.uniform(0.05, 0.95), 3) for i in (0, 1)]

    def segment():
        a, axis = place(), numbers.randrange(2)
        b = list(a)
        b[axis] += round(size[axis] * numbers.uniform(0.02, 0.1), 3)
        return "{} {} {} {}".format(*a, *b)

    states = ["open", "shut", "breakable", "open site"]
    lines = [f"door d{i % 2} {segment()} {numbers.choice(states)}" for i in range(3)]
    lines += ["mirror " + segment(), "mirror " + segment() + " one", "oneway " + segment(),
              "seam " + segment(), f"range {max(size) / 2!r}", "object crate " + segment(),
              "path tour {} {} {} {} {} {}".format(*place(), *place(), *place())]
    lines += ["start {} {} {}".format(*place(), numbers.randrange(-360, 360))]
    return text + "\n".join(lines) + "\n"


def area(polygon):
    return check_geojson.area(polygon + polygon[:1]) / 2


def check_rows(rows, cells, what):
    assert len(rows) == cells, what
    for row in rows:
        assert all(a < b for a, b in zip(row, row[1:])) and all(0 <= c < cells for c in row), what


def check_level(level):
    """What the schema cannot say."""
    cells, doors = level["cells"], {door["name"] for door in level.get("doors", [])}
    x0, y0, x1, y1 = level["bounds"]
    assert [cell["id"] for cell in cells] == list(range(len(cells)))
    total = math.fsum(area(cell["polygon"]) for cell in cells)
    assert abs(total - (x1 - x0) * (y1 - y0)) <= 1e-9 * abs(total), "cells do not tile the bounds"
    for cell in cells:
        ring = cell["polygon"]
        assert all(check_geojson.cross(ring[i - 2], ring[i - 1], ring[i]) >= 0
                   for i in range(len(ring))), "a cell that is not convex"
    for key in ("pvs", "doubtful", "mirrored"):
        if key in level:
            check_rows(level[key], len(cells), key)
    for portal in level["portals"]:
        assert 0 <= portal["cells"][0] < portal["cells"][1] < len(cells)
        assert portal.get("door") is None or portal["door"] in doors
    for key, rows in ("door_sets", "pvs"), ("mirrored_door_sets", "mirrored"):
        for item in level.get(key, []):
            assert item["cells"][1] in level[rows][item["cells"][0]], key
            assert all(set(names) <= doors for names in item["needs"]), key
    for hand in level.get("solid_walls", {}).values():
        assert all(number < len(level["walls"]) for number in hand)
    assert len(level.get("solids", [])) == sum("solid" in cell for cell in cells)
    assert all(number < len(level["mirrors"]) for number in level.get("one_sided_mirrors", []))


def read_grey(data):
    """The bits of a pixel and the rows of a grey PNG, whose lines have no filters."""
    width, height, depth = struct.unpack(">IIB", data[16:25])
    packed, at = b"", 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += size + 12
    line = 1 + (width * depth + 7) // 8
    lines = zlib.decompress(packed)
    assert not any(lines[::line])
    return depth, [[lines[y * line + 1 + x * depth // 8] >> 8 - depth - x * depth % 8
                    & 2 ** depth - 1 for x in range(width)] for y in range(height)]


class Exports:
    def __init__(self, box, validator):
        self.box, self.validator = box, validator
        self.refused = collections.Counter()
        self.done = 0

    def run(self, *arguments):
        result = self.box.run([str(argument) for argument in arguments])
        assert result.status == 0, f"{arguments}: {result.text()}"
        return result.stdout

    def export(self, *options):
        return json.loads(self.run("export", "m.slv", "-q", *options),
                          parse_constant=check_geojson.refuse)

    def check_pairs(self, level):
        """CSV, C and PNG say of each pair what JSON says, with mirrors too."""
        count = range(len(level["cells"]))
        mirrors = "mirrors" in level
        seen = [set(row) for row in level["pvs"]]
        mirrored = [set(row) for row in level["mirrored"]] if mirrors else [set() for _ in count]
        head, *lines = self.run("export", "m.slv", "--format", "csv", "-q").splitlines()
        assert head == ("from,to,direct,mirrored" if mirrors else "from,to")
        more = ",{:d},{:d}" if mirrors else ""
        assert lines == [f"{a},{b}" + more.format(b in seen[a], b in mirrored[a])
                         for a in count for b in sorted(seen[a] | mirrored[a])]
        header = self.run("export", "m.slv", "--format", "c", "-q")
        for name, rows in [("seen", seen)] + [("mirrored", mirrored)] * mirrors:
            table = re.search(rf"visible_{name}\[\d+\]\[\d+\] = {{\n(.*?)\n}};", header, re.S)
            found = [re.findall(r"\d+", line) for line in table.group(1).splitlines()]
            assert [{b for b in count if int(row[b // 8]) >> b % 8 & 1} for row in found] == rows
        assert ("VISIBLE_MIRRORS" in header) == mirrors
        self.run("export", "m.slv", "--format", "png", "-q", "-o", "m.png")
        depth, pixels = read_grey(self.box.path("m.png").read_bytes())
        assert depth == (2 if mirrors else 1)
        known = {(False, False): 3, (False, True): 2, (True, True): 1, (True, False): 0}
        assert pixels == [[known[b in seen[a], b in mirrored[a]] & (2 ** depth - 1) for b in count]
                          for a in count]

    def check(self, source, options):
        """Bakes a map and checks all of its exports. False where `bake` refuses the options."""
        result = self.box.run(["bake", str(source), "-o", "m.slv", "-q", *options.split()])
        if result.status == 2:
            self.refused[options] += 1
            return False
        assert result.status == 0, result.text()
        level = self.export()
        if self.validator:
            self.validator.validate(level)
        check_level(level)
        places = self.export("--format", "geojson")
        assert not check_geojson.faults(places), check_geojson.faults(places)[0]
        kinds = collections.Counter(f["properties"]["kind"] for f in places["features"])
        assert kinds["cell"] == len(level["cells"]) and kinds["portal"] == len(level["portals"])
        self.check_pairs(level)
        self.done += 1
        return True

    def sources(self):
        """Maps and generated maps by turns, without end: a name and a file."""
        for number in itertools.count():
            if number < 2 * len(MAPS) and number % 2 == 0:
                yield MAPS[number // 2].name, MAPS[number // 2]
                continue
            kind = KINDS[number // 2 % len(KINDS)]
            text = self.run("generate", *kind.split(), "--seed", number, "-q")
            path = self.box.path("generated.map")
            path.write_text(with_effects(text, random.Random(number)), encoding="utf-8")
            yield f"{kind} --seed {number}", path

    def check_many(self, count):
        options = itertools.cycle(OPTIONS)
        for name, path in self.sources():
            if self.done >= count:
                return
            for chosen in itertools.islice(options, 4 if count > 50 else 2):
                try:
                    self.check(path, chosen)
                except Exception:
                    print(f"in {name} with options '{chosen}':", file=sys.stderr)
                    raise


def make_validator():
    try:
        import jsonschema
    except ImportError:
        print("without the schema: the Python package jsonschema is not here")
        return None
    schema = json.loads((ROOT / "lib/bake/export.schema.json").read_text(encoding="utf-8"))
    return jsonschema.Draft202012Validator(schema)


def main():
    program = sandbox.program_argument()
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=12)
    count = parser.parse_args().count
    warnings.simplefilter("ignore", DeprecationWarning)
    with sandbox.Sandbox(program) as box:
        exports = Exports(box, make_validator())
        exports.check_many(count)
    refused = ", ".join(f"{n} x '{options}'" for options, n in exports.refused.items())
    print(f"{exports.done} exports are sound" + (f"; bake refused {refused}" if refused else ""))


if __name__ == "__main__":
    main()
