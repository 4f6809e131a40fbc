"""Where a scene's files lie, and what each is the value of. Frames are numbered from 0001.

    scene.json            family, seed, frames, camera by frame, parts (name, id, surface), rays to check against
    clean/####.exr        the picture, linear RGB, half: sun and lamps by sample, sky light by pixel
    plate/####.png        the same as a camera gives it: sRGB, 8 bit, with grain; what is rendered and measured
    plate.mp4             the plate as H.264, 4:2:0
    grey/####.exr         clean, with the surfaces in question in plain grey (scene.json: grey); on frames 1, 2, 5, 6, 9, …
    tiled/####.exr        clean, with them in the scene's tile.png, repeated every tile_m metres; on the same frames
    light/####.exr        diffuse light: albedo × light + gloss is the picture of a diffuse surface
    albedo/####.exr       diffuse colour, the pixel's mean
    gloss/####.exr        what a glossy surface reflects, and the background
    coverage/PART/####.png  16 bit: the share of the picture's own samples that hit the part, motion blur included
    visible/####.png      1 forward + 2 backward: the pixel's surface point is seen on the next, previous frame; 0 no surface
    data/####.exr         float, at the pixel's centre: Position (world, m), Normal, Depth (z, m), Vector (px, Blender's
                          convention: XY to the previous frame, ZW to the next, y up, negated), UV (m), IndexOB, rest (m)
    verified.json         what was checked, and how far it was off

A drawn scene (family drawn) has plate, grey and tiled as png, lines, coverage, extent/PART, holdouts/PART and
motion/PART (KITTI, to the next frame) instead of what only a rendering has."""
import json
import os
from pathlib import Path


def corpus_folder():
    """Outside of the repository: $WEFT_CORPUS, else a folder of the user's cache."""
    cache = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    return Path(os.environ.get("WEFT_CORPUS") or os.path.join(cache, "weft-corpus"))


FIGURE = "figure"  # the surface that is all parts of a body together (figure.py); these parts, by family:
FIGURES = {"body": ("torso", "skirt", "sleeve", "other sleeve"), "walker": ("coat", "near sleeve", "far sleeve")}


class Scene:
    def __init__(self, folder):
        self.folder = Path(folder)
        with open(self.folder / "scene.json", encoding="utf-8") as f:
            self.facts = json.load(f)

    @property
    def name(self):
        return "%s-%d" % (self.facts["family"], self.facts["seed"])

    @property
    def frames(self):
        return range(1, self.facts["frames"] + 1)

    @property
    def truth_frames(self):
        """The frames of grey and tiled: pairs, so that change over time shows."""
        return self.facts.get("truth_frames", list(self.frames))

    @property
    def drawn(self):
        return self.facts["family"] == "drawn"

    @property
    def parts(self):
        """Those that can be seen: dicts of name, id, surface."""
        return [p for p in self.facts["parts"] if not p.get("hidden")]

    @property
    def surfaces(self):
        return [p for p in self.parts if p["surface"]]

    @property
    def figure(self):
        """The parts that are one body, which an artist would mask together; none where the scene shows no body."""
        return [p for p in self.parts if p["name"] in FIGURES.get(self.facts["family"], ())]

    def coverage_files(self, surface, frame):
        """The files whose sum is the coverage of the surface of that name."""
        names = [p["name"] for p in self.figure] if surface == FIGURE else [surface]
        return [self.file(frame, "coverage", n, ending="png") for n in names]

    def pattern(self, *names, ending="exr"):
        """The files of a sequence, as weft's options take it."""
        return str(self.folder.joinpath(*names) / ("####." + ending))

    def file(self, frame, *names, ending="exr"):
        return self.folder.joinpath(*names) / ("%04d.%s" % (frame, ending))
