"""Points on a surface, followed through the shot, as trackers are measured (TAP-Vid, Doersch et al. 2022, section 3).

Queries lie on an even grid on the painted frame ("query first"). Each frame says where a point is and whether it is
seen; places are compared at a size of 256 × 256. Ours are read from the layer st: the pixel that shows the query's
coordinates. The baselines are OpenCV's DIS (preset medium), from frame to frame and chained, or straight from the
painted frame; all take the same true mattes for what is seen."""
import numpy as np

import fields
import images
import matching

try:
    import cv2
except ImportError:  # python3-opencv: only the baselines need it
    cv2 = None

QUERIES = 400
THRESHOLDS = (1, 2, 4, 8, 16)
SIDE = 256
SAME_PX = 1.5    # a point is where the coordinates agree to this
NEAR_PX = 2.0    # truth: a place so near to what is seen may be at its edge, and says nothing
NAMES = ("average_jaccard", "delta_average", "occlusion_accuracy", "jaccard", "delta")
BASELINES = ("dis_chain", "dis_direct")


class Tally:
    """Counts over all frames and points."""

    def __init__(self, shape):
        self.scale = np.array([SIDE / shape[1], SIDE / shape[0]])
        self.hits, self.false, self.visible, self.within = np.zeros(5), np.zeros(5), 0, np.zeros(5)
        self.right, self.all = 0, 0

    def add(self, true_places, true_seen, places, seen):
        off = np.linalg.norm((places - true_places) * self.scale, axis=1)
        for k, limit in enumerate(THRESHOLDS):
            near = off < limit
            self.within[k] += (true_seen & near).sum()
            self.hits[k] += (true_seen & seen & near).sum()
            self.false[k] += (seen & ~(true_seen & near)).sum()
        self.visible += true_seen.sum()
        self.right += (seen == true_seen).sum()
        self.all += len(seen)

    def figures(self):
        if self.visible == 0 or self.all == 0:
            return dict.fromkeys(NAMES)
        jaccard, delta = self.hits / (self.visible + self.false), self.within / self.visible
        return {"average_jaccard": rounded(jaccard.mean()), "delta_average": rounded(delta.mean()),
                "occlusion_accuracy": rounded(self.right / self.all),
                "jaccard": [rounded(v) for v in jaccard], "delta": [rounded(v) for v in delta]}


def rounded(value):
    return round(float(value), 4)


def queries_on(mask):
    """Pixels (x, y) of `mask` on an even grid, about QUERIES of them."""
    step = max(1, int(np.sqrt(mask.sum() / QUERIES)))
    y, x = np.nonzero(mask)
    chosen = (x % step == step // 2) & (y % step == step // 2)
    return np.stack([x[chosen], y[chosen]], -1)


def truth_of(truth):
    """(queries, [(frame, kept, places, seen)…]): of the queries that say something there (`kept`), where they are."""
    base = truth.painted_frame
    queries = queries_on(truth.smooth(base))
    found = []
    for frame in (f for f in truth.scene.frames if f != base):
        rest = truth.data(frame).rest
        goal = truth.data(base).rest[queries[:, 1], queries[:, 0]].astype(np.float64)
        shown = truth.coverage(frame) >= 0.5
        if shown.sum() < 16:
            found.append((frame, np.ones(len(queries), bool), np.zeros((len(queries), 2)),
                          np.zeros(len(queries), bool)))
            continue
        places, off = matching.located(goal, rest, matching.nearest(goal, rest, shown).astype(np.float64))
        seen = fields.Cells(places, rest.shape).all_in(truth.smooth(frame)) & (off < matching.CLOSE_PX)
        hidden = ~seen & ~(off < NEAR_PX)
        found.append((frame, seen | hidden, places, seen))
    return queries, found


def places_by_coordinates(queries, there, here, shown):
    """(places, seen): the pixels of a frame that show what the queries show on the painted one.

    `there`, `here`: drift.Coordinates of the painted frame and of this one; `shown`: the surface's matte here."""
    y, x = np.nonzero(shown)
    places, seen = np.zeros((len(queries), 2)), np.zeros(len(queries), bool)
    if len(x) == 0:
        return places, seen
    goal, known = there.texels[queries[:, 1], queries[:, 0]], here.texels[y, x]
    slopes = here.slopes()
    for k, wanted in enumerate(goal):
        away = fields.wrapped(wanted - known, here.side)
        best = np.argmin((away * away).sum(1))
        slope = slopes[y[best], x[best]]
        if not np.isfinite(slope).all() or abs(np.linalg.det(slope)) < 1e-4:
            continue
        step = np.linalg.solve(slope, away[best])
        seen[k] = np.linalg.norm(step) < SAME_PX
        places[k] = (x[best], y[best]) + np.clip(step, -SAME_PX, SAME_PX)
    return places, seen


def ours(truth, known, st_of_frame):
    queries, found = known
    tally, there = Tally(truth.coverage(truth.painted_frame).shape), st_of_frame(truth.painted_frame)
    for frame, kept, true_places, true_seen in found:
        places, seen = places_by_coordinates(queries, there, st_of_frame(frame), truth.coverage(frame) >= 0.5)
        tally.add(true_places[kept], true_seen[kept], places[kept], seen[kept])
    return tally.figures()


def baseline(truth, known, plate_of_frame, direct):
    """DIS, chained or `direct`; None without OpenCV. `plate_of_frame`: frame → the plate's file."""
    if cv2 is None:
        return None
    queries, found = known
    base, flow = truth.painted_frame, cv2.DISOpticalFlow_create(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM)
    tally, places = Tally(truth.coverage(base).shape), {base: queries.astype(np.float64)}
    for frame in sorted((f for f, *_ in found), key=lambda f: abs(f - base)):
        source = base if direct else frame + (1 if frame < base else -1)
        moved = flow.calc(codes(plate_of_frame(source)), codes(plate_of_frame(frame)), None)
        inside = np.clip(places[source], 0, np.array(moved.shape[1::-1]) - 1)
        places[frame] = places[source] + fields.Cells(inside, moved.shape).look_up(moved)
    for frame, kept, true_places, true_seen in found:
        seen = fields.Cells(places[frame], truth.coverage(frame).shape)
        shown = np.zeros(len(queries), bool)
        shown[seen.inside] = (seen.look_up(truth.coverage(frame)) >= 0.5)[seen.inside]
        tally.add(true_places[kept], true_seen[kept], places[frame][kept], shown[kept])
    return tally.figures()


def codes(path):
    return np.rint(255 * images.luma(images.rgb(path))).astype(np.uint8)
