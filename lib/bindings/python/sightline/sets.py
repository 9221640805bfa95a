"""Sight from lines and areas: from some point of them, or from all."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import tables
from ._library import Floats, Handle, address, as_flag, as_points, call


def _asked(points: ArrayLike, seen: str) -> tuple[Floats, bool]:
    """The points of a set, and whether all of them must see."""
    if seen not in ("some", "all"):
        raise ValueError(f"seen must be 'some' or 'all', not {seen!r}")
    return as_points(points, "points").reshape(-1, 2), seen == "all"


class Sets(Handle):
    """What levels answer about lines and areas."""

    def region_from(self, points: ArrayLike, *, area: bool = False, seen: str = "some",
                    as_array: bool = False) -> Any:
        """The region that is seen from some point of a line or an area, or from all of its points.

        Parameters
        ----------
        points
            The points of a line (n, 2), or the corners of a convex area.
        area
            The points are the corners of an area.
        seen
            "some": from some point (weak visibility). "all": from all (complete visibility).
        as_array
            A list of loops (n, 2) in place of a shapely geometry, which is the default with
            shapely. Outer loops are counter-clockwise, holes clockwise.

        Examples
        --------
        >>> import sightline
        >>> room = sightline.Plan.from_segments([(0, 0, 4, 0), (4, 0, 4, 3), (4, 3, 0, 3),
        ...                                      (0, 3, 0, 0), (2, 0, 2, 2)])
        >>> len(room.region_from([(1, 1), (3, 1)], seen="some", as_array=True))
        1
        """
        given, from_all = _asked(points, seen)
        is_area, as_array = as_flag(area, "area"), as_flag(as_array, "as_array")
        size = np.zeros(1)
        with self._lock:
            self._ask_long(call.level_set_region, np.ascontiguousarray(given), len(given), is_area,
                           from_all, size)
            pointer = self._open_pointer()
            found = np.empty((3, call.level_polygons(pointer, None, None, None)), np.int64)
            call.level_polygons(pointer, *(address(row) for row in found))
            corners = np.empty((int(found[2].sum()), 2))
            call.level_polygon_points(pointer, corners)
        loops = np.split(corners, np.cumsum(found[2])[:-1]) if found.shape[1] else []
        return loops if as_array else tables.polygons(loops)

    def seen_from(self, points: ArrayLike, places: ArrayLike, *, area: bool = False,
                  seen: str = "some") -> Any:
        """Whether places (..., 2) are seen from some point of a line or an area, or from all. Exact.

        Parameters are those of `region_from`.

        Examples
        --------
        >>> import sightline
        >>> room = sightline.Plan.from_segments([(0, 0, 4, 0), (4, 0, 4, 3), (4, 3, 0, 3),
        ...                                      (0, 3, 0, 0), (2, 0, 2, 2)])
        >>> room.seen_from([(1, 1), (1, 2.5)], [(1.5, 0.5), (3.5, 2.9), (3.5, 0.1)]).tolist()
        [True, True, False]
        """
        given, from_all = _asked(points, seen)
        at = np.ascontiguousarray(as_points(places, "places"))
        sees: NDArray[np.uint8] = np.zeros(at.shape[:-1], np.uint8)
        self._ask_long(call.level_set_sees, np.ascontiguousarray(given), len(given),
                       as_flag(area, "area"), from_all, at, sees.size, sees.reshape(-1))
        return bool(sees) if sees.ndim == 0 else sees.view(bool)
