"""What a camera makes of a clean picture: grain that grows with the light, 8 bit sRGB."""
import numpy as np

import images

# Deviations of a current camera's grain at ISO 400 to 800, linear: photon noise and a floor (Foi et al. 2008, eq. 1).
PHOTON, FLOOR = 1.2e-4, 6e-6


def camera_picture(clean, rng):
    """sRGB, 0 to 1, from linear RGB; `rng` is seeded by scene and frame. The grain is a little correlated, as
    demosaicking leaves it."""
    noise = rng.standard_normal(clean.shape).astype(np.float32)
    soft = 0.6 * noise + 0.2 * (np.roll(noise, 1, 0) + np.roll(noise, 1, 1))
    soft /= np.sqrt(0.36 + 0.08)
    return images.srgb_from_linear(clean + soft * np.sqrt(PHOTON * np.clip(clean, 0, 1) + FLOOR))
