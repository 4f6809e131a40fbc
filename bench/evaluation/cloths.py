"""Computed cloth: folds, sheen, prints and soft paints whose light is known exactly, in motion.

A surface is a height field with paint on it, or with pile, whose colour shifts with direction. It is seen in parallel
projection, turned and moved by a pose, under one far lamp and an even sky. Everything follows from its name and a seed."""
from dataclasses import dataclass

import numpy as np

SIZE = (270, 480)       # height, width
FRAMES = 6
MARGIN = 14             # pixels around the region
SKY, LAMP = 0.35, 0.75
FALL = 0.4              # ln units, of the light from one side of the picture to the other
NOISE = 1.0             # levels, the deviation of the grain

MOTIONS = ("still", "slides", "turns", "relit")


@dataclass
class Frame:
    plate: np.ndarray         # H×W×3, levels of 0 to 255 with grain
    light: np.ndarray         # H×W, the true light, linear
    paint: np.ndarray         # H×W, the luma of the paint; 1 on pile
    ref_from_cur: np.ndarray  # 2×3, from a pixel's centre to where it was on the first frame


def smooth_noise(seed, u, v, size):
    """Noise between −1 and 1 at places of the surface: one value every `size`, smoothly between."""
    x, y = u / size, v / size
    i, j = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    fx, fy = x - i, y - j
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)

    def at(a, b):
        key = (a * 374761393 + b * 668265263 + seed * 974634541) & 0xFFFFFFFF
        key = ((key ^ (key >> 13)) * 1274126177) & 0xFFFFFFFF
        return ((key ^ (key >> 16)) & 0xFFFF) / 32767.5 - 1
    top, low = at(i, j) * (1 - fx) + at(i + 1, j) * fx, at(i, j + 1) * (1 - fx) + at(i + 1, j + 1) * fx
    return top * (1 - fy) + low * fy


def clouds(seed, u, v, size, octaves=4):
    """Sums of noise with equal energy by octave, divided by its deviation."""
    return sum(smooth_noise(seed + k, u, v, size / 2 ** k) / 1.6 ** k for k in range(octaves)) * 2.0


def folds(seed, u, v):
    """The height of ridges that bend, branch and fade, px."""
    rng = np.random.default_rng(seed)
    angle = rng.uniform(0, np.pi)
    a, b = u * np.cos(angle) + v * np.sin(angle), v * np.cos(angle) - u * np.sin(angle)
    a = a + 14 * smooth_noise(seed + 11, u, v, 70)
    ridge = 1 - np.abs(smooth_noise(seed + 12, a * 1.0, b * 0.22, 26))
    fine = 1 - np.abs(smooth_noise(seed + 13, a, b * 0.3, 13))
    return 9 * ridge * ridge * (0.7 + 0.3 * smooth_noise(seed + 14, u, v, 90)) + 2.2 * fine * fine


def mixed(low, high, share):
    return np.asarray(low) + (np.asarray(high) - np.asarray(low)) * np.clip(share, 0, 1)[..., None]


def flowers(seed, u, v, size=46, radius=13):
    i, j = np.floor(u / size), np.floor(v / size)
    du, dv = u - (i + 0.5) * size, v - (j + 0.5) * size
    r, a = np.hypot(du, dv), np.arctan2(dv, du) + seed
    return r < radius * (0.7 + 0.3 * np.cos(5 * a))


def paint_of(kind, seed, u, v):
    """The paint, linear RGB, at places of the surface."""
    white, one = np.array([0.62, 0.6, 0.55]), np.ones_like(u)
    if kind == "plain":
        return mixed([0.5, 0.33, 0.26], white, 0 * one)
    if kind == "white":
        return mixed(white, white, one)
    if kind.startswith("weave"):
        depth = 0.01 * float(kind[5:])
        return (1 + depth * np.sign(np.sin(u * 1.9) * np.sin(v * 1.9)))[..., None] * np.array([0.4, 0.4, 0.45])
    if kind == "lines":
        return mixed(white, [0.06, 0.06, 0.07], (v % 30 < 4) * 1.0)
    if kind == "stripes":
        return mixed(white, [0.1, 0.14, 0.35], (u % 44 < 20) * 1.0)
    if kind == "grey stripes":
        return mixed([0.5] * 3, [0.25] * 3, (u % 44 < 20) * 1.0)
    if kind == "checks":
        return mixed(white, [0.45, 0.1, 0.08], 0.5 * ((u % 36 < 18) * 1.0 + (v % 36 < 18)))
    if kind == "dots":
        return mixed([0.25, 0.3, 0.5], white, (np.hypot(u % 26 - 13, v % 26 - 13) < 5) * 1.0)
    if kind == "flowers":
        return mixed([0.6, 0.55, 0.42], [0.5, 0.12, 0.16], flowers(seed, u, v) * 1.0)
    if kind == "clouds":      # brown on cream, soft
        return mixed([0.16, 0.09, 0.05], [0.6, 0.5, 0.38], 0.5 + 0.3 * clouds(seed + 20, u, v, 60))
    if kind == "blue clouds":
        return mixed([0.06, 0.1, 0.3], [0.55, 0.6, 0.66], 0.5 + 0.3 * clouds(seed + 21, u, v, 44))
    if kind == "stains":      # few, soft, of one hue, on a pale ground
        return mixed([0.62, 0.58, 0.5], [0.3, 0.2, 0.1], 1.3 * clouds(seed + 22, u, v, 70, 2) - 0.5)
    if kind == "marble":
        vein = 1 - np.abs(np.tanh(3 * smooth_noise(seed + 23, u + 30 * smooth_noise(seed + 24, u, v, 60), v * 0.5, 60)))
        return mixed([0.62, 0.6, 0.56], [0.28, 0.26, 0.24], vein * 0.8 + 0.15 * clouds(seed + 25, u, v, 80))
    if kind == "batik":       # soft, of three hues
        first = mixed([0.5, 0.42, 0.2], [0.1, 0.25, 0.35], 0.5 + 0.4 * clouds(seed + 26, u, v, 50))
        return mixed(first, np.array([0.5, 0.12, 0.1]), (0.4 * clouds(seed + 27, u, v, 60))).clip(0.02, 1)
    raise ValueError("no paint is called " + kind)


PILES = {"violet": ([0.08, 0.02, 0.13], [0.5, 0.42, 0.6]), "green": ([0.02, 0.09, 0.04], [0.35, 0.5, 0.38]),
         "red": ([0.2, 0.015, 0.02], [0.6, 0.35, 0.32]), "brown": ([0.13, 0.06, 0.03], [0.5, 0.4, 0.28])}


def turned(roll, yaw, pitch):
    """A rotation, camera from surface; degrees. y points down."""
    r, y, p = np.radians([roll, yaw, pitch])
    about_z = np.array([[np.cos(r), -np.sin(r), 0], [np.sin(r), np.cos(r), 0], [0, 0, 1]])
    about_y = np.array([[np.cos(y), 0, np.sin(y)], [0, 1, 0], [-np.sin(y), 0, np.cos(y)]])
    about_x = np.array([[1, 0, 0], [0, np.cos(p), -np.sin(p)], [0, np.sin(p), np.cos(p)]])
    return about_z @ about_y @ about_x


def lamp_at(azimuth, height=45):
    a, h = np.radians([azimuth, height])
    return np.array([np.cos(h) * np.cos(a), np.cos(h) * np.sin(a), np.sin(h)])


def pose_of(motion, k, seed):
    """(rotation, shift, lamp) of frame k."""
    t, first = k / (FRAMES - 1), 37 * seed % 360
    rotation, shift, lamp = turned(0, 8, -6), np.zeros(2), lamp_at(first)
    if motion == "slides":
        shift = np.array([60 * t, -20 * t])
    elif motion == "turns":
        rotation, shift = turned(24 * t, 8 + 34 * t, -6 - 8 * t), np.array([18 * t, 6 * t])
    elif motion == "relit":
        lamp = lamp_at(first + 70 * t, 40 + 15 * t)
    return rotation, shift, lamp


def affine_of(rotation, shift):
    """2×3, picture from surface."""
    centre = np.array([SIZE[1] / 2, SIZE[0] / 2])
    return np.hstack([rotation[:2, :2], (centre + shift)[:, None]])


def joined(a, b):
    """a after b, both 2×3."""
    return np.hstack([a[:, :2] @ b[:, :2], a[:, :2] @ b[:, 2:] + a[:, 2:]])


def inverse(a):
    linear = np.linalg.inv(a[:, :2])
    return np.hstack([linear, -linear @ a[:, 2:]])


def sun_through_leaves(seed, x, y, k):
    """The share of the lamp that arrives under leaves that sway, 0 to 1; it does not go with the surface."""
    dx, dy = 5 * np.sin(0.7 * k), 4 * np.cos(0.5 * k)
    n = smooth_noise(seed + 40, x + dx, y + dy, 34) + 0.6 * smooth_noise(seed + 41, x - dy, y + dx, 17)
    return 1 / (1 + np.exp(-7 * (n + 0.1)))


def frame_of(case, k):
    """`case`: (paint or pile, folds' height 0 to 1, motion, leaves or not, seed)."""
    kind, depth, motion, leaves, seed = case
    rotation, shift, lamp = pose_of(motion, k, seed)
    y, x = np.mgrid[0:SIZE[0], 0:SIZE[1]] + 0.5
    back = inverse(affine_of(rotation, shift))
    u, v = back[0, 0] * x + back[0, 1] * y + back[0, 2], back[1, 0] * x + back[1, 1] * y + back[1, 2]
    step = 0.5
    along = depth * (folds(seed, u + step, v) - folds(seed, u - step, v)) / (2 * step)
    down = depth * (folds(seed, u, v + step) - folds(seed, u, v - step)) / (2 * step)
    normal = np.stack([-along, -down, np.ones_like(along)], -1)
    normal = (normal / np.linalg.norm(normal, axis=-1, keepdims=True)) @ rotation.T
    arrives = sun_through_leaves(seed, x, y, k) if leaves else 1.0
    light = SKY * (0.7 + 0.3 * normal[..., 2]) + LAMP * arrives * np.clip(normal @ lamp, 0, None)
    light = light * np.exp(FALL * (x / SIZE[1] - 0.5) * np.cos(seed) + FALL * (y / SIZE[0] - 0.5) * np.sin(seed))
    if kind in PILES:
        body, sheen = (np.array(c) for c in PILES[kind])
        rim = np.clip(1 - np.clip(normal[..., 2], 0, 1), 0, 1) ** 0.7
        linear = light[..., None] * mixed(body, sheen, 0.1 + 1.1 * rim * np.clip(normal @ lamp + 0.3, 0, 1))
        paint, light = np.ones_like(light), linear @ np.array([0.2126, 0.7152, 0.0722])
    else:
        colour = paint_of(kind, seed, u, v)
        linear, paint = light[..., None] * colour, colour @ np.array([0.2126, 0.7152, 0.0722])
    rng = np.random.default_rng([seed, k, len(kind)])
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.clip(linear, 1e-8, None) ** (1 / 2.4) - 0.055)
    plate = np.clip(np.rint(255 * encoded + NOISE * rng.normal(size=linear.shape)), 0, 255).astype(np.uint8)
    first = affine_of(*pose_of(motion, 0, seed)[:2])
    return Frame(plate, light.astype(np.float32), paint.astype(np.float32), joined(first, back))


FLAT = ("clouds", "blue clouds", "stains", "marble", "batik", "lines", "stripes")
FOLDED = (("clouds", 0.5), ("stains", 0.5), ("marble", 0.5), ("batik", 0.5), ("plain", 0.35), ("plain", 1.0), ("weave5", 0.7),
          ("weave15", 0.7), ("lines", 0.4), ("lines", 1.0), ("stripes", 0.4), ("stripes", 1.0), ("grey stripes", 0.6),
          ("checks", 0.6), ("dots", 0.6), ("flowers", 0.6), ("violet", 0.6), ("green", 0.8), ("red", 0.6), ("brown", 1.0))
TOLD_BY_MOTION = ("clouds", "blue clouds", "stains", "batik", "violet", "brown")


def cases(half):
    """Cases of the half that is developed on (0) or reported (1)."""
    found = [(kind, depth, motion, False) for motion in MOTIONS for kind, depth in (*((k, 0.0) for k in FLAT), *FOLDED)
             if motion in ("still", "turns") or kind in TOLD_BY_MOTION]
    found += [(kind, 0.5, motion, True) for kind in ("white", "stripes", "flowers", "clouds") for motion in ("still", "slides")]
    return [(*case, 1000 + 500 * half + 7 * k) for k, case in enumerate(found)]
