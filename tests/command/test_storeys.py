"""Buildings: the storeys of one are the same as their plans beside each other with linked points.

test_storeys.py PROGRAM
"""
import csv
import json
import math
import random

import sandbox

GROUND = [(0, 0, 12, 0), (12, 0, 12, 8), (12, 8, 0, 8), (0, 8, 0, 0), (6, 0, 6, 3), (6, 5, 6, 8)]
FIRST = [(0, 0, 12, 0), (12, 0, 12, 8), (12, 8, 0, 8), (0, 8, 0, 0), (0, 4, 5, 4), (7, 4, 12, 4), (9, 4, 9, 8)]
LINKS = [("stair", (1, 1), (1, 1)), ("lift", (10, 6), (10, 6))]
ASIDE = 40  # how far apart the plans stand in one map; a multiple of the step
STEP = 1


def plan(walls, aside=0):
    return "".join(f"wall {x0 + aside} {y0} {x1 + aside} {y1}\n" for x0, y0, x1, y1 in walls)


class Storeys(sandbox.ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("ground.map", plan(GROUND))
        self.write("first.map", plan(FIRST))
        self.box.path("house.storeys").write_text(
            "storeys 1\nstorey ground ground.map\nstorey first first.map\n" + "".join(
                f"link {name} ground {a[0]},{a[1]} first {b[0]},{b[1]}\n" for name, a, b in LINKS))

    def write(self, name, walls):
        self.box.path(name).write_text("sightline 1\nunit m\n" + walls)

    def table(self, *arguments):
        self.run_well("vga", *arguments, "--grid", STEP, "-o", "out.csv", "--quiet")
        with open(self.box.path("out.csv")) as file:
            return list(csv.DictReader(file))

    def test_a_building_is_its_plans_with_links(self):
        self.write("both.map", plan(GROUND) + plan(FIRST, ASIDE))
        self.box.path("links.csv").write_text("x1,y1,x2,y2\n" + "".join(
            f"{a[0]},{a[1]},{b[0] + ASIDE},{b[1]}\n" for _, a, b in LINKS))
        measures = "--measures", "visual,through,isovist"
        both = self.table("both.map", "--links", "links.csv", *measures, "--from", "2,6")
        house = self.table("house.storeys", *measures, "--from", "ground:2,6")
        self.assertEqual(len(both), len(house))
        by_place = {(float(row["x"]), float(row["y"])): row for row in both}
        for row in house:
            aside = ASIDE if row["storey"] == "first" else 0
            other = by_place.pop((float(row["x"]) + aside, float(row["y"])))
            for name in set(other) - {"x", "y"}:
                self.assertEqual(bool(row[name]), bool(other[name]), name)
                if row[name]:
                    self.assertTrue(math.isclose(float(row[name]), float(other[name]), rel_tol=1e-12, abs_tol=1e-9),
                                    f"{name}: {row} {other}")
        self.assertFalse(by_place)

    def test_storeys_without_links_are_parts(self):
        text = self.box.path("house.storeys").read_text().splitlines()
        self.box.path("house.storeys").write_text("\n".join(text[:3]))
        house = self.table("house.storeys")
        self.assertEqual({row["part"] for row in house}, {"1", "2", "3"})  # one storey has a closed room
        for name in ("ground", "first"):
            alone = self.table(name + ".map")
            rows = [row for row in house if row["storey"] == name]
            self.assertEqual(len(alone), len(rows))
            for row, other in zip(rows, alone):
                self.assertEqual({key: row[key] for key in other if key != "part"},
                                 {key: other[key] for key in other if key != "part"})

    def test_a_picture_shows_one_storey(self):
        for storey in "ground", "first":
            self.run_well("vga", "house.storeys", "--grid", STEP, "--picture", storey + ".svg", "--storey", storey,
                          "--quiet")
        self.assertNotEqual(self.box.path("ground.svg").read_bytes(), self.box.path("first.svg").read_bytes())

    def test_geojson_names_the_storey(self):
        self.run_well("vga", "house.storeys", "--grid", STEP, "-o", "a.geojson", "--quiet")
        features = json.loads(self.box.path("a.geojson").read_text())["features"]
        self.assertEqual({each["properties"]["storey"] for each in features}, {"ground", "first"})

    def test_ways_are_no_longer_than_any_over_links(self):
        """Beside a search by hand over single ways, on buildings by chance."""
        chance = random.Random(5)
        for _ in range(6):
            links = [(f"l{i}", chance.randrange(2), chance.uniform(0.5, 11.5), chance.uniform(0.5, 3.5),
                      chance.randrange(2), chance.uniform(0.5, 11.5), chance.uniform(4.5, 7.5),
                      chance.choice([0, 1.5, 7])) for i in range(4)]
            names = "ground", "first"
            self.box.path("any.storeys").write_text(
                "storeys 1\nstorey ground ground.map\nstorey first first.map\n" + "".join(
                    f"link {n} {names[s]} {x!r},{y!r} {names[t]} {u!r},{v!r} {length}\n"
                    for n, s, x, y, t, u, v, length in links))
            places = [(0, 1.0, 7.0), (1, 11.0, 7.0)]
            for _, s, x, y, t, u, v, _ in links:
                places += [(s, x, y), (t, u, v)]
            best = self.shortest(names, places, [link[-1] for link in links])
            found = self.box.run(["path", "any.storeys", "--from", "ground:1,7", "--to", "first:11,7"])
            if math.isinf(best):
                self.assertEqual(found.status, 3, found.text())
            else:
                self.assertEqual(found.status, 0, found.text())
                self.assertAlmostEqual(float(found.stdout.split()[1]), best, places=9)

    def shortest(self, names, places, lengths):
        """Floyd and Warshall."""
        count = len(places)
        far = [[math.inf] * count for _ in places]
        for i in range(count):
            far[i][i] = 0
        for i, length in enumerate(lengths):
            far[2 + 2 * i][3 + 2 * i] = far[3 + 2 * i][2 + 2 * i] = length
        for storey in range(2):
            those = [i for i in range(count) if places[i][0] == storey]
            pairs = [(i, k) for i in those for k in those if i < k]
            self.box.path("pairs.csv").write_text("from_x,from_y,to_x,to_y\n" + "".join(
                f"{places[i][1]!r},{places[i][2]!r},{places[k][1]!r},{places[k][2]!r}\n" for i, k in pairs))
            if not pairs:
                continue
            result = self.box.run(["path", names[storey] + ".map", "--pairs", "pairs.csv", "-o", "-"])
            rows = list(csv.DictReader(result.stdout.splitlines()))
            for (i, k), row in zip(pairs, rows):
                if row["length"]:
                    far[i][k] = far[k][i] = min(far[i][k], float(row["length"]))
        for m in range(count):
            for i in range(count):
                for k in range(count):
                    far[i][k] = min(far[i][k], far[i][m] + far[m][k])
        return far[0][1]


if __name__ == "__main__":
    sandbox.main()
