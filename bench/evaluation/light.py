"""A picture with a new material laid on a surface, against a rendering of the scene with that material.

Of a plain grey this is the light that Weft puts on it; of a tile laid by exact coordinates, light, edges and filter.
Everything is linear RGB until it is told in levels: sRGB codes of 0 to 255 after one gain for the whole clip, the one
that makes the mean error least, for Weft and for what it is compared with alike.

A candidate is a function of the frame that returns two pictures (height × width × 3, linear, without grain): the
result, and what was laid on, times its coverage. A gain acts on the latter alone."""
import numpy as np

import fields
import images

BLUR_PX = 2.0
MARGIN_PX = 4
SOFT = (0.02, 0.98)
LEAST_PIXELS = 200
PLAIN_LEVELS = 1.0     # a light that deviates by less is too even for a correlation
GAIN_SAMPLES = 20000
NAMES = ("correlation", "correlation_worst", "levels", "levels_worst", "levels_rgb", "levels_p95", "edge_levels",
         "true_deviation_levels", "gain")


def levels(linear):
    return 255 * images.srgb_from_linear(linear)


def multiplied(truth, frame):
    """A candidate that parts nothing: the plate's own luma, blurred by 2 px, multiplied on, as in compositing."""
    plate, share = plate_of(truth, frame), truth.coverage(frame)[..., None]
    laid = share * fields.blurred(images.luma(plate), BLUR_PX)[..., None].repeat(3, -1)
    return (1 - share) * plate + laid, laid


def constant(truth, frame):
    """A candidate without any light."""
    share = truth.coverage(frame)[..., None]
    laid = share * np.full(3, truth.scene.facts["grey"], np.float32)
    return (1 - share) * plate_of(truth, frame) + laid, laid


def plate_of(truth, frame):
    return images.linear_from_srgb(images.rgb(truth.scene.file(frame, "plate", ending="png")))


def measure(truth, true_pictures, candidate):
    """`true_pictures`: "grey" or "tiled". None of the figures where the surface is too small."""
    inside, edges = [], []
    for frame in truth.frames_of(true_pictures):
        true, (result, laid) = images.rgb(truth.scene.file(frame, true_pictures)), candidate(frame)
        core = truth.core(frame, MARGIN_PX)
        if core.sum() >= LEAST_PIXELS:
            inside.append((result[core], true[core]))
        edges.append(edge_of(truth, frame, true, result, laid))
    if not inside:
        return dict.fromkeys(NAMES)
    gain, gains = fitted_gains(inside)
    found = {**interior(inside, gain, gains), "edge_levels": edge_error(edges, gains), "gain": gain}
    return {k: None if found[k] is None else round(float(found[k]), 4) for k in NAMES}


def interior(frames, gain, gains):
    """`frames`: (result, truth) of the pixels inside, (n, 3) each."""
    errors, coloured, correlations, deviations = [], [], [], []
    for result, true in frames:
        ours, goal = images.luma(result), images.luma(true)
        errors.append(np.abs(levels(gain * ours) - levels(goal)))
        coloured.append(np.abs(levels(gains * result) - levels(true)).mean())
        deviations.append(levels(goal).std())
        if deviations[-1] >= PLAIN_LEVELS:
            correlations.append(correlation(np.log(np.maximum(ours, 1e-4)), np.log(np.maximum(goal, 1e-4))))
    known, means = [c for c in correlations if c is not None], [e.mean() for e in errors]
    return {"correlation": np.mean(known) if known else None, "correlation_worst": min(known, default=None),
            "levels": np.mean(means), "levels_worst": max(means), "levels_rgb": np.mean(coloured),
            "levels_p95": np.percentile(np.concatenate(errors), 95), "true_deviation_levels": np.mean(deviations)}


def correlation(a, b):
    """Pearson's; None where one of them is constant."""
    a, b = a - a.mean(), b - b.mean()
    size = np.sqrt((a * a).sum() * (b * b).sum())
    return float((a * b).sum() / size) if a.std() > 1e-6 and b.std() > 1e-6 else None


def fitted_gains(frames):
    """(the gain of luma, the gains of the three channels)."""
    result, true = (np.concatenate([f[k] for f in frames]) for k in (0, 1))
    pick = np.random.default_rng(1).permutation(len(result))[:GAIN_SAMPLES]
    result, true = result[pick], true[pick]
    by_channel = np.array([best_gain(result[:, c], true[:, c]) for c in range(3)], np.float32)
    return best_gain(images.luma(result), images.luma(true)), by_channel


def best_gain(ours, true):
    """The factor with the least mean error in levels, by golden section about the medians' ratio."""
    start = np.log(max(np.median(true), 1e-5) / max(np.median(ours), 1e-5))
    goal, ratio = levels(true), (np.sqrt(5) - 1) / 2

    def error(log_gain):
        return np.abs(levels(np.exp(log_gain) * ours) - goal).mean()
    low, high = start - 0.7, start + 0.7
    a, b = high - ratio * (high - low), low + ratio * (high - low)
    at_a, at_b = error(a), error(b)
    for _ in range(18):
        if at_a < at_b:
            high, b, at_b = b, a, at_a
            a = high - ratio * (high - low)
            at_a = error(a)
        else:
            low, a, at_a = a, b, at_b
            b = low + ratio * (high - low)
            at_b = error(b)
    return np.float32(np.exp((low + high) / 2))


def edge_of(truth, frame, true, result, laid):
    """(what is expected, the result's fixed part, what was laid) in soft pixels that show no other surface in question.

    What is expected is the true picture, with the plate's own grain as far as its background shows."""
    coverage = truth.coverage(frame)
    soft = (coverage > SOFT[0]) & (coverage < SOFT[1]) & (truth.other_surfaces(frame) < 0.01)
    clean = np.clip(images.rgb(truth.scene.file(frame, "clean")), 0, 1)
    grain = (1 - coverage[soft][:, None]) * (plate_of(truth, frame)[soft] - clean[soft])
    return true[soft] + grain, result[soft] - laid[soft], laid[soft]


def edge_error(edges, gains):
    errors = np.concatenate([np.abs(levels(fixed + gains * laid) - levels(expected)).mean(1)
                             for expected, fixed, laid in edges])
    return float(errors.mean()) if len(errors) >= LEAST_PIXELS else None
