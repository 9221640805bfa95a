"""A folder of its own for runs of a program, with what must hold after every run checked."""
import contextlib
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

# A sanitizer's finding must not look like a failure of the program's own.
SANITIZERS = {
    "ASAN_OPTIONS": "exitcode=97",
    "LSAN_OPTIONS": "exitcode=98:print_suppressions=0:suppressions="
                    + str(pathlib.Path(__file__).with_name("leaks.supp")),
    "TSAN_OPTIONS": "exitcode=96:suppressions=" + str(pathlib.Path(__file__).with_name("races.supp")),
}


class Fault(Exception):
    """Something that must hold does not."""


def program_argument():
    """The program's path, taken out of a test's command line."""
    return os.path.abspath(sys.argv.pop(1))


def check(holds, what):
    if not holds:
        raise Fault(what)


class Result:
    def __init__(self, status, stdout, stderr, new_files):
        self.status, self.stdout, self.stderr, self.new_files = status, stdout, stderr, new_files

    def text(self):
        return f"status {self.status}\n-- stdout\n{self.stdout}\n-- stderr\n{self.stderr}"


def read_terminal(master):
    """All that is written to a terminal, until nobody can write to it any more."""
    text = b""
    with contextlib.suppress(OSError):  # Linux's way to say so
        while more := os.read(master, 65536):
            text += more
    os.close(master)
    return text


# --- what a process is about, so that a test need not guess how fast the machine is

def process_status(process):
    """The fields of its status from its state on."""
    return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()


def processor_seconds(process):
    """The time of processors that a process has used."""
    fields = process_status(process)
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def has_signal(process, kind, number):
    """Whether a signal is of a kind, as /proc/PID/status names it: SigCgt (caught), ShdPnd (pending)."""
    text = pathlib.Path(f"/proc/{process}/status").read_text()
    return bool(int(re.search(rf"^{kind}:\s*(\w+)", text, re.M)[1], 16) >> number - 1 & 1)


def wait_until(holds, what, seconds=60):
    end = time.monotonic() + seconds
    while not holds():
        check(time.monotonic() < end, f"{seconds} seconds pass, and not yet: {what}")
        time.sleep(0.005)


def wait_for_work(process, seconds=0.5):
    """Until a process has used so much time of processors. The work must be far longer: a process
    that is over by then is a zombie."""
    if not os.path.exists("/proc/self/stat"):
        return time.sleep(seconds)
    wait_until(lambda: processor_seconds(process) >= seconds or process_status(process)[0] == "Z",
               "the process is at work")
    check(process_status(process)[0] != "Z", "the work is over too soon to be interrupted")


def wait_for_signal(process, number):
    """Until a process has taken a signal that was sent: a second one is then one of its own."""
    if not os.path.exists("/proc/self/stat"):
        return time.sleep(0.05)
    wait_until(lambda: not has_signal(process, "ShdPnd", number), "the signal is taken")


def wait_for_sleep(process, number):
    """Until a process that would take a signal waits for something."""
    if not os.path.exists("/proc/self/stat"):
        return time.sleep(0.3)
    wait_until(lambda: has_signal(process, "SigCgt", number) and process_status(process)[0] == "S",
               "the process waits")


class Sandbox:
    """with Sandbox(program) as box: box.run([...])"""

    def __init__(self, program):
        self.program = program

    def __enter__(self):
        self._folder = tempfile.TemporaryDirectory(prefix="sightline-command-")
        self.folder = pathlib.Path(self._folder.name)
        return self

    def __exit__(self, *_):
        self._folder.cleanup()

    def path(self, name):
        path = self.folder / name
        check(self.folder in path.resolve().parents, f"{name} lies outside the test's folder")
        return path

    def files(self):
        return {str(path.relative_to(self.folder)): path.read_bytes() if path.is_file() else None
                for path in self.folder.rglob("*")}

    def start(self, arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
              stderr=subprocess.PIPE, file_limit=None, environment=None, closed=()):
        """The program as a running process. file_limit: no file may grow beyond so many bytes.
        closed: standard streams, by number, that it finds closed."""
        def prepare():
            # Whoever runs the tests in the background has signals ignored; the program must not.
            signal.signal(signal.SIGINT, signal.SIG_DFL)
            signal.signal(signal.SIGTERM, signal.SIG_DFL)
            if file_limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (file_limit, file_limit))
            for number in set(closed) | ({1} if stdout is None else set()):
                os.close(number)
        variables = dict(os.environ, TERM="xterm")
        for name, options in SANITIZERS.items():
            variables[name] = ":".join(filter(None, (variables.get(name), options)))
        return subprocess.Popen([self.program, *arguments], cwd=self.folder,
                                env=dict(variables, **(environment or {})),
                                stdin=stdin, stdout=stdout, stderr=stderr,
                                preexec_fn=prepare)

    def run(self, arguments, timeout=120, **how):
        before = self.files()
        process = self.start(arguments, **how)
        return self.finish(process, before, timeout)

    def finish(self, process, before, timeout=120):
        """Waits for the end and checks what holds for every run."""
        try:
            stdout, stderr = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            raise Fault(f"does not end within {timeout} seconds")
        after = self.files()
        result = Result(process.returncode, (stdout or b"").decode(errors="replace"),
                        stderr.decode(errors="replace"), sorted(set(after) - set(before)))
        try:
            self._check(result, before, after)
        except Fault as fault:
            raise Fault(f"{fault}\n{result.text()}")
        return result

    @staticmethod
    def _check(result, before, after):
        check(result.status in (0, 1, 2, 3), f"ends with status {result.status}")
        check(not set(before) - set(after), f"removed {sorted(set(before) - set(after))}")
        check(not re.search(r"[\0-\t\v-\x1f\x7f-\x9f]", result.stderr),
              "a control character on stderr")
        told = [line for line in result.stderr.splitlines() if not line.startswith("note: ")]
        if result.status in (0, 3):  # 3: the work was done, and a fault found
            check(not told, "done, and yet something is said on stderr")
            return
        changed = [name for name in after if name not in before or after[name] != before[name]]
        check(not changed, f"failed, and yet wrote {changed}")
        check(len(told) == 1 and re.match(r"sightline: .*[^\s.:]$", told[0]),
              "failed without one line 'sightline: what is wrong' on stderr")


class ProgramTest(unittest.TestCase):
    """Tests of the program that the command line names, each in a sandbox of its own."""
    program = None

    def setUp(self):
        self.box = Sandbox(self.program)
        self.box.__enter__()
        self.addCleanup(self.box.__exit__)

    def run_well(self, *arguments, **how):
        result = self.box.run([str(argument) for argument in arguments], **how)
        self.assertEqual(result.status, 0, result.text())
        return result

    def printed(self, *arguments):
        return self.run_well(*arguments).stdout


def main():
    ProgramTest.program = program_argument()
    unittest.main()
