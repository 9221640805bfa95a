"""Viewpoints: what given ones see together, and the fewest that see everything."""
from qgis.core import (QgsGeometry, QgsPointXY, QgsProcessing, QgsProcessingParameterEnum, QgsProcessingParameterFeatureSource,
                       QgsProcessingParameterNumber, QgsWkbTypes)

from . import layers
from .algorithm import Algorithm

PLACES = "anywhere", "corners", "walls", "grid"
COLUMNS = "heading", "fov", "range", "height", "tilt"


class Cover(Algorithm):
    """What viewpoints see together: the inside in convex pieces, each with how many viewpoints see it.

    The fields heading, fov, range, height and tilt of the viewpoints count where they are there. Headings are in degrees,
    counter-clockwise from east. The log has the area by how many see it, and the largest blind spots. Field blind_spot is the
    number of the blind spot, the largest 0; empty for what is seen.
    """

    NAME, TITLE, GROUP, STYLE = "cover", "Cover", "Viewpoints", "cover"
    TAGS = "cameras", "coverage", "blind spots", "visible"
    GEOMETRY = QgsWkbTypes.Polygon

    def add_parameters(self):
        self.addParameter(QgsProcessingParameterFeatureSource("POINTS", "Viewpoints", [QgsProcessing.TypeVectorPoint]))

    def answer(self, plan, crs, parameters, context, feedback):
        source = self.source(parameters, "POINTS", context)
        features, points = layers.points_of(source, crs, context)
        there = [name for name in COLUMNS if name in source.fields().names()]
        viewpoints = {"x": [x for x, _ in points], "y": [y for _, y in points],
                      **{name: [layers.value_of(feature, name) for feature in features] for name in there}}
        seen = plan.cover(viewpoints, arrays=True)
        whole = seen.areas.sum()
        for area, who in zip(seen.areas, ("no viewpoint", "1 viewpoint", "2 viewpoints", "3 viewpoints or more")):
            if area > 0:
                feedback.pushInfo(f"Seen by {who}: {area:.10g} of {whole:.10g}")
        for feature, point, area in zip(features, points, seen.viewpoints["seen"]):
            if not area > 0:
                feedback.pushWarning(f"Viewpoint {feature.id()} at {point[0]:.10g},{point[1]:.10g} sees nothing of the inside.")
        spots = seen.blind_spots
        for i in range(min(5, len(spots["area"]))):
            feedback.pushInfo(f"Blind spot of area {spots['area'][i]:.10g} at {spots['x'][i]:.10g},{spots['y'][i]:.10g}")
        table = seen.pieces(arrays=True)
        shapes = table.pop("polygon")
        counts, numbers = (table[name].tolist() for name in ("count", "blind_spot"))
        rows = ((layers.area(shape), [counts[i], None if numbers[i] < 0 else numbers[i]]) for i, shape in enumerate(shapes))
        return layers.fields_of(table)[0], rows


class Place(Algorithm):
    """The fewest viewpoints that see all that is inside, with a proof that fewer cannot (the art gallery problem).

    They look all round and without limit. The log has both bounds. After the time limit the best set so far is given, and the
    bounds say how far it may be from the fewest.
    """

    NAME, TITLE, GROUP = "place", "Place viewpoints", "Viewpoints"
    TAGS = "cameras", "guards", "art gallery", "fewest"
    GEOMETRY = QgsWkbTypes.Point

    def add_parameters(self):
        double = QgsProcessingParameterNumber.Double
        self.addParameter(QgsProcessingParameterEnum("PLACES", "Where they may stand", list(PLACES), False, 0))
        self.addParameter(QgsProcessingParameterNumber("STEP", "Distance between places on walls or of the grid", double, 1,
                                                       minValue=1e-9))
        self.addParameter(QgsProcessingParameterNumber("TIME_LIMIT", "Time limit in seconds", double, 60, minValue=0.001))

    def answer(self, plan, crs, parameters, context, feedback):
        places = PLACES[self.parameterAsEnum(parameters, "PLACES", context)]
        step = self.parameterAsDouble(parameters, "STEP", context) if places in ("walls", "grid") else None
        found = plan.place(places=places, step=step, time_limit=self.parameterAsDouble(parameters, "TIME_LIMIT", context),
                           arrays=True)
        feedback.pushInfo(f"{found.upper} viewpoint{' sees' if found.upper == 1 else 's see'} everything. {found.proof}")
        if found.slivers:
            feedback.pushWarning(f"Parts that are too thin to be found may be unseen: {found.slivers}, of area "
                                 f"{found.unseen_area:.6g} at most.")
        table = {name: found.viewpoints[name] for name in ("seen", "alone")}
        rows = ((QgsGeometry.fromPointXY(QgsPointXY(x, y)), [layers.number(column[i]) for column in table.values()])
                for i, (x, y) in enumerate(zip(found.viewpoints["x"], found.viewpoints["y"])))
        return layers.fields_of(table)[0], rows
