"""The viewer's pictures against stored ones, and each layer against none: VIEW SAME ROOT [--store].

--store writes the stored pictures anew: look at them before they are kept.
"""
import pathlib
import shutil
import sys
import tempfile

from viewing import TOLERANCE, Viewer

SIZE = "size 640 480\ntext 0.75\n"

# name: (map, script). All end in a picture of that name.
PICTURES = {
    "explore": ("office.map", "eye 53 20 160 90\nkey B\n"),
    "panes": ("office.map", "eye 53 20 160 90\nkey X\naction side_panel\n"),
    "difference": ("office.map", "eye 53 20 160 90\nkey X\nkey X\n"),
    "splits_dark": ("dungeon.txt", "key K\nkey T\nkey M\nkey R\n"),
    # The eye in rock, and a click there, which leaves the eye where it is.
    "rock": ("dungeon.txt", "eye 7.5 14.5 0\nclick 120 200\n"),
    "search": ("office.map", "eye 53 20 160\nkey F2\n" + "key Right\n" * 9 + "key Left\n"),
    "hidden": ("office.map", "eye 53 20 160\nkey F2\n" + "key Right\n" * 6),
    "subdivision": ("maze.map", "key F2\nkey U\n" + "key Right\n" * 4),
    "pass": ("maze.map", "key F2\nkey U\nkey U\n" + "key Right\n" * 30),
    "lesson_doors": ("effects/doors.map", "key F2\n" + "key U\n" * 3 + "key Right\nkey N\n"),
    "lesson_mirrors": ("effects/mirrors.map", "key F2\n" + "key U\n" * 3),
    "lesson_range": ("effects/range.map", "key F2\n" + "key U\n" * 3 + "key End\n"),
    "draw": ("office.map", "action side_panel\nkey F3\ndrag 200 100 200 300\naction side_panel\n"),
    "fisk": ("oblique/comb.map", "key F2\n" + "key U\n" * 4 + "key Right\n" * 20),
    "fewest": ("oblique/comb.map", "key F2\n" + "key U\n" * 3 + "key Right\n" * 3),
    "cameras": ("oblique/comb.map", "key 8\nclick 120 290\n" + "key ,\n" * 40 + "key Left\n" * 12 +
                "click 240 314\n"),
    "plan": ("effects/doors.map", "key 9\nkey Ctrl+2\naction heat_ranks\nmove 180 120\n"),
    "plan_path": ("effects/doors.map", "key 9\nkey Ctrl+3\nclick 100 120\nclick 380 400\n"),
    "quiz": ("office.map", "key F4\nkey Y\n"),
    "nodes": ("office.map", "eye 53 20 160 60\nkey M\nkey R\nkey Q\naction side_panel\n"),
    "views": ("office.map", "size 640 530\neye 53 20 160 90\nkey M\nkey R\nkey F5\n"
                            "drag 573 495 530 495\nkey F6\nmove 200 200\n"),
    "oblique_views": ("oblique/rotunda.map", "action side_panel\nkey M\nkey R\nkey F5\n"),
    "heat": ("office.map", "eye 53 20 160 90\nkey M\nkey R\nkey 1\nkey 2\nmove 200 200\n"),
    "heat_steps": ("effects/doors.map", "action side_panel\nkey M\nkey R\nkey T\nkey 1\nkey 6\n"
                                        "move 180 120\n"),
    "account": ("office.map", "eye 53 20 160 90\naction side_panel\nkey L\n"),
    "oblique": ("oblique/rotunda.map", "key B\n"),
    "oblique_delaunay": ("oblique/rotunda.map", "key F2\nkey U\n" + "key Right\n" * 2),
    "oblique_subdivision": ("oblique/rotunda.map", "key F2\nkey U\n" + "key Right\n" * 35),
    "oblique_corner": ("oblique/chapel.map", "key F2\nkey U\n" + "key Right\n" * 20),
    "oblique_search": ("oblique/rotunda.map", "key F2\n" + "key Right\n" * 12),
    "oblique_first_person": ("oblique/rotunda.map", "key I\naction side_panel\nwait 2\n"),
    "doors": ("effects/doors.map", "key V\nkey M\n"),
    "mirrors": ("effects/mirrors.map", "key V\nkey M\naction side_panel\n"),
    "reflections": ("effects/mirrors.map", "eye 10 5 0 40\nkey V\nkey F8\ndrag 482 447 520 447\n"),
    "oneway": ("effects/oneway.map", "eye 25 10 180 60\naction side_panel\n"),
    "watch": ("effects/oneway.map", "eye 5 5 0 60\nkey M\nkey Y\nkey F8\n"),
    "objects": ("effects/objects.map", "action side_panel\neye 3 10 0 360\nclick 320 262\nmove 5 5\n"),
    "range": ("effects/range.map", "key V\nkey M\naction side_panel\n"),
    "first_person": ("pillars.map", "key I\naction side_panel\nwait 2\n"),
}

# Keys that change the plan, each on its own; and how each is taken back. A mesh has no splits, and
# its cells end at walls and portals alone: their outlines are seen where portals are not shown.
LAYERS = ["C", "P", "K", "F5", "1", "V", "B", "M", "R", "J", "Q"]
MESH_LAYERS = [key for key in LAYERS if key != "K"]
SWITCHES = {"I": "I", "L": "L", "T": "T", "X": "X X", "Ctrl+B": "Ctrl+B", "?": "Escape", "O": "Escape",
            "F2": "F1", "F3": "F1", "F4": "F1", "8": "F1", "PageUp": "F", "Ctrl+=": "Ctrl+-", "/": "/"}


def shoot(viewer, folder):
    for name, (map_name, script) in PICTURES.items():
        viewer.script(folder, map_name, SIZE + script + f"screenshot {name}.png\n")


def check_stored(viewer, folder, stored):
    for name in PICTURES:
        share = viewer.difference(folder / f"{name}.png", stored / f"{name}.png")
        viewer.check(share <= TOLERANCE, f"{name}: {share:.2%} of the pixels are others than in {stored / name}.png. If "
                     "they should be, build the target store_pictures and look at the new pictures")


def check_switches(viewer, folder, map_name, eye, least, layers, before=""):
    """Each key changes the picture, a layer by at least a share, and back again."""
    script = SIZE + f"eye {eye}\naction side_panel\nkey M\nkey R\n{before}save before.png\n"
    for key in layers:
        script += f"key {key}\nsave {key}.png\nkey {key}\n"
    for i, (key, back) in enumerate(SWITCHES.items()):
        script += f"screenshot off{i}.png\nkey {key}\nscreenshot on{i}.png\n"
        script += "".join(f"key {one}\n" for one in back.split())
    viewer.script(folder, map_name, script + "save after.png\n")
    for key in layers:
        share = viewer.difference(folder / "before.png", folder / f"{key}.png")
        viewer.check(share > least, f"{map_name}: layer {key} changes only {share:.2%}")
    for i, key in enumerate(SWITCHES):
        share = viewer.difference(folder / f"off{i}.png", folder / f"on{i}.png")
        viewer.check(share > TOLERANCE, f"{map_name}: key {key} changes only {share:.2%}")
    viewer.check((folder / "before.png").read_bytes() == (folder / "after.png").read_bytes(),
                 "the plan is not as it was before")


def check_files(viewer, folder):
    """The plan as PNG, SVG and PDF; a series; the same bytes from the same script."""
    script = (SIZE + "eye 53 20 160 90\nsave a.png\nsave a.svg\nsave a.pdf\nscreenshot w.svg\n"
              "account c.png\naccount c.svg\naccount c.pdf\n"
              "key F9\ndown W\nwait 6\nup W\nkey F9\nexport series\n")
    viewer.script(folder, "office.map", script)
    starts = {"a.png": b"\x89PNG", "a.svg": b"<?xml", "a.pdf": b"%PDF", "w.svg": b"<?xml",
              "c.png": b"\x89PNG", "c.svg": b"<?xml", "c.pdf": b"%PDF"}
    for name, start in starts.items():
        viewer.check((folder / name).read_bytes().startswith(start), f"{name} is none")
    frames = sorted(path.name for path in (folder / "series").glob("*.png"))
    viewer.check(frames[:2] == ["frame-0001.png", "frame-0002.png"], f"the series is {frames}")
    first = (folder / "a.png").read_bytes()
    viewer.script(folder, "office.map", script)
    viewer.check(first == (folder / "a.png").read_bytes(), "not the same bytes again")


def check_undo(viewer, folder):
    """A wall drawn, moved, deleted, and all of it undone and redone."""
    steps = ["plain", "drawn", "moved", "deleted", "undone", "all", "redone"]
    commands = ["", "drag 60 80 60 390", "drag 60 225 250 225", "click 250 225\nkey Delete",
                "key Ctrl+Z\nkey Ctrl+Z", "key Ctrl+Z", "key Ctrl+Y\nkey Ctrl+Y"]
    script = SIZE + "action side_panel\nkey F3\n"
    for name, command in zip(steps, commands):
        script += f"{command}\nmove 5 5\nsave {name}.png\n"
    viewer.script(folder, "office.map", script)
    shots = {name: folder / f"{name}.png" for name in steps}
    for one, other in [("drawn", "undone"), ("plain", "all"), ("plain", "deleted"),
                       ("moved", "redone")]:
        share = viewer.difference(shots[one], shots[other])
        viewer.check(share < TOLERANCE, f"{one} and {other} differ: {share:.2%}")
    for one, other in [("plain", "drawn"), ("drawn", "moved"), ("moved", "deleted")]:
        share = viewer.difference(shots[one], shots[other])
        viewer.check(share > TOLERANCE, f"{one} and {other} are alike: {share:.2%}")


EYES = ["5 5 0", "15 5 0", "25 5 180", "5 15 0", "15 15 90", "25 15 180"]


def walled(plan, shut):
    """A map with walls in place of some doors, the others open, and a start in each room."""
    lines = []
    for line in plan.splitlines():
        words = line.split()
        if words and words[0] == "door":
            ends = " ".join(words[2:6])
            line = f"wall {ends}" if words[1] in shut else f"door {words[1]} {ends} open"
        lines.append(line)
    return "\n".join(lines + [f"start {eye}" for eye in EYES]) + "\n"


def check_doors(viewer, folder):
    """Doors turned by hand, against maps with walls in place of those that are shut."""
    plan = (viewer.root / "maps/effects/doors.map").read_text()
    before = SIZE + "action side_panel\nkey C\nkey P\nkey V\nkey J\nkey F8\n"
    # As the map begins; two turned by clicks; the one nearest to the eye turned back; the clicks
    # undone, and one redone.
    states = {"begin": (["north-east"], ""),
              "clicked": (["east"], "click 420 342\nclick 420 142\n"),
              "nearest": ([], "eye 19 5 0\nkey N\n"),
              "undone": (["north-east", "east"], "key Ctrl+Z\nkey Ctrl+Z\n"),
              "redone": (["east"], "key Ctrl+Y\n")}

    def looks(name):
        return "".join(f"eye {eye}\nsave {name}{i}.png\n" for i, eye in enumerate(EYES))

    viewer.script(folder, "effects/doors.map",
                  before + "".join(done + looks(name) for name, (_, done) in states.items()))
    for name, (shut, _) in states.items():
        path = folder / f"{name}.map"
        path.write_text(walled(plan, shut))
        viewer.script(folder, path, before + looks(f"{name}-walled"))
        for i in range(len(EYES)):
            share = viewer.difference(folder / f"{name}{i}.png", folder / f"{name}-walled{i}.png")
            viewer.check(share < TOLERANCE, f"doors: {name}, eye {i} is {share:.2%} off")
    share = viewer.difference(folder / "begin0.png", folder / "clicked0.png")
    viewer.check(share > TOLERANCE, f"doors: a click changes only {share:.2%}")


def check_glass(viewer, folder):
    """What is seen past glass that lets sight through, and past glass that is dark, against maps
    that have nothing there, or walls; whole, and cut by oblique walls."""
    starts = "start 5 5 0\nstart 5 15 0\n"
    before = SIZE + "action side_panel\nkey C\nkey P\nkey J\nkey F8\naction legend\n"
    for more in ["", "wall 16 2 20 3\nwall 17 12 19 11.5\n"]:
        plan = (viewer.root / "maps/effects/oneway.map").read_text() + more
        (folder / "glass.map").write_text(plan)
        (folder / "lit.map").write_text(plan.replace("oneway", "seam"))
        (folder / "dark.map").write_text(plan.replace("oneway", "wall") + starts)
        for i, (eye, like) in enumerate([("25 10 180 90", "lit"), ("5 5 0 90", "dark"),
                                         ("12 15 90 360", "dark"), ("18.5 15 180 360", "lit")]):
            for name in ["glass", like]:
                viewer.script(folder, folder / f"{name}.map",
                              before + f"eye {eye}\nsave {name}{i}.png\n")
            share = viewer.difference(folder / f"glass{i}.png", folder / f"{like}{i}.png")
            # The glass itself is drawn otherwise than a wall.
            viewer.check(share < 2 * TOLERANCE, f"glass: eye {i} sees {share:.2%} otherwise")


def check_mirrors(viewer, folder):
    """A mirror dragged whole, then by an end, and both undone, against maps that have it there."""
    plan = (viewer.root / "maps/effects/mirrors.map").read_text()
    before = SIZE + "action side_panel\nkey F8\nkey V\neye 5 25 0 90\n"
    states = {"given": ("20 12 20 28", ""), "whole": ("18 12 18 28", "drag 457 140 430 140\n"),
              "end": ("18 12 14 26", "drag 430 63 375 90\n"),
              "again": ("20 12 20 28", "key Ctrl+Z\n" * 2)}
    viewer.script(folder, "effects/mirrors.map", before + "".join(
        f"{done}move 5 5\nsave {name}.png\n" for name, (_, done) in states.items()))
    for name, (place, _) in states.items():
        path = folder / f"{name}.map"
        path.write_text(plan.replace("mirror 20 12 20 28", f"mirror {place}"))
        viewer.script(folder, path, before + f"move 5 5\nsave {name}-given.png\n")
        share = viewer.difference(folder / f"{name}.png", folder / f"{name}-given.png")
        viewer.check(share < TOLERANCE, f"mirrors: {name} is {share:.2%} off")


def check_objects(viewer, folder):
    """A box dragged, and one that blocks, against maps that have it there, or walls in its place."""
    plan = (viewer.root / "maps/office.map").read_text()
    sofa = "object sofa 53.5 37.5 56 38.5"
    box = "walls 48.5 22.5 51 22.5 51 23.5 48.5 23.5 48.5 22.5"
    (folder / "moved.map").write_text(plan.replace(sofa, "object sofa 48.5 22.5 51 23.5"))
    (folder / "blocks.map").write_text(plan.replace(sofa, box))
    before = "size 1200 760\naction side_panel\nkey C\nkey P\nkey M\neye 53 20 160 360\n"
    after = "move 5 5\nsave {0}.png\n"
    viewer.script(folder, "office.map", before + "save given.png\ndrag 977 92 894 341\n" +
                  after.format("moved") + "click 894 341\nkey J\n" + after.format("blocks") +
                  "key J\nclick 894 341\nkey Ctrl+Z\n" + after.format("again"))
    for name, before_too in [("moved", ""), ("blocks", "key J\n")]:
        viewer.script(folder, folder / f"{name}.map",
                      before + before_too + after.format(f"{name}-given"))
        share = viewer.difference(folder / f"{name}.png", folder / f"{name}-given.png")
        viewer.check(share < TOLERANCE / 2, f"objects: {name} is {share:.2%} off")
    share = viewer.difference(folder / "moved.png", folder / "blocks.png")
    viewer.check(share > TOLERANCE, f"objects: one that blocks changes only {share:.2%}")
    share = viewer.difference(folder / "given.png", folder / "again.png")
    viewer.check(share < TOLERANCE / 4, f"objects: not back where it was: {share:.2%}")


def check_range(viewer, folder):
    """A range set, moved by its slider, undone and lifted, against maps that have it."""
    plan = (viewer.root / "maps/effects/range.map").read_text()
    before = SIZE + "eye 5 5 0 90\nkey V\nkey F8\n"
    after = "action side_panel\nmove 5 5\nsave {0}.png\naction side_panel\n"
    # The slider dragged to its end, and back; clicked where it stands, which is no change to undo, and
    # undone; no range; the one that is set first.
    states = {"given": ("20", ""), "farther": ("60.8", "drag 534 403 600 403\n"),
              "nearer": ("9.58", "drag 588 403 511 403\n"), "undone": ("60.8", "click 511 403\nkey Ctrl+Z\n"),
              "lifted": (None, "key Ctrl+R\n"), "set": ("18.2", "key Ctrl+R\n")}
    viewer.script(folder, "effects/range.map", before + "".join(
        done + after.format(name) for name, (_, done) in states.items()))
    for name, (value, _) in states.items():
        path = folder / f"{name}.map"
        path.write_text(plan.replace("range 20\n", f"range {value}\n" if value else ""))
        viewer.script(folder, path, before + after.format(f"{name}-given"))
        share = viewer.difference(folder / f"{name}.png", folder / f"{name}-given.png")
        viewer.check(share < TOLERANCE, f"range: {name} is {share:.2%} off")


def check_views(viewer, folder):
    """A merge and its way back, the largest cost and the next one."""
    steps = {"cut": "key F5", "fewer": "key Ctrl+Left", "again": "key Ctrl+Right",
             "largest": "key F6", "next": "key F6",
             "unmarked": "key Ctrl+Left\nkey Ctrl+Right", "off": "key F5", "on": "key F5"}
    script = SIZE + "action side_panel\nkey M\nkey R\n"
    for name, command in steps.items():
        script += f"{command}\nsave {name}.png\n"
    viewer.script(folder, "office.map", script)
    shots = {name: (folder / f"{name}.png").read_bytes() for name in steps}
    for name in ["again", "unmarked", "on"]:
        viewer.check(shots[name] == shots["cut"], f"view cells: {name} and cut differ")
    for one, other in [("cut", "fewer"), ("cut", "largest"), ("largest", "next"), ("cut", "off")]:
        viewer.check(shots[one] != shots[other], f"view cells: {one} and {other} are alike")


def main():
    viewer = Viewer(sys.argv)
    stored = pathlib.Path(__file__).parent / "pictures"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shoot(viewer, folder)
        if "--store" in sys.argv:
            for picture in PICTURES:
                shutil.copy(folder / f"{picture}.png", stored)
        check_stored(viewer, folder, stored)
        check_switches(viewer, folder, "office.map", "53 20 160 90", TOLERANCE, LAYERS)
        check_switches(viewer, folder, "oblique/rotunda.map", "50 48 200 90", TOLERANCE / 2,
                       MESH_LAYERS, "key P\n")
        check_files(viewer, folder)
        check_undo(viewer, folder)
        check_views(viewer, folder)
        check_doors(viewer, folder)
        check_glass(viewer, folder)
        check_mirrors(viewer, folder)
        check_objects(viewer, folder)
        check_range(viewer, folder)
    viewer.end()


if __name__ == "__main__":
    main()
