import unittest

import worlds  # noqa: F401

import mattes
import numpy as np


def disc(x, radius=30.0, soft=1.0):
    v, u = np.mgrid[0:120, 0:160]
    return np.clip((radius - np.hypot(u - x, v - 60)) / soft + 0.5, 0, 1).astype(np.float32)


def still(frame):
    return np.zeros((120, 160, 2), np.float32), disc(70) > 0.5


class Mattes(unittest.TestCase):
    def measured(self, matte):
        return mattes.measure([1, 2, 3, 4], [1], lambda f: disc(70), matte, still)

    def test_the_truth_is_without_error(self):
        found = self.measured(lambda f: disc(70))
        self.assertEqual((found["iou"], found["boundary_f"], found["leak"], found["hole"]), (1, 1, 0, 0))
        self.assertEqual((found["edge_levels"], found["edge_change_levels"]), (0, 0))
        self.assertGreater(found["hard_edge_levels"], 20)

    def test_a_hard_matte_has_the_hard_matte_s_edge(self):
        found = self.measured(lambda f: (disc(70) >= 0.5).astype(np.float32))
        self.assertAlmostEqual(found["edge_levels"], found["hard_edge_levels"], places=4)
        self.assertEqual(found["iou"], 1)

    def test_nothing_and_everything_fail(self):
        nothing = self.measured(lambda f: np.zeros((120, 160), np.float32))
        self.assertEqual((nothing["iou"], nothing["boundary_f"], nothing["leak"]), (0, 0, 0))
        self.assertGreater(nothing["hole"], 0.7)
        everything = self.measured(lambda f: np.ones((120, 160), np.float32))
        self.assertLess(everything["iou"], 0.2)
        self.assertGreater(everything["leak"], 4)

    def test_a_shift_shows_in_the_overlap_and_the_worst_frame(self):
        found = self.measured(lambda f: disc(70 + 4 * (f == 3)))
        self.assertEqual(found["worst_frame"], 3)
        self.assertLess(found["iou_worst"], 0.9)
        self.assertGreater(found["iou"], found["iou_worst"])

    def test_boil_shows_in_the_change(self):
        steady, boiling = self.measured(lambda f: disc(70.4)), self.measured(lambda f: disc(70 + 0.4 * (-1) ** f))
        self.assertAlmostEqual(steady["edge_levels"], boiling["edge_levels"], delta=5)
        self.assertLess(steady["edge_change_levels"], 1)
        self.assertGreater(boiling["edge_change_levels"], 20)

    def test_the_painted_frame_does_not_count(self):
        found = self.measured(lambda f: disc(70) if f == 1 else np.zeros((120, 160), np.float32))
        self.assertEqual(found["iou"], 0)

    def test_frames_that_hide_the_surface_count_their_leaks_only(self):
        found = mattes.measure([1, 2, 3], [1], lambda f: disc(70) * (f != 3), lambda f: disc(70))
        self.assertEqual(found["iou_worst"], 1)
        self.assertGreater(found["leak_worst"], 0.9)

    def test_a_ragged_edge_is_neither_leak_nor_hole_and_a_piece_far_away_is(self):
        far = mattes.far_px(160)
        near = self.measured(lambda f: disc(70, 30 + 0.5 * far))
        self.assertEqual((near["leak"], near["hole"]), (0, 0))
        self.assertEqual(self.measured(lambda f: disc(70, 30 - 0.5 * far))["hole"], 0)
        island = self.measured(lambda f: np.maximum(disc(70), disc(130, 6) * (f == 3)))
        area = (disc(70) >= 0.5).sum()
        self.assertAlmostEqual(island["leak_worst"], (disc(130, 6) >= 0.5).sum() / area, places=4)
        self.assertAlmostEqual(island["leak"], island["leak_worst"] / 3, places=4)
        self.assertEqual([row["leak"] > 0 for row in island["frames"]], [False, True, False])

    def test_a_lost_limb_is_a_hole_however_thin_it_is(self):
        limb = np.zeros((120, 160), bool)
        limb[58:63, 100:150] = True
        found = mattes.measure([1, 2], [1], lambda f: np.maximum(disc(70), limb), lambda f: disc(70))
        self.assertGreater(found["hole"], 0.05)

    def test_a_loose_outline_is_smooth_near_the_true_one_and_the_same_every_time(self):
        true = disc(70)
        loose = mattes.loosely_painted(true, 7)
        np.testing.assert_array_equal(loose, mattes.loosely_painted(true, 7))
        self.assertTrue((loose != mattes.loosely_painted(true, 8)).any())
        self.assertFalse((loose & ~mattes.fields.dilated(true >= 0.5, 3)).any())
        self.assertLess(mattes.intersection_over_union(loose, true >= 0.5), 0.999)


if __name__ == "__main__":
    unittest.main()
