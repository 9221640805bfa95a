"""Small readers of Doom's levels and of ROS's maps for own_readers.py.

Of a level the lines with one side are walls, and those with two are seen through; lines without a side
are none. Lines of polyobjects are not told from others (counted as unread). Of a ROS map the walls are
the sides between pixels that are free and pixels that are not.
"""
import math
import re
import struct

from own_readers import Drawing

ALONE = ("BEHAVIOR", "SCRIPTS")
RECORDS = ("THINGS", "LINEDEFS", "SIDEDEFS", "VERTEXES", "SEGS", "SSECTORS", "NODES", "SECTORS", "REJECT",
           "BLOCKMAP", *ALONE)


def lumps(data):
    count, at = struct.unpack("<ii", data[4:12])
    for i in range(count):
        begin, size, name = struct.unpack("<ii8s", data[at + 16 * i:at + 16 * i + 16])
        yield name.split(b"\0")[0].decode("latin-1").upper(), data[begin:begin + size]


def levels(all_lumps):
    """(name, lumps by name) of each map; a header before scripts alone is none."""
    for i, (name, _) in enumerate(all_lumps):
        following = [n for n, _ in all_lumps[i + 1:i + 2]]
        if following == ["TEXTMAP"]:
            yield name, {"TEXTMAP": all_lumps[i + 1][1]}
        elif name not in RECORDS and following and following[0] in RECORDS:
            own = {}
            for other, data in all_lumps[i + 1:]:
                if other not in RECORDS or other in own:
                    break
                own[other] = data
            if set(own) - set(ALONE):
                yield name, own


def line_of(drawing, sides, a, b):
    if a != b and any(side >= 0 for side in sides):
        drawing.walls["one side" if min(sides) < 0 else "two sides, seen through"].append((*a, *b))


def level_of_text(drawing, text):
    text = re.sub(r"//.*|/\*.*?\*/", "", text.decode("latin-1"))
    blocks = re.findall(r"(vertex|linedef)\s*\{(.*?)\}", text, re.S)
    fields = [(kind, dict(re.findall(r"(\w+)\s*=\s*([^;\s]+)\s*;", body))) for kind, body in blocks]
    corners = [(float(own["x"]), float(own["y"])) for kind, own in fields if kind == "vertex"]
    for kind, own in fields:
        if kind == "linedef":
            sides = [int(own.get(key, -1)) for key in ("sidefront", "sideback")]
            if own.get("special") in ("1", "5"):
                drawing.unread["lines of polyobjects"] += 1
            line_of(drawing, sides, corners[int(own["v1"])], corners[int(own["v2"])])


def wad(path):
    for name, own in levels(list(lumps(path.read_bytes()))):
        drawing = Drawing(name)
        if "TEXTMAP" in own:
            level_of_text(drawing, own["TEXTMAP"])
        else:
            hexen = "BEHAVIOR" in own
            corners = list(struct.iter_unpack("<hh", own["VERTEXES"]))
            for record in struct.iter_unpack("<3H6B2H" if hexen else "<7H", own["LINEDEFS"]):
                if hexen and record[3] in (1, 5):
                    drawing.unread["lines of polyobjects"] += 1
                sides = [-1 if side == 0xffff else side for side in record[-2:]]
                line_of(drawing, sides, *((float(x), float(y)) for x, y in
                                          (corners[record[0]], corners[record[1]])))
        yield drawing


def netpbm(data):
    """Columns, rows, largest value and pixels of a grey picture."""
    head = re.match(rb"(P[25])(?:\s+#.*\n|\s)+(\d+)(?:\s+#.*\n|\s)+(\d+)(?:\s+#.*\n|\s)+(\d+)\s", data)
    kind, columns, rows, most = head.group(1), *(int(head.group(i)) for i in (2, 3, 4))
    rest = data[head.end():]
    return columns, rows, most, rest if kind == b"P5" else [int(word) for word in rest.split()]


def ros(path):
    text = path.read_text(encoding="utf-8")
    said = dict(re.findall(r"(?m)^(\w+):\s*(.*?)\s*$", text))
    columns, rows, most, pixels = netpbm((path.parent / said["image"].strip("'\"")).read_bytes())
    x0, y0, yaw = (float(word) for word in said["origin"].strip("[]").split(","))
    size, free = float(said["resolution"]), float(said["free_thresh"])
    occupied = float(said.get("occupied_thresh", 0.65))
    negate = said.get("negate", "0") in ("1", "true")
    drawing = Drawing()
    # Map savers write 254 for free and 205 for unknown ground, whatever free_thresh says.
    if free < occupied and {254, 255} & set(pixels) and \
            all(value in (205, 254, 255) for value in set(pixels) if 1 - value / most < free):
        free = min(free, 0.196)
    if yaw:
        drawing.unread["turned"] += 1

    def solid(column, row):
        part = pixels[row * columns + column] / most
        return (part if negate else 1 - part) >= free

    def side(layer, *ends):
        points = [(column * size, (rows - row) * size) for column, row in ends]
        c, s = math.cos(yaw), math.sin(yaw)
        drawing.line(layer, [(x0 + c * x - s * y, y0 + s * x + c * y) for x, y in points])

    for row in range(rows):
        for column in range(columns):
            if column + 1 < columns and solid(column, row) != solid(column + 1, row):
                side("pixels", (column + 1, row), (column + 1, row + 1))
            if row + 1 < rows and solid(column, row) != solid(column, row + 1):
                side("pixels", (column, row + 1), (column + 1, row + 1))
    side("frame, seen through", (0, 0), (columns, 0), (columns, rows), (0, rows), (0, 0))
    yield drawing
