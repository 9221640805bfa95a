"""What goes wrong is told in one clear line, with status 1 or 2: VIEW SAME ROOT."""
import pathlib
import re
import sys
import tempfile

from viewing import Viewer, environment


def main():
    viewer = Viewer(sys.argv)
    office = viewer.root / "maps/office.map"

    def fails(status, words, *arguments, **more):
        done = viewer.run(*arguments, **more)
        said = done.stderr.strip()
        viewer.check(done.returncode == status and words in said and said.count("\n") == 0 and
                     said.startswith("sightline-view: ") and not done.stdout,
                     f"{arguments}: status {done.returncode}, {done.stdout!r}, {said!r}")

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        out = folder / "out.png"
        nowhere = environment(DISPLAY=":9999")
        nowhere.pop("WAYLAND_DISPLAY", None)
        broken = folder / "broken.map"
        broken.write_text("sightline 1\nwall 0 0 1\n")
        cut = folder / "cut.slv"
        cut.write_bytes(b"SLV")
        fails(1, "no display", office, env=nowhere)
        fails(2, "missing.map", folder / "missing.map", "--screenshot", out)
        fails(2, "broken.map:2", broken, "--screenshot", out)
        unset = {name: value for name, value in nowhere.items()
                 if name not in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")}
        for map_file in (office, broken):
            done = viewer.run(map_file, env=unset)
            viewer.check(done.returncode == 1 and "no display" in done.stderr,
                         f"without a display: status {done.returncode}, {done.stderr!r}")
        fails(2, "cut.slv", cut, "--screenshot", out)
        fails(2, "--nonsense: no such option", "--nonsense")
        fails(2, "--doors=1: takes no argument", office, "--doors=1")
        fails(2, "--slice: an argument is missing", office, "--slice")
        fails(2, "one map at a time", office, office)
        fails(2, "--slice tall", office, "--slice", "tall")
        fails(2, "--start 3", office, "--start", "3")
        fails(2, "--start 1,2,3", office, "--start", "1,2,3")
        fails(2, "--threshold 2", office, "--threshold", "2")
        for width in ("0", "-1", "wide", "nan"):
            fails(2, f"--entrance {width}: a number over 0 is needed", office, "--entrance", width)
        for width in ("1e-200", "1e200"):
            fails(2, "a number from 1e-150 to 1e+150", office, "--entrance", width,
                  "--screenshot", out)
        fails(2, "has no use for it", office, "--doors", "--screenshot", out)
        fails(2, "outside", office, "--start", "1e6,1e6", "--screenshot", out)
        fails(2, "ends in .png", office, "--screenshot", folder / "out.gif")
        fails(2, "missing.txt", office, "--script", folder / "missing.txt")
        for line, words in [("dance", "no command is called 'dance'"),
                            ("key F24", "no action has the key 'F24'"),
                            ("action dance", "no action is called"),
                            ("click 1", "wrong operands"), ("click 1 2 3", "wrong operands"),
                            ("size 1 1", "a size is"), ("screenshot", "needs an operand"),
                            ("eye 1", "eye needs"), ("open nothing.map", "nothing.map"),
                            ("export frames", "nothing was recorded")]:
            script = folder / "script.txt"
            script.write_text(f"# a comment\n{line}\n")
            done = viewer.run(office, "--script", script, cwd=folder)
            viewer.check(done.returncode in (1, 2) and words in done.stderr,
                         f"{line}: status {done.returncode}, {done.stderr!r}")
        viewer.check(not out.exists(), "a picture of a failure")
        told = viewer.run("--help")
        viewer.check(told.returncode == 0 and "--screenshot" in told.stdout, "--help")
        for option, argument in re.findall(r"--([a-z]+)(?: ([A-Z]\S*?))?[],\s]", told.stdout):
            taken = viewer.run(f"--{option}", *(["1"] if argument else []), "--help")
            viewer.check("no such option" not in taken.stderr, f"--{option} is not taken")
        told = viewer.run("--version")
        viewer.check(told.returncode == 0 and told.stdout.startswith("sightline-view "), "--version")
    viewer.end()


if __name__ == "__main__":
    main()
