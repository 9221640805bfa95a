"""What an eye sees of a baked level, with doors opened and shut by name: Python's ctypes alone.

    python3 seen.py LEVEL.slv X Y [open NAME | shut NAME]...

SIGHTLINE_LEVEL names the shared library, if it is not where the system looks for libraries. For
plans, tables and numpy there is the Python package sightline.
"""
import ctypes
import os
import sys

C = ctypes.CDLL(os.environ.get("SIGHTLINE_LEVEL", "libsightline_level.so"))
NUMBER, COUNT = ctypes.c_double, ctypes.POINTER(ctypes.c_int32)
EYE = [ctypes.c_void_p, *[NUMBER] * 5, COUNT]
for name, result, arguments in (
        ("open_file", ctypes.c_void_p, [ctypes.c_char_p]),
        ("error", ctypes.c_char_p, []),
        ("close", None, [ctypes.c_void_p]),
        ("cell_count", ctypes.c_int32, [ctypes.c_void_p]),
        ("find_door", ctypes.c_int32, [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int32]),
        ("set_door", None, [ctypes.c_void_p, ctypes.c_int32, ctypes.c_int32]),
        ("locate", ctypes.c_int32, [ctypes.c_void_p, NUMBER, NUMBER]),
        ("can_see", ctypes.c_int32, [ctypes.c_void_p, ctypes.c_int32, ctypes.c_int32]),
        ("look", COUNT, EYE),
        ("visible_polygon", ctypes.POINTER(NUMBER), EYE)):
    function = getattr(C, "sl_level_" + name)
    function.restype, function.argtypes = result, arguments


def main(file, x, y, *doors):
    x, y = float(x), float(y)
    level = C.sl_level_open_file(file.encode())
    if not level:
        sys.exit(f"seen: {file}: {C.sl_level_error().decode()}")
    for what, name in zip(doors[::2], doors[1::2]):
        door = C.sl_level_find_door(level, name.encode(), 0)
        if door < 0:
            sys.exit(f"seen: there is no door {name}")
        while door >= 0:
            C.sl_level_set_door(level, door, what == "open")
            door = C.sl_level_find_door(level, name.encode(), door + 1)
    cell, count = C.sl_level_locate(level, x, y), ctypes.c_int32()
    print("cell", cell)
    print("row", *(i for i in range(C.sl_level_cell_count(level)) if C.sl_level_can_see(level, cell, i)))
    cells = C.sl_level_look(level, x, y, 0, 360, 0, count)
    print("seen", *sorted(cells[:count.value]))
    points = C.sl_level_visible_polygon(level, x, y, 0, 360, 0, count)
    print("points", count.value)
    for i in range(count.value):
        print(repr(points[2 * i]), repr(points[2 * i + 1]))
    C.sl_level_close(level)


if __name__ == "__main__":
    main(*sys.argv[1:])
