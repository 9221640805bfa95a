"""The plugin, and its list of algorithms."""
from qgis.core import QgsApplication, QgsProcessingProvider

from .graph import VisibilityGraph
from .isovists import Isovists
from .lines import AxialLines, Segments
from .viewpoints import Cover, Place
from .ways import Ways

ALGORITHMS = Isovists, VisibilityGraph, AxialLines, Segments, Cover, Place, Ways


class Provider(QgsProcessingProvider):
    def id(self):
        return "sightline"

    def name(self):
        return "Sightline"

    def loadAlgorithms(self):
        for algorithm in ALGORITHMS:
            self.addAlgorithm(algorithm())


class Plugin:
    def initProcessing(self):
        self.provider = Provider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self):
        self.initProcessing()

    def unload(self):
        QgsApplication.processingRegistry().removeProvider(self.provider)
