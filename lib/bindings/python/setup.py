"""Builds the library of the package with CMake, in the project that this folder is a part of, or in the
copy of it that a source distribution carries.

SIGHTLINE_PYTHON_LIBRARY names a library that is built already, to be taken as it is.
"""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

try:
    from wheel.bdist_wheel import bdist_wheel
except ImportError:
    from setuptools.command.bdist_wheel import bdist_wheel

HERE = pathlib.Path(__file__).resolve().parent
CARRIED = HERE / "project"
ROOT = CARRIED if CARRIED.is_dir() else HERE.parents[2]
NAME = "libsightline_python.so"
# One library with all that it needs of the project; nothing else is built.
OPTIONS = ["-DCMAKE_BUILD_TYPE=Release", "-DBUILD_SHARED_LIBS=OFF", "-DSIGHTLINE_PYTHON=ON",
           "-DSIGHTLINE_ANALYSIS=ON", "-DSIGHTLINE_IO=ON", *(f"-DSIGHTLINE_{part}=OFF" for part in
                                  ("STUDY", "GLPK", "DRAW", "LEVEL", "TOOLS", "VIEWER", "TESTS", "INSTALL"))]


def version():
    text = (ROOT / "lib/include/sightline/version.h").read_text(encoding="utf-8")
    return ".".join(re.search(rf"^#define SL_VERSION_{part} +(\d+)", text, re.MULTILINE)[1]
                    for part in ("MAJOR", "MINOR", "PATCH"))


def build_library(folder):
    subprocess.run(["cmake", "-S", str(ROOT), "-B", folder, *OPTIONS], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "sightline_python_library",
                    "--parallel", str(os.cpu_count() or 1)], check=True)
    return pathlib.Path(folder, "lib/bindings/python/sightline", NAME)


class BuildWithLibrary(build_py):
    def run(self):
        super().run()
        target = pathlib.Path(self.build_lib, "sightline", NAME)
        with tempfile.TemporaryDirectory() as scratch:
            shutil.copy(os.environ.get("SIGHTLINE_PYTHON_LIBRARY") or build_library(scratch), target)


class WithProject(sdist):
    """What the library is built of goes along: no file is looked for beside the archive."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        carried = pathlib.Path(base_dir, CARRIED.name)
        left_out = shutil.ignore_patterns("js", "level", "notebooks", "bench", "tests", "project", "build",
                                          "*.egg-info", "__pycache__", "*.so")
        shutil.copytree(ROOT / "lib", carried / "lib", ignore=lambda folder, names: (
            left_out(folder, names) if "bindings" in pathlib.Path(folder).parts else ()))
        shutil.copy(ROOT / "CMakeLists.txt", carried)
        shutil.copy((HERE if ROOT == CARRIED else ROOT) / "LICENSE", base_dir)


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return True


class WheelForThisMachine(bdist_wheel):
    """The library is of this machine, and of no version of Python."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


setup(version=version(), distclass=WithLibrary,
      cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": WheelForThisMachine, "sdist": WithProject})
