"""Viewpoints (cameras, guards): what given ones see together, and where the fewest must stand."""
from __future__ import annotations

import csv
import ctypes
import io
import os
import time
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import drawing, tables
from ._library import (Floats, Handle, Place, address, as_flag, as_number, as_points, call,
                       existing, said)

COLUMNS = ("name", "x", "y", "heading", "fov", "range", "height", "tilt", "letters", "sign", "cost")
_NUMBERS = ("x", "y", "heading", "fov", "range", "nearest", "height", "tilt", "letters", "sign",
            "cost", "seen", "alone", "spare")
_PARTS = ("from", "to", "from_x", "from_y", "to_x", "to_y")
_SPOTS = ("area", "x", "y", "x0", "y0", "x1", "y1")
# By how many see a place: none, 1, 2, 3 or more.
_CLASSES = ("#e4572e", "#dcecc9", "#8fc6a0", "#2f8f83")


def _cell(value: Any) -> Any:
    """A value of a table as text that reads back as the same; "" for none."""
    if value is None or type(value).__name__ == "NAType" or bool(value != value):
        return ""
    return value if isinstance(value, str) else repr(float(value))


def _table_text(viewpoints: Any) -> bytes:
    """Viewpoints in any form, as the table that the library reads."""
    if hasattr(viewpoints, "columns"):
        names = [str(name) for name in viewpoints.columns if name in COLUMNS]
        rows = list(zip(*(list(viewpoints[name]) for name in names)))
    elif isinstance(viewpoints, dict):
        names = [name for name in viewpoints if name in COLUMNS]
        rows = list(zip(*(np.atleast_1d(viewpoints[name]).tolist() for name in names)))
    elif len(viewpoints) and all(isinstance(row, dict) for row in viewpoints):
        names = [name for name in COLUMNS if any(name in row for row in viewpoints)]
        for number, row in enumerate(viewpoints):
            unknown = [name for name in row if name not in COLUMNS]
            if unknown:
                raise ValueError(f"viewpoint {number} has {unknown[0]!r}; there are {', '.join(COLUMNS)}")
        rows = [tuple(row.get(name) for name in names) for row in viewpoints]
    else:
        names, rows = ["x", "y"], as_points(viewpoints, "viewpoints").reshape(-1, 2).tolist()
    if "x" not in names or "y" not in names:
        raise ValueError("viewpoints need the columns x and y")
    if not rows:
        raise ValueError("there is no viewpoint")
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(names)
    writer.writerows([_cell(value) for value in row] for row in rows)
    return out.getvalue().encode("utf-8")


@dataclass(frozen=True, repr=False)
class Coverage:
    """What viewpoints see together.

    Attributes
    ----------
    areas
        What exactly 0, 1 and 2 of them see, and 3 or more, of all that is inside.
    viewpoints
        A table: name, x, y, heading, fov, range, nearest (the dead zone), height, tilt, letters,
        sign, cost; `seen`, the area that each sees; `alone`, what no other sees; `spare`, whether the others
        see all of that.
    blind_spots
        A table, the largest first: area, x and y of the middle of its largest piece, and its box
        x0, y0, x1, y1.
    unseen
        The parts of the path that nobody sees, a table: from and to, how far along it, and both
        ends from_x, from_y, to_x, to_y. None without a path.
    """
    areas: Floats
    viewpoints: Any
    blind_spots: Any
    unseen: Any
    _of: Any
    _pieces: tuple[NDArray[np.int64], NDArray[np.int64], list[Floats]]

    @property
    def share(self) -> float:
        """The share of the inside that is seen, 0 to 1."""
        return float(self.areas[1:].sum() / self.areas.sum())

    def pieces(self, *, arrays: bool = False) -> Any:
        """Convex pieces that tile the inside: `count`, how many see it, and `blind_spot` or -1.

        A GeoDataFrame with geopandas, else a table with a column `polygon` of corners. `arrays`:
        always a dict of arrays.
        """
        counts, spots, corners = self._pieces
        return tables.frame({"count": counts.copy(), "blind_spot": spots.copy()}, corners, "polygon",
                            self._of.crs, as_flag(arrays, "arrays"))

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draw with matplotlib: one colour for 0, 1, 2, 3 or more; viewpoints; walls."""
        from matplotlib.collections import PolyCollection
        ax = drawing.plot(self._of, ax, **style)
        counts, _, corners = self._pieces
        colours = [_CLASSES[min(int(count), 3)] for count in counts]
        ax.add_collection(PolyCollection(corners, facecolor=colours, edgecolor="none", zorder=1))
        table = self.viewpoints
        ax.plot(np.asarray(table["x"]), np.asarray(table["y"]), "o", color="#222222", ms=4, zorder=5)
        return ax

    def __repr__(self) -> str:
        count = len(self.viewpoints["x"])
        return f"<Coverage: {count} viewpoint{'' if count == 1 else 's'} see {100 * self.share:.4g} %>"


@dataclass(frozen=True, repr=False)
class Placement:
    """The fewest viewpoints that see all that is inside, as far as they were found.

    Attributes
    ----------
    lower
        No fewer viewpoints can do it: those of anywhere, or those of the given places. Exact.
    upper
        As many as there are in `viewpoints`, which see everything.
    proof
        What is proven, in a sentence.
    witnesses
        Points (n, 2), rounded: fewer than `lower` viewpoints do not see all of them.
    slivers
        Parts of borders beyond which something may be unseen, too thin to be found; 0: none.
    unseen_area
        Of the slivers.
    coverage
        What the viewpoints see, as `Level.cover`.
    """
    lower: int
    upper: int
    proof: str
    witnesses: Floats
    rounds: int
    slivers: int
    unseen_area: float
    seconds: float
    coverage: Coverage

    @property
    def optimal(self) -> bool:
        """Whether no fewer viewpoints can do it."""
        return self.lower == self.upper

    @property
    def viewpoints(self) -> Any:
        """The viewpoints, a table as in `Coverage`."""
        return self.coverage.viewpoints

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """As `Coverage.plot`."""
        return self.coverage.plot(ax, **style)

    def __repr__(self) -> str:
        most = f"{self.upper} viewpoint{'' if self.upper == 1 else 's'}"
        return f"<Placement: {most}, {'no fewer can' if self.optimal else f'at least {self.lower}'}>"


class Viewpoints(Handle):
    """Questions of a level about viewpoints."""

    crs: Any

    def cover(self, viewpoints: Any, *, fov: float = 360, range: float = 0, signs: bool = False,
              path: Optional[ArrayLike] = None, arrays: bool = False) -> Coverage:
        """What viewpoints see together: areas by how many see them, and blind spots.

        Doors and the range count as they are. What is seen by mirror does not. A viewpoint that is
        not inside sees nothing that counts.

        Parameters
        ----------
        viewpoints
            Points (n, 2), a DataFrame, a dict of columns, a list of dicts, or the path of a table.
            Columns are x and y, and any of name, heading, fov, range, height, tilt, letters, sign,
            cost. With height and tilt (degrees below the horizon) there is a dead zone below a
            camera. With letters (their height), or a sign other than 0, a row is a sign: it covers
            where it can be read, a disc before its wall that is `range` or 100 times the letters
            wide.
        fov, range
            What rows have that do not say it; a range of 0 has no limit.
        signs
            All rows are signs.
        path
            Points (n, 2): `Coverage.unseen` lists its parts that nobody sees.
        arrays
            Dicts of arrays in place of DataFrames, which are the default with pandas.

        Examples
        --------
        >>> import sightline
        >>> level = sightline.Plan.from_segments([(0, 0, 8, 0), (8, 0, 8, 4), (8, 4, 0, 4),
        ...                                       (0, 4, 0, 0), (4, 0, 4, 3)]).space()
        >>> seen = level.cover([(4, 3.5), (1, 1)])
        >>> seen
        <Coverage: 2 viewpoints see 100 %>
        >>> seen.viewpoints["spare"].tolist()
        [False, True]
        >>> corridor = sightline.Plan.from_segments([(0, 0, 20, 0), (20, 0, 20, 4), (20, 4, 0, 4),
        ...                                          (0, 4, 0, 0)])
        >>> read = corridor.cover([{"x": 0, "y": 2, "letters": 0.1}], path=[(0, 2), (20, 2)])
        >>> [round(float(at), 9) for at in (read.unseen["from"][0], read.unseen["to"][0])]
        [10.0, 20.0]
        """
        fov, range = as_number(fov, "fov", over=0), as_number(range, "range", least=0)
        arrays, signs = as_flag(arrays, "arrays"), as_flag(signs, "signs")
        way = None if path is None else np.ascontiguousarray(as_points(path, "path").reshape(-1, 2))
        if isinstance(viewpoints, (str, os.PathLike)):
            name, content = existing(viewpoints), None
        else:
            name, content = b"viewpoints", _table_text(viewpoints)
        with self._lock:
            self._ask_long(call.level_cover, name, content, len(content or b""), fov, range, signs)
            if way is not None:
                self._ask_long(call.level_cover_path, way, len(way))
            return self._coverage(arrays, way is not None)

    def place(self, *, places: Union[str, ArrayLike] = "anywhere", step: Optional[float] = None,
              time_limit: Optional[float] = None, arrays: bool = False) -> Placement:
        """The fewest viewpoints that see all that is inside, with a proof that fewer cannot.

        They look all round and without limit. Doors count as they are. Maps with mirrors, one-way
        glass or a range are refused. Both bounds close in; the gap is that of this package's own
        search, without a linear program.

        Parameters
        ----------
        places
            "anywhere", "corners", "walls", "grid", or points (n, 2) to choose from.
        step
            Between points of "grid", or along walls.
        time_limit
            Seconds: after them, the best set and both bounds so far. `Cancelled` without a set.
        arrays
            As for `cover`.

        Examples
        --------
        >>> import sightline
        >>> plan = sightline.Plan.from_segments([(0, 0, 8, 0), (8, 0, 8, 4), (8, 4, 0, 4),
        ...                                      (0, 4, 0, 0), (4, 0, 4, 3)])
        >>> plan.place()
        <Placement: 1 viewpoint, no fewer can>
        """
        arrays = as_flag(arrays, "arrays")
        limit = 0.0 if time_limit is None else as_number(time_limit, "time_limit", over=0)
        options = Place(step=0.0 if step is None else as_number(step, "step", over=0),
                        time_limit=limit)
        points = None
        if isinstance(places, str):
            if places not in ("anywhere", "corners", "walls", "grid"):
                raise ValueError("places must be 'anywhere', 'corners', 'walls', 'grid' or points, "
                                 f"not {places!r}")
            if places == "grid" and step is None:
                raise ValueError("a grid needs a step")
            setattr(options, "from", None if places == "anywhere" else places.encode())
        else:
            points = as_points(places, "places").reshape(-1, 2)
            if not len(points):
                raise ValueError("there is no place to choose from")
            options.places, options.count = address(points), len(points)
        if step is not None and not (points is None and places in ("grid", "walls")):
            raise ValueError("only a grid and walls have a step")
        start = time.monotonic()
        with self._lock:
            self._ask_long(call.level_place, ctypes.byref(options))
            seconds = time.monotonic() - start
            pointer = self._open_pointer()
            numbers, unseen = np.zeros(5, np.int64), np.zeros(1)
            call.level_placed(pointer, numbers, unseen, None)
            lower, upper, rounds, slivers, count = numbers.tolist()
            witnesses = np.empty((count, 2))
            call.level_placed(pointer, numbers, unseen, address(witnesses))
            coverage = self._coverage(arrays)
            proof = said(call.level_place_proof(pointer))
        return Placement(lower, upper, proof, witnesses, rounds, slivers, float(unseen[0]), seconds,
                         coverage)

    def _coverage(self, arrays: bool, has_path: bool = False) -> Coverage:
        """A copy of what the library keeps."""
        pointer, counts = self._open_pointer(), np.zeros(4, np.int64)
        call.level_cover_counts(pointer, counts)
        viewpoints, blind, pieces, corners = counts.tolist()
        areas, rows, spots = np.zeros(4), np.empty((viewpoints, 14)), np.empty((blind, 7))
        call.level_cover_copy(pointer, areas, rows, spots)
        offsets = np.empty(pieces + 1, np.int64)
        seen, spot = np.empty(pieces, np.int64), np.empty(pieces, np.int64)
        points = np.empty((corners, 2))
        call.level_cover_pieces(pointer, offsets, seen, spot, points)
        names = [said(call.level_cover_name(pointer, i)) for i in range(viewpoints)]
        columns: dict[str, NDArray[Any]] = {"name": np.array(names, object)}
        columns.update((name, rows[:, i].copy()) for i, name in enumerate(_NUMBERS))
        columns["spare"], columns["sign"] = columns["spare"] != 0, columns["sign"] != 0
        unseen = None
        if has_path:
            parts = np.empty((call.level_unseen(pointer, None), 6))
            call.level_unseen(pointer, address(parts))
            unseen = tables.frame({name: parts[:, i].copy() for i, name in enumerate(_PARTS)},
                                  arrays=arrays)
        blind_spots = {name: spots[:, i].copy() for i, name in enumerate(_SPOTS)}
        shapes = np.split(points, offsets[1:-1]) if pieces else []
        return Coverage(areas, tables.frame(columns, arrays=arrays),
                        tables.frame(blind_spots, arrays=arrays), unseen, self, (seen, spot, shapes))
