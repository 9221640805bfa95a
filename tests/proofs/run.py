"""Runs the proofs of this folder with CBMC; README.md says what they prove.

run.py [--cbmc PROGRAM] [--self-test] [FILE.c...]
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
LIBRARY = HERE.parent.parent / "lib"
CHECKS = ["--bounds-check", "--pointer-check", "--div-by-zero-check",
          "--signed-overflow-check", "--undefined-shift-check", "--unwinding-assertions",
          "--slice-formula", "--unwindset", "slrt_u64.0:9,slrt_u32.0:5"]


# Loops over the bytes of a number have their own bounds, others that of the file.


def prove(cbmc, path, name, broken):
    """Whether all that a function says holds; None where CBMC gives no answer."""
    unwind = re.search(r"^// unwind (\d+)$", path.read_text(), re.M).group(1)
    command = [cbmc, str(path), "--function", name, "--unwind", unwind, *CHECKS,
               "-I", str(LIBRARY), "-I", str(LIBRARY / "include")]
    if broken:
        command.append("-DBROKEN")
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode == 0 and "VERIFICATION SUCCESSFUL" in result.stdout:
        return True
    if result.returncode == 10:
        if not broken:
            print("\n".join(re.findall(r"^.*: FAILURE$", result.stdout, re.M)))
        return False
    print(result.stdout[-2000:], result.stderr[-2000:])
    return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--cbmc", default="cbmc")
    parser.add_argument("--self-test", action="store_true",
                        help="move each block by a byte: all proofs must fail")
    parser.add_argument("files", nargs="*")
    options = parser.parse_args()
    cbmc = shutil.which(options.cbmc)
    if not cbmc:
        print("skipped: there is no cbmc")
        return 77
    paths = [pathlib.Path(f).resolve() for f in options.files] or sorted(HERE.glob("*.c"))
    wrong = 0
    for path in paths:
        for name in re.findall(r"^void (\w+)\(void\) \{", path.read_text(), re.M):
            began = time.monotonic()
            holds = prove(cbmc, path, name, options.self_test)
            wrong += holds is not (not options.self_test)
            said = {True: "holds", False: "fails", None: "no answer"}[holds]
            print(f"{path.stem}: {name}: {said}, "
                  f"{time.monotonic() - began:.0f} s", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
