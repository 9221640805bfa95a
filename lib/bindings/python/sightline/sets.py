"""Sight from lines and areas: from some point of them, or from all."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import tables
from ._library import Floats, Handle, address, as_flag, as_number, as_points, call


def _asked(points: ArrayLike, seen: str, radius: float) -> tuple[Floats, float, bool]:
    """The points of a set, the radius of a disc, and whether all of them must see."""
    if seen not in ("some", "all"):
        raise ValueError(f"seen must be 'some' or 'all', not {seen!r}")
    given, wide = as_points(points, "points").reshape(-1, 2), as_number(radius, "radius", least=0)
    if wide > 0 and len(given) != 1:
        raise ValueError(f"radius is for one point, the middle of a disc, not for {len(given)}")
    return np.ascontiguousarray(given), wide, seen == "all"


class Sets(Handle):
    """What levels answer about lines and areas."""

    def region_from(self, points: ArrayLike, *, area: bool = False, radius: float = 0,
                    seen: str = "some", as_array: bool = False) -> Any:
        """The region that is seen from some point of a line or an area, or from all of its points.

        Within the `range`, bent borders are chords: a point that is seen from as far as 255/256 of
        the range is in the region.

        Parameters
        ----------
        points
            The points of a line (n, 2), or the corners of a convex area.
        area
            The points are the corners of an area.
        radius
            Of a disc about one point: as a polygon in it, with chords within a thousandth of this.
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
        given, wide, from_all = _asked(points, seen, radius)
        is_area, as_array = as_flag(area, "area"), as_flag(as_array, "as_array")
        size = np.zeros(1)
        with self._lock:
            self._ask_long(call.level_set_region, given, len(given), is_area, wide, from_all, size)
            pointer = self._open_pointer()
            found = np.empty((3, call.level_polygons(pointer, None, None, None)), np.int64)
            call.level_polygons(pointer, *(address(row) for row in found))
            corners = np.empty((int(found[2].sum()), 2))
            call.level_polygon_points(pointer, corners)
        loops = np.split(corners, np.cumsum(found[2])[:-1]) if found.shape[1] else []
        return loops if as_array else tables.polygons(loops)

    def exposure(self, path: ArrayLike, things: Any, *, area: bool = False,
                 arrays: bool = False) -> Any:
        """What of each thing is seen from a path, and from how much of the path.

        Parameters
        ----------
        path
            Points (n, 2).
        things
            Lines (n, 2), which are walls, doors or outlines: a list, or a dict of names.
        area
            The things are convex areas, given by their corners.
        arrays
            A dict of arrays in place of a DataFrame, which is the default with pandas.

        Returns
        -------
        A table: `name`, `size` (a length, or the area that is inside), `seen` (of that), `share`,
        `path_some` and `path_all`, the lengths of the path that see some of it and all of it, and
        `first`, how far along the path it is seen first; nan: never.

        Examples
        --------
        >>> import sightline
        >>> room = sightline.Plan.from_segments([(0, 0, 4, 0), (4, 0, 4, 3), (4, 3, 0, 3),
        ...                                      (0, 3, 0, 0), (2, 0, 2, 2)])
        >>> seen = room.exposure([(1, 1), (1, 3)], {"east": [(4, 0), (4, 3)]}, arrays=True)
        >>> [round(float(seen[name][0]), 9) for name in ("size", "share", "first")]
        [3.0, 1.0, 0.5]
        """
        way = np.ascontiguousarray(as_points(path, "path").reshape(-1, 2))
        names = list(things) if isinstance(things, dict) else [str(i) for i in range(len(things))]
        parts = [as_points(part, "things").reshape(-1, 2)
                 for part in (things.values() if isinstance(things, dict) else things)]
        if any(not len(part) for part in parts):
            raise ValueError("a thing has no points")
        is_area, arrays = as_flag(area, "area"), as_flag(arrays, "arrays")
        rows = np.empty((len(parts), 5))
        ends = np.cumsum([len(part) for part in parts], dtype=np.int64)
        points = np.ascontiguousarray(np.concatenate(parts)) if parts else np.empty((0, 2))
        self._ask_long(call.level_exposure, way, len(way), points, ends, len(parts), is_area, rows)
        size, seen = rows[:, 0].copy(), rows[:, 1].copy()
        share = np.divide(seen, size, out=np.zeros_like(seen), where=size > 0)
        columns = {"name": np.array(names, object), "size": size, "seen": seen, "share": share,
                   "path_some": rows[:, 2].copy(), "path_all": rows[:, 3].copy(),
                   "first": rows[:, 4].copy()}
        return tables.frame(columns, arrays=arrays)

    def sees_within(self, start: ArrayLike, start_radius: float, end: ArrayLike, end_radius: float,
                    *, on_foot: bool = False) -> Any:
        """Whether some place near `start` may see some place near `end`. Conservative: never misses.

        Each call prepares the level: ask for many pairs at once.

        Parameters
        ----------
        start, end
            Points (..., 2), which go together as numpy's arrays do.
        start_radius, end_radius
            How far places may be from them.
        on_foot
            Count only places that a way of that length leads to, through doors as they stand.

        Examples
        --------
        >>> import sightline
        >>> rooms = sightline.Plan.from_segments([(0, 0, 4, 0), (4, 0, 4, 3), (4, 3, 0, 3),
        ...                                       (0, 3, 0, 0), (2, 0, 2, 2.5)])
        >>> level = rooms.space()
        >>> [bool(level.sees_within((1.5, 0.5), 0.9, (2.5, 0.5), 0.9, on_foot=foot))
        ...  for foot in (False, True)]
        [True, False]
        """
        a, b = np.broadcast_arrays(as_points(start, "start"), as_points(end, "end"))
        near, far = (as_number(start_radius, "start_radius", least=0),
                     as_number(end_radius, "end_radius", least=0))
        sees: NDArray[np.uint8] = np.zeros(a.shape[:-1], np.uint8)
        self._ask_long(call.level_sees_within, np.ascontiguousarray(a), near,
                       np.ascontiguousarray(b), far, sees.size, as_flag(on_foot, "on_foot"),
                       sees.reshape(-1))
        return bool(sees) if sees.ndim == 0 else sees.view(bool)

    def seen_from(self, points: ArrayLike, places: ArrayLike, *, area: bool = False,
                  radius: float = 0, seen: str = "some") -> Any:
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
        given, wide, from_all = _asked(points, seen, radius)
        at = np.ascontiguousarray(as_points(places, "places"))
        sees: NDArray[np.uint8] = np.zeros(at.shape[:-1], np.uint8)
        self._ask_long(call.level_set_sees, given, len(given), as_flag(area, "area"), wide, from_all,
                       at, sees.size, sees.reshape(-1))
        return bool(sees) if sees.ndim == 0 else sees.view(bool)
