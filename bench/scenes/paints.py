"""What the old surfaces are made of: colours by Blender's procedural textures, in metres, moving with the surface.

A paint is a function of a Shader that returns the colour's socket; its parameters are drawn when it is made, so
that one seed gives one scene. `gloss` is the roughness of a clear coat, or None for a purely diffuse surface."""
import colorsys
from dataclasses import dataclass
from typing import Callable, Optional


@dataclass
class Paint:
    colour: Callable
    gloss: Optional[float] = None


def tone(rng, value=(0.25, 0.6), saturation=(0.1, 0.5)):
    """A linear RGB colour of a random hue."""
    return colorsys.hsv_to_rgb(rng.uniform(0, 1), rng.uniform(*saturation), rng.uniform(*value))


def darker(colour, factor):
    return tuple(c * factor for c in colour)


def plain(colour, gloss=None):
    return Paint(lambda s: colour, gloss)


def plaster(rng, contrast=0.12):
    """Nearly plain: broad, faint variation."""
    colour, scale = tone(rng, (0.45, 0.65), (0.05, 0.35)), rng.uniform(2, 5)
    shift = tuple(rng.uniform(-9, 9, 3))

    def build(s):
        place = s.scaled(s.rest, 1.0, shift)
        broad = s.ramp(s.noise(place, scale, 4, 0.6), [(0.3, 1 - contrast), (0.7, 1.0)])
        fine = s.ramp(s.noise(place, 18 * scale, 2), [(0.3, 1 - contrast / 2), (0.7, 1.0)])
        return s.mix(1.0, s.mix(1.0, colour, broad, "MULTIPLY"), fine, "MULTIPLY")
    return Paint(build)


def bricks(rng, width=None, joint=0.012):
    width = width or rng.uniform(0.2, 0.34)
    colour = tone(rng, (0.25, 0.5), (0.3, 0.65))
    other, mortar = darker(colour, rng.uniform(0.5, 0.8)), tone(rng, (0.45, 0.6), (0, 0.12))

    def build(s):
        n = s.node("ShaderNodeTexBrick", {"Vector": s.uv, "Color1": colour, "Color2": other, "Mortar": mortar,
                                          "Scale": 1.0, "Mortar Size": joint, "Brick Width": width,
                                          "Row Height": width * 0.36})
        grain = s.ramp(s.noise(s.rest, 30, 3, 0.6), [(0.3, 0.75), (0.7, 1.05)])
        return s.mix(0.8, n.outputs["Color"], grain, "MULTIPLY")
    return Paint(build)


def tiles(rng, side=None):
    """Square pavers, each of its own tone, with dark joints."""
    side = side or rng.uniform(0.3, 0.7)
    colour = tone(rng, (0.3, 0.55), (0.05, 0.35))
    joint = darker(colour, 0.35)

    def build(s):
        place = s.scaled(s.uv, 1 / side)
        n = s.node("ShaderNodeTexBrick", {"Vector": place, "Color1": colour, "Color2": darker(colour, 0.6),
                                          "Mortar": joint, "Scale": 1.0, "Mortar Size": 0.02, "Brick Width": 1.0,
                                          "Row Height": 1.0}, offset=0.0)
        grain = s.ramp(s.noise(s.rest, 14, 4, 0.6), [(0.3, 0.7), (0.7, 1.05)])
        return s.mix(0.8, n.outputs["Color"], grain, "MULTIPLY")
    return Paint(build)


def planks(rng, width=None):
    width = width or rng.uniform(0.12, 0.22)
    light = colorsys.hsv_to_rgb(rng.uniform(0.05, 0.1), rng.uniform(0.4, 0.65), rng.uniform(0.35, 0.6))
    turn = rng.choice([0.0, 1.5708])

    def build(s):
        place = s.scaled(s.uv, 1.0, turn=turn)
        n = s.node("ShaderNodeTexBrick", {"Vector": place, "Color1": light, "Color2": darker(light, 0.6),
                                          "Mortar": darker(light, 0.2), "Scale": 1.0, "Mortar Size": 0.004,
                                          "Brick Width": 9 * width, "Row Height": width}, offset=0.37)
        grain = s.ramp(s.noise(s.scaled(place, (4, 70, 1)), 1.0, 4, 0.6), [(0.3, 0.6), (0.7, 1.05)])
        return s.mix(0.8, n.outputs["Color"], grain, "MULTIPLY")
    return Paint(build)


def stripes(rng, period=None, faint=1.0):
    """Bands of four colours; `faint` mixes them towards the first."""
    period = period or rng.uniform(0.1, 0.3)
    colours = [tone(rng, (0.2, 0.65), (0.2, 0.7)) for _ in range(4)]
    colours = [tuple(f * a + (1 - f) * b for a, b in zip(c, colours[0])) for c, f in zip(colours, [1] + [faint] * 3)]
    turn = rng.uniform(0, 3.14)

    def build(s):
        u = s.node("ShaderNodeSeparateXYZ", {"Vector": s.scaled(s.uv, 1 / period, turn=turn)}).outputs["X"]
        bands = s.ramp(s.math("FRACT", u), [(0.0, colours[0]), (0.4, colours[1]), (0.52, colours[2]), (0.8, colours[3])],
                       "CONSTANT")
        return s.mix(0.5, bands, s.ramp(s.noise(s.rest, 25, 3), [(0.3, 0.75), (0.7, 1.05)]), "MULTIPLY")
    return Paint(build)


def tartan(rng, period=None, faint=1.0):
    """Bands in both directions over a weave."""
    period = period or rng.uniform(0.12, 0.3)
    ground, first, second = (tone(rng, (0.15, 0.6), (0.3, 0.8)) for _ in range(3))

    def build(s):
        axes = s.node("ShaderNodeSeparateXYZ", {"Vector": s.scaled(s.uv, 1 / period)})

        def band(axis, colour, under):
            where = s.ramp(s.math("FRACT", axes.outputs[axis]), [(0, 0.0), (0.3, 0.55 * faint), (0.5, 0.0),
                                                                 (0.62, 0.75 * faint), (0.68, 0.0)], "CONSTANT")
            return s.mix(where, under, colour)
        pattern = band("Y", second, band("X", first, ground))
        weave = s.ramp(s.noise(s.scaled(s.uv, (160, 40, 1)), 1.0, 2), [(0.3, 0.8), (0.7, 1.05)])
        return s.mix(0.6, pattern, weave, "MULTIPLY")
    return Paint(build)


def print_(rng, size=None, faint=1.0):
    """Round motifs of several colours on a ground."""
    size = size or rng.uniform(0.06, 0.16)
    ground = tone(rng, (0.3, 0.65), (0.1, 0.5))
    shift = tuple(rng.uniform(-9, 9, 3))

    def build(s):
        place = s.scaled(s.uv, 1.0, shift)
        cell = {"Vector": place, "Scale": 1 / size, "Randomness": 0.6}
        n = s.node("ShaderNodeTexVoronoi", cell, voronoi_dimensions="2D")
        spot = s.ramp(n.outputs["Distance"], [(0, faint), (0.33, faint), (0.36, 0.0)])
        colour = s.mix(0.5, ground, n.outputs["Color"], "OVERLAY")
        return s.mix(0.4, s.mix(spot, ground, colour), s.ramp(s.noise(s.rest, 40, 2), [(0.3, 0.75), (0.7, 1.05)]),
                     "MULTIPLY")
    return Paint(build)


def faint_cloth(rng):
    """A woven cloth of one colour whose dye varies by a few per cent."""
    colour, shift = tone(rng, (0.4, 0.7), (0.05, 0.4)), tuple(rng.uniform(-9, 9, 3))

    def build(s):
        place = s.scaled(s.uv, 1.0, shift)
        dye = s.ramp(s.noise(place, 9, 4, 0.6), [(0.3, 0.9), (0.7, 1.0)])
        weave = s.ramp(s.noise(s.scaled(place, (220, 60, 1)), 1.0, 2), [(0.3, 0.92), (0.7, 1.0)])
        return s.mix(1.0, s.mix(1.0, colour, dye, "MULTIPLY"), weave, "MULTIPLY")
    return Paint(build)


def ground(rng):
    """Earth and pebbles."""
    colour, shift = tone(rng, (0.2, 0.4), (0.2, 0.45)), tuple(rng.uniform(-9, 9, 3))

    def build(s):
        place = s.scaled(s.rest, 1.0, shift)
        broad = s.ramp(s.noise(place, 1.3, 4, 0.6), [(0.3, 0.6), (0.7, 1.1)])
        fine = s.ramp(s.noise(place, 22, 4, 0.65), [(0.3, 0.5), (0.7, 1.2)])
        return s.mix(1.0, s.mix(1.0, colour, broad, "MULTIPLY"), fine, "MULTIPLY")
    return Paint(build)


def lacquer(rng, roughness=0.25):
    """Car paint: one colour under a clear coat."""
    return Paint(plain(tone(rng, (0.03, 0.35), (0.5, 0.9))).colour, roughness)


PATTERNED = (bricks, tiles, planks, stripes, tartan, print_)
FABRICS = (stripes, tartan, print_)


def patterned(rng, size, kinds=PATTERNED):
    """One of `kinds`, whose pattern repeats every `size` metres or so."""
    return kinds[rng.integers(len(kinds))](rng, size * rng.uniform(0.75, 1.25))
