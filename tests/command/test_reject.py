"""reject makes the REJECT of all maps of a WAD that bake and export make of each, in one copy in
which all else stays; an interrupted one leaves an older file.

test_reject.py PROGRAM
"""
import json
import signal

import sandbox
from wad import blocked_passage, lumps_of_wad, make_wad, pillars, rooms

OTHER = [("BEFORE", b"kept"), ("PLAYPAL", bytes(range(200)))]

# One map whose REJECT has the right size, one that has none, one whose REJECT has a wrong size, and
# one whose walls are oblique.
MAPS = [rooms("MAP01", 6, reject=bytes((11 * 11 + 7) // 8)), rooms("MAP02", 9),
        rooms("MAP03", 4, reject=b"old"), rooms("MAP04", 12, skew=9)]


class Reject(sandbox.ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("in.wad", make_wad(OTHER[:1], MAPS[0], MAPS[1], OTHER[1:], *MAPS[2:]))

    def write(self, name, content):
        self.box.path(name).write_bytes(content)

    def read(self, name):
        return self.box.path(name).read_bytes()

    def refuse(self, message, *arguments, status=2):
        result = self.box.run(["reject", *arguments])
        self.assertEqual((result.status, result.stdout), (status, ""))
        self.assertIn(message, result.stderr)

    def test_as_one_by_one(self):
        """The lumps of bake and export, map after map; whatever the number of threads."""
        result = self.run_well("reject", "in.wad", "-o", "all.wad", "--threads", "3")
        self.assertEqual(result.new_files, ["all.wad"])
        self.assertIn("a new REJECT for 4 maps", result.stdout)
        self.run_well("reject", "in.wad", "-o", "one.wad", "--threads", "1", "-q")
        self.assertEqual(self.read("all.wad"), self.read("one.wad"))
        before = "in.wad"
        for name in "MAP01", "MAP02", "MAP03", "MAP04":
            self.run_well("bake", "in.wad", "--map", name, "-o", "map.slv", "--sectors", "--sight",
                          "open", "-q")
            self.run_well("export", "map.slv", "--format", "reject", "--wad", before, "--map", name,
                          "-o", name + ".wad", "-q")
            before = name + ".wad"
        made = lumps_of_wad(self.read("all.wad"))
        self.assertEqual(made, lumps_of_wad(self.read(before)))
        old = [lump for lump in lumps_of_wad(self.read("in.wad")) if lump[0] != "REJECT"]
        self.assertEqual([lump for lump in made if lump[0] != "REJECT"], old)
        rejects = [lump for name, lump in made if name == "REJECT"]
        self.assertEqual([len(lump) for lump in rejects],
                         [(n * n + 7) // 8 for n in (11, 17, 7, 23)])
        for lump in rejects:
            self.assertTrue(any(lump))

    def test_some_maps(self):
        told = json.loads(self.run_well("reject", "in.wad", "-o", "some.wad", "--map", "map04",
                                        "--map", "MAP01", "--json").stdout)
        self.assertEqual([each["name"] for each in told["maps"]], ["MAP04", "MAP01"])
        self.assertEqual([each["sectors"] for each in told["maps"]], [23, 11])
        self.assertEqual([each["pairs"] for each in told["maps"]], [23 * 11, 11 * 5])
        made, old = lumps_of_wad(self.read("some.wad")), lumps_of_wad(self.read("in.wad"))
        self.assertEqual(len(made), len(old) + 1)
        hidden = [sum(bin(byte).count("1") for byte in lump)
                  for name, lump in made if name == "REJECT"]
        self.assertEqual(hidden, [2 * told["maps"][1]["hidden"], hidden[1],
                                  2 * told["maps"][0]["hidden"]])
        self.assertEqual([lump for name, lump in made if name == "REJECT"][1], b"old")

    def test_in_place(self):
        """Of one map whose REJECT has its size already, these bytes alone differ."""
        self.run_well("reject", "in.wad", "-o", "place.wad", "--map", "MAP01")
        old, new = self.read("in.wad"), self.read("place.wad")
        self.assertEqual(len(old), len(new))
        differs = [i for i in range(len(old)) if old[i] != new[i]]
        self.assertTrue(differs)
        self.assertLess(differs[-1] - differs[0], (11 * 11 + 7) // 8)

    def test_closed_hides_no_more(self):
        def hidden(*options):
            told = self.run_well("reject", "in.wad", "-o", "x.wad", "--json", *options).stdout
            return [each["hidden"] for each in json.loads(told)["maps"]]
        for closed, opened in zip(hidden("--sight", "closed"), hidden("--sight", "open")):
            self.assertLessEqual(closed, opened)

    def test_unusual(self):
        """A polyobject hides nothing. Of several maps, notes say what is unusual, by the map."""
        passage = "special = %d; arg0 = 7;"
        self.write("poly.wad", make_wad(MAPS[0], blocked_passage("MAP02", passage % 0),
                                        blocked_passage("MAP03", passage % 1),
                                        blocked_passage("MAP04", passage % 156)))
        result = self.run_well("reject", "poly.wad", "-o", "x.wad", "--json")
        told = json.loads(result.stdout)["maps"]
        self.assertEqual([each["hidden"] > 0 for each in told], [True, True, False, True])
        self.assertEqual(result.stderr.splitlines(), [
            "note: poly.wad: map MAP02: 3 regions behind one-sided walls hold a start, a door or the "
            "front of a wall: taken as open",
            "note: poly.wad: map MAP03: left out: 4 lines of polyobjects, which the game moves",
            "note: poly.wad: map MAP04: 1 line of portals: portals are not followed; a REJECT may "
            "hide what they show",
            "note: poly.wad: map MAP04: 3 regions behind one-sided walls hold a start, a door or the "
            "front of a wall: taken as open"])
        one = self.run_well("reject", "poly.wad", "-o", "x.wad", "--map", "MAP03")
        self.assertEqual(one.stderr.splitlines(), result.stderr.splitlines()[1:2])

    def test_export_without_sectors(self):
        self.run_well("bake", "in.wad", "--map", "MAP01", "-o", "map.slv", "-q")
        result = self.run_well("export", "map.slv", "--format", "reject", "--wad", "in.wad", "--map",
                               "MAP01", "-o", "x.wad")
        self.assertIn("bake with --sectors --sight open", result.stderr)

    def test_refused(self):
        self.refuse("-o OUT.wad is needed", "in.wad")
        self.refuse("is the input itself", "in.wad", "-o", "in.wad")
        self.refuse("there is no map 'MAP09' for --map", "in.wad", "-o", "out.wad", "--map", "MAP09")
        self.refuse("map MAP01 is asked for twice", "in.wad", "-o", "out.wad", "--map", "MAP01",
                    "--map", "map01")
        self.refuse("both write to stdout", "in.wad", "-o", "-", "--json")
        self.refuse("none.wad", "none.wad", "-o", "out.wad")
        self.write("text.wad", b"no wad")
        self.refuse("text.wad: no WAD", "text.wad", "-o", "out.wad")
        self.write("empty.wad", make_wad(OTHER))
        self.refuse("empty.wad: holds no map", "empty.wad", "-o", "out.wad")
        self.refuse("allow more memory", "in.wad", "-o", "out.wad", "--memory", "1", status=1)

    def test_broken_map(self):
        """One map without sense fails the whole, by its name."""
        broken = [(name, b"\xff" * 14 if name == "LINEDEFS" else lump) for name, lump in MAPS[1]]
        self.write("broken.wad", make_wad(MAPS[0], broken))
        self.write("out.wad", b"an older file")
        self.refuse("map MAP02: ", "broken.wad", "-o", "out.wad")
        self.run_well("reject", "broken.wad", "-o", "out.wad", "--map", "MAP01")

    def test_interrupted(self):
        self.write("hall.wad", make_wad(MAPS[0], pillars("MAP02", 60)))
        self.write("out.wad", b"an older file")
        before = self.box.files()
        process = self.box.start(["reject", "hall.wad", "-o", "out.wad"])
        sandbox.wait_for_work(process.pid)
        process.send_signal(signal.SIGINT)
        result = self.box.finish(process, before, timeout=60)
        self.assertEqual((result.status, result.stdout), (1, ""))
        self.assertEqual(result.stderr, "sightline: interrupted\n")
        self.assertEqual(self.box.files(), before)


if __name__ == "__main__":
    sandbox.main()
