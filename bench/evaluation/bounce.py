"""A coloured ball on a floor, computed: its shadow, and its colour on the floor, which falls off as a sphere's light does."""
import numpy as np

import cloths

SIZE = (270, 480)
FRAMES = 6
RADIUS = 48.0           # of the ball, px
LOOK = 0.55             # the floor's depth is seen this much shorter
FLOORS = ("grey", "planks", "pebbles")
BALLS = {"red": (0.6, 0.04, 0.04), "green": (0.06, 0.45, 0.08), "orange": (0.7, 0.28, 0.03)}


def floor_paint(kind, u, v):
    if kind == "grey":
        return np.full((*u.shape, 3), 0.45)
    if kind == "planks":
        board = np.floor(v / 24)
        tone = 0.75 + 0.25 * cloths.smooth_noise(5, board * 7.3, board * 3.1, 1) + 0.12 * cloths.smooth_noise(6, u, v, 5)
        return np.where(v[..., None] % 24 < 1.5, 0.1, tone[..., None] * np.array([0.42, 0.29, 0.18]))
    grain = cloths.clouds(9, u, v, 12, 3)
    return np.clip(0.4 + 0.14 * grain, 0.05, 0.9)[..., None] * np.array([0.95, 1.0, 1.02])


def frame_of(floor, ball, k):
    """(plate in levels, matte of the floor, true light H×W×3, distance to the ball's outline in px, where seen)."""
    height, width = SIZE
    cx, cy = width / 2 + 3.0 * k, height * 0.62      # where the ball touches the floor
    y, x = np.mgrid[0:height, 0:width] + 0.5
    along, away = (x - cx) / RADIUS, (y - cy) / LOOK / RADIUS
    d2 = along ** 2 + away ** 2
    # The form factor of a sphere that touches the plane, from a point of it at distance d (radii).
    factor = (d2 + 1) ** -1.5
    shadow = 1 / (1 + np.exp(-6 * (np.hypot((along - 1.1) / 1.6, away - 0.2) - 0.9)))
    bounced = np.array(BALLS[ball]) * 0.8
    light = (0.4 * (1 - 0.9 * factor) + 0.6 * shadow)[..., None] + factor[..., None] * bounced
    plate = light * floor_paint(floor, x - 3.0 * k, y / LOOK)
    bx, by = x - cx, y - (cy - RADIUS * np.sqrt(1 - LOOK ** 2))
    r = np.hypot(bx, by)
    normal_z = np.sqrt(np.clip(1 - (r / RADIUS) ** 2, 0, 1))
    lit = 0.35 + 0.65 * np.clip(-0.5 * bx / RADIUS - 0.6 * by / RADIUS + 0.6 * normal_z, 0, 1)
    inside = np.clip(RADIUS - r + 0.5, 0, 1)
    plate = plate * (1 - inside[..., None]) + inside[..., None] * lit[..., None] * np.array(BALLS[ball])
    noise = np.random.default_rng([len(floor), len(ball), k]).normal(size=plate.shape)
    encoded = np.where(plate <= 0.0031308, 12.92 * plate, 1.055 * np.maximum(plate, 1e-8) ** (1 / 2.4) - 0.055)
    return (np.clip(np.rint(255 * encoded + cloths.NOISE * noise), 0, 255).astype(np.uint8),
            (1 - inside).astype(np.float32), light.astype(np.float32), (r - RADIUS).astype(np.float32))
