"""The four kinds of light, drawn by the seed."""
import math

KINDS = ("sun", "sky", "evening", "lamp")


def outdoors(stage, rng, kind=None):
    """Sun, sky or evening. The sun stands behind the camera, to one side, and moves by a few degrees."""
    kind = kind or ("sun", "sky", "evening")[rng.integers(3)]
    height = {"sun": rng.uniform(35, 60), "sky": 60, "evening": rng.uniform(9, 16)}[kind]
    side, drift = rng.uniform(20, 65) * rng.choice([-1, 1]), rng.uniform(-6, 6)

    def towards(frame):
        a, h = math.radians(side + drift * (frame - 1) / 23), math.radians(height)
        return (math.sin(a) * math.cos(h), math.cos(a) * math.cos(h), -math.sin(h))
    if kind == "sun":
        stage.sun(towards, rng.uniform(2.6, 3.4))
        stage.sky((0.55, 0.7, 1.0), rng.uniform(0.35, 0.6))
    elif kind == "evening":
        stage.sun(towards, rng.uniform(3.0, 4.2), colour=(1, 0.6, 0.32))
        stage.sky((0.5, 0.55, 0.9), rng.uniform(0.35, 0.5))
    else:
        stage.sky((0.85, 0.93, 1.0), rng.uniform(1.0, 1.4))
    return kind


def indoors(stage, rng, lamps, power=1.0):
    """`lamps`: (place, aim)…; a faint even light besides, so that no shadow is black. `power`: less where they are near."""
    for k, (place, aim) in enumerate(lamps):
        colour = ((1, 0.8, 0.55), (0.7, 0.82, 1.0))[k % 2]
        stage.lamp(place, aim, power * rng.uniform(130, 240), rng.uniform(0.06, 0.3), colour)
    stage.sky((1, 0.9, 0.8), rng.uniform(0.06, 0.14))
