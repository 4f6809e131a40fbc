"""A figure painted as one region: all of its parts together, as an artist masks a person.

Its truth is that of the parts: coverage is their sum, and a point is the same on two frames only where the same part
shows it."""
from functools import lru_cache

import numpy as np

import images
import mattes
import points
from layout import FIGURE
from rendered import RenderedSurface
from truth import SurfaceTruth

APART_M = 4.0    # between the parts' own places, so that no point of one is taken for a point of another


def of_scene(scene):
    """[the figure as one more surface of the scene], or [] where it shows none."""
    return [{"name": FIGURE, "parts": scene.figure}] if scene.figure else []


class Joined:
    """Of one frame: truth.Data, with one id for all parts, and their own places kept apart."""

    def __init__(self, data, ids, joined_id):
        shown = np.isin(data.ids, ids)
        self.ids = np.where(shown, joined_id, data.ids)
        self.rest = data.rest.copy()
        for k, part in enumerate(ids):
            self.rest[data.ids == part] += np.float32((APART_M * k, 0, 0))
        self.to_previous = data.to_previous


class FigureTruth(SurfaceTruth):
    def __init__(self, scene, figure):
        self.ids = [p["id"] for p in figure["parts"]]
        self.data = lru_cache(32)(self._data)
        super().__init__(scene, {"name": figure["name"], "id": self.ids[0]})

    def _coverage(self, frame):
        return np.minimum(1, sum(images.grey(f) for f in self.scene.coverage_files(self.name, frame)))

    def _data(self, frame):
        return Joined(SurfaceTruth.data(self, frame), self.ids, self.id)


class FigureSurface(RenderedSurface):
    """Motion, points and mattes; light and form are measured on the parts."""

    measures = {"deliver": (None,), "motion": ("draft", "final"), "points": ("draft", "final", *points.BASELINES),
                "matte": mattes.PAINTED}

    def truth_of(self, scene, part):
        return FigureTruth(scene, part)

    def write_matte(self):
        pattern = self.runs.work / "coverage" / "####.png"
        for frame in self.scene.frames:
            images.write(str(pattern).replace("####", "%04d" % frame), self.truth.coverage(frame), "uint16")
        return str(pattern)
