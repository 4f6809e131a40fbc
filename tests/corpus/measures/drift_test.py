import unittest

import worlds  # noqa: F401  (finds the modules under test)

import drift
import numpy as np


class Drift(unittest.TestCase):
    def setUp(self):
        self.truth = worlds.PlaneTruth()

    def measured(self, st_of_frame):
        return drift.of_surface(1, drift.matched(self.truth), st_of_frame)

    def sticker(self, frame, slip=(0, 0)):
        """A sticker laid on frame 1 that follows the truth, and then slips by `slip` px a frame on the picture."""
        y, x = np.mgrid[0:worlds.HEIGHT, 0:worlds.WIDTH].astype(np.float64)
        moved = (worlds.STEP_M * (frame - 1)) * worlds.FOCAL / -self.truth.data(frame).position[..., 2]
        return worlds.coordinates(np.stack([x - moved - slip[0] * (frame - 1), y - slip[1] * (frame - 1)], -1))

    def test_a_texture_that_follows_the_surface_does_not_drift(self):
        found = self.measured(self.sticker)
        self.assertLess(found["drift_worst_p90_px"], 0.01)

    def test_a_slip_is_told_in_pixels(self):
        found = self.measured(lambda f: self.sticker(f, (0.3, 0.4)))
        self.assertAlmostEqual(found["drift_last_median_px"], 1.5, delta=0.05)
        self.assertAlmostEqual(found["drift_median_px"], 1.0, delta=0.05)
        self.assertEqual(found["drift_worst_frame"], 4)

    def test_a_texture_that_stands_still_slides_by_the_motion(self):
        y, x = np.mgrid[0:worlds.HEIGHT, 0:worlds.WIDTH]
        still = worlds.coordinates(np.stack([x, y], -1))
        found = self.measured(lambda f: still)
        self.assertAlmostEqual(found["drift_last_median_px"], 3 * worlds.STEP_M * worlds.FOCAL / 2, delta=0.3)

    def test_one_colour_everywhere_is_no_success(self):
        flat = worlds.coordinates(np.zeros((worlds.HEIGHT, worlds.WIDTH, 2)))
        found = self.measured(lambda f: flat)
        self.assertEqual(found["drift_last_median_px"], drift.LOST_PX)

    def test_coordinates_that_smear_after_the_base_frame_are_errors(self):
        def smear(frame):
            y, x = np.mgrid[0:worlds.HEIGHT, 0:worlds.WIDTH]
            return worlds.coordinates(np.stack([x, y], -1) * (1 if frame == 1 else 1e-3))
        self.assertGreater(self.measured(smear)["drift_last_median_px"], 30)

    def test_planes_wrap(self):
        def wrapped(frame):
            st = self.sticker(frame)
            return worlds.coordinates(np.mod(st.texels, 256), 256)
        self.assertLess(self.measured(wrapped)["drift_worst_p90_px"], 0.01)

    def test_followed_motion_agrees(self):
        shift = np.zeros((worlds.HEIGHT, worlds.WIDTH, 2)) + (1.25, -0.5)
        whole = np.ones(shift.shape[:2], bool)
        y, x = np.mgrid[0:worlds.HEIGHT, 0:worlds.WIDTH]

        def st(frame, slip=0.0):
            return worlds.coordinates(np.stack([x - (1.25 + slip) * (frame - 1), y + 0.5 * (frame - 1)], -1))

        def run(slip):
            return drift.by_motion(range(1, 5), 1, lambda f: whole, lambda f: whole, lambda f: (shift, whole),
                                   lambda f: st(f, slip))
        self.assertLess(run(0)["drift_last_p90_px"], 1e-3)
        self.assertAlmostEqual(run(0.2)["drift_last_median_px"], 0.6, places=3)


if __name__ == "__main__":
    unittest.main()
