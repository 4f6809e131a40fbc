"""Drawn fills with ink: a figure, a creature or a flag in flat colours, held on ones, twos and threes; numpy only.

Hard: there is no shading and no texture to follow, drawings jump by many pixels and hold still in between, and ink
lies over all. Every fill has coordinates of its own (assets/drawn/make_drawn.py), so that all that is written is exact."""
import colorsys
import json
import pathlib
import re
import types

import numpy as np

TILE_PX = 64
GREY_LINEAR = 0.35
ASSET = pathlib.Path(__file__).resolve().parents[2] / "assets" / "drawn" / "make_drawn.py"


def toolbox(size):
    """The functions of make_drawn.py, for pictures of `size`, without making its clip."""
    module = types.ModuleType("make_drawn")
    source = re.sub(r"\nmain\(\)\s*$", "\n", ASSET.read_text(encoding="utf-8"))
    exec(compile(source, str(ASSET), "exec"), module.__dict__)
    module.W, module.H = size
    module.Y, module.X = np.mgrid[0:size[1], 0:size[0]].astype(np.float64) + 0.5
    return module


class Fill:
    """A fill of a drawing: its pose, its outline as a distance in its own coordinates, and how it is painted.

    `folds`: ink lines (at, tilt, v0, v1); `shade`: a distance below which it is painted darker."""

    def __init__(self, name, pose, shape, colour, surface=True, folds=(), shade=None):
        self.name, self.pose, self.shape, self.colour = name, pose, shape, np.asarray(colour, float)
        self.surface, self.folds, self.shade = surface, folds, shade


def ellipse(a, b):
    return lambda u, v: (np.hypot(u / a, v / b) - 1) * min(a, b)


def leaning(amount, bend_v):
    """A bend that shifts each height v sideways, growing with v."""
    return lambda v: amount * np.sign(v) * (np.abs(v) / bend_v) ** 1.5


def colour(rng):
    return 255 * np.array(colorsys.hsv_to_rgb(rng.uniform(0, 1), rng.uniform(0.25, 0.65), rng.uniform(0.5, 0.9)))


def figure(tools, rng, scale):
    """A cloaked figure that walks: cloak, legs, tunic, head, sleeve, hand."""
    tall, wide = rng.uniform(0.9, 1.15), rng.uniform(0.9, 1.2)
    pace, stride, phase = rng.uniform(0.4, 0.8), rng.uniform(3, 8) * rng.choice([-1, 1]), rng.uniform(0, 6)
    billow, skin = rng.uniform(12, 26), (236, 196, 164) if rng.integers(2) else (150, 104, 80)
    paint = [colour(rng) for _ in range(4)]

    def drawing(k, centre):
        sway = np.sin(pace * k + phase)
        body = centre + scale * np.array([stride * k + 6 * sway, -62 * tall + 3 * np.cos(2 * pace * k)])
        zoom = scale * np.diag([wide, tall])
        tunic = tools.Pose(tools.rotation(3 * sway) @ zoom, body)
        wave = lambda v: np.sign(v) * (np.abs(v) / 190) ** 1.3 * (billow * np.sin(v / 46 - 1.6 * pace * k) - 2 * stride)
        shoulder, hip, neck = (np.array(tunic.picture(u, v)) for u, v in ((38.0, 16.0), (0.0, 130.0), (0.0, -34.0)))
        arm = tools.Pose(tools.rotation(15 + 42 * np.sin(pace * k + phase + 0.8)) @ (scale * np.eye(2)), shoulder)
        hand = np.array(arm.picture(0.0, 112.0))
        upright = scale * np.eye(2)
        step = 22 * np.sin(pace * k + phase)
        legs = []
        for name, s in (("leg", 1), ("other leg", -1)):
            pose = tools.Pose(tools.rotation(s * step + s * 5) @ upright, hip + scale * np.array([-s * 20 * wide, 0]))
            legs.append(Fill(name, pose, lambda u, v: tools.capsule(u, v, 105, 20, 14), (74, 66, 82), False))
        return [Fill("cloak", tools.Pose(tools.rotation(5 * sway) @ zoom, body + scale * np.array([-16, -6]), wave),
                     lambda u, v: tools.rounded_trapezoid(u, v, 46, 104, 190, 10), paint[0],
                     folds=[(-48, -26, 30, 180), (6, 14, 50, 184), (52, 30, 70, 182)], shade=lambda u, v: u - 30), *legs,
                Fill("tunic", tunic, lambda u, v: tools.rounded_trapezoid(u, v, 44, 62, 140, 16), paint[1],
                     folds=[(-20, -9, 78, 136), (14, 10, 84, 138)], shade=lambda u, v: u - 18 - 8 * np.sin(v / 30)),
                Fill("head", tools.Pose(upright, neck), ellipse(32, 36), skin, False),
                Fill("sleeve", arm, lambda u, v: tools.capsule(u, v, 92, 23, 27), paint[2], folds=[(-6, 4, 60, 88)],
                     shade=lambda u, v: u - 7),
                Fill("hand", tools.Pose(upright, hand), ellipse(17, 17), skin, False)]
    return drawing


def creature(tools, rng, scale):
    """A round creature that hops and squashes, with a bent tail behind it and an ear before it."""
    pace, hop, phase = rng.uniform(0.5, 0.9), rng.uniform(20, 46), rng.uniform(0, 6)
    travel, long = rng.uniform(2, 7) * rng.choice([-1, 1]), rng.uniform(120, 160)
    paint = [colour(rng) for _ in range(4)]

    def drawing(k, centre):
        up = np.abs(np.sin(pace * k + phase))
        squash = np.diag([1.14 - 0.2 * up, 0.86 + 0.2 * up])
        body = centre + scale * np.array([travel * k, 44 - hop * up])
        trunk = tools.Pose(tools.rotation(8 * np.sin(pace * k)) @ squash * scale, body)
        rump, brow = np.array(trunk.picture(-80.0, 20.0)), np.array(trunk.picture(46.0, -78.0))
        lash = leaning(46 * np.sin(pace * k + phase + 1), long)
        ear = leaning(26 * np.sin(1.4 * pace * k), 90)
        return [Fill("tail", tools.Pose(tools.rotation(115) @ (scale * np.eye(2)), rump, lash),
                     lambda u, v: tools.capsule(u, v, long, 26, 12), paint[0], shade=lambda u, v: u - 8),
                Fill("trunk", trunk, ellipse(118, 96), paint[1], folds=[(-52, 16, -20, 50), (-30, 12, 0, 60)],
                     shade=lambda u, v: np.hypot(u - 24, v + 22) * -1 + 98),
                Fill("snout", tools.Pose(squash * scale, trunk.picture(92.0, 6.0)), ellipse(36, 28), paint[3], False),
                Fill("ear", tools.Pose(tools.rotation(-20 + 16 * np.sin(pace * k + 2)) @ (scale * np.eye(2)), brow, ear),
                     lambda u, v: tools.capsule(u, v, 84, 24, 34), paint[2], folds=[(-5, 6, 30, 84)],
                     shade=lambda u, v: u - 12)]
    return drawing


def banner(tools, rng, scale):
    """A long banner that flutters from a pole, and a shield that swings before it."""
    pace, phase, deep = rng.uniform(0.5, 0.9), rng.uniform(0, 6), rng.uniform(10, 22)
    swing, long = rng.uniform(14, 30), rng.uniform(230, 280)
    paint = [colour(rng) for _ in range(3)]
    side = rng.choice([-1, 1])

    def drawing(k, centre):
        wave = lambda v: deep * np.clip(v / 80, 0, 3) * np.sin(v / 44 - 1.3 * pace * k + phase)
        top = centre + scale * np.array([-130 * side, -20])
        cord = tools.Pose(tools.rotation(swing * np.sin(pace * k)) @ (scale * np.eye(2)),
                          centre + scale * np.array([70 * side, -140]))
        across = tools.rotation(-90 * side + 6 * np.sin(pace * k))
        return [Fill("pole", tools.Pose(scale * np.eye(2), top - scale * np.array([4 * side, 70])),
                     lambda u, v: tools.capsule(u, v, 330, 7, 8), (110, 84, 60), False),
                Fill("banner", tools.Pose(across * scale, top, wave),
                     lambda u, v: tools.rounded_trapezoid(u, v, 66, 58, long, 6), paint[0],
                     folds=[(-30, 10, 90, 210), (16, -8, 60, long - 30)], shade=lambda u, v: 26 - np.abs(v - 120 - 4 * k)),
                Fill("cord", cord, lambda u, v: tools.capsule(u, v, 90, 3, 3), (90, 70, 60), False),
                Fill("shield", tools.Pose(cord.matrix, cord.picture(0.0, 90.0)),
                     lambda u, v: tools.rounded_trapezoid(u, v, 62, 40, 130, 22), paint[1], folds=[(0, 0, 6, 124)],
                     shade=lambda u, v: u)]
    return drawing


def holds(rng, frames):
    """The number of the drawing on every frame."""
    kind = rng.integers(4)
    drawing_of = []
    while len(drawing_of) < frames:
        hold = int(rng.integers(1, 4)) if kind == 3 else int(kind) + 1
        drawing_of += [drawing_of[-1] + 1 if drawing_of else 0] * hold
    return drawing_of[:frames]


def draw(tools, fills, background, ink_of_background, k, texture):
    """Plate, ink, extents, holdouts and coverage. `texture`: None, or what fills in question look like at (u, v), unlit."""
    height, width = tools.X.shape
    picture, ink = background.copy(), ink_of_background.copy()
    extent, holdout, coverage = {}, {}, {}
    for number, fill in enumerate(fills):
        u, v = fill.pose.material(tools.X, tools.Y)
        # Coordinates may be stretched: divided by its slope a distance is in pixels again.
        d = fill.shape(u, v)
        slope = np.hypot(*np.gradient(d))
        d = d / np.maximum(slope, 1e-3)
        alpha = tools.coverage(d)
        for other in extent:
            holdout[other] = np.maximum(holdout[other], alpha)
            coverage[other] = coverage[other] * (1 - alpha)
        extent[fill.name], holdout[fill.name], coverage[fill.name] = alpha, np.zeros((height, width)), alpha
        ink = ink * (1 - alpha)
        if fill.surface and texture is not None:
            picture = picture + alpha[..., None] * (texture(u, v) - picture)
        else:
            picture = tools.over(picture, fill.colour, alpha)
            if fill.shade is not None:
                picture = tools.over(picture, 0.74 * fill.colour, alpha * tools.coverage(fill.shade(u, v)))
        for i, line in enumerate(fill.folds):
            ink = np.maximum(ink, alpha * tools.stroke(tools.fold(u, v, *line), k, 0.8, 10 * number + i))
        ink = np.maximum(ink, tools.stroke(d, k, 1.0, number))
    return tools.over(picture, tools.INK, ink), ink, extent, holdout, coverage


def landscape(tools, rng):
    """A flat sky, hills and ground, which stand still, and their ink."""
    height, width = tools.X.shape
    sky, hill, ground = (0.5 * colour(rng) + 110 for _ in range(3))
    ridge = tools.Y - height * (0.62 - 0.09 * np.sin(tools.X / width * rng.uniform(4, 9) + rng.uniform(0, 6)))
    picture = np.zeros((height, width, 3)) + sky
    picture = tools.over(picture, hill, tools.coverage(-ridge))
    level = height * 0.8 + 6 * np.sin(tools.X / 120)
    picture = tools.over(picture, ground, tools.coverage(level - tools.Y))
    return picture, np.clip(1.4 - np.abs(ridge), 0, 1) * (tools.Y < level)


def tile(rng):
    """A picture of TILE_PX that repeats: checks of unequal colours with a bar across."""
    y, x = np.mgrid[0:TILE_PX, 0:TILE_PX]
    colours = np.array([colour(rng) for _ in range(4)])
    picture = colours[(y // (TILE_PX // 2)) * 2 + x // (TILE_PX // 2)]
    picture[np.abs(x - y) < 4] = 255 - colours[0]
    return picture


def sampled(picture, u, v):
    """A picture repeated over (u, v), pixels of the fill's own, linearly between its texels."""
    u, v = u - 0.5, v - 0.5
    i, j = np.floor(u).astype(int), np.floor(v).astype(int)
    a, b = (u - i)[..., None], (v - j)[..., None]
    at = lambda di, dj: picture[(j + dj) % len(picture), (i + di) % picture.shape[1]].astype(float)
    return (1 - b) * ((1 - a) * at(0, 0) + a * at(1, 0)) + b * ((1 - a) * at(0, 1) + a * at(1, 1))


def flow(tools, now, then, extent):
    """Motion of a fill's points from one drawing to another; as KITTI has it."""
    u, v = now.pose.material(tools.X, tools.Y)
    x, y = then.pose.picture(u, v)
    known = extent > 0
    out = np.zeros(extent.shape + (3,), np.uint16)
    for channel, d in ((0, x - tools.X), (1, y - tools.Y)):
        out[..., channel] = np.where(known, np.round(d * 64) + 32768, 0).astype(np.uint16)
    out[..., 2] = known
    return out


def make(seed, folder, frames, size):
    """Writes the scene of `seed`: `frames` pictures of `size` and all that is known of them.

    Its tile.png covers its own size in pixels of a fill's coordinates."""
    folder, rng, tools = pathlib.Path(folder), np.random.default_rng(seed), toolbox(size)
    scale = size[1] / 360 * rng.uniform(1.1, 1.35)
    centre = np.array([size[0] * rng.uniform(0.46, 0.54), size[1] * 0.5])
    tools.INK = rng.uniform(15, 60, 3)
    tools.INK_WIDTH = rng.uniform(2.0, 3.2) * max(size[1] / 360, 0.6)
    drawing = (figure, creature, banner)[rng.integers(3)](tools, rng, scale)
    drawing_of = holds(rng, frames)
    background = landscape(tools, rng)
    picture_of_tile = tile(rng)
    tools.png(str(folder / "tile.png"), picture_of_tile)
    grey = 255 * (1.055 * GREY_LINEAR ** (1 / 2.4) - 0.055)
    looks = {"plate": None, "tiled": lambda u, v: sampled(picture_of_tile, u, v),
             "grey": lambda u, v: np.full(u.shape + (3,), grey)}
    fills = [drawing(k - drawing_of[-1] / 2, centre) for k in range(drawing_of[-1] + 1)]

    def codes(values):
        return np.floor(np.clip(values, 0, 255) + 0.5).astype(np.uint8)
    last = None
    for index, k in enumerate(drawing_of):
        number = "%04d.png" % (index + 1)
        if k != last:
            drawn = {name: draw(tools, fills[k], *background, k, look) for name, look in looks.items()}
            last = k
        _, ink, extent, holdout, coverage = drawn["plate"]
        for name in looks:
            tools.png(str(folder / name / number), codes(drawn[name][0]))
        tools.png(str(folder / "lines" / number), codes(255 * ink))
        for j, fill in enumerate(fills[k]):
            for kind, values in (("coverage", coverage), ("extent", extent), ("holdouts", holdout)):
                tools.png(str(folder / kind / fill.name / number), codes(255 * values[fill.name]))
            if index + 1 < frames:
                then = fills[drawing_of[index + 1]][j]
                tools.png(str(folder / "motion" / fill.name / number), flow(tools, fill, then, extent[fill.name]))
    parts = [{"name": f.name, "id": j + 1, "surface": f.surface} for j, f in enumerate(fills[0])]
    scene = {"family": "drawn", "seed": int(seed), "frames": frames, "size": list(size), "drawings": drawing_of,
             "tile_px": len(picture_of_tile), "parts": parts}
    (folder / "scene.json").write_text(json.dumps(scene, indent=1), encoding="utf-8")
