"""A small reader of SVG drawings for own_readers.py: shapes and paths through their transforms.

Curves become chords. Of style sheets, only classes are read that are not displayed or have no ink.
Layers are the nearest group with a label or an id.
"""
import math
import re
import xml.etree.ElementTree as ET

from own_readers import CHORDS, Drawing, apply, joined, round_points

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
RULE = re.compile(r"\.([\w-]+)\s*\{([^}]*)\}")
BARE = re.compile(r"fill\s*:\s*none")
HIDES = re.compile(r"display\s*:\s*none")
UNSEEN = re.compile(r"display\s*:\s*none|visibility\s*:\s*(hidden|collapse)|"
                    r"(^|;)\s*opacity\s*:\s*(0+(\.0*)?|\.0+)\s*(;|$)")
COMMAND = re.compile(r"([MmZzLlHhVvCcSsQqTtAa])([^MmZzLlHhVvCcSsQqTtAa]*)")
ARC = re.compile(rf"((?:{NUMBER.pattern}[\s,]*){{3}})([01])[\s,]*([01])"  # flags may touch what follows
                 rf"([\s,]*{NUMBER.pattern}[\s,]*{NUMBER.pattern})")
COUNTS = {"m": 2, "l": 2, "h": 1, "v": 1, "c": 6, "s": 4, "q": 4, "t": 2, "a": 7, "z": 0}
LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
LINK = "{http://www.w3.org/1999/xlink}href"


def numbers(text):
    return [float(word) for word in NUMBER.findall(text or "")]


def transform(text):
    m = (1, 0, 0, 1, 0, 0)
    for name, values in re.findall(r"(\w+)\s*\(([^)]*)\)", text or ""):
        v = numbers(values)
        if name == "matrix":
            n = tuple(v)
        elif name == "translate":
            n = (1, 0, 0, 1, v[0], v[1] if len(v) > 1 else 0)
        elif name == "scale":
            n = (v[0], 0, 0, v[1] if len(v) > 1 else v[0], 0, 0)
        elif name in ("skewX", "skewY"):
            t = math.tan(math.radians(v[0]))
            n = (1, 0, t, 1, 0, 0) if name == "skewX" else (1, t, 0, 1, 0, 0)
        else:
            c, s = math.cos(math.radians(v[0])), math.sin(math.radians(v[0]))
            x, y = v[1:3] if len(v) > 2 else (0, 0)
            n = (c, s, -s, c, x - c * x + s * y, y - s * x - c * y)
        m = joined(m, n)
    return m


def bezier(points):
    """Points of a curve with these control points."""
    out = []
    for i in range(1, CHORDS // 4 + 1):
        t, row = i / (CHORDS // 4), points
        while len(row) > 1:
            row = [(a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t) for a, b in zip(row, row[1:])]
        out.append(row[0])
    return out


def arc(here, rx, ry, turn, large, sweep, x, y):
    """Points of an arc of an ellipse from its two ends, as SVG 1.1 says in F.6.5."""
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    rx, ry = abs(rx), abs(ry)
    if not rx or not ry or here == (x, y):
        return [(x, y)]
    u, v = apply((c, -s, s, c, 0, 0), (here[0] - x) / 2, (here[1] - y) / 2)
    scale = math.hypot(u / rx, v / ry)
    rx, ry = rx * max(1, scale), ry * max(1, scale)
    u, v = u / rx, v / ry
    off = math.sqrt(max(0, 1 / (u * u + v * v) - 1)) * (-1 if large == sweep else 1)
    a, b = off * v, -off * u  # the centre, where the ellipse is the circle of radius 1
    begin, end = math.atan2(v - b, u - a), math.atan2(-v - b, -u - a)
    if sweep and end < begin:
        end += 2 * math.pi
    elif not sweep and end > begin:
        end -= 2 * math.pi
    m = (c * rx, s * rx, -s * ry, c * ry, (here[0] + x) / 2, (here[1] + y) / 2)
    return [apply(m, *p) for p in round_points(a, b, 1, 1, begin, end)[1:-1]] + [(x, y)]


def path_lines(text):
    """Lists of points of a path."""
    tokens = []
    for command, values in COMMAND.findall(text):
        values = ARC.sub(r"\1 \2 \3 \4 ", values) if command in "aA" else values
        tokens += [command, *numbers(values)]
    line, here, begin, control, i, last = [], (0.0, 0.0), (0.0, 0.0), None, 0, "m"
    while i < len(tokens):
        if isinstance(tokens[i], str):
            last, i = tokens[i], i + 1
            if last in "zZ":
                yield line + [begin]
                line, here = [begin], begin
                continue
        low, v = last.lower(), tokens[i:i + COUNTS[last.lower()]]
        if low == "z" or len(v) < COUNTS[low] or any(isinstance(word, str) for word in v):
            break  # drawn up to the error
        i += COUNTS[low]
        dx, dy = here if last.islower() else (0, 0)
        if low == "a":
            points = arc(here, *v[:5], v[5] + dx, v[6] + dy)
        elif low == "h":
            points = [(v[0] + dx, here[1])]
        elif low == "v":
            points = [(here[0], v[0] + dy)]
        else:
            points = [(x + dx, y + dy) for x, y in zip(v[::2], v[1::2])]
        if low == "m":
            if len(line) > 1:
                yield line
            begin, line = points[0], []
            last = "l" if last == "m" else "L"
        if low in "st":
            points.insert(0, (2 * here[0] - control[0], 2 * here[1] - control[1]) if control else here)
        control = points[-2] if low in "csqt" else None
        line += bezier([here] + points) if low in "csqt" else points
        here = points[-1]
    if len(line) > 1:
        yield line


def rectangle(x, y, w, h, rx, ry):
    """A rectangle, with round corners where the radii say so."""
    rx, ry = min(rx or ry, w / 2), min(ry or rx, h / 2)
    points = []
    for i, (cx, cy) in enumerate(((x + w - rx, y + h - ry), (x + rx, y + h - ry), (x + rx, y + ry),
                                  (x + w - rx, y + ry))):
        points += round_points(cx, cy, rx, ry, i * math.pi / 2, (i + 1) * math.pi / 2) if rx else [(cx, cy)]
    return points + points[:1]


def shapes(node, kind):
    """Lists of points of an element that is drawn."""
    g = {key: numbers(node.get(key))[0] for key in
         ("x", "y", "width", "height", "x1", "y1", "x2", "y2", "cx", "cy", "r", "rx", "ry")
         if numbers(node.get(key)) and not node.get(key).endswith("%")}

    def n(key):
        return g.get(key, 0.0)

    if kind == "rect" and n("width") > 0 and n("height") > 0:
        return [rectangle(n("x"), n("y"), n("width"), n("height"), n("rx"), n("ry"))]
    if kind == "line":
        return [[(n("x1"), n("y1")), (n("x2"), n("y2"))]]
    if kind in ("circle", "ellipse"):
        rx, ry = (n("r"), n("r")) if kind == "circle" else (n("rx"), n("ry"))
        return [round_points(n("cx"), n("cy"), rx, ry)] if rx > 0 and ry > 0 else []
    if kind in ("polyline", "polygon"):
        v = numbers(node.get("points"))
        points = list(zip(v[::2], v[1::2]))
        return [points + points[:1] if kind == "polygon" else points]
    return list(path_lines(node.get("d") or "")) if kind == "path" else []


def walk(drawing, node, m, layer, ids, depth=0):
    kind = node.tag.rsplit("}", 1)[-1] if isinstance(node.tag, str) else ""
    style = (node.get("style") or "") + "".join(
        f";{key}:{node.get(key) or ''}" for key in ("display", "visibility", "opacity"))
    classes = set((node.get("class") or "").split())
    if classes & drawing.hidden or kind != "g" and classes & drawing.bare and "stroke" not in style:
        return
    if re.search(UNSEEN, style) or kind in (
            "defs", "symbol", "clipPath", "mask", "pattern", "marker", "linearGradient", "filter"):
        if depth == 0 or kind != "symbol":
            return
    if "transform" in style:
        drawing.unread["transforms of styles"] += 1
    m = joined(m, transform(node.get("transform")))
    if kind == "g":
        layer = node.get(LABEL) or node.get("id") or layer
    if kind == "use":
        target = ids.get((node.get(LINK) or node.get("href") or "")[1:])
        if target is not None and depth < 16:
            x, y = (numbers(node.get(key) or "0")[0] for key in ("x", "y"))
            walk(drawing, target, joined(m, (1, 0, 0, 1, x, y)), layer, ids, depth + 1)
    if kind == "style":
        drawing.unread["rules that hide, of no class"] += len(HIDES.findall(RULE.sub("", node.text or "")))
    for line in shapes(node, kind):
        drawing.line(layer, [apply(m, *point) for point in line])
    for child in node:
        walk(drawing, child, m, layer, ids, depth)


def svg(path):
    root = ET.parse(path).getroot()
    drawing = Drawing()
    rules = RULE.findall("".join(node.text or "" for node in root.findall(".//{*}style")))
    drawing.hidden = {name for name, body in rules if HIDES.search(body)}
    drawing.bare = {name for name, body in rules if BARE.search(body) and "stroke" not in body}
    ids = {node.get("id"): node for node in root.iter() if node.get("id")}
    walk(drawing, root, (1, 0, 0, 1, 0, 0), "", ids)
    drawing.unread["inner pictures"] += len(root.findall(".//{*}svg"))
    box = numbers(root.get("viewBox"))
    height = root.get("height", "")
    if len(box) == 4:
        drawing.top = box[1] + box[3]
    elif numbers(height) and not height.endswith("%"):
        drawing.top = numbers(height)[0]
    yield drawing
