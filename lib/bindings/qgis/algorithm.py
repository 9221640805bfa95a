"""What all algorithms share: the walls, the package, messages, styles."""
import contextlib
import inspect
import pathlib
import threading
import warnings

from qgis.core import (QgsFeature, QgsFeatureSink, QgsProcessing, QgsProcessingAlgorithm, QgsProcessingException,
                       QgsProcessingParameterFeatureSink, QgsProcessingParameterFeatureSource, QgsProcessingParameterField,
                       QgsProcessingUtils)

from . import layers

try:
    import sightline
    MISSING = ""
except ImportError as fault:
    sightline = None
    MISSING = (f"The Python package sightline is missing: {fault}. Install it in the Python of QGIS, by "
               "'apt install ./python3-sightline_*.deb' or 'python3 -m pip install sightline-*.whl', and start QGIS again. "
               "If pip says 'externally-managed-environment', add --user --break-system-packages.")

# What warnings advise in Python, and what does the same here.
ADVICE = (("add a start with plan.add_start((x, y))", "give points that are inside (STARTS)"),
          ("add seams around all that counts with add_seams",
           "set a range, or draw lines of the kind seam around all that counts"))


def advice(doubt):
    """A warning of the package, for somebody who sits before QGIS."""
    text = str(doubt)
    for python, here in ADVICE:
        text = text.replace(python, here)
    if text == str(doubt):
        text += ". In QGIS, starts are the layer of points that are inside (STARTS)"
    return text + "."


@contextlib.contextmanager
def cancelled_by(feedback, plan):
    """Stops the questions to a plan once the user cancels."""
    done = threading.Event()

    def watch():
        while not done.wait(0.1):
            if feedback.isCanceled():
                plan.cancel()

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        yield
    finally:
        done.set()
        watcher.join()


class Algorithm(QgsProcessingAlgorithm):
    """An algorithm over a layer of walls. Its docstring is its help."""

    NAME = TITLE = GROUP = STYLE = ""
    TAGS = ()
    GEOMETRY = None
    WALLS = "Walls"
    HAS_INSIDE = True
    ASKS_INSIDE = True  # whether answers depend on what is inside

    def createInstance(self):
        return type(self)()

    def name(self):
        return self.NAME

    def displayName(self):
        return self.TITLE

    def group(self):
        return self.GROUP

    def groupId(self):
        return self.GROUP.lower().replace(" ", "")

    def tags(self):
        return list(self.TAGS)

    def shortHelpString(self):
        # QGIS takes the end of a line for that of a paragraph.
        return "\n\n".join(" ".join(each.split()) for each in inspect.cleandoc(self.__doc__).split("\n\n")) + (
            "\n\nThe field of kinds says what a line of the walls is: wall, door, mirror, oneway (glass seen through from its "
            "right to its left) or seam; what a polygon is: solid, open or wall; and that a point is a start. Empty: a wall, "
            "solid ground, a start. Doors take the fields name and open.")

    def canExecute(self):
        return not MISSING, MISSING

    def initAlgorithm(self, configuration=None):
        self.addParameter(QgsProcessingParameterFeatureSource("WALLS", self.WALLS, [QgsProcessing.TypeVectorAnyGeometry]))
        self.addParameter(QgsProcessingParameterField("KIND", "Field of kinds", None, "WALLS", optional=True))
        self.addParameter(QgsProcessingParameterFeatureSource("MORE", "More of these, as polygons beside lines",
                                                              [QgsProcessing.TypeVectorAnyGeometry], optional=True))
        if self.HAS_INSIDE:
            self.addParameter(QgsProcessingParameterFeatureSource("STARTS", "Points that are inside (default: what walls enclose)",
                                                                  [QgsProcessing.TypeVectorPoint], optional=True))
        self.add_parameters()
        self.addParameter(QgsProcessingParameterFeatureSink("OUTPUT", self.TITLE))

    def processAlgorithm(self, parameters, context, feedback):
        if MISSING:  # qgis_process does not ask canExecute
            raise QgsProcessingException(MISSING)
        walls = self.source(parameters, "WALLS", context)
        with warnings.catch_warnings(record=True) as doubts:
            warnings.simplefilter("always")
            try:
                more = self.parameterAsSource(parameters, "MORE", context)
                plan, self.weights = layers.plan_of(sightline, [walls, more] if more else [walls], context, feedback,
                                                    self.parameterAsString(parameters, "KIND", context),
                                                    self.parameterAsString(parameters, "WEIGHT", context))
                starts = self.parameterAsSource(parameters, "STARTS", context) if self.HAS_INSIDE else None
                for point in layers.points_of(starts, walls.sourceCrs(), context)[1] if starts else ():
                    plan.add_start(point)
                with cancelled_by(feedback, plan):
                    fields, rows = self.answer(plan, walls.sourceCrs(), parameters, context, feedback)
            except (ValueError, sightline.SightlineError) as fault:
                raise QgsProcessingException(str(fault)) from fault
        for doubt in doubts:
            if issubclass(doubt.category, sightline.SightlineWarning):
                text = advice(doubt.message)
                if self.ASKS_INSIDE or "(STARTS)" not in text:
                    feedback.pushWarning(text)
        sink, self.made = self.parameterAsSink(parameters, "OUTPUT", context, fields, self.GEOMETRY, walls.sourceCrs())
        if sink is None:
            raise QgsProcessingException(self.invalidSinkError(parameters, "OUTPUT"))
        for geometry, values in rows:
            if feedback.isCanceled():
                break
            feature = QgsFeature(fields)
            feature.setGeometry(geometry)
            feature.setAttributes(values)
            if not sink.addFeature(feature, QgsFeatureSink.FastInsert):
                raise QgsProcessingException(f"A result cannot be written: {sink.lastError()}")
        return {"OUTPUT": self.made}

    def source(self, parameters, name, context):
        """The layer of a parameter."""
        source = self.parameterAsSource(parameters, name, context)
        if source is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, name))
        return source

    def postProcessAlgorithm(self, context, feedback):
        layer = QgsProcessingUtils.mapLayerFromString(self.made, context) if self.STYLE else None
        if layer:
            layer.loadNamedStyle(str(pathlib.Path(__file__).with_name("styles") / f"{self.STYLE}.qml"))
        return {}
