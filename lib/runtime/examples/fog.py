"""Fog of war in Python: what an eye sees of a level, with doors opened and shut by name.

    sightline export LEVEL.slv --format json -o LEVEL.json
    python3 fog.py LEVEL.json PICTURE.svg X Y [open NAME | shut NAME]...

It prints and draws what fog.c does, from the JSON export, with the standard library alone.

The view spreads from the eye's cell through portals. Behind a portal it is a sector between two
directions, which each further portal narrows. A wall or a shut door ends it, and its part in the
sector is an edge of the polygon. An eye on a border looks from all cells there that open portals at
the eye join with its own. It counts in doubles: an eye in line with two corners may see a cell more
or less than by the exact answer, and none that it only touches.
"""
import json
import math
import sys


def to(a, b):
    return (b[0] - a[0], b[1] - a[1])


def cross(u, v):
    return u[0] * v[1] - u[1] * v[0]


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1]


def is_on(a, b, point):
    """Whether a point is on the line from a to b, but for rounding."""
    along = to(a, b)
    return abs(cross(along, to(a, point))) <= 1e-9 * dot(along, along)


def touches(a, b, point):
    """Whether a point is on the segment from a to b."""
    return cross(to(point, a), to(point, b)) == 0 and dot(to(point, a), to(point, b)) <= 0


def boundary(corners, portals):
    """The boundary of a cell, counter-clockwise: walls (a, b, None) and portals (a, b, portal)."""
    pieces = []
    for a, b in zip(corners, corners[1:] + corners[:1]):
        def place(p):
            middle = ((p[0][0] + p[1][0]) / 2, (p[0][1] + p[1][1]) / 2)
            return dot(to(a, b), to(a, middle)) / dot(to(a, b), to(a, b))
        here = [p for p in portals if is_on(a, b, p[0]) and is_on(a, b, p[1]) and 0 < place(p) < 1]
        at = a
        for p in sorted(here, key=place):
            pieces += [(at, p[0], None), p]
            at = p[1]
        pieces.append((at, b, None))
    return [piece for piece in pieces if piece[0] != piece[1]]


class Level:
    def __init__(self, data):
        if data.get("format") != "sightline" or data.get("version") != 2:
            raise ValueError("not a JSON export of version 2")
        if data["range"] is not None:
            raise ValueError("the level has a view range, which this example does not draw")
        self.data = data
        self.doors = data.get("doors", [])
        self.shut = {door["name"] for door in self.doors if not door["open"]}
        self.needs = {tuple(item["cells"]): item["needs"] for item in data.get("door_sets", [])}
        portals = [[] for _ in data["cells"]]
        for portal in data["portals"]:
            left, right = tuple(portal["segment"][:2]), tuple(portal["segment"][2:])
            portals[portal["cells"][0]].append((right, left, portal))
            portals[portal["cells"][1]].append((left, right, portal))
        self.is_axial = all(a[0] == b[0] or a[1] == b[1] for cell in data["cells"] for a, b in
                            zip(cell["polygon"], cell["polygon"][1:] + cell["polygon"][:1]))
        self.pieces = [boundary([tuple(corner) for corner in cell["polygon"]], portals[cell["id"]])
                       for cell in data["cells"]]

    def set_door(self, state, name):
        if state not in ("open", "shut"):
            raise ValueError(f"{state} is neither open nor shut")
        if all(door["name"] != name for door in self.doors):
            raise ValueError(f"there is no door {name}")
        (self.shut.add if state == "shut" else self.shut.discard)(name)

    def locate(self, eye):
        """The cell of the eye, as the runtime header has it: of those that hold the eye one that is
        inside, else one that is not solid. If all cells are boxes, the one over the eye and right of
        it comes first."""
        def rank(cell):
            x, y = zip(*self.data["cells"][cell]["polygon"])
            side = (max(y) <= eye[1], max(x) <= eye[0]) if self.is_axial else ()
            ground = self.data["cells"][cell]
            return not ground["inside"], bool(ground.get("solid")), side, cell

        here = [cell for cell, pieces in enumerate(self.pieces)
                if all(cross(to(a, b), to(a, eye)) >= 0 for a, b, _ in pieces)]
        if not here:
            raise ValueError("the eye is outside")
        return min(here, key=rank)

    def around(self, eye):
        """The eye's cell, and those that open portals at the eye join with it."""
        cells = [self.locate(eye)]
        for cell in cells:
            for a, b, portal in self.pieces[cell]:
                if portal and touches(a, b, eye) and self.is_open(portal, cell):
                    cells += set(portal["cells"]) - set(cells)
        return cells

    def row(self, cell):
        """What the cell sees past the doors, by the visible sets."""
        return [other for other in self.data["pvs"][cell] if (cell, other) not in self.needs or
                any(self.shut.isdisjoint(doors) for doors in self.needs[cell, other])]

    def is_open(self, portal, cell):
        ways = {None: portal["cells"], "from": portal["cells"][:1], "to": portal["cells"][1:],
                "none": []}
        return portal.get("door") not in self.shut and cell in ways[portal.get("oneway")]

    def look(self, eye):
        """The cells that the eye sees, and the ends of its polygon's edges, counter-clockwise."""
        seen, edges = set(), []

        def meet(direction, a, b):
            share = cross(to(eye, a), to(a, b)) / cross(direction, to(a, b))
            return (eye[0] + share * direction[0], eye[1] + share * direction[1])

        def spread(cell, pieces, right, left):
            seen.add(cell)
            for a, b, portal in pieces:
                from_a, to_b = to(eye, a), to(eye, b)
                cut_right = right is not None and cross(right, from_a) < 0
                cut_left = left is not None and cross(to_b, left) < 0
                if (cross(from_a, to_b) <= 0 or (cut_right and cross(right, to_b) <= 0) or
                        (cut_left and cross(from_a, left) <= 0)):
                    continue
                if portal and self.is_open(portal, cell):
                    ahead = portal["cells"][portal["cells"][0] == cell]
                    around = self.pieces[ahead]
                    entry = next(i for i, piece in enumerate(around) if piece[2] is portal)
                    spread(ahead, around[entry + 1:] + around[:entry],
                           right if cut_right else from_a, left if cut_left else to_b)
                else:
                    edges.append((meet(right, a, b) if cut_right else a,
                                  meet(left, a, b) if cut_left else b))

        def direction(edge):
            (x, y), (u, v) = to(eye, edge[0]), to(eye, edge[1])
            return math.atan2(y + v, x + u)

        for cell in self.around(eye):
            if not self.data["cells"][cell].get("solid"):
                spread(cell, self.pieces[cell], None, None)
        edges.sort(key=direction)
        points = []
        for (a, b), (after, _) in zip(edges, edges[1:] + edges[:1]):
            u, v = to(eye, b), to(eye, after)
            in_line = abs(cross(u, v)) <= 1e-9 * dot(u, v)
            points += [a, b] if in_line else [a, b, eye]  # the eye is on a wall
        return seen, points


def corners_of(points, eye):
    """The corners of a polygon, without those in line with their neighbours, but for the eye."""
    before = None
    while points != before:
        before = points
        points = [b for a, b in zip(points[-1:] + points[:-1], points) if a != b]
        points = [b for a, b, c in zip(points[-1:] + points[:-1], points, points[1:] + points[:1])
                  if b == eye or not is_on(a, c, b)]
    return points


def draw(out, level, eye, points):
    def line(s, colour):
        out.write(f"<line x1='{s[0]}' y1='{-s[1]}' x2='{s[2]}' y2='{-s[3]}' stroke='{colour}'/>\n")

    def polygon(corners, style):
        out.write(f"<polygon points='{' '.join(f'{x},{-y}' for x, y in corners)}' {style}/>\n")

    left, low, right, high = level.data["bounds"]
    out.write(f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='{left} {-high} {right - left} "
              f"{high - low}' stroke-width='{(right - left) / 300}'>\n")
    for cell in level.data["cells"]:
        polygon(cell["polygon"], "fill='#000'" if cell.get("solid") else "fill='#777' stroke='#000'")
    for portal in level.data["portals"]:
        line(portal["segment"], "#777")
    polygon(points, "fill='#fe9'")
    for door in level.doors:
        for segment in door["segments"]:
            line(segment, "red" if door["name"] in level.shut else "green")
    out.write(f"<circle cx='{eye[0]}' cy='{-eye[1]}' r='{(right - left) / 150}'/>\n</svg>\n")


def main(level_path, picture, x, y, *doors):
    with open(level_path, encoding="utf-8") as file:
        level = Level(json.load(file))
    if level.data.get("mirrors"):
        print("note: mirrors are walls here", file=sys.stderr)
    for state, name in zip(doors[::2], doors[1::2]):
        level.set_door(state, name)
    eye = (float(x), float(y))
    cell = level.locate(eye)
    seen, ends = level.look(eye)
    points = corners_of(ends, eye)
    print("cell", cell)
    print("row", *level.row(cell))
    print("seen", *sorted(seen))
    print("points", len(points))
    for point in points:
        print(*point)
    with open(picture, "w", encoding="utf-8") as out:
        draw(out, level, eye, points)


if __name__ == "__main__":
    if len(sys.argv) < 5 or len(sys.argv) % 2 == 0:
        print("usage: fog.py LEVEL.json PICTURE.svg X Y [open NAME | shut NAME]...", file=sys.stderr)
        sys.exit(2)
    sys.setrecursionlimit(100000)
    try:
        main(*sys.argv[1:])
    except (OSError, ValueError) as error:
        print(f"fog.py: {error}", file=sys.stderr)
        sys.exit(2)
