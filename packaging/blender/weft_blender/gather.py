"""The texture of an object, laid out by its UVs, from the frames of a render. Needs numpy, and no Blender."""
import numpy as np

from . import exr


class NothingSeen(Exception):
    """No frame shows the object."""


def frame_samples(path, layers, layer):
    """UVs (N x 2) and unlit colours (N x 3) of the pixels that the surface covers wholly: of a frame of Weft's, which
    keeps the view layer's UV pass, and of the file of its layers `texture` and `matte`."""
    names = exr.channel_names(path)
    u, v = next(((f"{layer}.UV.{a}", f"{layer}.UV.{b}") for a, b in (("U", "V"), ("X", "Y"))
                 if f"{layer}.UV.{a}" in names), (f"{layer}.UV.U", f"{layer}.UV.V"))
    data = exr.read(path, [u, v]) | exr.read(layers, ["matte.A", "texture.R", "texture.G", "texture.B"])
    if data[u].shape != data["matte.A"].shape:
        raise exr.Unreadable(f"{layers} has another size than {path}.")
    sure = data["matte.A"] >= 1
    # UVs of pixels at an edge are mixed with those of what is behind.
    inner = sure.copy()
    inner[1:] &= sure[:-1]
    inner[:-1] &= sure[1:]
    inner[:, 1:] &= sure[:, :-1]
    inner[:, :-1] &= sure[:, 1:]
    uv = np.stack([data[u][inner], data[v][inner]], 1)
    return uv, np.stack([data["texture." + c][inner] for c in "RGB"], 1)


def splat(uv, colours, side, total, weight):
    """Adds samples to the four texels around each; a texture repeats beyond 0 to 1. Rows go upwards, as in Blender."""
    x, y = uv[:, 0] * side - 0.5, uv[:, 1] * side - 0.5
    i, j = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    fx, fy = x - i, y - j
    for dx, dy in ((0, 0), (1, 0), (0, 1), (1, 1)):
        share = (fx if dx else 1 - fx) * (fy if dy else 1 - fy)
        at = ((j + dy) % side) * side + (i + dx) % side
        weight += np.bincount(at, share, side * side)
        for c in range(3):
            total[:, c] += np.bincount(at, share * colours[:, c], side * side)


def filled(total, weight):
    """Means of what was added; texels without samples take those around, from ever coarser levels."""
    side = weight.shape[0]
    known = weight > 1e-3
    out = np.where(known[..., None], total / np.maximum(weight, 1e-12)[..., None], 0)
    if known.all() or side <= 1:
        return out
    odd = side % 2
    pad = [(0, odd), (0, odd)]
    t, w = np.pad(total, pad + [(0, 0)]), np.pad(weight, pad)
    half = (side + odd) // 2
    coarse = filled(t.reshape(half, 2, half, 2, 3).sum((1, 3)), w.reshape(half, 2, half, 2).sum((1, 3)))
    from_coarse = coarse.repeat(2, 0).repeat(2, 1)[:side, :side]
    return np.where(known[..., None], out, from_coarse)


def gathered(frames, layer, side):
    """Of pairs of files as frame_samples() takes them: the texture (side x side x 3, rows upwards, linear light) and the share of it that the frames show."""
    total, weight = np.zeros((side * side, 3)), np.zeros(side * side)
    for path, layers in frames:
        uv, colours = frame_samples(path, layers, layer)
        good = np.isfinite(uv).all(1) & np.isfinite(colours).all(1)
        splat(uv[good], colours[good], side, total, weight)
    if not weight.any():
        raise NothingSeen("No frame shows the object wholly.")
    shown = float((weight > 1e-3).mean())
    return filled(total.reshape(side, side, 3), weight.reshape(side, side)), shown
