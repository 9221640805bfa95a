"""The package as pip builds it, from a copy of its sources and without a network."""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import sightline
import support


@unittest.skipUnless(all(importlib.util.find_spec(name) for name in ("pip", "setuptools", "wheel")),
                     "this Python has no pip, setuptools or wheel")
class Wheel(unittest.TestCase):
    def test_a_wheel_holds_the_package(self):
        built = pathlib.Path(sightline.__file__).parent
        with tempfile.TemporaryDirectory() as scratch:
            copy, headers = (pathlib.Path(scratch, "lib", folder)
                             for folder in ("bindings/python", "include/sightline"))
            shutil.copytree(support.ROOT / "lib/bindings/python", copy,
                            ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
            headers.mkdir(parents=True)
            shutil.copy(support.ROOT / "lib/include/sightline/version.h", headers)
            environment = {**os.environ,
                           "SIGHTLINE_PYTHON_LIBRARY": str(built / "libsightline_python.so")}
            environment.pop("LD_PRELOAD", None)
            done = subprocess.run(
                [sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-index",
                 "--no-deps", "--quiet", "--wheel-dir", scratch, str(copy)],
                env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertEqual(done.returncode, 0, done.stdout)
            wheel, = pathlib.Path(scratch).glob("*.whl")
            self.assertIn(f"sightline-{sightline.__version__}-py3-none-", wheel.name)
            place = pathlib.Path(scratch, "place")
            shutil.unpack_archive(str(wheel), str(place), "zip")
            names = {path.name for path in (place / "sightline").iterdir()}
            self.assertEqual(names, {path.name for path in built.iterdir()
                                     if path.name != "__pycache__"})
            ours = (place / "sightline/level.py").read_bytes()
            self.assertEqual(ours, (support.ROOT / "lib/bindings/python/sightline/level.py")
                             .read_bytes())


if __name__ == "__main__":
    unittest.main()
