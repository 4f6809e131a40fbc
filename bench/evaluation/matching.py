"""Where a surface's points of one frame are on another, from the truth alone.

A Match holds for points seen on both frames: `here` (n, 2), pixels of the later frame; `there` (n, 2), sub-pixel places
on the base frame; `here_from_there` (n, 2, 2), the derivative of the true motion, px of here per px of there."""
from dataclasses import dataclass

import numpy as np

import fields

NEAREST_AMONG = 8000     # pixels of the base frame among which the first guess is sought
NEWTON_STEPS = 8
CLOSE_PX = 0.05           # a point is found where the surface's own place agrees to this, in steps of a pixel
STRETCH_LIMIT = 12        # pairs of views of which one is so much larger or more slanted say nothing in pixels


@dataclass
class Match:
    here: np.ndarray
    there: np.ndarray
    here_from_there: np.ndarray


def chosen(mask, count, rng):
    """Up to `count` random pixels (x, y) of `mask`."""
    y, x = np.nonzero(mask)
    pick = rng.permutation(len(x))[:count]
    return np.stack([x[pick], y[pick]], -1)


def by_place(here, rest_here, rest_there, smooth_there):
    """(Match, unseen): which of the pixels `here` (n, 2) the base frame shows too; `unseen` are those it does not show.

    `rest`: the surface's own place, metres, at the pixels' centres. `smooth_there`: where that can be interpolated."""
    if len(here) == 0 or smooth_there.sum() < 16:
        return Match(np.zeros((0, 2), int), np.zeros((0, 2)), np.zeros((0, 2, 2))), here
    goal = rest_here[here[:, 1], here[:, 0]].astype(np.float64)
    there, off = located(goal, rest_there, nearest(goal, rest_there, smooth_there).astype(np.float64))
    found = fields.Cells(there, rest_there.shape).all_in(smooth_there) & (off < CLOSE_PX)
    unseen, here, there = here[~found], here[found], there[found]
    metres_there = fields.Cells(there, rest_there.shape).look_up(fields.slopes(rest_there))
    metres_here = fields.slopes(rest_here)[here[:, 1], here[:, 0]].astype(np.float64)
    forward, backward = derivative(metres_there, metres_here), derivative(metres_here, metres_there)
    size = np.maximum(np.linalg.norm(forward, axis=(1, 2)), np.linalg.norm(backward, axis=(1, 2)))
    usable = size < STRETCH_LIMIT
    return Match(here[usable], there[usable], forward[usable]), unseen


def located(goal, rest, places):
    """Gauss-Newton from `places`: (where `rest` is `goal`, how far off that is, px, along and across the surface)."""
    for _ in range(NEWTON_STEPS):
        cells = fields.Cells(places, rest.shape)
        a, b, c, d = (v.astype(np.float64) for v in cells.corners(rest))
        fx, fy = cells.fx[:, None], cells.fy[:, None]
        gradient = np.stack([(b - a) * (1 - fy) + (d - c) * fy, (c - a) * (1 - fx) + (d - b) * fx], -1)
        residual = goal - cells.look_up(rest)
        step = solved(gradient, residual)
        length = np.linalg.norm(step, axis=1)
        places = places + step * np.minimum(1, 4 / np.maximum(length, 1e-12))[:, None]
    a_pixel = np.linalg.norm(gradient, axis=1).max(1)
    return places, np.maximum(length, np.linalg.norm(residual, axis=1) / np.maximum(a_pixel, 1e-12))


def nearest(goal, rest, mask):
    """For each goal (n, 3) the pixel (x, y) of `mask` whose rest is nearest, among an even choice of pixels."""
    y, x = np.nonzero(mask)
    every = max(1, int(np.ceil(len(x) / NEAREST_AMONG)))
    y, x = y[::every], x[::every]
    known = rest[y, x]
    middle = known.mean(0)
    known, goal = known - middle, (goal - middle).astype(np.float32)
    length = (known * known).sum(1)
    best = [np.argmin(length - 2 * (part @ known.T), axis=1) for part in np.array_split(goal, 1 + len(goal) // 500)]
    best = np.concatenate(best)
    return np.stack([x[best], y[best]], -1)


def solved(gradient, residual):
    """Least squares of gradient (n, k, 2) · step = residual (n, k)."""
    normal = np.einsum("nki,nkj->nij", gradient, gradient)
    normal += 1e-9 * np.trace(normal, axis1=1, axis2=2)[:, None, None] * np.eye(2) + 1e-30 * np.eye(2)
    return np.linalg.solve(normal, np.einsum("nki,nk->ni", gradient, residual)[..., None])[..., 0]


def derivative(metres_from, metres_to):
    """pinv(metres_to) · metres_from: pixels of `to` per pixel of `from`."""
    return np.stack([solved(metres_to, metres_from[..., k]) for k in (0, 1)], -1)


class Follower:
    """The points of `mask` on a base frame, followed by true motion; where that is unknown they are lost."""

    def __init__(self, mask):
        y, x = np.nonzero(mask)
        self.shape = mask.shape
        self.index = np.full(mask.shape, -1)
        self.index[y, x] = np.arange(len(x))
        self.there = np.stack([x, y], -1)
        self.place = self.there.astype(np.float64)
        self.alive = np.ones(len(x), bool)

    def step(self, motion, mask_now, mask_next):
        """`motion` (height, width, 2), px, from the frame where the points are to the next one, valid in `mask_now`."""
        cells = fields.Cells(self.place, self.shape)
        self.alive &= cells.all_in(mask_now)
        self.place = self.place + np.where(self.alive[:, None], cells.look_up(motion), 0)
        self.alive &= fields.Cells(self.place, self.shape).all_in(mask_next)

    def match(self, visible, count, rng):
        """A Match of up to `count` points that are `visible` now; `here` has fractions."""
        x, y = self.there[:, 0], self.there[:, 1]
        at = [self.index[np.clip(y + dy, 0, self.shape[0] - 1), np.clip(x + dx, 0, self.shape[1] - 1)]
              for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1))]
        whole = np.all([(k >= 0) & self.alive[k] for k in at], axis=0)
        whole &= self.alive & fields.Cells(self.place, self.shape).all_in(visible)
        pick = rng.permutation(np.nonzero(whole)[0])[:count]
        right, left, below, above = (self.place[k[pick]] for k in at)
        slope = np.stack([(right - left) / 2, (below - above) / 2], -1)
        return Match(self.place[pick], self.there[pick].astype(np.float64), slope)
