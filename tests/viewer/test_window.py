"""The viewer in a window of a virtual display, with real keys and a real pointer: VIEW SAME ROOT.

Opens a map, switches layers, steps forwards and back, draws a wall and undoes it, walks, saves the
plan after each, and compares what was saved with what the same script gives without a window.
Skipped (77) where Xvfb or xdotool is not there.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from viewing import TOLERANCE, Viewer, environment

SKIP = 77
PATIENCE = 30
DROP = pathlib.Path(sys.argv[2]).with_name("drop_file")

# Where the cone's slider stands in a window of 1200 x 760: its knob at 90 degrees, and farther on.
CONE, WIDER = (1045, 554), (1090, 554)

# name, what is done in the window (a list of acts), and the same for the script.
# Acts: a key by its name for X; ("drag", X, Y, X2, Y2); ("wheel", X, Y, TURNS); ("drop", MAP).
STEPS = [
    ("start", [], ""),
    ("portals", ["p"], "key P\n"),
    ("tree", ["b"], "key B\n"),
    ("splits", ["k"], "key K\n"),
    ("dark", ["t"], "key T\n"),
    ("light", ["t", "k", "b", "p"], "key T\nkey K\nkey B\nkey P\n"),
    ("cone", [("drag", *CONE, *WIDER)], f"drag {CONE[0]} {CONE[1]} {WIDER[0]} {WIDER[1]}\n"),
    ("zoomed", [("wheel", 300, 300, 3)], "move 300 300\n" + "wheel 1\n" * 3),
    ("back_out", [("wheel", 300, 300, -3)], "move 300 300\n" + "wheel -1\n" * 3),
    ("fit", ["f"], "key F\n"),
    ("heat", ["m", "1", "2"], "key M\nkey 1\nkey 2\n"),
    ("heat_finer", ["5"], "key 5\n"),
    ("heat_kept", ["7"], "key 7\n"),
    ("heat_steps", ["6"], "key 6\n"),
    ("no_heat", ["6", "1", "m"], "key 6\nkey 1\nkey M\n"),
    ("plan", ["9"], "key 9\n"),
    ("plan_graph", ["ctrl+2"], "key Ctrl+2\n"),
    ("plan_path", ["ctrl+2", "ctrl+3", ("drag", 150, 200, 150, 200), ("drag", 600, 400, 600, 400)],
     "key Ctrl+2\nkey Ctrl+3\nclick 150 200\nclick 600 400\n"),
    ("plan_eye", ["ctrl+1", ("drag", 400, 300, 400, 300)], "key Ctrl+1\nclick 400 300\n"),
    ("learn", ["F2", "Right", "Right", "Right"], "key F2\n" + "key Right\n" * 3),
    ("back", ["Left"], "key Left\n"),
    ("moved", ["period", "period", "Up", "Up", "period", "Right"],
     "key .\nkey .\nkey Up\nkey Up\nkey .\nkey Right\n"),
    ("one_back", ["comma", "ctrl+z"], "key ,\nkey Ctrl+Z\n"),
    ("reset", ["Delete", "Escape", "r"], "key Delete\nkey Escape\nkey R\n"),
    ("unnamed", ["0"], "key 0\n"),
    ("named", ["0"], "key 0\n"),
    ("wall", ["F3", ("drag", 225, 260, 225, 320)], "key F3\ndrag 225 260 225 320\n"),
    ("undone", ["ctrl+z"], "key Ctrl+Z\n"),
    ("dropped", ["F1", ("drop", "oblique/rotunda.map")], "key F1\nopen {maps}/oblique/rotunda.map\n"),
    ("oblique_tree", ["b"], "key B\n"),
    ("oblique_nodes", ["q"], "key Q\n"),
    ("oblique_cells", ["c"], "key C\n"),
    ("oblique_learn", ["F2", "u", "Right", "Right"], "key F2\nkey U\nkey Right\nkey Right\n"),
    ("oblique_wall", ["F3", ("drag", 330, 440, 420, 470)], "key F3\ndrag 330 440 420 470\n"),
    ("oblique_undone", ["ctrl+z"], "key Ctrl+Z\n"),
    ("doors", ["F1", ("drop", "effects/doors.map")], "key F1\nopen {maps}/effects/doors.map\n"),
    ("door_shut", ["n"], "key N\n"),
    ("door_undone", ["ctrl+z"], "key Ctrl+Z\n"),
]


def steps():
    """Those that can be done: without the program that drops files, up to there."""
    names = [name for name, _, _ in STEPS]
    return STEPS if DROP.exists() else STEPS[:names.index("dropped")]


def start_display(size="1280x800"):
    """The server and its name; it chooses a free one itself."""
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{size}x24", "-nolisten", "tcp", "-noreset"],
        pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as pipe:
        number = pipe.readline().strip()
    return server, f":{number}"


class Window:
    def __init__(self, environment, viewer, folder):
        self.environment = environment
        self.viewer = viewer
        self.folder = folder
        self.id = None
        self.saved = 0

    def do(self, *words):
        done = subprocess.run(["xdotool", *map(str, words)], env=self.environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=PATIENCE)
        return done.stdout.strip()

    def wait_for(self, name):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            found = self.do("search", "--name", name)
            if found:
                return found.split()[0]
            time.sleep(0.1)
        return None

    def drag(self, x0, y0, x1, y1):
        self.do("mousemove", "--window", self.id, x0, y0, "mousedown", 1)
        for i in range(1, 5):
            self.do("mousemove", "--window", self.id, x0 + (x1 - x0) * i // 4,
                    y0 + (y1 - y0) * i // 4)
        self.do("mouseup", 1)

    def wheel(self, x, y, turns):
        self.do("mousemove", "--window", self.id, x, y)
        for _ in range(abs(turns)):
            self.do("click", 4 if turns > 0 else 5)

    def drop(self, name):
        path = self.viewer.root / "maps" / name
        done = subprocess.run([DROP, self.id, str(path.resolve())], env=self.environment, text=True,
                              stderr=subprocess.PIPE, timeout=PATIENCE)
        self.viewer.check(done.returncode == 0, f"{name}: {done.stderr.strip()}")

    def act(self, act):
        if isinstance(act, str):
            self.do("key", act)
        else:
            getattr(self, act[0])(*act[1:])

    def save(self):
        """The picture that is saved next. The pointer rests on the bar, where it changes nothing."""
        self.saved += 1
        path = self.folder / f"saved-{self.saved}.png"
        self.do("mousemove", "--window", self.id, 1150, 15)
        self.do("key", "ctrl+e")
        self.choose(path)
        self.viewer.check(wait_for_file(path), f"{path.name} was not saved")
        return path

    def write(self, text):
        self.do("type", "--delay", 15, text)

    def choose(self, path):
        """Types a path into the dialog that asks for one."""
        self.do("key", "ctrl+u")
        self.do("type", "--delay", 2, path)
        self.do("key", "Return")

    def save_after(self, series):
        """Saves the plan once the series is written: until then that is refused."""
        end = time.monotonic() + PATIENCE
        count = -1
        while time.monotonic() < end and len(list(series.iterdir())) != count:
            count = len(list(series.iterdir()))
            time.sleep(1)
        self.viewer.check(all(path.name.startswith("frame-") and path.suffix == ".png"
                              for path in series.iterdir()), "parts of pictures are left")
        self.save()

    def shows(self, picture):
        """How far the window is from a picture, once it has had time: what follows from a change of
        the map is made in the background."""
        end = time.monotonic() + PATIENCE
        while True:
            now, known = self.save(), len(self.viewer.faults)
            share = self.viewer.difference(picture, now)
            if share <= TOLERANCE or time.monotonic() > end:
                return share
            del self.viewer.faults[known:]  # another size: what changes it is still to come
            time.sleep(0.2)


def wait_for_file(path):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end and not path.exists():
        time.sleep(0.02)
    return path.exists()


def drive(viewer, window):
    found = window.wait_for("Sightline")
    viewer.check(found is not None, "no window")
    if not found:
        return
    window.id = found
    window.do("windowfocus", found)
    time.sleep(1)
    for name, acts, _ in steps():
        for act in acts:
            window.act(act)
        share = window.shows(window.folder / f"{name}.png")
        viewer.check(share <= TOLERANCE, f"{name}: the window shows {share:.2%} otherwise")
    # Walking takes as long as it takes: only that the eye moves can be told.
    window.do("key", "F1")
    before = window.save()
    window.do("keydown", "w")
    time.sleep(0.6)
    window.do("keyup", "w")
    share = viewer.difference(before, window.save())
    viewer.check(share > TOLERANCE, f"the eye did not walk: {share:.2%}")
    export(viewer, window)
    window.do("key", "ctrl+q")


def export(viewer, window):
    """A recorded way becomes numbered pictures in the background: keys work meanwhile."""
    series = window.folder / "way"
    for act in ["F9", "w", "F9", "ctrl+m", "End", "Up", "Return"]:
        window.act(act)
        time.sleep(0.3)
    window.choose(series)
    window.act("m")
    window.act("m")
    viewer.check(wait_for_file(series / "frame-0002.png"), "no numbered pictures")
    window.save_after(series)


def open_wrong(viewer, folder, shown, path):
    """A file that cannot be opened: the window is there, and ends as it is told."""
    program = subprocess.Popen([viewer.view, path], cwd=folder, env=shown, stderr=subprocess.PIPE,
                               text=True)
    window = Window(shown, viewer, folder)
    window.id = window.wait_for("Sightline")
    viewer.check(window.id is not None, f"{path.name}: no window")
    if window.id:
        window.do("windowfocus", window.id)
        time.sleep(0.5)
        viewer.check(program.poll() is None, f"{path.name}: the window did not stay")
        window.do("key", "Return")  # the message that says why
        time.sleep(0.3)
        window.do("key", "ctrl+q")
    try:
        _, said = program.communicate(timeout=PATIENCE)
        viewer.check(program.returncode == 0, f"{path.name}: status {program.returncode}: {said}")
    except subprocess.TimeoutExpired:
        program.kill()
        viewer.check(False, f"{path.name}: Ctrl+Q does not quit")


def draw_expected(viewer, folder):
    """What a script of the same steps saves."""
    script = "size 1200 760\n"
    for name, _, commands in steps():
        commands = commands.replace("{maps}", str(viewer.root / "maps"))
        script += f"{commands}move 1150 15\nsave {name}.png\n"
    viewer.script(folder, "office.map", script)


def main():
    if not shutil.which("Xvfb") or not shutil.which("xdotool"):
        print("Xvfb or xdotool is not here")
        sys.exit(SKIP)
    viewer = Viewer(sys.argv)
    server, display = start_display()
    try:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            draw_expected(viewer, folder)
            shown = environment(DISPLAY=display, XDG_CONFIG_HOME=str(folder / "config"),
                                XDG_STATE_HOME=str(folder / "state"))
            program = subprocess.Popen([viewer.view, viewer.root / "maps/office.map"], cwd=folder,
                                       env=shown, stderr=subprocess.PIPE, text=True)
            drive(viewer, Window(shown, viewer, folder))
            try:
                _, said = program.communicate(timeout=PATIENCE)
                viewer.check(program.returncode == 0, f"status {program.returncode}: {said}")
            except subprocess.TimeoutExpired:
                program.kill()
                viewer.check(False, "Ctrl+Q does not quit")
            viewer.check((folder / "config/sightline/view.conf").exists(), "nothing is remembered")
            broken = folder / "broken.map"
            broken.write_text("sightline 1\nwall 0 0 1\n")
            for path in (broken, folder / "missing.map"):
                open_wrong(viewer, folder, shown, path)
    finally:
        server.terminate()
        server.wait()
    viewer.end()


if __name__ == "__main__":
    main()
