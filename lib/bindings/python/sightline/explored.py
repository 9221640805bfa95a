"""Explored areas: the union of what was seen, for fog that stays."""
from __future__ import annotations

import ctypes
from typing import Any, Iterable

import numpy as np
from numpy.typing import ArrayLike

from . import tables
from ._library import Floats, Handle, Integers, address, as_flag, as_number, as_points, call


def _turned(loop: Any, left: bool) -> Floats:
    """A ring of shapely, counter-clockwise or not."""
    points = np.asarray(loop.coords)[:-1, :2]
    return points if loop.is_ccw == left else points[::-1]


def _loops(shape: Any) -> Iterable[Floats]:
    """The loops of a shape: outer ones counter-clockwise, holes clockwise."""
    if hasattr(shape, "geoms"):
        for each in shape.geoms:
            yield from _loops(each)
    elif hasattr(shape, "exterior"):
        if not shape.is_empty:
            yield _turned(shape.exterior, True)
            for ring in shape.interiors:
                yield _turned(ring, False)
    elif isinstance(shape, (list, tuple)) and np.ndim(shape[0] if shape else 0) == 2:
        for each in shape:
            yield from _loops(np.asarray(each))
    else:
        yield as_points(shape, "shape").reshape(-1, 2)


class Explored(Handle):
    """An area that grows: the union of what was seen.

    Parameters
    ----------
    resolution
        0: the area is exact, but for the rounding of places where outlines cross. Else all corners
        are rounded to multiples of it, and the outline has no detail below it, however much is added.

    Examples
    --------
    >>> import sightline
    >>> explored = sightline.Explored()
    >>> explored.add([(0, 0), (2, 0), (2, 1), (0, 1)])
    >>> explored.add([(1, 0), (3, 0), (3, 1), (1, 1)])
    >>> explored.area
    3.0
    >>> explored.holds([(2.5, 0.5), (2.5, 2)])
    array([ True, False])
    >>> sightline.Explored.from_text(explored.to_text()).area
    3.0
    """

    def __init__(self, resolution: float = 0) -> None:
        super().__init__(call.explored_new(), call.explored_free)
        self._ask(call.explored_begin, as_number(resolution, "resolution", least=0))

    @classmethod
    def from_text(cls, text: str, name: str = "the text") -> "Explored":
        """Read what `to_text` wrote. `name` is that of the file, for messages."""
        explored = cls.__new__(cls)
        Handle.__init__(explored, call.explored_new(), call.explored_free)
        coded = text.encode()
        explored._ask(call.explored_read, name.encode(), coded, len(coded))
        return explored

    def to_text(self) -> str:
        """The area as text, for a saved game: it reads back to the same numbers."""
        length: Integers = np.zeros(1, np.int64)
        with self._lock:
            self._ask_long(call.explored_write, length)
            text = ctypes.create_string_buffer(int(length[0]) + 1)
            call.explored_text(self._open_pointer(), text)
        return text.raw[:int(length[0])].decode()

    def add(self, shape: Any) -> None:
        """Add what was seen.

        Parameters
        ----------
        shape
            What `Level.region` and `World.region` give: a shapely polygon, or several, with holes; or
            corners (n, 2); or a list of such loops, outer ones counter-clockwise and holes clockwise.
        """
        loops = [loop for loop in _loops(shape) if len(loop)]
        corners = np.ascontiguousarray(np.concatenate(loops) if loops else np.zeros((0, 2)), float)
        ends: Integers = np.cumsum([len(loop) for loop in loops], dtype=np.int64)
        self._ask_long(call.explored_add, corners, ends, len(ends))

    def _copy(self) -> list[Floats]:
        counts: Integers = np.zeros(2, np.int64)
        with self._lock:
            self._ask_long(call.explored_counts, counts)
            ends: Integers = np.zeros(int(counts[0]), np.int64)
            corners = np.empty((int(counts[1]), 2))
            self._ask(call.explored_copy, ends, corners)
        return np.split(corners, ends[:-1]) if len(ends) else []

    def outline(self, *, as_arrays: bool = False) -> Any:
        """The area as a shapely geometry; with `as_arrays`, or without shapely, as a list of loops.

        Outer loops go counter-clockwise, holes clockwise. They meet in single points only.
        """
        flag, loops = as_flag(as_arrays, "as_arrays"), self._copy()
        return loops if flag or not loops else tables.polygons(loops)

    @property
    def area(self) -> float:
        """How large it is, in square units of the map."""
        total = 0.0
        for loop in self._copy():
            x, y = (loop - loop[0]).T
            total += float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2
        return total

    def holds(self, points: ArrayLike) -> Any:
        """Whether points are in the area, or on its border. Arrays (..., 2)."""
        places = np.ascontiguousarray(as_points(points, "points"))
        held = np.zeros(places.shape[:-1], np.uint8)
        self._ask_long(call.explored_holds, places, held.size, held.reshape(-1))
        return bool(held) if held.ndim == 0 else held.view(bool)
