"""Propagated mattes against the true coverage.

Regions are compared at one half: J, their intersection over union, and F, the harmonic mean of precision and recall of
their boundaries within 0.8 % of the picture's diagonal (Perazzi et al. 2016), as DAVIS evaluates. Leak and hole are what
lies further than FAR_PX from the truth, as shares of its area: a ragged edge is neither. Painted frames are left out
everywhere."""
import numpy as np

import fields

TOLERANCE_OF_DIAGONAL = 0.008
FAR_PX = 10            # at a width of 854: further outside than this is a leak, further inside a hole
LOOSE_PX = 2.0         # deviation of a loosely painted outline at that width, across and along; 5 at most
LOOSE_WAVE_PX = 24     # and the length over which it wanders
LEAST_AREA_PX = 50
SOFT = (0.02, 0.98)
FOLLOWED_PX = 6        # how far the surface's motion is continued beyond its edge
NAMES = ("iou", "iou_worst", "boundary_f", "boundary_f_worst", "leak", "leak_worst", "hole", "hole_worst",
         "edge_levels", "hard_edge_levels", "edge_change_levels", "worst_frame", "frames")
PAINTED = ("one", "loose", "three")  # one frame painted exactly, one as a hand does, three exactly
FRAME_NAMES = ("iou", "boundary_f", "leak", "hole")


def intersection_over_union(ours, true):
    union = (ours | true).sum()
    return float((ours & true).sum() / union) if union else 1.0


def boundary_f(ours, true):
    reach = np.ceil(TOLERANCE_OF_DIAGONAL * np.hypot(*true.shape))
    mine, right = fields.boundary(ours), fields.boundary(true)
    if not mine.any() and not right.any():
        return 1.0
    precision = (mine & fields.dilated(right, reach)).sum() / max(1, mine.sum())
    recall = (right & fields.dilated(mine, reach)).sum() / max(1, right.sum())
    return float(2 * precision * recall / (precision + recall)) if precision + recall else 0.0


def far_px(width):
    return FAR_PX * width / 854


def loosely_painted(coverage, seed):
    """The matte as a hand paints it along the true outline: displaced by a smooth random field, hard, 0 or 1."""
    height, width = coverage.shape
    unit = width / 854
    noise = np.random.Generator(np.random.PCG64(seed)).standard_normal((height, width, 2)).astype(np.float32)
    wander = fields.blurred(noise, LOOSE_WAVE_PX * unit)
    wander *= LOOSE_PX * unit / np.sqrt((wander ** 2).mean())
    wander = np.clip(wander, -5 * unit, 5 * unit)
    v, u = np.mgrid[0:height, 0:width]
    places = np.stack([np.clip(u + wander[..., 0], 0, width - 1), np.clip(v + wander[..., 1], 0, height - 1)], -1)
    cells = fields.Cells(places.reshape(-1, 2).astype(np.float64), coverage.shape)
    return cells.look_up(coverage).reshape(height, width) >= 0.5


class Comparison:
    """`greatest_px`: the surface's greatest area, which leaks are a share of on frames that hide it."""

    def __init__(self, greatest_px):
        self.greatest_px = greatest_px
        self.rows, self.soft, self.hard, self.changes = [], [], [], []

    def add(self, frame, matte, coverage):
        ours, true = matte >= 0.5, coverage >= 0.5
        area = true.sum()
        far = far_px(true.shape[1])
        leak = (ours & ~fields.dilated(true, far)).sum()
        if area >= LEAST_AREA_PX:
            hole = (true & ~fields.dilated(ours, far)).sum() / area
            self.rows.append((frame, intersection_over_union(ours, true), boundary_f(ours, true), leak / area, hole))
        else:
            self.rows.append((frame, None, None, leak / self.greatest_px, None))
        soft = soft_pixels(coverage)
        self.soft.append(255 * np.abs(matte - coverage)[soft])
        self.hard.append(255 * np.abs(true - coverage)[soft])

    def add_change(self, errors, coverage, previous_errors, to_previous, known):
        """How the soft edge's error changes along the motion `to_previous`, px, where it is `known`."""
        motion, reached = fields.extended(to_previous, known, FOLLOWED_PX)
        y, x = np.nonzero(soft_pixels(coverage) & reached)
        if len(x):
            cells = fields.Cells(np.stack([x, y], -1) + motion[y, x].astype(np.float64), coverage.shape)
            change = 255 * np.abs(errors[y, x] - cells.look_up(previous_errors))
            self.changes.append(change[cells.inside])

    def figures(self):
        if not any(row[1] is not None for row in self.rows):
            return dict.fromkeys(NAMES)
        iou, f, leak, hole = ([row[k] for row in self.rows if row[k] is not None] for k in (1, 2, 3, 4))
        worst = min((row for row in self.rows if row[1] is not None), key=lambda row: row[1])
        found = {"iou": np.mean(iou), "iou_worst": min(iou), "boundary_f": np.mean(f), "boundary_f_worst": min(f),
                 "leak": np.mean(leak), "leak_worst": max(leak), "hole": np.mean(hole), "hole_worst": max(hole),
                 "edge_levels": mean_of(self.soft), "hard_edge_levels": mean_of(self.hard),
                 "edge_change_levels": mean_of(self.changes)}
        return {**{k: rounded(v) for k, v in found.items()}, "worst_frame": worst[0], "frames": self.by_frame()}

    def by_frame(self):
        return [{"frame": row[0], **{k: rounded(v) for k, v in zip(FRAME_NAMES, row[1:])}} for row in self.rows]


def rounded(value):
    return None if value is None else round(float(value), 5)


def soft_pixels(coverage):
    return (coverage > SOFT[0]) & (coverage < SOFT[1])


def mean_of(parts):
    values = np.concatenate(parts) if parts else np.zeros(0)
    return float(values.mean()) if len(values) else None


def measure(frames, painted_frames, coverage_of_frame, matte_of_frame, motion_of_frame=None):
    """`motion_of_frame`: frame → (the surface's motion to the previous frame, px, where it is known), or None.

    `hard_edge_levels` is the soft edge's error of a perfect matte without soft edges."""
    comparison = Comparison(max((coverage_of_frame(f) >= 0.5).sum() for f in frames))
    previous = None
    for frame in frames:
        matte, coverage = matte_of_frame(frame), coverage_of_frame(frame)
        errors = matte - coverage
        if frame not in painted_frames:
            comparison.add(frame, matte, coverage)
        if previous is not None and motion_of_frame and not {frame, frame - 1} & set(painted_frames):
            comparison.add_change(errors, coverage, previous, *motion_of_frame(frame))
        previous = errors
    return comparison.figures()
