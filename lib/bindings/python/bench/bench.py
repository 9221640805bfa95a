"""Times of the package beside plain Python and beside the command line: bench.py COMMAND [MAP].

Prints one line of Markdown for each task: processor time, the least of several runs. The other ways are those that
one would write with numpy, shapely and scipy. They use rounded arithmetic; the last column says how
many of their answers agree.
"""
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import warnings

import numpy as np
import shapely
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import shortest_path
from shapely.geometry import LineString, MultiLineString, Point, Polygon
from shapely.prepared import prep
from shapely.strtree import STRtree

import sightline

MAPS = pathlib.Path(__file__).resolve().parents[4] / "maps"


def processor_seconds():
    """Of this process with all its threads, and of programs that it has run."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)


def least(work, runs=5):
    """The least time of several runs, and the last result. A busy machine changes it little."""
    best = None
    for _ in range(runs):
        begun = processor_seconds()
        result = work()
        spent = processor_seconds() - begun
        best = spent if best is None else min(best, spent)
    return best, result


# --- the other ways

def crossings(walls, p, q):
    """Whether the segments from p to q (n, 2) cross a wall: all pairs, in numpy."""
    a, b = walls[:, :2], walls[:, 2:]

    def turn(u, v, w):
        return (v[..., 0] - u[..., 0]) * (w[..., 1] - u[..., 1]) - \
            (v[..., 1] - u[..., 1]) * (w[..., 0] - u[..., 0])

    met = np.zeros(len(p), bool)
    for first in range(0, len(p), 4096):
        part = slice(first, first + 4096)
        s, t = p[part, None, :], q[part, None, :]
        met[part] = ((turn(s, t, a) * turn(s, t, b) < 0) &
                     (turn(a, b, s) * turn(a, b, t) < 0)).any(axis=1)
    return met


def sees_by_numpy(walls, p, q):
    return ~crossings(walls, p, q)


def sees_by_shapely(walls, p, q):
    prepared = prep(MultiLineString([((x0, y0), (x1, y1)) for x0, y0, x1, y1 in walls]))
    return np.array([not prepared.intersects(LineString([a, b])) for a, b in zip(p, q)])


def area_by_rays(walls, eye):
    """The isovist as one writes it in numpy: rays to all corners, and a little beside them."""
    corners = np.unique(walls.reshape(-1, 2), axis=0) - eye
    angles = np.arctan2(corners[:, 1], corners[:, 0])
    angles = np.unique(np.concatenate([angles - 1e-7, angles, angles + 1e-7]))
    d = np.column_stack([np.cos(angles), np.sin(angles)])[:, None, :]
    a, e = walls[:, :2] - eye, walls[:, 2:] - walls[:, :2]
    cross = d[..., 0] * e[:, 1] - d[..., 1] * e[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        along = (a[:, 0] * e[:, 1] - a[:, 1] * e[:, 0]) / cross
        across = (a[:, 0] * d[..., 1] - a[:, 1] * d[..., 0]) / cross
    along[~((across >= 0) & (across <= 1) & (along > 0))] = np.inf
    reach = along.min(axis=1)
    ends = d[:, 0, :] * reach[:, None]
    x, y = ends.T
    return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))


def depth_by_scipy(walls, points):
    n = len(points)
    i, j = np.triu_indices(n, 1)
    sees = np.zeros((n, n), bool)
    sees[i, j] = sees_by_numpy(walls, points[i], points[j])
    depth = shortest_path(csr_matrix(sees | sees.T), unweighted=True)
    reached = np.isfinite(depth)
    return np.where(reached, depth, 0).sum(axis=1) / (reached.sum(axis=1) - 1), sees | sees.T


def cells_by_shapely(polygons, points):
    tree = STRtree(polygons)
    number = {id(polygon): i for i, polygon in enumerate(polygons)}
    found = np.full(len(points), -1)
    for k, point in enumerate(map(Point, points)):
        for hit in tree.query(point):
            i = hit if isinstance(hit, (int, np.integer)) else number[id(hit)]
            if polygons[i].covers(point):
                found[k] = i
                break
    return found


# --- the table

def row(task, ours, name, theirs, agree):
    ratio = theirs / ours
    print(f"| {task} | {ours * 1e3:.3g} | {name} | {theirs * 1e3:.3g} | {ratio:.3g} | {agree} |",
          flush=True)


def share(agree):
    return f"{np.mean(agree):.2%}"


def beside_python(plan):
    level = plan.bake()
    walls = level.walls
    found = level.cell_arrays()
    x0, y0, x1, y1 = level.bounds
    points = np.random.default_rng(1).uniform((x0, y0), (x1, y1), (40000, 2))
    points = points[np.append(found["inside"], False)[level.locate(points)]]
    p, q = points[:10000], points[10000:20000]

    ours, sees = least(lambda: level.can_see(p, q))
    theirs, other = least(lambda: sees_by_numpy(walls, p, q), 1)
    row("10,000 pairs of points", ours, "numpy, all walls", theirs, share(sees == other))
    theirs, other = least(lambda: sees_by_shapely(walls, p, q), 1)
    row("", ours, "shapely, prepared", theirs, share(sees == other))

    eyes = points[:50]
    ours, table = least(lambda: level.isovists(eyes, arrays=True))
    theirs, other = least(lambda: np.array([area_by_rays(walls, eye) for eye in eyes]), 1)
    row("50 isovists", ours, "numpy, rays to corners", theirs,
        share(np.isclose(table["area"], other, rtol=1e-4)))

    step = np.sqrt(found["area"][found["inside"]].sum() / 500)
    ours, table = least(lambda: level.vga(step, arrays=True))
    grid = np.column_stack([table["x"], table["y"]])
    theirs, (_, other) = least(lambda: depth_by_scipy(walls, grid), 1)
    pairs = level.can_see(grid[:, None, :], grid)[np.triu_indices(len(grid), 1)]
    row(f"mean depth of {len(grid)} points", ours, "numpy and scipy", theirs,
        share(pairs == other[np.triu_indices(len(grid), 1)]) + " of pairs")

    polygons = [Polygon(each) for each in np.split(found["corners"], found["offsets"][1:-1])]
    ours, cells = least(lambda: level.locate(p))
    theirs, other = least(lambda: cells_by_shapely(polygons, p), 1)
    row("cells of 10,000 points", ours, "shapely, a tree", theirs, share(cells == other))


def beside_command(command, path, plan):
    def run(*arguments):
        subprocess.run([command, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)

    with tempfile.TemporaryDirectory() as scratch:
        ours_path, theirs_path = (pathlib.Path(scratch, name) for name in ("a.slv", "b.slv"))

        def bake():
            sightline.Plan.from_file(path).bake().save(ours_path)

        ours, _ = least(bake)
        theirs, _ = least(lambda: run("bake", path, "-o", theirs_path))
        row("read, bake, write", ours, "`sightline bake`", theirs,
            "same bytes" if ours_path.read_bytes() == theirs_path.read_bytes() else "DIFFERENT")
        x0, y0, x1, y1 = plan.bounds
        step = np.sqrt((x1 - x0) * (y1 - y0) / 3000)
        table_path = pathlib.Path(scratch, "t.csv")
        theirs, _ = least(lambda: run("isovist", path, "--grid", step, "-o", table_path))
        eyes = np.loadtxt(table_path, delimiter=",", skiprows=1, usecols=(0, 1))
        ours, table = least(lambda: sightline.Plan.from_file(path).isovists(eyes, arrays=True))
        areas = np.loadtxt(table_path, delimiter=",", skiprows=1, usecols=4)
        row(f"read, {len(eyes)} isovists", ours, "`sightline isovist`", theirs,
            share(table["area"] == areas))
        theirs, _ = least(lambda: run("vga", path, "--grid", step, "-o", table_path))
        ours, table = least(lambda: sightline.Plan.from_file(path).vga(step, arrays=True))
        seen = np.loadtxt(table_path, delimiter=",", skiprows=1, usecols=2)
        row(f"read, graph of {len(seen)} points", ours, "`sightline vga`", theirs,
            share(table["connectivity"] == seen))


def main():
    warnings.simplefilter("ignore")  # shapely 1.8 announces changes of 2.0
    path = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else MAPS / "office.map"
    plan = sightline.Plan.from_file(path)
    print(f"{path.name}: {len(plan.walls):,} walls; {os.cpu_count()} cores; Python "
          f"{sys.version.split()[0]}, numpy {np.__version__}, shapely {shapely.__version__}\n")
    print("| task | ours, ms | beside | ms | ratio | agree |")
    print("| --- | ---: | --- | ---: | ---: | --- |")
    beside_python(plan)
    beside_command(sys.argv[1], path, plan)


if __name__ == "__main__":
    main()
