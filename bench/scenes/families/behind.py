"""A patterned slab or cloth that a pillar hides completely for some frames in the middle of the shot.

Hard: nothing of the surface is left to follow, and what comes back must be known for the same. By seed the slab moves,
or the camera, or the pillar."""
import lighting
import meshes
import numpy as np
import paints
from mathutils import Matrix


def build(stage, rng):
    width, height, way = rng.uniform(0.75, 0.85), rng.uniform(1.3, 1.6), rng.choice([-1, 1])
    mode = ("surface", "camera", "pillar")[rng.integers(3)]
    deep, near = rng.uniform(3.8, 4.1), rng.uniform(1.9, 2.3)    # distances of the surface and the pillar
    shadow_m = width + 0.6                                       # what the pillar hides in the surface's depth
    path = lambda f: way * 1.05 * (2 * stage.at(f) - 1)          # of the surface past the pillar, in its own depth
    scale = near / deep
    paint = paints.patterned(rng, 0.2)
    sway, turn = rng.uniform(0, 0.035), rng.uniform(-0.2, 0.2)
    shift = path if mode == "surface" else lambda f: 0.0

    def place(f):
        return Matrix.Translation((shift(f), 0, 0.25)) @ Matrix.Rotation(turn + sway * 6 * np.sin(5 * f / 24), 4, "Z")
    if rng.integers(2):
        stage.add("slab", meshes.box(width, 0.08, height), paint, surface=True, pose=place)
    else:
        phase, folds = rng.uniform(0, 6), rng.uniform(14, 20)
        shape = lambda f: (meshes.draped(width * 1.08, height, lambda u, v: 0.035 * (0.4 + v / height) * np.sin(
            folds * u + phase + 1.5 * f / 24 - v), 60, 30) + [0, 0, height]).reshape(-1, 3)
        mesh = meshes.sheet(shape(0).reshape(31, 61, 3), uv=meshes.flat(width * 1.08, height, 60, 30))
        stage.add("cloth", mesh, paint, surface=True, pose=place, shape=shape)
    profile = [(shadow_m * scale / 2, 6), (shadow_m * scale / 2, -2)]
    pillar = meshes.revolved(profile) if rng.integers(2) else meshes.box(shadow_m * scale, 0.1, 8).moved((0, 0, -2))
    passing = lambda f: -path(f) * scale if mode == "pillar" else 0.0
    stage.add("pillar", pillar, (paints.plaster, paints.bricks, paints.planks)[rng.integers(3)](rng),
              pose=lambda f: Matrix.Translation((passing(f), near - deep, 0)))
    stage.add("wall", meshes.upright(14, 5), (paints.plaster, paints.bricks, paints.stripes)[rng.integers(3)](rng),
              surface=True, pose=Matrix.Translation((0, rng.uniform(0.7, 1.6), 0)))
    stage.add("floor", meshes.grid(14, 12), paints.tiles(rng), surface=True)
    lighting.outdoors(stage, rng, ("sun", "sky", "evening")[rng.integers(3)])
    drift = rng.uniform(0.03, 0.12) * way
    eye = lambda f: path(f) / (1 / scale - 1) if mode == "camera" else drift * f / 24
    stage.look(lambda f: ((eye(f), -deep, 1.3), (0.5 * eye(f), 0, 1.0)), 35)
