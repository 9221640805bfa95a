"""Results as tables and shapes of other packages, where these are installed."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray


def _module(name: str) -> Any:
    """A module; None where it is not installed."""
    import importlib
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


def polygon(points: NDArray[np.float64]) -> Any:
    """A shapely polygon; without shapely the array itself."""
    shapely = _module("shapely.geometry")
    if shapely is None:
        return points
    return shapely.Polygon(points) if len(points) > 2 else shapely.Polygon()


def polygons(loops: list[NDArray[np.float64]]) -> Any:
    """A shapely geometry of loops, holes clockwise; without shapely the loops themselves.

    Loops meet in single points only. So a loop is within another one where the middle of a side is.
    """
    shapely = _module("shapely.geometry")
    if shapely is None:
        return loops
    whole = [shapely.Polygon(loop) for loop in loops]
    outer = [i for i, each in enumerate(whole) if each.exterior.is_ccw]
    holes: dict[int, list[NDArray[np.float64]]] = {i: [] for i in outer}
    for i, loop in enumerate(loops):
        if i not in holes:
            middle = shapely.Point((loop[0] + loop[1]) / 2)
            around = [k for k in outer if whole[k].contains(middle)]
            holes[min(around, key=lambda k: float(whole[k].area))].append(loop)
    found = [shapely.Polygon(loops[i], holes[i]) for i in outer]
    return found[0] if len(found) == 1 else shapely.MultiPolygon(found)


def frame(columns: dict[str, NDArray[Any]], shapes: Optional[list[NDArray[np.float64]]] = None,
          kind: str = "polygon", crs: Any = None, arrays: bool = False,
          attributes: Optional[dict[str, Any]] = None) -> Any:
    """A GeoDataFrame, else a DataFrame, else the dict; shapes become geometry or a column."""
    pandas = None if arrays else _module("pandas")
    geopandas = None if arrays or shapes is None else _module("geopandas")
    if shapes is not None and geopandas is None:
        column = np.empty(len(shapes), object)
        column[:] = shapes
        columns = {**columns, kind: column}
    if pandas is None:
        return columns
    if geopandas is not None and shapes is not None:
        line_string = _module("shapely.geometry").LineString
        geometry = [polygon(each) if kind == "polygon" else line_string(each) for each in shapes]
        table = geopandas.GeoDataFrame(columns, geometry=geometry, crs=crs)
    else:
        table = pandas.DataFrame(columns)
    table.attrs.update(attributes or {})
    return table


def sparse(offsets: NDArray[np.int64], cells: NDArray[np.int64]) -> Any:
    """A scipy matrix of bool; without scipy the two arrays."""
    scipy = _module("scipy.sparse")
    if scipy is None:
        return offsets, cells
    size = len(offsets) - 1
    return scipy.csr_matrix((np.ones(len(cells), bool), cells, offsets), shape=(size, size))
