"""A clothed upper body: a torso that twists and leans, a skirt with folds that swings, and a sleeve that bends.

Hard: cloth that follows the body bends, folds and shades itself; the arm passes before the torso and leaves its
shadow there; the elbow stretches one side of the sleeve and crowds the other."""
import lighting
import meshes
import numpy as np
import paints
from mathutils import Matrix

WAIST = 1.0
# Height, half width and half depth of the torso, from the neck down.
TORSO = np.array([(1.52, .055, .055), (1.50, .075, .07), (1.475, .14, .085), (1.44, .185, .095), (1.36, .20, .11),
                  (1.25, .185, .115), (1.12, .15, .10), (1.04, .145, .10), (.97, .165, .11), (.9, .18, .115)])


def build(stage, rng):
    faint = paints.faint_cloth if rng.integers(3) == 0 else lambda r: paints.patterned(r, 0.1, paints.FABRICS)
    speed, twist, lean = rng.uniform(2.5, 4.5), rng.uniform(0.25, 0.5), rng.uniform(0.03, 0.08)
    phase = rng.uniform(0, 6)

    def moved(points, f):
        """The body's motion: nothing at the waist, a twist and a lean that grow upwards."""
        high = np.maximum(points[..., 2:] - WAIST, 0) / 0.5
        a = twist * high * np.sin(speed * f / 24 + phase)
        x, y, z = np.split(points, 3, axis=-1)
        side = lean * high ** 2 * np.sin(0.8 * speed * f / 24 + phase + 1)
        return np.concatenate([x * np.cos(a) - y * np.sin(a) + side, x * np.sin(a) + y * np.cos(a), z], -1)

    rows = np.linspace(0, 1, 44)
    z, wide, deep = (np.interp(rows, np.linspace(0, 1, len(TORSO)), c) for c in TORSO.T)
    angle = np.linspace(0, 2 * np.pi, 56, endpoint=False) + np.pi / 2
    chest = np.stack([wide[:, None] * np.cos(angle), deep[:, None] * np.sin(angle), z[:, None] + 0 * angle], -1)
    stage.add("torso", meshes.sheet(chest, True), faint(rng), surface=True, shape=lambda f: moved(chest, f).reshape(-1, 3))

    folds, depth, hem, long = rng.integers(8, 13), rng.uniform(0.16, 0.26), rng.uniform(0.32, 0.42), rng.uniform(0.55, 0.75)
    swing, sway = rng.uniform(0.06, 0.12), rng.uniform(3, 5)
    t, around = np.meshgrid(np.linspace(0, 1, 30), np.linspace(0, 2 * np.pi, 100, endpoint=False) + np.pi / 2, indexing="ij")

    def skirt(f):
        second = f / 24
        fold = 1 + depth * t ** 0.6 * np.cos(folds * around + 0.8 * np.sin(2 * around) + 0.5 * t * np.sin(sway * second))
        radius = (0.15 + (hem - 0.15) * np.sin(1.2 * t) / np.sin(1.2)) * fold
        x = radius * np.cos(around) + swing * t ** 1.5 * np.sin(sway * second + phase - 1.2 * t)
        y = 0.8 * radius * np.sin(around) + 0.6 * swing * t ** 1.5 * np.sin(0.8 * sway * second - 1.2 * t)
        return np.stack([x, y, WAIST + 0.02 - long * t], -1)
    rest = skirt(0)
    stage.add("skirt", meshes.sheet(rest, True, meshes.unrolled(rest, True)), faint(rng), surface=True,
              shape=lambda f: skirt(f).reshape(-1, 3))

    raised, bend = rng.uniform(0.1, 0.5), rng.uniform(0.5, 1.1)
    sleeve_m, radii = 0.52, np.interp(np.linspace(0, 1, 44), [0, .03, .12, .5, 1], [.02, .07, .098, .082, .066])

    def arm(f, side, rows):
        """Centres of an arm in the world and the direction across it; its plane lies aslant before the body."""
        s = 0.5 + 0.5 * np.sin(speed * f / 24 + phase + (0 if side > 0 else 2))
        line = meshes.bent((0, 0, 0), sleeve_m, raised * s, (bend + 0.9 * s), rows)
        heading = np.radians(-90 + (-40 if side > 0 else 40))  # forwards and outwards, or inwards
        heading -= np.radians(12) * side * s
        turn = np.array(Matrix.Rotation(heading, 3, "Z"))
        shoulder = moved(np.array([[0.2 * side, 0, 1.41]]), f)
        return line @ turn.T + shoulder, turn @ [0, 1, 0]

    def sleeve(f, side):
        return meshes.tube(*arm(f, side, 44), radii).reshape(-1, 3)
    straight = meshes.tube(meshes.bent((0, 0, 0), sleeve_m, 0, 0, 44), (0, 1, 0), radii)
    uv = meshes.arc_lengths(straight, True)
    cloth = faint(rng)
    for side, name in ((-1, "sleeve"), (1, "other sleeve")):
        stage.add(name, meshes.sheet(sleeve(0, side).reshape(44, 28, 3), True, uv), cloth, surface=side < 0,
                  shape=lambda f, side=side: sleeve(f, side))

    def hand(side):
        return lambda f: Matrix.Translation(arm(f, side, 44)[0][-1])
    skin = paints.plain(((0.55, 0.36, 0.26), (0.3, 0.17, 0.1), (0.62, 0.45, 0.36))[rng.integers(3)])
    for side, name in ((-1, "hand"), (1, "other hand")):
        stage.add(name, meshes.ball(0.055, 8), skin, pose=hand(side))
    stage.add("neck", meshes.capsule(0.3, 0.05, 0.05).moved((0, 0, 1.72)), skin,
              pose=lambda f: Matrix.Translation(moved(np.array([[0, 0, 1.5]]), f)[0] - [0, 0, 1.5]))
    stage.add("wall", meshes.upright(9, 4), (paints.plaster, paints.bricks, paints.planks)[rng.integers(3)](rng),
              pose=Matrix.Translation((0, rng.uniform(0.9, 1.8), 0)))
    stage.add("floor", meshes.grid(9, 9), paints.ground(rng))
    if rng.integers(3) == 0:
        lighting.indoors(stage, rng, [((-2.6, -2.8, 3.2), (0, 0, 1.1)), ((3.0, -2.6, 2.4), (0, 0, 1.1))])
    else:
        lighting.outdoors(stage, rng)
    far, aim = ((1.3, 1.18), (1.65, 1.04))[rng.integers(2)]
    side, drift = rng.uniform(-0.5, 0.5), rng.uniform(0.15, 0.5) * rng.choice([-1, 1])
    stage.look(lambda f: ((side + drift * f / 24, -far, aim + 0.2), (0.1 * drift * f / 24, 0, aim)), 35)
