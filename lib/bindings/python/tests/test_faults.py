"""Bad input gives a clear exception, or a right answer; it never ends the process."""
import gc
import os
import pathlib
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
                     lambda: at.vga(1, seeds=[(99, 99)]), lambda: at.vga(1, depth_from=[(99, 99)]),
                     lambda: plan.bake(threads=-1), lambda: plan.bake(mirror_depth=17),
                     lambda: plan.bake(start=(99, 99)), lambda: plan.bake(weld=np.nan),
                     lambda: at.region((1, 1), fov=-5), lambda: at.region((1, 1), tolerance=0),
                     lambda: setattr(at, "mirror_depth", 17), lambda: setattr(at, "range", -1)):
            with self.assertRaises(ValueError):
                call()
        with self.assertRaisesRegex(ValueError, "memory"):
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

        use()
        before = use()
        self.assertLess(use() - before, 1 << 20)

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


if __name__ == "__main__":
    unittest.main()
