"""The package as pip builds it, from a copy of its sources and without a network."""
import importlib.metadata
import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import sightline
import support

# What setup.py would build, without building it.
ASKED = """
import json, runpy, setuptools
setuptools.setup = lambda **_: None
package = runpy.run_path("setup.py")
print(json.dumps([str(package["ROOT"]), package["version"](), package["OPTIONS"]]))
"""


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

    def test_a_source_distribution_needs_nothing_beside_it(self):
        with tempfile.TemporaryDirectory() as scratch:
            clone, made = pathlib.Path(scratch, "clone"), pathlib.Path(scratch, "made")
            shutil.copytree(support.ROOT / "lib", clone / "lib")
            for name in ("CMakeLists.txt", "LICENSE"):
                shutil.copy(support.ROOT / name, clone)
            done = subprocess.run([sys.executable, "setup.py", "--quiet", "sdist", "--dist-dir", str(made)],
                                  cwd=clone / "lib/bindings/python", stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True)
            self.assertEqual(done.returncode, 0, done.stdout)
            shutil.rmtree(clone)
            name = f"sightline-{sightline.__version__}"
            shutil.unpack_archive(str(made / f"{name}.tar.gz"), str(made))
            done = subprocess.run([sys.executable, "-c", ASKED], cwd=made / name, stdout=subprocess.PIPE,
                                  text=True, check=True)
            root, version, options = json.loads(done.stdout)
            self.assertEqual((root, version), (str((made / name / "project").resolve()), sightline.__version__))
            self.assertTrue((made / name / "LICENSE").is_file())
            done = subprocess.run(["cmake", "-S", root, "-B", pathlib.Path(scratch, "build"), *options],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertEqual(done.returncode, 0, done.stdout)


class Metadata(unittest.TestCase):
    def test_a_build_by_cmake_says_what_it_is(self):
        said = importlib.metadata.metadata("sightline")
        project = (support.ROOT / "lib/bindings/python/pyproject.toml").read_text(encoding="utf-8")
        self.assertEqual(said["Version"], sightline.__version__)
        self.assertIn(f'description = "{said["Summary"]}"', project)
        self.assertIn(f'requires-python = "{said["Requires-Python"]}"', project)
        self.assertIn(f"\ndependencies = {json.dumps(said.get_all('Requires-Dist'))}\n", project)


if __name__ == "__main__":
    unittest.main()
