"""A walking figure in a coat with wide sleeves, which crosses the picture before a wall.

Hard: the sleeves swing before and behind the coat, hide it, and bend at the elbow; the coat sways; the figure's shadow
walks over the wall with it."""
import lighting
import meshes
import numpy as np
import paints
from mathutils import Matrix

HIP, SHOULDER = 0.92, 1.4


def build(stage, rng):
    rate = rng.uniform(0.75, 0.95)          # double steps a second
    way = int(rng.choice([-1, 1]))          # to the right or left
    phase = rng.uniform(0, 2 * np.pi)
    turned = way * rng.uniform(-0.5, 0.15)  # the path comes a little towards the camera or goes away
    heading = Matrix.Rotation(turned, 4, "Z") @ Matrix.Rotation(0 if way > 0 else np.pi, 4, "Z")

    def walk(f):
        """The hips' place; the figure walks to its own +x, and y is to its left."""
        s = f / 24
        bob = 0.025 * np.cos(4 * np.pi * rate * s + 2 * phase)
        return heading @ Matrix.Translation((1.25 * rate * (s - 0.5), 0, bob))

    def swing(f, lag):
        return np.sin(2 * np.pi * rate * f / 24 + phase + lag)

    def garment(paint, size):
        return paints.faint_cloth(rng) if paint == 0 else paints.patterned(rng, size, paints.FABRICS)
    choice = rng.integers(4)
    t, angle = np.meshgrid(np.linspace(0, 1, 44), np.linspace(0, 2 * np.pi, 60, endpoint=False) + np.pi / 2, indexing="ij")
    deep = np.interp(t, [0, .03, .1, .3, .5, 1], [.06, .09, .15, .19, .18, .25])
    wide = np.interp(t, [0, .03, .1, .3, .5, 1], [.06, .12, .2, .22, .2, .26])

    def coat(f):
        twist = 0.25 * swing(f, 0) * np.clip(1 - 2 * t, -1, 1)
        below = np.clip(2 * t - 1, 0, 1)
        x, y = deep * np.cos(angle), wide * np.sin(angle)
        fold = 1 + 0.1 * below * np.sin(9 * angle + 2 * np.sin(angle))
        x, y = x * fold * np.cos(twist) - y * np.sin(twist), x * np.sin(twist) + y * fold * np.cos(twist)
        kick = below ** 1.3 * (0.13 * np.sin(angle) * swing(f, -0.3) + 0.05 * swing(2 * f, 1))
        return np.stack([x + kick, y, 1.5 - 0.95 * t], -1)
    rest = coat(0)
    stage.add("coat", meshes.sheet(rest, True, meshes.unrolled(rest, True)), garment(choice, 0.14), surface=True,
              pose=walk, shape=lambda f: coat(f).reshape(-1, 3))

    radii = np.interp(np.linspace(0, 1, 44), [0, .03, .12, .5, 1], [.03, .08, .105, .095, .09])
    straight = meshes.tube(meshes.bent((0, 0, 0), 0.56, 0, 0, 44), (0, 1, 0), radii)
    uv, cloth = meshes.arc_lengths(straight, True), garment(choice, 0.12)
    near = -way  # which side faces the camera

    def arm(f, side):
        lag = 0 if side == near else np.pi
        return meshes.bent((0.03, 0.27 * side, SHOULDER), 0.56, 0.5 * swing(f, lag), 0.5 + 0.22 * swing(f, lag - 0.4), 44)
    for side, name in ((near, "near sleeve"), (-near, "far sleeve")):
        def sleeve(f, side=side):
            return meshes.tube(arm(f, side), (0, 1, 0), radii).reshape(-1, 3)
        stage.add(name, meshes.sheet(sleeve(0).reshape(44, 28, 3), True, uv), cloth,
                  surface=side == near, pose=walk, shape=sleeve)
    skin = paints.plain(((0.5, 0.33, 0.24), (0.25, 0.14, 0.08), (0.58, 0.42, 0.34))[rng.integers(3)])
    for side, name in ((near, "near hand"), (-near, "far hand")):
        stage.add(name, meshes.ball(0.06, 8), skin, pose=lambda f, side=side: walk(f) @ Matrix.Translation(arm(f, side)[-1]))
    trousers = paints.plain(paints.tone(rng, (0.06, 0.25)))
    thick = np.interp(np.linspace(0, 1, 40), [0, .05, .5, .97, 1], [.02, .09, .065, .05, .01])
    for side, name in ((near, "near leg"), (-near, "far leg")):
        def leg(f, side=side):
            lag = np.pi if side == near else 0
            knee = -0.75 * np.clip(swing(f, lag + 1.2), 0, 1) - 0.08
            line = meshes.bent((0, 0.1 * side, HIP), 0.84, 0.45 * swing(f, lag), knee, 40)
            return meshes.tube(line, (0, 1, 0), thick, 20).reshape(-1, 3)
        stage.add(name, meshes.sheet(leg(0).reshape(40, 20, 3), True), trousers, pose=walk, shape=leg)
    head = meshes.joined([meshes.ball(0.12, 10).moved((0.03, 0, 1.68)),
                          meshes.capsule(0.1, 0.055, 0.06).moved((0, 0, 1.58))])
    stage.add("head", head, skin, pose=walk)
    away = rng.uniform(0.8, 1.8)
    stage.add("wall", meshes.upright(12, 4), (paints.plaster, paints.bricks, paints.planks)[rng.integers(3)](rng),
              surface=True, pose=Matrix.Translation((0, away, 0)))
    stage.add("floor", meshes.grid(12, 9), paints.tiles(rng))
    lighting.outdoors(stage, rng)
    far, follow, aim = rng.uniform(1.75, 2.05), rng.uniform(0.35, 0.85), rng.uniform(0.98, 1.1)
    side = rng.uniform(-0.5, 0.5)

    def view(f):
        x = follow * walk(f).translation.x
        return (side + x, -far, 1.3), (x, 0, aim)
    stage.look(view, 35)
