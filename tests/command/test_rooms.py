"""Rooms: their areas, names and what is seen of them, on a plan whose answers are known, as it is and turned.

test_rooms.py PROGRAM
"""
import csv
import json
import math

import sandbox

# Two rooms of 6 x 5 and 4 x 5 m, a doorway of 1 m between them.
WALLS = [(0, 0, 10, 0), (10, 0, 10, 5), (10, 5, 0, 5), (0, 5, 0, 0), (6, 0, 6, 2), (6, 3, 6, 5)]
TEXTS = [(1, 1, 'Office, "north"'), (7, 1, "Store")]
ROOMS = {'Office, "north"': (0, 0, 6, 5), "Store": (6, 0, 10, 5)}


def turned(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda x, y: (20 + c * x - s * y, s * x + c * y)


def drawing(place):
    """A DXF of release 12."""
    def at(code, point):
        return f"{code}\n{point[0]!r}\n{code + 10}\n{point[1]!r}\n"
    lines = "".join("0\nLINE\n8\nWALLS\n" + at(10, place(x0, y0)) + at(11, place(x1, y1)) for x0, y0, x1, y1 in WALLS)
    texts = "".join("0\nTEXT\n8\nNAMES\n" + at(10, place(x, y)) + f"40\n0.3\n1\n{text}\n" for x, y, text in TEXTS)
    return ("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n"
            "0\nSECTION\n2\nENTITIES\n" + lines + texts + "0\nENDSEC\n0\nEOF\n")


def corridor():
    """An SVG with doors: a hall of 1 m, as narrow as they are, beside two rooms of 5 x 5 m."""
    walls = ["0,0 10,0 10,1 7,1", "6,1 2,1", "1,1 0,1 0,0", "10,1 10,6 0,6 0,1", "5,1 5,6"]
    swings = ["M1,1 V2 A1,1 0 0 0 2,1", "M6,1 V2 A1,1 0 0 0 7,1"]
    parts = ['<g id="walls">' + "".join(f'<polyline points="{w}"/>' for w in walls) + "</g>",
             '<g id="doors">' + "".join(f'<path d="{d}"/>' for d in swings) + "</g>",
             '<g id="text" font-size="0.3"><text x="5" y="0.5">Hall</text>',
             '<text x="2" y="4">Den</text><text x="7" y="4">Bath</text></g>']
    return ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 6" stroke="black" fill="none">'
            + "".join(parts) + "</svg>")


class Rooms(sandbox.ProgramTest):
    def table(self, *arguments):
        self.run_well("rooms", "plan.dxf", *arguments, "-o", "rooms.csv", "--quiet")
        with open(self.box.path("rooms.csv"), newline="") as file:
            return {row["room"]: row for row in csv.DictReader(file)}

    def each(self):
        for degrees in 0, 17.3:
            place = turned(degrees)
            self.box.path("plan.dxf").write_text(drawing(place))
            with self.subTest(degrees=degrees):
                yield place

    def test_areas_and_names(self):
        for _ in self.each():
            rooms = self.table()
            self.assertEqual(set(rooms), set(ROOMS))
            for name, (x0, y0, x1, y1) in ROOMS.items():
                self.assertAlmostEqual(float(rooms[name]["area"]), (x1 - x0) * (y1 - y0), places=9)
                self.assertAlmostEqual(float(rooms[name]["share"]), (x1 - x0) * (y1 - y0) / 50, places=9)

    def test_what_is_seen_of_which_room(self):
        for place in self.each():
            x, y = place(3, 2.5)
            rooms = self.table("--from", f"{x!r},{y!r}")
            self.assertAlmostEqual(float(rooms['Office, "north"']["seen_share"]), 1, places=9)
            # From 3 m before the doorway it widens from 1 m to 7/3 m over 4 m.
            self.assertAlmostEqual(float(rooms["Store"]["seen_area"]), 4 * (1 + 7 / 3) / 2, places=9)
            self.assertAlmostEqual(float(rooms["Store"]["seen_share"]), 4 * (1 + 7 / 3) / 2 / 20, places=9)
            ends = [place(*end) for end in ((1, 1), (9, 1))]
            both = self.table(*(word for x, y in ends for word in ("--from", f"{x!r},{y!r}")))
            self.assertTrue(all(float(row["seen_share"]) > 0.999999 for row in both.values()))

    def test_means_are_those_of_the_points(self):
        for place in self.each():
            rooms = self.table("--grid", "0.3")
            self.run_well("vga", "plan.dxf", "--grid", "0.3", "--measures", "visual,isovist", "-o", "points.csv", "--quiet")
            with open(self.box.path("points.csv")) as file:
                points = list(csv.DictReader(file))
            x_axis, origin = place(1, 0), place(0, 0)
            c, s = x_axis[0] - origin[0], x_axis[1] - origin[1]
            total = compared = 0
            for name, (x0, y0, x1, y1) in ROOMS.items():
                inside = []
                for row in points:
                    dx, dy = float(row["x"]) - origin[0], float(row["y"]) - origin[1]
                    if x0 < c * dx + s * dy < x1 and y0 < c * dy - s * dx < y1:
                        inside.append(row)
                total += len(inside)
                found = int(rooms[name]["points"])
                if found != len(inside):  # a point on the border of both rooms
                    self.assertLess(abs(found - len(inside)), 10)
                    continue
                compared += 1
                for column, measure in (("connectivity",) * 2, ("isovist_area", "area"), ("occlusivity",) * 2):
                    mean = sum(float(row[measure]) for row in inside) / len(inside)
                    self.assertTrue(math.isclose(float(rooms[name][column]), mean, rel_tol=1e-9), column)
            self.assertGreater(total, 400)
            self.assertGreater(compared, 0)

    def test_cameras_by_room(self):
        """What 0, 1, 2, 3 or more cameras see of each room: two in the office look through the doorway."""
        # Into the store, for x from 6 to 10: two see 2.5 - (x - 3) / 6 < y < 2.5 + (x - 3) / 6, and
        # the third 0.8 + 0.2 x < y < 0.6 + 0.4 x, which is above both borders of the others.
        by_two, by_third, by_all = 4 * (1 + 7 / 3) / 2, 5.6, 1.2 * 4 - (10 ** 2 - 6 ** 2) / 60
        for place in self.each():
            self.box.path("cameras.csv").write_text("x,y\n" + "".join(
                f"{x!r},{y!r}\n" for x, y in (place(3, 2.5), place(3, 2.5), place(1, 1))))
            self.run_well("cover", "plan.dxf", "cameras.csv", "--rooms", "-o", "rooms.csv", "--quiet")
            with open(self.box.path("rooms.csv"), newline="") as file:
                rooms = {row["name"]: row for row in csv.DictReader(file)}
            self.assertEqual(set(rooms), set(ROOMS))
            for column in "inside_area", "seen_area", "seen_by_two_area", "seen_by_three_area":
                self.assertAlmostEqual(float(rooms['Office, "north"'][column]), 30, places=7)
            store = {key: float(rooms["Store"][key]) for key in rooms["Store"] if key != "name"}
            self.assertAlmostEqual(store["inside_area"], 20, places=7)
            self.assertAlmostEqual(store["seen_area"], by_two + by_third - by_all, places=7)
            self.assertAlmostEqual(store["seen_by_two_area"], by_two, places=7)
            self.assertAlmostEqual(store["seen_by_three_area"], by_all, places=7)
            self.assertEqual(store["viewpoints"], 3)
            answer = json.loads(self.printed("cover", "plan.dxf", "cameras.csv", "--rooms", "--json", "--quiet"))
            self.assertEqual([each["name"] for each in answer["rooms"]], list(rooms))
            for each in answer["rooms"]:
                self.assertEqual(each, {key: value if key == "name" else float(value)
                                        for key, value in rooms[each["name"]].items()})
            self.assertRegex(self.printed("cover", "plan.dxf", "cameras.csv", "--rooms"),
                             r"\n  Store +20 m² +57\.3 % +9\.3 % +14\.7 % +18\.7 % +3\n")

    def test_json_has_the_same(self):
        for _ in self.each():
            rooms = self.table()
            answer = json.loads(self.printed("rooms", "plan.dxf", "--json", "--quiet"))
            self.assertEqual([each["room"] for each in answer["rooms"]], list(rooms))
            for each in answer["rooms"]:
                self.assertEqual(each["area"], float(rooms[each["room"]]["area"]))

    def test_drawn_doors_bound_rooms(self):
        """A corridor that is narrower than the usual opening is a room with its name: doors are drawn."""
        self.box.path("plan.svg").write_text(corridor())
        result = self.run_well("rooms", "plan.svg")
        areas = {row["room"]: float(row["area"]) for row in csv.DictReader(result.stdout.splitlines())}
        self.assertEqual({name: round(area, 9) for name, area in areas.items()},
                         {"Hall": 10, "Den": 25, "Bath": 25})
        self.assertNotIn("in no room", result.stderr)

    def test_one_room_about_the_origin(self):
        self.box.path("plan.map").write_text("sightline 1\nwalls -1 -1 5 -1 5 4 -1 4 -1 -1\n")
        row, = csv.DictReader(self.printed("rooms", "plan.map", "-q").splitlines())
        self.assertEqual(float(row["area"]), 30)

    def test_what_is_in_no_room_is_noted(self):
        for _ in self.each():
            result = self.run_well("rooms", "plan.dxf", "--door-width", "4.5")
            self.assertEqual([row["room"] for row in csv.DictReader(result.stdout.splitlines())],
                             ['Office, "north"'], result.text())
            self.assertIn('40 % of the area inside lies in no room, and so does 1 text ("Store"): ',
                          result.stderr)

    def test_a_long_text_is_cut_between_letters(self):
        text = drawing(turned(0))
        self.assertIn("Store", text)
        self.box.path("plan.dxf").write_text(text.replace("Store", "n" + "\u00e9" * 40), encoding="utf-8")
        result = self.run_well("rooms", "plan.dxf", "--door-width", "4.5")
        self.assertIn('1 text ("n' + "\u00e9" * 31 + '")', result.stderr)
        self.box.path("plan.dxf").write_text(text.replace("Store", "\u00e9" * 40), encoding="utf-8")
        result = self.run_well("rooms", "plan.dxf", "--door-width", "4.5")
        self.assertIn('1 text ("' + "\u00e9" * 31 + '")', result.stderr)

    def test_what_is_wrong(self):
        self.box.path("plan.dxf").write_text(drawing(turned(0)))
        for arguments, message in ((["--from", "3"], "two finite numbers"), (["--from", "99,99"], "outside the map"),
                                   (["--measures", "visual"], "of no use without --grid"),
                                   (["--door-width", "9"], "has no room"), (["--door-width", "0"], "over 0")):
            result = self.box.run(["rooms", "plan.dxf", *arguments])
            self.assertEqual(result.status, 2, result.text())
            self.assertIn(message, result.stderr)


if __name__ == "__main__":
    sandbox.main()
