"""Every command and method on small maps with every effect and every pair of effects.

test_effects.py PROGRAM [OPTIONS]          checks the table of tools/EFFECTS.md
test_effects.py PROGRAM [OPTIONS] --print  prints the table, to be put there

--runtime RUNTIME_EFFECTS  with the rows of the runtime header: tests/command/runtime_effects.c
--site SITE                with the rows of the playground: its built site; needs node
--only                     without those of the program
Without an option its rows are not checked.
"""
import argparse
import itertools
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import textwrap
import unittest

import sandbox

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCUMENT = pathlib.Path(__file__).resolve().parents[2] / "tools" / "EFFECTS.md"
WHOLE = "`+` throughout: "  # the rows that have nothing else
BEGIN, END = "<!-- the table -->\n", "<!-- the end of the table -->\n"

# Three rooms in a row and one above them; each effect stands in a place of its own.
ROOMS = """sightline 1
walls 0 0 30 0 30 20 0 20 0 0
wall 10 0 10 3
wall 10 5 10 10
wall 20 0 20 3
wall 20 5 20 10
wall 0 10 4 10
wall 6 10 30 10
start 5 5 0
path tour 2 2 8 8 2 8
"""
EFFECTS = {
    "doors": "door west 10 3 10 5 open\n",
    "shut": "door above 4 10 6 10 shut\n",
    "mirrors": "mirror 12 10 18 10\n",
    "glass": "oneway 20 3 20 5\n",
    "range": "range 12\n",
    "boxes": "object crate 6 3 7 4\n",
}
COLUMNS = [(name,) for name in EFFECTS] + list(itertools.combinations(EFFECTS, 2)) + [tuple(EFFECTS)]
ALL = ["+"] * len(EFFECTS)
FORMATS = {"json": "json", "geojson": "geojson", "csv": "csv", "c": "h", "png": "png"}


def rows(methods):
    """What is run: a name, the arguments, and what is given besides where there are boxes."""
    for method in methods:
        yield f"bake --method {method}", ["bake", "MAP", "-o", "out.slv", "--method", method], None
    yield "bake --time-limit", ["bake", "MAP", "-o", "out.slv", "--time-limit", "1e-9"], None
    yield "bake --shard", ["bake", "MAP", "-o", "out.slv", "--shard", "1/2"], None
    yield "bake --previous", ["bake", "MAP", "-o", "out.slv", "--previous", "SLV"], None
    yield "info", ["info", "SLV"], None
    yield "eye", ["eye", "SLV", "--at", "5,5", "--json", "-o", "out.png"], ["--object", "crate,block"]
    yield "isovist", ["isovist", "MAP", "--at", "5,5", "--picture", "out.png"], None
    yield "path", ["path", "MAP", "--from", "5,5", "--to", "25,2", "--picture", "out.png"], None
    yield "vga", ["vga", "MAP", "--grid", "1"], None
    yield "axial", ["axial", "MAP"], None
    yield "explain", ["explain", "SLV", "5,5", "25,2"], None
    yield "walk", ["walk", "SLV", "--steps", "5", "--repeat", "1"], None
    yield "regions", ["regions", "MAP", "--grid", "2", "--objects", "walls", "--points", "16",
                      "--pixels", "4"], None
    yield "viewcells", ["viewcells", "MAP", "--cells", "4", "--samples", "200", "--evaluate", "0"], None
    yield "compare", ["compare", "MAP", "--methods", "prune,dfs", "--solvers", "funnel",
                      "--repeat", "1"], None
    yield "compare --eye", ["compare", "MAP", "--eye", "--viewpoints", "20"], None
    yield "draw", ["draw", "SLV", "-o", "out.png"], None
    for name, ending in FORMATS.items():
        yield (f"export --format {name}",
               ["export", "SLV", "--format", name, "-o", "out." + ending], None)


# Eyes in front of the glass, before and behind doors, in sight of the mirror.
EYES = ["5.1,5.3", "13.2,5.1", "17.3,1.7", "25.1,4.2", "5.3,15.1"]


def run_beside(command, path):
    """Runs a program that compares with the library: what it prints of a map, or why it cannot."""
    environment = {**os.environ, "SDL_VIDEODRIVER": "dummy"}
    done = subprocess.run([*command, path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False, env=environment)
    sandbox.check(done.returncode == 0, f"{command[0]} {path.name}: {done.stderr}")
    return done.stdout


def rows_of_lines(command, path):
    """Lines "NAME<tab>+<tab>NOTE..." or "NAME<tab>REASON"."""
    for line in run_beside(command, path).splitlines():
        name, entry, *notes = line.split("\t")
        if entry == "+":
            yield name, "+", [note for note in notes if note]
        else:
            yield name, "", [reason_of(entry)]


def rows_of_site(site, box, base):
    """The playground sees what `eye` does: cells, area, and areas in mirrors."""
    map_file = box.path(base + ".map")
    # The circle of a range is made of chords there.
    slack = 2e-3 if "range" in map_file.read_text() else 1e-9
    command = ["node", str(ROOT / "viewer/web/test/effects.mjs"), str(site), str(map_file), *EYES]
    found = json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout)
    for eye, seen in zip(EYES, found["seen"]):
        answer = json.loads(box.run(["eye", base + ".slv", "--at", eye, "--json"]).stdout)
        mirrored = [part["area"] for part in answer.get("mirrored_region", [])]
        sandbox.check(seen["cells"] == len(answer["methods"]["exact"]) and
                      math.isclose(seen["area"], answer["region"]["area"], rel_tol=slack) and
                      len(seen["mirrored"]) == len(mirrored) and
                      math.isclose(sum(seen["mirrored"]), sum(mirrored), rel_tol=slack),
                      f"the playground, {base}, eye {eye}: {seen}, not {answer}")
    yield "playground: the eye", "+", []
    yield "playground: the heat map", "" if found["heat"] else "+", \
        [reason_of(found["heat"])] if found["heat"] else []
    yield from rows_between(found, box, base)


def rows_between(found, box, base):
    """The playground's lines and paths are those of `isovist --from-line` and `path`."""
    line, way = found["line"], found["way"]
    ends = ",".join(str(number) for end in line["ends"] for number in end)
    answer = box.run(["isovist", base + ".slv", "--from-line", ends, "-o", "-"])
    areas = [float(row.split(",")[1]) for row in answer.stdout.splitlines()[1:]]
    sandbox.check(("refused" in line) == (answer.status != 0) and line.get("answer", []) == areas,
                  f"the playground, {base}, line: {line}, not {answer.text()}")
    origin, goal = (",".join(map(str, end)) for end in way["ends"])
    answer = box.run(["path", base + ".slv", "--from", origin, "--to", goal, "--json"])
    sandbox.check(way["answer"] == json.loads(answer.stdout).get("length"),
                  f"the playground, {base}, path: {way}, not {answer.text()}")
    yield "playground: lines", "" if "refused" in line else "+", \
        [reason_of(line["refused"])] if "refused" in line else []
    yield "playground: paths", "+", []


class Matrix:
    def __init__(self, box):
        self.box = box
        self.reasons = {}  # the reason: its letter
        self.others = {}  # name of a row that no command of the program gives: its entries

    def letter(self, reason):
        return self.reasons.setdefault(reason, chr(ord("a") + len(self.reasons)))

    def entry(self, arguments, boxes, column):
        base = "-".join(column)
        arguments = [{"MAP": base + ".map", "SLV": base + ".slv"}.get(a, a) for a in arguments]
        if boxes and "boxes" in column:
            arguments += boxes
        result = self.box.run(arguments)
        for name in result.new_files:
            path = self.box.path(name)
            if path.is_file():
                path.unlink()
        if result.status in (0, 3):  # 3: an answer, too: there is no way
            return "+" + "".join(self.letter(note) for note in notes_of(result.stderr))
        sandbox.check(result.status == 2, f"{arguments}: status {result.status}, {result.stderr}")
        return self.letter(reason_of(result.stderr))

    def make_maps(self):
        for column in COLUMNS:
            base = "-".join(column)
            text = ROOMS + "".join(EFFECTS[name] for name in column)
            self.box.path(base + ".map").write_text(text)
            result = self.box.run(["bake", base + ".map", "-o", base + ".slv", "--quiet"])
            sandbox.check(result.status == 0, f"{base}.map is not baked: {result.stderr}")

    def commands(self):
        """Those of rows() that the program has."""
        known = self.box.run(["--help"]).stdout
        text = self.box.run(["bake", "--help", "all"]).stdout
        methods = re.findall(r"^  (\S+)", text.split("\nmethods:\n")[1].split("\n\n")[0], re.M)
        return [row for row in rows(methods) if re.search(rf"^  {row[1][0]} ", known, re.M)]

    def ask_others(self, base):
        """The rows of the runtime header and the playground, one column of them."""
        found = []
        if OPTIONS.runtime:
            found += rows_of_lines([OPTIONS.runtime], self.box.path(base + ".slv"))
        if OPTIONS.site:
            found += rows_of_site(OPTIONS.site, self.box, base)
        for name, sign, reasons in found:
            self.others.setdefault(name, []).append((sign, reasons))

    def table(self):
        self.make_maps()
        short = {name: name[0].upper() for name in EFFECTS}
        heads = [short[name] for name in EFFECTS]
        made = {}  # the name of a row: its entries
        for name, arguments, boxes in [] if OPTIONS.only else self.commands():
            made[f"`{name}`"] = [self.entry(arguments, boxes, column) for column in COLUMNS]
        for column in COLUMNS:
            self.ask_others("-".join(column))
        for name, found in self.others.items():
            made[name] = [sign + "".join(map(self.letter, reasons)) for sign, reasons in found]
        lines = ["| | " + " | ".join(heads) + " |", "| --- |" + " :-: |" * len(heads)]
        alone = {name: row[:len(EFFECTS)] for name, row in made.items()}
        lines += [f"| {name} | " + " | ".join(row) + " |" for name, row in alone.items() if row != ALL]
        whole = "; ".join(name for name, row in alone.items() if row == ALL)
        lines += ["", *textwrap.wrap(WHOLE + whole, 118, break_on_hyphens=False), ""]
        lines += [f"- {name} with {''.join(short[effect] for effect in column)}: {entry}"
                  for name, row in made.items() for column, entry in zip(COLUMNS, row)
                  if not follows(entry, [alone[name][list(EFFECTS).index(effect)] for effect in column])]
        lines += [f"- {letter}: {reason}" for reason, letter in self.reasons.items()]
        return "\n".join(lines).rstrip() + "\n"


def follows(entry, alone):
    """Whether what happens with several effects is what happens with each of them: it is refused where
    one is, and else has the notes of all."""
    refused = [one for one in alone if one[0] != "+"]
    return entry in refused if refused else set(entry) == set("".join(alone))


def reason_of(message):
    """What the program says last, without the file and what differs from column to column."""
    text = message.strip().splitlines()[-1]
    text = re.sub(r"^(sightline: )?((\S+\.(map|slv)|map)(:\d+)?: )?", "", text)
    text = re.sub(r"calls for [^;]*?, which", "calls for what", text)
    return re.sub(r"; (bake )?--without .*", "", text)


def notes_of(text):
    """What is noted of effects that are taken in part."""
    text = re.sub(r"taken over from \S+:", "taken over:", text)
    return re.findall(r"^note: (doors stand as the map has them|mirrors are walls here.*"
                      r"|one-way glass is open.*|nothing is taken over: the map has.*"
                      r"|the walk's own methods.*)", text, re.M)


def spelled_out(table):
    """The rows of a table with reasons in the place of letters: those of one run need not be those of
    another one, which had more rows."""
    reasons = dict(re.findall(r"^- (\S): (.*)$", table, re.M))
    rows_found = {}
    for name, entries in re.findall(r"^\| ([^|-][^|]*) \| (.*) \|$", table, re.M):
        rows_found[name] = [[reasons.get(letter, letter) for letter in entry]
                            for entry in entries.split(" | ")]
    for name, entry in re.findall(r"^- (.* with [A-Z]+): (.*)$", table, re.M):
        rows_found[name] = [[reasons.get(letter, letter) for letter in entry]]
    whole = (table + "\n\n").split(WHOLE.strip())[1].split("\n\n")[0]
    for name in " ".join(whole.split()).split("; "):
        if name:
            rows_found[name] = [[entry] for entry in ALL]
    return rows_found


class Effects(unittest.TestCase):
    def test_table(self):
        with sandbox.Sandbox(PROGRAM) as box:
            made = Matrix(box).table()
        text = DOCUMENT.read_text()
        stored = text[text.index(BEGIN) + len(BEGIN):text.index(END)]
        self.maxDiff = None
        if OPTIONS.runtime and OPTIONS.site:
            self.assertEqual(stored.strip(), made.strip(),
                             "the table is out of date: put in what --print prints")
        have, now = spelled_out(stored), spelled_out(made)
        self.assertGreater(len(now), 1)
        given = {"runtime": OPTIONS.runtime, "playground": OPTIONS.site}
        for name, row in have.items():
            if given.get(name.split(":")[0], not OPTIONS.only):
                self.assertEqual(row, now.get(name), f"{name} is out of date: put in what --print "
                                 "prints")
        self.assertEqual(set(now) - set(have), set(), "rows are missing: put in what --print prints")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--runtime", type=pathlib.Path)
    parser.add_argument("--site", type=pathlib.Path)
    parser.add_argument("--only", action="store_true")
    parser.add_argument("--print", action="store_true")
    OPTIONS = parser.parse_args()
    for given_path in ("runtime", "site"):
        if getattr(OPTIONS, given_path):
            setattr(OPTIONS, given_path, getattr(OPTIONS, given_path).resolve())
    PROGRAM = pathlib.Path(OPTIONS.program).resolve()
    if OPTIONS.print:
        with sandbox.Sandbox(PROGRAM) as sandbox_box:
            print(Matrix(sandbox_box).table(), end="")
        sys.exit()
    unittest.main(argv=sys.argv[:1])
