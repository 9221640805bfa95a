"""Baked levels by Python's ctypes alone: the shared library sightline_level, as a class.

    level = Level("level.slv")
    points = level.visible_polygon(x, y)            # [(x1, y1), (x2, y2), ...]

sightline_level.h says what each call answers. SIGHTLINE_LEVEL names the shared library, if it is not where
the system looks for libraries. For plans, tables and numpy there is the Python package sightline.
"""
import ctypes
import os

C = ctypes.CDLL(os.environ.get("SIGHTLINE_LEVEL", "libsightline_level.so"))
HANDLE, NUMBER, WHOLE, TEXT = ctypes.c_void_p, ctypes.c_double, ctypes.c_int32, ctypes.c_char_p
COUNT, NUMBERS = ctypes.POINTER(WHOLE), ctypes.POINTER(NUMBER)
EYE = [NUMBER] * 5 + [COUNT]
for name, result, arguments in (
        ("close", None, []),
        ("use_file_coordinates", WHOLE, []),
        ("use_coordinates", None, [NUMBER, NUMBER, NUMBER, WHOLE]),
        ("y_is_down", WHOLE, []),
        ("cell_count", WHOLE, []),
        ("bounds", None, [NUMBERS]),
        ("cell_corners", NUMBERS, [WHOLE, COUNT]),
        ("is_solid", WHOLE, [WHOLE]),
        ("door_count", WHOLE, []),
        ("door_name", TEXT, [WHOLE]),
        ("find_door", WHOLE, [TEXT, WHOLE]),
        ("set_door", WHOLE, [WHOLE, WHOLE]),
        ("door_is_open", WHOLE, [WHOLE]),
        ("door_segments", NUMBERS, [WHOLE, COUNT]),
        ("locate", WHOLE, [NUMBER, NUMBER]),
        ("can_see", WHOLE, [WHOLE, WHOLE]),
        ("look", COUNT, EYE),
        ("visible_polygon", NUMBERS, EYE)):
    function = getattr(C, "sl_level_" + name)
    function.restype, function.argtypes = result, [HANDLE, *arguments]
C.sl_level_open_file.restype, C.sl_level_open_file.argtypes = HANDLE, [TEXT]
C.sl_level_error.restype = TEXT


class Level:
    """A level in memory. Answers are copies. Headings and fields of view are in degrees."""

    def __init__(self, file):
        self._handle = C.sl_level_open_file(os.fsencode(file))
        if not self._handle:
            raise OSError(f"{file}: {C.sl_level_error().decode()}")

    def __del__(self):
        C.sl_level_close(self._handle)

    def _list(self, call, *arguments, numbers=1):
        """The numbers of an answer; `numbers` of them for each of its items."""
        count = WHOLE()
        answer = call(self._handle, *arguments, count)
        return answer[:numbers * count.value]

    def _points(self, call, *arguments):
        flat = self._list(call, *arguments, numbers=2)
        return list(zip(flat[::2], flat[1::2]))

    def use_file_coordinates(self):
        """Places become those of the file that was baked: pixels of Tiled with y down. False if nobody knows them."""
        return bool(C.sl_level_use_file_coordinates(self._handle))

    def use_coordinates(self, origin, scale, y_down):
        C.sl_level_use_coordinates(self._handle, *origin, scale, y_down)

    def y_is_down(self):
        """Whether y is down in the coordinates that are chosen, as in a window."""
        return bool(C.sl_level_y_is_down(self._handle))

    def bounds(self):
        numbers = (NUMBER * 4)()
        C.sl_level_bounds(self._handle, numbers)
        return tuple(numbers)

    def cell_count(self):
        return C.sl_level_cell_count(self._handle)

    def cell_corners(self, cell):
        return self._points(C.sl_level_cell_corners, cell)

    def is_solid(self, cell):
        return bool(C.sl_level_is_solid(self._handle, cell))

    def doors(self):
        """Of each door: its name, whether it is open, and its segments (x0, y0, x1, y1)."""
        found = []
        for door in range(C.sl_level_door_count(self._handle)):
            flat = self._list(C.sl_level_door_segments, door, numbers=4)
            found.append((C.sl_level_door_name(self._handle, door).decode(), bool(C.sl_level_door_is_open(self._handle, door)),
                          [tuple(flat[i:i + 4]) for i in range(0, len(flat), 4)]))
        return found

    def set_door(self, name, is_open):
        """Opens or shuts all doors of a name; KeyError for none. False if it cannot: a wall breaks once."""
        door = C.sl_level_find_door(self._handle, name.encode(), 0)
        if door < 0:
            raise KeyError(name)
        return bool(C.sl_level_set_door(self._handle, door, is_open))

    def locate(self, x, y):
        return C.sl_level_locate(self._handle, x, y)

    def can_see(self, cell, other):
        return bool(C.sl_level_can_see(self._handle, cell, other))

    def look(self, x, y, heading=0, fov=360, reach=0):
        return self._list(C.sl_level_look, x, y, heading, fov, reach)

    def visible_polygon(self, x, y, heading=0, fov=360, reach=0):
        return self._points(C.sl_level_visible_polygon, x, y, heading, fov, reach)
