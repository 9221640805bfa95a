"""Worlds: walls that change, and questions in between."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from . import tables
from ._library import (Floats, Handle, Integers, address, as_flag, as_number, as_point, as_points,
                       as_reals, as_segments, call, word)

if TYPE_CHECKING:
    from .plan import Plan


ROWS = ("none", "now", "later")
SIGHTS = ("closed", "open")
STOPS = ("sight", "steps", "sound")
MAY_STOP = (*STOPS, "limited")


def _choice(value: str, name: str, names: Sequence[str]) -> int:
    if value not in names:
        raise ValueError(f"{name} must be one of {', '.join(map(repr, names))}, not {value!r:.40}")
    return names.index(value)


def _one_segment(value: ArrayLike) -> Floats:
    segments = as_segments(value, "segment")
    if len(segments) != 1:
        raise ValueError(f"segment must be one segment, not {len(segments)}")
    return segments.reshape(4)


def _as_wall(value: Any) -> int:
    numbers = np.asarray(value)
    if numbers.ndim or numbers.dtype.kind not in "iu":
        raise TypeError(f"a wall is a whole number, not {value!r:.40}")
    return int(numbers)


class World(Handle):
    """Walls that change: an edit costs what it touches, and no bake. `Plan.edit` makes one.

    Walls have numbers, from when they are added until they are removed: first those of the plan's
    walls, then of its doors, its one-way glass, its seams and its mirrors. Edits count from `commit` on. Answers
    are those of a plan that is made anew, but nothing is welded: where ends of walls meet but for
    rounding, slits stay that a bake closes.

    Examples
    --------
    >>> import sightline
    >>> room = [(0, 0, 8, 0), (8, 0, 8, 4), (8, 4, 0, 4), (0, 4, 0, 0)]
    >>> world = sightline.Plan.from_segments(room).edit()
    >>> world.can_see((1, 1), (7, 1))
    True
    >>> wall = world.add((4, 0, 4, 3))
    >>> world.commit()
    >>> world.can_see((1, 1), (7, 1))
    False
    >>> world.remove(wall)
    >>> world.commit()
    >>> world.can_see((1, 1), (7, 1))
    True
    """

    def __init__(self, plan: "Plan", bounds: Optional[ArrayLike] = None, rows: str = "none",
                 sight: str = "closed") -> None:
        from .plan import Plan  # which imports this module

        if not isinstance(plan, Plan):
            raise TypeError(f"a world is made of a Plan, not {type(plan).__name__}")
        kept, open_sight = _choice(rows, "rows", ROWS), _choice(sight, "sight", SIGHTS)
        super().__init__(call.world_new(), call.world_free)
        box = None if bounds is None else as_reals(bounds, "bounds")
        if box is not None and box.shape != (4,):
            raise ValueError("bounds must be x0, y0, x1, y1")
        with plan._lock:
            self._ask(call.world_begin, plan._open_pointer(), None if box is None else address(box),
                      kept, open_sight)

    def add(self, segments: ArrayLike, kind: str = "wall", *, name: str = "door",
            open: bool = False, stops: Union[str, Sequence[str]] = STOPS,
            one_sided: bool = False) -> Any:
        """Add walls at the next commit. All of them, or none where one is refused.

        Parameters
        ----------
        segments
            One (4,), which gives a number, or several (n, 4), which give an array of numbers.
        kind
            "wall", "door", "oneway" (seen through from its right to its left), "seam", or "mirror".
        name, open
            Of doors.
        stops
            What walls stop, of "sight", "steps" and "sound": one of them, or several. So a window
            is ("steps", "sound"), and a curtain is "sight". "limited" is in place of "sight": it
            passes one such wall, not two.
        one_sided
            Of mirrors: they reflect on their left alone, going along them.
        """
        rows = as_segments(segments, "segments")
        bits = 0
        for what in (stops,) if isinstance(stops, str) else stops:
            bits |= 1 << _choice(what, "stops", MAY_STOP)
        numbers: Integers = np.zeros(len(rows), np.int64)
        self._ask(call.world_add, word(kind, "kind"), word(name, "name"), as_flag(open, "open"), bits,
                  as_flag(one_sided, "one_sided"), rows, len(rows), numbers)
        return int(numbers[0]) if np.ndim(segments) == 1 else numbers

    def add_solid(self, corners: ArrayLike) -> Integers:
        """Add a polygon of solid ground; the numbers of its walls. It goes when they are removed."""
        points = np.ascontiguousarray(as_points(corners, "corners").reshape(-1, 2))
        numbers: Integers = np.zeros(len(points), np.int64)
        self._ask(call.world_add_solid, points, len(points), numbers)
        return numbers

    def remove(self, walls: ArrayLike) -> None:
        """Remove walls, one number or several, at the next commit."""
        numbers = np.asarray(walls)
        if numbers.size and numbers.dtype.kind not in "iu":
            raise TypeError("walls are whole numbers")
        rows = np.ascontiguousarray(numbers, np.int64).reshape(-1)
        self._ask(call.world_remove, rows, len(rows))

    def move(self, wall: int, segment: ArrayLike) -> None:
        """Move a wall at the next commit; it keeps its number."""
        self._ask(call.world_move, _as_wall(wall), _one_segment(segment))

    def set_open(self, door: int, open: bool) -> None:
        """Open or shut a door at the next commit."""
        self._ask(call.world_set_open, _as_wall(door), as_flag(open, "open"))

    def commit(self) -> None:
        """Make the edits. If this raises, they are forgotten, and all is as it was."""
        self._ask_long(call.world_commit)

    def discard(self) -> None:
        """Forget the edits since the last commit."""
        with self._lock:
            call.world_discard(self._open_pointer())

    def settle(self, milliseconds: float) -> int:
        """Make visible sets exact for about so long, at least one. How many are not exact yet."""
        left: Integers = np.zeros(1, np.int64)
        self._ask_long(call.world_settle, as_number(milliseconds, "milliseconds", least=0), left)
        return int(left[0])

    def plan(self) -> "Plan":
        """The walls as they are, as a plan of its own: for files and bakes."""
        from .plan import Plan
        plan = Plan()
        with self._lock:
            self._ask(call.world_plan, plan._open_pointer())
        return plan

    def can_see(self, a: ArrayLike, b: ArrayLike) -> Any:
        """Whether points see each other directly. Exact. Arrays (..., 2) broadcast."""
        return self._ask_pairs(call.world_can_see, a, b)

    def may_see(self, a: ArrayLike, b: ArrayLike) -> Any:
        """Whether the cells that points are in see each other, by visible sets (`Plan.edit`).

        False: no place of the one sees one of the other. Arrays (..., 2) broadcast.
        """
        return self._ask_pairs(call.world_may_see, a, b)

    def _ask_pairs(self, question: Any, a: ArrayLike, b: ArrayLike) -> Any:
        eyes, places = np.broadcast_arrays(as_points(a, "a"), as_points(b, "b"))
        eyes, places = np.ascontiguousarray(eyes), np.ascontiguousarray(places)
        sees = np.zeros(eyes.shape[:-1], np.uint8)
        self._ask_long(question, eyes, places, sees.size, sees.reshape(-1))
        return bool(sees) if sees.ndim == 0 else sees.view(bool)

    def region(self, eye: ArrayLike, heading: float = 0, fov: float = 360, *,
               tolerance: Optional[float] = None, as_array: bool = False) -> Any:
        """The visible region of an eye. The parameters are those of `Level.region`."""
        at, flag = as_point(eye, "eye"), as_flag(as_array, "as_array")
        error = 0.0 if tolerance is None else as_number(tolerance, "tolerance", over=0)
        count: Integers = np.zeros(1, np.int64)
        with self._lock:
            self._ask(call.world_region, at, as_number(heading, "heading"), as_number(fov, "fov"),
                      error, count)
            corners = np.empty((int(count[0]), 2))
            call.world_region_points(self._open_pointer(), error, corners, len(corners))
        return corners if flag else tables.polygon(corners)
