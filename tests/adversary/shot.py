"""A small shot that other programs made, and the words to run Weft on it."""
import functools
import random

import png_maker
from sandbox import Sandbox

SIZE = (64, 48)
FRAMES = 3


@functools.lru_cache(maxsize=64)
def noise(seed, width, height):
    """Rows of (r, g, b), 8 bits: cells of two sizes, so that motion can be followed."""
    chance = random.Random(f"{seed}/{width}/{height}")

    def cells(size):
        values = [[[chance.random() for _ in range(3)] for _ in range(width // size + 1)] for _ in range(height // size + 1)]
        return lambda x, y: values[y // size][x // size]

    coarse, fine = cells(9), cells(3)
    return tuple(tuple(tuple(int(50 + 90 * coarse(x, y)[c] + 80 * fine(x, y)[c]) for c in range(3)) for x in range(width))
                 for y in range(height))


def card(size, step):
    """The surface's rectangle on a frame: it moves by a pixel, and leaves a border of two where there is room."""
    width, height = size
    w, h = max(1, width * 5 // 8), max(1, height * 5 // 8)
    return min(step + max(0, (width - w) // 3), max(0, width - w - 3)), max(0, (height - h) // 2), w, h


@functools.lru_cache(maxsize=256)
def plate(step, size=SIZE, seed=1):
    """Frame number `step` as rows of (r, g, b)."""
    rows = [list(row) for row in noise(f"background{seed}", *size)]
    x0, y0, w, h = card(size, step)
    front = noise(f"card{seed}", w, h)
    for y in range(h):
        rows[y0 + y][x0:x0 + w] = front[y]
    return rows


def matte(step, size=SIZE):
    """Rows of one grey sample."""
    x0, y0, w, h = card(size, step)
    return [[255 if x0 <= x < x0 + w and y0 <= y < y0 + h else 0 for x in range(size[0])] for y in range(size[1])]


@functools.lru_cache(maxsize=256)
def png(kind, step, size=SIZE, seed=1):
    """An encoded picture: 'plate', 'matte' or 'texture'."""
    if kind == "matte":
        return png_maker.encode(matte(step, size), 8, png_maker.GREY)
    rows = plate(step, size, seed) if kind == "plate" else noise(f"texture{seed}", *size)
    return png_maker.encode(png_maker.as_colour(rows, 8, png_maker.RGB))


def numbered(frame, digits=4):
    return f"-{-frame:0{digits}d}" if frame < 0 else f"{frame:0{digits}d}"


class Shot(Sandbox):
    """frames/####.png, masks/####.png, tile.png (a plane), sample.png: made by `ordinary`; formats by their functions."""

    def __init__(self, root, weft, chance):
        super().__init__(root, weft)
        self.chance = chance  # of this case alone
        self.size = SIZE
        self.numbers = list(range(1, FRAMES + 1))

    def plate(self, index=0):
        return plate(index, self.size)

    def ordinary(self, numbers=None, size=SIZE, plates="frames/{}.png", mattes="masks/{}.png"):
        """Writes the whole shot as PNG. plates or mattes None: without them."""
        self.size, self.numbers = size, list(numbers or self.numbers)
        for index, frame in enumerate(self.numbers):
            if plates:
                self.put(plates.replace("{}", numbered(frame)), png("plate", index, size))
            if mattes:
                self.put(mattes.replace("{}", numbered(frame)), png("matte", index, size))
        self.put("tile.png", png("texture", 0, (48, 48)))
        self.put("sample.png", png("texture", 1, (96, 96)))
        return self

    def converted(self, extension, *options, linear=False, pictures=None):
        """The plates as files of another format in frames/, by oiiotool; options stand before each output."""
        self.ordinary(plates="source/{}.png")
        self.folder("frames")
        words = ["oiiotool", "--nosoftwareattrib"]
        for frame in self.numbers:
            name = numbered(frame)
            words += [f"source/{name}.png", *(("--colorconvert", "sRGB", "linear") if linear else ()), *options, "-o",
                      f"frames/{name}{extension}"]
        self.tool(*words)
        return self

    def movie(self, name, *options, filters=None, count=FRAMES, rate="24"):
        """The plates as a movie, by ffmpeg."""
        self.ordinary(plates="source/{}.png", numbers=range(1001, 1001 + count))
        words = ["ffmpeg", "-v", "error", "-y", "-framerate", rate, "-start_number", "1001", "-i", "source/%04d.png"]
        self.tool(*words, *(("-vf", filters) if filters else ()), *options, name)
        return self

    def replace(self, *more, plate="frames/####.png", matte="masks/####.png", texture=("--plane", "tile.png"),
                out="out/####.png"):
        """The words of `weft replace`, in draft quality on one thread."""
        words = ["replace", "--plate", plate, "--quality", "draft", "--threads", "1", "--backend", "cpu", *texture]
        words += ["--matte", matte] if matte else []
        return words + (["-o", out] if out else []) + list(more)

    def project(self, name="shot.weft", **more):
        """A project of this shot, as a dictionary that may be changed before it is written."""
        return {"schema": "weft.project/1", "name": "Shot", "plate": {"path": "frames/####.png"},
                "settings": {"quality": "draft"}, "output": {"path": "out/####.png"}, "next_region_id": 2,
                "regions": [{"id": 1, "name": "wall", "matte": {"files": "masks/####.png"},
                             "texture": {"plane": "tile.png"}}], **more}
