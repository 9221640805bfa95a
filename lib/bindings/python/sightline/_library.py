"""The shared library beside this file, by ctypes: signatures, handles, arrays.

A handle belongs to one thread at a time, so each has a lock. ctypes lets other threads of Python run
while the library works. Arrays of doubles in C order go to the library as they are. Results are
written into new arrays, and never point into the library's memory.
"""
from __future__ import annotations

import ctypes
import math
import numbers
import operator
import pathlib
import sys
import threading
import weakref
from collections.abc import Iterator, Mapping, MutableMapping
from types import MappingProxyType
from typing import Any, Callable, Iterable, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import BY_STATUS, Closed, SightlineError

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_int, _uint32, _uint64 = ctypes.c_int, ctypes.c_uint32, ctypes.c_uint64
_size, _double = ctypes.c_size_t, ctypes.c_double
_text, _handle = ctypes.c_char_p, ctypes.c_void_p
_doubles = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
_integers = np.ctypeslib.ndpointer(np.int64, flags="C_CONTIGUOUS")
_bytes = np.ctypeslib.ndpointer(np.uint8, flags="C_CONTIGUOUS")
_counts = np.ctypeslib.ndpointer(np.uint64, flags="C_CONTIGUOUS")
# May be None: the address of an array.
_any = ctypes.c_void_p


class Import(ctypes.Structure):
    """As slp_import of facade.h."""
    _fields_ = [("map", _text), ("layers", _text), ("start_names", _text), ("unit", _text),
                ("slice", _double), ("tolerance", _double), ("entrance", _double),
                ("threshold", _double), ("max_squares", _uint64), ("max_pixels", _uint64),
                ("max_walls", _uint64), ("max_entities", _uint64), ("max_depth", _uint64),
                ("doors", _int), ("sectors", _int), ("cells", _int), ("planar", _int),
                ("degrees", _int), ("crop", _any)]


class Bake(ctypes.Structure):
    """As slp_bake of facade.h."""
    _fields_ = [("method", _text), ("subdivision", _text), ("weld", _double),
                ("start_x", _double), ("start_y", _double), ("open_sight", _int),
                ("inside_only", _int), ("sets", _int), ("threads", _uint32),
                ("mirror_depth", _uint32), ("door_limit", _uint32), ("without", _uint32)]


class Vga(ctypes.Structure):
    """As slp_vga of facade.h."""
    _fields_ = [("step", _double), ("range", _double), ("metric_radius", _double),
                ("angular_radius", _double), ("seed", _uint64), ("parts", _uint32),
                ("radius", _uint32), ("threads", _uint32), ("turned", _uint32), ("roots", _uint32)]


class Place(ctypes.Structure):
    """As slp_place of facade.h."""
    _fields_ = [("from", _text), ("places", _any), ("count", _size), ("step", _double),
                ("time_limit", _double)]


# Name: result, arguments.
_SIGNATURES: dict[str, tuple[Any, list[Any]]] = {
    "version": (_text, []),
    "message": (_text, [_handle]),
    "notes": (_text, [_handle]),
    "cancel": (None, [_handle, _int]),
    "names": (_size, [_handle, _text, _any, _size]),
    "plan_new": (_handle, []),
    "plan_free": (None, [_handle]),
    "plan_read": (_int, [_handle, _text, ctypes.POINTER(Import)]),
    "plan_parse": (_int, [_handle, _text, _text, _size, ctypes.POINTER(Import)]),
    "plan_write": (_int, [_handle, _text, _text]),
    "plan_add": (_int, [_handle, _text, _text, _int, _doubles, _size]),
    "plan_add_ground": (_int, [_handle, _int, _doubles, _size]),
    "plan_add_start": (_int, [_handle, _double, _double, _double]),
    "plan_set_range": (_int, [_handle, _double]),
    "plan_entrance": (_double, [_handle]),
    "plan_set_entrance": (_int, [_handle, _double]),
    "plan_set_door": (_int, [_handle, _text, _int]),
    "segments": (_size, [_handle, _int, _text, _any]),
    "name": (_text, [_handle, _int, _text, _size]),
    "door_open": (_int, [_handle, _int, _size]),
    "range": (_double, [_handle, _int]),
    "unit": (_text, [_handle, _int]),
    "bounds": (None, [_handle, _int, _doubles]),
    "transform": (None, [_handle, _int, _doubles]),
    "level_new": (_handle, []),
    "level_free": (None, [_handle]),
    "level_bake": (_int, [_handle, _handle, ctypes.POINTER(Bake)]),
    "level_open": (_int, [_handle, _text]),
    "level_write": (_int, [_handle, _text]),
    "level_export": (_int, [_handle, _text, _text]),
    "level_inside": (_text, [_handle]),
    "level_word": (_text, [_handle, _text]),
    "level_counts": (None, [_handle, _counts]),
    "level_cells": (None, [_handle, _doubles, _integers, _bytes, _bytes, _doubles]),
    "level_portals": (None, [_handle, _integers, _doubles, _integers]),
    "level_sets": (_int, [_handle, _int, _integers, _any]),
    "level_set_door": (_int, [_handle, _text, _int]),
    "level_set_range": (_int, [_handle, _double]),
    "level_set_mirror_depth": (_int, [_handle, _uint32]),
    "level_locate": (_int, [_handle, _doubles, _size, _integers]),
    "level_can_see": (_int, [_handle, _doubles, _doubles, _size, _uint32, _bytes]),
    "level_cell_sees": (_int, [_handle, _integers, _integers, _size, _bytes]),
    "level_look": (_int, [_handle, _doubles, _size, _double, _double, _text, _int, _uint32,
                          _bytes]),
    "level_isovists": (_int, [_handle, _doubles, _size, _doubles, _doubles, _uint32, _int, _double,
                              _doubles]),
    "level_polygons": (_size, [_handle, _any, _any, _any]),
    "level_polygon_points": (None, [_handle, _doubles]),
    "level_set_region": (_int, [_handle, _doubles, _size, _int, _double, _int, _doubles]),
    "level_set_sees": (_int, [_handle, _doubles, _size, _int, _double, _int, _doubles, _size, _bytes]),
    "level_exposure": (_int, [_handle, _doubles, _size, _doubles, _integers, _size, _int, _doubles]),
    "level_sees_within": (_int, [_handle, _doubles, _double, _doubles, _double, _size, _int, _bytes]),
    "level_path": (_int, [_handle, _doubles, _doubles, _double, _double, _doubles]),
    "level_path_points": (_size, [_handle, _any]),
    "level_distances": (_int, [_handle, _doubles, _double, _double, _doubles, _doubles]),
    "level_distances_to": (_int, [_handle, _doubles, _double, _double, _doubles, _size, _doubles, _doubles]),
    "level_vga": (_int, [_handle, ctypes.POINTER(Vga), _doubles, _size, _doubles, _size]),
    "level_vga_copy": (_size, [_handle, _any, _any, _any, _any, _any]),
    "level_axial": (_int, [_handle, _int, _uint32, _uint32]),
    "plan_segments": (_int, [_handle, _double, _double, _any, _doubles, _size, _uint32]),
    "lines_copy": (_size, [_handle, _any, _any]),
    "level_explain": (_int, [_handle, ctypes.c_int64, ctypes.c_int64, _uint32, _integers,
                             _doubles]),
    "level_sequence": (_size, [_handle, _int, _any, _any, _any, ctypes.POINTER(_size)]),
    "level_reason": (_text, [_handle, _int]),
    "level_cover": (_int, [_handle, _text, _text, _size, _double, _double, _int]),
    "level_cover_path": (_int, [_handle, _doubles, _size]),
    "level_unseen": (_size, [_handle, _any]),
    "level_place": (_int, [_handle, ctypes.POINTER(Place)]),
    "level_placed": (None, [_handle, _integers, _doubles, _any]),
    "level_place_proof": (_text, [_handle]),
    "level_cover_counts": (None, [_handle, _integers]),
    "level_cover_name": (_text, [_handle, _size]),
    "level_cover_copy": (None, [_handle, _doubles, _doubles, _doubles]),
    "level_cover_pieces": (None, [_handle, _integers, _integers, _integers, _doubles]),
    "explored_new": (_handle, []),
    "explored_free": (None, [_handle]),
    "explored_begin": (_int, [_handle, _double]),
    "explored_read": (_int, [_handle, _text, _text, _size]),
    "explored_add": (_int, [_handle, _doubles, _integers, _size]),
    "explored_counts": (_int, [_handle, _integers]),
    "explored_copy": (_int, [_handle, _integers, _doubles]),
    "explored_holds": (_int, [_handle, _doubles, _size, _bytes]),
    "explored_write": (_int, [_handle, _integers]),
    "explored_text": (None, [_handle, _any]),
    "world_new": (_handle, []),
    "world_free": (None, [_handle]),
    "world_begin": (_int, [_handle, _handle, _any, _int, _int]),
    "world_add": (_int, [_handle, _text, _text, _int, _int, _int, _doubles, _size, _integers]),
    "world_add_solid": (_int, [_handle, _doubles, _size, _integers]),
    "world_remove": (_int, [_handle, _integers, _size]),
    "world_move": (_int, [_handle, ctypes.c_int64, _doubles]),
    "world_set_open": (_int, [_handle, ctypes.c_int64, _int]),
    "world_commit": (_int, [_handle]),
    "world_discard": (None, [_handle]),
    "world_settle": (_int, [_handle, _double, _integers]),
    "world_plan": (_int, [_handle, _handle]),
    "world_can_see": (_int, [_handle, _doubles, _doubles, _size, _bytes]),
    "world_may_see": (_int, [_handle, _doubles, _doubles, _size, _bytes]),
    "world_region": (_int, [_handle, _doubles, _double, _double, _double, _integers]),
    "world_region_points": (None, [_handle, _double, _doubles, _size]),
}


def _load() -> Any:
    path = pathlib.Path(__file__).with_name("libsightline_python.so")
    try:
        library = ctypes.CDLL(str(path))
    except OSError as fault:
        raise ImportError(
            f"the library of this package cannot be loaded: {fault}; build it with "
            "'cmake --build --preset release --target sightline_python', and set PYTHONPATH to "
            "build/release/lib/bindings/python") from fault
    functions = type("Functions", (), {})()
    for name, (result, arguments) in _SIGNATURES.items():
        function = getattr(library, "slp_" + name)
        function.restype = result
        function.argtypes = arguments
        setattr(functions, name, function)
    return functions


call = _load()


def text(value: Optional[str], what: str = "text") -> Optional[bytes]:
    """A text for the library; None stays None."""
    if value is None:
        return None
    if not isinstance(value, str):
        raise TypeError(f"{what} must be a str, not {type(value).__name__}")
    coded = value.encode("utf-8", "surrogateescape")
    if b"\0" in coded:
        raise ValueError(f"{what} has a 0 in it")
    return coded


def word(value: str, what: str) -> bytes:
    """A text that must be there, for the library."""
    coded = text(value, what)
    if coded is None:
        raise TypeError(f"{what} must be a str, not None")
    return coded


def names_text(value: Union[str, Iterable[str], None], what: str) -> Optional[bytes]:
    """Names, one text with commas between or several, for the library; None stays None."""
    if value is None or isinstance(value, str):
        return text(value, what)
    names = list(value)
    for name in names:
        text(name, what)
        if "," in name:
            raise ValueError(f"{what}: a name has no comma")
    return text(",".join(names), what)


def path_text(path: Any) -> bytes:
    """A path as the library takes it."""
    import os
    coded = os.fsencode(path)
    if b"\0" in coded:
        raise ValueError("the path has a 0 in it")
    return coded


def existing(path: Any) -> bytes:
    """The same for a file to read. The system's own exception says why there is none."""
    import os
    coded = path_text(path)
    os.stat(path)
    return coded


def said(value: Optional[bytes]) -> str:
    """A text of the library."""
    return (value or b"").decode("utf-8", "surrogateescape")


def address(array: NDArray[Any]) -> int:
    """Where an array lies, for arguments that may be None."""
    return int(array.ctypes.data)


# --- arguments: one conversion for each kind, used by all calls


def as_flag(value: Any, what: str) -> bool:
    """True or False; nothing else stands for one of them."""
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise TypeError(f"{what} must be True or False, not {value!r:.40}")


def as_number(value: Any, what: str, *, least: float = -math.inf, over: float = -math.inf) -> float:
    """A finite number that is `least` or more, and more than `over`."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (numbers.Real, np.number)):
        raise TypeError(f"{what} must be a number, not {value!r:.40}")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if math.isfinite(number) and number >= least and number > over:
        return number
    limit = f" over {over:g}" if over > -math.inf else f", {least:g} or more," if least > -math.inf else ""
    raise ValueError(f"{what} must be a number{limit} and finite")


def as_count(value: Any, what: str, most: int) -> int:
    """A whole number that the library takes."""
    if isinstance(value, (bool, np.bool_)) or not hasattr(type(value), "__index__"):
        raise TypeError(f"{what} must be a whole number, not {value!r:.40}")
    number = operator.index(value)
    if not 0 <= number <= most:
        raise ValueError(f"{what} must be a whole number from 0 to {most}")
    return number


def as_reals(value: ArrayLike, what: str) -> Floats:
    """An array of doubles in C order."""
    try:
        given = np.asarray(value)
    except ValueError as fault:
        raise ValueError(f"{what} must be an array: {fault}") from fault
    if isinstance(value, np.ma.MaskedArray) and np.any(value.mask):
        raise ValueError(f"{what} has values that are masked")
    if given.dtype.kind not in "fiu" and given.size:
        raise TypeError(f"{what} must hold real numbers, not {given.dtype}")
    return np.ascontiguousarray(given, dtype=np.float64).reshape(given.shape)


def as_point(value: ArrayLike, what: str) -> Floats:
    """A point of finite coordinates, as an array (2,)."""
    point = as_points(value, what)
    if point.ndim != 1:
        raise ValueError(f"{what} must be one point (x, y), not an array of shape {point.shape}")
    return point


def as_points(value: ArrayLike, what: str, finite: bool = True) -> Floats:
    """An array (..., 2) of doubles in C order. Shapely points and series of them are taken too."""
    xy = getattr(value, "x", None), getattr(value, "y", None)
    if xy[0] is not None and xy[1] is not None:
        value = np.stack([np.asarray(xy[0], dtype=np.float64),
                          np.asarray(xy[1], dtype=np.float64)], axis=-1)
    points = given = as_reals(value, what)
    if points.size == 0 and points.ndim <= 1:
        points = points.reshape(0, 2)
    if points.ndim < 1 or points.shape[-1] != 2:
        raise ValueError(f"{what} must be a point (x, y) or an array of shape (n, 2), "
                         f"not of shape {given.shape}")
    if finite and not np.isfinite(points).all():
        raise ValueError(f"{what} must be finite")
    return points


def as_segments(value: ArrayLike, what: str) -> Floats:
    """An array (n, 4) of doubles: x0, y0, x1, y1. Shapes (n, 2, 2) and (4,) are taken too."""
    segments = given = as_reals(value, what)
    if segments.ndim == 3 and segments.shape[1:] == (2, 2):
        segments = segments.reshape(-1, 4)
    if segments.shape == (4,) or segments.shape == (2, 2):
        segments = segments.reshape(1, 4)
    if segments.size == 0:
        segments = segments.reshape(0, 4)
    if segments.ndim != 2 or segments.shape[1] != 4:
        raise ValueError(f"{what} must be of shape (n, 4) or (n, 2, 2), not {given.shape}")
    if not np.isfinite(segments).all():
        raise ValueError(f"{what} must be finite")
    return segments


class Doors(MutableMapping[str, bool]):
    """The doors of a plan or a level: whether each is open. `doors["front"] = False` shuts one."""

    def __init__(self, of: "MapHandle") -> None:
        self._of = of

    def __getitem__(self, name: str) -> bool:
        with self._of._lock:
            number = self._of._door_numbers()[name]
            return bool(call.door_open(self._of._open_pointer(), self._of._is_level, number))

    def __setitem__(self, name: str, is_open: bool) -> None:
        self._of._set_door(word(name, "the name of a door"), as_flag(is_open, f"door {name!r}"))

    def __delitem__(self, name: str) -> None:
        raise TypeError("doors cannot be removed")

    def __iter__(self) -> Iterator[str]:
        return iter(self._of._door_numbers())

    def __len__(self) -> int:
        return len(self._of._door_numbers())

    def __repr__(self) -> str:
        return repr(dict(self))


def _fixed(array: NDArray[Any]) -> NDArray[Any]:
    """Read-only: writing into a copy of what the library holds would change nothing there."""
    array.flags.writeable = False
    return array


class Handle:
    """A plan, level, world or explored area of the library, with a lock. It can be closed, also by `with`."""

    _is_level = 0
    _pointer: Optional[int]

    def __init__(self, pointer: Optional[int], free: Callable[[int], None]) -> None:
        if not pointer:
            raise MemoryError("no memory for a plan, level or world")
        self._pointer = pointer
        self._lock = threading.RLock()
        self._long, self._long_lock = False, threading.Lock()
        self._finalizer = weakref.finalize(self, free, pointer)

    def close(self) -> None:
        """Frees the memory. Calls after it raise `Closed`."""
        with self._lock:
            self._pointer = None
            self._finalizer()

    def __reduce_ex__(self, protocol: Any) -> Any:
        """Refuses copy, deepcopy and pickle: two objects would hold one piece of memory."""
        kind = type(self).__name__.lower()
        raise TypeError(f"a {kind} cannot be copied or pickled: save it to a file, and read that")

    @property
    def closed(self) -> bool:
        """Whether it was closed."""
        return self._pointer is None

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *unused: object) -> None:
        self.close()

    def _open_pointer(self) -> int:
        if self._pointer is None:
            raise Closed(f"this {type(self).__name__.lower()} was closed")
        return self._pointer

    def _check(self, status: int) -> None:
        if status == 0:
            return
        kind = BY_STATUS[status - 1] if status <= len(BY_STATUS) else SightlineError
        raise kind(said(call.message(self._pointer)) or "the library gave no reason")

    def _ask(self, function: Any, *arguments: Any) -> None:
        """A call that can fail."""
        with self._lock:
            self._check(function(self._open_pointer(), *arguments))

    def _ask_long(self, function: Any, *arguments: Any) -> None:
        """The same for long work, which `cancel` stops. So does Ctrl-C, as it runs beside the main thread."""
        with self._lock:
            pointer = self._open_pointer()
            with self._long_lock:
                self._long = True
            try:
                self._work(pointer, function, arguments)
            finally:
                with self._long_lock:
                    self._long = False
                    call.cancel(pointer, 0)

    def _work(self, pointer: int, function: Any, arguments: tuple[Any, ...]) -> None:
        if threading.current_thread() is not threading.main_thread():
            self._check(function(pointer, *arguments))
            return
        done, status = threading.Event(), [0]

        def work() -> None:
            try:
                status[0] = function(pointer, *arguments)
            finally:
                done.set()

        worker = threading.Thread(target=work, daemon=True)
        worker.start()
        try:
            done.wait()
        except BaseException:
            call.cancel(pointer, 1)
            worker.join()
            raise
        worker.join()
        self._check(status[0])

    def cancel(self) -> None:
        """Stops long work that another thread asks for: its call raises `Cancelled`."""
        with self._long_lock:
            if self._long: # then it is not closed
                call.cancel(self._open_pointer(), 1)

    def _names(self, what: str) -> list[str]:
        with self._lock:
            pointer = self._open_pointer()
            room = call.names(pointer, what.encode(), None, 0) + 1
            buffer = ctypes.create_string_buffer(room)
            call.names(pointer, what.encode(), ctypes.cast(buffer, ctypes.c_void_p), room)
        return said(buffer.value).splitlines()


class MapHandle(Handle):
    """A plan or level. Both hold a map."""

    def _segments(self, kind: str) -> Floats:
        with self._lock:
            pointer = self._open_pointer()
            rows = np.empty((call.segments(pointer, self._is_level, kind.encode(), None), 4))
            call.segments(pointer, self._is_level, kind.encode(), address(rows))
        return _fixed(rows)

    def _name(self, kind: str, number: int) -> str:
        return said(call.name(self._open_pointer(), self._is_level, kind.encode(), number))

    def _door_numbers(self) -> dict[str, int]:
        with self._lock:
            count = call.segments(self._open_pointer(), self._is_level, b"door", None)
            return {self._name("door", i): i for i in range(count)}

    def _set_door(self, name: Optional[bytes], is_open: bool) -> None:
        raise NotImplementedError

    # --- what both hold. Arrays are copies, which cannot be written.

    @property
    def doors(self) -> Doors:
        """The doors, as a mapping from names to whether they are open. It can be changed."""
        return Doors(self)

    @property
    def walls(self) -> Floats:
        """The walls, as rows x0, y0, x1, y1. Those of a level are clean."""
        return self._segments("wall")

    @property
    def mirrors(self) -> Floats:
        """The mirrors, as rows x0, y0, x1, y1."""
        return self._segments("mirror")

    @property
    def oneways(self) -> Floats:
        """One-way glass, seen through from its right to its left: rows x0, y0, x1, y1."""
        return self._segments("oneway")

    @property
    def seams(self) -> Floats:
        """The seams, as rows x0, y0, x1, y1. Walls that stop only sight, steps or sound are none."""
        return self._segments("seam")

    @property
    def starts(self) -> Floats:
        """The viewpoints of the map, as rows x, y, heading in degrees."""
        return _fixed(self._segments("start")[:, :3].copy())

    @property
    def objects(self) -> Mapping[str, Floats]:
        """The boxes of the map by name: x0, y0, x1, y1."""
        with self._lock:
            rows = self._segments("object")
            return MappingProxyType({self._name("object", i): rows[i] for i in range(len(rows))})

    @property
    def door_segments(self) -> Mapping[str, Floats]:
        """The doors by name, each as rows x0, y0, x1, y1."""
        with self._lock:
            rows = self._segments("door")
            names = [self._name("door", i) for i in range(len(rows))]
        return MappingProxyType({
            name: _fixed(rows[[i for i, other in enumerate(names) if other == name]])
            for name in dict.fromkeys(names)})

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """x0, y0, x1, y1."""
        box = np.empty(4)
        with self._lock:
            call.bounds(self._open_pointer(), self._is_level, box)
        x0, y0, x1, y1 = box.tolist()
        return x0, y0, x1, y1

    @property
    def transform(self) -> Any:
        """The `Transform` to the coordinates of the map's own file, such as pixels with y down.

        None where nobody knows it: plans made of arrays, and baked files before 2.0.
        """
        from .transform import Transform
        values = np.empty(4)
        with self._lock:
            call.transform(self._open_pointer(), self._is_level, values)
        x, y, scale, y_down = values.tolist()
        return Transform((x, y), scale, bool(y_down)) if scale else None

    @property
    def unit(self) -> str:
        """The unit that the file names: "m", "px" ...; "" where it names none."""
        with self._lock:
            return said(call.unit(self._open_pointer(), self._is_level))

    @property
    def notes(self) -> list[str]:
        """What readers and the bake have noted about the map, in sentences."""
        with self._lock:
            return said(call.notes(self._open_pointer())).splitlines()


if sys.platform == "win32":  # pragma: no cover
    raise ImportError("this package is for POSIX systems")
