"""GeoJSON that Sightline wrote: its form, and whether its polygons are what GIS programs expect. It
shares nothing with the library.

check_geojson.py FILE.geojson ...
check_geojson.py --self-test

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


def clash(a, b, c, d, apart):
    """Whether two segments cross or overlap. Those of one ring may share an end only; of two rings
    (`apart`) any one point."""
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
    if len(set(map(tuple, touching))) != 1:
        return bool(touching)
    # A common end counts twice: as an end of each.
    return not apart and len(touching) != 2


def edges_of(rings):
    return [(a, b, number) for number, ring in enumerate(rings) for a, b in zip(ring, ring[1:])]


def crossings(rings):
    """The pairs of edges that clash, found by a sweep along x."""
    edges = sorted(edges_of(rings), key=lambda edge: min(edge[0][0], edge[1][0]))
    active, found = [], []
    for edge in edges:
        left = min(edge[0][0], edge[1][0])
        active = [other for other in active if max(other[0][0], other[1][0]) >= left]
        found += [(edge[:2], other[:2]) for other in active
                  if clash(*edge[:2], *other[:2], edge[2] != other[2])]
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
    # "crs": null says that places are in a plane; without it they are in degrees.
    if set(collection) - {"crs"} != {"type", "features"} or collection["type"] != "FeatureCollection" \
            or collection.get("crs"):
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


def self_test():
    """Each fault is found; what only looks like one is not."""
    def polygon(*rings):
        return {"type": "Polygon", "coordinates": [list(map(list, ring)) for ring in rings]}

    def several(*polygons):
        return {"type": "MultiPolygon", "coordinates": [p["coordinates"] for p in polygons]}

    square = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)]
    hole = [(1, 1), (1, 2), (2, 2), (1, 1)]
    touching = [(0, 2), (1, 3), (1, 1), (0, 2)]
    corner = [(4, 4), (5, 4), (5, 5), (4, 4)]
    good = [None, polygon(square), polygon(square, hole), polygon(square, touching),
            polygon([(0, 0), (2, 0), (4, 0), (4, 4), (0, 0)]),
            several(polygon(square, hole), polygon(corner)),
            {"type": "Point", "coordinates": [1, -2.5]},
            {"type": "LineString", "coordinates": [[0, 0], [1, 1]]}]
    bad = [polygon(square[:-1]), polygon(square[::-1]), polygon(square, hole[::-1]),
           polygon(square, [(8, 8), (8, 9), (9, 9), (8, 8)]),
           polygon(square, [(3, 3), (3, 3.5), (5, 3), (3, 3)]),
           polygon([(0, 0), (4, 4), (4, 0), (0, 3), (0, 0)]),
           polygon([(0, 0), (4, 0), (2, 0), (4, 4), (0, 0)]),
           polygon([(0, 0), (2, 1), (4, 0), (4, 4), (2, 1), (0, 4), (0, 0)]),
           polygon([(0, 0), (4, 0), (2, 1e-300), (4, -1), (4, 4), (0, 0)]),
           polygon([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 0, 0)]), polygon(),
           several(polygon(square)), several(polygon(square), polygon([(3, 3), *corner[1:3], (3, 3)])),
           several(polygon(square), polygon([(4, 1), (5, 1), (5, 2), (4, 2), (4, 1)])),
           {"type": "Point", "coordinates": [1, float("inf")]},
           {"type": "LineString", "coordinates": [[0, 0]]}, {"type": "Circle", "coordinates": []}]
    for geometry in good:
        assert not check_geometry(geometry), geometry
    for geometry in bad:
        assert check_geometry(geometry), geometry
    feature = {"type": "Feature", "geometry": None, "properties": {"kind": "a"}}
    assert not faults({"type": "FeatureCollection", "features": [feature]})
    for wrong in {"type": "Feature"}, {"type": "Feature", "geometry": None, "properties": {}}:
        assert faults({"type": "FeatureCollection", "features": [wrong]})
    assert not faults({"type": "FeatureCollection", "crs": None, "features": [feature]})
    assert faults({"type": "FeatureCollection", "crs": "EPSG:1", "features": [feature]})
    assert faults({"type": "FeatureCollection"})


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    count = 0
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            for fault in faults(json.load(file, parse_constant=refuse)):
                print(f"{path}: {fault}")
                count += 1
    sys.exit(1 if count else 0)


if __name__ == "__main__":
    main()
