import unittest

import worlds

import form
import numpy as np


class Form(unittest.TestCase):
    def setUp(self):
        self.truth = worlds.PlaneTruth()

    def test_a_texture_along_the_surface_has_neither_stretch_nor_change_of_area(self):
        found = form.measure(self.truth, lambda f: worlds.laid_without_stretch(self.truth, f), 1)
        self.assertAlmostEqual(found["stretch_p90"], 1, delta=0.01)
        self.assertLess(found["area_p90"], 0.5)
        self.assertEqual(found["flipped_share"], 0)
        self.assertEqual(found["torn_share"], 0)

    def test_a_flat_sticker_has_the_slant_s_stretch(self):
        y, x = np.mgrid[0:worlds.HEIGHT, 0:worlds.WIDTH]
        flat = worlds.coordinates(np.stack([x, y], -1))
        found = form.measure(self.truth, lambda f: flat, 1)
        ray = worlds.rays()[self.truth.core(1, form.MARGIN_PX)]
        near = 1 + worlds.SLANT * ray[:, 1]
        metres = np.zeros((len(ray), 2, 2))  # across and along the slant, by the picture's x and y
        metres[:, 0, 0], metres[:, 0, 1] = 2 / near, -2 * worlds.SLANT * ray[:, 0] / near ** 2
        metres[:, 1, 1] = 2 * np.hypot(1, worlds.SLANT) / near ** 2
        both = np.linalg.svd(metres, compute_uv=False)
        self.assertAlmostEqual(found["stretch_median"], np.median(both[:, 0] / both[:, 1]), delta=0.002)
        self.assertGreater(found["area_p90"], 5)

    def test_breathing_counts_as_area(self):
        def breathing(frame):
            return worlds.laid_without_stretch(self.truth, frame, 100 * (1 if frame == 1 else 1.1))
        found = form.measure(self.truth, breathing, 1)
        self.assertAlmostEqual(found["area_median"], 100 * np.log(1.21), delta=0.5)

    def test_flips_and_tears_are_found(self):
        laid = worlds.laid_without_stretch(self.truth, 1)
        mirrored = laid.texels.copy()
        mirrored[:, 80:, 0] *= -1
        found = form.measure(self.truth, lambda f: worlds.coordinates(mirrored), 1)
        self.assertGreater(found["flipped_share"], 0.3)
        torn = laid.texels.copy()
        torn[:, 80:, 0] += 40
        found = form.measure(self.truth, lambda f: worlds.coordinates(torn), 1)
        self.assertGreater(found["torn_share"], 0.005)
        self.assertLess(found["torn_share"], 0.05)


if __name__ == "__main__":
    unittest.main()
