"""What lessons, explanations, the quiz and the first-person pane say: VIEW SAME ROOT.

Scripts print the state; nothing here depends on pixels, except where the pointer is put.
"""
import pathlib
import re
import sys
import tempfile

from viewing import Viewer

SIZE = "size 1280 800\n"
EYE = "eye 53 20 160\n"


class Lessons(Viewer):
    def __init__(self, arguments, folder):
        super().__init__(arguments)
        self.folder = folder

    def say(self, map_name, script):
        """The lines that a script prints, as one list for each "print"."""
        path = self.folder / "script.txt"
        path.write_text(SIZE + script)
        done = self.run(self.root / "maps" / map_name, "--script", path, cwd=self.folder)
        self.check(done.returncode == 0, f"{map_name}: {done.stderr}")
        return done.stdout.splitlines()

    def facts(self, map_name, script, name):
        """All values of a fact, in order."""
        start = name + ": "
        return [line[len(start):] for line in self.say(map_name, script) if line.startswith(start)]


def check_far_places(v):
    """Places of a national grid are told from each other."""
    path = v.folder / "far.map"
    path.write_text("sightline 1\nwalls 2600000 1200000 2600020 1200000 2600020 1200010 "
                    "2600000 1200010 2600000 1200000\nwall 2600010 1200000 2600010 1200004\n"
                    "start 2600005.25 1200005.5 0\n")
    said = v.facts(path, "move 1200 15\nprint place\nmove 300 300\nprint place\n", "place")
    v.check("Cell 0 at 2600005.25, 1200005.5: " in said[0], f"far from the origin: {said}")
    v.check(re.search(r" at 26000\d\d\.\d+, 12000\d\d\.\d+: ", said[1]), f"the pointer: {said}")


def step(text):
    return int(text.split()[0])


def check_seeking(v):
    """Next new cell, back, next rejection."""
    script = EYE + "key F2\n" + "key Ctrl+Right\nprint lesson\n" * 5 + "key Ctrl+Left\nprint lesson\n"
    steps = [step(each) for each in v.facts("office.map", script, "step")]
    v.check(steps[:5] == sorted(set(steps[:5])) and steps[5] == steps[3], f"new cells: {steps}")
    said = v.facts("office.map", script, "sentence")
    v.check(all("seen for the first time" in each for each in said), f"new cells: {said}")
    said = v.facts("office.map", EYE + "key F2\n" + "key R\nprint lesson\n" * 8, "sentence")
    v.check(len(set(said)) > 4 and all(each.startswith("No line") or "goes back" in each for each in said),
            f"rejections: {said}")
    # A subdivision by a kd-tree rejects nothing: the step stays.
    steps = v.facts("office.map", "key F2\nkey U\nprint lesson\nkey R\nprint lesson\n", "step")
    v.check(len(set(steps)) == 1, f"a kd-tree's steps: {steps}")
    # Of a mesh some sides stay.
    said = v.facts("oblique/chapel.map", "key F2\nkey U\n" + "key R\nprint lesson\n" * 3, "sentence")
    v.check(len(set(said)) == 3 and all(" stays: " in each for each in said), f"a mesh: {said}")


def check_view_cells(v):
    """Doors that are shut, and glass, are walls of the view cells too: sanitizers find those left out."""
    for name in ["doors", "oneway"]:
        v.say(f"effects/{name}.map", "key F5\nkey F6\n")


def check_speed(v):
    """A second plays two steps; twice as fast, four; half as fast, one."""
    for keys, expected in [("", 2), ("key =\n", 4), ("key =\nkey =\nkey =\n", 16), ("key -\n", 1)]:
        steps = v.facts("office.map", EYE + "key F2\n" + keys + "print lesson\nkey Space\nwait 62\n"
                        "print lesson\n", "step")
        v.check(step(steps[1]) - step(steps[0]) == expected, f"{keys!r}: {steps}")


def check_changes(v):
    """Ends and the line are moved by keys, undone one by one, and reset."""
    moves = "key .\nkey Right\nprint lesson\nkey .\nkey Up\nprint lesson\nkey .\nkey Left\nprint lesson\n"
    script = EYE + "key F2\n" + "key Right\n" * 3 + "print lesson\n" + moves
    back = script + "key Ctrl+Z\nprint lesson\n" * 3
    lines = v.say("office.map", back)
    states, now = [], None
    for line in lines:
        if line.startswith("lesson: "):
            now = []
            states.append(now)
        if re.match("portal|line|dragged|chosen", line):
            now.append(line)

    def places(state):
        return [line for line in state if not line.startswith("chosen")]

    v.check(len(states) == 7, f"{len(states)} states")
    begin, line, left, right, undone, twice, thrice = states
    v.check(places(undone) == places(left) and places(twice) == places(line) and
            places(thrice) == places(begin), "undo does not go back")
    chosen = [[each for each in state if each.startswith("chosen")][0] for state in states[:4]]
    v.check(chosen == ["chosen: nothing", "chosen: the line", "chosen: left end of portal 1",
                       "chosen: right end of portal 1"], f"{chosen}")
    v.check([each for each in line if each.startswith("portal")] ==
            [each for each in begin if each.startswith("portal")] and places(line) != places(begin),
            "the line alone should have moved")
    v.check("dragged: no" in line and "dragged: yes" in left and "dragged: no" in thrice, "dragged")
    y = [float(re.search(r"portal 1: left \S+ (\S+)", " ".join(state)).group(1)) for state in (line, left)]
    v.check(y[1] > y[0], f"Up should raise the end: {y}")
    reset = v.say("office.map", script + "key Delete\nprint lesson\n")
    end = reset[len(reset) - reset[::-1].index("lesson: Depth-first search") - 1:]
    v.check([each for each in end if re.match("portal|line|dragged", each)] == places(begin), "reset")
    # A comma goes the other way round; Escape chooses nothing.
    script = EYE + "key F2\n" + "key Right\n" * 3
    chosen = v.facts("office.map", script + "key ,\nprint lesson\nkey Escape\nprint lesson\n", "chosen")
    v.check(chosen[0].startswith("right end") and chosen[1] == "nothing", f"{chosen}")


def conflicts(v, map_name, script):
    return [set(each.split()[1:]) for each in v.facts(map_name, script, "conflict")]


def check_why(v):
    """The conflict that is explained is that of the step that it leads to, and of the portals there."""
    for map_name, eye, places in [
            ("office.map", EYE, [(300, 300), (100, 600), (740, 560), (860, 170), (420, 480)]),
            ("oblique/chapel.map", "", [(250, 300), (850, 480), (740, 280)]),
            ("effects/doors.map", "key F8\n", [(100, 200), (800, 200), (500, 300)])]:
        script = eye + "".join(f"key F1\nright {x} {y}\nprint why\nkey Ctrl+T\nprint lesson\n" for x, y in places)
        lines = v.say(map_name, script)
        text = "\n".join(lines)
        parts = text.split("why: ")[1:]
        v.check(len(parts) == len(places), f"{map_name}: {len(parts)} answers")
        for part in parts:
            to = part.splitlines()[0].split()[-1]
            sentence = re.search("sentence: (.*)", part)
            v.check(sentence is not None, f"{map_name}: no step for {part.splitlines()[0]}")
            if not sentence:
                continue
            found = re.findall("conflict: (.*)", part)
            if "words: Not seen" in part:
                v.check(len(found) == 2 and sorted(found[0].split()) == sorted(found[1].split()),
                        f"{map_name}: {found}")
                v.check(re.search("No line|goes back", sentence.group(1)), sentence.group(1))
            elif "words: Seen" in part:
                v.check(f"enter cell {to}," in sentence.group(1), f"{map_name}: {sentence.group(1)}")
                v.check(found == ["stabbed"], f"{map_name}: {found}")


def check_mirrors(v):
    """What only a mirror shows is explained by a bent line; what glass may bar is not."""
    words = v.facts("effects/mirrors.map", "key F8\nright 400 600\nprint why\n", "words")
    v.check(words[0].startswith("Not seen.") and "by mirror: the purple line" in words[0], f"{words}")
    words = v.facts("effects/mirrors.map", "key F8\nright 600 200\nprint why\n", "words")
    v.check(words[0].startswith("Seen: ") and "purple" not in words[0], f"{words}")


def check_twins(v):
    """An end under the pointer in the plan; its border in the dual plane; its row in the table."""
    script = EYE + "key F2\n" + "key R\n" + "key Ctrl+L\nmove 600 540\nprint lesson\n"
    hovered = v.facts("office.map", script, "hovered")
    without = any("needs GLPK" in line for line in v.say("office.map", script + "print program\n"))
    v.check(without or re.match("(left|right) end of portal", hovered[0]), f"a row of the table: {hovered}")
    # The pointer where the end is: the map's place is printed, the page's follows from two others.
    lines = v.say("office.map", EYE + "key F2\nkey R\nprint lesson\n")
    portal = next(each for each in lines if each.startswith("portal 1:"))
    x, y = (float(each) for each in portal.split()[3:5])
    found = set()
    for px in range(600, 700, 3):
        script = EYE + "key F2\nkey R\n" + "".join(
            f"move {px} {py}\nprint lesson\n" for py in range(215, 285, 5))
        found |= set(v.facts("office.map", script, "hovered"))
        if "left end of portal 1" in found and "right end of portal 1" in found:
            break
    v.check("left end of portal 1" in found or "right end of portal 1" in found,
            f"no end of portal 1 ({x}, {y}) under the pointer: {found}")
    hovered = v.facts("office.map", EYE + "key F2\nkey R\n" + "".join(
        f"move 450 {y}\nprint lesson\n" for y in range(450, 660, 6)), "hovered")
    v.check(len({each for each in hovered if each != "nothing"}) > 2, f"the dual plane: {set(hovered)}")
    steps = v.facts("office.map", EYE + "key F2\n" + "move 300 757\nprint lesson\nmove 700 757\nprint lesson\n",
                    "hovered step")
    v.check(0 < int(steps[0]) < int(steps[1]), f"the time line: {steps}")


def check_program(v):
    script = EYE + "key F2\nkey Right\nkey Right\nprint program\nkey R\nprint lesson\nprint program\n"
    programs = v.facts("office.map", script, "program")
    if programs and "GLPK" in programs[0]:
        return  # built without it, and it says so
    margins = [float(each) for each in v.facts("office.map", script, "margin")]
    v.check(programs[0].endswith("solved") and margins[0] > 0 > margins[1], f"{programs} {margins}")
    rows = [line for line in v.say("office.map", script) if line.startswith("row ")]
    v.check(any("tight" in row for row in rows) and any("basic" in row for row in rows), "no basis")


def check_quiz(v):
    script = "key F4\nprint quiz\nkey Y\nprint why\nprint quiz\nkey Space\nprint quiz\nkey N\nprint why\n"
    script += "key Space\nkey Y\nprint why\nkey Space\nkey N\nprint why\nprint quiz\n"
    first, again = v.say("office.map", script), v.say("office.map", script)
    v.check(first == again, "under scripts questions are the same")
    asked = [line for line in first if line.startswith("quiz: ")]
    v.check(asked[0] == asked[1] != asked[2], f"{asked}")
    words = [line[7:] for line in first if line.startswith("words: ")]
    right = sum(each.startswith("Right. ") for each in words)
    wrong = sum(each.startswith("Wrong: you said that it is ") for each in words)
    v.check(len(words) == 4 == right + wrong and right and wrong, f"{words}")
    for each in words:
        if each.startswith("Wrong"):
            v.check(("Seen: " in each) != ("no line gets there" in each), each)
    v.check(first[-1] == f"answers: {right} of 4 right", f"{first[-1]}: {right}")


def check_present(v):
    """Without the panel the question, the verdict and the reasons stand over the bottom line."""
    quiz = "key F4\nprint bar\nkey Y\nprint bar\nkey Space\nprint bar\n"
    v.check(v.facts("office.map", quiz, "bar") == ["nothing"] * 3, "the panel has it")
    for hide in ("key F12\n", "key Ctrl+B\n"):
        asked, judged, other = v.facts("office.map", hide + quiz, "bar")
        v.check(re.fullmatch(r"Can the orange cell \d+ see the purple cell \d+\?", asked), asked)
        v.check(re.match(re.escape(asked) + " (Right|Wrong)", judged), judged)
        v.check(other.startswith("Can the orange cell") and other != asked, other)
    why = "right 200 300\nprint why\nprint bar\nkey Escape\nprint bar\n"
    words = v.facts("office.map", "key F12\n" + EYE + why, "words")
    bars = v.facts("office.map", "key F12\n" + EYE + why, "bar")
    v.check(bars[0].startswith("From cell ") and bars[0].endswith(words[0]) and bars[1] == "nothing", f"{bars}")
    # The button that leaves is there at any size, and the legend leaves the map free until it is asked for.
    bar = v.facts("office.map", "size 1024 768\nkey F12\nscreenshot a.png\nclick 668 24\nkey F4\nprint bar\n", "bar")
    v.check(bar == ["nothing"], f"the button does not end the presentation: {bar}")
    keys = "".join(f"{key}screenshot a.png\nprint legend\n" for key in ("key F12\n", "key F7\n", "key F7\n", "click 80 652\n"))
    legends = v.facts("office.map", "size 1280 720\n" + keys, "legend")
    v.check(legends == ["a button", "on", "off", "off"], f"{legends}")
    legends = v.facts("office.map", "size 1280 720\nkey F12\nscreenshot a.png\nclick 80 652\nscreenshot a.png\nprint legend\n", "legend")
    v.check(legends == ["on"], f"the button does not open the legend: {legends}")


def check_why_in_lesson(v):
    """In a lesson a right click has the plan until the lesson goes on."""
    script = EYE + "key F2\nkey R\nprint bar\nsave step.svg\nright 200 300\nprint bar\nsave why.svg\n"
    script += "key Right\nprint bar\nkey Left\nprint bar\nsave again.svg\n"
    step_said, why, after, again = v.facts("office.map", script, "bar")
    v.check(why.startswith("From cell ") and after != why and again == step_said, f"{why} / {after} / {again}")
    purple = "rgb(65.882353%,28.235294%,49.019608%)"  # of the cell that was asked about
    shown = [purple in (v.folder / f"{name}.svg").read_text().replace(", ", ",") for name in ("step", "why", "again")]
    v.check(shown == [False, True, False], f"the plan shows the pair: {shown}")


def check_subdivision(v):
    """U goes to the subdivision from anywhere."""
    for key in ("", "key F3\n", "key F4\n"):
        lessons = v.facts("office.map", key + "key U\nprint lesson\nkey U\nprint lesson\n", "lesson")
        v.check(len(lessons) == 2 and "ubdivision" in lessons[0] and lessons[1] != lessons[0], f"{key!r}: {lessons}")


def check_doors(v):
    """Doors of one name are one door."""
    plan = (v.root / "maps/effects/doors.map").read_text()
    path = v.folder / "named.map"
    path.write_text(plan.replace("door east ", "door west "))
    script = "key F8\nclick 323 550\nprint doors\nkey Ctrl+Z\nprint doors\n"
    lines = [line for line in v.say(path, script) if line.startswith("door west")]
    v.check(lines == ["door west: shut"] * 2 + ["door west: open"] * 2, f"{lines}")
    shut = v.facts("effects/doors.map", "key F8\nclick 323 550\nprint doors\n", "door west")
    v.check(shut == ["shut"], f"a door of its own: {shut}")


def first_person(v, map_name, script):
    lines = v.say(map_name, "action effects\n" + script + "action first_person\nprint first_person\n")
    return {name: int(count) for name, count in (line.split(": ") for line in lines)}


def check_first_person(v):
    c = first_person(v, "effects/mirrors.map", "eye 5 25 0 90\n")
    v.check(c["reflected"] > 300 and c["mirrors"] >= c["reflected"], f"a mirror: {c}")
    c = first_person(v, "effects/mirrors.map", "eye 5 25 180 90\n")
    v.check(c["reflected"] == c["mirrors"] == 0, f"away from mirrors: {c}")
    c = first_person(v, "effects/oneway.map", "eye 25 10 180 90\n")
    v.check(c["tinted"] > 300 and not c["dark"], f"glass from behind it: {c}")
    c = first_person(v, "effects/oneway.map", "eye 5 5 0 90\n")
    v.check(c["dark"] > 200 and not c["tinted"], f"dark glass: {c}")
    doors = "effects/doors.map"
    c = first_person(v, doors, "eye 7 5 0 90\n")
    v.check(c["frames"] > 100 and not c["leaves"], f"open doors: {c}")
    shut = first_person(v, doors, "eye 7 5 0 90\nkey N\n")
    v.check(shut["leaves"] > 100 and not shut["frames"] and shut["pieces"] < c["pieces"], f"shut: {shut}")
    for reach, frames in [("2", False), ("20", True)]:
        path = v.folder / "reach.map"
        path.write_text((v.root / "maps" / doors).read_text() + f"range {reach}\n")
        c = first_person(v, path, "eye 7 5 0 90\n")
        v.check(bool(c["frames"]) == frames, f"a range of {reach}: {c}")
    c = first_person(v, "office.map", EYE)
    v.check(not any(c[name] for name in c if name != "pieces") and c["pieces"], f"walls alone: {c}")


def check_numbers(v):
    """The layer changes the saved plan, and only where it is switched on."""
    v.script(v.folder, "office.map", SIZE + "save off.svg\nkey 0\nsave on.svg\nkey 0\nsave again.svg\n")
    # cairo counts its surfaces, images and patterns through.
    off, on, again = (re.sub(rb"\b(surface|image|pattern)\d+", rb"\1", (v.folder / f"{name}.svg").read_bytes())
                      for name in ("off", "on", "again"))
    v.check(off == again and len(on) > len(off) + 5000, "numbers are not drawn into saved plans")


def main():
    with tempfile.TemporaryDirectory() as name:
        v = Lessons(sys.argv, pathlib.Path(name))
        for check in (check_seeking, check_far_places, check_view_cells, check_speed, check_changes, check_why, check_mirrors, check_twins, check_program,
                      check_quiz, check_present, check_why_in_lesson, check_subdivision,
                      check_doors, check_first_person, check_numbers):
            check(v)
        path = v.folder / "bad.txt"
        path.write_text("print nonsense\n")
        done = v.run(v.root / "maps/office.map", "--script", path)
        v.check(done.returncode == 2 and "bad.txt:1" in done.stderr, f"print nonsense: {done.stderr}")
        v.end()


if __name__ == "__main__":
    main()
