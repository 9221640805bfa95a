"""Documents without a window: new, open, save, questions, the file browser, options: VIEW SAME ROOT.

Each case is a script. `expect` in it fails the script; what was written is read here.
"""
import pathlib
import tempfile

import sys

from viewing import Viewer

SIZE = "size 800 600\n"
# A plan of two rooms, with comments of each kind.
PLAN = """# two rooms
sightline 1
walls 0 0 20 0 20 10 0 10 0 0   # the outer walls
# the wall between
wall 10 0 10 4
wall 10 6 10 10
start 5 5 0
# the end
"""
# A room with an opening of 2, and no start: inside is known by the width of entrances.
HOUSE = """sightline 1
walls 5 0 10 0 10 8 0 8 0 0 3 0
wall 12 0 12 8
"""
# Two layers of tiles, and nothing that says which is solid. Their tiles are all alike, so that the
# reader cannot guess.
TILES = """<map width='3' height='2' tilewidth='8' tileheight='8'>
<tileset firstgid='1' tilewidth='8' tileheight='8'/>
<layer name='floor' width='3' height='2'><data encoding='csv'>1,1,1,1,1,1</data></layer>
<layer name='stuff' width='3' height='2'><data encoding='csv'>0,2,2,0,0,0</data></layer>
</map>
"""
# A wall from one place to another, by the pointer.
WALL = "key F3\ndrag 60 300 160 300\n"
OBLIQUE = "key F3\ndrag 60 260 160 340\n"


def statements(text):
    """The statements of a map text, without comments."""
    lines = (line.split("#")[0].split() for line in text.splitlines())
    return [line for line in lines if line]


def comments(text):
    return [line[line.index("#"):].strip() for line in text.splitlines() if "#" in line]


class Cases:
    def __init__(self, viewer, folder):
        self.viewer = viewer
        self.folder = folder

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def run(self, name, map_path, script, *options):
        """Runs a script in the folder; `name` is for the report."""
        path = self.write("script.txt", SIZE + script)
        done = self.viewer.run(map_path, "--script", path, *options, cwd=self.folder)
        self.viewer.check(done.returncode == 0, f"{name}: {done.stderr.strip()}")

    def check(self, good, what):
        self.viewer.check(good, what)

    # --- saving

    def saves_and_keeps_comments(self):
        path = self.write("plan.map", PLAN)
        self.run("save", path, "expect plan.map - Sightline\n" + WALL + "expect *plan.map\n"
                 "key Ctrl+S\nexpect saved\nexpect plan.map - Sightline\n")
        text = path.read_text()
        walls = [line for line in statements(text) if line[0] == "wall"]
        self.check(len(walls) == 7, f"save: {len(walls)} walls in {text}")
        self.check(sorted(comments(text)) == sorted(comments(PLAN)), f"save: comments of {text}")
        self.run("read back", path, "expect plan.map: \nexpect plan.map - Sightline\n")

    def undone_is_unchanged(self):
        path = self.write("plan.map", PLAN)
        self.run("undo", path, WALL + "key Ctrl+Z\nexpect plan.map - Sightline\nkey Ctrl+Y\n"
                 "expect *plan.map\nkey Ctrl+S\nexpect plan.map - Sightline\nkey Ctrl+Z\n"
                 "expect *plan.map\nkey Ctrl+Y\nexpect plan.map - Sightline\n")

    def escape_puts_back(self):
        """Escape during a drag by keys does what it does during one with the mouse."""
        path = self.write("plan.map", PLAN)
        grab = "key F3\nkey Tab\nkey Right\nkey Space\n" + "key Left\n" * 6
        self.run("held", path, grab + "key Space\nexpect *plan.map\n")
        self.run("put back", path, grab + "key Escape\nexpect back where it was\n"
                 "expect plan.map - Sightline\n")

    def saves_as(self):
        path = self.write("plan.map", PLAN)
        other = self.folder / "other.map"
        taken = self.write("taken.map", "nothing")
        before = WALL + "key Ctrl+Shift+S\nexpect Save the map\nkey Ctrl+U\n"
        # Without an ending it is map text, and the map's name from then on.
        self.run("save as", path, before + f"type {self.folder}/other\nkey Return\n"
                 "expect other.map - Sightline\n")
        self.check(path.read_text() == PLAN, "save as changed the file that was open")
        self.check(other.exists() and statements(other.read_text())[0] == ["sightline", "1"],
                   "save as wrote no map")
        self.run("replace", path, before + f"type {taken}\nkey Return\nexpect Replace the file?\n"
                 "key C\nexpect Save the map\nkey Return\nkey R\nexpect taken.map - Sightline\n")
        self.check("sightline 1" in taken.read_text(), "a file was not replaced")
        self.run("endings", path, before + f"type {self.folder}/plan.png\nkey Return\n"
                 "expect .map (map text) or .slv (baked)\nkey Escape\nexpect *plan.map\n")
        self.run("no folder", path, before + f"type {self.folder}/nowhere/plan.map\nkey Return\n"
                 "expect The map was not saved\nkey C\nexpect *plan.map\n")
        # The path that was typed is in the field again.
        self.run("another path", path, before + f"type {self.folder}/nowhere/plan.map\nkey Return\n"
                 "expect The map was not saved\nkey A\nexpect Save the map\nkey Return\n"
                 "expect nowhere/plan.map\nkey A\nkey Ctrl+W\nkey Ctrl+W\n"
                 "type there.map\nkey Return\nexpect there.map - Sightline\n")
        self.check((self.folder / "there.map").exists(), "the second path was not taken")

    def chooses_all(self):
        path = self.write("plan.map", PLAN)
        field = "key Ctrl+Shift+S\nkey Ctrl+A\n"
        self.run("replace", path, field + f"type {self.folder}/new.map\nkey Return\n"
                 "expect new.map - Sightline\n")
        self.run("delete", path, field + f"key Backspace\ntype {self.folder}/empty.map\n"
                 "key Return\nexpect empty.map - Sightline\n")
        # A key that moves keeps the text.
        self.run("move", path, field + "key End\ntype x\nkey Return\nexpect Names end in .map\n")

    def saves_baked(self):
        path = self.write("plan.map", PLAN)
        baked = self.folder / "plan.slv"
        copy = self.folder / "copy.slv"
        self.run("walls", path, "expect 8 walls\n")
        self.run("bake", path, f"key Ctrl+Shift+S\nkey Ctrl+U\ntype {baked}\nkey Return\n"
                 "expect saved\nexpect plan.slv - Sightline\n")
        self.check(baked.exists() and baked.stat().st_size > 100, "no baked file")
        # One that has not changed keeps its bytes; one that has changed is baked anew.
        self.run("copy", baked, f"key Ctrl+Shift+S\nkey Ctrl+U\ntype {copy}\nkey Return\n"
                 "expect saved\n")
        self.check(copy.exists() and copy.read_bytes() == baked.read_bytes(), "the copy differs")
        self.run("anew", baked, WALL + "key Ctrl+S\nexpect saved\n")
        self.check(copy.read_bytes() != baked.read_bytes(), "a change was not baked")
        self.run("read baked", baked, "expect 9 walls\n")

    def begins_anew(self):
        path = self.write("plan.map", PLAN)
        drawn = self.folder / "drawn.map"
        drawn.unlink(missing_ok=True)
        self.run("new", path, "key Ctrl+N\nexpect Untitled - Sightline\nexpect 4 walls\n" + WALL +
                 f"expect *Untitled\nkey Ctrl+S\nexpect Save the map\nkey Ctrl+U\n"
                 f"type {drawn}\nkey Return\nexpect drawn.map - Sightline\n")
        kinds = [line[0] for line in statements(drawn.read_text())]
        self.check(kinds.count("wall") == 5 and kinds.count("start") == 1, f"new: {kinds}")

    # --- questions

    def asks_before_changes_are_lost(self):
        for act, then in [(f"drop {self.folder}/second.map", "expect second.map - Sightline"),
                          ("key Ctrl+N", "expect Untitled - Sightline")]:
            path = self.write("plan.map", PLAN)
            self.write("second.map", PLAN)
            asked = WALL + f"{act}\nexpect plan.map has changes that are not saved\n"
            self.run(f"cancel {act}", path, asked + "key Escape\nexpect *plan.map\n")
            self.run(f"give up {act}", path, asked + f"key D\n{then}\n")
            self.check(path.read_text() == PLAN, f"{act}: changes were given up, and are in the file")
            self.run(f"save {act}", path, asked + f"key Return\n{then}\n")
            self.check(path.read_text() != PLAN, f"{act}: changes were not saved")
        path = self.write("plan.map", PLAN)
        self.run("by hand", path, WALL + "key Ctrl+Q\nexpect Save the changes?\nkey Right\n"
                 "key Right\nkey Return\nexpect *plan.map\n")
        # A map without a file: Save asks for its name, and what has waited goes on.
        self.run("no file", path, "key Ctrl+N\n" + WALL + f"drop {self.folder}/second.map\nkey S\n"
                 f"key Ctrl+U\ntype {self.folder}/named.map\nkey Return\n"
                 "expect second.map - Sightline\n")
        self.check((self.folder / "named.map").exists(), "the map that had no file is lost")

    # --- the file browser

    def browses(self):
        shelf = self.folder / "shelf"
        (shelf / "inner").mkdir(parents=True)
        self.write("shelf/CMakeLists.txt", "add_executable(program main.c)\n")
        self.write("shelf/cave.txt", "#####\n#@..#\n#####\n")
        self.write("shelf/inner/inside.map", PLAN)
        path = self.write("shelf/plan.map", PLAN)
        openings = "key Ctrl+O\nexpect Open a map\nkey Ctrl+U\n"
        self.run("by path", path, openings + f"type {shelf}/inner/inside.map\nkey Return\n"
                 "expect inside.map - Sightline\n")
        self.run("by Tab", path, openings + f"type {shelf}/inn\nkey Tab\ntype ins\n"
                 "key Tab\nkey Return\nexpect inside.map - Sightline\n")
        self.run("by its beginning", path, f"key O\ntype pla\nkey Return\n"
                 "expect plan.map - Sightline\n")
        # Backspace and cursor: "planX" with the X taken out again.
        self.run("edited", path, openings + f"type {shelf}/cavXe.txt\nkey End\n" +
                 "key Left\n" * 5 + "key Backspace\nkey Return\nexpect cave.txt - Sightline\n")
        # Down to "inner/", into it, and back up; then the first map that follows the folder.
        self.run("by arrows", path, openings + f"type {shelf}/\nkey Down\nkey Return\nkey Down\n"
                 "key Return\nexpect inside.map - Sightline\n")
        self.run("folder above", path, openings + f"type {shelf}/inner/\nkey Ctrl+Up\nkey Down\n"
                 "key Down\nkey Return\nexpect cave.txt - Sightline\n")
        # The head of a column sorts: the largest file first, and again the smallest.
        for clicks, name in [(0, "cave.txt"), (1, "plan.map"), (2, "cave.txt")]:
            self.run(f"sorted {clicks}", shelf / "inner/inside.map", openings + f"type {shelf}/\n" +
                     "click 559 152\n" * clicks + "key Down\nkey Down\nkey Return\n"
                     f"expect {name} - Sightline\n")
        # A text that is no plan is not offered.
        self.run("no plan", path, openings + f"type {shelf}/CM\nkey Return\n"
                 "expect There is no such file: CM\nkey Escape\nexpect plan.map - Sightline\n")
        self.run("nothing chosen", path, openings + f"type {shelf}/\nkey Return\n"
                 "expect Open a map\n")
        # A click chooses a row, another one on it opens it.
        self.run("by pointer", path, openings + f"type {shelf}/\nclick 200 196\n"
                 "expect Open a map\nclick 200 196\nexpect cave.txt - Sightline\n")

    def lists_samples(self):
        """All maps that come with the program, those of effects too."""
        path = self.write("plan.map", PLAN)
        for name in ["effects/doors.map", "oblique/star.map", "cellar.txt"]:
            script = f"key Ctrl+O\nclick 182 125\nclick 300 91\nkey Ctrl+U\ntype {name}\nkey Return\n"
            self.run(f"sample {name}", path, script + f"expect {pathlib.Path(name).name} - Sightline\n")

    # --- options

    def asks_for_layers(self):
        path = self.write("plan.map", PLAN)
        tiles = self.write("tiles.tmx", TILES)
        asked = f"drop {tiles}\nexpect Open tiles.tmx\n"
        self.run("layers", path, asked + "key Down\nkey Space\nkey Return\n"
                 "expect tiles.tmx - Sightline\nexpect what was read\nkey Ctrl+J\n"
                 "expect 6 walls from 1 solid layer; left out: 1 layer\n")
        # Without a choice the reader says what it needs; the way back keeps the layers in sight.
        self.run("no layer", path, asked + "key Return\nexpect nothing in it says what is solid\n"
                 "key O\nexpect Open tiles.tmx\nkey Down\nkey Space\nkey Return\n"
                 "expect tiles.tmx - Sightline\n")
        self.run("cancel", path, asked + "key Escape\nexpect plan.map - Sightline\n")

    def takes_options(self):
        path = self.write("plan.map", PLAN)
        options = "key Ctrl+I\nexpect Open plan.map\n"
        # Fields of a map text: weld, start; then the check of cells.
        self.run("wrong number", path, options + "key Tab\ntype many\nkey Return\n"
                 "expect Weld ends within: 0 or a number over 0 is needed\nkey Ctrl+U\n"
                 "type 0.5\nkey Return\nexpect plan.map: \n")
        self.run("wrong start", path, options + "key Tab\nkey Tab\nkey Tab\ntype 3\nkey Return\n"
                 "expect a place is needed\nkey Ctrl+U\ntype 15,5\nkey Return\n"
                 "expect plan.map: \n")
        outside = options + "key Tab\nkey Tab\nkey Tab\ntype 300,5\nkey Return\n"
        self.run("start outside", path, outside + "expect outside the map\n")

    def takes_the_width_of_entrances(self):
        path = self.write("house.map", HOUSE)
        saved = self.folder / "saved.map"
        found, narrow = "expect inside ends at 1 opening up to 2 wide\n", "expect walls enclose nothing\n"
        keep = f"key Ctrl+Shift+S\nkey Ctrl+U\ntype {saved}\nkey Return\nexpect saved\n"
        field = "key Ctrl+I\n" + "key Tab\n" * 4
        self.run("found", path, found)
        self.run("by the option", path, narrow + keep, "--entrance", "1")
        self.check(["entrance", "1"] in statements(saved.read_text()), "the width was not saved")
        # It holds for files that are opened later, too.
        other = self.write("other.map", HOUSE)
        self.run("later", path, f"drop {other}\nexpect other.map\n" + narrow, "--entrance", "1")
        # The dialog has it in its field; an empty one is what the file says.
        self.run("in the field", path, field + "key Ctrl+U\nkey Return\n" + found, "--entrance", "1")
        for wrong in ("wide", "0", "1e200"):
            self.run(f"field {wrong}", path, field + f"type {wrong}\nkey Return\n"
                     "expect Widest entrance: a number over 0 is needed\nkey Ctrl+U\ntype 1\n"
                     "key Return\n" + narrow)

    def suggests_a_weld(self):
        # The walls along a hall miss each other by the rounding of a drawing: each gap gives cells.
        gap = 1e-7
        plan = ["sightline 1", "wall 0 0 0 9", "wall 24 0.8 24 8.2", "start 1 4 0"]
        for i in range(8):
            x = 3 * i
            plan += [f"wall {x} {0.1 * i:.3f} {x + 3 - gap} {0.1 * (i + 1):.3f}",
                     f"wall {x + gap} {9 - 0.1 * i:.3f} {x + 3 - gap} {8.9 - 0.1 * i:.3f}"]
        path = self.write("gaps.map", "\n".join(plan) + "\n")
        welded = self.folder / "welded.map"
        self.run("suggest", path, "expect gaps.map: 29 cells\nkey Ctrl+I\nkey Tab\nkey Tab\n"
                 "key Space\nwait 1\nkey Return\nexpect gaps.map: 14 cells\n"
                 f"key Ctrl+Shift+S\nkey Ctrl+U\ntype {welded}\nkey Return\nexpect saved\n")
        # What is saved needs no weld any more.
        self.run("welded", welded, "expect welded.map: 14 cells\n")

    def asks_which_map(self):
        for wad in pathlib.Path("/usr/share/games/doom").glob("freedoom1.wad"):
            path = self.write("plan.map", PLAN)
            self.run("wad", path, f"drop {wad}\nexpect Open freedoom1.wad\nkey Down\nkey Return\n"
                     "expect freedoom1.wad E1M2 - Sightline\n")

    # --- messages

    def shows_errors(self):
        path = self.write("plan.map", PLAN)
        bad = self.write("bad.map", "sightline 1\nwall 0 0 1\n")
        self.run("error", path, f"drop {bad}\nexpect The file was not opened\nexpect bad.map:2\n"
                 f"key Return\nexpect bad.map was not opened\ndrop {path}\n"
                 "expect plan.map: \n")
        self.run("missing", path, f"drop {self.folder}/none.map\nexpect none.map\nkey Escape\n"
                 "expect plan.map - Sightline\n")

    def tells_of_oblique_walls(self):
        path = self.write("plan.map", PLAN)
        self.run("oblique", path, OBLIQUE + "expect A wall is oblique now\nkey Ctrl+Z\n"
                 "expect All walls are axial now\n")

    def lists_layers_of_a_drawing(self):
        """Ctrl+I: layers with what is on them and what they are taken for; a part of a name filters; the
        plan follows each choice, and Escape puts back what was there."""
        layers = "".join(f"<g id='part-{i}'><path d='M{i} 0 V4' stroke='black'/></g>" for i in range(9))
        path = self.write("house.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='90' height='50'>"
                          "<g id='Mauer'><path d='M0 0 H90 V50 H0 Z M40 0 V30' stroke='black' fill='none'/>"
                          f"</g>{layers}</svg>")
        ask = "key Ctrl+I\nexpect How to read house.svg\nfits\n"
        save = "key Ctrl+Shift+S\nkey Ctrl+U\ntype walls\nkey Return\nexpect walls.map\n"

        def walls(script):
            (self.folder / "walls.map").unlink(missing_ok=True)
            self.run("layers", path, script + save)
            lines = statements((self.folder / "walls.map").read_text())
            return {float(line[1]) for line in lines if line[0].startswith("wall")}

        plain = walls("")
        self.check(plain and plain <= {0, 40, 90}, f"Mauer: {plain}")
        # The first choice of a layer that is ignored is a wall; letters press no button.
        self.check(walls(ask + "type PART-3\nkey Tab\nkey Space\nkey Return\n") == plain | {3}, "part-3")
        self.check(walls(ask + "type part-3\nkey Tab\nkey Space\nkey Escape\n") == plain, "Escape")
        for text in ("1024 768", "640 480"):
            self.run("fits", path, f"size {text}\n{ask}key Escape\n")

    def asks_before_pictures(self):
        """A picture goes beside the map, under the map's name or the one that is typed."""
        (self.folder / "plans").mkdir()
        path = self.write("plans/plan.map", PLAN)
        ask = "key Ctrl+E\nexpect Save a picture of the plan\n"
        self.run("none", path, ask + "key Escape\n")
        self.run("unasked", path, "key Ctrl+G\nkey Ctrl+P\nkey Escape\n")
        names = lambda: sorted(each.name for each in self.folder.rglob("*.???"))
        self.check(names() == ["plan.map", "script.txt"], f"pictures were saved unasked: {names()}")
        self.run("picture", path, ask + "key Return\nexpect saved plan.png\n"
                 + ask + "key Return\nexpect saved plan-2.png\n"
                 "key Ctrl+G\nkey Return\nexpect saved plan.svg\n")
        self.run("wrong ending", path, ask + "key Ctrl+U\ntype hall.jpg\nkey Return\n"
                 "expect end in .png, .svg or .pdf\nkey Escape\n")
        self.run("replaced", path, ask + "key Ctrl+U\ntype plan.png\nkey Return\n"
                 "expect Replace the file?\nkey R\nexpect saved plan.png\n")
        self.run("account", path, "key L\n" + ask + "key Ctrl+U\ntype cost.pdf\nkey Return\n"
                 "expect the account beside it\n")
        self.check(names() == ["cost-account.pdf", "cost.pdf", "plan-2.png", "plan.map", "plan.png",
                               "plan.svg", "script.txt"], f"pictures: {names()}")
        self.check(not list(self.folder.glob("*.png")), "a picture is in the working folder")

    def asks_before_many_pictures(self):
        path = self.write("plan.map", PLAN)
        frames = self.folder / "plan-frames"
        script = "key F9\ndown W\nwait 6\nup W\nkey F9\naction export_series\n"
        self.run("no way", path, "action export_series\nexpect no way was recorded\n")
        self.run("no pictures", path, script + "expect pictures of 800 x 600 pixels\nkey Escape\n")
        self.check(not frames.exists(), "pictures were saved unasked")
        self.run("pictures", path, script + "key Return\nexpect frames in\n")
        self.check(any(frames.glob("*.png")), "no pictures were saved")


def main():
    viewer = Viewer(sys.argv)
    for name in [name for name in vars(Cases) if not name.startswith("_")]:
        if name in ("write", "run", "check"):
            continue
        with tempfile.TemporaryDirectory() as folder:
            getattr(Cases(viewer, pathlib.Path(folder).resolve()), name)()
    viewer.end()


if __name__ == "__main__":
    main()
