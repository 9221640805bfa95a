"""Walls that change, against plans that are made anew."""
import unittest
import warnings

import numpy as np

import sightline
import support

warnings.simplefilter("ignore", sightline.SightlineWarning)


class Worlds(unittest.TestCase):
    def setUp(self):
        self.plan = sightline.Plan.from_segments(support.TWO_ROOMS)

    def compare(self, world):
        fresh = world.plan().space(subdivide="mesh")
        points = support.random_points(self.plan, 40, 5)
        eyes = points[:10, None, :]
        self.assertTrue((world.can_see(eyes, points) == fresh.can_see(eyes, points)).all())
        for eye in points[:5]:
            here, there = world.region(eye, as_array=True), fresh.region(eye, as_array=True)
            self.assertAlmostEqual(area(here), area(there), places=9)

    def test_edits(self):
        world = self.plan.edit()
        self.compare(world)
        numbers = world.add([(1, 1, 3, 2), (5, 1, 7, 2.5)])
        door = world.add((4, 3, 4, 4), "door", name="gate")
        glass = world.add((2, 3, 3, 3), "oneway")
        world.commit()
        self.compare(world)
        self.assertFalse(world.can_see((3.5, 3.5), (4.5, 3.5)))
        world.set_open(door, True)
        world.move(numbers[0], (1, 1, 3, 3))
        world.commit()
        self.assertTrue(world.can_see((3.5, 3.5), (4.5, 3.5)))
        self.assertEqual(dict(world.plan().doors), {"gate": True})
        self.assertEqual(len(world.plan().oneways), 1)
        self.compare(world)
        world.remove([glass, *numbers])
        crate = world.add_solid([(1, 1), (2, 1), (2, 2), (1, 2)])
        world.commit()
        self.compare(world)
        world.remove(crate)
        world.discard()
        world.commit()
        self.assertFalse(world.can_see((0.5, 1.5), (2.5, 1.5)))

    def test_walls_that_stop_some_things(self):
        world = self.plan.edit()
        window = world.add((2, 0, 2, 4), stops=("steps", "sound"))
        world.commit()
        self.assertTrue(world.can_see((1, 2), (3, 2)))
        world.remove(window)
        world.add((2, 0, 2, 4), stops="sight")
        world.commit()
        self.assertFalse(world.can_see((1, 2), (3, 2)))
        with self.assertRaises(ValueError):
            world.add((2, 0, 2, 4), stops="smell")

    def test_mirrors_and_limited_walls(self):
        world = self.plan.edit()
        fences = [world.add((x, 0, x, 4), stops="limited") for x in (1, 2, 3)]
        world.commit()
        self.assertEqual(world.can_see((0.5, 2), [(1.5, 2), (2.5, 2)]).tolist(), [True, False])
        world.remove(fences)
        world.add((2, 0, 2, 4), "mirror", one_sided=True)
        world.commit()
        self.assertFalse(world.can_see((1, 2), (3, 2)))
        self.assertEqual(world.plan().mirrors.tolist(), [[2, 0, 2, 4]])
        self.compare(world)

    def test_visible_sets(self):
        points = support.random_points(self.plan, 30, 6)
        eyes = points[:10, None, :]
        now, later = self.plan.edit(rows="now"), self.plan.edit(rows="later", sight="closed")
        for segment in ((1, 1, 3, 2), (2, 0, 2, 3.5), (5, 1, 7, 2.5)):
            for world in (now, later):
                world.add(segment)
                world.commit()
            exact = now.may_see(eyes, points)
            self.assertTrue((now.can_see(eyes, points) <= exact).all())
            self.assertTrue((exact <= later.may_see(eyes, points)).all())
            self.assertEqual(now.settle(0), 0)
            before = later.settle(0)
            while before:
                left = later.settle(0)
                self.assertLess(left, before)
                before = left
            self.assertTrue((exact == later.may_see(eyes, points)).all())
        self.assertFalse(exact.all())
        with self.assertRaises(sightline.BadArgument):
            self.plan.edit().may_see((1, 1), (2, 2))
        for wrong in ({"rows": "soon"}, {"sight": "far"}):
            with self.assertRaises(ValueError):
                self.plan.edit(**wrong)
        with self.assertRaises(ValueError):
            now.settle(-1)

    def test_a_world_is_made_of_a_plan(self):
        for wrong in None, "plan.map", self.plan.space():
            with self.assertRaisesRegex(TypeError, "made of a Plan, not"):
                sightline.World(wrong)

    def test_what_is_refused_changes_nothing(self):
        world = self.plan.edit(bounds=(-1, -1, 9, 5))
        with self.assertRaises(sightline.BadArgument):
            world.add([(1, 1, 2, 2), (1, 1, 99, 1)])
        with self.assertRaises(sightline.BadArgument):
            world.add((1, 1, 2, 2), "window")
        for wall in (-1, 5, 2**40):
            with self.assertRaises(sightline.BadArgument):
                world.remove(wall)
        with self.assertRaises(sightline.BadArgument):
            world.set_open(0, True)
        with self.assertRaises(sightline.BadArgument):
            world.add_solid([(1, 1), (2, 1)])
        with self.assertRaises(TypeError):
            world.remove(1.5)
        with self.assertRaises(TypeError):
            world.move("x", (1, 1, 2, 2))
        with self.assertRaises(ValueError):
            world.move(0, [(1, 1, 2, 2), (1, 1, 2, 3)])
        with self.assertRaises(ValueError):
            self.plan.edit(bounds=(0, 0, 1))
        with self.assertRaises(sightline.BadInput):
            self.plan.edit(bounds=(0, 0, 1, 1))
        world.commit()
        self.assertEqual(len(world.plan().walls), len(support.TWO_ROOMS))
        self.compare(world)
        world.close()
        with self.assertRaises(sightline.Closed):
            world.commit()


def area(loop):
    x, y = loop[:, 0], loop[:, 1]
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2


if __name__ == "__main__":
    unittest.main()
