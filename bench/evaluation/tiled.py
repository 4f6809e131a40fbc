"""The coordinates of a scene's tiled rendering, in the form that `weft replace --uv` reads.

Laid by them nothing is tracked or guessed: what differs from the rendering is light, edges, and the two programs'
filtering of the picture (light.measure)."""
import numpy as np

import images


def write_coordinates(truth, folder):
    """ST-maps (0 to 1 across the tile, origin bottom left, repeating): their pattern, or None without coordinates."""
    scene, painted = truth.scene, truth.data(truth.painted_frame)
    if not np.any(painted.uv[painted.ids == truth.id]):
        return None
    for frame in scene.frames:
        st = truth.data(frame).uv / np.float32(scene.facts["tile_m"]) * np.float32((1, -1))
        images.write(folder / ("%04d.exr" % frame), st, "float", ("R", "G"))
    return str(folder / "####.exr")
