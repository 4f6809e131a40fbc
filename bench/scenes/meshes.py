"""Meshes of the corpus: triangles with texture coordinates in metres. numpy only."""
from dataclasses import dataclass

import numpy as np


@dataclass
class Mesh:
    """`vertices` (n, 3) in metres; `triangles` (m, 3); `uv` (m, 3, 2), metres along the surface at each corner.

    Corners have coordinates of their own, so that a closed surface has a seam in `uv` and none in its shading."""
    vertices: np.ndarray
    triangles: np.ndarray
    uv: np.ndarray

    def moved(self, offset):
        return Mesh(self.vertices + np.asarray(offset, float), self.triangles, self.uv)

    def turned(self, matrix):
        """`matrix`: 3×3, applied to column vectors."""
        return Mesh(self.vertices @ np.asarray(matrix, float).T, self.triangles, self.uv)


def joined(meshes):
    offsets = np.cumsum([0] + [len(m.vertices) for m in meshes[:-1]])
    return Mesh(np.concatenate([m.vertices for m in meshes]),
                np.concatenate([m.triangles + o for m, o in zip(meshes, offsets)]),
                np.concatenate([m.uv for m in meshes]))


def arc_lengths(points, closed):
    """(rows, columns [+1 if closed], 2): mean lengths along rows and along columns, metres."""
    if closed:
        points = np.concatenate([points, points[:, :1]], axis=1)
    across = np.linalg.norm(np.diff(points, axis=1), axis=2).mean(axis=0)
    down = np.linalg.norm(np.diff(points, axis=0), axis=2).mean(axis=1)
    u = np.concatenate([[0], np.cumsum(across)])
    v = np.concatenate([[0], np.cumsum(down)])
    return np.stack(np.meshgrid(u, v), axis=-1)


def sheet(points, closed=False, uv=None):
    """A surface through a grid of `points` (rows, columns, 3); `closed` joins the last column to the first.

    `uv` (rows, columns [+1 if closed], 2) defaults to arc lengths."""
    rows, columns = points.shape[:2]
    uv = arc_lengths(points, closed) if uv is None else uv
    i, j = (a.ravel() for a in np.mgrid[0:rows - 1, 0:columns if closed else columns - 1])
    k = (j + 1) % columns
    corner = [(i, j, j), (i, k, j + 1), (i + 1, k, j + 1), (i + 1, j, j)]
    index = [r * columns + c for r, c, _ in corner]
    place = [uv[r, c] for r, _, c in corner]
    pick = ((0, 1, 2), (0, 2, 3))
    triangles = np.concatenate([np.stack([index[c] for c in t], -1) for t in pick])
    uvs = np.concatenate([np.stack([place[c] for c in t], 1) for t in pick])
    return Mesh(points.reshape(-1, 3).astype(float), triangles, uvs)


def grid(width, height, columns=1, rows=1):
    """A rectangle in the xy plane, centred; u to +x, v to −y (down, as a picture has it)."""
    x, y = np.meshgrid(np.linspace(-width / 2, width / 2, columns + 1), np.linspace(height / 2, -height / 2, rows + 1))
    return sheet(np.stack([x, y, np.zeros_like(x)], -1))


UPRIGHT = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])  # xy becomes xz, facing −y


def upright(width, height, columns=1, rows=1):
    """A rectangle in the xz plane that faces −y, its lower edge at z = 0."""
    return grid(width, height, columns, rows).turned(UPRIGHT).moved((0, 0, height / 2))


def revolved(profile, around=72):
    """A surface of revolution about z: `profile` (k, 2) of radius and height, from top to bottom."""
    profile = np.asarray(profile, float)
    angle = np.linspace(0, 2 * np.pi, around, endpoint=False) + np.pi / 2  # the seam lies at +y, away from the camera
    radius, height = profile[:, 0:1], profile[:, 1:2]
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.broadcast_to(height, (len(profile), around))], -1)
    return sheet(points, closed=True)


def ball(radius, rings=48, around=96):
    polar = np.linspace(1e-3, np.pi - 1e-3, rings + 1)
    return revolved(np.stack([radius * np.sin(polar), radius * np.cos(polar)], -1), around)


def capsule(length, top, bottom, rings=24, around=40):
    """A limb that hangs from the origin along −z, with round ends."""
    a = np.linspace(1e-3, np.pi / 2, 8)
    head = np.stack([top * np.sin(a), top * np.cos(a)], -1)
    foot = np.stack([bottom * np.cos(a - 1e-3), -length - bottom * np.sin(a - 1e-3)], -1)
    t = np.linspace(0, 1, rings)[1:-1]
    side = np.stack([top + (bottom - top) * t, -length * t], -1)
    return revolved(np.concatenate([head, side, foot]), around)


def box(x, y, z):
    """A box on the ground, centred in x and y; each side has coordinates of its own."""
    half = np.pi / 2

    def side(width, height, depth, turn):
        c, s = np.cos(turn), np.sin(turn)
        return upright(width, height).moved((0, -depth / 2, 0)).turned([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    return joined([side(x, z, y, 0), side(y, z, x, half), side(x, z, y, 2 * half), side(y, z, x, 3 * half),
                   grid(x, y).moved((0, 0, z)), grid(x, y).turned(np.diag([1, -1, -1]))])


def blades(roots, normals, length, width, rng):
    """Pointed strands of two triangles that stand on `roots` (n, 3) along `normals`, leaning at random."""
    n = len(roots)
    lean = rng.normal(0, 0.35, (n, 3)) + [0, 0, -0.35]
    direction = normals + lean
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    side = np.cross(direction, rng.normal(size=(n, 3)))
    side *= width / 2 / np.linalg.norm(side, axis=1, keepdims=True)
    tall = length * rng.uniform(0.6, 1.2, (n, 1))
    vertices = np.stack([roots - side, roots + side, roots + direction * tall * 0.6 + side * 0.7, roots + direction * tall], 1)
    first = 4 * np.arange(n)[:, None]
    triangles = np.concatenate([first + [0, 1, 2], first + [0, 2, 3]])
    across = np.array([[0, 0], [width, 0], [width, length * 0.6], [width / 2, length]])
    uv = across[np.concatenate([np.tile([0, 1, 2], (n, 1)), np.tile([0, 2, 3], (n, 1))])]
    return Mesh(vertices.reshape(-1, 3), triangles, uv)
