"""Layers of QGIS as plans and points, and results as features.

A field of the layer of walls may say what each line is. Coordinates stay as they are: answers are in those of the walls.
"""
import collections
import math

from qgis.core import (QgsFeatureRequest, QgsField, QgsGeometry, QgsLineString, QgsPointXY, QgsPolygon,
                       QgsProcessingException, QgsProcessingUtils, QgsFields, QgsWkbTypes)
from qgis.PyQt.QtCore import QVariant

LINE_KINDS = "wall", "door", "mirror", "oneway", "seam"
KINDS = *LINE_KINDS, "solid", "open", "start"


def _corners(line):
    return [(point.x(), point.y()) for point in line.points()]


def _rings(polygon):
    return [_corners(polygon.exteriorRing())] + [_corners(polygon.interiorRing(i)) for i in range(polygon.numInteriorRings())]


class _Walls:
    """What a layer adds to a plan, kind by kind. Curves become chords."""

    def __init__(self, plan):
        self.plan, self.segments = plan, {}
        self.features, self.feature = [], None  # of each wall; of what is added now

    def add(self, part, kind, name, is_open):
        of = QgsWkbTypes.geometryType(part.wkbType())
        usual = {QgsWkbTypes.PointGeometry: "start", QgsWkbTypes.PolygonGeometry: "solid"}.get(of, "wall")
        kind = kind or usual
        if kind not in {"start": ("start",), "solid": ("solid", "open", "wall"), "wall": LINE_KINDS}[usual]:
            what = {"start": "point", "solid": "polygon", "wall": "line"}[usual]
            raise ValueError(f"a {what} cannot be of the kind '{kind}'")
        if kind == "start":
            self.plan.add_start((part.x(), part.y()))
        elif usual == "wall":
            self._add_lines(_corners(part.segmentize()), kind, name, is_open)
        else:
            self._add_area(_rings(part.segmentize()), kind)

    def _add_lines(self, corners, kind, name, is_open):
        sides = [(*a, *b) for a, b in zip(corners, corners[1:])]
        if kind == "door":
            self.plan.add_door(name or "door", sides, is_open=is_open)
        else:
            self.segments.setdefault(kind, []).extend(sides)
            if kind == "wall":
                self.features += [self.feature] * len(sides)

    def _add_area(self, rings, kind):
        for i, corners in enumerate(rings):
            if kind == "wall":
                self._add_lines(corners, kind, "", True)
            else:  # a hole in solid ground is open, and the other way round
                solid = (kind == "solid") == (i == 0)
                self.plan.add_polygon(corners, solid=solid, is_open=not solid)

    def finish(self):
        for kind, segments in self.segments.items():
            getattr(self.plan, f"add_{kind}s")(segments)

    def weights(self, field):
        """A number for each wall: the sides of a feature share its value by their lengths."""
        sides = [(feature, math.dist(side[:2], side[2:])) for feature, side in zip(self.features, self.segments.get("wall", ()))]
        lengths = collections.Counter()
        for feature, length in sides:
            if not isinstance(value_of(feature, field), (int, float)):
                raise ValueError(f"feature {feature.id()} of the walls has no number in the field '{field}'")
            lengths[feature.id()] += length
        return [value_of(feature, field) * (length / (lengths[feature.id()] or 1)) for feature, length in sides]


def value_of(feature, field):
    """A value of a field; None where there is none."""
    value = feature[field] if field else None
    return None if value is None or isinstance(value, QVariant) and value.isNull() else value


def _is_open(feature, field):
    """Whether a door is: a truth, also as 0 or 1; yes without a value."""
    value = value_of(feature, field)
    if value not in (None, 0, 1):
        raise ValueError(f"field '{field}' must hold true or false, not '{value}'")
    return value is None or bool(value)


def crs_of(source):
    """The coordinate system of walls: that of a plane."""
    crs = source.sourceCrs()
    if crs.isGeographic():
        raise QgsProcessingException(
            f"The walls are in degrees ({crs.authid()}), where lines of sight are not straight. Project the layer first: "
            "Vector > Data Management Tools > Reproject Layer, for example to the UTM zone of the place.")
    return crs


def plan_of(sightline, source, kind_field, feedback):
    """A plan of all lines, polygons and points of a layer, and its walls."""
    crs_of(source)
    plan = sightline.Plan()
    walls, names = _Walls(plan), source.fields().names()
    name_field, open_field = ("name" if "name" in names else ""), ("open" if "open" in names else "")
    for feature in source.getFeatures():
        if feedback.isCanceled():
            raise QgsProcessingException("Cancelled: the walls were not read.")
        if not feature.hasGeometry():
            continue
        kind = str(value_of(feature, kind_field) or "")
        if kind and kind not in KINDS:
            raise QgsProcessingException(f"Feature {feature.id()} of the walls: field '{kind_field}' says '{kind}', which is no "
                                         f"kind. Kinds: {', '.join(KINDS)}; empty for a wall.")
        walls.feature = feature
        try:
            is_open = kind != "door" or _is_open(feature, open_field)
            for part in feature.geometry().constParts():
                walls.add(part, kind, str(value_of(feature, name_field) or ""), is_open)
        except (ValueError, sightline.SightlineError) as fault:
            raise QgsProcessingException(f"Feature {feature.id()} of the walls: {fault}.") from fault
    walls.finish()
    return plan, walls


def points_of(source, crs, context):
    """Features and their points, in the coordinates of the walls."""
    features, points = [], []
    request = QgsFeatureRequest().setDestinationCrs(crs, context.transformContext())
    for feature in source.getFeatures(request):
        for point in feature.geometry().vertices():
            features.append(feature)
            points.append((point.x(), point.y()))
    if not points:
        raise QgsProcessingException("The layer of points has no point.")
    return features, points


def fields_of(names, source=None):
    """Fields of measures, then those of a source: of two of one name the second is renamed. Its feature ids are left out."""
    measures, others = QgsFields(), QgsFields()
    for name in names:
        measures.append(QgsField(name, QVariant.Double))
    kept = []
    for i, field in enumerate(source.fields() if source else []):
        if field.name().lower() != "fid":
            others.append(field)
            kept.append(i)
    return QgsProcessingUtils.combineFields(measures, others), kept


def number(value):
    """A measure as a field has it: none where it is not defined."""
    value = float(value)
    return value if math.isfinite(value) else None


def area(corners):
    """A polygon; no geometry without corners."""
    return QgsGeometry(QgsPolygon(_ring(corners))) if len(corners) > 2 else QgsGeometry()


def _ring(corners):
    xs, ys = [float(x) for x, _ in corners], [float(y) for _, y in corners]
    return QgsLineString(xs + xs[:1], ys + ys[:1])


def line(corners):
    """A line; no geometry without corners."""
    return QgsGeometry.fromPolylineXY([QgsPointXY(x, y) for x, y in corners]) if len(corners) > 1 else QgsGeometry()
