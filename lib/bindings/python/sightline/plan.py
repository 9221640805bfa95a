"""Plans: walls and what else a map holds, before cells are made of them."""
from __future__ import annotations

import ctypes
import math
import os
import warnings
from typing import Any, Iterable, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from . import drawing
from ._library import (Bake, Floats, Handle, Import, MapHandle, as_count, as_flag, as_number, as_point,
                       as_points, as_reals, as_segments, call, existing, names_text, path_text, said,
                       text, word)
from .errors import BadInput, SightlineWarning
from .level import Level
from .lines import Segments
from .placement import Coverage, Placement
from .ways import Path
from .world import World

EFFECTS = ("door", "mirror", "oneway", "range")

class Plan(Segments, drawing.InNotebooks, MapHandle):
    """A plan: walls, solid ground, doors, mirrors, one-way glass, starts and a view range.

    Lengths are in any unit, and y grows upwards.

    Examples
    --------
    >>> import sightline
    >>> room = [(0, 0, 8, 0), (8, 0, 8, 4), (8, 4, 0, 4), (0, 4, 0, 0), (4, 0, 4, 3)]
    >>> plan = sightline.Plan.from_segments(room)
    >>> plan
    <Plan: 5 walls>
    >>> plan.bake().can_see((1, 1), (7, 1))
    False
    """

    def __init__(self) -> None:
        super().__init__(call.plan_new(), call.plan_free)
        self.crs: Any = None
        self._space: Optional[Level] = None

    # --- making

    @classmethod
    def from_file(cls, path: Union[str, "os.PathLike[str]"], *, map: Optional[str] = None,
                  layers: Union[str, Sequence[str], None] = None,
                  start_names: Union[str, Sequence[str], None] = None,
                  unit: Optional[str] = None, slice: Optional[float] = None,
                  tolerance: float = 0, entrance: float = 0, threshold: float = 0,
                  doors: bool = False, sectors: bool = False, cells: bool = False,
                  planar: bool = False, degrees: bool = False, crop: Optional[ArrayLike] = None,
                  max_squares: int = 0, max_pixels: int = 0, max_walls: int = 0,
                  max_entities: int = 0, max_depth: int = 0) -> "Plan":
        """Read a map: map text, Tiled, LDtk, Universal VTT, Foundry, Doom, DXF, SVG, images, ROS.

        Parameters
        ----------
        path
            The file. Its ending and its first bytes say which format it has.
        map
            Which map of a file that holds several.
        layers
            The layers to take: a list, or a text with commas between.
        start_names
            Names of objects that are starts, likewise; "none" for no starts.
        unit
            The unit that coordinates are to have: mm, cm, m, km, in, ft or yd. "mm=m" reads a
            drawing that is in mm, whatever it says, in m.
        slice
            Height of the cut through a 3D model.
        tolerance
            How far a curve may be from its walls; 0 for the usual.
        entrance
            How wide openings to the outside are at most (`Plan.entrance`); 0: as the file says.
        threshold
            Darkness from which a pixel of an image is solid, 0 to 1; 0 for the usual.
        doors, sectors, cells
            Take doors as doors (Doom), make seams between sectors (Doom), take the file's cells.
        planar, degrees
            Take the coordinates of GeoJSON as plain units, or as longitude and latitude.
        crop
            Keep what lies in a box x0, y0, x1, y1, in the map's places.
        max_squares, max_pixels, max_walls, max_entities, max_depth
            Limits: a file that has more tiles, pixels, walls, entities or blocks within blocks is
            refused. They are the `--max-...` of the command line; 0 for the usual.

        Raises
        ------
        BadInput
            The file is broken, and the text names the line; it has more than a limit; or it is a
            table (.csv).
        OSError
            The file cannot be read.
        """
        plan = cls()
        box = None if crop is None else as_reals(crop, "crop")
        if box is not None and (box.shape != (4,) or not np.isfinite(box).all()
                                or not (box[:2] < box[2:]).all()):
            raise ValueError("crop must be x0, y0, x1, y1, with x0 < x1 and y0 < y1")
        options = Import(text(map, "map"), names_text(layers, "layers"),
                         names_text(start_names, "start_names"), text(unit, "unit"),
                         math.nan if slice is None else as_number(slice, "slice"),
                         as_number(tolerance, "tolerance", least=0),
                         as_number(entrance, "entrance", least=0),
                         as_number(threshold, "threshold", least=0),
                         as_count(max_squares, "max_squares", 2**64 - 1),
                         as_count(max_pixels, "max_pixels", 2**64 - 1),
                         as_count(max_walls, "max_walls", 2**64 - 1),
                         as_count(max_entities, "max_entities", 2**64 - 1),
                         as_count(max_depth, "max_depth", 1000), as_flag(doors, "doors"),
                         as_flag(sectors, "sectors"), as_flag(cells, "cells"),
                         as_flag(planar, "planar"), as_flag(degrees, "degrees"),
                         None if box is None else box.ctypes.data)
        source = existing(path)
        if os.fspath(path).lower().endswith(".csv"):
            raise BadInput(f"{os.fspath(path)}: a table is no map; its lines are taken by "
                           "Plan.from_segments(numpy.genfromtxt(path, delimiter=',', names=True)"
                           "[['x1', 'y1', 'x2', 'y2']].tolist())")
        plan._ask(call.plan_read, source, ctypes.byref(options))
        return plan

    @classmethod
    def from_text(cls, map_text: str, name: str = "text.map") -> "Plan":
        """Read a map from a text, by default a map text; `name` is for its ending and messages.

        Examples
        --------
        >>> import sightline
        >>> sightline.Plan.from_text("sightline 1\\nwalls 0 0 9 0 9 9 0 9 0 0\\n")
        <Plan: 4 walls>
        """
        plan = cls()
        coded = word(map_text, "map_text")
        plan._ask(call.plan_parse, word(name, "name"), coded, len(coded),
                  ctypes.byref(Import(slice=math.nan)))
        return plan

    @classmethod
    def from_segments(cls, segments: ArrayLike, *, starts: Optional[ArrayLike] = None) -> "Plan":
        """Make a plan of walls.

        Parameters
        ----------
        segments
            Rows x0, y0, x1, y1; shape (n, 4) or (n, 2, 2).
        starts
            Points from which inside is reached; shape (n, 2).
        """
        plan = cls()
        plan.add_walls(segments)
        if starts is not None:
            for x, y in as_points(starts, "starts").reshape(-1, 2):
                plan.add_start((x, y))
        return plan

    @classmethod
    def from_polygons(cls, polygons: Iterable[Any], *, solid: bool = True,
                      boundary: Optional[ArrayLike] = None) -> "Plan":
        """Make a plan of polygons: buildings or pillars, or the outlines of rooms.

        Parameters
        ----------
        polygons
            Shapely polygons, multipolygons, or arrays of corners of shape (n, 2).
        solid
            Whether they are solid ground. If not, their outlines are walls.
        boundary
            A box x0, y0, x1, y1 of walls around all, so that sight ends there.

        Examples
        --------
        >>> import sightline
        >>> pillar = [(4, 4), (5, 4), (5, 5), (4, 5)]
        >>> sightline.Plan.from_polygons([pillar], boundary=(0, 0, 9, 9)).can_see((1, 4.5), (8, 4.5))
        False
        """
        plan = cls()
        for polygon in polygons:
            plan.add_polygon(polygon, solid=solid)
        if boundary is not None:
            plan.add_box(boundary)
        return plan

    @classmethod
    def from_geodataframe(cls, frame: Any, *, kind: str = "kind", solid: bool = True,
                          boundary: Optional[ArrayLike] = None) -> "Plan":
        """Make a plan of a GeoDataFrame, by its geometry and, where there is one, a column of kinds.

        Parameters
        ----------
        frame
            A GeoDataFrame or GeoSeries. Lines are walls, polygons solid ground, points starts.
        kind
            The column that says otherwise: wall, solid, open, door, mirror, oneway, seam or start.
            Rows of other kinds are refused. Doors take the columns `name` and `open`.
        solid, boundary
            As for `from_polygons`.
        """
        plan = cls()
        plan.crs = getattr(frame, "crs", None)
        shapes = list(getattr(frame, "geometry", frame))
        columns = getattr(frame, "columns", ())

        def column(name: str) -> Sequence[Any]:
            return list(frame[name]) if name in columns else [None] * len(shapes)

        for shape, what, name, is_open in zip(shapes, column(kind), column("name"), column("open")):
            if shape is None:
                continue
            if not hasattr(shape, "geom_type"):
                raise TypeError(f"frame must have shapes, not {shape!r:.40}")
            if not shape.is_empty:
                plan._add_shape(shape, _text_of(what, kind), _text_of(name, "name") or "door",
                                _flag_of(is_open, "open"), as_flag(solid, "solid"))
        if boundary is not None:
            plan.add_box(boundary)
        return plan

    def _add_shape(self, shape: Any, what: Optional[str], name: str, is_open: bool,
                   solid: bool) -> None:
        if hasattr(shape, "geoms"):
            for part in shape.geoms:
                self._add_shape(part, what, name, is_open, solid)
        elif shape.geom_type == "Polygon":
            if what not in (None, "wall", "solid", "open"):
                raise ValueError(f"a polygon cannot be of the kind {what!r}")
            self.add_polygon(shape, solid=solid if what is None else what == "solid",
                             is_open=what == "open")
        elif shape.geom_type == "Point":
            if what not in (None, "start"):
                raise ValueError(f"a point cannot be of the kind {what!r}")
            self.add_start((shape.x, shape.y))
        else:
            points = np.asarray(shape.coords)[:, :2]
            self._add(what or "wall", np.hstack([points[:-1], points[1:]]), name, is_open)

    # --- adding

    def _add(self, kind: str, segments: ArrayLike, name: str = "", is_open: bool = True) -> None:
        rows = as_segments(segments, f"{kind}s")
        words = word(kind, "kind"), word(name, "name"), as_flag(is_open, "is_open")
        self._changed()
        self._ask(call.plan_add, *words, rows, len(rows))

    def _changed(self) -> None:
        self._space = None

    def add_walls(self, segments: ArrayLike) -> None:
        """Add walls, rows x0, y0, x1, y1."""
        self._add("wall", segments)

    def add_box(self, box: ArrayLike) -> None:
        """Add the four sides of a box x0, y0, x1, y1 as walls."""
        sides = as_reals(box, "a box")
        if sides.shape != (4,):
            raise ValueError(f"a box must be x0, y0, x1, y1, not of shape {sides.shape}")
        x0, y0, x1, y1 = sides.tolist()
        self.add_walls([(x0, y0, x1, y0), (x1, y0, x1, y1), (x1, y1, x0, y1), (x0, y1, x0, y0)])

    def add_polygon(self, polygon: Any, *, solid: bool = True, is_open: bool = False) -> None:
        """Add solid ground, or outlines as walls (`solid=False`), or open ground within solid."""
        solid, is_open = as_flag(solid, "solid"), as_flag(is_open, "is_open")
        if hasattr(polygon, "geoms"):
            for part in polygon.geoms:
                self.add_polygon(part, solid=solid, is_open=is_open)
            return
        if hasattr(polygon, "exterior"):
            rings = [(polygon.exterior.coords, True)]
            rings += [(ring.coords, False) for ring in polygon.interiors]
        else:
            rings = [(polygon, True)]
        for ring, outer in rings:
            corners = as_reals(np.asarray(ring), "a polygon")
            # Shapes may have heights.
            corners = as_points(corners[:, :2] if corners.shape[1:] == (3,) else corners, "a polygon")
            if corners.ndim == 2 and len(corners) > 1 and (corners[0] == corners[-1]).all():
                corners = np.ascontiguousarray(corners[:-1])
            if corners.ndim != 2 or len(corners) < 3:
                raise ValueError("a polygon needs three corners or more")
            self._changed()
            if solid or is_open:
                self._ask(call.plan_add_ground, outer != is_open, corners, len(corners))
            else:
                self.add_walls(np.hstack([corners, np.roll(corners, -1, axis=0)]))

    def add_door(self, name: str, segment: ArrayLike, *, is_open: bool = True) -> None:
        """Add a door: a segment that hides what is behind it while it is shut."""
        self._add("door", segment, name, is_open)

    def add_mirrors(self, segments: ArrayLike) -> None:
        """Add mirrors, which reflect on both sides."""
        self._add("mirror", segments)

    def add_oneways(self, segments: ArrayLike) -> None:
        """Add one-way glass, seen through from its right to its left, from first to second end."""
        self._add("oneway", segments)

    def add_seams(self, segments: ArrayLike) -> None:
        """Add seams: cells end at them, and sight does not."""
        self._add("seam", segments)

    def add_start(self, point: ArrayLike, heading: float = 0) -> None:
        """Add a viewpoint; the heading is in degrees, counter-clockwise from +x."""
        x, y = as_point(point, "a start")
        degrees = as_number(heading, "heading")
        self._changed()
        self._ask(call.plan_add_start, x, y, degrees)

    @property
    def range(self) -> float:
        """How far is seen; 0 for no limit. It can be set."""
        with self._lock:
            return float(call.range(self._open_pointer(), 0))

    @range.setter
    def range(self, value: float) -> None:
        limit = as_number(value, "range", least=0)
        self._changed()
        self._ask(call.plan_set_range, limit)

    @property
    def entrance(self) -> float:
        """How wide openings to the outside are at most. It can be set.

        It counts where there is no start: inside is then what a disc of that width cannot enter from
        outside. 0: 1.2 m if the unit is known, else a width found from the plan.

        Examples
        --------
        >>> import sightline
        >>> plan = sightline.Plan.from_segments([(5, 0, 10, 0), (10, 0, 10, 8), (10, 8, 0, 8),
        ...                                      (0, 8, 0, 0), (0, 0, 3, 0), (12, 0, 12, 8)])
        >>> plan.entrance = 2
        >>> cells = plan.space().cell_arrays()
        >>> float(cells["area"][cells["inside"]].sum())
        80.0
        """
        with self._lock:
            return float(call.plan_entrance(self._open_pointer()))

    @entrance.setter
    def entrance(self, value: float) -> None:
        width = as_number(value, "entrance", least=0)
        self._changed()
        self._ask(call.plan_set_entrance, width)

    def _set_door(self, name: Optional[bytes], is_open: bool) -> None:
        self._changed()
        self._ask(call.plan_set_door, name, is_open)

    # --- what is made of it

    def save(self, path: Union[str, "os.PathLike[str]"], format: Optional[str] = None) -> None:
        """Write the plan, in the format that the ending names: .map, .dxf, .svg, .tmx ..."""
        self._ask(call.plan_write, path_text(path), text(format, "format"))

    def bake(self, *, method: Optional[str] = None, sight: str = "closed",
             subdivide: Optional[str] = None, start: Optional[ArrayLike] = None,
             weld: Optional[float] = None, without: Sequence[str] = (), inside_only: bool = False,
             mirror_depth: int = 1, door_limit: int = 16, threads: int = 0) -> Level:
        """Cut the plan into cells, and find which cells see each other.

        Parameters
        ----------
        method
            How (`sightline.methods()`); by default the fastest exact one.
        sight
            "closed": lines that only touch walls count; "open": they do not.
        subdivide
            "kd", "mesh" or "given"; by default what the walls call for.
        start
            A point to add as a start: inside is what starts reach.
        weld
            Ends of walls up to this far apart become one; by default what rounding calls for.
        without
            Effects to leave out: "door", "mirror", "oneway", "range".
        inside_only
            Look from and at inside cells only.
        mirror_depth
            How often mirrors reflect a sightline at most, 0 to 16.
        door_limit
            Sets of doors kept of a pair of cells at most.
        threads
            0 for one per core. The result is the same for any number.

        Warns
        -----
        SightlineWarning
            It is doubtful what is inside.
        """
        return self._bake(method, sight, subdivide, start, weld, without, inside_only,
                          mirror_depth, door_limit, threads, True)

    def space(self, *, subdivide: Optional[str] = None, start: Optional[ArrayLike] = None,
              weld: Optional[float] = None, without: Sequence[str] = ()) -> Level:
        """The cells and portals alone, without visible sets: faster, and enough for regions.

        The parameters are those of `bake`.
        """
        return self._bake(None, "closed", subdivide, start, weld, without, False, 1, 16, 0, False)

    def edit(self, *, bounds: Optional[ArrayLike] = None, rows: str = "none",
             sight: str = "closed") -> World:
        """The walls as a `World`: they change, and answers follow without a bake.

        Parameters
        ----------
        bounds
            x0, y0, x1, y1: where walls may be. By default those of the plan, and an eighth of their
            size more on each side.
        rows
            Visible sets for `World.may_see`: "none"; "now", exact after each commit; or "later",
            which miss nothing after a commit, and are exact once `World.settle` says so.
        sight
            As of `bake`.
        """
        return World(self, bounds, rows, sight)

    def _bake(self, method: Optional[str], sight: str, subdivide: Optional[str],
              start: Optional[ArrayLike], weld: Optional[float], without: Sequence[str],
              inside_only: bool, mirror_depth: int, door_limit: int, threads: int,
              sets: bool) -> Level:
        if sight not in ("closed", "open"):
            raise ValueError(f"sight must be 'closed' or 'open', not {sight!r}")
        bits = 0
        for effect in (without,) if isinstance(without, str) else without:
            if effect not in EFFECTS:
                raise ValueError(f"there is no effect {effect!r}; effects: {', '.join(EFFECTS)}")
            bits |= 1 << EFFECTS.index(effect)
        x, y = math.nan, math.nan
        if start is not None:
            x, y = as_point(start, "start").tolist()
        options = Bake(text(method, "method"), text(subdivide, "subdivide"),
                       math.nan if weld is None else as_number(weld, "weld", least=0), x, y,
                       sight == "open", as_flag(inside_only, "inside_only"), sets,
                       as_count(threads, "threads", 1024), as_count(mirror_depth, "mirror_depth", 16),
                       as_count(door_limit, "door_limit", 2**32 - 1), bits)
        level = Level()
        level.crs = self.crs
        with self._lock:
            level._ask_long(call.level_bake, self._open_pointer(), ctypes.byref(options))
        doubt = said(call.level_inside(level._open_pointer()))
        if doubt:
            warnings.warn(doubt, SightlineWarning, stacklevel=3)
        return level

    def cancel(self) -> None:
        """Stops long work that another thread asks for, also of the questions below."""
        super().cancel()
        space = self._space
        if space is not None:
            space.cancel()

    def _own_space(self) -> Level:
        with self._lock:
            self._open_pointer()
            if self._space is None:
                self._space = self._bake(None, "closed", None, None, None, (), False, 1, 16, 0,
                                         False)
            return self._space

    # --- questions that need no visible sets

    def locate(self, points: ArrayLike) -> Any:
        """As `Level.locate`."""
        return self._own_space().locate(points)

    def can_see(self, a: ArrayLike, b: ArrayLike, *, threads: int = 0) -> Any:
        """As `Level.can_see`, for points."""
        return self._own_space().can_see(a, b, threads=threads)

    def region(self, eye: ArrayLike, **options: Any) -> Any:
        """As `Level.region`."""
        return self._own_space().region(eye, **options)

    def region_from(self, points: ArrayLike, **options: Any) -> Any:
        """As `Level.region_from`."""
        return self._own_space().region_from(points, **options)

    def exposure(self, path: ArrayLike, things: Any, **options: Any) -> Any:
        """As `Level.exposure`."""
        return self._own_space().exposure(path, things, **options)

    def path(self, start: ArrayLike, end: ArrayLike, **options: Any) -> Path:
        """As `Level.path`."""
        return self._own_space().path(start, end, **options)

    def distances(self, start: ArrayLike, **options: Any) -> Any:
        """As `Level.distances`."""
        return self._own_space().distances(start, **options)

    def distances_to(self, start: ArrayLike, places: ArrayLike, **options: Any) -> Any:
        """As `Level.distances_to`."""
        return self._own_space().distances_to(start, places, **options)

    def sees_within(self, start: ArrayLike, start_radius: float, end: ArrayLike, end_radius: float,
                    **options: Any) -> Any:
        """As `Level.sees_within`."""
        return self._own_space().sees_within(start, start_radius, end, end_radius, **options)

    def seen_from(self, points: ArrayLike, places: ArrayLike, **options: Any) -> Any:
        """As `Level.seen_from`."""
        return self._own_space().seen_from(points, places, **options)

    def isovists(self, points: ArrayLike, **options: Any) -> Any:
        """As `Level.isovists`."""
        return self._own_space().isovists(points, **options)

    def vga(self, grid: float, **options: Any) -> Any:
        """As `Level.vga`."""
        return self._own_space().vga(grid, **options)

    def grid(self, step: float, **options: Any) -> Floats:
        """As `Level.grid`."""
        return self._own_space().grid(step, **options)

    def axial(self, lines: str = "fewest", **options: Any) -> Any:
        """As `Level.axial`."""
        return self._own_space().axial(lines, **options)

    def cover(self, viewpoints: Any, **options: Any) -> Coverage:
        """As `Level.cover`."""
        return self._own_space().cover(viewpoints, **options)

    def place(self, **options: Any) -> Placement:
        """As `Level.place`."""
        return self._own_space().place(**options)

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draw walls, doors, mirrors, glass and starts with matplotlib; returns the axes."""
        return drawing.plot(self, ax, **style)

    def __repr__(self) -> str:
        if self.closed:
            return "<Plan: closed>"
        return f"<Plan: {drawing.describe(self)}>"


def _is_missing(value: Any) -> bool:
    """Whether it is one of the marks that tables have for no value."""
    return value is None or type(value).__name__ == "NAType" or bool(value != value)


def _text_of(value: Any, column: str) -> Optional[str]:
    """A text of a table; None for no value."""
    if isinstance(value, str) or _is_missing(value):
        return value if isinstance(value, str) and value else None
    raise ValueError(f"column {column!r} must hold texts, not {value!r:.40}")


def _flag_of(value: Any, column: str) -> bool:
    """A truth of a table, also as 0 or 1; True for no value."""
    if _is_missing(value):
        return True
    if isinstance(value, (bool, np.bool_, int, float, np.number)) and value in (0, 1):
        return bool(value)
    raise ValueError(f"column {column!r} must hold True and False, not {value!r:.40}")
