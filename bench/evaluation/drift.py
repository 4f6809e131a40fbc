"""How far Weft's texture has slid on the surface, from the coordinates it writes (the layer st) and the truth.

For a point of the surface that is seen on the base frame and on another, the coordinates should be the same. The
difference, by the base frame's own coordinates carried along by the true motion, is a distance on the other frame in
pixels: what the texture would have to be moved by. The measured frame's own gradient is not used, so that coordinates
that smear or stand still are errors and not small."""
import numpy as np

import fields
import images
import matching

POINTS = 2000
LEAST_POINTS = 50
LOST_PX = 1000.0       # stands for a texture that cannot be followed at all
NAMES = ("drift_median_px", "drift_last_median_px", "drift_last_p90_px", "drift_worst_median_px", "drift_worst_p90_px",
         "drift_worst_frame", "drift_fresh_median_px", "drift_fresh_p90_px")
DEGENERATE = 0.02      # texels per px of the base frame: a texture that is so smeared there cannot be followed


class Coordinates:
    """The layer st of one frame in texels, x right and y down; known up to whole planes of `side` texels."""

    def __init__(self, path, side):
        picture = images.read(path)
        self.side = side
        self.texels = images.channels(picture, "st.R", "st.G") * np.float32(side)
        self.texels[..., 1] *= -1

    def slopes(self):
        """Texels per px, (height, width, 2, 2)."""
        return fields.slopes(self.texels, self.side)


def errors(match, here, there):
    """Pixels of the measured frame by point; inf where the base frame's coordinates are degenerate.

    `here`, `there`: Coordinates of the measured and of the base frame."""
    if len(match.here) == 0:
        return np.zeros(0)
    base = fields.Cells(match.there, there.texels.shape)
    seen = fields.Cells(match.here.astype(np.float64), here.texels.shape)
    change = fields.wrapped(seen.look_up(here.texels, here.side) - base.look_up(there.texels, there.side), here.side)
    slope = base.look_up(there.slopes())
    slope = np.where(np.isfinite(slope), slope, 0)
    good = np.linalg.svd(slope, compute_uv=False)[:, 1] > DEGENERATE
    slope[~good] = np.eye(2)
    moved = np.linalg.solve(slope, change[..., None])
    moved = np.linalg.norm((match.here_from_there @ moved)[..., 0], axis=1)
    return np.where(good, moved, np.inf)


class Tally:
    """Errors by frame, told in a few numbers."""

    def __init__(self):
        self.frames, self.fresh = {}, []

    def add(self, frame, errors_px):
        if len(errors_px) >= LEAST_POINTS:
            self.frames[frame] = np.percentile(errors_px, (50, 90), method="lower")

    def figures(self):
        if not self.frames:
            return dict.fromkeys(NAMES)
        last, worst = max(self.frames), max(self.frames, key=lambda f: self.frames[f][0])
        fresh = np.concatenate(self.fresh) if self.fresh else np.zeros(0)
        new = np.percentile(fresh, (50, 90), method="lower") if len(fresh) >= LEAST_POINTS else (None, None)
        return {"drift_median_px": finite(np.median([m for m, _ in self.frames.values()])),
                "drift_last_median_px": finite(self.frames[last][0]), "drift_last_p90_px": finite(self.frames[last][1]),
                "drift_worst_median_px": finite(self.frames[worst][0]),
                "drift_worst_p90_px": finite(max(p for _, p in self.frames.values())), "drift_worst_frame": worst,
                "drift_fresh_median_px": finite(new[0]), "drift_fresh_p90_px": finite(new[1])}


def finite(value):
    """A number that JSON has."""
    return None if value is None else round(float(min(value, LOST_PX)), 4)


def matched(truth):
    """[(frame, base, Match)…] of a rendered scene, from the truth alone.

    The base is the painted frame. Points that it does not show are found on the middle, the last or the first frame, the
    first of these that shows them."""
    frames = list(truth.scene.frames)
    bases = list(dict.fromkeys([truth.painted_frame, frames[len(frames) // 2], frames[-1], frames[0]]))
    found = []
    for frame in (f for f in frames if f != bases[0]):
        wanted = matching.chosen(truth.smooth(frame), POINTS, np.random.default_rng(frame))
        for base in (b for b in bases if b != frame):
            match, wanted = matching.by_place(wanted, truth.data(frame).rest, truth.data(base).rest, truth.smooth(base))
            found.append((frame, base, match))
    return found


def of_surface(painted_frame, matches, st_of_frame):
    """`matches` as matched() returns them; `st_of_frame`: frame → Coordinates. Those of other bases are the fresh ones."""
    tally = Tally()
    for frame, base, match in matches:
        found = errors(match, st_of_frame(frame), st_of_frame(base))
        if base == painted_frame:
            tally.add(frame, found)
        else:
            tally.fresh.append(found)
    return tally.figures()


def by_motion(frames, base, extent_of_frame, visible_of_frame, motion_of_frame, st_of_frame):
    """Figures where only the true motion is known: points of `base` followed forwards on the surface's extent.

    `motion_of_frame`: frame → (motion to the next frame in px, where it is known). Points are counted where they are
    visible."""
    tally, follower, there = Tally(), matching.Follower(visible_of_frame(base)), st_of_frame(base)
    for frame in (f for f in frames if f > base):
        motion, known = motion_of_frame(frame - 1)
        follower.step(motion, known & extent_of_frame(frame - 1), extent_of_frame(frame))
        match = follower.match(visible_of_frame(frame), POINTS, np.random.default_rng(frame))
        tally.add(frame, errors(match, st_of_frame(frame), there))
    return tally.figures()
