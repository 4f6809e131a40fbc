#!/usr/bin/env python3
"""Draws the drawn test clip: a character in flat fills and ink, held on twos and threes.

    python3 make_drawn.py [FOLDER]

Needs numpy. Writes, for frames 0001 to 0030 of 640x360 at 24 frames a second:

    frames/####.png         the plate
    lines/####.png          the ink: coverage, 8-bit grey
    mattes/NAME/####.png    the fill's extent, what passes in front of it included
    holdouts/NAME/####.png  what passes in front of it, without ink
    flow/NAME/####.png      true motion to the next frame (KITTI 16 bit), on the fill's extent

for the fills cape, tunic and sleeve. Every fill has coordinates of its own, `u`, which a drawing takes to
the picture by f_k(u) = A_k (u + bend_k(u)) + t_k; so mattes and motion are exact. Frames of one drawing are
the same bytes.
"""
import os
import struct
import sys
import zlib

import numpy as np

W, H = 640, 360
# How many frames each drawing is held: twos, then threes, then ones.
HOLDS = [2] * 6 + [3] * 3 + [1] * 3 + [2] * 3
INK = np.array([34, 26, 30.0])
INK_WIDTH = 2.6

Y, X = np.mgrid[0:H, 0:W].astype(np.float64) + 0.5


def png(path, pixels):
    """8- or 16-bit grey or RGB."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    pixels = np.ascontiguousarray(pixels)
    deep = pixels.dtype == np.uint16
    channels = 1 if pixels.ndim == 2 else 3
    rows = pixels.astype(">u2" if deep else np.uint8).reshape(pixels.shape[0], -1)
    raw = rows.view(np.uint8).reshape(pixels.shape[0], -1).astype(np.int16)
    step = channels * (2 if deep else 1)
    up = np.vstack([np.zeros((1, raw.shape[1]), np.int16), raw[:-1]])
    left = np.hstack([np.zeros((raw.shape[0], step), np.int16), raw[:, :-step]])
    best = None
    for kind, line in ((0, raw), (1, raw - left), (2, raw - up)):
        body = (line & 255).astype(np.uint8)
        data = np.hstack([np.full((body.shape[0], 1), kind, np.uint8), body]).tobytes()
        packed = zlib.compress(data, 9)
        if best is None or len(packed) < len(best):
            best = packed

    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    head = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 16 if deep else 8,
                       2 if channels == 3 else 0, 0, 0, 0)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", best) + chunk(b"IEND", b""))


def rotation(degrees):
    a = np.radians(degrees)
    return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])


class Pose:
    """f_k of one fill in one drawing."""

    def __init__(self, matrix, place, bend=None):
        self.matrix, self.place, self.bend = matrix, np.asarray(place, float), bend

    def material(self, x, y):
        inverse = np.linalg.inv(self.matrix)
        dx, dy = x - self.place[0], y - self.place[1]
        u, v = inverse[0, 0] * dx + inverse[0, 1] * dy, inverse[1, 0] * dx + inverse[1, 1] * dy
        return (u if self.bend is None else u - self.bend(v)), v

    def picture(self, u, v):
        if self.bend is not None:
            u = u + self.bend(v)
        m = self.matrix
        return m[0, 0] * u + m[0, 1] * v + self.place[0], m[1, 0] * u + m[1, 1] * v + self.place[1]


# ---- shapes: signed distance in the fill's own coordinates, negative inside ------------------------

def rounded_trapezoid(u, v, top, bottom, height, radius):
    """Between half widths `top` at v = 0 and `bottom` at v = height."""
    slope = (bottom - top) / height
    side = (np.abs(u) - (top + slope * v)) / np.hypot(1, slope)
    d = np.stack([side, -v, v - height]) + radius
    outside = np.hypot(np.maximum(d[0], 0), np.maximum(np.maximum(d[1], d[2]), 0))
    return outside + np.minimum(np.max(d, axis=0), 0) - radius


def capsule(u, v, length, r0, r1):
    t = np.clip(v / length, 0, 1)
    return np.hypot(u, v - t * length) - (r0 + (r1 - r0) * t)


def cape_shape(u, v):
    return rounded_trapezoid(u, v, 46, 104, 190, 10)


def tunic_shape(u, v):
    return rounded_trapezoid(u, v, 44, 62, 140, 16)


def sleeve_shape(u, v):
    return capsule(u, v, 92, 21, 25)


def coverage(distance):
    return np.clip(0.5 - distance, 0, 1)


def over(picture, colour, alpha):
    return picture + alpha[..., None] * (np.asarray(colour, float) - picture)


# ---- the drawings ----------------------------------------------------------------------------------

def poses(k):
    """The fills of drawing k."""
    sway = 7 * np.sin(0.45 * k)
    lean = rotation(2.5 * np.sin(0.45 * k + 0.6))
    body = np.array([300 + 3.2 * k + sway, 130 + 2 * np.sin(0.9 * k)])
    squash = np.diag([1 + 0.03 * np.sin(0.9 * k), 1 - 0.03 * np.sin(0.9 * k)])

    def wave(v):
        return (v / 190) ** 1.3 * (22 * np.sin(v / 46 - 0.8 * k) + 9 * np.sin(0.5 * k)) \
            if np.isscalar(v) else np.sign(v) * (np.abs(v) / 190) ** 1.3 * (
                22 * np.sin(v / 46 - 0.8 * k) + 9 * np.sin(0.5 * k))

    tunic = Pose(lean @ squash, body)
    shoulder = np.array(tunic.picture(38.0, 16.0))
    swing = rotation(18 + 40 * np.sin(0.38 * k))
    return {"cape": Pose(rotation(6 + 4 * np.sin(0.4 * k)), body + [-16, -6], wave),
            "tunic": tunic, "sleeve": Pose(swing, shoulder)}


SHAPES = {"cape": cape_shape, "tunic": tunic_shape, "sleeve": sleeve_shape}
FILLS = {"cape": (176, 62, 60), "tunic": (86, 132, 160), "sleeve": (118, 160, 180)}
IN_FRONT = {"cape": ["legs", "tunic", "head", "sleeve", "hand"], "tunic": ["sleeve", "hand"], "sleeve": []}


def stroke(distance, drawing, weight=1.0, key=0):
    """Ink along distance = 0, its width and place a little different in every drawing, as a hand's are."""
    phase = 2.1 * drawing + key
    wobble = 0.35 * np.sin(X / 23 + phase) * np.cos(Y / 31 - 1.3 * phase)
    width = weight * INK_WIDTH * (1 + 0.22 * np.sin(X / 37 + Y / 29 + 0.7 * key))
    return np.clip(0.5 + width / 2 - np.abs(distance + wobble), 0, 1)


def fold(u, v, at, tilt, v0, v1):
    """Distance to a fold line of the cloth, far away beyond its ends."""
    d = np.abs(u - at - tilt * (v - v0) / (v1 - v0))
    return np.hypot(d, np.maximum(np.maximum(v0 - v, v - v1), 0))


def draw(k):
    """Plate, ink, and the fills' extents and holdouts of drawing k."""
    place = poses(k)
    own = {name: p.material(X, Y) for name, p in place.items()}
    distance = {name: SHAPES[name](*own[name]) for name in SHAPES}
    tunic = place["tunic"]
    head = np.hypot(X - tunic.picture(0, -34)[0], (Y - tunic.picture(0, -34)[1]) * 0.9) - 32
    hand_at = place["sleeve"].picture(0.0, 112.0)
    hand = np.hypot(X - hand_at[0], Y - hand_at[1]) - 17
    hip = tunic.picture(0, 134)
    legs = np.minimum(capsule(*Pose(rotation(9), (hip[0] - 22, hip[1])).material(X, Y), 110, 20, 15),
                      capsule(*Pose(rotation(-9), (hip[0] + 22, hip[1])).material(X, Y), 110, 20, 15))
    solid = dict(distance, head=head, hand=hand, legs=legs)

    # Background: a flat sky, hills, ground. It stands still.
    picture = np.zeros((H, W, 3)) + (188, 214, 224)
    hills = Y - (230 - 34 * np.sin(X / 92) - 16 * np.sin(X / 41 + 1))
    picture = over(picture, (146, 176, 140), coverage(-hills))
    picture = over(picture, (202, 180, 138), coverage(286 + 6 * np.sin(X / 120) - Y))
    ink = np.clip(0.5 + 0.9 - np.abs(hills), 0, 1) * (Y < 286)

    layers = [("cape", FILLS["cape"]), ("legs", (74, 66, 82)), ("tunic", FILLS["tunic"]),
              ("head", (236, 196, 164)), ("sleeve", FILLS["sleeve"]), ("hand", (236, 196, 164))]
    for number, (name, colour) in enumerate(layers):
        alpha = coverage(solid[name])
        ink = ink * (1 - alpha)
        picture = over(picture, colour, alpha)
        if name in own:
            u, v = own[name]
            # One tone of shadow, hard as it is painted.
            edge = {"cape": u - 30, "tunic": u - 18 - 8 * np.sin(v / 30), "sleeve": u - 7}[name]
            picture = over(picture, np.asarray(colour) * 0.74, alpha * coverage(-edge))
            lines = {"cape": [(-48, -26, 30, 180), (6, 14, 50, 184), (52, 30, 70, 182)],
                     "tunic": [(-20, -9, 78, 136), (14, 10, 84, 138)],
                     "sleeve": [(-6, 4, 60, 88)]}[name]
            for i, line in enumerate(lines):
                ink = np.maximum(ink, alpha * stroke(fold(u, v, *line), k, 0.8, 10 * number + i))
            if name == "tunic":  # a belt
                ink = np.maximum(ink, alpha * stroke(v - 92, k, 0.9, 77))
        ink = np.maximum(ink, stroke(solid[name], k, 1.0, number))
        if name == "head":
            for side in (-11, 11):
                eye = np.hypot((X - tunic.picture(side + 6, -38)[0]) * 1.6, Y - tunic.picture(0, -38)[1]) - 4.5
                ink = np.maximum(ink, coverage(eye))
    picture = over(picture, INK, ink)
    extent = {name: coverage(distance[name]) for name in SHAPES}
    holdout = {}
    for name, others in IN_FRONT.items():
        cover = np.zeros((H, W))
        for other in others:
            cover = np.maximum(cover, coverage(solid[other]))
        holdout[name] = cover
    return picture, ink, extent, holdout


def flow(name, k, to, extent):
    """Motion of the fill's points from drawing k to drawing `to`."""
    out = np.zeros((H, W, 3), np.uint16)
    u, v = poses(k)[name].material(X, Y)
    x, y = poses(to)[name].picture(u, v)
    known = extent > 0
    for channel, d in ((0, x - X), (1, y - Y)):
        out[..., channel] = np.where(known, np.round(d * 64) + 32768, 0).astype(np.uint16)
    out[..., 2] = known
    return out


def codes(coverage_01):
    return np.floor(255 * np.clip(coverage_01, 0, 1) + 0.5).astype(np.uint8)


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    drawing_of = [k for k, hold in enumerate(HOLDS) for _ in range(hold)]
    drawings = {}
    for index, k in enumerate(drawing_of):
        if k not in drawings:
            drawings = {k: draw(k)}
        picture, ink, extent, holdout = drawings[k]
        number = "%04d.png" % (index + 1)
        png(os.path.join(folder, "frames", number), np.floor(np.clip(picture, 0, 255) + 0.5).astype(np.uint8))
        png(os.path.join(folder, "lines", number), codes(ink))
        for name in SHAPES:
            png(os.path.join(folder, "mattes", name, number), codes(extent[name]))
            if IN_FRONT[name]:
                png(os.path.join(folder, "holdouts", name, number), codes(holdout[name]))
            if index + 1 < len(drawing_of):
                png(os.path.join(folder, "flow", name, number), flow(name, k, drawing_of[index + 1], extent[name]))


main()
