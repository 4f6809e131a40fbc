"""Contact sheets as JPEG: what was measured, to look at. They need the pictures that measure_scene leaves."""
import numpy as np
import OpenImageIO as oiio

import fields
import images
import tables
from measure import measured_of, surface_folder

FONT = "DejaVuSans"
CELL_WIDTH = 320
CAPTION_PX = 20
COLUMNS = 5
WORST_OF_EACH = 4


def scene_sheet(scene, work, path):
    """Rows: the plate; then for each surface the tile as delivered, the true grey, Weft's grey, the propagated matte.

    Columns: frames of which there is a true grey, from the first to the last. Rows without pictures are left out."""
    frames = [f for f in scene.frames if scene.file(f, "grey").is_file()] or list(scene.frames)
    frames = [frames[k] for k in sorted({int(round(k)) for k in np.linspace(0, len(frames) - 1, COLUMNS)})]
    rows = [("%s: the plate, frames %s" % (scene.name, ", ".join(map(str, frames))), [plate(scene, f) for f in frames])]
    for part in measured_of(scene):
        views = Views(scene, surface_folder(work, scene, part["name"]), part["name"])
        rows += [(part["name"] + ": " + what, [view(f) for f in frames])
                 for what, view in (("the tile, as delivered", views.delivered), ("true grey", views.true_grey),
                                    ("grey in Weft's light, at the true brightness", views.grey),
                                    ("propagated matte in red, true outline in green", views.matte))]
    write(path, [captioned(caption, pictures) for caption, pictures in rows if all(p is not None for p in pictures)])


def worst_sheet(results, scenes, work, path):
    """`scenes`: Scene by name. The worst surfaces by each table's first column, each on one frame."""
    strips = []
    for title, columns in tables.TABLES.items():
        for record, surface in tables.ordered(results, columns)[:WORST_OF_EACH]:
            scene = scenes.get(record["name"])
            if scene is None:
                continue
            views = Views(scene, surface_folder(work, scene, surface["name"]), surface["name"])
            frame = worst_frame(title, surface) or last_rendered(scene)
            pictures = {"Light": (views.true_grey, views.grey), "Matte": (views.matte,),
                        "Tile by exact coordinates": (views.true_tile, views.tile)}.get(title, (views.delivered,))
            pictures = [plate(scene, frame)] + [view(frame) for view in pictures]
            figures = "; ".join("%s %s" % (c.title, c.text(c.value(surface))) for c in columns[:2])
            caption = "%s: %s, %s, frame %d: %s" % (title, scene.name, surface["name"], frame, figures)
            strips.append(captioned(caption, [p for p in pictures if p is not None], width=3 * CELL_WIDTH))
    if strips:
        write(path, strips)


def last_rendered(scene):
    return max((f for f in scene.frames if scene.file(f, "grey").is_file()), default=scene.frames[-1])


def worst_frame(title, surface):
    return {"Motion": surface.get("motion", {}).get("final", {}).get("drift_worst_frame"),
            "Matte": surface.get("matte", {}).get("one", {}).get("worst_frame")}.get(title)


def plate(scene, frame):
    return images.rgb(scene.file(frame, "plate", ending="png"))


class Views:
    """Pictures of one surface as displayed (sRGB, 0 to 1), or None where there is no file."""

    def __init__(self, scene, folder, name):
        self.scene, self.folder, self.name = scene, folder, name

    def delivered(self, frame):
        return shown(self.folder / "delivered" / ("%04d.png" % frame))

    def true_grey(self, frame):
        return shown(self.scene.file(frame, "grey"))

    def grey(self, frame):
        """Inside at the true grey's brightness, by one gain for the clip: that of the frame that shows most of it."""
        path = self.folder / "light-final" / ("%04d.exr" % frame)
        if not path.is_file():
            return None
        gain = 1 + self.coverage(frame)[..., None] * (self.gain() - 1)
        return images.srgb_from_linear(gain * images.rgb(path))

    def gain(self):
        files = {f: self.folder / "light-final" / ("%04d.exr" % f) for f in self.scene.frames}
        frame = max((f for f in files if files[f].is_file()), key=lambda f: self.coverage(f).sum())
        inside = self.coverage(frame) > 0.999
        true, result = (images.luma(images.rgb(p)) for p in (self.scene.file(frame, "grey"), files[frame]))
        return np.median(true[inside]) / max(np.median(result[inside]), 1e-6) if inside.any() else 1

    def coverage(self, frame):
        return sum(images.grey(f) for f in self.scene.coverage_files(self.name, frame))

    def true_tile(self, frame):
        return shown(self.scene.file(frame, "tiled"))

    def tile(self, frame):
        return shown(self.folder / "tiled" / ("%04d.exr" % frame))

    def matte(self, frame):
        picture, path = plate(self.scene, frame), self.folder / "matte" / ("%04d.png" % frame)
        if not path.is_file():
            return None
        picture = picture + 0.5 * images.grey(path)[..., None] * (np.float32((1, 0, 0)) - picture)
        picture[fields.boundary(self.coverage(frame) >= 0.5)] = (0, 1, 0)
        return picture


def shown(path):
    """A display-referred PNG as it is; a linear EXR as sRGB."""
    if not path.is_file():
        return None
    return images.rgb(path) if path.suffix == ".png" else images.srgb_from_linear(images.rgb(path))


def captioned(caption, pictures, width=None):
    """The pictures beside each other, CELL_WIDTH wide each, under a line of text; black up to `width`."""
    cells = [scaled(p) for p in pictures]
    strip = np.concatenate(cells, 1)
    width = max(width or 0, strip.shape[1])
    strip = np.pad(strip, ((0, 0), (0, width - strip.shape[1]), (0, 0)))
    line = oiio.ImageBuf(oiio.ImageSpec(width, CAPTION_PX, 3, "float"))
    oiio.ImageBufAlgo.zero(line)
    if not oiio.ImageBufAlgo.render_text(line, 4, CAPTION_PX - 6, caption, 13, FONT, (0.9, 0.9, 0.9)):
        raise OSError("%s, which captions need, is missing (Debian: fonts-dejavu-core): %s" % (FONT, line.geterror()))
    return np.concatenate([line.get_pixels(oiio.FLOAT), strip])


def scaled(picture):
    height = round(picture.shape[0] * CELL_WIDTH / picture.shape[1])
    source = oiio.ImageBuf(oiio.ImageSpec(picture.shape[1], picture.shape[0], 3, "float"))
    source.set_pixels(oiio.ROI(), np.ascontiguousarray(picture[..., :3], np.float32))
    return oiio.ImageBufAlgo.resize(source, roi=oiio.ROI(0, CELL_WIDTH, 0, height, 0, 1, 0, 3)).get_pixels(oiio.FLOAT)


def write(path, strips):
    width = max(s.shape[1] for s in strips)
    rows = [np.pad(s, ((0, 0), (0, width - s.shape[1]), (0, 0))) for s in strips]
    images.write(path, np.clip(np.concatenate(rows), 0, 1), "uint8", compression="jpeg:90")
