"""Every format and depth that is written, resumed and skipped runs, and folders that cannot be written."""
import os

from cases import add, frames
from oracle import OK, SPACE, UNREADABLE, USAGE, Output, Step
from shot import numbered



def linear(plate, extension, more):
    """Whether a format holds linear values by default: an EXR does, and a TIFF of floating point."""
    return extension == ".exr" or (extension == ".tif" and (plate == ".exr" or "float" in more))


def written(extension, more=(), exits=(OK,), plate=".png", depth=None):
    def build(shot):
        if plate == ".png":
            shot.ordinary()
        else:
            shot.converted(plate, *(("-d", depth) if depth else ()), linear=plate == ".exr")
        outputs = frames(shot, "out/{}" + extension, "1" not in more, linear=linear(plate, extension, more), tolerance=10)
        yield Step(shot.replace(*more, plate="frames/####" + plate, out="out/####" + extension), exits=exits, outputs=outputs)
    return build


for _extension, _depths in {".png": ("8", "16"), ".jpg": ("8",), ".tif": ("8", "16", "float"), ".exr": ("half", "float"), ".dpx": ("8", "16")}.items():
    for _plate, _kind in ((".png", "uint8"), (".png", "uint16"), (".tif", "uint16"), (".exr", "half"), (".exr", "float"), (".jpg", None)):
        if _kind != "uint16" or _plate == ".tif":
            add(f"output/{_plate[1:]}_{_kind}_to_{_extension[1:]}", written(_extension, (), plate=_plate, depth=_kind))
    for _depth in ("8", "16", "half", "float"):
        add(f"output/{_extension[1:]}_depth_{_depth}", written(_extension, ("--depth", _depth), (OK,) if _depth in _depths else (USAGE,)))
for _extension in (".gif", ".bmp", ".webp", ".psd", ".txt", "", ".png.exe", ".PNG", ".jpeg", ".tiff", ".weft", ".json", ".mp4"):
    _good = _extension in (".PNG", ".jpeg", ".tiff")
    add(f"output/extension_{_extension[1:] or 'none'}", written(_extension, (), (OK, USAGE) if _good else (USAGE,)))
for _quality in ("1", "100", "0", "101", "-5", "nan", "95.5"):
    add("output/quality_" + _quality, written(".jpg", ("--jpeg-quality", _quality), (OK,) if _quality in ("1", "100") else (USAGE,)))
for _name in ("zip9", "", "lossless", "ZIP"):
    add("output/compression_" + (_name or "nothing"), written(".exr", ("--exr-compression", _name), (OK, USAGE) if _name == "ZIP" else (USAGE,)))


def spaces(option, space, exits):
    def build(shot):
        shot.ordinary()
        yield Step(shot.replace(option, space), exits=exits, outputs=frames(shot, picture=False))
    return build


for _option in ("--plate-space", "--texture-space", "--out-space", "--working-space"):
    for _space in ("srgb", "linear", "nosuch", "", "../../etc/passwd", "\x1b[2J"):
        _known = _space in ("srgb", "linear")
        add(f"space/{_option[2:]}_{_space if _space.isalnum() else 'odd' + str(len(_space))}",
            spaces(_option, _space, (OK,) if _known else (OK, USAGE) if not _space else (USAGE, UNREADABLE)))


def config(text, exits):
    def build(shot):
        shot.ordinary()
        path = shot.put("config.ocio", text)
        yield Step(shot.replace("--plate-space", "ACEScg"), exits=exits, environment={"OCIO": path})
    return build


for _name, _text in {"empty": "", "text": "no config", "deep": "[" * 50000, "missing_file": "ocio_profile_version: 2\nroles: {default: a}\n"
                     "displays: {}\ncolorspaces:\n  - !<ColorSpace> {name: ACEScg, from_reference: !<FileTransform> {src: nosuch.spi1d}}\n"}.items():
    add("space/config_" + _name, config(_text, (UNREADABLE, USAGE)))
add("space/config_is_missing", lambda shot: iter([Step(shot.ordinary().replace(), exits=(OK, UNREADABLE, USAGE), environment={"OCIO": "/no/such"})]))


def resumed(extension, plate=".png"):
    """Frames that go missing or are cut off come back with the same bytes."""
    def build(shot):
        if plate == ".png":
            shot.ordinary()
        else:
            shot.converted(plate, linear=True)
        words = shot.replace(plate="frames/####" + plate, out="out/####" + extension)
        yield Step(words)
        whole = [shot.get(f"out/{numbered(f)}{extension}") for f in shot.numbers]
        os.remove(shot.path("out/0001" + extension))
        yield Step([*words, "--resume"], outputs=frames(shot, "out/{}" + extension, picture=False))
        shot.put("out/0002" + extension, whole[1][:len(whole[1]) // 2])
        yield Step([*words, "--skip-existing"], exits=(OK, USAGE, UNREADABLE), outputs=frames(shot, "out/{}" + extension, picture=False))
        yield Step([*words, "--overwrite"], outputs=frames(shot, "out/{}" + extension, picture=False))
        assert whole == [shot.get(f"out/{numbered(f)}{extension}") for f in shot.numbers], "other bytes"
        yield Step([*words, "--resume", "--seed", "5"], outputs=frames(shot, "out/{}" + extension, picture=False))
        yield Step([*words, "--version-up"], exits=(USAGE,))
    return build


for _extension in (".png", ".jpg", ".tif", ".exr", ".dpx"):
    add("resume/" + _extension[1:], resumed(_extension))
    add("resume/exr_to_" + _extension[1:], resumed(_extension, ".exr"))


def versions(shot):
    shot.ordinary()
    words = shot.replace("--version-up", out="out/v001/sh_v001.####.png")
    yield Step(words)
    yield Step(words, outputs=[Output("out/v002/sh_v002.0001.png", size=shot.size)])
    shot.put("out/v2147483647/x.png", "x")
    yield Step(words, exits=(OK, USAGE))


add("output/version_up", versions)


def folder_is(make, exits, out="out/####.png"):
    def build(shot):
        shot.ordinary()
        make(shot)
        yield Step(shot.replace(out=out), exits=exits)
        yield Step(shot.replace("--report", out.replace("####.png", "r.json"), out="fine/####.png"), exits=exits + (OK,), may_write=("fine", "fine/**"))
    return build


add("output/folder_is_a_file", folder_is(lambda s: s.put("out", "a file"), (UNREADABLE, USAGE, SPACE)))
add("output/below_a_file", folder_is(lambda s: s.put("out", "a file"), (UNREADABLE, USAGE, SPACE), "out/a/b/####.png"))
add("output/below_the_plate", folder_is(lambda s: None, (UNREADABLE, USAGE), "frames/0001.png/####.png"))
add("output/in_proc", folder_is(lambda s: None, (UNREADABLE, USAGE, SPACE), "/proc/weft/####.png"))
add("output/on_a_full_device", folder_is(lambda s: None, (UNREADABLE, USAGE, SPACE), "/dev/full/####.png"))
add("output/name_too_long", folder_is(lambda s: None, (UNREADABLE, USAGE), "out/" + "n" * 300 + "####.png"))
add("output/path_too_long", folder_is(lambda s: None, (UNREADABLE, USAGE), "out/" + "n/" * 3000 + "####.png"))
add("output/deep_folder", lambda shot: iter([Step(shot.ordinary().replace(out="out/" + "n/" * 60 + "####.png"), outputs=frames(
    shot, "out/" + "n/" * 60 + "{}.png"))]))
add("output/one_name_for_all", lambda shot: iter([Step(shot.ordinary().replace(out="out/one.png"), exits=(USAGE,))]))
add("output/dry_run", lambda shot: iter([Step(shot.ordinary().replace("--dry-run"), may_write=()), Step(
    shot.ordinary().replace("--dry-run", "--json"), may_write=())]))
for _memory in ("1", "0", "-1", "1K", "10M", "600M", "1T", "x", "1e99", "99999999999999999999G"):
    add("output/memory_" + _memory, lambda shot, m=_memory: iter([Step(shot.ordinary().replace("--memory", m), exits=(
        (OK,) if m in ("0", "600M", "1T") else (SPACE, USAGE, OK) if m == "10M" else (SPACE, USAGE)), outputs=frames(shot))]))
for _cache, _exits in {"frames": (OK, USAGE, UNREADABLE), "tile.png": (OK, USAGE, UNREADABLE), "/proc/x": (OK, UNREADABLE), "": (OK, USAGE)}.items():
    add(f"output/cache_at_{_cache.replace('/', '_') or 'nothing'}", lambda shot, c=_cache, e=_exits: iter([Step(
        shot.ordinary().replace("--cache", c), exits=e, may_write=("out", "out/**", "frames/**"))]))
add("output/recipe_in_new_folder", lambda shot: iter([Step(shot.ordinary().replace("--recipe", "out/a/b/r.json", "--report", "out/c/d/r.json"),
                                                           outputs=frames(shot) + [Output("out/a/b/r.json"), Output("out/c/d/r.json")])]))
