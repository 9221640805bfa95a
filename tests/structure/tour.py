"""Runs every `sightline` line of README.md as it stands there: tour.py ROOT FOLDER_OF_THE_COMMAND."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

root, command = (pathlib.Path(each).resolve() for each in sys.argv[1:])
lines = re.findall(r"^sightline .*", (root / "README.md").read_text(encoding="utf-8"), re.MULTILINE)
if not lines:
    sys.exit("README.md has no line to run")
with tempfile.TemporaryDirectory() as scratch:
    (pathlib.Path(scratch) / "maps").symlink_to(root / "maps")
    path = f"{command}{os.pathsep}{os.environ['PATH']}"
    for line in lines:
        print(line, flush=True)
        subprocess.run(line, shell=True, check=True, cwd=scratch, env={**os.environ, "PATH": path})
