"""Files that bake writes are as lib/bake/SLV.md says: a reader written from that document alone
(slv_reader.py) finds in them what info and export print.

test_slv_format.py PROGRAM
"""
import json
import pathlib

import sandbox
import slv_reader

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAPS = sorted([*(ROOT / "maps").glob("*.map"), *(ROOT / "maps").glob("*/*.map"),
               *(ROOT / "maps").glob("*.txt")])
VIEW_CELLS = ["--cells", "6", "--elementary", "30", "--samples", "2000", "--evaluate", "0"]
COUNTS = {"cells": "CELL", "vertices": "VERT", "portals": "PORT", "walls": "WALL", "nodes": "NODE",
          "stab_tree_nodes": "TREN"}


class SlvFormat(sandbox.ProgramTest):
    def read(self, name):
        return slv_reader.Slv(self.box.path(name).read_bytes())

    def check(self, name):
        """The file against info and export; gives the reader."""
        slv, info = self.read(name), json.loads(self.printed("info", name, "--json"))
        for key, tag in COUNTS.items():
            self.assertEqual(len(slv.items(tag)), info[key], key)
        self.assertEqual(slv.info["pairs"], info["pairs"])
        place, = slv.items("MAPI")
        if place["scale"]:
            told = info["transform"]
            self.assertEqual([place["origin_x"], place["origin_y"], place["scale"], place["y_down"]],
                             [told["x"], told["y"], told["scale"], int(told["y_down"])])
        else:
            self.assertNotIn("transform", info)
        self.assertEqual(slv.info["method"].rstrip(b"\0").decode(), info["method"])
        self.assertEqual("PART" in slv.table, not info["finished"])
        vertices = slv.items("VERT")
        polygons = [slv.polygon(i, vertices) for i in range(len(slv.cells))]
        rows = slv.visible()
        self.assertEqual(sum(map(len, rows)), slv.info["pairs"])
        self.check_directed(slv)
        self.check_places(slv, polygons, vertices)
        self.check_export(name, slv, polygons, rows)
        self.check_things(slv)
        self.check_parts(slv, rows)
        return slv

    def check_export(self, name, slv, polygons, rows):
        self.printed("export", name, "--format", "json", "-o", name + ".json", "-q")
        export = json.loads(self.box.path(name + ".json").read_text(encoding="utf-8"))
        self.assertEqual([slv.info[key] for key in ("min_x", "min_y", "max_x", "max_y")],
                         export["bounds"])
        self.assertEqual([list(wall.values()) for wall in slv.items("WALL")], export["walls"])
        self.assertEqual([[*portal.values()] for portal in slv.items("PORT")],
                         [portal["cells"] + portal["segment"] for portal in export["portals"]])
        self.assertEqual([[list(p) for p in polygon] for polygon in polygons],
                         [cell["polygon"] for cell in export["cells"]])
        self.assertEqual(rows, export["pvs"])

    def check_parts(self, slv, rows):
        self.assertEqual("PVSP" in slv.table, "PVSO" in slv.table)
        if "PVSP" in slv.table:
            told, size = slv.told_parts()
            self.assertEqual(told, [{cell // size for cell in row} for row in rows])

    def check_things(self, slv):
        """The sections of the map hold what the map text does."""
        said = {word: [line.split("#")[0].split()[1:] for line in slv.map_text.splitlines()
                       if line.startswith(word + " ")]
                for word in ("door", "start", "object", "path", "mirror", "range")}
        info, = slv.items("MAPI")
        self.assertEqual(info["range"], float(said["range"][0][0]) if said["range"] else 0)
        numbers = lambda words: [float(word) for word in words]
        kinds = {0: [], 2: ["breakable"], 4: ["site"]}
        self.assertEqual([[slv.name_of(d), "open" if d["state"] & 1 else "shut", *kinds[d["state"] & ~1]]
                          for d in slv.items("DOOR")],
                         [[d[0], *d[5:]] for d in said["door"]])
        self.assertEqual([[*s.values()] for s in slv.items("STRT")],
                         [numbers(s) for s in said["start"]])
        self.assertEqual([[slv.name_of(o), *[*o.values()][2:]] for o in slv.items("OBJE")],
                         [[o[0], *numbers(o[1:])] for o in said["object"]])
        points = [[*p.values()] for p in slv.items("PAPO")]
        self.assertEqual([[slv.name_of(p), *sum(points[p["first"]:p["first"] + p["count"]], [])]
                          for p in slv.items("PATH")],
                         [[p[0], *numbers(p[1:])] for p in said["path"]])
        self.assertEqual([[*m.values()] for m in slv.items("MIRR")],
                         [numbers(m[:4]) + [int("one" in m)] for m in said["mirror"]])

    def check_directed(self, slv):
        """Each portal has two directed portals, of which one is turned round."""
        portals, directed = slv.items("PORT"), slv.items("EXIT")
        self.assertEqual(len(directed), 2 * len(portals))
        at = 0
        for number, cell in enumerate(slv.cells):
            self.assertEqual(cell["first_directed"], at)
            at += cell["directed_count"]
            for item in directed[cell["first_directed"]:at]:
                portal = portals[item["portal"]]
                turned = portal["cell_1"] == number
                self.assertEqual(portal["cell_0" if turned else "cell_1"], item["cell"])
                ends = [portal[key] for key in ("left_x", "left_y", "right_x", "right_y")]
                self.assertEqual(ends[2:] + ends[:2] if turned else ends,
                                 [item[key] for key in ("left_x", "left_y", "right_x", "right_y")])
        self.assertEqual(at, len(directed))

    def check_places(self, slv, polygons, vertices):
        """The middle of a cell is in that cell."""
        for number in range(0, len(polygons), max(1, len(polygons) // 20)):
            polygon = polygons[number]
            x, y = (sum(p[i] for p in polygon) / len(polygon) for i in (0, 1))
            self.assertEqual(slv.locate(x, y, vertices), number)

    def test_maps(self):
        for path in MAPS:
            with self.subTest(map=path.name):
                self.printed("bake", path, "-o", "map.slv", "-q")
                slv = self.check("map.slv")
                self.assertEqual(slv.header["version"], 1 if slv.items("NODE") else 2)

    def test_doors(self):
        """The doors of each alternative stand in the map text, and seams name them."""
        self.printed("bake", ROOT / "maps/effects/doors.map", "-o", "doors.slv", "-q")
        slv = self.check("doors.slv")
        doors = sum(line.startswith("door ") for line in slv.map_text.splitlines())
        rows = slv.door_rows("DORO", "DORB")
        used = {door for row in rows for sets in row.values() for doors_ in sets for door in doors_}
        self.assertEqual(used, set(range(doors)))
        self.assertEqual({seam["number"] for seam in slv.items("SEAM") if seam["kind"] == 1}, used)
        for cell, row in enumerate(rows):
            for other, sets in row.items():
                self.assertEqual(rows[other][cell], sets)
        for on in slv.items("SEPO"):
            seam, portal = slv.items("SEAM")[on["seam"]], slv.items("PORT")[on["portal"]]
            dx, dy = seam["b_x"] - seam["a_x"], seam["b_y"] - seam["a_y"]
            # To the left of the way from cell_0 to cell_1 is the portal's left end.
            along = dx * (portal["left_x"] - portal["right_x"]) + \
                dy * (portal["left_y"] - portal["right_y"])
            self.assertEqual(on["forward"], 1 if along < 0 else 0)

    def test_mirrors_and_trees(self):
        self.printed("bake", ROOT / "maps/effects/mirrors.map", "-o", "mirrors.slv", "--stab-trees",
                      "-q")
        slv = self.check("mirrors.slv")
        self.assertTrue(any(slv.rows("MIRO", "MIRB")))
        nodes, directed = slv.items("TREN"), slv.items("EXIT")
        for source, (start, end) in enumerate(slv.spans("TREO", len(nodes))):
            tree = nodes[start:end]
            self.assertEqual(list(tree[0].values()), [0, source, slv_reader.NONE])
            for i, node in enumerate(tree[1:], 1):
                self.assertLess(node["parent"], i)
                if node["directed"] >= 0x80000000:
                    self.assertEqual(node["cell"], tree[node["parent"]]["cell"])
                else:
                    self.assertEqual(node["cell"], directed[node["directed"]]["cell"])

    def test_view_cells(self):
        for more in [], ["--by-views"]:
            self.printed("viewcells", ROOT / "maps/office.map", *VIEW_CELLS, "--slv", "views.slv",
                          "-q", *more)
            slv = self.check("views.slv")
            self.assertEqual("PVSO" in slv.table, not more)
            views, visible = slv.view_rows(), slv.visible()
            self.assertEqual(len(views), 6)
            for cell, item in enumerate(slv.items("VCEL")):
                if item["view_cell"] != slv_reader.NONE:
                    self.assertLessEqual(set(visible[cell]), set(views[item["view_cell"]]))

    def test_partial_and_shards(self):
        source = ROOT / "maps/gallery.map"
        self.printed("bake", source, "-o", "partial.slv", "--time-limit", "1e-9", "-q")
        part, = self.check("partial.slv").items("PART")
        self.assertEqual((part["shard"], part["shard_count"]), (0, 0))
        done = 0
        for number in 1, 2:
            self.printed("bake", source, "-o", f"{number}.slv", "--shard", f"{number}/2", "-q")
            slv = self.read(f"{number}.slv")
            self.assertTrue(slv.is_shard() and slv.visible() is None)
            part, = slv.items("PART")
            self.assertEqual((part["shard"], part["shard_count"]), (number, 2))
            units = sum(bin(item["units"]).count("1") for item in slv.items("DONE"))
            self.assertGreater(units, 0)
            done += units
            self.assertTrue(any(slv.rows("FNDO", "FNDB")))
        self.assertEqual(done, part["unit_count"])

    def test_transform(self):
        """A place of the file is one of the map's own file again: the walls of a picture's plan."""
        self.printed("bake", ROOT / "maps/keep.tmx", "-o", "keep.slv", "-q")
        info, = self.check("keep.slv").items("MAPI")
        self.assertEqual([info[key] for key in ("origin_x", "scale", "y_down")], [0, 1, 1])
        self.box.path("plan.txt").write_text("####\n#@.#\n#..#\n#..#\n####\n", encoding="utf-8")
        self.printed("bake", "plan.txt", "-o", "plan.slv", "-q")
        slv = self.check("plan.slv")
        (info,), (start,) = slv.items("MAPI"), slv.items("STRT")
        self.assertEqual((info["scale"] * (start["x"] - info["origin_x"]),
                          info["scale"] * (info["origin_y"] - start["y"])), (1.5, 1.5))

    def test_old_files(self):
        """The tree is passed over in version 1 with BEYO: with oblique walls."""
        loose = set()
        for path in sorted((ROOT / "tests/old_files").glob("*.slv")):
            slv = slv_reader.Slv(path.read_bytes())
            if slv.header["version"] == 1 and "BEYO" in slv.table:
                loose.add(path.stem)
            self.assertEqual(sum(map(len, slv.visible())), slv.info["pairs"])
            self.box.path(path.name).write_bytes(path.read_bytes())
            info = json.loads(self.printed("info", path.name, "--json"))
            self.assertEqual(len(slv.cells), info["cells"])
        self.assertEqual(loose, {"askew", "star"})

    def test_damage(self):
        self.printed("bake", ROOT / "maps/flat.map", "-o", "map.slv", "-q")
        data = self.box.path("map.slv").read_bytes()
        for spoiled in data[:-1], data[:40] + bytes([data[40] ^ 1]) + data[41:], b"PNG" + data[3:]:
            with self.assertRaises(slv_reader.Fault):
                slv_reader.Slv(spoiled)


if __name__ == "__main__":
    sandbox.main()
