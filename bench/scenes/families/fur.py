"""A furred ball or body that rolls, nods or is blown upon, before a patterned wall.

Hard: thousands of strands two to four pixels wide, with no outline of their own, through which the skin and the
background show; every strand casts a shadow on its neighbours."""
import lighting
import meshes
import numpy as np
import paints
from mathutils import Matrix


def build(stage, rng):
    far, high = rng.uniform(1.9, 2.3), rng.uniform(0.9, 1.2)
    kind = ("ball", "body")[rng.integers(2)]
    pace, phase = rng.uniform(2, 4), rng.uniform(0, 6)
    if kind == "ball":
        size = rng.uniform(0.42, 0.5)
        skin = meshes.ball(size, 14)
        travel = rng.uniform(0.3, 0.6) * rng.choice([-1, 1])

        def pose(f):
            s = travel * (f / 24 - 0.5)
            return Matrix.Translation((s, 0, size + 0.04)) @ Matrix.Rotation(s / size, 4, "Y")
    else:  # a sitting creature: a pear with a head
        profile = np.array([(.001, 1.08), (.10, 1.06), (.19, .98), (.22, .88), (.19, .77), (.2, .68), (.29, .52), (.36, .36),
                            (.37, .2), (.3, .05), (.2, .0)])
        t = np.linspace(0, 1, 40)
        at = np.linspace(0, 1, len(profile))
        smooth = np.stack([np.interp(t, at, c) for c in profile.T], -1)
        smooth[1:-1] = (smooth[:-2] + 2 * smooth[1:-1] + smooth[2:]) / 4
        skin = meshes.revolved(smooth, 64)

        def pose(f):
            a = 0.10 * np.sin(pace * f / 24 + phase)
            return Matrix.Rotation(a, 4, "Y") @ Matrix.Rotation(4 * a, 4, "Z")
    count, long, wide = int(rng.uniform(3000, 4000)), rng.uniform(0.08, 0.14), rng.uniform(0.010, 0.014)
    roots, normals, uv = meshes.scattered(skin, count, rng)
    fur = meshes.blades(roots, normals, long, wide, rng, uv)
    coat = paints.plain(paints.tone(rng, (0.25, 0.6), (0.1, 0.5))) if rng.integers(3) == 0 else paints.patterned(
        rng, 0.25, (paints.stripes, paints.print_, paints.tartan))
    stage.add("skin", skin, coat, surface=True, pose=pose)
    wind = rng.uniform(0.15, 0.35) * long * rng.integers(2)
    if wind:
        bend = np.tile([[0.0], [0.0], [0.4], [1.0]], (count, 1))
        place = np.repeat(roots, 4, axis=0)

        def blown(f):
            gust = np.sin(9 * place[:, :1] + 4 * place[:, 2:] - 6 * f / 24 + phase)
            return fur.vertices + wind * bend * gust * [1, 0.3, 0.2]
        stage.add("fur", fur, coat, surface=True, pose=pose, shape=blown)
    else:
        stage.add("fur", fur, coat, surface=True, pose=pose)
    stage.add("wall", meshes.upright(10, 4), paints.patterned(rng, 0.25), surface=True,
              pose=Matrix.Translation((0, rng.uniform(0.9, 1.5), 0)))
    stage.add("floor", meshes.grid(10, 8), (paints.planks, paints.ground)[rng.integers(2)](rng))
    if rng.integers(3) == 0:
        lighting.indoors(stage, rng, [((-2.2, -2.2, 2.6), (0, 0, 0.5)), ((2.4, -2.0, 2.0), (0, 0, 0.5))])
    else:
        lighting.outdoors(stage, rng)
    start, drift = rng.uniform(-0.5, 0.5), rng.uniform(0.15, 0.5) * rng.choice([-1, 1])
    stage.look(lambda f: ((start + drift * f / 24, -far, high), (0.15 * drift * f / 24, 0, 0.52)), 35)
