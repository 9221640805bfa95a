"""Places of a map in other coordinates: pixels with y down, say."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ._library import Floats, as_flag, as_number, as_point, as_points, as_reals


@dataclass(frozen=True)
class Transform:
    """How the places of a map stand in other coordinates.

    The place (x, y) of the map is scale * (x - origin[0]), scale * (y - origin[1]) there, or
    scale * (origin[1] - y) with `y_down`. With y down the picture is the same: what is left of an
    eye stays left, polygons still go counter-clockwise as they are seen, and headings go clockwise.

    Whole numbers are exact if the scale is a power of 2. Other places are rounded.

    Attributes
    ----------
    origin
        The place in the map that is (0, 0) there.
    scale
        Units there in a unit of the map: lengths are multiplied by it.
    y_down
        Whether y grows downwards there.

    Examples
    --------
    >>> import sightline
    >>> pixels = sightline.Transform(origin=(0, 4), scale=16, y_down=True)
    >>> pixels.from_map([(0, 4), (8, 0)])
    array([[  0.,   0.],
           [128.,  64.]])
    >>> pixels.to_map((128, 64))
    array([8., 0.])
    """
    origin: tuple[float, float] = (0.0, 0.0)
    scale: float = 1.0
    y_down: bool = False

    def __post_init__(self) -> None:
        x, y = as_point(self.origin, "origin").tolist()
        object.__setattr__(self, "origin", (x, y))
        object.__setattr__(self, "scale", as_number(self.scale, "scale", over=0))
        object.__setattr__(self, "y_down", as_flag(self.y_down, "y_down"))

    def _turn(self) -> Floats:
        return np.array([1.0, -1.0 if self.y_down else 1.0])

    def to_map(self, points: ArrayLike) -> Floats:
        """Places of the map, to ask with: a point (x, y) or an array (..., 2)."""
        turned: Floats = as_points(points, "points", finite=False) * self._turn() / self.scale
        return turned + self.origin

    def from_map(self, points: ArrayLike) -> Floats:
        """Places of the map in the other coordinates: those of a region, walls as (..., 2)."""
        return self.scale * ((as_points(points, "points", finite=False) - self.origin) * self._turn())

    def heading(self, degrees: ArrayLike) -> Floats:
        """Headings in degrees, either way."""
        given = as_reals(degrees, "degrees")
        return 0 - given if self.y_down else given
