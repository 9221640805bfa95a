"""Exports are as lib/bake/EXPORT.md says: JSON by its schema, GeoJSON by its form, the examples run,
and the JSON read as a map gives the same export again.

test_export.py PROGRAM
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import warnings

import sandbox
import slv_reader

ROOT = pathlib.Path(__file__).resolve().parents[2]
BAKE = ROOT / "lib/bake"
MAPS = sorted([*(ROOT / "maps").glob("*.map"), *(ROOT / "maps").glob("*/*.map"),
               *(ROOT / "maps").glob("*.txt"), *(ROOT / "tests/cases").glob("*.map")])
ALL_EFFECTS = """sightline 1
walls 0 0 12 0 12 8 0 8 0 0
wall 4 0 4 3
wall 4 5 4 8
wall 8 0 8 3
wall 8 5 8 8
solid 9 6 10 6 10 7 9 7
door west 4 3 4 5 open
oneway 8 5 8 3
mirror 1 0 3 0 one
mirror 5 8 7 8
seam 2 0 2 8
range 30
start 1 1 45.5
path tour 1 1 6 4
object crate 5 5 6 6
"""
BOX = "sightline 1\nwalls 0 0 4 0 4 3 0 3 0 0\nwall 1 1 1 2\nstart 2 1 0\n"
BOX_VERSION_1 = """{"format": "sightline", "version": 1, "sight": "closed",
"bounds": [0.0,0.0,4.0,3.0],
"walls": [
[0.0,0.0,0.0,3.0],
[1.0,1.0,1.0,2.0],
[4.0,0.0,4.0,3.0],
[0.0,0.0,4.0,0.0],
[0.0,3.0,4.0,3.0]],
"cells": [
{"id":0,"polygon":[[0.0,0.0],[1.0,0.0],[1.0,3.0],[0.0,3.0]],"inside":true},
{"id":1,"polygon":[[1.0,0.0],[4.0,0.0],[4.0,3.0],[1.0,3.0]],"inside":true}],
"portals": [
{"cells":[0,1],"segment":[1.0,1.0,1.0,0.0]},
{"cells":[0,1],"segment":[1.0,3.0,1.0,2.0]}],
"pvs": [
[0,1],
[0,1]]}
"""


def validator():
    """Of the schema; None without the package jsonschema."""
    try:
        import jsonschema
    except ImportError:
        return None
    schema = json.loads((BAKE / "export.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


class Export(sandbox.ProgramTest):
    def bake(self, text, *options):
        self.box.path("m.map").write_text(text, encoding="utf-8")
        self.printed("bake", "m.map", "-o", "m.slv", "-q", *options)

    def export(self, name="m.slv", *options):
        self.printed("export", name, "-o", name + ".json", "-q", *options)
        return json.loads(self.box.path(name + ".json").read_text(encoding="utf-8"))

    def test_schema(self):
        checked = validator()
        if not checked:
            self.skipTest("the Python package jsonschema is not here (Debian: python3-jsonschema)")
        for path in MAPS:
            with self.subTest(map=path.name):
                self.printed("bake", path, "-o", "m.slv", "-q")
                checked.validate(self.export())
        self.bake(ALL_EFFECTS)
        level = self.export()
        checked.validate(level)
        spoiled = [{**level, "version": 1}, {**level, "range": 0}, {**level, "guarantee": "maybe"},
                   {**level, "walls": [[0, 0, 1]]}, {**level, "doors": [{"name": "a b"}]}]
        spoiled += [{key: level[key] for key in level if key != gone} for gone in ("pvs", "range")]
        for data in spoiled:
            self.assertFalse(checked.is_valid(data))

    def test_map_again(self):
        """An export baked as a map gives the same export, to the last byte."""
        for path in MAPS:
            with self.subTest(map=path.name):
                self.printed("bake", path, "-o", "m.slv", "-q")
                self.export()
                self.printed("bake", "m.slv.json", "-o", "again.slv", "-q")
                self.export("again.slv")
                self.assertEqual(*(self.box.path(name).read_bytes()
                                   for name in ("m.slv.json", "again.slv.json")))

    def test_all_effects(self):
        self.bake(ALL_EFFECTS)
        level, slv = self.export(), slv_reader.Slv(self.box.path("m.slv").read_bytes())
        self.assertEqual(level["guarantee"], "exact")
        self.assertEqual(level["doors"],
                         [{"name": "west", "segments": [[4, 3, 4, 5]], "open": True}])
        self.assertEqual(level["mirrors"], [[1, 0, 3, 0], [5, 8, 7, 8]])
        self.assertEqual(level["one_sided_mirrors"], [0])
        self.assertEqual(level["oneways"], [[8, 5, 8, 3]])
        self.assertEqual(level["seams"], [[2, 0, 2, 8]])
        self.assertEqual(level["starts"], [{"at": [1, 1], "heading": 45.5}])
        self.assertEqual(level["paths"], [{"name": "tour", "points": [[1, 1], [6, 4]]}])
        self.assertEqual(level["objects"], [{"name": "crate", "box": [5, 5, 6, 6]}])
        self.assertEqual(level["range"], 30)
        self.assertEqual([sum(p[i] for c in level["cells"] if "solid" in c for p in c["polygon"])
                          for i in (0, 1)], [38, 26])
        self.assertEqual(len(level["solid_walls"]["left"] + level["solid_walls"]["right"]), 4)
        self.assertEqual(level["pvs"], slv.visible())
        self.assertEqual(level["mirrored"], slv.rows("MIRO", "MIRB"))
        for key, tags in ("door_sets", ("DORO", "DORB")), ("mirrored_door_sets", ("MDOO", "MDOB")):
            wanted = [{"cells": [a, b], "needs": [["west"] * len(doors) for doors in sets]}
                      for a, row in enumerate(slv.door_rows(*tags)) for b, sets in row.items()]
            self.assertTrue(wanted)
            self.assertEqual(level[key], wanted)

    def test_oneway_portals(self):
        """The glass is seen through from the cell that the rows say."""
        for way, glass in ("from", "oneway 4 3 4 0"), ("to", "oneway 4 0 4 3"):
            self.bake(f"sightline 1\nwalls 0 0 8 0 8 3 0 3 0 0\n{glass}\n")
            level = self.export()
            (portal,) = level["portals"]
            a, b = portal["cells"]
            self.assertEqual(portal["oneway"], way)
            self.assertEqual((b in level["pvs"][a], a in level["pvs"][b]),
                             (way == "from", way == "to"))
        self.bake("sightline 1\nwalls 0 0 8 0 8 3 0 3 0 0\noneway 4 0 4 3\noneway 4 3 4 0\n")
        level = self.export()
        self.assertEqual([level["portals"][0]["oneway"], level["pvs"]], ["none", [[0], [1]]])

    def test_doors_of_one_name(self):
        self.bake("sightline 1\nwalls 0 0 9 0 9 2 0 2 0 0\ndoor d 3 0 3 2\ndoor d 6 0 6 2 shut\n")
        level = self.export()
        self.assertEqual([door["name"] for door in level["doors"]], ["d", "d"])
        for item in level["door_sets"]:
            self.assertEqual(item["needs"], [["d"]])

    def test_doubtful_pairs(self):
        result = self.box.run(["bake", str(ROOT / "maps/office.map"), "-o", "m.slv", "-q",
                               "--method", "dfs", "--solver", "glpk"])
        if "this build has no GLPK" in result.stderr:
            self.skipTest("no GLPK in this build")
        self.assertEqual(result.status, 0, result.stderr)
        level, slv = self.export(), slv_reader.Slv(self.box.path("m.slv").read_bytes())
        self.assertEqual((level["guarantee"], level["solver"]), ("rounded", "glpk"))
        self.assertEqual(level["doubtful"], slv.rows("DBTO", "DBTB"))

    def test_view_cells(self):
        self.printed("viewcells", ROOT / "maps/office.map", "--cells", "6", "--elementary", "30",
                      "--samples", "2000", "--evaluate", "0", "--slv", "m.slv", "-q")
        level, slv = self.export(), slv_reader.Slv(self.box.path("m.slv").read_bytes())
        numbers = [item["view_cell"] for item in slv.items("VCEL")]
        self.assertEqual(level["view_cells"], [[c for c, n in enumerate(numbers) if n == i]
                                               for i in range(6)])
        self.assertEqual([set(row) for row in level["view_cell_pvs"]],
                         [set(row) for row in slv.view_rows()])

    def test_version_1(self):
        """The older form, to the last byte."""
        self.bake(BOX)
        level = self.printed("export", "m.slv", "--json-version", "1")
        self.assertEqual(level, BOX_VERSION_1)
        self.box.path("old.json").write_text(level, encoding="utf-8")
        self.assertEqual(self.printed("convert", "old.json", "-q").count("wall"), 5)

    def test_geojson(self):
        self.bake(ALL_EFFECTS)
        level = self.export()
        places = self.export("m.slv", "--format", "geojson")
        self.assertEqual(set(places), {"type", "crs", "features"})
        kinds = {}
        for feature in places["features"]:
            self.assertEqual((feature["type"], set(feature)),
                             ("Feature", {"type", "geometry", "properties"}))
            kinds.setdefault(feature["properties"]["kind"], []).append(
                (feature["geometry"]["type"], feature["geometry"]["coordinates"],
                 feature["properties"]))
        self.assertEqual(set(kinds), {"cell", "portal", "wall", "door", "mirror", "oneway", "start"})
        for (kind, rings, properties), cell, row in zip(kinds["cell"], level["cells"], level["pvs"]):
            self.assertEqual((kind, rings), ("Polygon", [cell["polygon"] + cell["polygon"][:1]]))
            self.assertEqual(properties, {"kind": "cell", "id": cell["id"], "sees": len(row),
                                          "inside": cell["inside"], "solid": "solid" in cell})
        for (kind, line, properties), portal in zip(kinds["portal"], level["portals"]):
            self.assertEqual((kind, line[0] + line[1]), ("LineString", portal.pop("segment")))
            self.assertEqual(properties, {"kind": "portal", **portal})
        self.assertEqual([len(kinds[kind]) for kind in ("cell", "portal", "wall")],
                         [len(level[key]) for key in ("cells", "portals", "walls")])
        self.assertEqual([line[0] + line[1] for _, line, _ in kinds["wall"]], level["walls"])
        self.assertEqual(kinds["door"], [("LineString", [[4, 3], [4, 5]],
                                          {"kind": "door", "name": "west", "open": True})])
        self.assertEqual(kinds["start"], [("Point", [1, 1], {"kind": "start", "heading": 45.5})])

    C_PROGRAM = """
#include <stdio.h>
#include "FIRST.h"
void second(void);
static void cells(void) {
    for (int i = 0; i < NAME_CELLS; i++) {
        printf("cell %d %d", NAME_cells[i].inside, NAME_cells[i].solid);
        for (int k = 0; k < NAME_cells[i].count; k++)
            printf(" %.17g %.17g", NAME_corners[NAME_cells[i].first + k][0],
                   NAME_corners[NAME_cells[i].first + k][1]);
        printf("\\nsees");
        for (int k = 0; k < NAME_CELLS; k++) if (NAME_SEES(i, k)) printf(" %d", k);
        printf("\\n");
    }
}
ENTRY {
    cells();
    for (int i = 0; i < NAME_PORTALS; i++)
        printf("portal %d %d %.17g %.17g %.17g %.17g %s %d\\n", NAME_portals[i].from,
               NAME_portals[i].to, NAME_portals[i].left[0], NAME_portals[i].left[1],
               NAME_portals[i].right[0], NAME_portals[i].right[1],
               NAME_portals[i].door < 0 ? "-" : NAME_doors[NAME_portals[i].door].name,
               NAME_portals[i].oneway);
    for (int i = 0; i < NAME_DOORS; i++)
        printf("door %s %d\\n", NAME_doors[i].name, NAME_doors[i].open);
    for (int i = 0; i < NAME_STARTS; i++)
        printf("start %.17g %.17g %.17g\\n", NAME_starts[i].at[0], NAME_starts[i].at[1],
               NAME_starts[i].heading);
    END
}
"""

    def c_lines(self, level):
        """What the program above prints, by the JSON export of the same map."""
        ways = {None: 0, "from": 1, "to": 2, "none": 3}
        for cell, row in zip(level["cells"], level["pvs"]):
            yield ["cell", cell["inside"], "solid" in cell, *sum(cell["polygon"], [])]
            yield ["sees", *row]
        for portal in level["portals"]:
            yield ["portal", *portal["cells"], *portal["segment"], portal.get("door", "-"),
                   ways[portal.get("oneway")]]
        doors = {}
        for door in level.get("doors", []):
            doors[door["name"]] = doors.get(door["name"], True) and door["open"]
        for name, is_open in doors.items():
            yield ["door", name, is_open]
        for start in level.get("starts", []):
            yield ["start", *start["at"], start["heading"]]

    def test_c(self):
        """Two exports make one program, without a warning, and it holds what the JSON holds."""
        compilers = [name for name in ("gcc", "clang", "cc") if shutil.which(name)]
        if not compilers:
            self.skipTest("no C compiler is here")
        texts = ['sightline 1\nwalls 0 0 9 0 9 2 0 2 0 0\ndoor d 3 0 3 2\n'
                 'door d 6 0 6 2 shut\ndoor a"\\??/%\xe4 1 0 1 2\noneway 8 0 8 2\n'
                 'oneway 4 0 4 2\noneway 4 2 4 0\nstart 0.1 1e-9 45.5\n'
                 'solid 5 0.5 5.3 0.5 5.3 1 5 1\n',
                 "sightline 1\nwalls 0 0 1e20 0 1e20 3 0 3 0 0\n"]
        wanted = []
        for text, name in zip(texts, ("second", "Main_2")):
            self.bake(text)
            self.printed("export", "m.slv", "--prefix", name, "-o", name + ".h", "-q")
            wanted = [list(map(str, line)) for line in self.c_lines(self.export())] + wanted
            entry = "void second(void)" if name == "second" else "int main(void)"
            end = "" if name == "second" else "second(); return 0;"
            program = (self.C_PROGRAM.replace("FIRST", name).replace("ENTRY", entry)
                       .replace("END", end).replace("NAME_", name + "_"))
            for count in ("CELLS", "SEES", "PORTALS", "DOORS", "STARTS"):
                program = program.replace(f"{name}_{count}", f"{name.upper()}_{count}")
            self.box.path(name + ".c").write_text(program, encoding="utf-8")
        (example,) = re.findall(r"```c\n(.*?)```",
                                (BAKE / "EXPORT.md").read_text(encoding="utf-8"), re.DOTALL)
        self.box.path("example.c").write_text(example, encoding="utf-8")
        self.bake(BOX)
        self.printed("export", "m.slv", "--prefix", "office", "-o", "office.h", "-q")
        for compiler in compilers:
            warnings_too = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
            # A header that is compiled by itself uses none of its tables.
            for what in (["-fsyntax-only", "-x", "c", "Main_2.h"],
                         ["-o", "two", "second.c", "Main_2.c"]):
                subprocess.run([compiler, *warnings_too, *what], cwd=self.box.folder, check=True)
            subprocess.run([compiler, *warnings_too, "-o", "example", "example.c"],
                           cwd=self.box.folder, check=True)
            done = subprocess.run(["./example"], cwd=self.box.folder, check=True,
                                  stdout=subprocess.PIPE)
            self.assertEqual(done.stdout, b"cell 0 has 4 corners\ncell 1 has 4 corners\n")
            done = subprocess.run(["./two"], cwd=self.box.folder, check=True,
                                  stdout=subprocess.PIPE)
            lines = done.stdout.decode("utf-8").splitlines()
            self.assertEqual(len(lines), len(wanted))
            for line, values in zip(lines, wanted):
                self.assertEqual(len(line.split(" ")), len(values), line)
                for found, value in zip(line.split(" "), values):
                    if value in ("True", "False"):
                        value = str(int(value == "True"))
                    if found != value:
                        self.assertEqual(float(found), float(value), line)

    def test_examples_of_the_document(self):
        text = (BAKE / "EXPORT.md").read_text(encoding="utf-8")
        self.printed("bake", ROOT / "maps/effects/doors.map", "-o", "m.slv", "-q")
        self.export()
        self.box.path("m.slv.json").rename(self.box.path("office.json"))
        scripts = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        lines = re.findall(r"```sh run-by-test\n(jq .*?)\n```", text)
        self.assertEqual((len(scripts), len(lines)), (1, 2))
        done = subprocess.run([sys.executable, "-c", scripts[0]], cwd=self.box.folder, check=True,
                              stdout=subprocess.PIPE, universal_newlines=True)
        self.assertEqual(json.loads(done.stdout), [0, 1, 2, 3, 4])
        if not shutil.which("jq"):
            self.skipTest("jq is not here")
        done = [subprocess.run(line, shell=True, cwd=self.box.folder, check=True,
                               stdout=subprocess.PIPE, universal_newlines=True).stdout
                for line in lines]
        self.assertEqual(json.loads(done[0]), [0, 1, 2, 3, 4])
        self.assertEqual(done[1].splitlines()[0], "0 5")

    def test_document_names_all_members(self):
        schema = json.loads((BAKE / "export.schema.json").read_text(encoding="utf-8"))
        text = (BAKE / "EXPORT.md").read_text(encoding="utf-8")
        for name in schema["properties"]:
            self.assertIn(f"`{name}`", text)


    def test_files_of_older_versions(self):
        """A baked file and an export of 0.1.0 still say what they said."""
        for stored in sorted((ROOT / "tests/old_files").glob("*.json")):
            before = json.loads(stored.read_text(encoding="utf-8"))
            self.printed("bake", stored, "-o", "again.slv", "-q")
            for baked in stored.with_suffix(".slv"), "again.slv":
                with self.subTest(stored.name, read_from=str(baked)):
                    now = json.loads(self.printed("export", baked))
                    self.assertEqual({key: now.get(key) for key in before}, before)
        self.assertTrue(before)

if __name__ == "__main__":
    warnings.simplefilter("ignore", DeprecationWarning)
    sandbox.main()
