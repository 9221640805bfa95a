"""Levels: cells, portals, visible sets, and questions to them."""
from __future__ import annotations

import ctypes
import os
import warnings
from dataclasses import dataclass, field
from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import drawing, tables
from ._library import (Floats, Handle, Integers, MapHandle, Vga, address, as_count, as_flag, as_number,
                       as_point, as_points, as_reals, call, existing, path_text, said, text)
from .errors import SightlineWarning
from .explorer import Explorer
from .lines import Axial
from .placement import Viewpoints
from .sets import Sets
from .ways import Ways

# Questions up to this number are answered at once; Ctrl-C waits for them.
FEW = 16
_NO_POINTS = np.empty((0, 2))


@dataclass(frozen=True)
class Measure:
    """A measure: a column of `isovists` or `vga`.

    Attributes
    ----------
    group
        What `vga(measures=...)` takes: "visual", "through", "metric", "angular", "isovist".
    unit
        "unit" stands for that of the map: "unit²". Empty for numbers and ratios.
    meaning
        In a few words.
    """
    name: str
    group: str
    unit: str
    meaning: str
    part: int = field(repr=False, default=0)
    estimated: bool = field(repr=False, default=False)


_MEASURES: list[Measure] = []


def measures_of(handle: Handle) -> list[Measure]:
    """The library's table, which is asked once."""
    if not _MEASURES:
        rows = [row.split("\t") for row in handle._names("measures")]
        _MEASURES[:] = [Measure(row[0], row[1], row[2], row[3], int(row[4]), row[5] == "1") for row in rows]
    return list(_MEASURES)


@dataclass(frozen=True)
class PortalSequence:
    """Portals in the order crossed, the cells behind them, and the ends that decide."""
    portals: list[int]
    cells: list[int]
    ends: Floats
    reason: str = ""


@dataclass(frozen=True)
class Explanation:
    """Why one cell does or does not see another.

    Attributes
    ----------
    seen
        Whether it does, directly and with the doors as they are.
    verdict
        "stabbed": a line passes between all portal ends. "grazing": lines touch ends. "hidden".
    distance
        Portals on the shortest way, seen or not; -1 where there is no way.
    sequence
        Where it is seen, the portals that the line crosses; else None.
    line
        Two points of the line, in its two cells; None where it is hidden.
    misses
        Where it is hidden, the sequences that came farthest, and why each fails.
    decides
        Effects without any one of which it would be seen: "door", "mirror", "oneway", "range".
    by_mirror
        Whether it is seen by mirror.
    """
    start: int
    end: int
    seen: bool
    verdict: str
    distance: int
    sequence: Optional[PortalSequence]
    line: Optional[Floats]
    misses: list[PortalSequence] = field(default_factory=list)
    decides: tuple[str, ...] = ()
    by_mirror: bool = False

    def __str__(self) -> str:
        if self.seen:
            portals = 0 if self.sequence is None else len(self.sequence.portals)
            return (f"cell {self.start} sees cell {self.end} through {portals} "
                    f"portal{'' if portals == 1 else 's'}")
        why = f"cell {self.start} does not see cell {self.end}"
        if self.decides:
            return f"{why}: hidden by {' or '.join(self.decides)}"
        if self.distance < 0:
            return f"{why}: no portals lead there"
        if self.misses and self.misses[0].reason:
            ends = ", ".join(f"({x:g}, {y:g})" for x, y in self.misses[0].ends)
            return f"{why}: {self.misses[0].reason}; the ends: {ends}"
        return why


class Level(Viewpoints, Sets, Ways, Axial, drawing.InNotebooks, MapHandle):
    """A baked plan: cells, the portals between them, and which cells see each other.

    `Plan.bake` makes one, and `Level.open` reads one. Several threads may use a level: they take
    turns, and calls with many points use all cores.

    Examples
    --------
    >>> import sightline
    >>> two_rooms = [(0, 0, 8, 0), (8, 0, 8, 4), (8, 4, 0, 4), (0, 4, 0, 0), (4, 0, 4, 3)]
    >>> level = sightline.Plan.from_segments(two_rooms).bake()
    >>> level.locate([(1, 1), (7, 1), (9, 9)]) >= 0
    array([ True,  True, False])
    >>> level.can_see((1, 1), [(7, 1), (3, 3.5)])
    array([False,  True])
    """

    _is_level = 1
    _mirror_depth = 1

    def __init__(self) -> None:
        super().__init__(call.level_new(), call.level_free)
        self.crs: Any = None

    @classmethod
    def open(cls, path: Union[str, "os.PathLike[str]"]) -> "Level":
        """Read a baked file (.slv)."""
        level = cls()
        level._ask(call.level_open, existing(path))
        return level

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Write a baked file (.slv), which games and the command line read."""
        self._need_sets()
        self._ask(call.level_write, path_text(path))

    def export(self, path: Union[str, "os.PathLike[str]"], format: Optional[str] = None) -> None:
        """Write for other programs: json, geojson, csv, c or png; by default what the ending says."""
        self._need_sets()
        if format is None:
            ending = os.path.splitext(os.fspath(path))[1][1:]
            format = {"h": "c"}.get(ending, ending)
        self._ask(call.level_export, path_text(path), text(format, "format"))

    def _need_sets(self) -> None:
        if not self.has_sets:
            raise ValueError("this level has no visible sets: use Plan.bake in place of Plan.space")

    # --- settings

    def _set_door(self, name: Optional[bytes], is_open: bool) -> None:
        self._ask(call.level_set_door, name, is_open)

    @property
    def range(self) -> float:
        """How far is seen; 0 for no limit. It can be set, up to the map's own."""
        with self._lock:
            return float(call.range(self._open_pointer(), 1))

    @range.setter
    def range(self, value: float) -> None:
        self._ask(call.level_set_range, as_number(value, "range", least=0))

    @property
    def mirror_depth(self) -> int:
        """How often mirrors reflect a sightline at most: 0 to 16, at first 1. It can be set."""
        return self._mirror_depth

    @mirror_depth.setter
    def mirror_depth(self, value: int) -> None:
        depth = as_count(value, "mirror_depth", 16)
        self._ask(call.level_set_mirror_depth, depth)
        self._mirror_depth = depth

    # --- what it holds

    def _counts(self) -> list[int]:
        counts = np.zeros(8, np.uint64)
        with self._lock:
            call.level_counts(self._open_pointer(), counts)
        return [int(count) for count in counts]

    def __len__(self) -> int:
        """The number of cells."""
        return self._counts()[0]

    @property
    def has_sets(self) -> bool:
        """Whether there are visible sets."""
        return bool(self._counts()[7])

    def _word(self, what: bytes) -> str:
        with self._lock:
            return said(call.level_word(self._open_pointer(), what))

    @property
    def method(self) -> str:
        """The method that the visible sets were found by."""
        return self._word(b"method")

    @property
    def sight(self) -> str:
        """"closed" or "open"."""
        return self._word(b"sight")

    @property
    def guarantee(self) -> str:
        """What the visible sets promise: "exact", "conservative", "aggressive", "rounded"."""
        return self._word(b"guarantee")

    def cell_arrays(self) -> dict[str, NDArray[Any]]:
        """The cells as arrays: corners (n, 2), offsets, inside, solid, area.

        The corners of cell c are corners[offsets[c]:offsets[c + 1]], counter-clockwise.
        """
        with self._lock:
            cells, corners = self._counts()[:2]
            found: dict[str, NDArray[Any]] = {
                "corners": np.empty((corners, 2)), "offsets": np.empty(cells + 1, np.int64),
                "inside": np.empty(cells, np.uint8), "solid": np.empty(cells, np.uint8),
                "area": np.empty(cells)}
            call.level_cells(self._open_pointer(), *found.values())
        found["inside"] = found["inside"].view(bool)
        found["solid"] = found["solid"].view(bool)
        return found

    @property
    def cells(self) -> Any:
        """The cells: inside, solid, area, and their polygons.

        A GeoDataFrame with geopandas, else a DataFrame with pandas, else a dict of arrays.
        """
        found = self.cell_arrays()
        corners = np.split(found["corners"], found["offsets"][1:-1])
        columns = {name: found[name] for name in ("inside", "solid", "area")}
        return tables.frame(columns, corners, "polygon", self.crs)

    @property
    def portals(self) -> Any:
        """The portals: the two cells, the ends, the door on it ("" for none), and its line.

        As `cells`. On the way from the first cell to the second, (x0, y0) is at the left.
        """
        with self._lock:
            count = self._counts()[2]
            cells, doors = np.empty((count, 2), np.int64), np.empty(count, np.int64)
            ends = np.empty((count, 4))
            call.level_portals(self._open_pointer(), cells, ends, doors)
            names = [self._name("door", door) if door >= 0 else "" for door in doors.tolist()]
        columns = {"a": cells[:, 0].copy(), "b": cells[:, 1].copy(),
                   "x0": ends[:, 0].copy(), "y0": ends[:, 1].copy(),
                   "x1": ends[:, 2].copy(), "y1": ends[:, 3].copy(), "door": np.array(names, object)}
        return tables.frame(columns, list(ends.reshape(-1, 2, 2)), "line", self.crs)

    def sets(self, mirrored: bool = False) -> tuple[Integers, Integers]:
        """The visible sets as (offsets, cells): what cell c sees is cells[offsets[c]:offsets[c+1]].

        Doors count as they are. `mirrored`: what is seen by mirror in place of directly.
        """
        mirrored = as_flag(mirrored, "mirrored")
        with self._lock:
            offsets = np.empty(self._counts()[0] + 1, np.int64)
            self._ask(call.level_sets, mirrored, offsets, None)
            columns = np.empty(int(offsets[-1]), np.int64)
            self._ask(call.level_sets, mirrored, offsets, address(columns))
        return offsets, columns

    @property
    def pvs(self) -> Any:
        """The visible sets, doors as they are: a sparse matrix of bool with scipy, else `sets()`."""
        return tables.sparse(*self.sets())

    @property
    def mirrored(self) -> Any:
        """What cells see by mirror, as `pvs`."""
        return tables.sparse(*self.sets(mirrored=True))

    # --- points and cells

    def locate(self, points: ArrayLike) -> Any:
        """The cells that hold points; -1 outside the map and for NaN.

        Parameters
        ----------
        points
            A point (x, y), which gives an int, or an array (..., 2), which gives an array.
        """
        places = as_points(points, "points", finite=False)
        cells = np.empty(places.shape[:-1], np.int64)
        self._ask(call.level_locate, places, cells.size, cells.reshape(-1))
        return int(cells) if cells.ndim == 0 else cells

    def can_see(self, a: ArrayLike, b: ArrayLike, *, threads: int = 0) -> Any:
        """Whether points see each other directly; for two numbers, whether a cell sees another.

        Exact. Arrays (..., 2) broadcast: shapes (n, 1, 2) and (m, 2) give an (n, m) matrix.

        Examples
        --------
        >>> import sightline
        >>> level = sightline.Plan.from_segments([(0, 0, 9, 0), (9, 0, 9, 9), (9, 9, 0, 9),
        ...                                       (0, 9, 0, 0)]).bake()
        >>> level.can_see((1, 1), (8, 8)), level.can_see(0, 0)
        (True, True)
        """
        if isinstance(a, (int, float, np.generic)) and isinstance(b, (int, float, np.generic)):
            return bool(self.cell_sees(a, b))
        eyes, places = np.broadcast_arrays(as_points(a, "a"), as_points(b, "b"))
        eyes, places = np.ascontiguousarray(eyes), np.ascontiguousarray(places)
        sees = np.zeros(eyes.shape[:-1], np.uint8)
        ask = self._ask_long if sees.size > FEW else self._ask
        ask(call.level_can_see, eyes, places, sees.size, as_count(threads, "threads", 1024),
            sees.reshape(-1))
        return bool(sees) if sees.ndim == 0 else sees.view(bool)

    def cell_sees(self, a: ArrayLike, b: ArrayLike) -> Any:
        """Whether cells see each other directly, doors as they are. Arrays broadcast.

        The range is that of the bake: a smaller one that is set later counts for eyes only.
        """
        first, second = np.broadcast_arrays(a, b)
        if first.size and (first.dtype.kind not in "iu" or second.dtype.kind not in "iu"):
            raise TypeError("cells are whole numbers")
        sees = np.zeros(first.shape, np.uint8)
        self._ask(call.level_cell_sees, np.ascontiguousarray(first, np.int64).reshape(-1),
                  np.ascontiguousarray(second, np.int64).reshape(-1), sees.size, sees.reshape(-1))
        return bool(sees) if sees.ndim == 0 else sees.view(bool)

    def look(self, eye: ArrayLike, heading: float = 0, fov: float = 360, *,
             method: Optional[str] = None, mirrored: bool = False, threads: int = 0) -> Any:
        """The cells that a view sees.

        Parameters
        ----------
        eye
            A point, which gives an array of cells; or points (n, 2), which give a matrix of bool
            with a row for each.
        heading, fov
            Degrees, counter-clockwise from +x; 360 wide is all round.
        method
            How (`sightline.eye_methods()`); by default the exact one.
        mirrored
            What is seen by mirror in place of directly.
        """
        eyes = as_points(eye, "eye")
        if eyes.ndim > 2:
            raise ValueError("eye must be a point or an array of shape (n, 2)")
        heading, fov = as_number(heading, "heading"), as_number(fov, "fov", least=0)
        mirrored = as_flag(mirrored, "mirrored")
        single, eyes = eyes.ndim == 1, eyes.reshape(-1, 2)
        cells = np.zeros((len(eyes), len(self)), np.uint8)
        ask = self._ask_long if len(eyes) > FEW else self._ask
        ask(call.level_look, eyes, len(eyes), heading, fov, text(method, "method"), mirrored,
            as_count(threads, "threads", 1024), cells.reshape(-1))
        return np.flatnonzero(cells[0]) if single else cells.view(bool)

    # --- regions

    def _isovists(self, eyes: Floats, heading: ArrayLike, fov: ArrayLike, threads: int, keep: bool,
                  tolerance: Optional[float]) -> tuple[Floats, list[tuple[int, int, Floats]]]:
        """Measures; and polygons as (eye, reflections, points)."""
        headings, fovs = (
            np.ascontiguousarray(np.broadcast_to(as_reals(value, what), (len(eyes),)))
            for value, what in ((heading, "heading"), (fov, "fov")))
        if not (np.isfinite(headings).all() and np.isfinite(fovs).all() and (fovs >= 0).all()):
            raise ValueError("heading and fov must be finite, and fov not below 0")
        if tolerance is not None:
            tolerance = as_number(tolerance, "tolerance", over=0)
        with self._lock:
            chord = tolerance or (self.range or 1) / 1000
            measures = np.empty((len(eyes), len(self._measures("isovist")) + 4))
            ask = self._ask_long if len(eyes) > FEW else self._ask
            ask(call.level_isovists, eyes, len(eyes), headings, fovs,
                as_count(threads, "threads", 1024), keep, chord, measures.reshape(-1))
            if not keep:
                return measures, []
            pointer = self._open_pointer()
            found = np.empty((3, call.level_polygons(pointer, None, None, None)), np.int64)
            call.level_polygons(pointer, *(address(row) for row in found))
            points = np.empty((int(found[2].sum()), 2))
            call.level_polygon_points(pointer, points)
        pieces = np.split(points, np.cumsum(found[2])[:-1]) if found.shape[1] else []
        return measures, list(zip(found[0].tolist(), found[1].tolist(), pieces))

    def region(self, eye: ArrayLike, heading: float = 0, fov: float = 360, *,
               mirrors: bool = False, tolerance: Optional[float] = None,
               as_array: bool = False) -> Any:
        """The visible region (isovist) of an eye.

        Parameters
        ----------
        eye
            A point (x, y).
        heading, fov
            Degrees, counter-clockwise from +x; 360 wide is all round.
        mirrors
            Return a list: the direct region, then what is seen in each mirror.
        tolerance
            How far chords may be from arcs where the view range ends; by default 1/1000 of it.
        as_array
            Corners (n, 2) in place of a shapely polygon, which is the default with shapely.

        Examples
        --------
        >>> import sightline
        >>> room = sightline.Plan.from_segments([(0, 0, 2, 0), (2, 0, 2, 1), (2, 1, 0, 1),
        ...                                      (0, 1, 0, 0)])
        >>> len(room.region((1, 0.5), as_array=True))
        4
        """
        eyes = as_point(eye, "eye")
        mirrors, as_array = as_flag(mirrors, "mirrors"), as_flag(as_array, "as_array")
        found = self._isovists(eyes.reshape(1, 2), heading, fov, 1, True, tolerance)[1]
        shapes = [points if as_array else tables.polygon(points) for _, _, points in found]
        return shapes if mirrors else shapes[0]

    def _measures(self, analysis: str) -> list[Measure]:
        """Those of isovists, or of visibility graphs, in the order of the columns of the library."""
        isovist = analysis == "isovist"
        return [each for each in measures_of(self) if (each.group == "isovist") == isovist]

    def isovists(self, points: ArrayLike, heading: ArrayLike = 0, fov: ArrayLike = 360, *,
                 range: Optional[float] = None, polygons: bool = False, tolerance: Optional[float] = None, threads: int = 0,
                 arrays: bool = False) -> Any:
        """Measures of the visible regions of many eyes, under the names of depthmapX.

        Parameters
        ----------
        points
            Eyes, of shape (n, 2).
        heading, fov
            Degrees, a number for all or one for each.
        range
            See no farther, in this question alone; by default the range of the level.
        polygons
            Add the regions as geometry (a GeoDataFrame), or as a column `polygon` of arrays.
        arrays
            A dict of arrays in place of a DataFrame, which is the default with pandas.

        Returns
        -------
        DataFrame
            x, y, the measures of the group "isovist" (`sightline.measures()`: area, perimeter
            and so on), corners; and mirrored_area and parts where the map has mirrors.

        Warns
        -----
        SightlineWarning
            Where regions end at the border of the map without a wall: what lies beyond is not known.
        """
        eyes = as_points(points, "points").reshape(-1, 2)
        polygons, arrays = as_flag(polygons, "polygons"), as_flag(arrays, "arrays")
        with self._lock:
            before = self.range
            self.range = before if range is None else range
            try:
                measures, found = self._isovists(eyes, heading, fov, threads, polygons, tolerance)
            finally:
                self.range = before
        cut = np.flatnonzero(measures[:, -1])
        if len(cut):
            x, y = eyes[cut[0]].tolist()
            warnings.warn(f"{len(cut)} of {len(eyes)} points see{'s' if len(cut) == 1 else ''} the border of the map where no "
                          f"wall is, the first from {x:.12g},{y:.12g}: regions end there. To see farther, add seams around all "
                          "that counts with add_seams", SightlineWarning, stacklevel=2)
        names = [measure.name for measure in self._measures("isovist")]
        names += ["corners", "mirrored_area", "parts"]
        columns: dict[str, NDArray[Any]] = {"x": eyes[:, 0].copy(), "y": eyes[:, 1].copy()}
        for i, name in enumerate(names):
            if name not in ("mirrored_area", "parts") or len(self.mirrors):
                columns[name] = measures[:, i].copy()
        shapes = [shape for _, depth, shape in found if depth == 0] if polygons else None
        return tables.frame(columns, shapes, "polygon", self.crs, arrays)

    # --- visibility graph analysis

    def _vga(self, step: float, seeds: Optional[ArrayLike], limit: float, parts: int, radius: int,
             metric_radius: float, angular_radius: float, threads: int,
             depth_from: Optional[ArrayLike], seen_from: bool, estimate: int = 0,
             seed: int = 1) -> tuple[Floats, Floats, Integers, Integers, Floats]:
        options = Vga(as_number(step, "the grid's step", over=0), as_number(limit, "range", least=0),
                      as_number(metric_radius, "metric_radius", least=0),
                      as_number(angular_radius, "angular_radius", least=0),
                      as_count(seed, "seed", 2**64 - 1), parts, as_count(radius, "radius", 2**32 - 1),
                      as_count(threads, "threads", 1024), as_flag(seen_from, "seen_from"), estimate)
        at = _NO_POINTS if seeds is None else as_points(seeds, "seeds").reshape(-1, 2)
        start = _NO_POINTS if depth_from is None else as_points(depth_from, "depth_from")
        start = start.reshape(-1, 2)
        with self._lock:
            self._ask_long(call.level_vga, ctypes.byref(options), at, len(at), start, len(start))
            pointer = self._open_pointer()
            count = call.level_vga_copy(pointer, None, None, None, None, None)
            points, depths = np.empty((count, 2)), np.empty(count, np.int64)
            components, intervals = np.ones(count, np.int64), np.empty((count, 2))
            measures = np.full((count, len(self._measures("vga"))), np.nan)
            call.level_vga_copy(pointer, address(points), address(measures), address(depths),
                                address(components), address(intervals))
        return points, measures, depths, components, intervals

    def grid(self, step: float, *, seeds: Optional[ArrayLike] = None) -> Floats:
        """The points of a grid that are inside, of shape (n, 2): multiples of `step`.

        `seeds`: only what these points lead to.
        """
        return self._vga(step, seeds, 0, 0, 0, 0, 0, 1, None, False)[0]

    def vga(self, grid: float, *, seeds: Optional[ArrayLike] = None,
            measures: Union[str, Sequence[str]] = ("visual",), range: Optional[float] = None,
            radius: int = 0, metric_radius: float = 0, angular_radius: float = 0,
            depth_from: Optional[ArrayLike] = None, seen_from: bool = False, estimate: int = 0,
            seed: int = 1, threads: int = 0, geometry: bool = False, arrays: bool = False) -> Any:
        """Visibility graph analysis of a grid of points, under the names of depthmapX.

        Which points see each other is exact. Doors count as they are. With one-way glass, values
        are of what a point sees. Maps with mirrors are refused. Metric and angular paths turn only
        at points beside walls, and add up in single precision, as those of depthmapX. NaN: not
        defined. Where no sightline joins all of the grid, the column `part` numbers its parts from
        the largest, 1, on.

        Parameters
        ----------
        grid
            The distance between neighbouring points.
        seeds
            Fill the grid from these points; by default all that is inside.
        measures
            Groups: "visual", "through", "metric", "angular", "isovist".
        range
            Nothing farther is seen; by default the level's range.
        radius, metric_radius, angular_radius
            Limits of steps, of lengths of paths, and of their turns in right angles; 0 for none.
        depth_from
            Add the column visual_step_depth: steps from these points.
        seen_from
            With one-way glass: values of who sees a point, in place of what it sees.
        estimate
            Of "visual": estimate mean depth and integration by searches from this number of points
            in each part of the graph, drawn by `seed`; 0 for exact values. The columns
            visual_mean_depth_least and visual_mean_depth_most are the ends between which the exact
            depth of a point lies with a probability of 99 %.
        geometry
            Add the square of each point: a GeoDataFrame.
        arrays
            A dict of arrays in place of a DataFrame.
        """
        chosen = (measures,) if isinstance(measures, str) else tuple(measures)
        of_graph = self._measures("vga")
        groups = [*dict.fromkeys(measure.group for measure in of_graph), "isovist"]
        geometry, arrays = as_flag(geometry, "geometry"), as_flag(arrays, "arrays")
        for part in chosen:
            if not isinstance(part, str) or part not in groups:
                raise ValueError(f"there is no group {part!r}; groups: {', '.join(groups)}")
        if as_count(estimate, "estimate", 2**26) and ({*chosen} - {"isovist"} != {"visual"} or radius or seen_from):
            raise ValueError('estimate is for measures="visual" alone or with "isovist", without radius '
                             "and seen_from: leave estimate out for exact values")
        bits = sum({measure.part for measure in of_graph if measure.group in chosen})
        limit = self.range if range is None else range
        points, found, depths, parts, ends = self._vga(
            grid, seeds, limit, bits, radius, metric_radius, angular_radius, threads, depth_from,
            seen_from, estimate, seed)
        columns: dict[str, NDArray[Any]] = {"x": points[:, 0].copy(), "y": points[:, 1].copy()}
        for i, measure in enumerate(of_graph):
            if measure.group in chosen and (measure.estimated or not estimate):
                columns[measure.name] = found[:, i].copy()
        if estimate:
            columns["visual_mean_depth_least"], columns["visual_mean_depth_most"] = ends.T.copy()
        if depth_from is not None:
            columns["visual_step_depth"] = depths
        if "isovist" in chosen:
            more = self.isovists(points, threads=threads, arrays=True)
            columns.update({name: more[name] for name in more if name not in ("x", "y")})
        if (parts > 1).any():
            columns["part"] = parts
        half = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]) * grid
        squares = list(points[:, None, :] + half) if geometry else None
        return tables.frame(columns, squares, "polygon", self.crs, arrays, {"grid": grid})

    # --- why

    def explain(self, a: Union[int, ArrayLike], b: Union[int, ArrayLike], *,
                misses: int = 3) -> Explanation:
        """Explain why cell `a` does or does not see cell `b`. Points stand for their cells.

        Doors count as they are, and the range is that of the map.

        Examples
        --------
        >>> import sightline
        >>> level = sightline.Plan.from_segments([(0, 0, 8, 0), (8, 0, 8, 4), (8, 4, 0, 4),
        ...                                       (0, 4, 0, 0), (4, 0, 4, 3)]).bake()
        >>> print(level.explain((1, 1), (7, 3.5)))
        cell 0 sees cell 1 through 1 portal
        """
        cells = [self._cell(a, "a"), self._cell(b, "b")]
        numbers, lines = np.zeros(8, np.int64), np.zeros(8)
        with self._lock:
            self._ask_long(call.level_explain, cells[0], cells[1], as_count(misses, "misses", 1000),
                           numbers, lines)
            seen, verdict, distance, _, decides, count, by_mirror, _ = numbers.tolist()
            way = self._sequence(-1) if verdict else None
            failed = [self._sequence(i) for i in range(count)]
        effects = tuple(name for i, name in enumerate(("door", "mirror", "oneway", "range"))
                        if decides >> i & 1)
        return Explanation(cells[0], cells[1], bool(seen), ("hidden", "grazing", "stabbed")[verdict],
                           distance, way, lines[4:].reshape(2, 2).copy() if verdict else None,
                           failed, effects, bool(by_mirror))

    def _cell(self, value: Any, what: str) -> int:
        if isinstance(value, (int, float, np.generic)):
            return as_count(value, f"{what}, the number of a cell,", len(self) - 1)
        cell = self.locate(as_point(value, what))
        if cell < 0:
            raise ValueError(f"{what} is outside the map")
        return int(cell)

    def _sequence(self, which: int) -> PortalSequence:
        pointer, ends = self._open_pointer(), ctypes.c_size_t()
        count = call.level_sequence(pointer, which, None, None, None, ctypes.byref(ends))
        portals, cells = np.empty(count, np.int64), np.empty(count, np.int64)
        places = np.empty((ends.value, 2))
        call.level_sequence(pointer, which, address(portals), address(cells), address(places),
                            ctypes.byref(ends))
        return PortalSequence(portals.tolist(), cells.tolist(), places,
                         said(call.level_reason(pointer, which)))

    # --- pictures

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draw with matplotlib; returns the axes. `cells=True`, `portals=True` add these."""
        return drawing.plot(self, ax, **style)

    def explorer(self, eye: Optional[ArrayLike] = None, *, width: int = 640,
                 package: Union[str, "os.PathLike[str]", None] = None) -> Explorer:
        """A page to look around in: what the pointer sees, doors that open by a click.

        A notebook shows it; `save(path)` writes it as one file of HTML. It needs neither a kernel nor
        a network. The level must be baked. A released wheel brings what the page needs.

        Parameters
        ----------
        eye
            Where to look from at first; by default the first start, else the middle of the map.
        width
            Of the picture, 64 to 8192 pixels.
        package
            The folder of the npm package; by default the one that is named by the variable
            SIGHTLINE_NPM, else that of the wheel.
        """
        return Explorer(self, eye, width, package)

    def __repr__(self) -> str:
        if self.closed:
            return "<Level: closed>"
        cells, _, portals = self._counts()[:3]
        how = f"{self.guarantee}, by {self.method}" if self.has_sets else "no visible sets"
        return (f"<Level: {cells} cell{'' if cells == 1 else 's'}, {portals} "
                f"portal{'' if portals == 1 else 's'}, {how}>")
