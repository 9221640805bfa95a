"""Layers of QGIS as plans and points, and results as features.

A field of the layer of walls may say what each line is. Coordinates stay as they are: answers are in those of the walls.
"""
import math

from qgis.core import (QgsFeatureRequest, QgsField, QgsGeometry, QgsLineString, QgsPointXY, QgsPolygon,
                       QgsProcessingException, QgsProcessingUtils, QgsFields, QgsWkbTypes)
from qgis.PyQt.QtCore import QVariant

KINDS = "wall", "door", "mirror", "oneway", "seam", "solid", "open", "start"


def _rings(geometry):
    """Lines of a geometry: their corners, and whether they are rings of polygons. Curves become chords."""
    for part in geometry.constParts():
        plain = part.segmentize()
        if QgsWkbTypes.geometryType(part.wkbType()) == QgsWkbTypes.PolygonGeometry:
            rings = [plain.exteriorRing()] + [plain.interiorRing(i) for i in range(plain.numInteriorRings())]
            yield from ((_corners(ring), hole) for hole, ring in enumerate(rings))
        else:
            yield _corners(plain), None


def _corners(line):
    return [(point.x(), point.y()) for point in line.points()]


class _Walls:
    """What a layer adds to a plan, kind by kind."""

    def __init__(self, plan):
        self.plan, self.segments = plan, {}

    def add(self, feature, kind, name, is_open):
        geometry = feature.geometry()
        if geometry.type() == QgsWkbTypes.PointGeometry:
            if kind not in ("", "start"):
                raise ValueError(f"a point cannot be of the kind '{kind}'")
            for point in geometry.vertices():
                self.plan.add_start((point.x(), point.y()))
            return
        is_area = geometry.type() == QgsWkbTypes.PolygonGeometry
        kind = kind or ("solid" if is_area else "wall")
        if kind == "start" or kind in ("solid", "open") and not is_area:
            raise ValueError(f"a {'polygon' if is_area else 'line'} cannot be of the kind '{kind}'")
        for corners, hole in _rings(geometry):
            if kind in ("solid", "open"):
                # A hole in solid ground is open, and the other way round.
                self.plan.add_polygon(corners, solid=(kind == "solid") != bool(hole), is_open=(kind == "open") != bool(hole))
                continue
            sides = [(*a, *b) for a, b in zip(corners, corners[1:])]
            if kind == "door":
                self.plan.add_door(name or "door", sides, is_open=is_open)
            else:
                self.segments.setdefault(kind, []).extend(sides)

    def finish(self):
        for kind, segments in self.segments.items():
            getattr(self.plan, f"add_{kind}s")(segments)


def value_of(feature, field):
    """A value of a field; None where there is none."""
    value = feature[field] if field else None
    return None if value is None or isinstance(value, QVariant) and value.isNull() else value


def crs_of(source):
    """The coordinate system of walls: that of a plane."""
    crs = source.sourceCrs()
    if crs.isGeographic():
        raise QgsProcessingException(
            f"The walls are in degrees ({crs.authid()}), where lines of sight are not straight. Project the layer first: "
            "Vector > Data Management Tools > Reproject Layer, for example to the UTM zone of the place.")
    return crs


def plan_of(sightline, source, kind_field, feedback):
    """A plan of all lines, polygons and points of a layer."""
    crs_of(source)
    plan = sightline.Plan()
    walls, names = _Walls(plan), source.fields().names()
    name_field, open_field = ("name" if "name" in names else ""), ("open" if "open" in names else "")
    for feature in source.getFeatures():
        if feedback.isCanceled():
            break
        if not feature.hasGeometry():
            continue
        kind = str(value_of(feature, kind_field) or "")
        if kind and kind not in KINDS:
            raise QgsProcessingException(f"Feature {feature.id()} of the walls: field '{kind_field}' says '{kind}', which is no "
                                         f"kind. Kinds: {', '.join(KINDS)}; empty for a wall.")
        is_open = value_of(feature, open_field)
        try:
            walls.add(feature, kind, str(value_of(feature, name_field) or ""), is_open is None or bool(is_open))
        except (ValueError, sightline.SightlineError) as fault:
            raise QgsProcessingException(f"Feature {feature.id()} of the walls: {fault}.") from fault
    walls.finish()
    return plan


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
