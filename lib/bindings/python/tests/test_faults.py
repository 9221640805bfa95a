"""Bad input gives a clear exception, or a right answer; it never ends the process."""
import copy
import gc
import os
import pathlib
import pickle
import random
import signal
import tempfile
import threading
import time
import unittest
import warnings

import numpy as np

import sightline
import support

warnings.simplefilter("ignore", sightline.SightlineWarning)

# What limits of reading are of.
LIMITS = ("squares", "pixels", "walls", "entities", "depth")


def level():
    return sightline.Plan.from_segments(support.TWO_ROOMS).bake()


class Arguments(unittest.TestCase):
    def test_wrong_shapes_are_refused(self):
        at = level()
        for wrong in (5, [1, 2, 3], [[1, 2, 3]], np.zeros((2, 3)), np.zeros((2, 2, 4))):
            for ask in (at.locate, at.region, at.isovists, at.look,
                        lambda points: at.can_see(points, (1, 1))):
                with self.assertRaises((ValueError, TypeError)):
                    ask(wrong)
        with self.assertRaisesRegex(ValueError, r"\(n, 2\)"):
            at.isovists([1, 2, 3])
        with self.assertRaisesRegex(ValueError, r"\(n, 4\)"):
            sightline.Plan.from_segments([[1, 2, 3]])
        with self.assertRaises(ValueError):
            at.can_see(np.zeros((3, 2)), np.zeros((4, 2)))

    def test_wrong_types_are_refused(self):
        at = level()
        for wrong in ("ab", [["a", "b"]], [[1, 2j]], [[None, 1]], {"x": 1}):
            with self.assertRaises((TypeError, ValueError)):
                at.isovists(wrong)
        with self.assertRaises(TypeError):
            at.cell_sees(0.5, 1)
        with self.assertRaises(TypeError):
            at.doors[3] = True

    def test_values_that_are_not_finite_are_refused(self):
        at = level()
        for bad in (np.nan, np.inf):
            for ask in (at.region, at.isovists, at.look):
                with self.assertRaisesRegex(ValueError, "finite"):
                    ask((bad, 1))
            for options in ({"heading": bad}, {"fov": bad}):
                with self.assertRaises(ValueError):
                    at.region((1, 1), **options)
            with self.assertRaises(ValueError):
                sightline.Plan.from_segments([(0, 0, bad, 1)])
            with self.assertRaises(ValueError):
                at.vga(bad)
            with self.assertRaises(ValueError):
                at.range = bad
        self.assertEqual(at.locate([(np.nan, 1), (np.inf, 1), (1, 1)])[:2].tolist(), [-1, -1])

    def test_far_points_are_answered(self):
        at = level()
        for far in (1e300, 1e-300, -1e150):
            self.assertFalse(at.can_see((1, 1), (far, 1)) and abs(far) > 1)
            at.locate((far, far))
            self.assertGreaterEqual(at.isovists([(far, far)], arrays=True)["area"][0], 0)
        with self.assertRaises(sightline.BadArgument):
            sightline.Plan.from_segments([(0, 0, 1e300, 0)])

    def test_nothing_is_asked_of_no_points(self):
        at = level()
        self.assertEqual(at.locate([]).shape, (0,))
        self.assertEqual(at.can_see([], []).shape, (0,))
        self.assertEqual(len(at.isovists([], arrays=True)["area"]), 0)
        self.assertEqual(at.look(np.empty((0, 2))).shape, (0, len(at)))

    def test_names_that_do_not_exist_are_named(self):
        at, plan = level(), sightline.Plan.from_segments(support.TWO_ROOMS)
        with self.assertRaisesRegex(sightline.BadArgument, "no door 'x'"):
            at.doors["x"] = True
        with self.assertRaises(KeyError):
            at.doors["x"]
        for call in (lambda: plan.bake(method="x"), lambda: plan.bake(subdivide="x"),
                     lambda: plan.bake(sight="x"), lambda: plan.bake(without=("x",)),
                     lambda: at.look((1, 1), method="x"), lambda: at.export("a", "x"),
                     lambda: at.vga(1, measures="x"), lambda: plan.save("plan.xyz")):
            with self.assertRaisesRegex(ValueError, "x"):
                call()

    def test_numbers_out_of_range_are_refused(self):
        at, plan = level(), sightline.Plan.from_segments(support.TWO_ROOMS)
        for call in (lambda: at.can_see(0, 99), lambda: at.can_see(-1, 0),
                     lambda: at.explain(0, 99), lambda: at.explain(0, (99, 99)),
                     lambda: at.vga(0), lambda: at.vga(-1), lambda: at.vga(1, radius=-1),
                     lambda: at.vga(1, measures=("visual", "metric"), estimate=9), lambda: at.vga(1, estimate=9, seen_from=True),
                     lambda: at.vga(1, measures="isovist", estimate=9), lambda: at.vga(1, estimate=9, radius=2),
                     lambda: at.vga(1, seeds=[(99, 99)]), lambda: at.vga(1, depth_from=[(99, 99)]),
                     lambda: plan.bake(threads=-1), lambda: plan.bake(mirror_depth=17),
                     lambda: plan.bake(start=(99, 99)), lambda: plan.bake(weld=np.nan),
                     lambda: at.region((1, 1), fov=-5), lambda: at.region((1, 1), tolerance=0),
                     lambda: setattr(at, "mirror_depth", 17), lambda: setattr(at, "range", -1)):
            with self.assertRaises(ValueError):
                call()
        with self.assertRaisesRegex(ValueError, "choose a larger step"):
            at.vga(1e-5)

    def test_what_is_not_supported_is_said(self):
        plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        with self.assertRaises(sightline.SightlineError):
            sightline.Plan().bake()
        plan.add_mirrors([(1, 4, 3, 4)])
        with self.assertRaisesRegex(sightline.Unsupported, "mirror images"):
            plan.vga(1)
        space = plan.space()
        for call in (space.sets, lambda: space.look((1, 1)), lambda: space.can_see(0, 0),
                     lambda: space.save("never.slv"), lambda: space.export("never.json")):
            with self.assertRaisesRegex(ValueError, "visible sets"):
                call()
        self.assertFalse(os.path.exists("never.slv"))

    def test_doubtful_insides_warn(self):
        plan = sightline.Plan.from_segments([(0, 0, 9, 0), (0, 9, 9, 9)], starts=[(4, 4)])
        with warnings.catch_warnings():
            warnings.simplefilter("error", sightline.SightlineWarning)
            with self.assertRaisesRegex(sightline.SightlineWarning, "leads out"):
                plan.bake()


NO_NUMBERS = ["1", None, True, 1j, [1, 2, 3], (1,), {}, object(), np.nan, np.inf, -np.inf, 10**400]
NO_COUNTS = NO_NUMBERS + [-1, 0.5, 1.0, 2**32, 2**64, 2**64 + 1, -2**63, np.float64(1), np.True_]
NO_FLAGS = ["shut", "", 0, 1, 1.0, None, [], [True], np.nan]
NO_TEXTS = [1, 0.5, True, b"x", ["x"], {}]
NO_POINTS = ["ab", None, 5, True, (1,), (1, 2, 3), [[1, 2, 3]], [(1, 2), (3,)], (1, None), (True, False),
             (1, 2j), (1, "2"), {"x": 1}, object(), (np.nan, 1), (np.inf, 1),
             np.ma.array([1.0, 2.0], mask=[True, False])]


def refused(call):
    """How a call refuses: ValueError or TypeError with a sentence; a fault if it answers."""
    try:
        answer = call()
    except (ValueError, TypeError) as fault:
        return str(fault)
    raise AssertionError(f"it answers {answer!r}")


class EveryArgument(unittest.TestCase):
    """Wrong values in place of each argument of each call."""

    def check(self, wrong, calls, but=()):
        for name, call in calls.items():
            for value in wrong:
                if any(value is each for each in but):
                    continue
                with self.subTest(call=name, value=repr(value)):
                    self.assertGreater(len(refused(lambda: call(value))), 10)

    def setUp(self):
        self.level = level()
        self.plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        self.plan.add_door("front", (4, 3, 4, 4))
        self.hall = self.plan.bake()

    def test_numbers(self):
        at, plan = self.level, self.plan
        for what in (at, plan):
            self.check(NO_NUMBERS + [-1], {"range": lambda v, what=what: setattr(what, "range", v)})
        self.check(NO_NUMBERS, {
            "look heading": lambda v: at.look((1, 1), v), "look fov": lambda v: at.look((1, 1), 0, v),
            "vga": lambda v: at.vga(v), "grid": lambda v: at.grid(v),
            "vga metric_radius": lambda v: at.vga(1, metric_radius=v),
            "vga angular_radius": lambda v: at.vga(1, angular_radius=v),
            "add_start": lambda v: plan.add_start((1, 1), v)})
        self.check(NO_NUMBERS, {
            "region tolerance": lambda v: at.region((1, 1), tolerance=v),
            "isovists range": lambda v: at.isovists([(1, 1)], range=v),
            "vga range": lambda v: at.vga(1, range=v), "weld": lambda v: plan.bake(weld=v),
            "slice": lambda v: sightline.Plan.from_file(support.MAPS / "office.map", slice=v)}, [None])
        self.check(NO_NUMBERS, {
            "tolerance": lambda v: sightline.Plan.from_file(support.MAPS / "office.map", tolerance=v),
            "threshold": lambda v: sightline.Plan.from_file(support.MAPS / "office.map", threshold=v)})
        arrays = ["1", None, True, 1j, [1, 2, 3], {}, object(), np.nan, np.inf]
        self.check(arrays, {
            "region heading": lambda v: at.region((1, 1), v), "region fov": lambda v: at.region((1, 1), 0, v),
            "isovists heading": lambda v: at.isovists([(1, 1), (2, 2)], v),
            "isovists fov": lambda v: at.isovists([(1, 1), (2, 2)], 0, v)})
        office = support.MAPS / "office.map"
        self.check(NO_NUMBERS + [-1], {
            "entrance": lambda v: setattr(plan, "entrance", v),
            "from_file entrance": lambda v: sightline.Plan.from_file(office, entrance=v)})
        for far in (1e200, 1e-200):
            with self.assertRaisesRegex(sightline.BadArgument, "from 1e-150 to 1e.150"):
                sightline.Plan.from_file(office, entrance=far)
            with self.assertRaisesRegex(sightline.BadArgument, "entrance.*from 1e-150 to 1e.150"):
                plan.entrance = far
        self.assertTrue((at.range, plan.range, plan.entrance) == (0, 0, 0) and len(plan.starts) == 0)

    def test_counts_and_cells(self):
        at, plan = self.level, self.plan
        self.check(NO_COUNTS, {
            "threads": lambda v: at.can_see((1, 1), (2, 2), threads=v),
            "look threads": lambda v: at.look((1, 1), threads=v),
            "isovists threads": lambda v: at.isovists([(1, 1)], threads=v),
            "vga threads": lambda v: at.vga(1, threads=v), "bake threads": lambda v: plan.bake(threads=v),
            "vga radius": lambda v: at.vga(1, radius=v),
            "vga estimate": lambda v: at.vga(1, estimate=v),
            "mirror_depth": lambda v: setattr(at, "mirror_depth", v),
            "bake mirror_depth": lambda v: plan.bake(mirror_depth=v),
            "bake door_limit": lambda v: plan.bake(door_limit=v),
            "misses": lambda v: at.explain(0, 1, misses=v),
            "explain": lambda v: at.explain(v, 1), "explain to": lambda v: at.explain(0, v)})
        self.check([*(each for each in NO_COUNTS if each != 2**32)], {
            f"max_{what}": lambda v, what=what: sightline.Plan.from_file(
                support.MAPS / "office.map", **{f"max_{what}": v}) for what in LIMITS})
        cells = [each for each in NO_COUNTS if not isinstance(each, (list, tuple))]
        self.check([*cells, 2, 99], {
            "can_see": lambda v: at.can_see(v, 1), "can_see to": lambda v: at.can_see(0, v),
            "cell_sees": lambda v: at.cell_sees(v, 1), "cell_sees to": lambda v: at.cell_sees([0, 1], v)})
        self.check([[0.0], [True], [-1], [2], [2**64 - 1], ["0"], [None], [[0], [1, 2]]], {
            "cells": lambda v: at.cell_sees(v, 1)})

    def test_flags(self):
        at, plan = self.level, self.plan
        self.check(NO_FLAGS, {
            "level door": lambda v: self.hall.doors.__setitem__("front", v),
            "plan door": lambda v: plan.doors.__setitem__("front", v),
            "add_door": lambda v: plan.add_door("back", (5, 1, 5, 2), is_open=v),
            "look": lambda v: at.look((1, 1), mirrored=v), "sets": lambda v: at.sets(v),
            "region": lambda v: at.region((1, 1), mirrors=v),
            "as_array": lambda v: at.region((1, 1), as_array=v),
            "isovists": lambda v: at.isovists([(1, 1)], polygons=v),
            "arrays": lambda v: at.isovists([(1, 1)], arrays=v),
            "vga": lambda v: at.vga(1, seen_from=v), "geometry": lambda v: at.vga(1, geometry=v),
            "bake": lambda v: plan.bake(inside_only=v),
            "solid": lambda v: plan.add_polygon([(0, 0), (1, 0), (1, 1)], solid=v),
            "is_open": lambda v: plan.add_polygon([(0, 0), (1, 0), (1, 1)], is_open=v),
            "doors": lambda v: sightline.Plan.from_file(support.MAPS / "office.map", doors=v)})
        self.assertEqual((dict(plan.doors), dict(self.hall.doors)), ({"front": True}, {"front": True}))

    def test_texts(self):
        at, plan = self.level, self.plan
        self.check(NO_TEXTS, {
            "door": lambda v: self.hall.doors.__setitem__(v, True),
            "add_door": lambda v: plan.add_door(v, (5, 1, 5, 2)), "method": lambda v: plan.bake(method=v),
            "sight": lambda v: plan.bake(sight=v), "subdivide": lambda v: plan.bake(subdivide=v),
            "without": lambda v: plan.bake(without=[v]), "look": lambda v: at.look((1, 1), method=v),
            "measures": lambda v: at.vga(1, measures=[v]), "export": lambda v: at.export("a.json", v),
            "save": lambda v: plan.save("a.map", v), "map": lambda v: sightline.Plan.from_text(v),
            "name": lambda v: sightline.Plan.from_text("sightline 1\n", v),
            "from_file": lambda v: sightline.Plan.from_file(support.MAPS / "office.map", map=v)})
        world = plan.edit()
        self.check([None], {
            "door": lambda v: self.hall.doors.__setitem__(v, True),
            "add_door": lambda v: plan.add_door(v, (5, 1, 5, 2)), "map": sightline.Plan.from_text,
            "name": lambda v: sightline.Plan.from_text("sightline 1\n", v),
            "edit": lambda v: world.add((5, 1, 5, 2), "door", name=v)})
        for path in (None, 1, 0.5, [], "a\0b"):
            for call in (sightline.Level.open, sightline.Plan.from_file, at.save, plan.save, at.export):
                self.assertTrue(refused(lambda: call(path)))

    def test_points(self):
        at, plan = self.level, self.plan
        self.check(NO_POINTS, {
            "isovists": at.isovists, "look": at.look, "region": at.region, "can_see": lambda v: at.can_see(v, (1, 1)),
            "can_see to": lambda v: at.can_see((1, 1), v), "add_start": plan.add_start,
            "seeds": lambda v: at.vga(1, seeds=v), "depth_from": lambda v: at.vga(1, depth_from=v),
            "start": lambda v: plan.bake(start=v), "explain": lambda v: at.explain(v, (1, 1)),
            "starts": lambda v: sightline.Plan.from_segments(support.TWO_ROOMS, starts=v)}, [None])
        self.check([None], {"region": at.region, "isovists": at.isovists, "look": at.look,
                            "add_start": plan.add_start})
        self.check(["ab", 5, True, (1, 2, 3), [[1, 2, 3]], [(1, 2), (3,)], (1, None), (True, False), object()],
                   {"locate": at.locate})  # NaN is in no cell
        self.check([(1, 2), (2, 1, 0)], {"region": lambda v: at.region([v, v])})
        segments = ["abcd", None, 5, True, (1, 2, 3), [[1, 2, 3]], [(0, 0, 1, "x")], (0, 0, 1, np.nan),
                    (0, 0, 1, None), np.zeros((2, 3, 2)), np.zeros((1, 4), bool), {}, object()]
        self.check(segments, {
            "from_segments": sightline.Plan.from_segments, "add_walls": plan.add_walls,
            "add_box": plan.add_box, "add_door": lambda v: plan.add_door("d", v),
            "add_mirrors": plan.add_mirrors, "add_oneways": plan.add_oneways, "add_seams": plan.add_seams})
        self.check([np.zeros((2, 4))], {"add_box": plan.add_box})
        self.check([*segments, [(0, 0), (1, 1)], np.zeros((3, 4)), [(0, 0), (1, 0), (1, np.inf)]],
                   {"add_polygon": plan.add_polygon})
        self.assertEqual(len(plan.walls), len(support.TWO_ROOMS))

    def test_tables(self):
        class Shape:
            geom_type, is_empty, coords = "LineString", False, [(0, 0), (1, 1)]

        class Table(dict):
            columns = ("kind", "name", "open")

        def table(**columns):
            found = Table({"kind": ["door"], "name": ["d"], "open": [True]}, **columns)
            found.geometry = [Shape()]
            return sightline.Plan.from_geodataframe(found)

        self.assertEqual(dict(table(open=[0]).doors), {"d": False})
        self.assertEqual(dict(table(open=[np.nan]).doors), {"d": True})
        self.check(["shut", "False", 2, 0.5, [], {}], {"open": lambda v: table(open=[v])})
        self.check([1, True, [], {}], {"kind": lambda v: table(kind=[v]), "name": lambda v: table(name=[v])})
        self.check([5, "ab", [1], [(1, 2)]], {"frame": sightline.Plan.from_geodataframe})


class Files(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = pathlib.Path(scratch.name)

    def test_broken_files_name_their_line(self):
        path = self.scratch / "bad.map"
        path.write_text("sightline 1\nwall 0 0 1\n")
        with self.assertRaisesRegex(sightline.BadInput, r"bad\.map:2"):
            sightline.Plan.from_file(path)
        with self.assertRaisesRegex(sightline.BadInput, "text.map:1"):
            sightline.Plan.from_text("nonsense\n")

    def test_limits_of_reading(self):
        lines = "".join(f" 0 LINE 8 0 10 0 20 {y} 11 9 21 {y}" for y in range(9))
        blocks = ("0 SECTION 2 BLOCKS 0 BLOCK 2 A 10 0 20 0 0 LINE 8 0 10 0 20 20 11 9 21 20 0 ENDBLK "
                  "0 BLOCK 2 B 10 0 20 0 0 INSERT 2 A 10 0 20 0 0 ENDBLK 0 ENDSEC")
        (self.scratch / "many.dxf").write_text("\n".join(
            f"{blocks} 0 SECTION 2 ENTITIES{lines} 0 INSERT 2 B 10 0 20 0 0 ENDSEC 0 EOF".split()) + "\n")
        (self.scratch / "dark.pbm").write_text("P1\n8 8\n" + "1 " * 64)
        (self.scratch / "tiles.tmx").write_text(
            "<map width='4' height='4' tilewidth='8' tileheight='8'><tileset firstgid='1' tilewidth='8' "
            "tileheight='8'/><layer name='solid' width='4' height='4'><data encoding='csv'>"
            f"{','.join('1001100110011111')}</data></layer></map>")
        for name, what, enough in (("many.dxf", "walls", 10), ("many.dxf", "entities", 14),
                                   ("many.dxf", "depth", 2), ("dark.pbm", "pixels", 64),
                                   ("tiles.tmx", "squares", 16)):
            with self.subTest(what):
                path = self.scratch / name
                sightline.Plan.from_file(path, **{f"max_{what}": enough})
                sightline.Plan.from_file(path, **{f"max_{what}": 0})  # the usual
                with self.assertRaisesRegex(sightline.BadInput, f"limit of {enough - 1}; --max-{what}"):
                    sightline.Plan.from_file(path, **{f"max_{what}": enough - 1})

    def test_missing_files_are_errors_of_the_system(self):
        for call in (lambda: sightline.Plan.from_file(self.scratch / "no.map"),
                     lambda: sightline.Level.open(self.scratch / "no.slv"),
                     lambda: level().save(self.scratch / "no/file.slv")):
            with self.assertRaises(OSError):
                call()
        with self.assertRaises(ValueError):
            sightline.Level.open("a\0b")

    def test_hostile_baked_files_are_refused(self):
        path = self.scratch / "a.slv"
        level().save(path)
        good, chance = path.read_bytes(), random.Random(1)
        for _ in range(200):
            bad = bytearray(good[:chance.randrange(len(good))] if chance.random() < 0.3 else good)
            for _ in range(chance.randint(1, 4)):
                if bad:
                    bad[chance.randrange(len(bad))] ^= 1 << chance.randrange(8)
            path.write_bytes(bytes(bad))
            if bytes(bad) != good:
                with self.assertRaises(sightline.SightlineError):
                    sightline.Level.open(path)

    def test_plans_read_back(self):
        plan = sightline.Plan.from_segments(support.TWO_ROOMS, starts=[(1, 1)])
        plan.add_door("front", (4, 3, 4, 4))
        plan.range = 30
        plan.save(self.scratch / "plan.map")
        again = sightline.Plan.from_file(self.scratch / "plan.map")
        self.assertTrue((again.walls == plan.walls).all())
        self.assertEqual((again.doors, again.range, len(again.starts)), ({"front": True}, 30, 1))


class Lives(unittest.TestCase):
    def test_plans_and_levels_have_one_owner(self):
        at = level()
        for owner in (at, sightline.Plan.from_segments(support.TWO_ROOMS)):
            for call in (copy.copy, copy.deepcopy, pickle.dumps, lambda each: pickle.dumps(each, 0)):
                with self.assertRaisesRegex(TypeError, "cannot be copied or pickled: save it"):
                    call(owner)
            with self.assertRaisesRegex(TypeError, "cannot be copied"):
                copy.deepcopy(owner.doors)
            copy.copy(owner.doors)
            owner.walls, owner.bounds
        with self.assertRaises(TypeError):
            sightline.Level(4711)

    def test_an_empty_level_answers(self):
        at = sightline.Level()
        for ask in (lambda: at.cells, lambda: at.pvs, lambda: at.locate((1, 1)), lambda: at.region((1, 1)),
                    lambda: at.can_see((1, 1), (2, 2)), lambda: at.can_see(0, 0), lambda: at.look((1, 1)),
                    lambda: at.vga(1), lambda: at.explain(0, 0), lambda: at.portals, lambda: at.bounds,
                    lambda: at.save("never.slv"), lambda: dict(at.doors), lambda: repr(at)):
            try:
                ask()
            except (ValueError, sightline.SightlineError):
                pass
        self.assertEqual(len(at), 0)

    def test_doors_of_a_plan_can_be_set(self):
        plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        plan.add_door("gap", (4, 3, 4, 4))
        self.assertTrue(plan.can_see((1, 3.5), (7, 3.5)))
        plan.doors["gap"] = False
        self.assertEqual((plan.doors, plan.doors["gap"]), ({"gap": False}, False))
        self.assertFalse(plan.can_see((1, 3.5), (7, 3.5)))
        self.assertFalse(plan.bake().doors["gap"])
        plan.doors.update(gap=True)
        self.assertTrue(plan.can_see((1, 3.5), (7, 3.5)))
        with self.assertRaisesRegex(sightline.BadArgument, "no door 'x'"):
            plan.doors["x"] = True
        with self.assertRaises(KeyError):
            plan.doors["x"]
        with self.assertRaises(TypeError):
            del plan.doors["gap"]

    def test_copies_cannot_be_written(self):
        plan = sightline.Plan.from_text("sightline 1\nwalls 0 0 9 0 9 9 0 9 0 0\nstart 1 1 0\nmirror 1 9 2 9\n"
                                        "oneway 5 1 5 2\nseam 3 0 3 9\nobject crate 6 6 7 7\n"
                                        "door front 0 3 0 4 open\n")
        for of in (plan, plan.bake()):
            for rows in (of.walls, of.mirrors, of.oneways, of.seams, of.starts, *of.objects.values(),
                         *of.door_segments.values()):
                with self.assertRaisesRegex(ValueError, "read-only"):
                    rows[...] = 5
            for table in (of.objects, of.door_segments):
                self.assertEqual(len(table), 1)
                with self.assertRaises(TypeError):
                    table["new"] = (1, 1, 2, 2)
            for name in ("walls", "mirrors", "oneways", "seams", "starts", "objects", "door_segments",
                         "doors", "bounds", "unit", "notes"):
                with self.assertRaises(AttributeError):
                    setattr(of, name, getattr(of, name))

    def test_closed_handles_are_refused(self):
        with level() as at:
            doors = at.doors
        self.assertTrue(at.closed)
        for call in (lambda: at.locate((1, 1)), lambda: at.cells, lambda: at.region((1, 1)),
                     lambda: len(doors), lambda: at.bounds, lambda: at.save("x.slv"),
                     lambda: at.vga(1), lambda: at.pvs, lambda: at.notes):
            with self.assertRaises(sightline.Closed):
                call()
        at.close()
        self.assertEqual(repr(at), "<Level: closed>")
        plan = sightline.Plan.from_segments(support.TWO_ROOMS)
        plan.close()
        with self.assertRaises(sightline.Closed):
            plan.bake()
        with self.assertRaises(sightline.Closed):
            plan.region((1, 1))

    def test_arrays_outlive_their_level(self):
        at = level()
        found, walls = at.cell_arrays(), at.walls
        before = found["corners"].copy()
        at.close()
        del at
        gc.collect()
        self.assertTrue((found["corners"] == before).all() and len(walls))

    @unittest.skipUnless(os.path.exists("/proc/self/statm") and "LD_PRELOAD" not in os.environ,
                         "the memory in use is not known here")
    def test_memory_is_given_back(self):
        plan = sightline.Plan.from_file(support.MAPS / "effects/doors.map")
        eyes = support.random_points(plan, 40, 11)

        def use():
            for _ in range(30):
                with plan.bake() as at:
                    at.isovists(eyes, polygons=True, arrays=True)
                    at.vga(2, measures=("visual", "metric"), arrays=True)
                    at.explain(0, len(at) - 1)
                    at.doors["west"] = not at.doors["west"]
                    at.look(eyes), at.sets(), at.cell_arrays(), at.region(eyes[0])
                    with self.assertRaises(ValueError):
                        at.doors["nowhere"] = True
                with self.assertRaises(ValueError):
                    sightline.Plan.from_text("nonsense")
            gc.collect()
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4096

        # What is lost is lost each time; what the allocator keeps for its threads comes now and then.
        uses = [use() for _ in range(5)]
        self.assertLess(min(after - before for before, after in zip(uses, uses[1:])), 1 << 18)

    def test_threads_share_one_level(self):
        plan = sightline.Plan.from_file(support.MAPS / "office.map")
        at = plan.bake()
        eyes = support.inside_points(at, 60, 8)
        wanted = at.isovists(eyes, arrays=True)["area"], at.look(eyes), at.can_see(eyes, eyes[::-1])
        faults = []

        def work(number):
            try:
                for _ in range(5):
                    if number == 0:
                        at.range = 0
                    area = at.isovists(eyes, arrays=True)["area"]
                    assert (area == wanted[0]).all()
                    assert (at.look(eyes, threads=number) == wanted[1]).all()
                    assert (at.can_see(eyes, eyes[::-1]) == wanted[2]).all()
                    assert at.explain(0, 9).start == 0
            except BaseException as fault:  # what any thread says must be heard
                faults.append(fault)

        crew = [threading.Thread(target=work, args=(number,)) for number in range(4)]
        for each in crew:
            each.start()
        for each in crew:
            each.join()
        self.assertEqual(faults, [])

    def test_a_level_is_closed_while_others_ask(self):
        at = level()
        eyes = support.random_points(at, 3000, 9)
        ends = []

        def work():
            try:
                while True:
                    at.isovists(eyes, arrays=True)
            except sightline.Closed:
                ends.append(True)

        crew = [threading.Thread(target=work) for _ in range(3)]
        for each in crew:
            each.start()
        time.sleep(0.1)
        at.close()
        for each in crew:
            each.join()
        self.assertEqual(ends, [True] * 3)

    def test_other_threads_run_while_one_asks(self):
        at = sightline.Plan.from_file(support.MAPS / "office.map").bake()
        eyes = np.tile(support.inside_points(at, 500, 10), (20, 1))
        asking = threading.Thread(target=lambda: at.isovists(eyes, threads=1, arrays=True))
        asking.start()
        turns = 0
        while asking.is_alive():
            turns += 1
            time.sleep(0.001)
        self.assertGreater(turns, 3)

    def test_control_c_stops_long_work(self):
        at = sightline.Plan.from_file(support.MAPS / "office.map").space()
        timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        begun = time.monotonic()
        try:
            with self.assertRaises(KeyboardInterrupt):
                at.vga(0.2, measures=("visual", "metric", "angular"))
        finally:
            timer.cancel()
        self.assertLess(time.monotonic() - begun, 30)
        self.assertTrue(at.can_see((1, 1), (1.5, 1.5)))

    def test_another_thread_stops_long_work(self):
        plan = sightline.Plan.from_file(support.MAPS / "office.map")
        plan.cancel() # nothing is asked: nothing happens
        self.assertTrue(plan.can_see((1, 1), (1.5, 1.5)))
        ends = []

        def work():
            try:
                plan.vga(0.2, measures=("visual", "metric", "angular"))
            except sightline.Cancelled:
                ends.append("cancelled")

        for _ in range(2): # the second time as the first
            asking = threading.Thread(target=work)
            asking.start()
            while asking.is_alive():
                plan.cancel()
                time.sleep(0.01)
        self.assertEqual(ends, ["cancelled"] * 2)
        self.assertEqual(len(plan.vga(4, arrays=True)["x"]), len(plan.grid(4)))


if __name__ == "__main__":
    unittest.main()
