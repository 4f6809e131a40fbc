"""A wall, a paved floor and a cloth or striped ball in the dappled shade of a tree that stands outside the picture.

Hard: small bright and dark patches, soft at their edges, lie over every surface; on some seeds they sway while the
surface stands still, and may be taken for its pattern."""
import meshes
import numpy as np
import paints
from mathutils import Matrix, Vector


def canopy(rng, light, count):
    """Leaves as pairs of triangles around the light's path to the scene; also the directions in which they flutter."""
    across = np.array(light.to_track_quat("Z", "Y").to_matrix())
    size = rng.uniform(0.14, 0.34, (count, 1))
    middle = np.concatenate([rng.uniform(-3.4, 3.4, (count, 2)), rng.uniform(-0.7, 0.7, (count, 1))], 1)
    middle[:, :2] += 0.25 * np.sin(3.1 * middle[:, 1::-1] + 1)  # in clumps, with gaps
    long, wide = rng.normal(size=(2, count, 3)) * [1, 1, 0.5]
    long /= np.linalg.norm(long, axis=1, keepdims=True)
    wide -= (wide * long).sum(axis=1, keepdims=True) * long
    wide *= 0.28 / np.linalg.norm(wide, axis=1, keepdims=True)
    corners = np.stack([-0.5 * long, wide, 0.5 * long, -wide], 1) * size[:, None] + middle[:, None]
    flutter = np.cross(long, wide)[:, None] * [[[0.4], [1], [0.4], [-1]]]
    first = 4 * np.arange(count)[:, None]
    triangles = np.concatenate([first + [0, 1, 2], first + [0, 2, 3]])
    vertices = (corners @ across.T).reshape(-1, 3) - 6.0 * np.array(light) + [0, 0.6, 0.9]
    return (meshes.Mesh(vertices, triangles, np.zeros((len(triangles), 3, 2))), (flutter @ across.T).reshape(-1, 3),
            np.repeat(middle, 4, axis=0))


def build(stage, rng):
    side, height = np.radians(rng.uniform(15, 50)) * rng.choice([-1, 1]), np.radians(rng.uniform(38, 55))
    light = Vector((np.sin(side) * np.cos(height), np.cos(side) * np.cos(height), -np.sin(height)))
    stage.sun(light, rng.uniform(3.2, 4.2))
    stage.sky((0.55, 0.7, 1.0), rng.uniform(0.35, 0.5))
    mesh, flutter, place = canopy(rng, light, int(rng.uniform(1400, 2600)))
    if rng.integers(2):
        wind, pace = rng.uniform(0.04, 0.12), rng.uniform(2, 5)

        def sway(f):
            s = pace * f / 24
            branch = np.stack([np.sin(s + 0.9 * place[:, 0]), np.sin(0.7 * s + place[:, 1]),
                               0.3 * np.sin(s + place[:, 1])], -1)
            return mesh.vertices + wind * branch + 0.5 * wind * flutter * np.sin(3 * s + 9 * place[:, :1])
        stage.add("leaves", mesh, paints.plain((0.1, 0.2, 0.05)), hidden=True, shape=sway)
    else:
        stage.add("leaves", mesh, paints.plain((0.1, 0.2, 0.05)), hidden=True)
    wall = (paints.plaster, paints.plaster, paints.bricks, paints.planks)[rng.integers(4)](rng)
    stage.add("wall", meshes.upright(12, 4), wall, surface=True, pose=Matrix.Translation((0, 1.6, 0)))
    stage.add("floor", meshes.grid(12, 10), paints.tiles(rng), surface=True)
    x = rng.uniform(-0.7, 0.7)
    if rng.integers(2):
        radius = rng.uniform(0.4, 0.5)
        roll = rng.uniform(-0.6, 0.6) * rng.integers(2)
        turn = np.array(Matrix.Rotation(rng.uniform(0, 3), 3, "X"))
        stage.add("ball", meshes.ball(radius).turned(turn), paints.stripes(rng), surface=True,
                  pose=lambda f: Matrix.Translation((x + roll * (f / 24 - 0.5), 0.2, radius))
                  @ Matrix.Rotation(roll * f / 24 / radius, 4, "Y"))
    else:
        folds, phase, deep = 2 * np.pi / rng.uniform(0.35, 0.55), rng.uniform(0, 6), rng.uniform(0.04, 0.06)
        points = meshes.draped(1.5, 1.1, lambda u, v: deep * (0.4 + v / 1.1) * np.sin(
            folds * u + phase + 0.7 * np.sin(3 * u)))
        cloth = paints.faint_cloth(rng) if rng.integers(2) else paints.patterned(rng, 0.16, paints.FABRICS)
        stage.add("cloth", meshes.sheet(points, uv=meshes.flat(1.5, 1.1)), cloth, surface=True,
                  pose=Matrix.Translation((x, 0.5, 1.3)) @ Matrix.Rotation(rng.uniform(-0.3, 0.3), 4, "Z"))
        bar = meshes.joined([meshes.box(1.5, 0.04, 0.04).moved((0, 0, 0))] +
                            [meshes.box(0.05, 0.05, 1.34).moved((s, 0, -1.3)) for s in (-0.76, 0.76)])
        stage.add("rack", bar, paints.plain(paints.tone(rng, (0.1, 0.3))), pose=Matrix.Translation((x, 0.53, 1.3)))
    start, drift, far = rng.uniform(-0.8, 0.8), rng.uniform(0.4, 1.1) * rng.choice([-1, 1]), rng.uniform(2.6, 3.2)
    stage.look(lambda f: ((start + drift * f / 24, -far, 1.5), (0.3 * start, 0.6, 0.65)), rng.uniform(30, 36))
