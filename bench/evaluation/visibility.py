"""Which surface points are seen again on the next and on the previous frame."""
import numpy as np

import images

FORWARD, BACKWARD = 1, 2


def motion(data, direction):
    """(h, w, 2) px to the next frame (FORWARD) or the previous one, y down, of Blender's Vector pass: XY hold the
    previous place less this one, ZW this one less the next, y up."""
    if direction == FORWARD:
        return np.stack([-images.channels(data, "Vector.Z"), images.channels(data, "Vector.W")], -1)
    return np.stack([images.channels(data, "Vector.X"), -images.channels(data, "Vector.Y")], -1)


def seen_again(scene, frame):
    """(h, w) of FORWARD + BACKWARD bits."""
    here = images.read(scene.file(frame, "data"))
    bits = np.zeros(here[1].shape[:2], np.float32)
    for direction, other in ((FORWARD, frame + 1), (BACKWARD, frame - 1)):
        if other in scene.frames:
            bits += direction * seen_in(here, images.read(scene.file(other, "data")), motion(here, direction))
    return bits


def seen_in(here, there, flow):
    """A point is seen where a pixel around its new place shows the same part at the same point of it.

    Points are compared by `rest`, the place on the undeformed part, to within the step of one and a half pixels:
    a point one pixel behind an edge may pass for seen."""
    ids, other = images.channels(here, "IndexOB.X"), images.channels(there, "IndexOB.X")
    rest, far = (images.channels(d, "rest.R", "rest.G", "rest.B") for d in (here, there))
    height, width = ids.shape
    y, x = np.mgrid[0:height, 0:width]
    tx, ty = x + flow[..., 0], y + flow[..., 1]
    found = np.zeros(ids.shape, bool)
    step = 1.5 * pixel_step(rest, ids)
    for dy in (0, 1):
        for dx in (0, 1):
            px, py = np.floor(tx).astype(int) + dx, np.floor(ty).astype(int) + dy
            inside = (px >= 0) & (px < width) & (py >= 0) & (py < height)
            px, py = np.clip(px, 0, width - 1), np.clip(py, 0, height - 1)
            near = np.linalg.norm(far[py, px] - rest, axis=-1) <= step
            found |= inside & (other[py, px] == ids) & near
    return found & (ids > 0) & (tx >= -0.5) & (tx < width - 0.5) & (ty >= -0.5) & (ty < height - 0.5)


def pixel_step(rest, ids):
    """(h, w): the longest step of `rest` to a neighbour of the same part, metres; without one, no step."""
    step = np.zeros(ids.shape, np.float32)
    for axis in (0, 1):
        size = np.linalg.norm(np.diff(rest, axis=axis), axis=-1) * (np.diff(ids, axis=axis) == 0)
        lead, trail = [(0, 0), (0, 0)], [(0, 0), (0, 0)]
        lead[axis], trail[axis] = (1, 0), (0, 1)
        # The smaller of a pixel's two sides: the other may cross a fold.
        sides = np.stack([np.pad(size, lead), np.pad(size, trail)])
        sides[sides == 0] = np.inf
        least = sides.min(axis=0)
        step = np.hypot(step, np.where(np.isfinite(least), least, 0))
    return step
