"""EXR plates: every compression and sample, parts in every order, windows, layers, deep and subsampled files."""
import itertools
import os
import re
import struct

import raw_makers
from cases import add, frames
from oracle import OK, SPACE, UNREADABLE, USAGE, Step
from raw_makers import FLOAT, HALF, UINT
from shot import numbered, plate

EITHER = (OK, UNREADABLE)
COMPRESSIONS = ("none", "rle", "zip", "zips", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab")


def simple(depth, options=(), out=".exr", more=(), picture=True, exits=(OK,), tolerance=6.0):
    """All plates by oiiotool, linear; rendered to `out`."""
    def build(shot):
        shot.converted(".exr", "-d", depth, *options, linear=True)
        yield Step(shot.replace(*more, plate="frames/####.exr", out="out/####" + out), exits=exits,
                   outputs=frames(shot, "out/{}" + out, picture, linear=out in (".exr", ".tif"), tolerance=tolerance))
    return build


for _depth in ("half", "float"):
    for _compression in COMPRESSIONS:
        add(f"exr/{_compression}_{_depth}", simple(_depth, ("--compression", _compression), tolerance=8))
        add(f"exr/to_{_compression}_{_depth}", simple(_depth, (), more=("--exr-compression", _compression), tolerance=8))
    for _tile in ("16x16", "64x64", "7x5"):
        add(f"exr/tiles{_tile}_{_depth}", simple(_depth, ("--tile", *_tile.split("x"))))
    for _out in (".png", ".tif", ".dpx", ".jpg"):
        add(f"exr/{_depth}_to_{_out[1:]}", simple(_depth, out=_out, tolerance=10))
    add(f"exr/{_depth}_to_the_other", simple(_depth, more=("--depth", "float" if _depth == "half" else "half")))
add("exr/mixed_depths", simple("half", ("-d", "G=float")))
add("exr/metadata", simple("half", ("--attrib", "smpte:TimeCode", "01:02:03:04", "--attrib", "camera", "x\x1b[2Jy",
                                    "--attrib:type=float", "framesPerSecond", "25", "--attrib", "owner", "a" * 5000)))
add("exr/negative_and_huge_values", simple("half", ("--mulc", "70000", "--subc", "9"), picture=False, out=".png"))


def mipmapped(shot):
    shot.ordinary(plates="source/{}.png")
    shot.folder("frames")
    for frame in shot.numbers:
        shot.tool("oiiotool", f"source/{numbered(frame)}.png", "-d", "half", "-otex:fileformatname=openexr",
                  f"frames/{numbered(frame)}.exr")
    # oiiotool makes textures of a power of two.
    yield Step(shot.replace(plate="frames/####.exr"), exits=EITHER)


add("exr/mipmaps", mipmapped)


def parts_case(order, out, more=(), depth="half", exits=(OK,)):
    """A file of several parts: the picture is the beauty's, wherever it stands."""
    def build(shot):
        shot.ordinary(plates="source/{}.png")
        shot.folder("frames")
        for frame in shot.numbers:
            source = f"source/{numbered(frame)}.png"
            made = {"beauty": [source, "--colorconvert", "sRGB", "linear"],
                    "depth": ["--create", "64x48", "1", "--addc", "30", "--chnames", "Z"],
                    "matte": ["--create", "64x48", "1", "--addc", "0.5", "--chnames", "matte.A"],
                    "normal": ["--create", "64x48", "3", "--addc", "0.7", "--chnames", "N.X,N.Y,N.Z"]}
            words = ["oiiotool", "--nosoftwareattrib"]
            for index, part in enumerate(order):
                words += [*made[part], "--attrib", "oiio:subimagename", part, *(("--siappend",) if index else ())]
            shot.tool(*words, "-d", depth, "-o", f"frames/{numbered(frame)}.exr")
        outputs = frames(shot, "out/{}" + out, linear=out == ".exr")
        yield Step(shot.replace(*more, plate="frames/####.exr", out="out/####" + out), exits=exits, outputs=outputs)
        yield Step(shot.replace(*more, "--overwrite", plate="frames/####.exr", out="out/####" + out), exits=exits,
                   outputs=outputs)
    return build


for _count in (2, 3):
    for _order in itertools.permutations(("beauty", "depth", "matte"), _count):
        if "beauty" in _order:
            for _out in (".exr", ".png"):
                add(f"parts/{'_'.join(_order)}_{_out[1:]}", parts_case(_order, _out))
add("parts/normal_beauty_depth_exr", parts_case(("normal", "beauty", "depth"), ".exr"))
add("parts/layers_all", parts_case(("beauty", "depth"), ".exr", ("--layers", "all")))
add("parts/float_of_half", parts_case(("depth", "beauty"), ".exr", ("--depth", "float")))
add("parts/chosen", parts_case(("depth", "beauty"), ".exr", ("--plate-layer", "beauty"), exits=EITHER + (USAGE,)))
add("parts/no_such_layer", parts_case(("depth", "beauty"), ".exr", ("--plate-layer", "diffuse"), exits=(USAGE, UNREADABLE)))


def raw(channels, window=(0, 0, 63, 47), display=None, extra=b"", line_order=0, exits=(OK,), more=(), out=".exr"):
    """Plates made byte by byte. channels: name -> (type, sampling, component or a value)."""
    def build(shot):
        left, top, right, bottom = display or window
        size = (right - left + 1, bottom - top + 1)
        shot.ordinary(size=size, plates=None)
        for index, frame in enumerate(shot.numbers):
            rows = plate(index, size)

            def value(of, kind):
                if not isinstance(of, int):
                    return lambda x, y: of
                return lambda x, y: (rows[min(max(y - top, 0), size[1] - 1)][min(max(x - left, 0), size[0] - 1)][of] /
                                     255 if kind != UINT else x + 9)

            shot.put(f"frames/{numbered(frame)}.exr", raw_makers.exr(
                {name: (kind, sampling, sampling, value(of, kind)) for name, (kind, sampling, of) in channels.items()},
                window, display, extra, line_order))
        yield Step(shot.replace(*more, plate="frames/####.exr", out="out/####" + out), exits=exits,
                   outputs=frames(shot, "out/{}" + out, False))
    return build


def huge_display(shot):
    """A small file whose display window no memory holds."""
    shot.ordinary(plates=None)
    channels = {c: (HALF, 1, 1, lambda x, y: 0.5) for c in "RGB"}
    for frame in shot.numbers:
        shot.put(f"frames/{numbered(frame)}.exr", raw_makers.exr(channels, (0, 0, 63, 47), (0, 0, 44720, 44720)))
    yield Step(shot.replace(plate="frames/####.exr"), exits=(UNREADABLE, SPACE))


def rgb(kind=HALF, sampling=1):
    return {name: (kind, sampling, index) for index, name in enumerate("RGB")}


for _name, _window, _display in (
        ("data_inside", (10, 10, 50, 40), (0, 0, 63, 47)), ("data_larger", (-9, -7, 80, 60), (0, 0, 63, 47)),
        ("data_left", (-20, 0, 30, 47), (0, 0, 63, 47)), ("data_apart", (100, 100, 120, 120), (0, 0, 63, 47)),
        ("negative", (-100, -90, -37, -43), (-100, -90, -37, -43)), ("display_offset", (5, 5, 68, 52), (5, 5, 68, 52)),
        ("one_pixel_of_data", (30, 20, 30, 20), (0, 0, 63, 47)), ("far_away", (1000000, 5, 1000063, 52), (1000000, 5, 1000063, 52))):
    for _out in (".exr", ".png"):
        add(f"windows/{_name}_{_out[1:]}", raw(rgb(), _window, _display, out=_out))
add("windows/display_of_two_thousand_millions", huge_display)
add("exr/decreasing_lines", raw(rgb(), line_order=1))
add("exr/mixed_types", raw({"R": (HALF, 1, 0), "G": (FLOAT, 1, 1), "B": (HALF, 1, 2)}))
add("exr/uint", raw(rgb(UINT), exits=EITHER))
add("exr/only_y", raw({"Y": (HALF, 1, 1)}))
add("exr/y_and_alpha", raw({"Y": (HALF, 1, 1), "A": (HALF, 1, 1.0)}))
add("exr/alpha_alone", raw({"A": (HALF, 1, 1.0)}, exits=EITHER))
add("exr/z_alone", raw({"Z": (FLOAT, 1, 9.0)}, exits=EITHER))
add("exr/without_blue", raw({"R": (HALF, 1, 0), "G": (HALF, 1, 1)}, exits=EITHER))
add("exr/half_transparent", raw({**rgb(), "A": (HALF, 1, 0.5)}))
add("exr/layers_only", raw({f"beauty.{c}": (HALF, 1, i) for i, c in enumerate("RGB")}, exits=EITHER))
add("exr/layer_chosen", raw({f"beauty.{c}": (HALF, 1, i) for i, c in enumerate("RGB")}, more=("--plate-layer", "beauty")))
add("exr/layer_of_escapes", raw({**rgb(), "\x1b[2J.R": (HALF, 1, 0)}, more=("--plate-layer", "nosuch"), exits=(USAGE, UNREADABLE)))
add("exr/subsampled_luma", raw({"Y": (HALF, 1, 1), "RY": (HALF, 2, 0.1), "BY": (HALF, 2, 0.1)}, exits=EITHER))
add("exr/subsampled_blue", raw({"R": (HALF, 1, 0), "G": (HALF, 1, 1), "B": (HALF, 2, 2)}, exits=EITHER))
add("exr/all_nan", raw({c: (HALF, 1, float("nan")) for c in "RGB"}, exits=EITHER))
add("exr/all_infinite", raw({c: (FLOAT, 1, float("inf")) for c in "RGB"}, exits=EITHER))
add("exr/three_hundred_channels", raw({**rgb(), **{f"aov{i}.R": (HALF, 1, 0.25) for i in range(300)}}))
add("exr/channel_named_like_weft", raw({**rgb(), "patch.R": (HALF, 1, 0.5), "id.Y": (UINT, 1, 7)}))
for _name, _numbers in {"acescg": (0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767),
                        "rec709": (0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329)}.items():
    add("exr/chromaticities_" + _name,
        raw(rgb(), extra=raw_makers.exr_attribute("chromaticities", "chromaticities", struct.pack("<8f", *_numbers))))
for _name, _value in {"aspect_of_nan": float("nan"), "aspect_of_zero": 0.0}.items():
    add("exr/" + _name, raw(rgb(), extra=raw_makers.exr_attribute("pixelAspectRatio", "float", struct.pack("<f", _value)),
                            exits=EITHER))


def deep(shot):
    shot.ordinary(plates="source/{}.png")
    shot.folder("frames")
    for frame in shot.numbers:
        shot.tool("oiiotool", f"source/{numbered(frame)}.png", "--ch", "R,G,B,A=1,Z=4", "--deepen", "-o",
                  f"frames/{numbered(frame)}.exr")
    yield Step(shot.replace(plate="frames/####.exr"), exits=(UNREADABLE,), says=("deep",))


add("exr/deep", deep)


def again(options, out):
    """A second pass over what Weft wrote with all layers."""
    def build(shot):
        shot.converted(".exr", "-d", "half", linear=True)
        yield Step(shot.replace("--layers", "all", plate="frames/####.exr", out="out/a/####.exr"),
                   outputs=frames(shot, "out/a/{}.exr", linear=True))
        yield Step(shot.replace(*options, plate="out/a/####.exr", out=out), may_write=("out/b", "out/b/**"),
                   exits=(OK, USAGE) if "--layers" in options else (OK,), outputs=frames(shot, out.replace("####", "{}"), linear=True))
        name = out.replace("####", numbered(1))
        if os.path.exists(shot.path(name)):
            channels = shot.tool("oiiotool", "--info", "-v", name)
            assert not re.search(r"channel\d", channels), channels
    return build


add("layers/second_pass", again((), "out/b/####.exr"))
add("layers/second_pass_all", again(("--layers", "all"), "out/b/####.exr"))
add("layers/second_pass_matte", again(("--layers", "matte,id"), "out/b/####.exr"))


def layers(names, out=".exr", more=(), exits=(OK,), depth="half"):
    def build(shot):
        shot.converted(".exr", "-d", depth, linear=True)
        yield Step(shot.replace("--layers", names, *more, plate="frames/####.exr", out="out/####" + out), exits=exits,
                   outputs=frames(shot, "out/{}" + out, linear=out == ".exr"))
    return build


for _name in ("all", "patch", "edge", "light", "st", "matte", "seam", "id", "patch,id", "id,id"):
    add("layers/" + _name.replace(",", "_"), layers(_name))
add("layers/unknown", layers("shine", exits=(USAGE,)))
add("layers/empty", layers("", exits=EITHER + (USAGE,)))
add("layers/png_alone", layers("all", ".png", exits=(USAGE,)))
add("layers/beside_png", layers("all", ".png", ("--layers-output", "out/layers.####.exr")))
add("layers/into_the_same_file", layers("all", ".exr", ("--layers-output", "out/####.exr"), (OK, USAGE)))
add("layers/into_png", layers("all", ".exr", ("--layers-output", "out/l.####.png"), (USAGE,)))
add("layers/without_a_number", layers("all", ".exr", ("--layers-output", "out/l.exr"), (USAGE,)))
add("layers/over_the_plate", layers("all", ".exr", ("--layers-output", "frames/####.exr", "--overwrite"), (USAGE,)))
