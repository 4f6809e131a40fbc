"""The runs of weft and the measures for one surface of a rendered scene."""
import shutil
from functools import cached_property, lru_cache, partial

import drift
import form
import images
import light
import mattes
import motion
import points
import textures
import tiled
from runs import frame_file
from truth import SurfaceTruth

TILE_PX = 96    # the side of the tile on the reference frame, as it is delivered
BASELINES = {"multiply": light.multiplied, "constant": light.constant}
UNTOUCHED = ("--light", "none", "--match-plate", "0", "--grain", "0", "--defocus", "0", "--shutter", "0")


class RenderedSurface:
    """Runs weft for one surface. Its matte is the true coverage: what hides the surface is cut out of it already.

    `delivered` comes first, so that its seconds are those of a whole run without a cache."""

    measures = {"deliver": (None,), "light": ("draft", "final", "multiply", "constant"), "motion": ("draft", "final"),
                "points": ("draft", "final", *points.BASELINES), "form": (None,), "tiled": (None,), "matte": mattes.PAINTED}

    def __init__(self, scene, part, runs):
        self.scene, self.runs, self.truth = scene, runs, self.truth_of(scene, part)
        self.name, self.last = part["name"], max(scene.frames)
        self.plate = scene.pattern("plate", ending="png")
        self.matte_options = ("--matte", self.write_matte())
        self.true_motion = ("--motion", scene.pattern("data"), "--motion-convention", "blender")
        self.texture = textures.followed(runs.work.parent.parent / "followed.png")
        self.tile = textures.tile_of(scene) or self.texture
        self.moving = True  # its true motion is known
        self.followed = {}

    def truth_of(self, scene, part):
        return SurfaceTruth(scene, part)

    def write_matte(self):
        """The pattern of the true matte's files."""
        return self.truth.coverage_pattern

    def render(self, name, *options, **how):
        return self.runs.render(name, self.plate, (*self.matte_options, *options), **how)

    def deliver(self):
        self.deliver_with()

    def deliver_with(self, *options):
        scale = TILE_PX / images.read(self.tile)[1].shape[1]
        self.render("delivered", "--plane", self.tile, "--scale", scale, *options)

    def light(self, candidate):
        if candidate in BASELINES:
            return light.measure(self.truth, "grey", partial(BASELINES[candidate], self.truth))
        grey = textures.grey(self.runs.work / "grey.png", self.scene.facts["grey"])
        laid = self.lay("light-" + candidate, "grey", "--plane", grey, "--quality", candidate)
        return light.measure(self.truth, "grey", laid)

    def lay(self, name, true_pictures, *options):
        """A candidate of light.py: weft's result and its layer patch, on the frames of the true pictures."""
        wanted = ",".join(map(str, self.truth.frames_of(true_pictures)))
        _, frames, layers = self.render(name, *options, "--grain", "0", "--frames", wanted, ending="exr", layers="patch")
        return lambda frame: (images.rgb(frame_file(frames, frame)), patch(frame_file(layers, frame)))

    def motion(self, quality):
        name = "followed-" + quality
        report, frames, layers = self.render(name, "--plane", self.texture, *UNTOUCHED, "--quality", quality,
                                             layers="st")
        reference = report["references"][0]["frame"]
        self.followed[quality] = reference, lru_cache(32)(partial(coordinates, layers))
        figures = {**self.drift(self.followed[quality][1]), "reference": reference}
        return figures if quality == "draft" else {**figures, **self.flicker(frames, reference)}

    def flicker(self, frames, reference):
        options = (*self.matte_options, "--plane", self.texture, *self.true_motion)
        return motion.measure(self.runs, self.plate, options, frames, reference, self.last)

    def points(self, candidate):
        if candidate in points.BASELINES:
            return points.baseline(self.truth, self.points_known, self.plate_file, candidate == "dis_direct")
        if candidate not in self.followed:
            return None
        return points.ours(self.truth, self.points_known, self.followed[candidate][1])

    def plate_file(self, frame):
        return self.scene.file(frame, "plate", ending="png")

    @cached_property
    def points_known(self):
        return points.truth_of(self.truth)

    @cached_property
    def matches(self):
        return drift.matched(self.truth)

    def drift(self, st_of_frame):
        return drift.of_surface(self.truth.painted_frame, self.matches, st_of_frame)

    def form(self):
        if "final" not in self.followed:
            return None
        reference, st_of_frame = self.followed["final"]
        return form.measure(self.truth, st_of_frame, reference)

    def tiled(self):
        coordinates_pattern = tiled.write_coordinates(self.truth, self.runs.work / "uv")
        if coordinates_pattern is None or self.tile == self.texture:
            return None
        laid = self.lay("tiled", "tiled", "--plane", self.tile, "--uv", coordinates_pattern)
        return light.measure(self.truth, "tiled", laid)

    def matte(self, how):
        """Painted on one frame exactly, on one loosely, or on three exactly, and propagated."""
        keys = three_of(self.truth) if how == "three" else [self.truth.painted_frame]
        pattern = self.propagated(how, keys)
        figures = mattes.measure(list(self.scene.frames), keys, self.truth.coverage,
                                 lambda f: images.grey(frame_file(pattern, f)),
                                 self.motion_to_previous if self.moving else None)
        chatter = self.chatter(pattern) if self.moving and how == "one" else None
        return {**figures, "chatter_px": chatter, "painted": keys}

    def propagated(self, how, keys):
        """The pattern of the mattes that weft makes of the painted frames `keys`."""
        painted = []
        for frame in keys:
            file = self.runs.work / ("painted-%s-%04d.png" % (how, frame))
            coverage = self.truth.coverage(frame)
            paint = mattes.loosely_painted(coverage, frame) if how == "loose" else coverage >= 0.5
            images.write(file, paint, "uint8")
            painted += ["--matte", "%d=%s" % (frame, file)]
        pattern = self.runs.work / ("matte" if how == "one" else "matte-" + how) / "####.png"
        self.runs("matte-" + how, "matte", "--plate", self.plate, *painted, "-o", pattern, "--overwrite",
                  "--progress", "none")
        return str(pattern)

    def motion_to_previous(self, frame):
        data = self.truth.data(frame)
        return data.to_previous, data.ids == self.truth.id

    def chatter(self, mattes_pattern):
        said = self.runs("chatter", "measure", "--result", self.plate, "--plate", self.plate, "--matte", mattes_pattern,
                         *self.true_motion)
        return (said["matte_chatter_px"] or {}).get("mean")

    def tidy(self):
        """Leaves the pictures that sheets show."""
        for name in ("cache", "uv", "coverage", "matte-loose", "matte-three", "light-draft", "light-draft-layers", "light-final-layers", "followed-draft",
                     "followed-draft-layers", "followed-final", "followed-final-layers", "tiled-layers"):
            shutil.rmtree(self.runs.work / name, ignore_errors=True)


def three_of(truth):
    """The painted frame, and of the first, the middle and the last frame those two that lie furthest from it."""
    frames = [f for f in truth.areas if truth.areas[f] >= mattes.LEAST_AREA_PX]
    candidates = sorted({frames[0], frames[len(frames) // 2], frames[-1]} - {truth.painted_frame},
                        key=lambda f: -abs(f - truth.painted_frame))
    return sorted([truth.painted_frame] + candidates[:2])


def patch(path):
    return images.channels(images.read(path), "patch.R", "patch.G", "patch.B")


def coordinates(pattern, frame):
    return drift.Coordinates(frame_file(pattern, frame), textures.SIDE)
