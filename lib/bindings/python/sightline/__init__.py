"""What can be seen from where: 2D cell-and-portal visibility, exact.

A `Plan` is walls and what else a map holds. Baking it gives a `Level`: convex cells, the portals
between them, and which cells see each other.

>>> import sightline
>>> plan = sightline.Plan.from_segments([(0, 0, 8, 0), (8, 0, 8, 4), (8, 4, 0, 4), (0, 4, 0, 0),
...                                      (4, 0, 4, 3)])
>>> level = plan.bake()
>>> level
<Level: 2 cells, 1 portal, exact, by sweep>
>>> level.can_see((1, 1), (7, 1))
False
"""
from __future__ import annotations

from ._library import Doors
from ._library import call as _call
from ._library import said as _said
from .drawing import heat_map
from .errors import (BadArgument, BadInput, Cancelled, Closed, FileError, OutOfMemory,
                     SightlineError, SightlineWarning, Unsupported)
from .explored import Explored
from .level import Explanation, Level, Measure, PortalSequence, measures_of as _measures_of
from .placement import Coverage, Placement
from .plan import Plan
from .transform import Transform
from .ways import Path
from .world import World

__version__: str = _said(_call.version())

__all__ = ["BadArgument", "BadInput", "Cancelled", "Closed", "Coverage", "Doors", "Explanation", "Explored", "FileError",
           "Level", "Measure", "OutOfMemory", "Path", "Placement", "Plan", "PortalSequence", "SightlineError", "SightlineWarning",
           "Transform", "Unsupported", "World", "eye_methods", "exports", "formats", "heat_map", "measures", "methods"]


def _names(what: str) -> list[str]:
    return Plan()._names(what)


def formats() -> list[str]:
    """The formats of maps that `Plan.from_file` reads."""
    return _names("map_formats")


def methods() -> list[str]:
    """The methods of `Plan.bake`."""
    return _names("methods")


def eye_methods() -> list[str]:
    """The methods of `Level.look`, from the loosest to the exact one."""
    return _names("eye_methods")


def exports() -> list[str]:
    """The formats of `Level.export`."""
    return _names("exports")


def measures() -> list[Measure]:
    """The measures of isovists and visibility graphs: the columns of `isovists` and `vga`."""
    return _measures_of(Plan())
