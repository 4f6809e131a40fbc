"""How a laid texture follows the form of its surface: its coordinates against the surface's true place at every pixel.

J: texels per px, by the layer st; P: metres per px, by the pass Position. With l1 ≥ l2 the eigenvalues of
(PᵀP)⁻¹ JᵀJ, stretch is √(l1 / l2), 1 where the texture is laid without any, and area |½ ln(l1 l2) less its median over
the reference frame| in per cent, with that one median on every frame. Pixels within 4 px of the outline, seen at
a cosine below 0.15, or at a fold are left out."""
import numpy as np

import fields
import matching

MARGIN_PX = 4
RING_PX = 12
LEAST_COSINE = 0.15
FOLD_COSINE = 0.9     # between the normals on either side of a pixel
LEAST_PIXELS = 200
TEAR_TEXELS = 1.0
GROWN_POINTS = 1000
NAMES = ("stretch_median", "stretch_p90", "area_median", "area_p90", "rim_stretch_median", "rim_stretch_p90",
         "rim_area_median", "rim_area_p90", "grown_stretch_median", "grown_stretch_p90", "grown_area_p90",
         "flipped_share", "torn_share")


def place_slopes(truth, frame):
    """(metres per px (height, width, 3, 2), where they can be told)."""
    data = truth.data(frame)
    slope = fields.slopes(data.position)
    normal = np.cross(slope[..., 0], slope[..., 1])
    length = np.linalg.norm(normal, axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        normal /= length[..., None]
        view = data.position - camera_place(truth.scene, frame)
        view /= np.linalg.norm(view, axis=-1, keepdims=True)
        good = truth.smooth(frame) & truth.core(frame, MARGIN_PX) & (np.abs((normal * view).sum(-1)) >= LEAST_COSINE)
        for axis in (0, 1):
            turn = np.full(good.shape, -1, np.float32)
            middle, before, after = slices(axis)
            turn[middle] = (data.normal[before] * data.normal[after]).sum(-1)
            good &= turn > FOLD_COSINE
    return slope, good


def slices(axis):
    """A pixel, the one before it and the one after it, along an axis."""
    whole = slice(None)
    parts = (slice(1, -1), slice(None, -2), slice(2, None))
    return tuple((p, whole) if axis == 0 else (whole, p) for p in parts)


def camera_place(scene, frame):
    return np.array(scene.facts["camera"]["world_from_camera"][str(frame)], np.float32)[:3, 3]


def eigenvalues(texels, metres):
    """l1 and l2 of (PᵀP)⁻¹ JᵀJ by pixel; `texels` (n, 2, 2), `metres` (n, 3, 2)."""
    hxx, hxy, hyy = metric(texels)
    gxx, gxy, gyy = metric(metres)
    area = gxx * gyy - gxy * gxy
    half = (gyy * hxx - 2 * gxy * hxy + gxx * hyy) / (2 * area)
    determinant = (hxx * hyy - hxy * hxy) / area
    root = np.sqrt(np.maximum(half * half - determinant, 0))
    larger = half + root
    return larger, np.maximum(determinant, 0) / np.maximum(larger, 1e-30)


def metric(slope):
    """xx, xy and yy of slopeᵀ slope."""
    x, y = slope[..., 0].astype(np.float64), slope[..., 1].astype(np.float64)
    return (x * x).sum(1), (x * y).sum(1), (y * y).sum(1)


class Form:
    """One frame's pixels that count: their places (x, y), stretch, ½ ln area, ring and handedness."""

    def __init__(self, truth, frame, st):
        metres, good = place_slopes(truth, frame)
        texels = st.slopes()
        good &= np.isfinite(texels).all((2, 3))
        self.pixels = np.stack(np.nonzero(good)[::-1], -1)
        self.ring = ~truth.core(frame, RING_PX)[good]
        larger, smaller = eigenvalues(texels[good], metres[good])
        self.stretch = np.sqrt(larger / np.maximum(smaller, 1e-12 * np.maximum(larger, 1e-30)))
        self.log_area = 0.5 * np.log(np.maximum(larger * smaller, 1e-30))
        (a, b), (c, d) = np.moveaxis(texels[good], 0, -1)
        self.hand = np.sign(a * d - b * c)
        self.torn = torn(truth.data(frame).position, st)[good]


def torn(position, st):
    """Pixels at which a step of the coordinates is not, to a texel, what the step before and the surface foretell."""
    found = np.zeros(position.shape[:2], bool)
    for axis in (0, 1):
        middle, _, _ = slices(axis)
        metres = np.linalg.norm(np.diff(position, axis=axis), axis=-1)
        step = fields.wrapped(np.diff(st.texels, axis=axis), st.side)
        first = (slice(None, -1), slice(None)) if axis == 0 else (slice(None), slice(None, -1))
        second = (slice(1, None), slice(None)) if axis == 0 else (slice(None), slice(1, None))
        with np.errstate(invalid="ignore", divide="ignore"):
            foretold = step[first] * (metres[second] / metres[first])[..., None]
            found[middle] |= np.linalg.norm(step[second] - foretold, axis=-1) > TEAR_TEXELS
    return found


def measure(truth, st_of_frame, reference):
    """`reference`: the frame on which Weft placed the texture."""
    forms = {f: Form(truth, f, st_of_frame(f)) for f in truth.scene.frames}
    base = forms[reference] if len(forms[reference].pixels) >= LEAST_PIXELS else forms[truth.painted_frame]
    if len(base.pixels) < LEAST_PIXELS:
        return dict.fromkeys(NAMES)
    middle = np.median(base.log_area)
    together = {k: np.concatenate([getattr(f, k) for f in forms.values()]) for k in ("stretch", "ring", "hand", "torn")}
    area = 100 * np.abs(np.concatenate([f.log_area for f in forms.values()]) - middle)
    ring, stretch = together["ring"], together["stretch"]
    grown = np.concatenate([grown_pixels(truth, f, forms[f], reference) for f in forms])
    usual = np.sign(base.hand.sum())
    found = {**two("stretch", stretch), **two("area", area), **two("rim_stretch", stretch[ring]),
             **two("rim_area", area[ring]), **two("grown_stretch", stretch[grown]), **two("grown_area", area[grown]),
             "flipped_share": float((together["hand"] != usual).mean()), "torn_share": float(together["torn"].mean())}
    return {k: None if found[k] is None else round(found[k], 5) for k in NAMES}


def two(name, values):
    enough = len(values) >= LEAST_PIXELS
    return {name + "_median": float(np.median(values)) if enough else None,
            name + "_p90": float(np.percentile(values, 90)) if enough else None}


def grown_pixels(truth, frame, form, reference):
    """Which of a frame's pixels (of a random choice) the reference frame did not show."""
    chosen = np.zeros(len(form.pixels), bool)
    pick = np.random.default_rng(frame).permutation(len(chosen))[:GROWN_POINTS]
    if frame == reference or len(pick) == 0:
        return chosen
    here = form.pixels[pick]
    there = truth.data(reference)
    _, unseen = matching.by_place(here, truth.data(frame).rest, there.rest, truth.smooth(reference))
    hidden = {(x, y) for x, y in unseen.tolist()}
    chosen[pick] = [(x, y) in hidden for x, y in here.tolist()]
    return chosen
