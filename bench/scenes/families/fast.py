"""A panel, box or ball that swings fast before a still wall, or a whip-pan past a poster; the shutter is open for half
a frame.

Hard: up to 40 pixels a frame, in smears half as long, with edges that are nowhere crisp."""
import lighting
import meshes
import numpy as np
import paints
from mathutils import Matrix

FOCAL_PX = 35 / 36 * 640


def build(stage, rng):
    stage.shutter_deg = 180
    far, phase = rng.uniform(3.0, 3.4), rng.uniform(0, 6.3)
    kind = ("panel", "box", "ball", "pan")[rng.integers(4)]
    speed = rng.uniform(24, 38) * far / FOCAL_PX      # metres a frame at the fastest
    reach = rng.uniform(0.55, 0.75)
    beat = speed / reach                              # radians a frame
    paint = paints.patterned(rng, 0.2)
    if kind == "panel":  # a sign on a long chain
        length = 2.6
        stage.add("panel", meshes.box(1.0, 0.06, 0.8).moved((0, 0, -length - 0.4)), paint, surface=True,
                  pose=lambda f: Matrix.Translation((0, 0, length + 0.95)) @ Matrix.Rotation(
                      -reach / length * np.sin(beat * f + phase), 4, "Y"))
    elif kind == "box":  # pushed to and fro, and turned
        stage.add("box", meshes.box(0.75, 0.75, 0.9), paint, surface=True,
                  pose=lambda f: Matrix.Translation((reach * np.sin(beat * f + phase), 0, 0))
                  @ Matrix.Rotation(0.5 + 0.4 * np.sin(0.7 * beat * f), 4, "Z"))
    elif kind == "ball":  # it bounces and rolls
        radius = rng.uniform(0.36, 0.44)
        stage.add("ball", meshes.ball(radius), paint, surface=True,
                  pose=lambda f: Matrix.Translation((reach * np.sin(beat * f + phase), 0,
                                                     radius + 0.7 * abs(np.sin(0.5 * beat * f))))
                  @ Matrix.Rotation(0.35 * np.sin(beat * f + phase) * reach / radius, 4, "Y"))
    else:
        stage.add("poster", meshes.upright(1.9, 1.3), paint, surface=True,
                  pose=Matrix.Translation((0, 0.6, 0.4)) @ Matrix.Rotation(rng.uniform(-0.25, 0.25), 4, "Z"))
        posts = [meshes.box(0.1, 0.1, 1.7).moved((x, 0.62, 0)) for x in (-1.4, 1.4)]
        stage.add("posts", meshes.joined(posts), paints.plain(paints.tone(rng)))
    stage.add("wall", meshes.upright(16, 5), (paints.plaster, paints.bricks, paints.planks)[rng.integers(3)](rng),
              surface=True, pose=Matrix.Translation((0, rng.uniform(1, 2), 0)))
    stage.add("floor", meshes.grid(16, 12), paints.tiles(rng), surface=True)
    lighting.outdoors(stage, rng)
    drift, way = rng.uniform(-0.3, 0.3), rng.choice([-1, 1])
    middle, sharp = rng.uniform(8, 15), rng.uniform(3.2, 4.2)  # of the pan, frames

    def view(f):
        turn = way * 0.2 * np.tanh((f - middle) / sharp) if kind == "pan" else 0.0
        eye = drift * f / 24
        return (eye, -far, 1.15), (eye + 3 * np.tan(turn), 3 - far, 0.8)
    stage.look(view, 35)
