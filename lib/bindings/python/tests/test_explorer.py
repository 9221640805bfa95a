"""The page of Level.explorer in a browser: what it says of an eye is what the level says."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from support import MAPS, TWO_ROOMS

import sightline

BROWSER = shutil.which("chromium")
NPM = os.environ.get("SIGHTLINE_NPM", "")


class Explorer(unittest.TestCase):
    def test_wrong_arguments_are_named(self):
        level = sightline.Plan.from_segments(TWO_ROOMS).bake()
        with tempfile.TemporaryDirectory() as empty:
            with self.assertRaisesRegex(ValueError, re.escape(empty)):
                level.explorer(package=empty)
        with self.assertRaisesRegex(ValueError, "width"):
            level.explorer(width=-1)
        with self.assertRaisesRegex((TypeError, ValueError), "eye"):
            level.explorer((1, 2, 3), package=NPM)

    @unittest.skipUnless(pathlib.Path(NPM, "level.wasm").is_file(), "the npm package is not built")
    def test_files_of_a_wheel_are_enough(self):
        release = (MAPS.parent / "tools/release.sh").read_text()
        names, = re.findall(r"cp (sightline\.js [\w. ]+) ", release)
        level = sightline.Plan.from_segments(TWO_ROOMS).bake()
        with tempfile.TemporaryDirectory() as folder:
            for name in names.split():
                shutil.copy(pathlib.Path(NPM, name), folder)
            self.assertEqual(level.explorer(package=folder).page, level.explorer(package=NPM).page)

    @unittest.skipUnless(BROWSER and pathlib.Path(NPM, "level.wasm").is_file(), "no Chromium, or the npm package is not built")
    def test_page_says_what_the_level_says(self):
        for name, eye in (("office.map", (53, 20)), ("effects/doors.map", (5.1, 5.03)), ("oblique/chapel.map", (9.3, 12.1))):
            level = sightline.Plan.from_file(MAPS / name).bake()
            said = self.said(level.explorer(eye))
            self.assertEqual(said, f"{eye[0]:.2f}, {eye[1]:.2f}: area {level.region(eye).area:.2f}, "
                                   f"{len(level.look(eye))} cells", name)

    def said(self, explorer):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder, "page.html")
            explorer.save(page)
            done = subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder}/profile",
                                   "--virtual-time-budget=20000", "--dump-dom", page.as_uri()],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=120)
        found = re.search("<output>(.*?)</output>", done.stdout)
        self.assertTrue(found, done.stderr)
        return found[1]
