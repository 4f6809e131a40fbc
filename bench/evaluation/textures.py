"""The textures that are laid: one to follow, the grey of the second rendering, the tile of the third."""
import numpy as np

import fields
import images

SIDE = 1024  # texels of the followed texture: coordinates are known up to its whole multiples


def followed(path):
    """A fixed texture that repeats, with detail of 2 to 60 texels in luma and colour. Kept if it exists."""
    if path.is_file():
        return path
    rng = np.random.default_rng(20)
    picture = np.full((SIDE, SIDE, 3), 0.45, np.float32)
    for sigma, strength in ((1.0, 0.06), (3.0, 0.08), (8.0, 0.1), (24.0, 0.1)):
        reach = int(4 * sigma)
        for colour in (np.ones(3), rng.uniform(-0.7, 0.7, 3)):
            noise = np.pad(rng.normal(size=(SIDE, SIDE)).astype(np.float32), reach, mode="wrap")
            noise = fields.blurred(noise, sigma)[reach:-reach, reach:-reach]
            picture += (strength * noise / noise.std())[..., None] * colour.astype(np.float32)
    images.write(path, np.clip(picture, 0.02, 0.98), "uint8")
    return path


def grey(path, linear):
    """A flat picture whose sRGB code is the nearest to `linear`."""
    images.write(path, np.full((64, 64, 3), images.srgb_from_linear(np.float32(linear))), "uint8")
    return path


def tile_of(scene):
    """The picture of the scene's tiled rendering, or None."""
    path = scene.folder / "tile.png"
    return path if path.is_file() else None
