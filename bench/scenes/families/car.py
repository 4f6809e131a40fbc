"""A lacquered car that turns as in a roundabout, before parked cars, posts and a house front.

Hard: reflections slide over the body while its form turns away; shut-lines and wheel arches cut it; the windows are
another dark and glossy part; there is no pattern to hold on to."""
import lighting
import meshes
import numpy as np
import paints
from mathutils import Matrix

LENGTH, WHEEL, AXLES = 4.2, 0.31, (-1.28, 1.3)  # the front is at −x
SHUT = (-0.95, 0.12, 1.05)                     # where the doors end


def power(x, p):
    return np.sign(x) * np.abs(x) ** p


def lower_body(rows=40, stations=140):
    """Nested arches across the car, each cut off at the sill or the wheel arch; thin gaps at the shut-lines."""
    a = np.linspace(-np.pi / 2, np.pi / 2, stations)
    x = np.concatenate([LENGTH / 2 * power(np.sin(a), 0.8), [s + d for s in SHUT for d in (-0.006, 0.006)]])
    order = np.argsort(x)
    x = x[order]
    end = np.sqrt(np.maximum(1 - np.abs(2 * x / LENGTH) ** 5, 0)) ** 0.7  # 1 but for the rounded ends
    wide = 0.004 + 0.856 * end
    top = np.interp(x, [-2.1, -1.9, -1.0, -.7, 1.3, 1.9, 2.1], [.62, .72, .86, .92, .96, .92, .78]) - 0.12 * (1 - end)
    low = np.full_like(x, 0.2)
    for axle in AXLES:
        arch = WHEEL + np.sqrt(np.maximum((WHEEL + 0.06) ** 2 - (x - axle) ** 2, 0))
        low = np.where(np.abs(x - axle) < WHEEL + 0.06, arch, low)
    lines, across = [], []
    phi = np.linspace(0, np.pi / 2, 400)
    for w, t, b in zip(wide, top, low):
        y, z = w * np.cos(phi) ** 0.42, 0.2 + (t - 0.2) * np.sin(phi) ** 0.62
        y = y * (1 - 0.10 * ((0.55 - z) / 0.35) ** 2 * (z < 0.55))  # the flank draws in below
        keep = z >= b
        y, z = np.append(np.interp(b, z, y), y[keep]), np.append(b, z[keep])
        length = np.concatenate([[0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))])
        at = np.linspace(0, length[-1], rows)
        half = np.stack([np.interp(at, length, y), np.interp(at, length, z)], -1)
        lines.append(np.concatenate([half, (half * [-1, 1])[-2::-1]]))
        across.append(np.concatenate([at - length[-1], (length[-1] - at)[-2::-1]]))
    lines = np.array(lines)
    points = np.concatenate([np.broadcast_to(x[:, None, None], lines.shape[:2] + (1,)), lines], -1).transpose(1, 0, 2)
    u = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points[rows - 1], axis=0), axis=1))])  # along the middle
    uv = np.stack([np.broadcast_to(u, points.shape[:2]), np.array(across).T], -1)
    gap = np.isin(order[:-1], stations + 2 * np.arange(len(SHUT)))
    side = np.abs(points[:-1, :-1, 1]) > 0.45  # the doors' lines end on the shoulder
    return meshes.part_of(meshes.sheet(points, uv=uv), ~(gap[None] & side))


def cabin():
    """Rings from below the belt line to the middle of the roof: the painted part, and the windows, set in a little."""
    a = np.linspace(0, 2 * np.pi, 160, endpoint=False) + np.pi / 2
    belt, rail, roof = (np.array(r) for r in ((1.34, .76, .30, .88), (.92, .62, .28, 1.32), (.86, .58, .28, 1.36)))
    rings = [belt - [0, 0, 0, 0.1]] + [belt + (rail - belt) * t for t in np.linspace(0, 1, 13)]
    rings += [roof * [s, s, 1, 1] + [0, 0, 0, 0.08 * (1 - s ** 2)] for s in np.linspace(1, 0.01, 14)]
    plan = np.stack([power(np.cos(a), 0.62), power(np.sin(a), 0.62)], -1)
    outward = plan / np.linalg.norm(plan, axis=1, keepdims=True)

    def points(inset):
        return np.array([np.concatenate([(plan * [l, w] - inset * outward) + [c, 0], np.full((160, 1), h)], 1)
                         for l, w, c, h in rings])
    out = points(0)
    below = np.linalg.norm(np.diff(out, axis=0), axis=2).mean(axis=1)[::-1].cumsum()[::-1]
    below = np.maximum(np.append(below, 0) - below[14], 0)[:, None, None]
    uv = np.where(np.arange(len(rings))[:, None, None] < 14, out[14, :, :2] + outward * below, out[..., :2])
    uv = np.concatenate([uv, uv[:, :1]], 1) * [1, -1]
    level, turn = np.meshgrid(np.arange(len(rings) - 1), (np.degrees(a) + 1.1) % 360, indexing="ij")
    off = np.abs((turn + 90) % 180 - 90)  # 0 at the front and back, 90 at the sides
    glass = (level >= 2) & (level < 12) & ((off < 22) | (off > 32)) & (off < 86)
    windows = meshes.part_of(meshes.sheet(points(0.012), True, uv), level < 13)
    return meshes.part_of(meshes.sheet(out, True, uv), ~glass), windows


def wheel():
    profile = [(0.001, .1), (.16, .1), (.2, .085), (.21, .1), (WHEEL, .08), (WHEEL, -.08), (.2, -.1), (.001, -.1)]
    return meshes.revolved(profile, 48).turned([[1, 0, 0], [0, 0, -1], [0, 1, 0]])


def spokes(rng):
    """Light spokes in a dark tyre; `rest` is about the axle."""
    metal = paints.tone(rng, (0.4, 0.6), (0, 0.1))

    def build(s):
        x, _, z = (s.node("ShaderNodeSeparateXYZ", {"Vector": s.rest}).outputs[c] for c in "XYZ")
        radius = s.math("SQRT", s.math("ADD", s.math("MULTIPLY", x, x), s.math("MULTIPLY", z, z)))
        five = s.math("COSINE", s.math("MULTIPLY", s.math("ARCTAN2", z, x), 5.0))
        star = s.math("MULTIPLY", s.math("GREATER_THAN", five, -0.2), s.math("LESS_THAN", radius, 0.205))
        return s.mix(star, (0.015, 0.015, 0.017), metal)
    return paints.Paint(build)


def build(stage, rng):
    radius = rng.uniform(2.6, 4)
    yaw = rng.uniform(1.3, 2.0) / radius * rng.choice([-1, 1])
    heading = rng.uniform(-0.9, 0.9)
    middle = np.array([0, np.sign(yaw) * radius])  # the roundabout's middle

    def drive(f):
        a = yaw * (f / 24 - 0.5)
        x, y = radius * np.sign(yaw) * np.array([np.sin(a), -np.cos(a)]) + middle
        return Matrix.Rotation(heading, 4, "Z") @ Matrix.Translation((-x, -y, 0)) @ Matrix.Rotation(a, 4, "Z")
    painted, windows = cabin()
    lacquer = paints.lacquer(rng, rng.uniform(0.15, 0.4))
    body = meshes.joined([lower_body(), painted])
    stage.add("body", body, lacquer, surface=True, pose=drive)
    stage.add("windows", windows, paints.plain((0.02, 0.024, 0.026), 0.05), pose=drive)
    inside = meshes.joined([meshes.box(3.3, 1.4, 0.3).moved((0, 0, 0.3)), meshes.box(1.7, 1.5, 0.36).moved((0, 0, 0.25))])
    stage.add("inside", inside, paints.plain((0.008, 0.008, 0.008)), pose=drive)
    rim = spokes(rng)
    for k, (x, y) in enumerate((x, y) for x in AXLES for y in (-0.74, 0.74)):
        def roll(f, x=x, y=y):
            turn = -radius * abs(yaw) * (f / 24) / WHEEL
            return drive(f) @ Matrix.Translation((x, y, WHEEL)) @ Matrix.Rotation(turn, 4, "Y")
        stage.add("wheel %d" % (k + 1), wheel(), rim, pose=roll)
    stage.add("floor", meshes.grid(40, 40), (paints.ground, paints.tiles)[rng.integers(2)](rng))
    simple, wheels = meshes.joined([lower_body(12, 50), painted, windows]), meshes.joined(
        [wheel().moved((x, y, WHEEL)) for x in AXLES for y in (-0.74, 0.74)])
    places = [(np.array(Matrix.Rotation(rng.uniform(1.2, 1.9), 3, "Z")), (x + rng.uniform(-0.5, 0.5), 7, 0))
              for x in (-4.5, -1, 4)]
    stage.add("parked cars", meshes.joined([simple.turned(r).moved(at) for r, at in places]), paints.lacquer(rng))
    stage.add("their wheels", meshes.joined([wheels.turned(r).moved(at) for r, at in places]),
              paints.plain((0.02, 0.02, 0.02)))
    posts = [meshes.box(0.12, 0.12, 1.0).moved((x + rng.uniform(-.3, .3), 4.2, 0)) for x in (-5, -3, -1, 1, 3, 5)]
    poles = [meshes.box(0.25, 0.25, 4.5).moved((x, -7, 0)) for x in (-6, -2.5, 3, 7)]  # seen only as reflections
    stage.add("posts", meshes.joined(posts + poles), paints.plain(paints.tone(rng, (0.4, 0.7))))
    stage.add("house", meshes.upright(40, 7), paints.bricks(rng), pose=Matrix.Translation((0, 12, 0)))
    lighting.outdoors(stage, rng, ("sun", "evening", "sun", "sky")[rng.integers(4)])
    far, drift = rng.uniform(5.2, 5.7), rng.uniform(-0.8, 0.8)
    follow = rng.uniform(0.7, 0.95)

    def view(f):
        x, y, _ = drive(f).translation
        return (drift * f / 24, -far, 1.5), (follow * x, follow * y, 0.6)
    stage.look(view, rng.uniform(32, 38))
