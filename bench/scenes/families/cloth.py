"""A hanging cloth, a curtain with folds, or a flag, which waves before a wall.

Hard: folds hide parts of the cloth and show them again, shade themselves and travel over the pattern; a faint
cloth has almost nothing to hold on to."""
import lighting
import meshes
import numpy as np
import paints
from mathutils import Matrix

KINDS = ("hanging", "curtain", "flag")


def waves(rng, lengths, heights, speed, along):
    """Travelling waves in random phase, mostly along u (`along` 1) or v (0), as a function of u, v and seconds."""
    parts = []
    for length, height in zip(lengths, heights):
        turn = (1 - along) * np.pi / 2 + rng.uniform(-0.35, 0.35)
        k = 2 * np.pi / (length * rng.uniform(0.85, 1.2))
        parts.append((height * rng.uniform(0.8, 1.2), k * np.cos(turn), k * np.sin(turn), k * speed, rng.uniform(0, 6.3)))
    return lambda u, v, s: sum(a * np.sin(ku * u + kv * v - w * s + phase) for a, ku, kv, w, phase in parts)


def build(stage, rng):
    far, side = rng.uniform(2.7, 3.2), rng.uniform(-1.2, 1.2)
    kind = KINDS[rng.integers(3)]
    faint = rng.integers(3) == 0
    paint = paints.faint_cloth(rng) if faint else paints.patterned(rng, 0.2, paints.FABRICS)
    width, height = {"hanging": (1.7, 1.5), "curtain": (2.3, 1.7), "flag": (1.9, 1.15)}[kind]
    top = {"hanging": 1.75, "curtain": 1.8, "flag": 1.75}[kind]
    speed, seconds = rng.uniform(0.7, 1.3), lambda f: f / 24
    if kind == "hanging":
        field = waves(rng, (1.1, 0.7, 0.35), (0.10, 0.04, 0.008), speed, 0.2)
        depth = lambda f: lambda u, v: field(u, v, seconds(f)) * (v / height) ** 0.7
    elif kind == "curtain":
        pleats = 2 * np.pi / rng.uniform(0.28, 0.4)
        phase, deep = rng.uniform(0, 6), rng.uniform(0.03, 0.045)
        field = waves(rng, (1.2, 0.5), (0.11, 0.012), speed, 0.6)
        depth = lambda f: lambda u, v: (deep * np.sin(pleats * u + phase + 0.6 * np.sin(2.3 * u) + 0.5 * v)
                                        + field(u, v, seconds(f)) * (v / height))
    else:
        field = waves(rng, (0.95, 0.6, 0.3), (0.10, 0.04, 0.006), 1.6 * speed, 1)
        depth = lambda f: lambda u, v: field(u, v, seconds(f)) * np.minimum(u / 0.5, 1)
    held = "left" if kind == "flag" else "middle"
    place = np.array([-0.85 if held == "left" else 0, 0, top])

    def shape(f):
        points = meshes.draped(width, height, depth(f), held=held)
        if held == "left":  # it also droops
            points[..., 2] -= 0.12 * (points[..., 0] / width) ** 1.5
        return (points + place).reshape(-1, 3)
    mesh = meshes.sheet(shape(0).reshape(41, 73, 3), uv=meshes.flat(width, height))
    stage.add(kind, mesh, paint, surface=True, shape=shape)

    rod = meshes.capsule(2.2, 0.02, 0.02).turned([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]).moved((1.1, 0, top + 0.02))
    pole = meshes.capsule(2.6, 0.03, 0.03).moved((-0.88, 0, 2.05))
    stage.add("rod", pole if held == "left" else rod, paints.plain(paints.tone(rng, (0.1, 0.3))))
    away = rng.uniform(0.5, 1.6)
    stage.add("wall", meshes.upright(12, 5), (paints.plaster, paints.bricks, paints.planks)[rng.integers(3)](rng),
              surface=True, pose=Matrix.Translation((0, away, -0.4)))
    stage.add("floor", meshes.grid(12, 9), paints.tiles(rng), pose=Matrix.Translation((0, 0, -0.4)))
    if kind != "flag" and rng.integers(3) == 0:
        lighting.indoors(stage, rng, [((-2.6, -2.4, 2.6), (0, 0, 1.0)), ((2.6, -1.8, 2.2), (0, 0, 0.9))])
    else:
        lighting.outdoors(stage, rng)
    drift = rng.uniform(0.3, 0.9) * rng.choice([-1, 1])
    stage.look(lambda f: ((side + drift * f / 24, -far, 1.2), (0.25 * drift * (f / 24 - 0.5), 0, 1.05)), 35)
