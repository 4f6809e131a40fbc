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


def unrolled(points, closed):
    """As `arc_lengths`, of a sheet that tapers: laid flat as a cone is, nearly true to length in every row."""
    around = np.concatenate([points, points[:, :1]], axis=1) if closed else points
    along = np.linalg.norm(np.diff(around, axis=1), axis=2)
    along = np.concatenate([np.zeros((len(along), 1)), np.cumsum(along, axis=1)], axis=1)
    down = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(around, axis=0), axis=2).mean(axis=1))])
    sector, start = np.polyfit(down, along[:, -1], 1)  # the length of a row is sector · (its distance from the tip)
    if abs(sector) < 0.02:
        return arc_lengths(points, closed)
    radius = (down + start / sector)[:, None]
    angle = (along / along[:, -1:] - 0.5) * sector
    return np.stack([radius * np.sin(angle), radius * np.cos(angle) - radius[0]], -1)


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


def ball(radius, cells=20):
    """A ball of six sewn patches, so that the coordinates are nearly true to length everywhere."""
    angle = np.linspace(-np.pi / 4, np.pi / 4, cells + 1)
    x, z = np.meshgrid(np.tan(angle), -np.tan(angle))
    front = np.stack([x, -np.ones_like(x), z], -1)
    front *= radius / np.linalg.norm(front, axis=2, keepdims=True)
    uv = radius * np.stack(np.meshgrid(angle, angle), -1)
    quarter = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    sides = [np.linalg.matrix_power(quarter, k) for k in range(4)] + [UPRIGHT, UPRIGHT.T]
    return welded(joined([sheet(front @ turn.T, uv=uv + [2 * radius * k, 0]) for k, turn in enumerate(sides)]))


def welded(mesh):
    """With one vertex where several lie in one place, so that seams are shaded smoothly."""
    _, first, index = np.unique(np.round(mesh.vertices, 5), axis=0, return_index=True, return_inverse=True)
    return Mesh(mesh.vertices[first], index.reshape(-1)[mesh.triangles], mesh.uv)


def part_of(mesh, cells):
    """The cells of a sheet where `cells` (rows − 1, columns [− 1]) is true."""
    kept = np.tile(np.asarray(cells, bool).ravel(), 2)
    used, index = np.unique(mesh.triangles[kept], return_inverse=True)
    return Mesh(mesh.vertices[used], index.reshape(-1, 3), mesh.uv[kept])


def tube(centres, across, radii, around=28):
    """Points (k, around, 3) of a limb through `centres` (k, 3), which lie in a plane with the normal `across`.

    `radii`: (k,), or (k, 2) in the plane and across it. The seam lies on the side that `across` points away from."""
    radii = np.broadcast_to(np.asarray(radii, float).reshape(len(centres), -1), (len(centres), 2))
    along = np.gradient(centres, axis=0)
    inward = np.cross(across, along)
    inward /= np.linalg.norm(inward, axis=1, keepdims=True)
    angle = np.linspace(0, 2 * np.pi, around, endpoint=False)
    return (centres[:, None] - radii[:, None, :1] * np.sin(angle)[:, None] * inward[:, None]
            - radii[:, None, 1:] * np.cos(angle)[:, None] * np.asarray(across, float))


def bent(start, length, turn, bend, rows=32, joint=0.5, soft=0.16):
    """Centres (rows, 3) of a limb in the xz plane from `start`: hanging, turned towards +x by `turn` at its root and by
    `bend` more at `joint` (a share of its length), smoothly over `soft` of its length on either side. Radians."""
    place = np.linspace(0, 1, rows)
    t = np.clip((place - joint + soft) / (2 * soft), 0, 1)
    angle = turn + bend * t * t * (3 - 2 * t)
    step = length * np.stack([np.sin(angle), 0 * angle, -np.cos(angle)], -1)
    middle = (step[1:] + step[:-1]) / 2 / (rows - 1)
    return np.asarray(start, float) + np.concatenate([np.zeros((1, 3)), np.cumsum(middle, axis=0)])


def draped(width, height, depth, columns=72, rows=40, held="middle"):
    """Points of a cloth that hangs in the xz plane from z = 0, true to its lengths: `depth(u, v)` is how far each
    point stands out towards −y; u runs from 0 to `width` and v down to `height`. `held`: "left", or "middle"."""
    u, v = np.meshgrid(np.linspace(0, width, columns + 1), np.linspace(0, height, rows + 1))
    y = depth(u, v) + 0 * u

    def shortened(axis, step):
        slope = np.diff(y, axis=axis) / step
        return np.cumsum(step * np.sqrt(np.maximum(1 - slope ** 2, 0.04)), axis=axis)
    x = np.pad(shortened(1, width / columns), ((0, 0), (1, 0)))
    if held == "middle":
        x -= x[:, -1:] / 2
    z = -np.pad(shortened(0, height / rows), ((1, 0), (0, 0)))
    return np.stack([x, -y, z], -1)


def flat(width, height, columns=72, rows=40):
    """Texture coordinates of a draped cloth: where its points lie when it is spread out."""
    return np.stack(np.meshgrid(np.linspace(0, width, columns + 1), np.linspace(0, height, rows + 1)), -1)


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


def scattered(mesh, count, rng):
    """`count` places spread evenly over a mesh: roots, normals (n, 3) and texture coordinates (n, 2)."""
    corners = mesh.vertices[mesh.triangles]
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 1] - corners[:, 0])  # sheets are wound clockwise
    area = np.linalg.norm(normal, axis=1)
    which = rng.choice(len(area), count, p=area / area.sum())
    share = rng.dirichlet((1, 1, 1), count)[:, :, None]
    return ((share * corners[which]).sum(axis=1), normal[which] / area[which, None], (share * mesh.uv[which]).sum(axis=1))


def blades(roots, normals, length, width, rng, uv=None):
    """Pointed strands of two triangles that stand on `roots` (n, 3) along `normals`, leaning at random.

    `uv` (n, 2): the roots' texture coordinates, if the strands are to be dyed with a pattern as a whole."""
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
    place = across[np.concatenate([np.tile([0, 1, 2], (n, 1)), np.tile([0, 2, 3], (n, 1))])]
    return Mesh(vertices.reshape(-1, 3), triangles, place if uv is None else place + np.tile(uv, (2, 1))[:, None])
