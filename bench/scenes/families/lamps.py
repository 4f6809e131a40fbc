"""A still life indoors under two small lamps, a warm and a cool one: a box, a ball and a cloth on a table.

Hard: every surface has two crossing shadows with hard edges and colours of their own, and those of the thing that moves
travel over surfaces that stand still."""
import lighting
import meshes
import numpy as np
import paints
from mathutils import Matrix


def build(stage, rng):
    x, y = rng.uniform(-0.12, 0.12), rng.uniform(-0.05, 0.1)
    mover = ("ball", "box", "ring")[rng.integers(3)]
    top = (paints.planks, paints.plaster, paints.tiles)[rng.integers(3)]
    stage.add("table", meshes.grid(3.2, 1.9, 16, 10), top(rng, 0.12), surface=True)
    side = np.radians(rng.uniform(15, 60))
    box = meshes.box(*rng.uniform(0.28, 0.4, 3))
    pace, phase = rng.uniform(1.0, 1.8), rng.uniform(0, 6)
    stage.add("box", box, paints.patterned(rng, 0.1), surface=True,
              pose=lambda f: Matrix.Translation((-0.45 + x, 0.1 - y, 0)) @ Matrix.Rotation(
                  side + (0.5 * f / 24 if mover == "box" else 0), 4, "Z"))
    radius = rng.uniform(0.15, 0.2)

    def roll(f):
        s = (0.3 * np.sin(pace * f / 24 + phase)) if mover == "ball" else 0.0
        return Matrix.Translation((0.1 + x + s, -0.32 + y, radius)) @ Matrix.Rotation(s / radius, 4, "Y")
    stage.add("ball", meshes.ball(radius), paints.patterned(rng, 0.09, paints.FABRICS), pose=roll)
    folds, shift, deep = 2 * np.pi / rng.uniform(0.2, 0.32), rng.uniform(0, 6), rng.uniform(0.03, 0.045)
    points = meshes.draped(0.85, 0.6, lambda u, v: deep * np.sin(folds * u + shift + np.sin(5 * u)) * (0.3 + v), 72, 40)
    cloth = paints.faint_cloth(rng) if rng.integers(3) == 0 else paints.patterned(rng, 0.1, paints.FABRICS)
    stage.add("cloth", meshes.sheet(points, uv=meshes.flat(0.85, 0.6)), cloth, surface=True,
              pose=Matrix.Translation((0.5 + x, 0.3, 0.62)) @ Matrix.Rotation(rng.uniform(-0.5, 0.1), 4, "Z"))
    rail = meshes.joined([meshes.box(0.86, 0.02, 0.02)] +
                         [meshes.box(0.03, 0.03, 0.64).moved((s, 0, -0.62)) for s in (-0.42, 0.42)])
    stage.add("rail", rail, paints.plain(paints.tone(rng, (0.1, 0.3))), pose=Matrix.Translation((0.5 + x, 0.32, 0.62)))
    if mover == "ring":  # a ring on a string, whose shadows swing
        a = np.linspace(0, 2 * np.pi, 48)
        ring = meshes.tube(0.11 * np.stack([np.sin(a), 0 * a, np.cos(a)], -1), (0, 1, 0), np.full(48, 0.022), 14)
        string = meshes.box(0.01, 0.01, 1.0).moved((0, 0, 0.12))
        stage.add("ring", meshes.joined([meshes.sheet(ring, True), string]), paints.plain(paints.tone(rng)),
                  pose=lambda f: Matrix.Translation((-0.05 + x + 0.35 * np.sin(pace * f / 24 + phase), -0.15, 0.42)))
    stage.add("wall", meshes.upright(5, 3), (paints.plaster, paints.bricks, paints.stripes)[rng.integers(3)](rng),
              surface=True, pose=Matrix.Translation((0, 0.95, 0)))
    lighting.indoors(stage, rng, [((-1.9 + x, -1.9, 1.9), (0, 0.2, 0.2)), ((2.0 + x, -1.6, 1.5 + y), (0, 0.2, 0.2))], 0.5)
    start, drift = rng.uniform(-0.3, 0.3), rng.uniform(0.1, 0.3) * rng.choice([-1, 1])
    stage.look(lambda f: ((start + drift * f / 24, -1.65, 0.85), (0.05 * drift * f / 24, 0.1, 0.27)), rng.uniform(34, 38))
