"""The picture of the third rendering: glazed tiles with motifs that differ from tile to tile, so that any slip, turn or
swap of places shows, and no two directions look alike."""
import numpy as np

import images

SIDE = 512
TILES = 2


def tile_picture(path):
    """SIDE × SIDE, sRGB, 8 bit; repeats without a seam."""
    rng = np.random.default_rng(5)
    y, x = np.mgrid[0:SIDE, 0:SIDE].astype(np.float32) + 0.5
    cell = SIDE / TILES
    picture = np.empty((SIDE, SIDE, 3), np.float32)
    for row in range(TILES):
        for column in range(TILES):
            here = (y // cell == row) & (x // cell == column)
            u, v = (x % cell) / cell - 0.5, (y % cell) / cell - 0.5
            ground = rng.uniform(0.35, 0.75, 3) * [1.0, 0.95, 0.85]
            ink = rng.uniform(0.08, 0.3, 3)
            turn, petals = rng.uniform(0, 2 * np.pi), rng.integers(3, 7)
            radius, angle = np.hypot(u, v), np.arctan2(v, u)
            flower = radius < 0.26 + 0.12 * np.cos(petals * angle + turn)
            arrow = (np.abs(u * np.cos(turn) + v * np.sin(turn)) < 0.03) & (u * np.sin(turn) - v * np.cos(turn) > 0)
            colour = np.where((flower ^ arrow)[..., None], ink, ground)
            joint = (np.abs(u) > 0.47) | (np.abs(v) > 0.47)
            picture[here] = np.where(joint[..., None], [0.82, 0.8, 0.76], colour)[here]
    images.write(path, picture + rng.normal(0, 0.015, picture.shape), "uint8")
