#!/usr/bin/env python3
"""Makes the demo's texture samples, textures/brick.png and textures/knit.png.

Everything is computed here from seeded noise, so the samples are this project's own (CC0). Needs
numpy and Pillow (Debian: python3-numpy python3-pil); run it in this folder.
"""
import numpy as np
from PIL import Image

rng = np.random.default_rng(7)


def noise(height, width, cell):
    """Smooth noise in [-1, 1] with features of about `cell` px, joining at the borders."""
    spectrum = np.fft.fft2(rng.standard_normal((height, width)))
    fy, fx = np.fft.fftfreq(height)[:, None], np.fft.fftfreq(width)[None, :]
    spectrum *= np.exp(-0.5 * (cell * 2.5) ** 2 * (fx**2 + fy**2))
    out = np.fft.ifft2(spectrum).real
    return out / np.abs(out).max()


def lit(height_map, strength):
    """Lambert shading of a height map under light from the upper left."""
    gy = np.roll(height_map, -1, 0) - np.roll(height_map, 1, 0)
    gx = np.roll(height_map, -1, 1) - np.roll(height_map, 1, 1)
    normal = np.stack([-gx * strength, -gy * strength, np.ones_like(gx)], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    light = np.array([-0.42, -0.55, 0.72])
    return np.clip(normal @ (light / np.linalg.norm(light)), 0, 1)


def save(name, rgb):
    Image.fromarray((np.clip(rgb, 0, 1) * 255 + 0.5).astype(np.uint8)).save(f"textures/{name}.png", optimize=True)


def brick():
    """Running bond, 4 bricks by 8 courses of 68x28 px with 5 px of mortar."""
    brick_w, brick_h, joint = 68, 28, 5
    height, width = 8 * brick_h, 4 * brick_w
    y, x = np.mgrid[0:height, 0:width].astype(float)
    wobble = 1.6 * noise(height, width, 7)
    row = (y // brick_h).astype(int)
    along = (x + (row % 2) * brick_w / 2 + wobble) % brick_w
    across = (y + 1.2 * noise(height, width, 9)) % brick_h
    column = (((x + (row % 2) * brick_w / 2) // brick_w) % 4).astype(int)
    edge = np.minimum.reduce([along, brick_w - along, across, brick_h - across]) - joint / 2
    inside = np.clip(edge / 1.8 + 0.3, 0, 1)
    relief = np.clip(edge / 4, 0, 1) ** 0.5 * 2.4
    relief += 0.55 * noise(height, width, 1.2) + 0.7 * noise(height, width, 3)
    tones = np.array([[0.52, 0.27, 0.19], [0.56, 0.30, 0.22], [0.49, 0.24, 0.18], [0.58, 0.33, 0.25], [0.45, 0.23, 0.18]])
    pick = rng.integers(0, len(tones), (8, 4))
    clay = tones[pick[row % 8, column]] * (1 + 0.06 * rng.standard_normal((8, 4))[row % 8, column])[..., None]
    clay = clay * (1 + 0.14 * noise(height, width, 2.2) + 0.08 * noise(height, width, 9))[..., None]
    mortar = np.array([0.62, 0.58, 0.52]) * (1 + 0.14 * noise(height, width, 1.3))[..., None]
    shade = 0.30 + 0.92 * lit(relief, 0.55)
    save("brick", (inside[..., None] * clay + (1 - inside[..., None]) * mortar) * shade[..., None])


def knit():
    """Stockinette: columns of V stitches, 16x13 px, of a twisted two-tone yarn."""
    stitch_w, stitch_h = 16, 13
    height, width = 16 * stitch_h, 13 * stitch_w
    y, x = np.mgrid[0:height, 0:width].astype(float)
    x = x + 0.8 * noise(height, width, 14)
    y = y + 0.8 * noise(height, width, 14)
    u = (x % stitch_w) / stitch_w - 0.5
    side = np.where(u < 0, -1.0, 1.0)
    # Each leg of the V is a leaning ellipse; the one of the next course lies over its foot.
    best = np.full((height, width), -1.0)
    twist = np.zeros((height, width))
    for course in (-1, 0, 1):
        v = (y % stitch_h) / stitch_h - 0.5 + course
        cx, cy = 0.25 * side, 0.0
        dx, dy = (u - cx) * stitch_w, (v - cy) * stitch_h
        angle = side * 0.52
        along = dy * np.cos(angle) - dx * np.sin(angle)
        across = dx * np.cos(angle) + dy * np.sin(angle)
        dome = 1 - (along / 10.2) ** 2 - (across / 4.3) ** 2
        depth = dome - 0.12 * v
        front = depth > best
        best = np.where(front, depth, best)
        twist = np.where(front, along * 1.15 + across * 1.5 * side, twist)
    relief = np.sqrt(np.clip(best, 0, 1)) * 3.4 + 0.28 * np.sin(twist) + 0.35 * noise(height, width, 0.9)
    ply = 0.5 + 0.5 * np.sin(twist)
    yarn = np.array([0.80, 0.72, 0.58]) * (0.90 + 0.14 * ply)[..., None]
    yarn = yarn * (1 + 0.10 * noise(height, width, 1.0) + 0.06 * noise(height, width, 20))[..., None]
    shade = (0.28 + 0.86 * lit(relief, 0.42)) * (0.42 + 0.58 * np.clip(best + 0.25, 0, 1) ** 0.6)
    save("knit", yarn * shade[..., None])


brick()
knit()
