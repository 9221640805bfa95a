"""Plans and levels as pictures: by matplotlib, and as SVG for notebooks."""
from __future__ import annotations

import base64
import html as escaping
from typing import Any

import numpy as np
from numpy.typing import NDArray

# Beyond so many walls a notebook's picture says how many there are in place of showing them.
MOST_WALLS_IN_SVG = 20000
_COLOURS = {"wall": "#222222", "door": "#b5651d", "mirror": "#2a7fba", "oneway": "#7a3fa0",
            "cell": "#eef2f5", "portal": "#9fb4c3", "start": "#c0392b"}


def describe(handle: Any) -> str:
    """What a plan holds, in words: "5 walls, 1 door"."""
    counts = [(len(handle.walls), "wall"), (len(handle.doors), "door"),
              (len(handle.mirrors), "mirror"), (len(handle.oneways), "one-way glass"),
              (len(handle.starts), "start")]
    words = [f"{count} {name}{'' if count == 1 or name.endswith('glass') else 's'}"
             for count, name in counts if count]
    return ", ".join(words) or "empty"


def _polygons(level: Any) -> list[NDArray[np.float64]]:
    """The cells in which one can stand."""
    found = level.cell_arrays()
    corners = np.split(found["corners"], found["offsets"][1:-1])
    return [corner for corner, inside in zip(corners, found["inside"]) if inside]


def _lines(handle: Any) -> list[tuple[str, NDArray[np.float64], bool]]:
    """Segments by kind, and whether they are dashed: doors that are open."""
    lines = [("wall", handle.walls, False), ("mirror", handle.mirrors, False),
             ("oneway", handle.oneways, False)]
    states = dict(handle.doors)
    lines += [("door", rows, states[name]) for name, rows in handle.door_segments.items()]
    return lines


def plot(handle: Any, ax: Any = None, *, cells: bool = False, portals: bool = False,
         starts: bool = True, **style: Any) -> Any:
    """See Plan.plot and Level.plot; `style` goes to the lines of the walls."""
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection, PolyCollection
    if ax is None:
        ax = plt.subplots()[1]
    if cells and handle._is_level:
        ax.add_collection(PolyCollection(_polygons(handle), facecolor=_COLOURS["cell"],
                                         edgecolor=_COLOURS["portal"], linewidth=0.4, zorder=0))
    if portals and handle._is_level:
        table = handle.portals
        ends = np.stack([np.asarray(table[name]) for name in ("x0", "y0", "x1", "y1")], axis=1)
        ax.add_collection(LineCollection(list(ends.reshape(-1, 2, 2)), color=_COLOURS["portal"],
                                         linewidth=0.8, zorder=1))
    for kind, rows, dashed in _lines(handle):
        options = {"color": _COLOURS[kind], "linewidth": 1.2 if kind == "wall" else 2, "zorder": 3,
                   "linestyle": "--" if dashed else "-"}
        options.update(style if kind == "wall" else {})
        ax.add_collection(LineCollection(list(rows.reshape(-1, 2, 2)), **options))
    if starts and len(handle.starts):
        ax.plot(handle.starts[:, 0], handle.starts[:, 1], "o", color=_COLOURS["start"], ms=4,
                zorder=4)
    x0, y0, x1, y1 = handle.bounds
    margin = 0.02 * max(x1 - x0, y1 - y0) or 1
    ax.set_xlim(x0 - margin, x1 + margin)
    ax.set_ylim(y0 - margin, y1 + margin)
    ax.set_aspect("equal")
    return ax


def heat_map(table: Any, column: str, ax: Any = None, *, grid: float = 0, **style: Any) -> Any:
    """Draw a column of a table of `vga` or `isovists` as coloured squares; returns the image.

    Parameters
    ----------
    table
        A DataFrame or dict with columns x, y and `column`.
    column
        What the colours show.
    ax
        The axes; by default new ones.
    grid
        The distance between neighbouring points; by default what the table says, or the least
        distance of two columns of points.
    """
    import matplotlib.pyplot as plt
    if ax is None:
        ax = plt.subplots()[1]
    x, y, values = (np.asarray(table[name], dtype=float) for name in ("x", "y", column))
    step = grid or getattr(table, "attrs", {}).get("grid") or _least_step(x, y)
    left, bottom = x.min(), y.min()
    i, j = np.rint((x - left) / step).astype(int), np.rint((y - bottom) / step).astype(int)
    image = np.full((j.max() + 1, i.max() + 1), np.nan)
    image[j, i] = values
    extent = (left - step / 2, x.max() + step / 2, bottom - step / 2, y.max() + step / 2)
    return ax.imshow(image, origin="lower", extent=extent, interpolation="nearest", zorder=2,
                     **style)


def _least_step(x: NDArray[np.float64], y: NDArray[np.float64]) -> float:
    steps = np.concatenate([np.diff(np.unique(x)), np.diff(np.unique(y))])
    if not steps.size:
        raise ValueError("one point makes no grid: give grid=")
    return float(steps.min())


def _number(value: float) -> str:
    return f"{value:.7g}"


def svg(handle: Any) -> str:
    """An SVG picture about 480 wide; y is turned down."""
    x0, y0, x1, y1 = handle.bounds
    size = max(x1 - x0, y1 - y0) or 1
    margin = 0.02 * size
    width, height = x1 - x0 + 2 * margin, y1 - y0 + 2 * margin
    scale = 480 / width if width >= height else 480 / height
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{_number(width * scale)}" '
             f'height="{_number(height * scale)}" viewBox="0 0 {_number(width * scale)} '
             f'{_number(height * scale)}">']

    def place(points: NDArray[np.float64]) -> NDArray[np.float64]:
        turned = np.array(points, dtype=float).reshape(-1, 2)
        turned[:, 0] = (turned[:, 0] - x0 + margin) * scale
        turned[:, 1] = (y1 + margin - turned[:, 1]) * scale
        return turned

    count = len(handle.walls)
    if count > MOST_WALLS_IN_SVG:
        parts.append(f'<text x="10" y="24" font-family="sans-serif">{count} walls: too many for '
                     'this picture; plot() draws them</text></svg>')
        return "".join(parts)
    if handle._is_level:
        path = "".join("M" + "L".join(f"{a:.2f},{b:.2f}" for a, b in place(corners)) + "Z"
                       for corners in _polygons(handle))
        parts.append(f'<path d="{path}" fill="{_COLOURS["cell"]}" stroke="{_COLOURS["portal"]}" '
                     'stroke-width="0.4"/>')
    for kind, rows, dashed in _lines(handle):
        if not len(rows):
            continue
        ends = place(rows).reshape(-1, 4)
        path = "".join(f"M{a:.2f},{b:.2f}L{c:.2f},{d:.2f}" for a, b, c, d in ends)
        parts.append(f'<path d="{path}" fill="none" stroke="{_COLOURS[kind]}" stroke-width='
                     f'"{1.2 if kind == "wall" else 2.5}" stroke-linecap="round"'
                     f'{" stroke-dasharray=" + chr(34) + "4 3" + chr(34) if dashed else ""}/>')
    for a, b in place(handle.starts[:, :2]):
        parts.append(f'<circle cx="{a:.2f}" cy="{b:.2f}" r="3" fill="{_COLOURS["start"]}"/>')
    parts.append("</svg>")
    return "".join(parts)


def html(handle: Any) -> str:
    """The same as an image: nbconvert drops what is inside of an SVG element."""
    coded = base64.b64encode(svg(handle).encode("utf-8")).decode("ascii")
    return (f'<img alt="{escaping.escape(repr(handle))}" '
            f'src="data:image/svg+xml;base64,{coded}">')


class InNotebooks:
    """What notebooks show of a plan or a level."""

    def _repr_svg_(self) -> str:
        return svg(self)

    def _repr_html_(self) -> str:
        return html(self)
