"""The truth of one surface of a rendered scene, by frame: coverage, and what stands at each pixel's centre."""
from functools import lru_cache

import numpy as np

import fields
import images

INSIDE = 0.999       # a pixel with more coverage shows nothing else
PAINTED_SHARE = 0.6  # of the greatest area: the first frame that shows as much is painted, and compared with


class Data:
    """Of one frame: ids; position, rest (metres, height × width × 3), normal, uv (metres), motion (px, y down)."""

    def __init__(self, path):
        picture = images.read(path)
        self.ids = np.rint(images.channels(picture, "IndexOB.X")).astype(np.int32)
        self.position = images.channels(picture, "Position.X", "Position.Y", "Position.Z")
        self.normal = images.channels(picture, "Normal.X", "Normal.Y", "Normal.Z")
        self.rest = images.channels(picture, "rest.R", "rest.G", "rest.B")
        self.uv = images.channels(picture, "UV.U", "UV.V")
        self.to_previous = images.channels(picture, "Vector.X", "Vector.Y") * np.float32((1, -1))


@lru_cache(32)
def data_of(path):
    """Kept for all frames of a shot, and for all surfaces of a scene."""
    return Data(path)


class SurfaceTruth:
    def __init__(self, scene, part):
        self.scene, self.name, self.id = scene, part["name"], part.get("id")
        self.coverage = lru_cache(64)(self._coverage)
        self.core = lru_cache(128)(self._core)
        self.smooth = lru_cache(64)(self._smooth)
        self.areas = {f: float(self.coverage(f).sum()) for f in scene.frames}
        enough = PAINTED_SHARE * max(self.areas.values())
        self.painted_frame = next(f for f in scene.frames if self.areas[f] >= enough)

    @property
    def coverage_pattern(self):
        return self.scene.pattern("coverage", self.name, ending="png")

    def frames_of(self, pictures):
        """The frames of which there are such pictures: grey and tiled are rendered for some only."""
        found = [f for f in self.scene.frames if self.scene.file(f, pictures).is_file()]
        if not found:
            raise OSError("%s has no frame of %s" % (self.scene.folder, pictures))
        return found

    def _coverage(self, frame):
        return images.grey(self.scene.file(frame, "coverage", self.name, ending="png"))

    def data(self, frame):
        return data_of(self.scene.file(frame, "data"))

    def other_surfaces(self, frame):
        """The share of each pixel that the scene's other surfaces in question cover."""
        others = [p["name"] for p in self.scene.surfaces if p["name"] != self.name]
        files = [self.scene.file(frame, "coverage", n, ending="png") for n in others]
        return sum((images.grey(f) for f in files), np.zeros_like(self.coverage(frame)))

    def _core(self, frame, margin_px):
        """Pixels that show the surface alone, at least so far from its edge."""
        return fields.eroded(self.coverage(frame) > INSIDE, margin_px)

    def _smooth(self, frame):
        """Core pixels whose neighbours continue the same piece of the surface: no fold or other sheet between."""
        data = self.data(frame)
        good = self.core(frame, 2) & (data.ids == self.id)
        rest = np.where(good[..., None], data.rest, np.nan)
        for axis in (0, 1):
            step = np.linalg.norm(np.diff(rest, axis=axis), axis=-1)
            longer, shorter = np.full(good.shape, np.inf, np.float32), np.zeros(good.shape, np.float32)
            middle = tuple(slice(1, -1) if a == axis else slice(None) for a in (0, 1))
            first = tuple(slice(None, -1) if a == axis else slice(None) for a in (0, 1))
            second = tuple(slice(1, None) if a == axis else slice(None) for a in (0, 1))
            longer[middle] = np.maximum(step[first], step[second])
            shorter[middle] = np.minimum(step[first], step[second])
            with np.errstate(invalid="ignore"):
                good &= longer <= 2 * shorter
        return good
