import unittest

import worlds  # noqa: F401

import images
import light
import numpy as np


def shading(frame):
    v, u = np.mgrid[0:80, 0:100]
    return (0.3 + 0.2 * np.sin(u / 17 + 0.1 * frame) * np.cos(v / 11))[..., None].repeat(3, -1).astype(np.float32)


class Light(unittest.TestCase):
    def interior(self, change):
        frames = []
        for frame in range(3):
            true = shading(frame).reshape(-1, 3)
            frames.append((change(true).astype(np.float32), true))
        return light.interior(frames, *light.fitted_gains(frames))

    def test_the_truth_at_any_brightness_is_without_error(self):
        for gain in (1.0, 0.6, 1.7):
            found = self.interior(lambda true: gain * true)
            self.assertLess(found["levels_p95"], 0.1)
            self.assertGreater(found["correlation_worst"], 0.9999)

    def test_no_light_has_the_light_s_own_deviation_as_error(self):
        found = self.interior(lambda true: np.full_like(true, 0.3))
        self.assertIsNone(found["correlation"])
        self.assertGreater(found["levels"], 0.6 * found["true_deviation_levels"])

    def test_noise_lowers_the_correlation_and_raises_the_error(self):
        noise = np.random.default_rng(1).normal(0, 0.05, (8000, 1))
        found = self.interior(lambda true: true + noise)
        self.assertLess(found["correlation"], 0.97)
        self.assertGreater(found["levels"], 4)

    def test_one_gain_for_the_clip_does_not_forgive_flicker(self):
        frames = [((1 + 0.3 * (f % 2)) * shading(f).reshape(-1, 3), shading(f).reshape(-1, 3)) for f in range(4)]
        found = light.interior(frames, *light.fitted_gains(frames))
        self.assertGreater(found["levels"], 5)

    def test_the_best_gain_is_the_best(self):
        rng = np.random.default_rng(2)
        true = rng.uniform(0.05, 0.9, 5000).astype(np.float32)
        ours = true * rng.uniform(0.5, 0.9, 5000).astype(np.float32)
        best = light.best_gain(ours, true)

        def error(gain):
            return np.abs(light.levels(gain * ours) - light.levels(true)).mean()
        self.assertLessEqual(error(best), min(error(g) for g in np.linspace(0.8, 2.5, 200)) + 0.01)

    def test_an_edge_of_the_truth_is_without_error(self):
        share = np.linspace(0.03, 0.97, 400, dtype=np.float32)[:, None] * np.ones(3, np.float32)
        back, material = np.float32((0.2, 0.4, 0.1)), np.float32((0.35, 0.35, 0.35))
        expected = (1 - share) * back + share * material
        halo = np.float32((0.05, 0, 0)) * share
        self.assertLess(light.edge_error([(expected, (1 - share) * back, share * material / 2)], np.full(3, 2.0)), 1e-3)
        self.assertGreater(light.edge_error([(expected, (1 - share) * back + halo, share * material)], np.ones(3)), 1)


class Levels(unittest.TestCase):
    def test_levels_are_srgb_codes(self):
        codes = np.arange(256, dtype=np.float32)
        np.testing.assert_allclose(light.levels(images.linear_from_srgb(codes / 255)), codes, atol=1e-3)


if __name__ == "__main__":
    unittest.main()
