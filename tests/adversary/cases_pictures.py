"""Plates as PNG, JPEG, TIFF and DPX in all their kinds, and of all sizes."""
import zlib

import png_maker
import probes
import raw_makers
from cases import add, frames
from oracle import MISSING, OK, SPACE, UNREADABLE, USAGE, Step, edge_difference
from shot import numbered, plate

EITHER = (OK, UNREADABLE)


def written(shot, extension, encode):
    """The shot with every plate encoded by a function of its number and its rows of (r, g, b)."""
    shot.ordinary(plates=None)
    for index, frame in enumerate(shot.numbers):
        shot.put(f"frames/{numbered(frame)}{extension}", encode(index, shot.plate(index)))
    return shot.replace(plate="frames/####" + extension)


def grey_rows(rows, bits):
    largest = (1 << bits) - 1
    coded = png_maker.as_colour(rows, bits, png_maker.GREY)
    return [[(round(v * 255 / largest),) * 3 for v in row] for row in coded]


def png_case(bits, colour, interlaced):
    def build(shot):
        palette = [(i * 255 // ((1 << bits) - 1),) * 3 for i in range(1 << bits)] if colour == png_maker.PALETTE else None
        words = written(shot, ".png", lambda i, rows: png_maker.encode(
            png_maker.as_colour(rows, bits, colour), bits, colour, interlaced, palette))
        outputs = frames(shot)
        if colour in (png_maker.GREY, png_maker.PALETTE, png_maker.GREY_ALPHA):
            for index, output in enumerate(outputs):
                output.picture = grey_rows(shot.plate(index), bits)
        yield Step(words, outputs=outputs)
    return build


KINDS = {"grey": (png_maker.GREY, (1, 2, 4, 8, 16)), "palette": (png_maker.PALETTE, (1, 2, 4, 8)),
         "greyalpha": (png_maker.GREY_ALPHA, (8, 16)), "rgb": (png_maker.RGB, (8, 16)), "rgba": (png_maker.RGBA, (8, 16))}
for _kind, (_colour, _depths) in KINDS.items():
    for _bits in _depths:
        for _interlaced in (False, True):
            add(f"png/{_kind}{_bits}{'_interlaced' if _interlaced else ''}", png_case(_bits, _colour, _interlaced))


def png_chunks(extra, exits=(OK,)):
    def build(shot):
        words = written(shot, ".png", lambda i, rows: png_maker.encode(png_maker.as_colour(rows, 8, 2), extra=extra))
        yield Step(words, exits=exits, outputs=frames(shot, picture=False))
    return build


PROFILE = b"other\0\0" + zlib.compress(b"\0" * 200)
for _name, _extra in {"gamma": [(b"gAMA", b"\0\0\xb1\x8f")], "chromaticities": [(b"cHRM", b"\0\0z&" * 8)],
                      "broken_profile": [(b"iCCP", PROFILE)], "transparent_colour": [(b"tRNS", b"\0\x50" * 3)],
                      "pixel_aspect": [(b"pHYs", b"\0\0\x10\0\0\0\x08\0\0")], "animated": [(b"acTL", b"\0\0\0\1\0\0\0\0")],
                      "text_of_escapes": [(b"tEXt", b"Comment\0\x1b[2J\x1b]0;x\x07")],
                      "unknown_chunk": [(b"weFt", b"?" * 5000)]}.items():
    add("png/" + _name, png_chunks(_extra))
for _name, _extra in {"unknown_critical_chunk": [(b"WEFT", b"?")], "two_headers": [(b"IHDR", b"\0" * 13)],
                      "text_bomb": [(b"zTXt", b"Comment\0\0" + zlib.compress(b"a" * (64 << 20)))]}.items():
    add("png/" + _name, png_chunks(_extra, EITHER))


def blocks_of(rows, turn):
    return [[turn(rows[y][x]) for x in range(0, len(rows[0]), 8)] for y in range(0, len(rows), 8)]


def jpeg_case(turn, exits=(OK,), **options):
    def build(shot):
        words = written(shot, ".jpg", lambda i, rows: raw_makers.jpeg(blocks_of(rows, turn), **options))
        yield Step(words, exits=exits, outputs=frames(shot, picture=False))
    return build


def luma(p):
    return ((p[0] + 2 * p[1] + p[2]) // 4, 128, 128)


for _progressive in (False, True):
    _tail = "_progressive" if _progressive else ""
    add("jpeg/grey" + _tail, jpeg_case(lambda p: luma(p)[:1], progressive=_progressive))
    add("jpeg/colour" + _tail, jpeg_case(luma, progressive=_progressive))
    for _transform in (0, 2):
        add(f"jpeg/cmyk{_transform}{_tail}", jpeg_case(lambda p: (*luma(p), 40), EITHER, progressive=_progressive,
                                                       adobe=_transform))
add("jpeg/12_bits", jpeg_case(luma, (UNREADABLE,), precision=12))
add("jpeg/broken_exif", jpeg_case(luma, EITHER, exif=b"Exif\0\0II*\0\xff\xff\xff\xff"))


def orientation_case(value, big, kind):
    """A picture that is marked as turned is shown turned: 64×48 becomes 48×64 from 5 on."""
    def build(shot):
        size = (48, 64) if value >= 5 else (64, 48)
        shot.ordinary(size=size, plates=None)
        for index, frame in enumerate(shot.numbers):
            rows = plate(index, (64, 48))
            data = raw_makers.jpeg(blocks_of(rows, luma), exif=raw_makers.exif_orientation(value, big)) if kind == "jpg" \
                else raw_makers.tiff([[v for p in row for v in p] for row in rows], orientation=value, big=big)
            shot.put(f"frames/{numbered(frame)}.{kind}", data)
        yield Step(shot.replace(plate="frames/####." + kind), outputs=frames(shot, picture=False))
    return build


for _value in range(1, 9):
    add(f"jpeg/orientation{_value}", orientation_case(_value, _value % 2 == 0, "jpg"))
    add(f"tiff/orientation{_value}", orientation_case(_value, _value % 2 == 1, "tif"))
for _value in (0, 9, 65535):
    add(f"jpeg/orientation{_value}", jpeg_case(luma, exif=raw_makers.exif_orientation(_value)))


def converted_case(extension, options, exits=(OK,), linear=False, picture=True, out=None, tolerance=6.0):
    def build(shot):
        shot.converted(extension, *options, linear=linear)
        out_extension = out or ".png"
        yield Step(shot.replace(plate="frames/####" + extension, out="out/####" + out_extension), exits=exits,
                   outputs=frames(shot, "out/{}" + out_extension, picture=picture, tolerance=tolerance,
                                  linear=out_extension == ".exr"))
    return build


for _quality in (1, 50, 100):
    add(f"jpeg/quality{_quality}", converted_case(".jpg", ("--compression", f"jpeg:{_quality}", "--attrib", "jpeg:subsampling", "4:4:4"), picture=_quality == 100,
                                                  out=".jpg"))
for _layout in (("--scanline",), ("--tile", "16", "16"), ("--tile", "64", "64"), ("--planarconfig", "separate")):
    for _depth in ("uint8", "uint16", "half", "float"):
        for _compression in ("none", "zip") if _depth != "half" else ("lzw",):
            _label = "".join(_layout).replace("-", "")
            add(f"tiff/{_label}_{_depth}_{_compression}",
                converted_case(".tif", (*_layout, "-d", _depth, "--compression", _compression), out=".tif" if _depth != "half"
                               else ".png", linear=_depth in ("half", "float"), picture=_depth[0] == "u"))
for _depth in ("uint32", "double"):
    add(f"tiff/{_depth}", converted_case(".tif", ("-d", _depth), EITHER, picture=False))
for _compression in ("packbits", "jpeg"):
    add(f"tiff/{_compression}", converted_case(".tif", ("--compression", _compression), picture=_compression == "packbits"))
add("tiff/big", converted_case(".tif", ("--attrib", "tiff:bigtiff", "1")))
add("tiff/two_pages", converted_case(".tif", ("--dup", "--siappend")))
for _extension in (".bmp", ".tga", ".pnm", ".webp", ".gif", ".hdr", ".sgi", ".iff"):
    add("other/" + _extension[1:], converted_case(_extension, (), EITHER, picture=False))


def signed(shot):
    words = written(shot, ".tif", lambda i, rows: raw_makers.tiff([[v // 2 for p in row for v in p] for row in rows],
                                                                  extra_tags={339: (3, [2, 2, 2])}))
    yield Step(words, exits=EITHER, outputs=frames(shot, picture=False))


add("tiff/signed", signed)


def raw_tiff_case(photometric, bits, big):
    def build(shot):
        largest = 257 if bits == 16 else 1
        turn = {0: lambda p: [255 - p[1]], 1: lambda p: [p[1]], 2: list, 3: lambda p: [p[1]], 5: lambda p: [255 - v for v in p] + [0]}
        words = written(shot, ".tif", lambda i, rows: raw_makers.tiff(
            [[s * largest for p in row for s in turn[photometric](p)] for row in rows], photometric, bits, big=big))
        yield Step(words, exits=EITHER if photometric == 5 else (OK,), outputs=frames(shot, picture=False))
    return build


for _photometric in (0, 1, 2, 3, 5):
    for _bits in (8,) if _photometric == 3 else (8, 16):
        add(f"tiff/photometric{_photometric}_{_bits}", raw_tiff_case(_photometric, _bits, _bits == 16))


def dpx_case(bits, big, transfer, **more):
    def build(shot):
        words = written(shot, ".dpx", lambda i, rows: raw_makers.dpx(
            [[tuple(v / 255 for v in p) for p in row] for row in rows], bits, big, transfer, **more))
        step = Step(words, outputs=frames(shot, picture=False))
        yield step
        if transfer in (1, 3) and "warning" not in step.outcome.err:
            off = edge_difference(probes.rgb8(shot.path("out/0001.png"), False, shot.size[0]), shot.plate())
            assert off > 6, "codes of a logarithm are shown as they are, and nothing is said"
        yield Step(shot.replace(plate="frames/####.dpx", out="out/b/####.dpx"), outputs=frames(shot, "out/b/{}.dpx", False))
    return build


for _bits in (8, 10, 12, 16):
    for _big in (True, False):
        for _transfer, _name in ((2, "linear"), (3, "log"), (6, "rec709")):
            add(f"dpx/{_bits}_{'big' if _big else 'little'}_{_name}", dpx_case(_bits, _big, _transfer))
add("dpx/printing_density", dpx_case(10, True, 1))
add("dpx/timecode", dpx_case(10, True, 2, fps=25.0, timecode=0x01020304))
add("dpx/rate_is_no_number", dpx_case(10, True, 2, fps=float("nan")))


def size_case(size, extension, options, linear=False):
    def build(shot):
        shot.size = size
        shot.ordinary(size=size, numbers=range(1, 3), plates="source/{}.png")
        shot.folder("frames")
        words = ["oiiotool", "--nosoftwareattrib"]
        for frame in shot.numbers:
            words += [f"source/{numbered(frame)}.png", *(("--colorconvert", "sRGB", "linear") if linear else ()), *options, "-o",
                      f"frames/{numbered(frame)}{extension}"]
        shot.tool(*words)
        yield Step(shot.replace(plate="frames/####" + extension, out="out/####" + extension),
                   outputs=frames(shot, "out/{}" + extension, picture=False))
    return build


for _size in ((1, 1), (2, 1), (1, 2), (2, 3), (3, 2), (7, 5), (1, 64), (64, 1), (3, 200), (200, 3), (63, 47), (127, 1), (97, 53)):
    for _extension in (".png", ".exr", ".tif", ".dpx"):
        add(f"size/{_size[0]}x{_size[1]}_{_extension[1:]}", size_case(_size, _extension, (), _extension == ".exr"))


def large(extension, size):
    def build(shot):
        shot.ordinary(plates=None, mattes=None)
        width, height = size
        for name in ("frames", "masks"):
            shot.folder(name)
        for frame in (1, 2):
            shot.tool("oiiotool", "--pattern", "noise:seed=7", f"{width}x{height}", "3", "--mulc", "0.4", "--addc", "0.3", "--clamp:min=0:max=1",
                      "-d", "uint8", "-o", f"frames/{frame:04d}{extension}", "--create", f"{width}x{height}", "1",
                      f"--fill:color=1", f"{width // 2}x{height // 2}+{width // 4}+{height // 4}", "-d", "uint8", "-o", f"masks/{frame:04d}.png")
        shot.size, shot.numbers = size, [1, 2]
        yield Step(shot.replace("--no-cache", plate="frames/####" + extension, out="out/####" + extension),
                   outputs=frames(shot, "out/{}" + extension, picture=False), seconds=240, rss_mb=4000)
    return build


for _extension in (".png", ".exr", ".jpg"):
    add(f"size/4k_{_extension[1:]}", large(_extension, (3840, 2160)))
add("size/strip_20000x4", large(".png", (20000, 4)))
add("size/strip_4x20000", large(".tif", (4, 20000)))


def claims(width, height, exits=(UNREADABLE, SPACE)):
    """A header that claims more pixels than any memory holds."""
    def build(shot):
        shot.ordinary(plates=None)
        data = bytearray(png_maker.encode([[0, 0, 0]]))
        head = png_maker.chunk(b"IHDR", width.to_bytes(4, "big") + height.to_bytes(4, "big") + b"\x08\x02\0\0\0")
        data[8:8 + len(head)] = head
        for frame in shot.numbers:
            shot.put(f"frames/{numbered(frame)}.png", bytes(data))
        yield Step(shot.replace(), exits=exits)
    return build


for _size in ((0, 0), (1, 0), (100000, 100000), (2147483647, 1), (65535, 65535)):
    add(f"size/claims_{_size[0]}x{_size[1]}", claims(*_size))


def changing(sizes, exits=(UNREADABLE,)):
    def build(shot):
        shot.ordinary()
        for frame, size in zip(shot.numbers, sizes):
            shot.put(f"frames/{numbered(frame)}.png", png_maker.encode(png_maker.as_colour(plate(0, size), 8, 2)))
        yield Step(shot.replace(), exits=exits)
    return build


add("size/changes_at_the_end", changing([(64, 48), (64, 48), (65, 48)]))
add("size/changes_at_the_start", changing([(32, 48), (64, 48), (64, 48)]))
add("size/empty_folder", lambda shot: iter([Step(shot.ordinary(plates=None).replace(), exits=(MISSING, UNREADABLE))]))
add("size/no_plate_at_all", lambda shot: iter([Step(shot.ordinary().replace(plate=""), exits=(USAGE,))]))
