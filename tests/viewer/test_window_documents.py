"""Documents in a window of a virtual display, with real keys and a real pointer: VIEW SAME ROOT.

Saves, saves under another name, answers the question before the end, chooses layers, types a path,
and is killed with unsaved changes, which the next start recovers. What the window shows is told by
its title, what was done by the files. Skipped (77) where Xvfb or xdotool is not there.
"""
import contextlib
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from test_documents import PLAN, TILES
from test_window import PATIENCE, SKIP, Window, start_display
from viewing import Viewer, environment

# From place to place in a window of 1200 x 760.
WALL = ("drag", 120, 380, 240, 380)


class Session:
    """A run of the viewer."""

    def __init__(self, viewer, folder, shown, *arguments):
        self.viewer = viewer
        self.program = subprocess.Popen([viewer.view, *map(str, arguments)], cwd=folder, env=shown,
                                        stderr=subprocess.PIPE, text=True)
        self.window = Window(shown, viewer, folder)
        self.window.id = self.find()
        if self.window.id:
            self.window.do("windowfocus", self.window.id)
            time.sleep(1)

    def find(self):
        """The window of this program, not that of another one. A renderer may make it anew at
        first: it counts once it has stayed for a while."""
        end = time.monotonic() + PATIENCE
        before = None
        while time.monotonic() < end and self.program.poll() is None:
            found = self.window.do("search", "--all", "--pid", self.program.pid, "--name",
                                   "Sightline").split()
            if found and found == before:
                return found[0]
            before = found
            time.sleep(0.5)
        return None

    def keys(self, *names):
        self.window.do("windowfocus", self.window.id)
        for name in names:
            self.window.do("key", name)
            time.sleep(0.05)

    def type(self, text):
        self.window.write(text)

    def title(self):
        return self.window.do("getwindowname", self.window.id)

    def shows(self, title):
        """Waits for a title."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and self.title() != f"{title} - Sightline":
            time.sleep(0.05)
        self.viewer.check(self.title() == f"{title} - Sightline",
                          f"'{title}' is not shown, but '{self.title()}'")

    def runs(self):
        time.sleep(0.4)
        return self.program.poll() is None

    def ends(self, what):
        try:
            _, said = self.program.communicate(timeout=PATIENCE)
            self.viewer.check(self.program.returncode == 0,
                              f"{what}: status {self.program.returncode}: {said}")
        except subprocess.TimeoutExpired:
            self.viewer.check(False, f"{what}: the program goes on")

    def kill(self):
        if self.program.poll() is None:
            self.program.send_signal(signal.SIGKILL)
        self.program.communicate()


class Cases:
    def __init__(self, viewer, folder, shown):
        self.viewer = viewer
        self.folder = folder
        self.shown = shown

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    @contextlib.contextmanager
    def session(self, *arguments):
        session = Session(self.viewer, self.folder, self.shown, *arguments)
        try:
            self.viewer.check(session.window.id is not None, f"{arguments}: no window")
            if session.window.id:
                yield session
        finally:
            session.kill()

    def saves_and_quits(self):
        path = self.write("plan.map", PLAN)
        other = self.folder / "other.map"
        with self.session(path) as s:
            s.shows("plan.map")
            s.keys("F3")
            s.window.act(WALL)
            s.shows("*plan.map")
            s.keys("ctrl+s")
            s.shows("plan.map")
            saved = path.read_text()
            self.viewer.check(saved != PLAN and "# the wall between" in saved, f"saved: {saved}")
            s.window.act(("drag", 120, 440, 240, 440))
            s.shows("*plan.map")
            s.keys("ctrl+shift+s", "ctrl+u")
            s.type(str(self.folder / "other"))
            s.keys("Return")
            s.shows("other.map")
            self.viewer.check(path.read_text() == saved, "save as wrote to the file that was open")
            self.viewer.check(other.exists() and other.read_text() != saved, "save as")
            # The question: Escape goes back, D gives up, Return saves.
            s.window.act(("drag", 120, 500, 240, 500))
            s.shows("*other.map")
            s.keys("ctrl+q", "Escape")
            self.viewer.check(s.runs(), "Escape did not keep the program")
            before = other.read_text()
            s.keys("ctrl+q", "d")
            s.ends("give up")
            self.viewer.check(other.read_text() == before, "changes that were given up are saved")
        with self.session(other) as s:
            s.shows("other.map")
            s.keys("F3")
            s.window.act(("drag", 120, 500, 240, 500))
            s.shows("*other.map")
            s.keys("ctrl+q", "Return")
            s.ends("save and quit")
            self.viewer.check(other.read_text() != before, "changes are not saved at the end")
        recent = (self.folder / "config/sightline/recent").read_text().split()
        self.viewer.check(recent == [str(other), str(path)], f"recent files: {recent}")
        left = list((self.folder / "state/sightline").glob("unsaved-*"))
        self.viewer.check(not left, f"copies are left: {left}")

    def recovers(self):
        path = self.write("plan.map", PLAN)
        state = self.folder / "state/sightline"
        with self.session(path) as s:
            s.shows("plan.map")
            s.keys("F3")
            s.window.act(WALL)
            s.shows("*plan.map")
            end = time.monotonic() + PATIENCE
            while time.monotonic() < end and not list(state.glob("unsaved-*.map")):
                time.sleep(0.1)
            # Another window beside it does not take the copy for one of a crash.
            with self.session(path) as other:
                other.shows("plan.map")
                other.keys("ctrl+q")
                other.ends("beside it")
            self.viewer.check(list(state.glob("unsaved-*.map")), "no copy of unsaved changes")
        self.viewer.check(path.read_text() == PLAN, "the file was written unasked")
        with self.session() as s:
            s.keys("l")  # later
            s.keys("Escape", "ctrl+q")
            s.ends("later")
        self.viewer.check(list(state.glob("unsaved-*.map")), "the copy is gone")
        with self.session() as s:
            s.keys("r")
            s.shows("*plan.map")
            s.keys("Escape", "ctrl+s")
            s.shows("plan.map")
            self.viewer.check(path.read_text() != PLAN, "the recovered changes are not in the file")
            s.keys("ctrl+q")
            s.ends("recovered")
        self.viewer.check(not list(state.glob("unsaved-*")), "the copy stays after the changes are saved")

    def offers_each(self):
        """Two sessions ended: both are offered, one after the other."""
        state = self.folder / "state/sightline"
        state.mkdir(parents=True)
        for name in ["unsaved-1-0", "unsaved-2-0"]:
            (state / f"{name}.lock").touch()
            (state / f"{name}.map").write_text(PLAN)
        with self.session() as s:
            s.keys("l", "l", "Escape", "ctrl+q")
            s.ends("both later")
        self.viewer.check(len(list(state.glob("unsaved-*.map"))) == 2, "a copy is gone")
        with self.session() as s:
            s.keys("d", "r")
            s.shows("*Untitled")
            s.keys("ctrl+q", "d")
            s.ends("one and the other")
        self.viewer.check(not list(state.glob("unsaved-*")), "a copy was not offered")

    def opens_by_path(self):
        path = self.write("plan.map", PLAN)
        tiles = self.write("tiles.tmx", TILES)
        with self.session(path) as s:
            s.shows("plan.map")
            # The letter that opens the browser is no part of the path. Tab completes.
            s.keys("o")
            s.keys("ctrl+u")
            s.type(str(tiles)[:-5])
            s.keys("Tab", "Return")
            # The dialog of layers: the second one.
            s.keys("Down", "space", "Return")
            s.shows("tiles.tmx")
            s.keys("o")
            s.type("plam")
            s.keys("BackSpace")
            s.type("n.map")
            s.keys("Return")
            s.shows("plan.map")
            s.keys("ctrl+q")
            s.ends("opened by path")

    def starts_large(self):
        """On a dense screen that does not tell its size the window is not tiny."""
        path = self.write("plan.map", PLAN)
        with self.session(path) as s:
            s.shows("plan.map")
            told = s.window.do("getwindowgeometry", s.window.id).split("Geometry: ")[1]
            wide, high = map(int, told.split("x"))
            self.viewer.check(wide >= 1800 and high >= 1100, f"a window of {told} on 2880 x 1800")
            s.keys("ctrl+q")
            s.ends("on a dense screen")

    def shows_a_bad_file(self):
        bad = self.write("bad.map", "sightline 1\nwall 0 0 1\n")
        good = self.write("plan.map", PLAN)
        with self.session(bad) as s:
            self.viewer.check(s.runs(), "a bad file ends the program")
            s.keys("Escape", "o", "ctrl+u")
            s.type(str(good))
            s.keys("Return")
            s.shows("plan.map")
            s.keys("ctrl+q")
            s.ends("after a bad file")


def play(viewer, size, cases):
    server, display = start_display(size)
    try:
        for case in cases:
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name).resolve()
                shown = environment(DISPLAY=display, XDG_CONFIG_HOME=str(folder / "config"),
                                    XDG_STATE_HOME=str(folder / "state"), HOME=str(folder))
                getattr(Cases(viewer, folder, shown), case)()
    finally:
        server.terminate()
        server.wait()


def main():
    if not shutil.which("Xvfb") or not shutil.which("xdotool"):
        print("Xvfb or xdotool is not here")
        sys.exit(SKIP)
    viewer = Viewer(sys.argv)
    play(viewer, "1280x800",
         ["saves_and_quits", "recovers", "offers_each", "opens_by_path", "shows_a_bad_file"])
    play(viewer, "2880x1800", ["starts_large"])
    viewer.end()


if __name__ == "__main__":
    main()
