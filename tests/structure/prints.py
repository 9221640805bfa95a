"""Whether a program prints what a file holds: prints.py FILE PROGRAM [ARGUMENT...]."""
import pathlib
import subprocess
import sys

wanted = pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")
printed = subprocess.run(sys.argv[2:], stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout
if printed != wanted:
    sys.exit(f"wanted:\n{wanted}printed:\n{printed}")
