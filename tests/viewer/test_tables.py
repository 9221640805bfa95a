"""Tables of the Plan mode beside those of the command: VIEW SAME ROOT SIGHTLINE.

The viewer's table of axial lines, of segments and of the visibility graph is what `sightline axial`,
`segments` and `vga` write for the same plan. Each is exported through the dialog, by keys.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

from viewing import Viewer


def export(keys, path):
    return f"{keys}key Ctrl+Shift+E\nkey Ctrl+A\ntype {path}\nkey Return\nexpect written to\n"


PROGRAM = pathlib.Path(sys.argv[4]).resolve()


def command(viewer, folder, *arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments), "--quiet"], cwd=folder, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60)
    viewer.check(done.returncode == 0, f"sightline {arguments[0]}: {done.stderr}")


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def check_same(viewer, folder, name):
    """Each column of the viewer's table is one of the command's, with the same values."""
    shown, told = rows(folder / f"{name}-shown.csv"), rows(folder / f"{name}.csv")
    viewer.check(len(shown) == len(told) > 0, f"{name}: {len(shown)} rows, not {len(told)}")
    for one, other in zip(shown, told):
        wrong = [key for key in one if one[key] != other.get(key)]
        viewer.check(not wrong, f"{name}: {wrong} of {one} are others in {other}")
        if wrong:
            return
    viewer.check(bool(shown) and len(shown[0]) > 6, f"{name}: only {len(shown[0])} columns")


def check_map(viewer, folder, plan):
    viewer.script(folder, plan, "key 9\n" + export("key Ctrl+5\n", folder / "axial-shown.csv") +
                  export("key Ctrl+6\n", folder / "segments-shown.csv") +
                  export("key Ctrl+2\n", folder / "vga-shown.csv"))
    step = float(rows(folder / "vga-shown.csv")[1]["y"]) - float(rows(folder / "vga-shown.csv")[0]["y"])
    command(viewer, folder, "axial", viewer.root / "maps" / plan, "-o", "axial.csv")
    command(viewer, folder, "segments", "axial.csv", "-o", "segments.csv")
    command(viewer, folder, "vga", viewer.root / "maps" / plan, "--grid", f"{step:.6g}", "--measures", "visual",
            "-o", "vga.csv")
    for name in ("axial", "segments", "vga"):
        check_same(viewer, folder, name)


TWO_PARTS = "sightline 1\nwalls 0 0 12 0 12 8 0 8 0 0\nwalls 8 0 8 8\n"


def check_parts(viewer, folder):
    """A plan of two parts that no sightline joins: the last column tells them apart."""
    plan = folder / "two.map"
    plan.write_text(TWO_PARTS)
    viewer.script(folder, plan, "key 9\n" + export("key Ctrl+2\n", folder / "vga-shown.csv"))
    shown = rows(folder / "vga-shown.csv")
    step = float(shown[1]["y"]) - float(shown[0]["y"])
    command(viewer, folder, "vga", plan, "--grid", f"{step:.6g}", "--measures", "visual", "-o", "vga.csv")
    check_same(viewer, folder, "vga")
    viewer.check({row["part"] for row in shown} == {"1", "2"}, "the table has no two parts")


# In the office: a wall stands elsewhere, and another one is gone.
BEFORE = ["wall 20 0 20 6.5\n", "wall 44 0 44 6.5\n"]
AFTER = ["wall 22 0 22 6.5\n", ""]


def check_changes(viewer, folder):
    """The table of changes is that of `sightline vga --compare`, for the points of the first plan."""
    plan = viewer.root / "maps/office.map"
    text = plan.read_text()
    for before, after in zip(BEFORE, AFTER):
        viewer.check(before in text, f"the office has no '{before.strip()}'")
        text = text.replace(before, after)
    other = folder / "other.map"
    other.write_text(text)
    viewer.script(folder, "office.map",
                  f"key 9\nkey Ctrl+7\nkey Ctrl+A\ntype {other}\nkey Return\n" +
                  export("key 1\n", folder / "shown.csv"))
    command(viewer, folder, "vga", plan, "--compare", other, "--grid", "1", "--measures", "visual", "-o",
            "told.csv")
    told = {(row["x"], row["y"]): row for row in rows(folder / "told.csv")}
    shown = rows(folder / "shown.csv")
    changed = 0
    for row in shown:
        same = told.get((row["x"], row["y"]), {})
        wrong = [key for key in row if row[key] != same.get(key)]
        viewer.check(not wrong, f"changes: {wrong} of {row} are others in {same}")
        changed += row["visual_integration_hh_change"] not in ("", "0")
        if wrong:
            break
    viewer.check(changed > 1000, f"changes at {changed} of {len(shown)} places")


def main():
    viewer = Viewer(sys.argv)
    for plan in ("office.map", "oblique/comb.map"):
        with tempfile.TemporaryDirectory() as name:
            check_map(viewer, pathlib.Path(name), plan)
    with tempfile.TemporaryDirectory() as name:
        check_changes(viewer, pathlib.Path(name))
    with tempfile.TemporaryDirectory() as name:
        check_parts(viewer, pathlib.Path(name))
    viewer.end()


if __name__ == "__main__":
    main()
