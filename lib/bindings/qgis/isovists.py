"""Isovists of points."""
from qgis.core import (QgsProcessing, QgsProcessingParameterFeatureSource, QgsProcessingParameterField,
                       QgsProcessingParameterNumber, QgsWkbTypes)

from . import layers
from .algorithm import Algorithm


class Isovists(Algorithm):
    """The region that is visible from each point, exactly, and its measures under the names of depthmapX.

    Headings are in degrees, counter-clockwise from east. A point in solid ground sees nothing, and is named in the log.

    With a range, open ground reaches as far as the points see. Without one it ends at the outermost walls and points: the log
    has a warning where an isovist ends there.
    """

    NAME, TITLE, GROUP, STYLE = "isovists", "Isovists", "Sight", "isovists"
    TAGS = "visible", "viewshed", "field of view", "polygon"
    GEOMETRY = QgsWkbTypes.Polygon
    ASKS_INSIDE = False

    def add_parameters(self):
        self.addParameter(QgsProcessingParameterFeatureSource("POINTS", "Points", [QgsProcessing.TypeVectorPoint]))
        self.addParameter(QgsProcessingParameterNumber("RANGE", "Range, 0 for no limit", QgsProcessingParameterNumber.Double,
                                                       0, minValue=0))
        for name, text in (("HEADING", "Field of headings, in degrees"), ("FOV", "Field of widths of view, in degrees")):
            self.addParameter(QgsProcessingParameterField(name, text, None, "POINTS",
                                                          QgsProcessingParameterField.Numeric, optional=True))

    def answer(self, plan, crs, parameters, context, feedback):
        source = self.source(parameters, "POINTS", context)
        features, points = layers.points_of(source, crs, context)

        def column(name, default):
            field = self.parameterAsString(parameters, name, context)
            return [default if value is None else float(value)
                    for value in (layers.value_of(feature, field) for feature in features)]

        distance = self.parameterAsDouble(parameters, "RANGE", context)
        layers.widen(plan, points, distance)
        table = plan.isovists(points, heading=column("HEADING", 0.0), fov=column("FOV", 360.0), range=distance or None,
                              polygons=True, arrays=True)
        shapes = table.pop("polygon")
        fields, kept = layers.fields_of(table, source)
        for feature, point, shape in zip(features, points, shapes):
            if not len(shape):
                feedback.pushWarning(f"Point {feature.id()} at {point[0]:.10g},{point[1]:.10g} sees nothing: it is in solid "
                                     "ground.")
        rows = ((layers.area(shape), [layers.number(table[name][i]) for name in table]
                 + [features[i].attribute(k) for k in kept]) for i, shape in enumerate(shapes))
        return fields, rows
