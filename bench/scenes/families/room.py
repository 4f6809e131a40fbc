"""A room under a moving camera: floor, back wall and table, each of another pattern."""
import lighting
import meshes
import paints
from mathutils import Matrix


def build(stage, rng):
    stage.add("floor", meshes.grid(9, 9, 12, 12), paints.tiles(rng), surface=True)
    wall = (paints.plaster, paints.bricks, paints.stripes)[rng.integers(3)](rng)
    stage.add("wall", meshes.upright(9, 3.4), wall, surface=True, pose=Matrix.Translation((0, 3.2, 0)))
    stage.add("side wall", meshes.upright(9, 3.4), paints.plaster(rng),
              pose=Matrix.Translation((-4.2, 0, 0)) @ Matrix.Rotation(1.5708, 4, "Z"))
    top, x = rng.uniform(0.7, 0.85), rng.uniform(-0.6, 0.9)
    table = meshes.joined([meshes.box(1.7, 1.0, 0.05).moved((0, 0, top))] +
                          [meshes.box(0.07, 0.07, top).moved((sx, sy, 0)) for sx in (-0.75, 0.75) for sy in (-0.42, 0.42)])
    stage.add("table", mesh=table, paint=paints.planks(rng), surface=True,
              pose=Matrix.Translation((x, 1.1, 0)) @ Matrix.Rotation(rng.uniform(-0.5, 0.5), 4, "Z"))
    radius = rng.uniform(0.14, 0.22)
    stage.add("vase", meshes.revolved([(0.001, 0.42), (0.07, 0.42), (0.05, 0.33), (radius, 0.16), (0.08, 0.001)]),
              paints.plain(paints.tone(rng)), pose=Matrix.Translation((x + 0.3, 1.1, top + 0.05)))
    if rng.integers(2):
        lighting.indoors(stage, rng, [((-2.2, -1.0, 2.9), (0, 1.5, 0.6)), ((2.6, 0.2, 2.6), (0, 2.2, 0.8))])
    else:
        lighting.outdoors(stage, rng)
    start, end = rng.uniform(-1.6, -0.4), rng.uniform(0.3, 1.5)
    stage.look(lambda f: ((start + (end - start) * (f - 1) / 23, -3.6, 1.65), (0.2, 1.6, 0.95)), rng.uniform(28, 38))
