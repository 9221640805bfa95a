"""Help in all its forms says the same, fits a terminal, and is what shells complete: test_help.py PROGRAM"""
import pathlib
import re
import shutil
import subprocess
import sys

import sandbox

COMPLETION = pathlib.Path(__file__).resolve().parents[2] / "tools/completion"


def words(text):
    return [line.split("\t") for line in text.splitlines()]


class Help(sandbox.ProgramTest):
    def setUp(self):
        super().setUp()
        self.commands = [row[0] for row in words(self.printed("--help", "words"))]
        self.assertIn("bake", self.commands)

    def test_lines_fit_a_terminal(self):
        for arguments in [[], *([name] for name in self.commands)]:
            for form in [[], ["all"]]:
                for line in self.printed(*arguments, "--help", *form).splitlines():
                    self.assertLess(len(line), 80, f"{arguments} {form}: {line}")

    def test_all_forms_have_all_options(self):
        for name in self.commands:
            everything, manual = self.printed(name, "--help", "all"), self.printed(name, "--help", "man")
            short = set(re.findall(r"^  (?:-\w, )?(--[\w-]+)", self.printed(name, "--help"), re.MULTILINE))
            options = [row[0] for row in words(self.printed(name, "--help", "words"))]
            self.assertIn("--help", options)
            self.assertLessEqual(short, set(options))
            self.assertLessEqual(len(short), 22, name)
            for option in options:
                self.assertRegex(everything, rf"(?m)^  (-\w, )?{option}\b")
                self.assertIn(option.replace("-", "\\-"), manual)

    def test_manual_pages_are_clean(self):
        if not shutil.which("groff"):
            self.skipTest("there is no groff")
        for name in ["", *self.commands]:
            page = self.printed(*([name] if name else []), "--help", "man")
            done = subprocess.run(["groff", "-man", "-ww", "-Tascii", "-z"], input=page, text=True,
                                  capture_output=True, check=False)
            self.assertEqual(done.stderr, "", name)

    def test_bash_completes(self):
        if not shutil.which("bash"):
            self.skipTest("there is no bash")
        for typed, wanted in [(["bak"], "bake"), (["bake", "--stab"], "--stab-trees"),
                              (["bake", "--subdivide", "m"], "mesh"), (["bake", "--method", "sw"], "sweep")]:
            script = (f". {COMPLETION}/sightline.bash; COMP_WORDS=({self.program} {' '.join(typed)}); "
                      f"COMP_CWORD={len(typed)}; _sightline; echo \"${{COMPREPLY[*]}}\"")
            done = subprocess.run(["bash", "-c", script], text=True, capture_output=True, check=True)
            self.assertEqual(done.stdout.strip(), wanted)


if __name__ == "__main__":
    sandbox.main()
