"""That a case can fail: each of these must, and say why. The program is the shell."""
import unittest

import case
import sandbox

FAILING = {
    "wrong status": ("run -c 'exit 0'\nstatus 1\n", "status 1 is due"),
    "no such status": ("run -c 'exit 4'\nstatus 4\n", "ends with status 4"),
    "killed": ("run -c 'kill -9 $$'\nstatus 1\n", "ends with status -9"),
    "stdout lacks": ("run -c 'echo one'\nstatus 0\nstdout two\n", "stdout lacks two"),
    "stderr lacks": ("run -c 'echo note: one >&2'\nstatus 0\nstderr two\n", "stderr lacks two"),
    "unasked stdout": ("run -c 'echo one'\nstatus 0\n", "stdout should be empty"),
    "unasked note": ("run -c 'echo note: one >&2'\nstatus 0\n", "stderr should be empty"),
    "talks on stderr": ("run -c 'echo one >&2'\nstatus 0\nstderr one\n", "something is said"),
    "plays tricks": ("run -c 'echo \"sightline: \\033[2J\" >&2; exit 1'\nstatus 1\nstderr a\n",
                     "a control character"),
    "silent failure": ("run -c 'exit 1'\nstatus 1\n", "without one line"),
    "two lines": ("run -c 'echo sightline: a >&2; echo sightline: b >&2; exit 1'\nstatus 1\n"
                  "stderr a\n", "without one line"),
    "failed and wrote": ("run -c 'echo > new; echo sightline: a >&2; exit 1'\nstatus 1\nstderr a\n",
                         "failed, and yet wrote"),
    "failed and changed": ("file old\n| a\nrun -c 'echo > old; echo sightline: a >&2; exit 1'\n"
                           "status 1\nstderr a\n", "failed, and yet wrote"),
    "removed": ("file old\n| a\nrun -c 'rm old'\nstatus 0\n", "removed"),
    "made nothing": ("run -c 'exit 0'\nstatus 0\nmakes new\n", "new is not there"),
    "made another": ("run -c 'echo a > new'\nstatus 0\nmakes new b\n", "does not start with b"),
    "made more": ("run -c 'echo > new'\nstatus 0\n", "also wrote"),
    "not the same": ("file a\n| a\nfile b\n| b\nrun -c 'exit 0'\nstatus 0\nsame a b\n", "differ"),
    "wrote without room": ("run-limited 8 -c 'echo 1234567890 > new'\nstatus 0\nmakes new\n",
                           "status"),
}


def play(text):
    with sandbox.Sandbox("/bin/sh") as box:
        case.Case(box, text).play()


class CasesCanFail(unittest.TestCase):
    def test_failing(self):
        for name, (text, reason) in FAILING.items():
            with self.subTest(name):
                with self.assertRaises(sandbox.Fault) as caught:
                    play(text)
                self.assertIn(reason, str(caught.exception))

    def test_malformed(self):
        for text in ("", "walk on\n", "run -c 'exit 0'\n"):
            with self.subTest(text):
                with self.assertRaises(case.Malformed):
                    play(text)

    def test_passing(self):
        play("file old\n| a\n# a comment\nrun -c 'echo done; echo note: b >&2; cp old new'\n"
             "status 0\nstdout ^done$\nstderr b\nmakes new a\nsame old new\n"
             "run -c 'echo sightline: no >&2; exit 2'\nstatus 2\nstderr no$\n")


if __name__ == "__main__":
    unittest.main()
