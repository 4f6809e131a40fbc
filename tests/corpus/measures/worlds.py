"""A small world whose truth is known by formula: a slanted plane that slides under a fixed camera."""
import sys
from pathlib import Path
from types import SimpleNamespace

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "bench" / "evaluation"))

import numpy as np  # noqa: E402

import fields  # noqa: E402

WIDTH, HEIGHT, FOCAL = 160, 90, 150.0
SLANT = 0.5         # metres of depth per metre down the picture
STEP_M = 0.02       # how far the plane slides by frame, to the right


def rays():
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH].astype(np.float64)
    return np.stack([(x + 0.5 - WIDTH / 2) / FOCAL, (HEIGHT / 2 - y - 0.5) / FOCAL, -np.ones_like(x)], -1)


class PlaneTruth:
    """Has the interface of truth.SurfaceTruth, as far as the measures use it."""

    def __init__(self, frames=4):
        self.scene = SimpleNamespace(frames=range(1, frames + 1), facts={"camera": {"world_from_camera": {
            str(f): np.eye(4).tolist() for f in range(1, frames + 1)}}})
        self.name, self.id, self.painted_frame = "plane", 1, 1

    def coverage(self, frame):
        share = np.zeros((HEIGHT, WIDTH), np.float32)
        share[10:80, 20:140] = 1
        return share

    def core(self, frame, margin_px):
        return fields.eroded(self.coverage(frame) > 0.999, margin_px)

    def smooth(self, frame):
        return self.core(frame, 2)

    def data(self, frame):
        ray = rays()
        depth = 2 / (1 + SLANT * ray[..., 1])
        position = (ray * depth[..., None]).astype(np.float32)
        rest = position - np.float32((STEP_M * frame, 0, 0))
        normal = np.broadcast_to(np.float32((0, SLANT, -1)) / np.hypot(1, SLANT), position.shape)
        return SimpleNamespace(position=position, rest=rest, normal=normal, ids=np.ones((HEIGHT, WIDTH), int))


def coordinates(texels, side=1024):
    return SimpleNamespace(texels=np.asarray(texels, np.float32), side=side, slopes=lambda: fields.slopes(texels, side))


def laid_without_stretch(truth, frame, texels_per_metre=100):
    """Coordinates along the plane, by its own axes."""
    rest = truth.data(frame).rest
    down = -rest[..., 1] * np.hypot(1, SLANT)
    return coordinates(np.stack([rest[..., 0], down], -1) * np.float32(texels_per_metre))
