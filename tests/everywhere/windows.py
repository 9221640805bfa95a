"""What only Windows has, tried with the command under Wine: threads of its own, Ctrl-C, files that are open
elsewhere, lines that end in CR LF, backslashes, drives, and names in its own encoding."""
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "command"))
from test_interrupt import endless  # noqa: E402

MAP = "maps/effects/chambers.map"


class Fault(Exception):
    """A check that found something else than it should."""


class Windows:
    """The command, a folder to write to, and a Wine of its own."""

    def __init__(self, program, folder, source):
        self.program, self.source = program, source
        self.folder = folder / "files"
        self.folder.mkdir(exist_ok=True)
        for file in self.folder.iterdir():
            file.unlink()
        prefix = folder / "prefix"
        self.environment = dict(os.environ, WINEDEBUG="-all", WINEPREFIX=str(prefix), WINEDLLOVERRIDES="mscoree=;mshtml=")
        if not prefix.exists():
            subprocess.run(["wine", "wineboot", "-i"], env=self.environment, capture_output=True, check=True)
        drive = prefix / "dosdevices" / "t:"  # its root takes no files
        if not drive.is_symlink():
            drive.symlink_to("/sys")

    def start(self, *arguments, **more):
        return subprocess.Popen(["wine", *map(str, arguments)], env=self.environment, stdin=subprocess.PIPE,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                **{"cwd": self.folder, **more})

    def run(self, *arguments, status=0, **more):
        """Runs the command; its standard output and error."""
        with self.start(self.program, *arguments, **more) as process:
            out, error = process.communicate(timeout=120)
        if process.returncode != status:
            raise Fault(f"{' '.join(map(str, arguments))}: status {process.returncode}, not {status}: {error}")
        return out, error

    def bake(self, name, output, *options, **more):
        self.run("bake", name, "-o", output, "--quiet", *options, **more)
        return (self.folder / output).read_bytes()

    def corpus(self, name=MAP):
        return (self.source / name).read_bytes()


def path_by_drive(path):
    return "Z:" + str(path).replace("/", "\\")


def must(condition, what):
    if not condition:
        raise Fault(what)


def threads_of_windows_share_the_work(windows):
    (windows.folder / "a.map").write_bytes(windows.corpus())
    one = windows.bake("a.map", "one.slv", "--threads", "1")
    must(windows.bake("a.map", "four.slv", "--threads", "4") == one, "four threads give other bytes")


def lines_may_end_in_cr_lf(windows):
    text = windows.corpus()
    must(b"\r" not in text and text.count(b"\n") > 5, f"{MAP} shows nothing")
    (windows.folder / "lf.map").write_bytes(text)
    (windows.folder / "crlf.map").write_bytes(text.replace(b"\n", b"\r\n"))
    must(windows.bake("lf.map", "lf.slv") == windows.bake("crlf.map", "crlf.slv"), "CR LF gives other bytes")


def lines_are_written_as_elsewhere(windows):
    out, _ = windows.run("generate", "maze", "--walls", "100")
    must(out.count(b"\n") > 50 and b"\r" not in out, "standard output has CR")
    windows.run("generate", "maze", "--walls", "100", "-o", "maze.map")
    must((windows.folder / "maze.map").read_bytes() == out, "a file is not what standard output is")


def paths_have_drives_and_backslashes(windows):
    windows.run("bake", path_by_drive(windows.source / MAP), "--quiet")
    must((windows.folder / "chambers.slv").exists(), "the baked file is not in the current folder")
    _, error = windows.run("bake", path_by_drive(windows.folder / "none.map"), status=2)
    must(b"\\none.map" in error, f"a missing file is not named: {error}")


def names_have_all_letters(windows):
    windows.run("generate", "maze", "--walls", "100", "-o", "Grundriß-κάτοψη.map")
    windows.bake("Grundriß-κάτοψη.map", "Grundriß-κάτοψη.slv")


def a_file_open_elsewhere_stays(windows):
    """Nothing may replace it; once it is closed, it can be."""
    (windows.folder / "a.map").write_bytes(windows.corpus())
    held = windows.folder / "held.slv"
    with windows.start("cmd", "/c", "pause > held.slv") as holder:
        for _ in range(100):
            if held.exists() and held.stat().st_size:
                break
            time.sleep(0.1)
        before = held.read_bytes()
        _, error = windows.run("bake", "a.map", "-o", "held.slv", status=1)
        must(b"held.slv" in error, f"the message does not name the file: {error}")
        must(held.read_bytes() == before, "a file that is open elsewhere was changed")
        must(not list(windows.folder.glob("held.slv.*")), "a temporary file stayed")
        holder.communicate(b"\r\n", timeout=60)
    windows.bake("a.map", "held.slv")
    must(held.read_bytes() != before, "a file that was closed is not replaced")


def ctrl_c_leaves_no_file(windows):
    (windows.folder / "large.map").write_text(endless())
    with windows.start(windows.program, "bake", "large.map", "-o", "large.slv", "--method",
                       "dfs") as process:
        time.sleep(3)
        must(process.poll() is None, f"the bake was too short: {process.poll()}")
        process.send_signal(signal.SIGINT)  # Wine makes it Ctrl-C
        _, error = process.communicate(timeout=60)
    must(process.returncode != 0, "a bake that was stopped says that it is done")
    left = [file.name for file in windows.folder.glob("large.slv*")]
    must(not left, f"Ctrl-C left {left}: {error}")


def nothing_is_written_elsewhere(windows):
    """The folder that is the current one and the root of its drive take no files."""
    (windows.folder / "a.map").write_bytes(windows.corpus())
    windows.run("bake", path_by_drive(windows.folder / "a.map"), "-o", path_by_drive(windows.folder / "far.slv"),
                 cwd="/sys/kernel")


CHECKS = [threads_of_windows_share_the_work, lines_may_end_in_cr_lf, lines_are_written_as_elsewhere,
          paths_have_drives_and_backslashes, names_have_all_letters, a_file_open_elsewhere_stays,
          ctrl_c_leaves_no_file, nothing_is_written_elsewhere]


def run_all(program, folder, source):
    """How many of the checks hold, of how many; what fails is told."""
    windows = Windows(program, folder, source)
    passed = 0
    for check in CHECKS:
        try:
            check(windows)
            passed += 1
        except (Fault, OSError, subprocess.SubprocessError) as fault:
            print(f"windows: {check.__name__}: {fault}", file=sys.stderr)
    return passed, len(CHECKS)


if __name__ == "__main__":  # windows.py PROGRAM FOLDER
    passed, total = run_all(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(),
                            Path(__file__).resolve().parents[2])
    print(f"{passed} of {total}")
    sys.exit(passed != total)
