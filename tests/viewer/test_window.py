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

# (name, keys by their names for X, drags in the window, the same for the script)
STEPS = [
    ("start", [], [], ""),
    ("portals", ["p"], [], "key P\n"),
    ("tree", ["b"], [], "key B\n"),
    ("splits", ["k"], [], "key K\n"),
    ("dark", ["t"], [], "key T\n"),
    ("light", ["t", "k", "b", "p"], [], "key T\nkey K\nkey B\nkey P\n"),
    ("learn", ["F2", "Right", "Right", "Right"], [], "key F2\n" + "key Right\n" * 3),
    ("back", ["Left"], [], "key Left\n"),
    ("wall", ["F3"], [(225, 260, 225, 320)], "key F3\ndrag 225 260 225 320\n"),
    ("undone", ["ctrl+z"], [], "key Ctrl+Z\n"),
]


def start_display():
    """The server and its name; it chooses a free one itself."""
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp"],
        pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as pipe:
        number = pipe.readline().strip()
    return server, f":{number}"


class Window:
    def __init__(self, environment):
        self.environment = environment
        self.id = None

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


def wait_for_file(path):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end and not path.exists():
        time.sleep(0.02)
    return path.exists()


def save(window, folder, number):
    """The pointer rests on the panel, where it changes nothing in the plan."""
    window.do("mousemove", "--window", window.id, 1100, 600)
    window.do("key", "ctrl+s")
    return wait_for_file(folder / f"sightline-{number}.png")


def drive(viewer, window, folder):
    found = window.wait_for("Sightline")
    viewer.check(found is not None, "no window")
    if not found:
        return
    window.id = found
    window.do("windowfocus", found)
    time.sleep(1)
    for number, (name, keys, drags, _) in enumerate(STEPS, 1):
        for key in keys:
            window.do("key", key)
            if key == "ctrl+z":
                time.sleep(1)
        for one in drags:
            window.drag(*one)
            time.sleep(1)  # the map is made anew in the background
        viewer.check(save(window, folder, number), f"{name}: nothing was saved")
    # Walking takes as long as it takes: only that the eye moves can be told.
    window.do("key", "F1", "keydown", "w")
    time.sleep(0.6)
    window.do("keyup", "w")
    viewer.check(save(window, folder, len(STEPS) + 1), "nothing was saved after the walk")
    share = viewer.difference(folder / f"sightline-{len(STEPS)}.png",
                              folder / f"sightline-{len(STEPS) + 1}.png")
    viewer.check(share > TOLERANCE, f"the eye did not walk: {share:.2%}")
    window.do("key", "ctrl+q")


def compare(viewer, folder):
    script = "size 1200 760\n"
    for name, _, _, commands in STEPS:
        script += f"{commands}move 1100 600\nsave {name}.png\n"
    viewer.script(folder, "office.map", script)
    for number, (name, _, _, _) in enumerate(STEPS, 1):
        share = viewer.difference(folder / f"{name}.png", folder / f"sightline-{number}.png")
        viewer.check(share <= TOLERANCE, f"{name}: the window shows {share:.2%} otherwise")


def main():
    if not shutil.which("Xvfb") or not shutil.which("xdotool"):
        print("Xvfb or xdotool is not here")
        sys.exit(SKIP)
    viewer = Viewer(sys.argv)
    server, display = start_display()
    try:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            shown = environment(DISPLAY=display, XDG_CONFIG_HOME=str(folder / "config"))
            program = subprocess.Popen([viewer.view, viewer.root / "maps/office.map"], cwd=folder,
                                       env=shown, stderr=subprocess.PIPE, text=True)
            drive(viewer, Window(shown), folder)
            try:
                _, said = program.communicate(timeout=PATIENCE)
                viewer.check(program.returncode == 0, f"status {program.returncode}: {said}")
            except subprocess.TimeoutExpired:
                program.kill()
                viewer.check(False, "Ctrl+Q does not quit")
            viewer.check((folder / "config/sightline/view.conf").exists(), "nothing is remembered")
            if not viewer.faults:
                compare(viewer, folder)
    finally:
        server.terminate()
        server.wait()
    viewer.end()


if __name__ == "__main__":
    main()
