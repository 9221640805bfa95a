"""What the tests of the viewer share: running it, and comparing pictures."""
import os
import pathlib
import subprocess
import sys

# The share of pixels that may differ from a stored picture: other versions of the font and of its
# renderer move the edges of letters. The tests make sure that each layer changes more than that.
TOLERANCE = 0.004


def environment(**more):
    """For runs that look for a display: what its drivers keep until the end is not ours."""
    leaks = os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0"
    return {**os.environ, "ASAN_OPTIONS": leaks.lstrip(":"), "SDL_VIDEODRIVER": "x11", **more}


class Viewer:
    def __init__(self, arguments):
        if len(arguments) < 4:
            sys.exit(f"usage: {arguments[0]} VIEW SAME ROOT: the viewer, the program same_picture of "
                     "tests/viewer, and the folder of the project")
        self.view, self.same, self.root = (pathlib.Path(each).resolve() for each in arguments[1:4])
        self.faults = []

    def run(self, *arguments, **more):
        return subprocess.run([self.view, *map(str, arguments)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, timeout=120, **more)

    def script(self, folder, map_name, text):
        """Runs a script in a folder; it must go well."""
        path = pathlib.Path(folder) / "script.txt"
        path.write_text(text)
        done = self.run(self.root / "maps" / map_name, "--script", path, cwd=folder)
        self.check(done.returncode == 0, f"script on {map_name}: {done.stderr}")

    def difference(self, one, other):
        done = subprocess.run([self.same, str(one), str(other)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True)
        if done.returncode:
            self.faults.append(done.stderr.strip())
            return 1.0
        return float(done.stdout)

    def check(self, good, what):
        if not good:
            self.faults.append(what)

    def end(self):
        for fault in self.faults:
            print(fault)
        sys.exit(bool(self.faults))
