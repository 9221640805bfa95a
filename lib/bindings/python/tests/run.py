"""Runs the tests of the Python package: run.py PACKAGE [COMMAND].

PACKAGE is the folder that has the package, COMMAND the program `sightline` to compare with. The exit
status is 77 where a module is missing that all tests need.
"""
import os
import sys
import unittest


def main():
    sys.path[:0] = [sys.argv[1], os.path.dirname(os.path.abspath(__file__))]
    if len(sys.argv) > 2:
        os.environ["SIGHTLINE_COMMAND"] = sys.argv[2]
    try:
        import numpy  # noqa: F401
    except ImportError:
        print("skipped: this Python has no numpy (Debian: apt-get install python3-numpy)")
        return 77
    os.environ.setdefault("MPLBACKEND", "Agg")
    tests = unittest.defaultTestLoader.discover(os.path.dirname(os.path.abspath(__file__)))
    return not unittest.TextTestRunner(verbosity=1).run(tests).wasSuccessful()


if __name__ == "__main__":
    sys.exit(main())
