"""Visibility graph analysis."""
from qgis.core import (QgsGeometry, QgsProcessing, QgsProcessingParameterEnum, QgsProcessingParameterFeatureSource,
                       QgsProcessingParameterNumber, QgsRectangle, QgsWkbTypes)

from . import layers
from .algorithm import Algorithm

GROUPS = "visual", "through", "metric", "angular", "isovist"


class VisibilityGraph(Algorithm):
    """Visibility graph analysis of a grid of points (space syntax): a square for each point that is inside, with its measures
    under the names of depthmapX.

    Which points see each other is exact. For large grids, mean depth and integration can be estimated from some points: two
    more fields have the ends between which the exact mean depth lies with a probability of 99 %. A measure that is not defined has no value. The style shows visual integration.
    """

    NAME, TITLE, GROUP, STYLE = "visibilitygraph", "Visibility graph", "Space syntax", "graph"
    TAGS = "vga", "space syntax", "integration", "depthmap", "heat map"
    GEOMETRY = QgsWkbTypes.Polygon

    def add_parameters(self):
        double = QgsProcessingParameterNumber.Double
        self.addParameter(QgsProcessingParameterNumber("GRID", "Distance between points", double, 1, minValue=1e-9))
        self.addParameter(QgsProcessingParameterEnum("MEASURES", "Measures", list(GROUPS), True, [0]))
        self.addParameter(QgsProcessingParameterNumber("RANGE", "Range, 0 for no limit", double, 0, minValue=0))
        self.addParameter(QgsProcessingParameterNumber("ESTIMATE", "Estimate mean depth from so many points, 0 for exact values",
                                                       QgsProcessingParameterNumber.Integer, 0, minValue=0))
        for name, text in (("SEEDS", "Fill the grid from these points (default: all that is inside)"),
                           ("DEPTH_FROM", "Count steps from these points")):
            self.addParameter(QgsProcessingParameterFeatureSource(name, text, [QgsProcessing.TypeVectorPoint], optional=True))

    def answer(self, plan, crs, parameters, context, feedback):
        def points(name):
            source = self.parameterAsSource(parameters, name, context)
            return layers.points_of(source, crs, context)[1] if source else None

        grid = self.parameterAsDouble(parameters, "GRID", context)
        chosen = [GROUPS[i] for i in self.parameterAsEnums(parameters, "MEASURES", context)]
        distance = self.parameterAsDouble(parameters, "RANGE", context)
        table = plan.vga(grid, seeds=points("SEEDS"), measures=chosen, range=distance or None, depth_from=points("DEPTH_FROM"),
                         estimate=self.parameterAsInt(parameters, "ESTIMATE", context), arrays=True)
        if not len(table["x"]):
            feedback.pushWarning("No point of the grid is inside: give a smaller distance, or points to fill it from.")
        half = grid / 2
        rows = ((QgsGeometry.fromRect(QgsRectangle(x - half, y - half, x + half, y + half)),
                 [layers.number(column[i]) for column in table.values()])
                for i, (x, y) in enumerate(zip(table["x"].tolist(), table["y"].tolist())))
        return layers.fields_of(table)[0], rows
