"""Axial lines of a plan, and segments of a network of lines."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import tables
from ._library import Handle, address, as_count, as_flag, as_number, as_points, as_reals, call

KEPT = ("all", "subsets", "fewest")


class Lines(Handle):
    """What plans and levels share: copies of the lines that the library keeps."""

    crs: Any

    def _lines(self, analysis: str, geometry: bool, arrays: bool) -> Any:
        names = self._names(analysis)
        pointer = self._open_pointer()
        count = call.lines_copy(pointer, None, None)
        rows, values = np.empty((count, 4)), np.empty((count, len(names)))
        call.lines_copy(pointer, rows.ctypes.data, values.ctypes.data)
        columns = {name: rows[:, i].copy() for i, name in enumerate(("x1", "y1", "x2", "y2"))}
        columns.update((name, values[:, i].copy()) for i, name in enumerate(names))
        shapes = list(rows.reshape(-1, 2, 2)) if geometry else None
        return tables.frame(columns, shapes, "line", self.crs, arrays)


class Axial(Lines):
    """What levels answer about axial lines."""

    def axial(self, lines: str = "fewest", *, radius: int = 0, threads: int = 0,
              geometry: bool = False, arrays: bool = False) -> Any:
        """The axial lines of what is inside, and their measures under the names of depthmapX.

        The longest lines that pass two corners of walls. Doors count as they are. Maps with
        mirrors, one-way glass or a range are refused.

        Parameters
        ----------
        lines
            "all": the all-line map. "subsets", "fewest": lines of it that cover the plan.
        radius
            Measures of the network up to this number of steps; 0 for no limit.
        threads
            0 for one per core. The result is the same for any number.
        geometry
            Add the lines: a GeoDataFrame, or a column `line`.
        arrays
            A dict of arrays in place of a DataFrame.

        Returns
        -------
        A table with a row for each line: its ends x1, y1, x2, y2, and its measures. NaN: not
        defined.

        Examples
        --------
        >>> import sightline
        >>> level = sightline.Plan.from_segments([(0, 0, 8, 0), (8, 0, 8, 4), (8, 4, 0, 4),
        ...                                       (0, 4, 0, 0), (4, 0, 4, 3)]).space()
        >>> len(level.axial(arrays=True)["connectivity"])
        1
        """
        if lines not in KEPT:
            raise ValueError(f"lines must be one of {', '.join(KEPT)}, not {lines!r:.40}")
        geometry, arrays = as_flag(geometry, "geometry"), as_flag(arrays, "arrays")
        with self._lock:
            self._ask_long(call.level_axial, KEPT.index(lines), as_count(radius, "radius", 2**32 - 1),
                           as_count(threads, "threads", 1024))
            return self._lines("axial_measures", geometry, arrays)


class Segments(Lines):
    """What plans answer about their walls as a network."""

    def segments(self, *, metric_radius: float = 0, angular_radius: float = 0,
                 weights: Optional[ArrayLike] = None, unlinks: Optional[ArrayLike] = None,
                 threads: int = 0, geometry: bool = False, arrays: bool = False) -> Any:
        """Angular segment analysis of the walls as a network: street centre lines, axial lines.

        Lines are cut where they cross. Names are those of depthmapX.

        Parameters
        ----------
        metric_radius
            Only segments up to this far along the network; 0 for no limit.
        angular_radius
            Only segments up to this turn, in right angles; 0 for no limit.
        weights
            A number from 0 for each wall. Its pieces share it by length. A segment then counts as
            its weight in node count and depth, and a pair as the product of both in choice.
        unlinks
            Points (n, 2) of crossings that are no junctions, as bridges.
        threads, geometry, arrays
            As for `Level.axial`.

        Returns
        -------
        A table with a row for each segment: its ends x1, y1, x2, y2, and its measures.

        Notes
        -----
        Where several shortest paths share a pair, the last digits of choice may change with the
        order of the walls: each share is rounded to 2^-24, more coarsely with weights or beyond
        262,143 segments (`sightline/axial.h`).

        Examples
        --------
        >>> import sightline
        >>> cross = sightline.Plan.from_segments([(0, 0, 2, 0), (1, -1, 1, 1)])
        >>> cross.segments(arrays=True)["connectivity"].tolist()
        [3.0, 3.0, 3.0, 3.0]
        >>> cross.segments(unlinks=[(1, 0)], arrays=True)["connectivity"].tolist()
        [1.0, 1.0, 1.0, 1.0]
        """
        metric = as_number(metric_radius, "metric_radius", least=0)
        angular = as_number(angular_radius, "angular_radius", least=0)
        geometry, arrays = as_flag(geometry, "geometry"), as_flag(arrays, "arrays")
        points = np.empty((0, 2)) if unlinks is None else np.atleast_2d(as_points(unlinks, "unlinks"))
        with self._lock:
            own = None
            if weights is not None:
                own = as_reals(weights, "weights")
                walls = len(self._segments("wall"))
                if own.shape != (walls,):
                    raise ValueError(f"weights must be an array of {walls} numbers, one for each wall, "
                                     f"not of shape {own.shape}")
            self._ask_long(call.plan_segments, metric, angular, None if own is None else address(own),
                           points, len(points), as_count(threads, "threads", 1024))
            return self._lines("segment_measures", geometry, arrays)
