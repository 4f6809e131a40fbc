"""Operations on pictures and masks of one frame. Places are (x, y) in pixels; a pixel's centre is at its index."""
import numpy as np


def dilated(mask, radius):
    """`mask` grown by a disc of `radius` px. The picture's border neither grows nor shrinks anything."""
    reach = int(radius)
    height, width = mask.shape
    grown = np.zeros_like(mask)
    rows = np.zeros((height, width + 1), np.int32)
    np.cumsum(mask, axis=1, out=rows[:, 1:])
    x = np.arange(width)
    for dy in range(-reach, reach + 1):
        half = int(np.sqrt(radius * radius - dy * dy))
        near = rows[:, np.minimum(x + half + 1, width)] > rows[:, np.maximum(x - half, 0)]
        source, target = slice(max(0, -dy), height - max(0, dy)), slice(max(0, dy), height - max(0, -dy))
        grown[target] |= near[source]
    return grown


def eroded(mask, radius):
    """`mask` shrunk by a disc of `radius` px; what leaves the picture is not an edge."""
    return ~dilated(~mask, radius)


def boundary(mask):
    """The mask's pixels beside which, to the right or below, the mask changes (as DAVIS' evaluation takes them)."""
    edge = np.zeros_like(mask)
    edge[:, :-1] |= mask[:, :-1] != mask[:, 1:]
    edge[:-1] |= mask[:-1] != mask[1:]
    edge[:-1, :-1] |= mask[:-1, :-1] != mask[1:, 1:]
    return edge


def blurred(field, sigma):
    """A Gaussian of `sigma` px; the border's values continue outside."""
    reach = max(1, int(np.ceil(3 * sigma)))
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    weights /= weights.sum()
    for axis in (0, 1):
        pad = [(0, 0)] * field.ndim
        pad[axis] = (reach, reach)
        wide = np.pad(field, pad, mode="edge")
        length = field.shape[axis]
        field = sum(w * np.take(wide, np.arange(k, k + length), axis) for k, w in enumerate(weights))
    return field.astype(np.float32)


def slopes(field, period=None):
    """d/dx and d/dy by central differences, (height, width, channels, 2); NaN at the picture's border.

    `period`: the field is known up to whole multiples of this."""
    out = np.full(field.shape + (2,), np.nan, np.float32)
    out[:, 1:-1, ..., 0] = wrapped(field[:, 2:] - field[:, :-2], period) / 2
    out[1:-1, ..., 1] = wrapped(field[2:] - field[:-2], period) / 2
    return out


def wrapped(difference, period):
    """`difference`, less the whole multiple of `period` that brings it nearest to 0."""
    return difference if period is None else difference - period * np.round(difference / period)


class Cells:
    """The four pixels about each of `places` (n, 2), and a bilinear lookup between them."""

    def __init__(self, places, shape):
        height, width = shape[:2]
        self.inside = (places[:, 0] >= 0) & (places[:, 1] >= 0)
        self.inside &= (places[:, 0] <= width - 1) & (places[:, 1] <= height - 1)
        safe = np.where(self.inside[:, None], places, 0)
        self.x = np.minimum(safe[:, 0].astype(int), width - 2)
        self.y = np.minimum(safe[:, 1].astype(int), height - 2)
        self.fx, self.fy = (safe[:, 0] - self.x), (safe[:, 1] - self.y)

    def corners(self, field):
        """Values at (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)."""
        x, y = self.x, self.y
        return field[y, x], field[y, x + 1], field[y + 1, x], field[y + 1, x + 1]

    def all_in(self, mask):
        a, b, c, d = self.corners(mask)
        return self.inside & a & b & c & d

    def look_up(self, field, period=None):
        a, b, c, d = (v.astype(np.float64) for v in self.corners(field))
        fx, fy = (f.reshape(f.shape + (1,) * (a.ndim - 1)) for f in (self.fx, self.fy))
        b, c, d = (a + wrapped(v - a, period) for v in (b, c, d))
        return (1 - fy) * ((1 - fx) * a + fx * b) + fy * ((1 - fx) * c + fx * d)


def extended(field, known, steps):
    """`field` (height, width, channels), continued outside of `known` by means of known neighbours, `steps` px far."""
    total, known = np.where(known[..., None], field, 0), known.copy()
    for _ in range(steps):
        weight = known.astype(np.float32)
        sums, count = np.zeros_like(total), np.zeros_like(weight)
        for dy in (-1, 0, 1):
            for dx in (-1, 0, 1):
                sums += np.roll(total * weight[..., None], (dy, dx), (0, 1))
                count += np.roll(weight, (dy, dx), (0, 1))
        fresh = ~known & (count > 0)
        total[fresh] = sums[fresh] / count[fresh][:, None]
        known |= fresh
    return total, known
