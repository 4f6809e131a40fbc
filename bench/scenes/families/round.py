"""A column, cone, ball or vase on a paved floor, under a camera that walks slowly round it.

Hard: the surface turns away at the rims, where its pattern is foreshortened and new parts come into view; on some
seeds it turns by itself, so that the light stays while the pattern moves."""
import lighting
import meshes
import numpy as np
import paints
from mathutils import Matrix

KINDS = ("column", "cone", "ball", "vase")


def shape(kind, rng):
    """A mesh on the ground, and its height and radius."""
    if kind == "ball":
        radius = rng.uniform(0.55, 0.75)
        turn = np.array(Matrix.Rotation(rng.uniform(0, 3), 3, "X") @ Matrix.Rotation(rng.uniform(0, 3), 3, "Z"))
        return meshes.ball(radius, 26).turned(turn).moved((0, 0, radius)), 2 * radius, radius
    if kind == "vase":
        height, wide, narrow = rng.uniform(1.3, 1.6), rng.uniform(0.42, 0.52), rng.uniform(0.2, 0.3)
        t = np.linspace(0, 1, 60)
        radius = narrow + (wide - narrow) * np.sin(np.pi * np.clip(1.25 * t - 0.12, 0, 1)) ** 1.5
        return meshes.revolved(np.stack([radius, height * (1 - t)], -1), 96), height, wide
    top, bottom = {"column": (0.42, 0.48), "cone": (0.02, 0.75)}[kind]
    height = {"column": 3.2, "cone": rng.uniform(1.4, 1.8)}[kind]
    t, angle = np.meshgrid(np.linspace(0, 1, 40), np.linspace(0, 2 * np.pi, 96, endpoint=False) + np.pi / 2, indexing="ij")
    radius = (top + (bottom - top) * t) * rng.uniform(0.85, 1.1)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), height * (1 - t)], -1)
    return meshes.sheet(points, True, meshes.unrolled(points, True)), height, radius.max()


def build(stage, rng):
    start, rise = rng.uniform(-0.3, 0.3), rng.uniform(-0.25, 0.25)
    kind = KINDS[rng.integers(4)]
    mesh, height, radius = shape(kind, rng)
    paint = paints.patterned(rng, 0.22)
    spin = np.radians(rng.uniform(20, 50)) * rng.choice([-1, 0, 1])
    stage.add(kind, mesh, paint, surface=True, pose=lambda f: Matrix.Rotation(spin * f / 24, 4, "Z"))
    stage.add("floor", meshes.grid(14, 14), (paints.tiles, paints.planks, paints.ground)[rng.integers(3)](rng), surface=True)
    stage.add("wall", meshes.upright(16, 5), (paints.plaster, paints.bricks)[rng.integers(2)](rng),
              pose=Matrix.Translation((0, rng.uniform(2.5, 4), 0)) @ Matrix.Rotation(rng.uniform(-0.2, 0.2), 4, "Z"))
    posts = [meshes.box(0.2, 0.2, rng.uniform(0.6, 1.6)).moved((s * rng.uniform(1.1, 1.9), rng.uniform(0.2, 1.6), 0))
             for s in (-1, 1)]
    stage.add("posts", meshes.joined(posts), paints.plain(paints.tone(rng)))
    if rng.integers(3) == 0:
        lighting.indoors(stage, rng, [((-2.6, -2.0, 3.2), (0, 0, 0.7)), ((2.8, -1.2, 2.8), (0, 0, 0.8))])
    else:
        lighting.outdoors(stage, rng)
    middle = min(height, 2.0) / 2
    far = radius * rng.uniform(4.6, 5.6) if kind != "column" else rng.uniform(2.6, 3.2)
    orbit = np.radians(rng.uniform(10, 22)) * rng.choice([-1, 1])

    def view(f):
        a = start + orbit * (f / 24 - 0.5)
        return ((far * np.sin(a), -far * np.cos(a), middle + 0.55 + rise * f / 24), (0.12 * np.sin(1.5 * f / 24), 0, middle))
    stage.look(view, rng.uniform(32, 38))
