"""Mattes, holdouts, textures, tracks and passes in all forms, and some that cannot be."""
import struct

import png_maker
import raw_makers
from cases import add, frames
from oracle import MISSING, OK, SPACE, UNREADABLE, USAGE, Step
from shot import matte, noise, numbered

EITHER = (OK, UNREADABLE)
SURE = (OK,)


def mattes(encode, extension=".png", exits=SURE, more=(), picture=True, says=()):
    """The shot with mattes made by a function of the shot, the index and its rows of grey samples."""
    def build(shot):
        shot.ordinary(mattes=None)
        for index, frame in enumerate(shot.numbers):
            data = encode(index, matte(index))
            if data is not None:
                shot.put(f"masks/{numbered(frame)}{extension}", data)
        yield Step(shot.replace(*more, matte="masks/####" + extension), exits=exits, says=says,
                   outputs=frames(shot, picture=picture))
    return build


def grey(bits):
    return lambda i, rows: png_maker.encode([[s * ((1 << bits) - 1) // 255 for s in row] for row in rows], bits, png_maker.GREY)


def rgba(alpha, colour=lambda s: s):
    return lambda i, rows: png_maker.encode([[v for s in row for v in (colour(s),) * 3 + (alpha(s),)] for row in rows], 8,
                                            png_maker.RGBA)


for _bits in (1, 2, 4, 8, 16):
    add(f"matte/grey{_bits}", mattes(grey(_bits)))
add("matte/alpha", mattes(rgba(lambda s: s, lambda s: 90)))
add("matte/alpha_all_opaque", mattes(rgba(lambda s: 255)))
add("matte/alpha_all_clear", mattes(rgba(lambda s: 0), exits=EITHER + (USAGE,)))
add("matte/grey_alpha", mattes(lambda i, rows: png_maker.encode([[v for s in row for v in (9, s)] for row in rows], 8, png_maker.GREY_ALPHA)))
add("matte/palette_ids", mattes(lambda i, rows: png_maker.encode([[3 if s else 1 for s in row] for row in rows], 2, png_maker.PALETTE,
                                                                 palette=[(0, 0, 0)] * 4), more=("--matte-value", "3")))
add("matte/palette_ids_interlaced", mattes(lambda i, rows: png_maker.encode(
    [[3 if s else 1 for s in row] for row in rows], 4, png_maker.PALETTE, True, [(9, 9, 9)] * 16), more=("--matte-value", "3")))
add("matte/ids_of_16_bits", mattes(lambda i, rows: png_maker.encode([[40000 if s else 1 for s in row] for row in rows], 16, 0),
                                   more=("--matte-value", "40000")))
add("matte/no_such_id", mattes(grey(8), more=("--matte-value", "77"), exits=EITHER + (USAGE,)))
add("matte/exr", mattes(lambda i, rows: raw_makers.exr({"A": (1, 1, 1, lambda x, y: rows[y][x] / 255)}, (0, 0, 63, 47)), ".exr"))
add("matte/exr_values_of_nan", mattes(lambda i, rows: raw_makers.exr(
    {"Y": (2, 1, 1, lambda x, y: float("nan") if rows[y][x] else 0)}, (0, 0, 63, 47)), ".exr", EITHER + (USAGE,)))
add("matte/exr_data_inside", mattes(lambda i, rows: raw_makers.exr(
    {"Y": (1, 1, 1, lambda x, y: 1.0)}, (20, 10, 40, 30), (0, 0, 63, 47)), ".exr"))
add("matte/exr_ids", mattes(lambda i, rows: raw_makers.exr({"id": (0, 1, 1, lambda x, y: 7 if rows[y][x] else 0)}, (0, 0, 63, 47)),
                            ".exr", more=("--matte-value", "7", "--matte-channel", "id")))
add("matte/tif", mattes(lambda i, rows: raw_makers.tiff(rows, 1), ".tif"))
add("matte/tif_white_is_zero", mattes(lambda i, rows: raw_makers.tiff([[255 - s for s in row] for row in rows], 0), ".tif"))
add("matte/jpg", mattes(lambda i, rows: raw_makers.jpeg([[(rows[y][x],) for x in range(0, 64, 8)] for y in range(0, 48, 8)]), ".jpg"))
add("matte/inverted", mattes(lambda i, rows: grey(8)(i, [[255 - s for s in row] for row in rows]), more=("--matte-invert",)))
add("matte/no_such_channel", mattes(grey(8), more=("--matte-channel", "depth"), exits=(UNREADABLE, USAGE)))
add("matte/wrong_size", mattes(lambda i, rows: grey(8)(i, rows[1:]), exits=(UNREADABLE, USAGE)))
add("matte/one_of_wrong_size", mattes(lambda i, rows: grey(8)(i, rows[i // 2:]), exits=(UNREADABLE, USAGE)))
add("matte/all_white", mattes(lambda i, rows: grey(8)(i, [[255] * 64] * 48), picture=False))
add("matte/all_black", mattes(lambda i, rows: grey(8)(i, [[0] * 64] * 48), exits=EITHER + (USAGE,)))
add("matte/empty_at_first", mattes(lambda i, rows: grey(8)(i, rows if i else [[0] * 64] * 48)))
add("matte/empty_at_last", mattes(lambda i, rows: grey(8)(i, rows if i < 2 else [[0] * 64] * 48)))
add("matte/empty_between", mattes(lambda i, rows: grey(8)(i, rows if i != 1 else [[0] * 64] * 48)))
add("matte/one_pixel", mattes(lambda i, rows: grey(8)(i, [[255 if (x, y) == (30, 20) else 0 for x in range(64)] for y in range(48)])))
add("matte/first_missing", mattes(lambda i, rows: grey(8)(i, rows) if i else None, exits=(MISSING,)))
add("matte/middle_missing", mattes(lambda i, rows: grey(8)(i, rows) if i != 1 else None, exits=(MISSING,)))
add("matte/all_missing", mattes(lambda i, rows: None, exits=(MISSING, UNREADABLE)))
add("matte/empty_reference", mattes(lambda i, rows: grey(8)(i, rows if i else [[0] * 64] * 48), more=("--reference-frame", "1"),
                                    exits=(OK, USAGE, UNREADABLE)))
for _frame in ("99", "0", "-1", "2147483647", "x"):
    add("matte/reference_" + _frame, mattes(grey(8), more=("--reference-frame", _frame), exits=(USAGE, MISSING)))


def keyframes(words, exits=SURE, says=()):
    def build(shot):
        shot.ordinary(mattes="painted/{}.png")
        yield Step(shot.replace(*words, matte=None), exits=exits, outputs=frames(shot, picture=False), says=says)
    return build


P = "painted/0001.png"
for _name, _words, _exits in (
        ("one", ("--matte", f"1={P}"), SURE), ("two", ("--matte", f"1={P}", "--matte", "3=painted/0003.png"), SURE),
        ("same_twice", ("--matte", f"1={P}", "--matte", f"1={P}"), (OK, USAGE)), ("outside", ("--matte", f"9={P}"), (MISSING, USAGE)),
        ("and_pattern", ("--matte", f"1={P}", "--matte", "painted/####.png"), (USAGE,)), ("no_file", ("--matte", "1="), (USAGE,)),
        ("missing", ("--matte", "1=nosuch.png"), (UNREADABLE, MISSING)), ("no_number", ("--matte", f"={P}"), (USAGE, UNREADABLE, MISSING)),
        ("huge_number", ("--matte", f"99999999999={P}"), (USAGE, MISSING, UNREADABLE)), ("carried_nowhere", (
            "--matte", f"2={P}", "--matte-from", "3", "--matte-to", "1"), (USAGE,)),
        ("steady_nan", ("--matte", f"1={P}", "--matte-stabilize", "nan"), (USAGE,)),
        ("frozen_without_files", ("--matte", f"1={P}", "--matte-frozen", "2"), (USAGE, MISSING, UNREADABLE)),
        ("holdout", ("--matte", f"1={P}", "--holdout", "painted/####.png"), (OK, USAGE, UNREADABLE)),
        ("holdout_missing", ("--matte", f"1={P}", "--holdout", "nosuch/####.png"), (MISSING, UNREADABLE)),
        ("zone", ("--matte", f"1={P}", "--zone", f"light=0.5@1={P}"), SURE),
        ("zone_in_files", ("--matte", f"1={P}", "--zone", "light=0@painted/####.png"), (OK, MISSING)),
        ("zone_missing", ("--matte", f"1={P}", "--zone", "light=0@nosuch.png"), (MISSING, UNREADABLE)),
        ("zone_outside", ("--matte", f"1={P}", "--zone", f"light=0@9={P}"), (MISSING, USAGE)),
        ("zone_without_value", ("--matte", f"1={P}", "--zone", P), (USAGE,)),
        ("zone_nan", ("--matte", f"1={P}", "--zone", f"light=nan@{P}"), (USAGE,)),
        ("zone_of_no_kind", ("--matte", f"1={P}", "--zone", f"fog=1@{P}"), (USAGE,)),
        ("no_matte_at_all", (), (USAGE,))):
    add("keyframe/" + _name, keyframes(_words, _exits))


def texture(make, exits=SURE, option="--texture", name="t.png", more=()):
    def build(shot):
        shot.ordinary()
        made = make(shot) if make else None
        if made is not None:
            shot.put(name, made)
        yield Step(shot.replace(*more, texture=(option, name)), exits=exits, outputs=frames(shot))
    return build


def texture_of(width, height, bits=8, colour=2):
    return png_maker.encode(png_maker.as_colour(noise("t", width, height), bits, colour), bits, colour)


for _option in ("--texture", "--plane"):
    _o = _option[2:]
    for _size in ((1, 1), (2, 3), (1, 200), (200, 1), (13, 11), (33, 95)):
        add(f"texture/{_o}_{_size[0]}x{_size[1]}", texture(lambda s, z=_size: texture_of(*z), SURE if _o == "plane" else (
            OK, UNREADABLE, USAGE), _option))
    for _name, _make in {"grey1": lambda s: texture_of(96, 96, 1, 0), "grey16": lambda s: texture_of(96, 96, 16, 0),
                         "rgba16": lambda s: texture_of(96, 96, 16, 6), "one_colour": lambda s: png_maker.encode([[90, 80, 70] * 96] * 96),
                         "black": lambda s: png_maker.encode([[0, 0, 0] * 96] * 96)}.items():
        add(f"texture/{_o}_{_name}", texture(_make, SURE, _option))
    add(f"texture/{_o}_cmyk", texture(lambda s: raw_makers.jpeg([[(60, 70, 80, 90)] * 12] * 12, adobe=0), EITHER, _option, "t.jpg"))
    add(f"texture/{_o}_turned", texture(lambda s: raw_makers.jpeg([[(x * 15 + y, 128, 128) for x in range(12)] for y in range(9)],
                                                                  exif=raw_makers.exif_orientation(6)), SURE, _option, "t.jpg"))
    add(f"texture/{_o}_nan", texture(lambda s: raw_makers.exr({c: (1, 1, 1, lambda x, y: float("nan")) for c in "RGB"}, (0, 0, 95, 95)),
                                     EITHER + (USAGE,), _option, "t.exr"))
    add(f"texture/{_o}_deep", texture(lambda s: s.tool("oiiotool", "sample.png", "--ch", "R,G,B,A=1,Z=4", "--deepen", "-o", "t.exr") and None,
                                      (UNREADABLE,), _option, "t.exr"))
    add(f"texture/{_o}_missing", texture(None, (UNREADABLE, MISSING), _option))
    add(f"texture/{_o}_text", texture(lambda s: b"not a picture\x1b[31m", (UNREADABLE,), _option))
add("texture/both", texture(lambda s: texture_of(96, 96), (USAGE,), more=("--plane", "tile.png")))
add("texture/none", lambda shot: iter([Step(shot.ordinary().replace(texture=()), exits=(USAGE,))]))
add("texture/no_such_id", lambda shot: iter([Step(shot.ordinary().replace("--db", "none.db", texture=("--texture", "db:0123456789")),
                                                  exits=(USAGE, UNREADABLE), may_write=("none.db*",))]))
add("texture/sixty_four_more", texture(lambda s: texture_of(96, 96), (USAGE,), more=("--texture-also", "sample.png") * 64))


def passes(option, make, exits, name="pass/{}.exr", more=()):
    def build(shot):
        shot.ordinary()
        for index, frame in enumerate(shot.numbers):
            shot.put(name.format(numbered(frame)), make(index))
        yield Step(shot.replace(option, name.replace("{}", "####"), *more), exits=exits, outputs=frames(shot))
    return build


def exr_pass(*channels, value=0.25, size=(64, 48)):
    return lambda i: raw_makers.exr({c: (2, 1, 1, lambda x, y: value) for c in channels}, (0, 0, size[0] - 1, size[1] - 1))


def flo(u, v, size=(64, 48), magic=202021.25):
    return lambda i: struct.pack("<fii", magic, *size) + struct.pack("<2f", u, v) * min(size[0] * size[1], 64 * 48)


NAN = float("nan")
for _option in ("--uv", "--albedo", "--lighting", "--depth-pass", "--lines", "--position-pass"):
    _channels = "RG" if _option == "--uv" else "RGB"
    add(f"pass/{_option[2:]}", passes(_option, exr_pass(*_channels), EITHER + (USAGE,)))
    add(f"pass/{_option[2:]}_nan", passes(_option, exr_pass(*_channels, value=NAN), EITHER + (USAGE,)))
    add(f"pass/{_option[2:]}_wrong_size", passes(_option, exr_pass(*_channels, size=(32, 24)), (UNREADABLE, USAGE)))
    add(f"pass/{_option[2:]}_missing", lambda shot, o=_option: iter([Step(
        shot.ordinary().replace(o, "no/####.exr"), exits=(MISSING, UNREADABLE))]))
for _name, _make, _exits in (("flo", flo(1, 0), SURE), ("flo_nan", flo(NAN, NAN), EITHER + (USAGE,)), ("flo_huge", flo(1e30, 0), EITHER + (USAGE,)),
                             ("flo_wrong_size", flo(1, 0, (63, 48)), (UNREADABLE, USAGE)), ("flo_wrong_magic", flo(1, 0, magic=1.0), (UNREADABLE,)),
                             ("flo_claims", flo(1, 0, (2000000000, 2000000000)), (UNREADABLE, SPACE)),
                             ("flo_negative", flo(1, 0, (-64, -48)), (UNREADABLE,)), ("flo_far", flo(5000, 5000), EITHER + (USAGE,))):
    add("pass/" + _name, passes("--motion", _make, _exits, "pass/{}.flo"))
for _convention in ("nuke", "blender", "moonray", "flame", "arnold"):
    add("pass/motion_" + _convention, passes("--motion", exr_pass("R", "G", "B", value=0.0), EITHER + (USAGE,),
                                             more=("--motion-convention", _convention)))

CORNERS = "10 10 50 10 50 40 10 40"
for _name, _text, _exits in (
        ("text", "".join(f"{f} {CORNERS}\n" for f in (1, 2, 3)), SURE), ("one_frame", f"1 {CORNERS}\n", (MISSING, USAGE, UNREADABLE)),
        ("empty", "", (UNREADABLE,)), ("nan", "1 nan nan 1 1 1 1 1 1\n", (UNREADABLE,)), ("crossed", "1 10 10 50 40 50 10 10 40\n", (UNREADABLE,)),
        ("escapes", "\x1b[2J\x1b]0;pwned\x07 what\n", (UNREADABLE,)), ("password", "root:x:0:0:root:/root:/bin/bash\n", (UNREADABLE,)),
        ("json", '{"schema": "weft.track/1", "frames": [%s]}' % ",".join('{"frame": %d, "corners_px": [%s]}' % (
            f, CORNERS.replace(" ", ",")) for f in (1, 2, 3)), SURE), ("json_other", '{"schema": "other/1"}', (UNREADABLE,)),
        ("json_deep", "[" * 100000, (UNREADABLE,)), ("huge_frame", f"1 {CORNERS}\n2147483647 {CORNERS}\n", EITHER + (USAGE,)),
        ("long_line", "1 " + "9" * 3000000, (UNREADABLE,)), ("nuke", "CornerPin2D {\n to1 {1e999 2}\n}\n", (UNREADABLE,)),
        ("after_effects", "Adobe After Effects 8.0 Keyframe Data\n\n\tUnits Per Second\t24\n\tSource Width\t0\n", (UNREADABLE,))):
    add("track/" + _name, lambda shot, text=_text, exits=_exits: iter([Step(
        shot.ordinary().replace("--track", shot.put("t.txt", text)), exits=exits, outputs=frames(shot), silent=("root:x",))]))
