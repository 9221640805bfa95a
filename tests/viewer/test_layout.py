"""Every text in its panel, and on no other one, at each size: VIEW SAME ROOT [--pictures FOLDER] [--brief].

--pictures also saves a picture of each window, to be looked at. --brief: of sizes and of texts the
smallest and the largest alone. Then keys alone: what a pointer does, the focus, the cursor and the
fields do too.
"""
import itertools
import pathlib
import sys
import tempfile

from viewing import TOLERANCE, Viewer

SIZES = ["640 480", "800 600", "1280 800", "1920 1080"]
TEXTS = ["1", "1.5", "2", "3"]

# name: (map, script)
SCENES = {
    "explore": ("office.map", "eye 53 20 160 90\nkey V\n"),
    "panes": ("office.map", "eye 53 20 160 90\nkey X\nkey L\nkey I\n"),
    "rock": ("dungeon.txt", "eye 7.5 14.5 0\n"),
    "layers": ("office.map", "key Q\nkey F5\nkey B\nkey K\n"),
    "heat": ("office.map", "key 1\nkey 7\n"),
    "heat_over_plan": ("office.map", "action side_panel\nkey F5\nkey 1\n" + "key 3\n" * 4),
    "search": ("office.map", "eye 53 20 160\nkey F2\n" + "key Right\n" * 4),
    "program": ("office.map", "eye 53 20 160\nkey F2\nkey R\nkey R\nkey Ctrl+L\n"),
    "why": ("office.map", "eye 53 20 160 90\nright 100 200\n"),
    "subdivision": ("maze.map", "key F2\nkey U\nkey Right\n"),
    "pass": ("maze.map", "key F2\nkey U\nkey U\nkey Right\n"),
    "draw": ("office.map", "key F3\n"),
    "cameras": ("office.map", "key 8\nclick 200 300\nkey ,\nclick 300 340\nkey B\n"),
    "plan": ("office.map", "key 9\nkey Ctrl+2\naction heat_ranks\n"),
    "path": ("office.map", "key 9\nkey Ctrl+3\nclick 100 250\nclick 200 300\n"),
    "axial": ("office.map", "key 9\nkey Ctrl+5\naction heat_ranks\n"),
    "table": ("office.map", "key 9\nkey Ctrl+6\nkey Ctrl+L\n"),
    "compare": ("office.map", "key 9\nkey Ctrl+7\nkey Ctrl+A\ntype {maps}/courtyard.map\nkey Return\nkey 1\n"),
    "from_line": ("office.map", "key 9\nkey Ctrl+4\ndrag 100 250 130 280\n"),
    "fewest": ("oblique/comb.map", "key 8\nkey Space\n"),
    "tables": ("office.map", "key 8\nkey Ctrl+Shift+O\n"),
    "fisk": ("oblique/comb.map", "key F2\n" + "key U\n" * 4 + "key End\n"),
    "quiz": ("office.map", "key F4\nkey N\n"),
    "help": ("office.map", "key ?\n"),
    "browser": ("office.map", "key O\n"),
    "menu": ("office.map", "key Ctrl+M\n"),
    "options": ("office.map", "key Ctrl+I\n"),
    "question": ("office.map", "key F3\ndrag 60 300 160 300\nkey Ctrl+Q\n"),
    "error": ("office.map", "drop no_such_folder/a_map_with_a_long_name_that_is_not_there.map\n"),
    "glass": ("effects/oneway.map", "eye 5 5 0 60\nkey Y\nkey F8\n"),
    "mirrors": ("effects/mirrors.map", "key V\nkey F5\n"),
    "doors": ("effects/doors.map", "key L\nkey Z\n"),
    "present": ("office.map", "key F12\nkey T\n"),
    "present_quiz": ("office.map", "key F12\nkey F4\nkey N\n"),
    "present_why": ("office.map", "eye 53 20 160 90\nkey F12\nright 300 300\n"),
}


def check_fits(viewer, folder, pictures, brief):
    sizes, texts = (SIZES[::3], TEXTS[::3]) if brief else (SIZES, TEXTS)
    for name, (map_name, script) in SCENES.items():
        script = script.replace("{maps}", str(viewer.root / "maps"))
        for size, text in itertools.product(sizes, texts):
            script += f"size {size}\ntext {text}\nfits\n"
            if pictures:
                picture = pictures / f"{name}-{size.split()[0]}-{text}.png"
                script += f"screenshot {picture}\n"
        viewer.script(folder, map_name, script)


def check_misfit_is_found(viewer, folder):
    """The check can fail: no button fits into a window of two letters."""
    path = folder / "misfit.txt"
    path.write_text("size 320 240\ntext 3\nkey F2\nkey L\nkey F8\nkey F4\nfits\n")
    done = viewer.run(viewer.root / "maps/office.map", "--script", path)
    viewer.check(done.returncode == 2 and "misfit.txt:7:" in done.stderr,
                 f"a text without room: status {done.returncode}, {done.stderr}")


# Steps of the grid from one end of the wall to the other.
GRID_STEPS = 10

# What a pointer does, and what keys do in its place: both must end in the same plan.
HANDS = {
    "eye": ("office.map", "", "click 300 300\n",
            "move 300 300\nkey Tab\nkey Return\nkey Escape\n"),
    "why": ("office.map", "eye 53 20 160 360\n", "right 300 300\n",
            "move 300 300\nkey Tab\nkey Shift+Return\nkey Escape\n"),
    "wall": ("office.map", "key F3\n", "drag 200 100 200 300\n",
             "move 200 100\nkey Tab\nkey Space\n" + "key Down\n" * GRID_STEPS +
             "key Space\nkey Escape\n"),
    "line": ("office.map", "key 9\nkey Ctrl+4\n", "drag 200 300 300 300\n",
             "move 200 300\nkey Tab\nkey Space\n" + "key Right\n" * 10 + "key Space\nkey Escape\n"),
    "path": ("office.map", "key 9\nkey Ctrl+3\n", "click 200 300\nclick 300 300\n",
             "move 200 300\nkey Tab\nkey Return\n" + "key Right\n" * 10 + "key Return\nkey Escape\n"),
    "layer": ("office.map", "", "key V\n", "key ?\ntype none\nkey Ctrl+A\ntype visible set\nkey Tab\nkey Tab\n"
                                            "key Return\n"),
    "door": ("effects/doors.map", "", "action nearest_door\n", "key ?\ntype nearest door\nkey Tab\n"
                                                                "key Tab\nkey Return\n"),
}


def check_hands(viewer, folder):
    before = "size 1000 700\n"
    for name, (map_name, first, pointer, keys) in HANDS.items():
        script = before + first + f"save {name}-none.png\n"
        viewer.script(folder, map_name,
                      script + pointer + f"move 5 5\nsave {name}-pointer.png\n")
        viewer.script(folder, map_name, script + keys + f"move 5 5\nsave {name}-keys.png\n")
        shots = [folder / f"{name}-{how}.png" for how in ("none", "pointer", "keys")]
        share = viewer.difference(shots[0], shots[1])
        viewer.check(share > 0, f"{name}: the pointer changes nothing")
        share = viewer.difference(shots[1], shots[2])
        viewer.check(share < TOLERANCE / 4, f"{name}: by keys {share:.2%} is otherwise")


def check_panels(viewer, folder):
    """Borders are dragged, panels scroll, a tooltip comes after a while and goes."""
    script = "size 1000 700\neye 53 20 160 90\n"
    steps = {"begin": "", "wide": "drag 662 400 500 400\n", "back": "drag 500 400 662 400\nmove 5 600\n",
             "scrolled": "size 1000 400\nmove 900 300\nwheel -4\n",
             "up": "wheel 9\nsize 1000 700\nmove 5 600\n",
             "soon": "move 30 15\nwait 10\n", "later": "wait 40\n", "gone": "move 5 600\nwait 2\n",
             "focus": "key Tab\nkey Tab\n", "unfocused": "key Escape\nmove 5 600\n",
             "panned": "key Shift+Right\n", "panned back": "key Shift+Left\nwait 20\n",
             "at the border": "move 650 300\nkey Tab\nkey Right\nkey Right\nkey Escape\nmove 5 600\n",
             "fitted": "key F\nwait 20\n", "presented": "key F12\n", "left": "key Escape\n",
             "help": "size 1000 400\nkey ?\n", "next page": "key PageDown\n", "page before": "key PageUp\n"}
    for name, step in steps.items():
        script += f"{step}screenshot {name}.png\n"
    viewer.script(folder, "office.map", script)
    for one, other, alike in [("begin", "wide", False), ("begin", "back", True),
                              ("begin", "up", True), ("soon", "later", False),
                              ("begin", "gone", True), ("begin", "focus", False),
                              ("begin", "unfocused", True), ("begin", "panned", False),
                              ("begin", "panned back", True), ("begin", "at the border", False),
                              ("begin", "fitted", True), ("begin", "presented", False),
                              ("begin", "left", True),
                              ("help", "next page", False), ("help", "page before", True)]:
        share = viewer.difference(folder / f"{one}.png", folder / f"{other}.png")
        viewer.check((share < 0.001) == alike, f"panels: {one} and {other} differ by {share:.2%}")


def main():
    viewer = Viewer(sys.argv)
    pictures = pathlib.Path(sys.argv[5]).resolve() if sys.argv[4:5] == ["--pictures"] else None
    if pictures:
        pictures.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_fits(viewer, folder, pictures, "--brief" in sys.argv)
        check_misfit_is_found(viewer, folder)
        check_hands(viewer, folder)
        check_panels(viewer, folder)
    viewer.end()


if __name__ == "__main__":
    main()
