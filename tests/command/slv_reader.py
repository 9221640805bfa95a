"""A reader of baked files, written from lib/bake/SLV.md alone: the field tables in that document are
its input. It shares nothing with the library.
"""
import pathlib
import re
import struct
import zlib

DOCUMENT = pathlib.Path(__file__).resolve().parents[2] / "lib/bake/SLV.md"
CODES = {"u8": "B", "u32": "I", "i32": "i", "u64": "Q", "f64": "d"}
NONE = 0xffffffff
REQUIRED = "INFO NODE CELL VERT PORT EXIT WALL MAPT".split()


class Fault(Exception):
    """A file, or the document, is wrong."""


def require(holds, what):
    if not holds:
        raise Fault(what)


def layouts():
    """The document's field tables by title: (struct, field names)."""
    found = {}
    for part in re.split(r"^### ", DOCUMENT.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]:
        title = re.match(r"([\w ]+): (\d+) bytes?$", part, re.MULTILINE)
        rows = re.findall(r"^\| (\d+) \| ([a-z0-9]+(?:\[\d+\])?) \| (\w+) \|", part, re.MULTILINE)
        if not title or not rows:
            continue
        code, names = "<", []
        for offset, kind, name in rows:
            require(struct.calcsize(code) == int(offset), f"{title[1]}: {name} is not at {offset}")
            text = re.match(r"char\[(\d+)\]", kind)
            code += text[1] + "s" if text else CODES[kind]
            names.append(name)
        require(struct.calcsize(code) == int(title[2]), f"{title[1]} has not {title[2]} bytes")
        found[title[1]] = struct.Struct(code), names
    return found


class Slv:
    """The file's header as `header`, the sections as lists of dicts by tag (`items`), rows as lists
    of cells."""

    def __init__(self, data):
        self.data, self.layouts = data, layouts()
        self.header = self.unpack("header", 0)
        self.check_header()
        self.table = {}
        for i in range(self.header["section_count"]):
            entry = self.unpack("table entry", 32 + 24 * i)
            tag = entry["tag"].decode("ascii")
            require(tag not in self.table, f"{tag} is there twice")
            self.table[tag] = entry
        require(all(tag in self.table for tag in REQUIRED), "a section is missing")
        self.info, = self.items("INFO")
        self.cells = self.items("CELL")
        self.map_text = self.bytes_of("MAPT").decode("utf-8")

    def unpack(self, title, offset):
        layout, names = self.layouts[title]
        require(offset + layout.size <= len(self.data), "the file ends early")
        return dict(zip(names, layout.unpack_from(self.data, offset)))

    def check_header(self):
        h, data = self.header, self.data
        require(h["magic"] == b"\x89SLV\r\n\x1a\n", "not a baked file")
        require(h["byte_order"] == 0x01020304, "of another byte order")
        require(h["version"] in (1, 2), "of another version")
        require(h["file_bytes"] == len(data), "cut short")
        require(h["checksum"] == zlib.crc32(data[:28] + bytes(4) + data[32:]), "checksum")
        require(h["section_count"] <= (len(data) - 32) // 24, "more sections than fit")

    def place(self, tag, item_bytes):
        entry = self.table[tag]
        require(entry["item_bytes"] == item_bytes, f"{tag}: size of an item")
        require(entry["offset"] % 8 == 0, f"{tag} is not at a multiple of 8")
        require(entry["offset"] + entry["count"] * item_bytes <= len(self.data), f"{tag} is cut")
        return entry["offset"], entry["count"]

    def items(self, tag):
        """A section's items; none where the file has no such section."""
        if tag not in self.table:
            return []
        size = self.layouts[tag][0].size
        offset, count = self.place(tag, size)
        return [self.unpack(tag, offset + i * size) for i in range(count)]

    def bytes_of(self, tag):
        offset, count = self.place(tag, 1)
        return self.data[offset:offset + count]

    def name_of(self, item):
        """The name of a door, an object or a path."""
        first, names = item["name"], self.bytes_of("MAPN")
        require(first + item["name_bytes"] <= len(names), "a name")
        return names[first:first + item["name_bytes"]].decode("utf-8")

    def spans(self, offsets_tag, item_count):
        """(start, end) of each cell."""
        offset, count = self.place(offsets_tag, 8)
        offsets = struct.unpack_from(f"<{count}Q", self.data, offset)
        require(count == len(self.cells) + 1 and offsets[0] == 0 and offsets[-1] == item_count and
                list(offsets) == sorted(offsets), f"{offsets_tag}: the offsets")
        return list(zip(offsets, offsets[1:]))

    def raw_rows(self, offsets_tag, bytes_tag):
        """The numbers of each row; None where the file has no such rows."""
        require((offsets_tag in self.table) == (bytes_tag in self.table), f"{bytes_tag} alone")
        if offsets_tag not in self.table:
            return None
        data = self.bytes_of(bytes_tag)
        return [numbers(data[a:b]) for a, b in self.spans(offsets_tag, len(data))]

    def rows(self, offsets_tag, bytes_tag):
        """For each row its cells."""
        raw = self.raw_rows(offsets_tag, bytes_tag)
        return raw and [self.cells_of(row) for row in raw]

    def cells_of(self, row):
        require(len(row) % 2 == 0, "a row ends within a pair")
        at, cells = 0, []
        for i, (skip, length) in enumerate(zip(row[::2], row[1::2])):
            require(length > 0 and (skip > 0 or i == 0), "a row has an empty run")
            cells += range(at + skip, at + skip + length)
            at += skip + length
        require(at <= len(self.cells), "a row goes past the last cell")
        return cells

    def told_parts(self):
        """For each row the numbers of the parts of the cells that PVSP says it reaches into, and the size of a part."""
        size = 1
        while (len(self.cells) - 1) // size >= 64:
            size *= 2
        return [{k for k in range(64) if item["parts"] >> k & 1} for item in self.items("PVSP")], size

    def door_rows(self, offsets_tag, bytes_tag):
        """For each row {cell: [doors, ...]}."""
        raw = self.raw_rows(offsets_tag, bytes_tag)
        return raw and [self.pairs_of(iter(row)) for row in raw]

    def pairs_of(self, row):
        pairs, cell = {}, -1
        for gap in row:
            cell += 1 + gap
            alternatives = []
            for _ in range(next(row)):
                door, doors = -1, []
                for _ in range(next(row)):
                    door += 1 + next(row)
                    doors.append(door)
                require(doors, "an alternative without doors")
                alternatives.append(doors)
            require(alternatives and cell < len(self.cells), "a pair of doors")
            pairs[cell] = alternatives
        return pairs

    def view_rows(self):
        """For each view cell the cells it sees."""
        views, = self.items("VCIN")
        rows, parents = self.rows("VCRO", "VCRB"), [p["parent"] for p in self.items("VCPA")]
        require(len(parents) == views["node_count"], "VCPA")
        seen = []
        for view_cell in range(views["view_cell_count"]):
            cells, node = set(), view_cell
            while node != NONE:
                cells |= set(rows[node])
                require(parents[node] > node, "a parent before its child")
                node = parents[node]
            seen.append(sorted(cells))
        return seen

    def is_shard(self):
        return any(part["shard_count"] for part in self.items("PART"))

    def visible(self):
        """For each cell the cells it sees; None for a shard."""
        if self.is_shard():
            return None
        if "PVSO" in self.table:
            return self.rows("PVSO", "PVSB")
        views = self.view_rows()
        return [[] if item["view_cell"] == NONE else views[item["view_cell"]]
                for item in self.items("VCEL")]

    def polygon(self, number, vertices):
        cell = self.cells[number]
        first = cell["first_vertex"]
        require(first + cell["vertex_count"] <= len(vertices), f"cell {number}: corners")
        return [(v["x"], v["y"]) for v in vertices[first:first + cell["vertex_count"]]]

    def descend(self, child, x, y):
        """The cell below a child of a node that a point is in."""
        nodes = self.items("NODE")
        while child >= 0:
            node = nodes[child]
            coordinate = y if node["axis"] else x
            child = node["below" if coordinate < node["position"] else "above"]
        return -1 - child

    def bucket(self, x, y, columns, rows):
        info = self.info
        step = [min(int((value - info["min_" + axis]) / (info["max_" + axis] - info["min_" + axis])
                        * count), count - 1)
                for value, axis, count in ((x, "x", columns), (y, "y", rows))]
        return step[1] * columns + step[0]

    def locate(self, x, y, vertices):
        """The cell of a point within the bounds; None in a gap."""
        info = self.info
        if self.header["version"] == 1 and "BEYO" not in self.table:
            cell = self.descend(info["root"], x, y)
            for size in self.items("NODG"):
                bucket = self.bucket(x, y, size["columns"], size["rows"])
                require(self.descend(self.items("NODS")[bucket]["start"], x, y) == cell, "NODS: a start")
            return cell
        cells = range(len(self.cells))
        if self.header["version"] == 2:
            bucket = self.bucket(x, y, info["grid_columns"], info["grid_rows"])
            first = [item["first"] for item in self.items("GRIO")]
            cells = [item["cell"] for item in self.items("GRIC")][first[bucket]:first[bucket + 1]]
        for cell in cells:
            if is_within(x, y, self.polygon(cell, vertices)):
                return cell
        return None


def is_within(x, y, polygon):
    return all((bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0
               for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]))


def numbers(data):
    """The numbers in LEB128."""
    found, value, shift = [], 0, 0
    for byte in data:
        value |= (byte & 0x7f) << shift
        shift += 7
        require(shift <= 35, "a number is too long")
        if byte < 0x80:
            require(value <= 0xffffffff, "a number is too large")
            found.append(value)
            value = shift = 0
    require(shift == 0, "a row ends within a number")
    return found
