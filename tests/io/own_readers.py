"""Small readers of the formats of other programs that share nothing with the library.

Each gives a Drawing: the author's walls by layer, in the file's coordinates, and the squares of tile
layers by the tile that lies there. They read what is common and count the rest in `unread`; what of it
is a wall is for the caller to say.
"""
import base64
import collections
import gzip
import json
import math
import pathlib
import re
import struct
import xml.etree.ElementTree as ET
import zlib

CHORDS = 128  # of a full circle
NO_WALLS = ("TEXT", "MTEXT", "ATTDEF", "ATTRIB", "POINT", "DIMENSION", "VIEWPORT", "SEQEND", "ENDSEC",
            "EOF")


class Drawing:
    """Segments by layer, squares by (layer, tile), and what was not read."""

    def __init__(self, name=None):
        self.name = name  # of the map, in a file that holds several
        self.walls = collections.defaultdict(list)
        self.squares = collections.defaultdict(set)  # (layer, tile): (column, row)
        self.size = None  # of a square
        self.extent = None  # columns and rows, if there are squares
        self.origin = 0, 0  # the first column and row
        self.gaps = []  # openings that cut the walls that run along them
        self.top = None  # the map's y is this less the file's, if the file says so
        self.unread = collections.Counter()

    def line(self, layer, points, closed=False):
        points = list(points)
        for a, b in zip(points, points[1:] + points[:1] if closed else points[1:]):
            if a != b:
                self.walls[layer].append((*a, *b))


def apply(m, x, y):
    """The point under the affine map (a, b, c, d, e, f), as SVG writes it."""
    return m[0] * x + m[2] * y + m[4], m[1] * x + m[3] * y + m[5]


def joined(m, n):
    """The map that does n, then m."""
    e, f = apply(m, n[4], n[5])
    return (m[0] * n[0] + m[2] * n[1], m[1] * n[0] + m[3] * n[1], m[0] * n[2] + m[2] * n[3],
            m[1] * n[2] + m[3] * n[3], e, f)


def round_points(x, y, rx, ry, begin=0.0, end=2 * math.pi):
    count = max(2, math.ceil(abs(end - begin) / (2 * math.pi) * CHORDS))
    angles = (begin + (end - begin) * i / count for i in range(count + 1))
    return [(x + rx * math.cos(a), y + ry * math.sin(a)) for a in angles]


# Tabletops


def scenes(path):
    """Scenes of a Foundry file: one, one a line, or those of an adventure."""
    text = path.read_text(encoding="utf-8", errors="replace")
    try:
        documents = [json.loads(text)]
    except ValueError:
        documents = [json.loads(line) for line in text.splitlines() if line.strip()]
    for document in documents:
        if isinstance(document, list):
            yield {"walls": document}
        else:
            yield from document.get("scenes", [document])


def foundry(path):
    for scene in scenes(path):
        drawing = Drawing(scene.get("name"))
        for wall in scene.get("walls", []):
            if "c" not in wall or wall["c"][:2] == wall["c"][2:]:
                continue
            sight = wall["sight"] if "sight" in wall else {0: 0, 1: 20, 2: 10}.get(wall.get("sense", 1), 20)
            kind = {20: "normal", 10: "limited", 0: "seen through"}.get(sight, "proximity")
            if wall.get("door"):
                shut = sight == 20 and wall.get("ds") != 1
                kind = "door shut" if shut else "door open" if sight == 20 else "door seen through"
            elif wall.get("dir"):
                kind += ", one-way"
            drawing.walls[kind].append(tuple(map(float, wall["c"])))
        yield drawing


def uvtt(path):
    data = json.loads(path.read_text(encoding="utf-8", errors="replace"))
    drawing = Drawing()
    for layer in ("line_of_sight", "objects_line_of_sight"):
        for line in data.get(layer) or []:
            drawing.line(layer, [(p["x"], p["y"]) for p in line])
    for portal in data.get("portals") or []:
        shut = "shut" if portal.get("closed", True) else "open"
        drawing.line("portal " + shut, [(p["x"], p["y"]) for p in portal["bounds"]])
    yield drawing


# Tiles


def unpacked(text, encoding, compression):
    if isinstance(text, list):
        return text
    if encoding != "base64":
        return [int(word) for word in re.findall(r"\d+", text)]
    data = base64.b64decode(text)
    data = {"zlib": zlib.decompress, "gzip": gzip.decompress}.get(compression, bytes)(data)
    return list(struct.unpack(f"<{len(data) // 4}I", data))


def value(text):
    """A number of an attribute, or the text."""
    try:
        return float(text) if "." in text or "e" in text else int(text)
    except ValueError:
        return text


def tmx_object(node):
    shape = {key: value(text) for key, text in node.attrib.items()}
    for kind in ("polygon", "polyline"):
        found = node.find(kind)
        if found is not None:
            pairs = (pair.split(",") for pair in found.get("points").split())
            shape[kind] = [{"x": float(x), "y": float(y)} for x, y in pairs]
    for kind in ("ellipse", "point"):
        shape[kind] = node.find(kind) is not None
    shape["properties"] = [{"name": own.get("name"), "value": own.get("value")}
                           for own in node.iterfind("properties/property")]
    return shape


def name_of(shape):
    """The name of an object, else its class, else the text of a property of this name."""
    named = [own["value"] for own in shape.get("properties") or []
             if isinstance(own, dict) and own["name"].lower() == "name"]
    return shape.get("name") or shape.get("type") or (named[0] if named else "")


def tmx_layers(root):
    """The layers of XML in the form that the JSON has."""
    kinds = {"layer": "tilelayer", "objectgroup": "objectgroup", "group": "group"}
    for node in root:
        if node.tag not in kinds:
            continue
        layer = {key: value(text) for key, text in node.attrib.items() if key != "name"}
        layer.update(name=node.get("name", ""), type=kinds[node.tag], visible=node.get("visible") != "0")
        data = node.find("data")
        if node.tag == "group":
            layer["layers"] = list(tmx_layers(node))
        elif node.tag == "objectgroup":
            layer["objects"] = [tmx_object(child) for child in node.findall("object")]
        elif data is not None:
            layer.update(encoding=data.get("encoding"), compression=data.get("compression"))
            chunks = data.findall("chunk")
            if chunks:
                layer["chunks"] = [{**{k: int(c.get(k)) for k in ("x", "y", "width", "height")},
                                    "data": c.text or ""} for c in chunks]
            elif data.find("tile") is not None:
                layer["data"] = [int(tile.get("gid") or 0) for tile in data.findall("tile")]
            else:
                layer["data"] = data.text or ""
        yield layer


def object_points(shape):
    x, y = shape.get("x", 0), shape.get("y", 0)
    w, h = shape.get("width", 0), shape.get("height", 0)
    turn = math.radians(shape.get("rotation", 0))
    if shape.get("point") or shape.get("gid"):
        return None, False
    if shape.get("polygon") or shape.get("polyline"):
        points = [(p["x"], p["y"]) for p in shape.get("polygon") or shape["polyline"]]
    elif shape.get("ellipse"):
        points = round_points(w / 2, h / 2, w / 2, h / 2)[:-1]
    elif w and h:
        points = [(0, 0), (w, 0), (w, h), (0, h)]
    else:
        return None, False
    c, s = math.cos(turn), math.sin(turn)
    return [apply((c, s, -s, c, x, y), *p) for p in points], not shape.get("polyline")


def tile_layer(drawing, layer):
    parts = layer.get("chunks") or [dict(layer, x=0, y=0)]
    for part in parts:
        gids = unpacked(part.get("data", []), layer.get("encoding"), layer.get("compression"))
        for i, gid in enumerate(gids):
            place = part.get("x", 0) + i % part["width"], part.get("y", 0) + i // part["width"]
            drawing.squares[layer["name"], gid & 0x0FFFFFFF].add(place)


def tiled_layers(drawing, layers, at=(0, 0)):
    for layer in layers:
        here = at[0] + layer.get("offsetx", 0), at[1] + layer.get("offsety", 0)
        if layer["type"] == "group":
            tiled_layers(drawing, layer["layers"], here)
        elif layer["type"] == "tilelayer":
            tile_layer(drawing, layer)
        elif layer["type"] == "objectgroup":
            for shape in layer["objects"]:
                points, closed = object_points(shape)
                if points:
                    drawing.line(f"{layer['name']} ({name_of(shape)})",
                                 [(x + here[0], y + here[1]) for x, y in points], closed)


def tiled(path):
    if path.suffix == ".tmx":
        root = ET.parse(path).getroot()
        data = {key: value(text) for key, text in root.attrib.items()}
        layers = list(tmx_layers(root))
    else:
        data = json.loads(path.read_text(encoding="utf-8"))
        layers = data["layers"]
    drawing = Drawing()
    drawing.size, drawing.extent = data["tilewidth"], (data["width"], data["height"])
    if data["tilewidth"] != data["tileheight"]:
        drawing.unread["tiles that are no squares"] += 1
    if data.get("orientation", "orthogonal") != "orthogonal":
        drawing.unread["orientation"] += 1
    tiled_layers(drawing, layers)
    places = [place for own in drawing.squares.values() for place in own]
    if places and data.get("infinite"):
        low, high = ([end(p[i] for p in places) for i in (0, 1)] for end in (min, max))
        drawing.origin, drawing.extent = tuple(low), (high[0] - low[0] + 1, high[1] - low[1] + 1)
    if not places and not data.get("infinite"):
        width, height = data["width"] * data["tilewidth"], data["height"] * data["tileheight"]
        drawing.line("frame, seen through", [(0, 0), (width, 0), (width, height), (0, height)], True)
    yield drawing


def ldtk(path):
    project = json.loads(path.read_text(encoding="utf-8"))
    levels = project["levels"] or [level for world in project.get("worlds", []) for level in world["levels"]]
    for level in levels:
        drawing = Drawing(level["identifier"])
        for layer in level.get("layerInstances") or []:
            if not layer.get("intGridCsv"):
                continue
            size = layer["__gridSize"]
            if drawing.size not in (None, size) or layer["__pxTotalOffsetX"] or layer["__pxTotalOffsetY"]:
                drawing.unread["grids that differ"] += 1
                continue
            drawing.size, drawing.extent = size, (layer["__cWid"], layer["__cHei"])
            for i, number in enumerate(layer["intGridCsv"]):
                place = i % layer["__cWid"], i // layer["__cWid"]
                drawing.squares[layer["__identifier"], number].add(place)
        yield drawing


# DXF


def dxf_pairs_begin(lines, at):
    """Whether pairs of a code and a value begin at a line, up to a code 0 with a name."""
    for i in range(at, len(lines) - 1, 2):
        if not re.fullmatch(r" *-?\d+ *", lines[i]):
            return False
        if int(lines[i]) == 0:
            return not re.fullmatch(r"[-+.\d]*", lines[i + 1].strip())
    return True


def dxf_records(path):
    """Lists of (code, value), each from one code 0 to the next."""
    # Not splitlines(): bytes of letters are ends of lines there.
    lines = re.split("\r\n|\n|\r", path.read_bytes().decode("latin-1"))
    record, at, text = [], 0, False
    while at + 1 < len(lines) and lines[at].strip():
        code, value = int(lines[at]), lines[at + 1].strip()
        at += 2
        if code == 0 and record:
            yield record
            record = []
        record.append((code, value))
        if code == 0:
            text = value in ("TEXT", "MTEXT", "ATTRIB")
        if text and code in (1, 3):
            text = False
            while at < len(lines) and not dxf_pairs_begin(lines, at):
                at += 1  # a text that goes on
    yield record


class Dxf:
    """Tables, blocks and entities of a drawing, put out as lines."""

    def __init__(self, path):
        self.drawing = Drawing()
        self.off, self.blocks, entities = set(), {}, []
        section = block = None
        for record in dxf_records(path):
            kind, first = record[0][1], dict(reversed(record[1:]))
            if kind == "SECTION":
                section = first.get(2)
            elif section == "TABLES" and kind == "LAYER":
                if int(first.get(70, 0)) & 1 or int(first.get(62, 7)) < 0:
                    self.off.add(first[2].lower())
            elif section == "BLOCKS" and kind == "BLOCK":
                block = self.blocks[first.get(2, "").lower()] = []
                block.append((float(first.get(10, 0)), float(first.get(20, 0))))
            elif section == "BLOCKS" and kind != "ENDBLK" and block:
                block.append(record)
            elif section == "ENTITIES":
                entities.append(record)
        self.entities(entities, (1, 0, 0, 1, 0, 0), None, 0)

    def entities(self, records, m, layer_of_insert, depth):
        poly = None
        for record in records:
            kind, first = record[0][1], dict(reversed(record[1:]))
            layer = first.get(8, "0")
            if layer == "0" and layer_of_insert:
                layer = layer_of_insert
            if kind == "POLYLINE":
                poly = (layer, [], int(first.get(70, 0)), first)
            elif kind == "VERTEX" and poly:
                poly[1].append(tuple(float(first.get(code, 0)) for code in (10, 20, 42)))
            elif kind == "SEQEND" and poly:
                if self.shown(poly[3], poly[0]) and not poly[2] & ~0x81:
                    self.bulges(poly[0], poly[1], poly[2] & 1, m)
                elif poly[2] & ~0x81:
                    self.drawing.unread["POLYLINE of other kinds"] += 1
                poly = None
            elif self.shown(first, layer):
                self.entity(kind, record, first, layer, m, depth)

    def shown(self, first, layer):
        out_of_plane = float(first.get(230, 1)) != 1
        if out_of_plane:
            self.drawing.unread["turned out of the plane"] += 1
        return (layer.lower() not in self.off and first.get(67, "0") == "0" and first.get(60, "0") == "0"
                and not out_of_plane)

    def put(self, layer, points, m):
        self.drawing.line(layer, [apply(m, *point) for point in points])

    def entity(self, kind, record, first, layer, m, depth):
        def number(code, default=0.0):
            return float(first.get(code, default))

        if kind == "LINE":
            self.put(layer, [(number(10), number(20)), (number(11), number(21))], m)
        elif kind == "LWPOLYLINE":
            points = []
            for code, text in record:
                if code == 10:
                    points.append([float(text), 0.0, 0.0])
                elif code in (20, 42) and points:
                    points[-1][1 if code == 20 else 2] = float(text)
            self.bulges(layer, points, int(first.get(70, 0)) & 1, m)
        elif kind in ("ARC", "CIRCLE"):
            begin, end = math.radians(number(50)), math.radians(number(51, 360 if kind == "CIRCLE" else 0))
            if number(40) > 0:
                self.put(layer, round_points(number(10), number(20), number(40), number(40), begin,
                                             end if end > begin else end + 2 * math.pi), m)
        elif kind == "INSERT":
            self.insert(first, number, layer, m, depth)
        elif kind not in NO_WALLS:
            self.drawing.unread[kind] += 1

    def insert(self, first, number, layer, m, depth):
        block = self.blocks.get(first.get(2, "").lower())
        if not block or depth > 16 or number(70, 1) > 1 or number(71, 1) > 1:
            self.drawing.unread["INSERT"] += 1
            return
        turn = math.radians(number(50))
        c, s = math.cos(turn), math.sin(turn)
        place = (c * number(41, 1), s * number(41, 1), -s * number(42, 1), c * number(42, 1), number(10),
                 number(20))
        inner = joined(joined(m, place), (1, 0, 0, 1, -block[0][0], -block[0][1]))
        self.entities(block[1:], inner, layer, depth + 1)

    def bulges(self, layer, points, closed, m):
        points = list(points) + ([points[0]] if closed and points else [])
        for (x0, y0, bulge), (x1, y1, _) in zip(points, points[1:]):
            length = math.hypot(x1 - x0, y1 - y0)
            if not bulge or not length:
                self.put(layer, [(x0, y0), (x1, y1)], m)
                continue
            sweep = 4 * math.atan(bulge)
            radius = length / 2 / math.sin(sweep / 2)
            rise = radius * math.cos(sweep / 2)
            cx = (x0 + x1) / 2 - (y1 - y0) / length * rise
            cy = (y0 + y1) / 2 + (x1 - x0) / length * rise
            begin = math.atan2(y0 - cy, x0 - cx)
            self.put(layer, round_points(cx, cy, abs(radius), abs(radius), begin, begin + sweep), m)


def dxf(path):
    yield Dxf(path).drawing


# GeoJSON


def features_of(path):
    data = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {"features": []}
    return data.get("features", [data])


def lines_of(shape):
    kind, places = shape["type"], shape.get("coordinates", [])
    if kind == "GeometryCollection":
        return [line for part in shape["geometries"] for line in lines_of(part)]
    lines = {"LineString": [places], "MultiPolygon": [ring for part in places for ring in part],
             "Polygon": places, "MultiLineString": places}.get(kind, [])
    return [[tuple(place[:2]) for place in line] for line in lines]


def metres(longitude, latitude, lon, lat):
    """A place in the plane about longitude, latitude: the series of the transverse Mercator projection
    (Snyder, Map Projections, USGS 1987, equations 3-21 and 8-9 to 8-15), on WGS 84."""
    radius, f = 6378137.0, 1 / 298.257223563
    e2 = f * (2 - f)
    e4, e6 = e2 ** 2, e2 ** 3

    def meridian(phi):
        return radius * ((1 - e2 / 4 - 3 * e4 / 64 - 5 * e6 / 256) * phi
                         - (3 * e2 / 8 + 3 * e4 / 32 + 45 * e6 / 1024) * math.sin(2 * phi)
                         + (15 * e4 / 256 + 45 * e6 / 1024) * math.sin(4 * phi)
                         - 35 * e6 / 3072 * math.sin(6 * phi))

    phi = math.radians(lat)
    n = radius / math.sqrt(1 - e2 * math.sin(phi) ** 2)
    t, c = math.tan(phi) ** 2, e2 / (1 - e2) * math.cos(phi) ** 2
    a = math.radians(lon - longitude) * math.cos(phi)
    x = n * (a + (1 - t + c) * a ** 3 / 6 + (5 - 18 * t + t * t + 72 * c - 58 * e2) * a ** 5 / 120)
    rise = a * a / 2 + (5 - t + 9 * c + 4 * c * c) * a ** 4 / 24
    rise += (61 - 58 * t + t * t + 600 * c - 330 * e2) * a ** 6 / 720
    return x, meridian(phi) - meridian(math.radians(latitude)) + n * math.tan(phi) * rise


def geojson(path):
    """One drawing, or one for each level of a set of IMDF, by its ordinal."""
    indoor = path.name == "unit.geojson"
    features = features_of(path) + (features_of(path.parent / "opening.geojson") if indoor else [])
    levels = {level["id"]: level["properties"]["ordinal"]
              for level in features_of(path.parent / "level.geojson") if indoor}
    drawings = {}
    for feature in features:
        shape = feature.get("geometry", feature if "coordinates" in feature else None)
        properties = feature.get("properties") or {}
        level = levels.get(properties.get("level_id"))
        drawing = drawings.setdefault(level, Drawing(None if level is None else str(level)))
        layer = feature.get("feature_type") or properties.get("category") or properties.get("indoor")
        if indoor and properties.get("category") in ("unenclosedarea", "opentobelow"):
            drawing.unread["units without walls"] += 1
            continue
        for line in lines_of(shape) if shape else []:
            if layer == "opening":
                drawing.gaps += [(*a, *b) for a, b in zip(line, line[1:])]
            else:
                drawing.line(str(layer or shape["type"]), line)
    yield from drawings.values()
