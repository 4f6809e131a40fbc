import unittest

import worlds  # noqa: F401  (finds the modules under test)

import numpy as np
import points


class Points(unittest.TestCase):
    def setUp(self):
        self.truth = worlds.PlaneTruth()
        self.known = points.truth_of(self.truth)

    def sticker(self, frame, slip_px=0.0):
        y, x = np.mgrid[0:worlds.HEIGHT, 0:worlds.WIDTH].astype(np.float64)
        moved = (worlds.STEP_M * (frame - 1)) * worlds.FOCAL / -self.truth.data(frame).position[..., 2]
        return worlds.coordinates(np.stack([x - moved - slip_px * (frame - 1), y], -1))

    def measured(self, st_of_frame):
        return points.ours(self.truth, self.known, st_of_frame)

    def test_what_follows_the_surface_is_all_right(self):
        found = self.measured(self.sticker)
        self.assertEqual(found["delta_average"], 1)
        self.assertEqual(found["jaccard"], [found["jaccard"][0]] * 5)
        self.assertGreater(found["average_jaccard"], 0.97)

    def test_a_slip_counts_by_its_length_at_256(self):
        # 1.5, 3 and 4.5 px, at 256 / 160: 2.4, 4.8 and 7.2.
        found = self.measured(lambda f: self.sticker(f, 1.5))
        self.assertEqual(found["delta"][0], 0)
        self.assertAlmostEqual(found["delta"][2], 1 / 3, delta=0.05)
        self.assertEqual(found["delta"][3], 1)

    def test_a_texture_that_is_lost_is_not_seen(self):
        far = worlds.coordinates(np.full((worlds.HEIGHT, worlds.WIDTH, 2), 500.0))
        found = self.measured(lambda f: self.sticker(f) if f == 1 else far)
        self.assertEqual(found["average_jaccard"], 0)
        self.assertLess(found["occlusion_accuracy"], 0.1)

    def test_one_that_goes_on_over_what_is_hidden_is_false(self):
        cover = self.truth.coverage

        def half(frame):
            share = cover(frame).copy()
            share[:, :80] *= frame == 1
            return share
        self.truth.coverage = half
        known = points.truth_of(self.truth)
        self.truth.coverage = cover  # the surface goes on where it is hidden
        found = points.ours(self.truth, known, self.sticker)
        self.assertEqual(found["delta_average"], 1, "of what is seen")
        self.assertLess(found["average_jaccard"], 0.75)
        self.assertLess(found["occlusion_accuracy"], 0.75)


if __name__ == "__main__":
    unittest.main()
