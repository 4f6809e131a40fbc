"""A part of a drawn scene: a flat fill under lines, whose true motion is known by part, hidden places included."""
import numpy as np

import drift
import fields
import images
import mattes
from rendered import RenderedSurface

KNOWN = 0.5 / 65535


def kitti(path):
    """(motion in px, x right and y down; where it is known) of a KITTI 16-bit PNG."""
    picture = images.read(path)[1]
    return (picture[..., :2] * np.float32(65535) - 32768) / 64, picture[..., 2] > KNOWN


class DrawnSurface(RenderedSurface):
    """Has no form, light or tiled rendering to compare with; what passes in front of it is given as a holdout."""

    measures = {"deliver": (None,), "motion": ("draft", "final"), "matte": mattes.PAINTED}

    def __init__(self, scene, part, runs):
        super().__init__(scene, part, runs)
        self.matte_options = ("--matte", scene.pattern("extent", self.name, ending="png"))
        if scene.file(1, "holdouts", self.name, ending="png").is_file():
            self.matte_options += ("--holdout", scene.pattern("holdouts", self.name, ending="png"))
        self.true_motion = ("--motion", scene.pattern("motion", self.name, ending="png"))

    def deliver(self):
        self.deliver_with("--lines", self.scene.pattern("lines", ending="png"))

    def drift(self, st_of_frame):
        return drift.by_motion(self.scene.frames, self.truth.painted_frame, self.extent, self.visible, self.true_step,
                               st_of_frame)

    def extent(self, frame):
        return images.grey(self.scene.file(frame, "extent", self.name, ending="png")) >= 0.5

    def visible(self, frame):
        return self.truth.core(frame, 2)

    def true_step(self, frame):
        return kitti(self.scene.file(frame, "motion", self.name, ending="png"))

    def motion_to_previous(self, frame):
        """The motion of the frame before, carried to where it leads; between drawings it is smooth."""
        motion, known = self.true_step(frame - 1)
        y, x = np.nonzero(known & self.extent(frame - 1))
        there = np.rint(np.stack([x, y], -1) + motion[y, x]).astype(int)
        height, width = known.shape
        inside = (there >= 0).all(1) & (there[:, 0] < width) & (there[:, 1] < height)
        back, reached = np.zeros_like(motion), np.zeros_like(known)
        back[there[inside, 1], there[inside, 0]] = -motion[y, x][inside]
        reached[there[inside, 1], there[inside, 0]] = True
        return fields.extended(back, reached, 1)
