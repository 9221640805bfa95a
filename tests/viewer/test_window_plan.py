"""The tools of the Plan mode in a window of a virtual display, by mouse and keys: VIEW SAME ROOT.

In a small window and on a large dense screen, where the window is not tiny: what each tool shows is
what the same script shows without a window, and tables that are exported hold the same. Skipped (77)
where Xvfb or xdotool is not there.
"""
import pathlib
import re
import shutil
import sys
import tempfile
import time

from test_window import SKIP, TOLERANCE, Window, start_display, wait_for_file
from test_window_documents import Session
from viewing import Viewer, environment


# The screen, the window, and the density of pixels that the viewer finds there.
SCREENS = [("1024x768", (1000, 700), 1), ("2880x1800", (1800, 1140), 1.5)]


def steps(width, height, other):
    """name, acts in the window, and the same for the script, by the size of the plan."""
    def at(x, y):
        return round(x * width), round(y * height)

    a, b, c, d = at(0.12, 0.3), at(0.5, 0.5), at(0.08, 0.2), at(0.2, 0.22)
    drag = (*c, *d)
    return [
        ("plan", ["9"], "key 9\n"),
        ("line", ["ctrl+4", ("drag", *drag)], f"key Ctrl+4\ndrag {c[0]} {c[1]} {d[0]} {d[1]}\n"),
        ("path", ["ctrl+3", ("drag", *a, *a), ("drag", *b, *b)],
         f"key Ctrl+3\nclick {a[0]} {a[1]}\nclick {b[0]} {b[1]}\n"),
        ("axial", ["ctrl+5"], "key Ctrl+5\n"),
        ("measure", ["2"], "key 2\n"),
        ("segments", ["ctrl+6"], "key Ctrl+6\n"),
        ("table", ["ctrl+5", "ctrl+l"], "key Ctrl+5\nkey Ctrl+L\n"),
        ("row", ["ctrl+Next", "ctrl+Next"], "key Ctrl+PageDown\nkey Ctrl+PageDown\n"),
        ("no table", ["ctrl+l"], "key Ctrl+L\n"),
        ("rooms", ["ctrl+8"], "key Ctrl+8\n"),
        ("room", [("drag", *a, *a)], f"click {a[0]} {a[1]}\n"),
        ("room named", ["ctrl+k", ("write", "Study"), "Return"], "key Ctrl+K\ntype Study\nkey Return\n"),
        ("zone", [("drag", *drag)], f"drag {c[0]} {c[1]} {d[0]} {d[1]}\n"),
        ("zone in the table", ["ctrl+l", "ctrl+Next"], "key Ctrl+L\nkey Ctrl+PageDown\n"),
        ("no more rooms", ["ctrl+l"], "key Ctrl+L\n"),
        ("camera", ["8", ("drag", *a, *a)], f"key 8\nclick {a[0]} {a[1]}\n"),
        ("camera named", ["ctrl+k", ("write", "Gate 2"), "Return"],
         "key Ctrl+K\ntype Gate 2\nkey Return\n"),
        ("camera turned", ["comma"] * 20 + ["Left", "Left"], "key ,\n" * 20 + "key Left\nkey Left\n"),
        ("camera moved", [("drag", *a, *b)], f"drag {a[0]} {a[1]} {b[0]} {b[1]}\n"),
        ("second camera", [("drag", *a, *a)], f"click {a[0]} {a[1]}\n"),
        ("plan again", ["9"], "key 9\n"),
        ("compared", ["ctrl+7", ("choose", other)],
         f"key Ctrl+7\nkey Ctrl+U\ntype {other}\nkey Return\n"),
        ("changes", ["1"], "key 1\n"),
        ("lines again", ["1", "ctrl+5"], "key 1\nkey Ctrl+5\n"),
    ]


def settings(folder, display, size, density):
    """The environment of a viewer that begins with a window of this size."""
    conf = folder / "config/sightline/view.conf"
    conf.parent.mkdir(parents=True)
    conf.write_text(f"width {size[0] / density:g}\nheight {size[1] / density:g}\n")
    return environment(DISPLAY=display, XDG_CONFIG_HOME=str(folder / "config"),
                       XDG_STATE_HOME=str(folder / "state"))


def export(window, folder):
    """The table of the tool at hand, by keys alone."""
    path = folder / "exported.csv"
    window.do("key", "ctrl+shift+e")
    time.sleep(0.3)
    window.choose(path)
    window.viewer.check(wait_for_file(path), "no table was written")
    return path.read_text() if path.exists() else ""


def in_window(viewer, display, size, density):
    """What each tool shows in a window of that size; its table of axial lines."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        width, height = size
        shown = settings(folder, display, size, density)
        all_steps = steps(width, height, viewer.root / "maps/courtyard.map")
        script = f"size {width} {height}\ndensity {density}\n"
        for step, _, commands in all_steps:
            script += f"{commands}move 5 5\nsave {step}.png\n"
        viewer.script(folder, "office.map", script)
        session = Session(viewer, folder, shown, viewer.root / "maps/office.map")
        window = session.window
        place = window.do("getwindowgeometry", window.id)
        viewer.check(f"Geometry: {width}x{height}" in place, f"not {width} x {height}: {place}")
        for step, acts, _ in all_steps:
            for act in acts:
                window.act(act)
            share = window.shows(folder / f"{step}.png")
            viewer.check(share <= TOLERANCE, f"{size}, {step}: {share:.2%} is otherwise")
        table = export(window, folder)
        session.keys("ctrl+q", "d")  # the cameras are not exported
        session.ends(f"{size}")
        return table


def house():
    """A DXF drawing: two rooms, an opening to the outside, and a hedge on a layer of its own."""
    lines = [("A-WALL", 0, 0, 4, 0), ("A-WALL", 5.5, 0, 12, 0), ("A-WALL", 12, 0, 12, 8),
             ("A-WALL", 12, 8, 0, 8), ("A-WALL", 0, 8, 0, 0), ("A-WALL", 6, 0, 6, 3),
             ("A-WALL", 6, 4, 6, 8), ("A-WALL", 13, -2, 14, -2), ("HEDGE", 2, 5, 4, 5)]
    form = "0\nLINE\n8\n{}\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n"
    return "0\nSECTION\n2\nENTITIES\n" + "".join(form.format(*line) for line in lines) + "0\nENDSEC\n0\nEOF\n"


def kept(viewer, display, size, density):
    """Names of rooms and zones, typed and drawn in a window, are there in the next one."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        width, height = size
        shown = settings(folder, display, size, density)
        x, y = round(0.12 * width), round(0.3 * height)
        x0, y0, x1, y1 = (round(0.08 * width), round(0.2 * height), round(0.2 * width),
                          round(0.22 * height))
        viewer.script(folder, "office.map",
                      f"size {width} {height}\ndensity {density}\nkey 9\nkey Ctrl+8\nmove 5 5\n"
                      f"save rooms.png\nclick {x} {y}\nkey Ctrl+K\ntype Study\nkey Return\n"
                      f"drag {x0} {y0} {x1} {y1}\nkey H\nmove 5 5\nsave named.png\n"
                      "key Ctrl+1\nkey Ctrl+8\nsave again.png\n")

        def is_shown(window, picture):
            share = window.shows(folder / f"{picture}.png")
            viewer.check(share <= TOLERANCE, f"{size}, {picture}: {share:.2%} is otherwise")

        for turn in ("first", "second"):
            session = Session(viewer, folder, shown, viewer.root / "maps/office.map")
            window = session.window
            session.keys("9", "ctrl+8")
            if turn == "first":
                is_shown(window, "rooms")
                window.act(("drag", x, y, x, y))
                session.keys("ctrl+k")
                session.type("Study")
                session.keys("Return")
                window.act(("drag", x0, y0, x1, y1))
                session.keys("h")
                is_shown(window, "named")
            else:
                is_shown(window, "again")
            session.keys("ctrl+q")
            session.ends(f"{size}, {turn} start")
            for picture in folder.glob("saved-*.png"):
                picture.unlink()


def reading(viewer, display, size, density):
    """A drawing asks how it is read, by itself; what was said is known the next time."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        path = folder / "house.dxf"
        path.write_text(house())
        width, height = size
        shown = settings(folder, display, size, density)
        inside = round(0.12 * width), round(0.45 * height)
        # Eleven widgets on from the filter is "Here is inside", and two from there "Close it".
        to_inside, to_close = ["Tab"] * 11, ["Tab"] * 2
        script = (f"size {width} {height}\ndensity {density}\nkey 9\nkey Ctrl+I\ntype hed\nkey Tab\nkey Space\n"
                  f"move 5 5\nscreenshot list.png\n"
                  "key Shift+Tab\n" + "key Tab\n" * 11 + f"key Return\nclick {inside[0]} {inside[1]}\n"
                  + "screenshot leak.png\n" + "key Tab\n" * 2 + "key Return\nkey Return\nkey H\nmove 5 5\nsave read.png\n")
        (folder / "script.txt").write_text(script)
        done = viewer.run(path, "--script", folder / "script.txt", cwd=folder)
        viewer.check(done.returncode == 0, f"reading: {done.stderr}")
        for turn in ("first", "second"):
            session = Session(viewer, folder, shown, path)
            window = session.window
            session.shows("house.dxf")
            if turn == "first":
                time.sleep(0.5)
                session.type("hed")
                session.keys("Tab", "space")
                time.sleep(0.5)
                session.keys("shift+Tab", *to_inside, "Return")
                window.act(("drag", *inside, *inside))
                time.sleep(1)
                session.keys(*to_close, "Return")
                time.sleep(0.5)
                session.keys("Return")
            session.keys("h")  # the first time the eye stays where it was
            share = window.shows(folder / "read.png")
            viewer.check(share <= TOLERANCE, f"{size}, {turn} reading: {share:.2%} is otherwise")
            session.keys("ctrl+q")
            session.ends(f"{size}, {turn} reading")
            for picture in folder.glob("saved-*.png"):
                picture.unlink()
        kept = folder / "config/sightline/drawings"
        text = kept.read_text() if kept.exists() else ""
        for line in ("layers HEDGE=wall\n", "start ", "closed "):
            viewer.check(line in text, f"'{line.strip()}' is not kept: {text}")


def by_keys(viewer, display, size, density):
    """With the keyboard alone: an opening of a drawing is closed. In a building, a way from one storey to the
    other on paper, cameras from a table and one more, named, and their table."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for storey, source in (("ground", "office"), ("upper", "courtyard")):
            text = (viewer.root / f"maps/{source}.map").read_text()
            (folder / f"{storey}.map").write_text(text + "unit m\n")
        building = folder / "house.storeys"
        building.write_text("storeys 1\nstorey ground ground.map\nstorey upper upper.map\n"
                            "link stair ground 3,3 upper 3,3 4\n")
        (folder / "given.csv").write_text("name,x,y,heading,fov,range\nHall,3,3,45,90,10\n")
        shown = settings(folder, display, size, density)
        (folder / "house.dxf").write_text(house())
        session = Session(viewer, folder, shown, folder / "house.dxf")
        session.shows("house.dxf")
        session.keys(*["Tab"] * 11, "Return", "Return")
        time.sleep(1)
        session.keys("Tab", "Tab", "Return", "Return", "ctrl+q")
        session.ends("an opening by keys")
        drawings = (folder / "config/sightline/drawings").read_text()
        viewer.check("start " in drawings and "closed " in drawings, f"not closed by keys: {drawings}")
        session = Session(viewer, folder, shown, building)
        session.keys("Return")
        session.shows("ground.map")
        session.keys("9", "ctrl+3", "Tab", "Up", "Return", "ctrl+shift+b", "Down", "Return")
        session.shows("upper.map")
        session.keys("Left", "Left", "Left", "Return", "ctrl+shift+p", "Return", "Return")
        session.window.choose(folder / "way.svg")
        viewer.check(wait_for_file(folder / "way.svg"), "the way is on no paper")
        session.keys("8", "ctrl+shift+o")
        session.window.choose(folder / "given.csv")
        time.sleep(1)  # a camera that stands before the table is read would be asked about
        session.keys("Return", "ctrl+k")
        session.type("Desk 3")
        session.keys("Return", "Escape", "comma", "ctrl+shift+e")
        session.window.choose(folder / "cameras.csv")
        viewer.check(wait_for_file(folder / "cameras.csv"), "no table was written")
        session.keys("ctrl+q")
        session.ends("by keys")
        table, way = (folder / "cameras.csv").read_text(), (folder / "way.svg").read_text()
        viewer.check(re.fullmatch(r'name,x,y,heading,fov,range\n"Hall",3,3,45,90,10\n"Desk 3",[-0-9.,]+,355,0\n',
                                  table), f"cameras by keys: {table}")
        viewer.check(re.search(r"shortest way through the building: [0-9.]+ m<", way) is not None, "the way has no length")


def main():
    if not shutil.which("Xvfb") or not shutil.which("xdotool"):
        print("Xvfb or xdotool is not here")
        sys.exit(SKIP)
    viewer = Viewer(sys.argv)
    tables = []
    for screen, size, density in SCREENS:
        server, display = start_display(screen)
        try:
            tables.append(in_window(viewer, display, size, density))
            kept(viewer, display, size, density)
            reading(viewer, display, size, density)
            if density == 1:
                by_keys(viewer, display, size, density)
        finally:
            server.terminate()
            server.wait()
    viewer.check(tables[0].startswith("x1,y1,x2,y2,connectivity") and tables[0] == tables[1],
                 "the tables are not the same in both windows")
    viewer.end()


if __name__ == "__main__":
    main()
