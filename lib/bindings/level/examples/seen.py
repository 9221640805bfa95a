"""What an eye sees of a baked level, with doors opened and shut by name.

    python3 seen.py LEVEL.slv X Y [open NAME | shut NAME]...
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from sightline_level import Level  # noqa: E402


def main(file, x, y, *doors):
    x, y = float(x), float(y)
    try:
        level = Level(file)
        for what, name in zip(doors[::2], doors[1::2]):
            level.set_door(name, what == "open")
    except OSError as fault:
        sys.exit(f"seen: {fault}")
    except KeyError as fault:
        sys.exit(f"seen: there is no door {fault}")
    cell = level.locate(x, y)
    print("cell", cell)
    print("row", *(i for i in range(level.cell_count()) if level.can_see(cell, i)))
    print("seen", *sorted(level.look(x, y)))
    points = level.visible_polygon(x, y)
    print("points", len(points))
    for point in points:
        print(*map(repr, point))


if __name__ == "__main__":
    main(*sys.argv[1:])
