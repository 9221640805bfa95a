"""Shortest ways, and how far cells are."""
from __future__ import annotations

import math
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import tables
from ._library import Floats, Handle, as_flag, as_number, as_point, as_points, call


class Path(NamedTuple):
    """A shortest way: its length (inf: there is none), and its points (n, 2)."""

    length: float
    points: Floats


def _as_loss(loss: Optional[float]) -> float:
    return math.nan if loss is None else as_number(loss, "loss", least=0)


class Ways(Handle):
    """What levels answer about ways."""

    def path(self, start: ArrayLike, end: ArrayLike, *, loss: Optional[float] = None,
             radius: float = 0) -> Path:
        """The shortest way among the walls, for a point or a walker with a radius.

        Parameters
        ----------
        start, end
            Points (2,).
        loss
            None: shut doors block. A number: passing one counts as so much more, in map units.
        radius
            Of the walker; not with a loss. Its middle stays farther than this from all walls, and
            the way is no longer than the shortest one for 1.0013 times the radius.

        Returns
        -------
        Its `length`, losses among it, and its `points`. Without a way inf, and no points.

        Examples
        --------
        >>> import sightline
        >>> room = sightline.Plan.from_segments([(0, 0, 10, 0), (10, 0, 10, 9), (10, 9, 0, 9),
        ...                                      (0, 9, 0, 0), (5, 0, 5, 6)])
        >>> way = room.path((2, 2), (8, 2))
        >>> way.length, way.points.tolist()
        (10.0, [[2.0, 2.0], [5.0, 6.0], [8.0, 2.0]])
        >>> round(room.path((2, 2), (8, 2), radius=0.5).length, 2)
        10.98
        """
        a, b, length = as_point(start, "start"), as_point(end, "end"), np.zeros(1)
        wide = as_number(radius, "radius", least=0)
        with self._lock:
            self._ask_long(call.level_path, a, b, _as_loss(loss), wide, length)
            pointer = self._open_pointer()
            points = np.empty((call.level_path_points(pointer, None), 2))
            call.level_path_points(pointer, points.ctypes.data)
        return Path(float(length[0]), points)

    def distances(self, start: ArrayLike, *, loss: Optional[float] = None, limit: float = math.inf,
                  arrays: bool = False) -> Any:
        """How far each cell is from a point: the length of the shortest way to its nearest point.

        With a loss and a limit, these are the cells that a sound reaches.

        Parameters
        ----------
        start
            A point (2,).
        loss
            As for `path`.
        limit
            Cells that are farther have no distance.
        arrays
            A dict of arrays in place of a DataFrame, which is the default with pandas.

        Returns
        -------
        A table with a row for each cell: `distance`, or inf, and the nearest point `x`, `y`, or
        nan.

        Examples
        --------
        >>> import sightline
        >>> room = sightline.Plan.from_segments([(0, 0, 10, 0), (10, 0, 10, 9), (10, 9, 0, 9),
        ...                                      (0, 9, 0, 0), (5, 0, 5, 6)])
        >>> far = room.distances((2, 2), arrays=True)
        >>> float(far["distance"][room.locate((8, 2))])
        5.0
        """
        given, least = as_point(start, "start"), _as_loss(loss)
        most = limit if limit == math.inf else as_number(limit, "limit", least=0)
        arrays = as_flag(arrays, "arrays")
        with self._lock:
            counts = np.zeros(8, np.uint64)
            call.level_counts(self._open_pointer(), counts)
            distance, nearest = np.empty(int(counts[0])), np.empty((int(counts[0]), 2))
            self._ask_long(call.level_distances, given, least, most, distance, nearest)
        columns = {"distance": distance, "x": nearest[:, 0].copy(), "y": nearest[:, 1].copy()}
        return tables.frame(columns, arrays=arrays)

    def distances_to(self, start: ArrayLike, places: ArrayLike, *, loss: Optional[float] = None,
                     limit: float = math.inf, arrays: bool = False) -> Any:
        """How far places are from one, all at once: the shortest path map of a point.

        Parameters
        ----------
        start
            A point (2,).
        places
            Points (n, 2).
        loss, limit, arrays
            As for `distances`.

        Returns
        -------
        A table with a row for each place: `distance`, or inf, and `root_x`, `root_y`, where the
        way turns last (`start` if it is straight), or nan.

        Examples
        --------
        >>> import sightline
        >>> room = sightline.Plan.from_segments([(0, 0, 10, 0), (10, 0, 10, 9), (10, 9, 0, 9),
        ...                                      (0, 9, 0, 0), (5, 0, 5, 6)])
        >>> far = room.distances_to((2, 2), [(2, 5), (8, 2)], arrays=True)
        >>> far["distance"].tolist(), far["root_x"].tolist()
        ([3.0, 10.0], [2.0, 5.0])
        """
        given, least = as_point(start, "start"), _as_loss(loss)
        most = limit if limit == math.inf else as_number(limit, "limit", least=0)
        asked, arrays = np.ascontiguousarray(as_points(places, "places").reshape(-1, 2)), as_flag(arrays, "arrays")
        distance, root = np.empty(len(asked)), np.empty((len(asked), 2))
        with self._lock:
            self._ask_long(call.level_distances_to, given, least, most, asked, len(asked), distance, root)
        columns = {"distance": distance, "root_x": root[:, 0].copy(), "root_y": root[:, 1].copy()}
        return tables.frame(columns, arrays=arrays)
