"""A map goes the whole way: baked with closed and with open sight, exported, and what comes out
checked by check_export.py, which shares nothing with the library.

check_map.py PROGRAM MAP [BAKE-OPTION...]

Exit status: 0 nothing found, 1 faults found, 77 where the map is not there.
"""
import pathlib
import subprocess
import sys
import tempfile

SIGHTLINES = "20000"
# Effects that a map calls for are left out: the exported visibility is that of its walls.
WITHOUT = ["--without", "door,mirror,oneway,range"]


def run(*command):
    """Runs a command that must be done well; what it says is shown."""
    status = subprocess.run(list(map(str, command))).returncode
    if status:
        sys.exit(f"{' '.join(map(str, command))}: ended with {status}")


def main():
    program, path, *options = sys.argv[1:]
    if not pathlib.Path(path).exists():
        print(f"skipped: {path} is not there")
        sys.exit(77)
    check = pathlib.Path(__file__).with_name("check_export.py")
    with tempfile.TemporaryDirectory(prefix="sightline-map-") as folder:
        for sight in ("closed", "open"):
            baked, export = (pathlib.Path(folder, sight + ending) for ending in (".slv", ".json"))
            run(program, "bake", path, "-o", baked, "--check", "--sight", sight, "--stab-trees",
                *WITHOUT, *options)
            run(program, "export", baked, "--format", "json", "-o", export)
            run(sys.executable, "-B", check, "--sightlines", SIGHTLINES, export)


if __name__ == "__main__":
    main()
