"""GeoJSON that Sightline wrote: its form, and whether its polygons are what GIS programs expect. It
shares nothing with the library.

check_geojson.py FILE.geojson ...

Checks: a FeatureCollection of Features (RFC 7946), each with a geometry, or null, and properties with
a `kind`; two finite coordinates; closed rings; outer rings counter-clockwise, holes clockwise and
within the outer ring; no ring crosses or touches itself or another ring of its polygon, but in single
points. Signs are exact.

Prints each fault; exit status: 0 nothing found, 1 faults found.
"""
import fractions
import json
import math
import sys


def cross(a, b, c):
    """The sign of the turn from a over b to c, exact."""
    left, right = (b[0] - a[0]) * (c[1] - a[1]), (b[1] - a[1]) * (c[0] - a[0])
    if abs(left - right) > 1e-12 * (abs(left) + abs(right)):
        return 1 if left > right else -1
    a, b, c = ([fractions.Fraction(value) for value in point] for point in (a, b, c))
    turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (turn > 0) - (turn < 0)


def area(ring):
    """Twice the area, with its sign; from the first point, so that large coordinates lose little."""
    x, y = ring[0]
    return math.fsum((a[0] - x) * (b[1] - y) - (b[0] - x) * (a[1] - y)
                     for a, b in zip(ring, ring[1:]))


def on(a, b, p):
    """Whether p, which is in line with a and b, is between them."""
    return min(a[0], b[0]) <= p[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= p[1] <= max(a[1], b[1])


def clash(a, b, c, d):
    """Whether two segments cross, or share more than an end of both."""
    if min(a[0], b[0]) > max(c[0], d[0]) or min(c[0], d[0]) > max(a[0], b[0]) or \
            min(a[1], b[1]) > max(c[1], d[1]) or min(c[1], d[1]) > max(a[1], b[1]):
        return False
    first, second = cross(a, b, c), cross(a, b, d)
    third, fourth = cross(c, d, a), cross(c, d, b)
    if first * second < 0 and third * fourth < 0:
        return True
    touching = [p for sign, ends, p in ((first, (a, b), c), (second, (a, b), d),
                                        (third, (c, d), a), (fourth, (c, d), b))
                if sign == 0 and on(*ends, p)]
    # A common end only: two of the four, which are one point.
    return bool(touching) and not (len(touching) == 2 and touching[0] == touching[1])


def edges_of(rings):
    return [(a, b) for ring in rings for a, b in zip(ring, ring[1:])]


def crossings(rings):
    """The pairs of edges that clash, found by a sweep along x."""
    edges = sorted(edges_of(rings), key=lambda edge: min(edge[0][0], edge[1][0]))
    active, found = [], []
    for edge in edges:
        left = min(edge[0][0], edge[1][0])
        active = [other for other in active if max(other[0][0], other[1][0]) >= left]
        found += [(edge, other) for other in active if clash(*edge, *other)]
        active.append(edge)
    return found


def inside(ring, p):
    """1 inside, 0 on the ring, -1 outside."""
    odd = False
    for a, b in zip(ring, ring[1:]):
        turn = cross(a, b, p)
        if turn == 0 and on(a, b, p):
            return 0
        if (a[1] <= p[1]) != (b[1] <= p[1]) and (turn > 0) == (b[1] > a[1]):
            odd = not odd
    return 1 if odd else -1


def is_point(value):
    return isinstance(value, list) and len(value) == 2 and \
        all(isinstance(v, (int, float)) and math.isfinite(v) for v in value)


def check_polygon(rings):
    if not isinstance(rings, list) or not rings:
        return "no rings"
    for number, ring in enumerate(rings):
        if len(ring) < 4 or not all(map(is_point, ring)):
            return "a ring of fewer than 4 points, or with a point that is none"
        if ring[0] != ring[-1]:
            return "a ring that is not closed"
        if len(set(map(tuple, ring[:-1]))) != len(ring) - 1:
            return "a ring that comes to a point twice"
        if (area(ring) > 0) != (number == 0):
            return "an outer ring that goes clockwise, or a hole that does not"
        if number and all(inside(rings[0], p) < 0 for p in ring):
            return "a hole outside its polygon"
    found = crossings(rings)
    return f"{len(found)} crossings: {found[0]}" if found else None


def check_geometry(geometry):
    if geometry is None:
        return None
    kind, places = geometry.get("type"), geometry.get("coordinates")
    if set(geometry) != {"type", "coordinates"}:
        return "members beside type and coordinates"
    if kind == "Point":
        return None if is_point(places) else "no point"
    if kind == "LineString":
        return None if len(places) >= 2 and all(map(is_point, places)) else "no line"
    if kind == "Polygon":
        return check_polygon(places)
    if kind != "MultiPolygon":
        return f"a geometry of type {kind}"
    fault = next(filter(None, map(check_polygon, places)), None)
    if fault or len(places) < 2:
        return fault or "one polygon alone"
    found = crossings([ring for polygon in places for ring in polygon])
    return f"polygons of one shape cross: {found[0]}" if found else None


def faults(collection):
    """Lines about what is wrong with a collection."""
    if set(collection) != {"type", "features"} or collection["type"] != "FeatureCollection":
        return ["no FeatureCollection"]
    found = []
    for number, feature in enumerate(collection["features"]):
        if set(feature) != {"type", "geometry", "properties"} or feature["type"] != "Feature":
            found.append(f"features[{number}]: no Feature")
            continue
        fault = check_geometry(feature["geometry"])
        if not isinstance(feature["properties"].get("kind"), str):
            fault = "no kind"
        if fault:
            found.append(f"features[{number}] ({feature['properties'].get('kind')}): {fault}")
    return found


def refuse(name):
    raise ValueError(f"{name} is no number of JSON")


def main():
    count = 0
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            for fault in faults(json.load(file, parse_constant=refuse)):
                print(f"{path}: {fault}")
                count += 1
    sys.exit(1 if count else 0)


if __name__ == "__main__":
    main()
