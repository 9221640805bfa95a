"""Shortest ways."""
from qgis.core import (QgsProcessing, QgsProcessingParameterFeatureSource, QgsProcessingParameterNumber,
                       QgsProcessingParameterPoint, QgsWkbTypes)

from . import algorithm, layers
from .algorithm import Algorithm


class Ways(Algorithm):
    """The shortest way among the walls from a point to each of others, for a point or for a walker with a radius.

    Shut doors block it. Where there is no way, the feature has neither a line nor a length, and is named in the log. So is a
    point in solid ground or too near to a wall. Ways may lead around the outermost walls.
    """

    NAME, TITLE, GROUP = "ways", "Shortest ways", "Ways"
    TAGS = "path", "route", "distance", "walk"
    GEOMETRY = QgsWkbTypes.LineString
    ASKS_INSIDE = False

    def add_parameters(self):
        self.addParameter(QgsProcessingParameterPoint("START", "From"))
        self.addParameter(QgsProcessingParameterFeatureSource("ENDS", "To", [QgsProcessing.TypeVectorPoint]))
        self.addParameter(QgsProcessingParameterNumber("RADIUS", "Radius of the walker", QgsProcessingParameterNumber.Double, 0,
                                                       minValue=0))

    def answer(self, plan, crs, parameters, context, feedback):
        start = self.parameterAsPoint(parameters, "START", context, crs)
        source = self.source(parameters, "ENDS", context)
        radius = self.parameterAsDouble(parameters, "RADIUS", context)
        fields, kept = layers.fields_of(["length"], source)
        rows = []
        features, points = layers.points_of(source, crs, context)
        begin = start.x(), start.y()
        layers.widen(plan, [begin, *points], 3 * radius, around=True)
        plan.path(begin, begin, radius=radius)  # a start that is refused ends it all
        for i, (feature, point) in enumerate(zip(features, points)):
            if feedback.isCanceled():
                break
            feedback.setProgress(100 * i / len(points))
            line, length, fault = None, None, ""
            try:
                way = plan.path(begin, point, radius=radius)
                line, length = layers.line(way.points), layers.number(way.length)
            except algorithm.sightline.BadArgument as reason:
                fault = f": {reason}"
            if length is None:
                feedback.pushWarning(f"There is no way to point {feature.id()} at {point[0]:.10g},{point[1]:.10g}{fault}.")
            rows.append((line, [length] + [feature.attribute(k) for k in kept]))
        return fields, rows
