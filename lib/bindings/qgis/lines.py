"""Axial lines, and segments of a network."""
from qgis.core import (QgsProcessing, QgsProcessingParameterEnum, QgsProcessingParameterFeatureSource,
                       QgsProcessingParameterField, QgsProcessingParameterNumber, QgsWkbTypes)

from . import layers
from .algorithm import Algorithm

KEPT = "fewest", "subsets", "all"


class OfLines(Algorithm):
    """Lines with their measures."""

    GROUP = "Space syntax"
    GEOMETRY = QgsWkbTypes.LineString

    def rows_of(self, table):
        ends = [table.pop(name) for name in ("x1", "y1", "x2", "y2")]
        rows = ((layers.line([(x1, y1), (x2, y2)]), [layers.number(column[i]) for column in table.values()])
                for i, (x1, y1, x2, y2) in enumerate(zip(*ends)))
        return layers.fields_of(table)[0], rows


class AxialLines(OfLines):
    """The axial lines of what is inside (space syntax), and their measures under the names of depthmapX.

    An axial line passes two corners of walls and is as long as no wall crosses it. The fewest lines, and the subsets, cover the
    plan; all is the all-line map. The style shows integration.
    """

    NAME, TITLE, STYLE = "axiallines", "Axial lines", "axial"
    TAGS = "axial", "integration", "depthmap"

    def add_parameters(self):
        self.addParameter(QgsProcessingParameterEnum("LINES", "Lines", list(KEPT), False, 0))
        self.addParameter(QgsProcessingParameterNumber("RADIUS", "Radius in steps, 0 for no limit",
                                                       QgsProcessingParameterNumber.Integer, 0, minValue=0))

    def answer(self, plan, crs, parameters, context, feedback):
        return self.rows_of(plan.axial(KEPT[self.parameterAsEnum(parameters, "LINES", context)],
                                       radius=self.parameterAsInt(parameters, "RADIUS", context), arrays=True))


class Segments(OfLines):
    """Angular segment analysis of a network (space syntax): street centre lines, or axial lines, in place of walls.

    Lines are cut where they cross. Names are those of depthmapX, without the radius. Without a radius, time grows with the
    square of the number of segments. With a field of weights, the measures that end with _weighted are added: a segment counts
    as its weight in node count and depth, and a pair as the product of both in choice; the segments of a line share its weight
    by length. The style shows choice.
    """

    NAME, TITLE, STYLE = "segments", "Segments", "segments"
    WALLS = "Streets or axial lines"
    HAS_INSIDE = False
    TAGS = "angular", "choice", "streets", "network", "depthmap"

    def add_parameters(self):
        double = QgsProcessingParameterNumber.Double
        self.addParameter(QgsProcessingParameterNumber("METRIC_RADIUS", "Radius along the network, 0 for no limit", double, 0,
                                                       minValue=0))
        self.addParameter(QgsProcessingParameterNumber("ANGULAR_RADIUS", "Radius in right angles of turns, 0 for no limit",
                                                       double, 0, minValue=0))
        self.addParameter(QgsProcessingParameterField("WEIGHT", "Field of weights", None, "WALLS",
                                                      QgsProcessingParameterField.Numeric, optional=True))
        self.addParameter(QgsProcessingParameterFeatureSource("UNLINKS", "Crossings that are no junctions, as bridges",
                                                              [QgsProcessing.TypeVectorPoint], optional=True))

    def answer(self, plan, crs, parameters, context, feedback):
        unlinks = self.parameterAsSource(parameters, "UNLINKS", context)
        options = {"metric_radius": self.parameterAsDouble(parameters, "METRIC_RADIUS", context),
                   "angular_radius": self.parameterAsDouble(parameters, "ANGULAR_RADIUS", context),
                   "unlinks": layers.points_of(unlinks, crs, context)[1] if unlinks else None, "arrays": True}
        table = plan.segments(**options)
        if self.weights is not None:
            weighted = plan.segments(weights=self.weights, **options)
            table.update((f"{name}_weighted", column) for name, column in weighted.items()
                         if name.startswith(("t1024_", "nach", "nain")))
        return self.rows_of(table)
