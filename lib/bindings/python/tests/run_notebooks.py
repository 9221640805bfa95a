"""Runs the notebooks: run_notebooks.py PACKAGE [FOLDER]. With a FOLDER, pages are written there.

The exit status is 77 where what runs notebooks is missing.
"""
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile

NOTEBOOKS = pathlib.Path(__file__).resolve().parents[1] / "notebooks"
NEEDED = ("nbconvert", "ipykernel", "numpy", "scipy", "pandas", "geopandas", "matplotlib")


def main():
    missing = [name for name in NEEDED if not importlib.util.find_spec(name)]
    if missing:
        print("skipped: this Python has no", ", ".join(missing))
        return 77
    paths = sorted(NOTEBOOKS.glob("*.ipynb"))
    faults = 0 if len(paths) == 4 else 1
    if not pathlib.Path(os.environ.get("SIGHTLINE_NPM", ""), "level.wasm").is_file():
        paths = [path for path in paths if path.stem != "explorer"]
        print("explorer.ipynb is left out: the npm package is not built (js_package builds it)")
    with tempfile.TemporaryDirectory() as scratch:
        folder = os.path.abspath(sys.argv[2]) if len(sys.argv) > 2 else scratch
        environment = {**os.environ, "PYTHONPATH": os.path.abspath(sys.argv[1]),
                       "SIGHTLINE_MAPS": str(NOTEBOOKS.parents[3] / "maps"),
                       "IPYTHONDIR": os.path.join(scratch, "ipython"),
                       "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
        for path in paths:
            done = subprocess.run(
                [sys.executable, "-m", "nbconvert", "--execute", "--to", "html", "--output-dir",
                 folder, str(path)], env=environment, cwd=scratch, stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT, text=True)
            pictures = 0
            if done.returncode == 0:
                page = pathlib.Path(folder, path.stem + ".html").read_text(encoding="utf-8")
                pictures = page.count('src="data:image/') + page.count("<iframe srcdoc=")
            print(f"{path.name}: {pictures} pictures" if pictures else f"{path.name}: {done.stdout}")
            faults += done.returncode != 0 or not pictures
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
