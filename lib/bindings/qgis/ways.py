"""Shortest ways."""
from qgis.core import (QgsProcessing, QgsProcessingParameterFeatureSource, QgsProcessingParameterNumber,
                       QgsProcessingParameterPoint, QgsWkbTypes)

from . import layers
from .algorithm import Algorithm


class Ways(Algorithm):
    """The shortest way among the walls from a point to each of others, for a point or for a walker with a radius.

    Shut doors block it. Where there is no way, the feature has neither a line nor a length, and is named in the log.
    """

    NAME, TITLE, GROUP = "ways", "Shortest ways", "Ways"
    TAGS = "path", "route", "distance", "walk"
    GEOMETRY = QgsWkbTypes.LineString

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
        for i, (feature, point) in enumerate(zip(features, points)):
            if feedback.isCanceled():
                break
            feedback.setProgress(100 * i / len(points))
            way = plan.path((start.x(), start.y()), point, radius=radius)
            if not len(way.points):
                feedback.pushWarning(f"There is no way to point {feature.id()} at {point[0]:.10g},{point[1]:.10g}.")
            rows.append((layers.line(way.points), [layers.number(way.length)] + [feature.attribute(k) for k in kept]))
        return fields, rows
