"""Every file that Weft writes, put onto every input: refused, with --overwrite too, and nothing is touched."""
import json
import os

from cases import add, frames
from oracle import DIFFERS, OK, UNREADABLE, USAGE, Output, Step
from shot import numbered, png

# Input -> a name of one file of it.
INPUTS = {"plate": "frames/0002.png", "matte": "masks/0001.png", "plane": "tile.png", "project": "shot.weft", "holdout": "holdout.png",
          "zone": "zone.png", "track": "track.txt"}


def prepared(shot):
    shot.ordinary()
    shot.put("holdout.png", png("matte", 0))
    shot.put("zone.png", png("matte", 0))
    shot.put("track.txt", "".join(f"{f} 10 10 50 10 50 40 10 40\n" for f in shot.numbers))
    project = shot.project()
    project["regions"][0]["holdouts"] = [{"files": "holdout.png", "invert": True}]
    project["regions"][0]["zones"] = [{"value": 0.5, "matte": {"files": "zone.png"}}]
    project["regions"][0]["motion"] = {"track": "track.txt"}
    shot.put("shot.weft", json.dumps(project))


def direct(shot, target, suffix):
    return target


def by_link(shot, target, suffix):
    os.symlink(os.path.join("..", target), shot.path("links/x" + suffix))
    return "links/x" + suffix


def by_dots(shot, target, suffix):
    return f"./masks/../{target}"



WAYS = {"": direct, "_by_link": by_link, "_by_dots": by_dots, "_absolute": lambda shot, target, suffix: shot.path(target)}
# Written file -> the option that names it, and what its name ends in (None: as it is).
WRITTEN = {"report": ("--report", None), "recipe": ("--recipe", None)}
for _written, (_option, _suffix) in WRITTEN.items():
    for _input, _target in INPUTS.items():
        for _way, _make in WAYS.items() if _input in ("plate", "project") else [("", direct)]:
            for _overwrite in ((), ("--overwrite",)):
                def build(shot, option=_option, target=_target, make=_make, overwrite=_overwrite):
                    prepared(shot)
                    shot.folder("links")
                    name = make(shot, target, os.path.splitext(target)[1])
                    # A link in the place of an output is replaced where that is allowed: its target stays.
                    exits = (USAGE,) if make is not by_link or not overwrite else (USAGE, OK)
                    yield Step(["render", "shot.weft", "--threads", "1", option, name, *overwrite], exits=exits,
                               may_write=("out", "out/**", "links/**"))
                add(f"onto/{_written}_{_input}{_way}{'_overwrite' if _overwrite else ''}", build)
del build


def frames_onto(name, out, more=(), exits=(USAGE,), prepare=lambda shot: None, may_write=("out", "out/**")):
    def build(shot):
        prepared(shot)
        prepare(shot)
        for overwrite in ((), ("--overwrite",), ("--resume",), ("--skip-existing",), ("--restart",)):
            yield Step(["render", "shot.weft", "--threads", "1", "-o", out, *more, *overwrite], exits=exits, may_write=may_write)
    add("onto/frames_" + name, build)


frames_onto("plate", "frames/####.png")
frames_onto("plate_unpadded", "./frames/../frames/####.png")
frames_onto("mattes", "masks/####.png")
frames_onto("plate_by_folder_link", "linked/####.png", prepare=lambda s: s.link("frames", "linked"))
frames_onto("plane_file", "tile.png")
frames_onto("holdout_file", "holdout.png")
frames_onto("zone_file", "zone.png")
frames_onto("layers_onto_mattes", "out/####.png", ("--layers", "matte", "--layers-output", "masks/####.exr"), (OK, USAGE),
            may_write=("out", "out/**", "masks/*.exr"))
frames_onto("textures_folder", "tex/####.png", exits=(USAGE,), prepare=lambda s: (s.put("tex/0002.png", png("texture", 0, (48, 48))), s.put(
    "shot.weft", s.get("shot.weft").replace(b'"tile.png"', b'"tex/0002.png"'))))
frames_onto("second_texture", "tex/####.png", exits=(USAGE,), prepare=lambda s: (s.put("tex/0002.png", s.get("sample.png")), s.put(
    "shot.weft", s.get("shot.weft").replace(b'"plane": "tile.png"', b'"sample": "sample.png", "also": ["tex/0002.png"]'))))
frames_onto("light_picture", "lamp/####.png", exits=(USAGE,), prepare=lambda s: (s.put("lamp/0002.png", png("plate", 0)), s.put(
    "shot.weft", s.get("shot.weft").replace(b'"texture"', b'"light": {"source": "image", "image": "lamp/0002.png"}, "texture"'))))


def movie_onto(target, kind):
    def build(shot):
        shot.movie("plate.mkv", "-c:v", "ffv1")
        shot.put("notes.mkv", "notes")
        shot.link("plate.mkv", "link.mkv")
        for overwrite in ((), ("--overwrite",)):
            exits = (USAGE,) if kind == "input" or not overwrite else (OK,)
            yield Step(shot.replace("--movie", target, *overwrite, plate="plate.mkv"), exits=exits, may_write=("out", "out/**", target))
    return build


add("onto/movie_plate", movie_onto("plate.mkv", "input"))
add("onto/movie_plate_link", movie_onto("link.mkv", "input"))
add("onto/movie_other", movie_onto("notes.mkv", "other"))


def onto_existing(words, name, prepare=prepared, exits=(USAGE,), again=True, done=(OK,)):
    """A file that is there: refused without --overwrite, replaced with it."""
    def build(shot):
        prepare(shot)
        shot.put(name, "precious")
        yield Step([*words], exits=exits)
        assert shot.get(name) == b"precious"
        if again:
            yield Step([*words, "--overwrite"], exits=done, may_write=("out", "out/**", name), outputs=[Output(name)])
            assert shot.get(name) != b"precious"
    return build


RENDER = ("render", "shot.weft", "--threads", "1")
for _name, _words, _file in (
        ("report", (*RENDER, "--report", "out/r.json"), "out/r.json"), ("recipe", (*RENDER, "--recipe", "out/r.json"), "out/r.json"),
        ("movie", (*RENDER, "--movie", "out/r.mp4"), "out/r.mp4"), ("frame", RENDER, "out/0002.png"),
        ("layers", (*RENDER, "--layers", "all", "--layers-output", "out/l.####.exr"), "out/l.0002.exr"),
        ("synth", ("synth", "sample.png", "-o", "out/p.png", "--size", "64x64"), "out/p.png"),
        ("source_map", ("synth", "sample.png", "-o", "out/p.png", "--size", "64x64", "--source-map", "out/m.exr"), "out/m.exr"),
        ("look", ("look", "save", "shot.weft", "out/l.json", "--region", "wall"), "out/l.json"),
        ("matte", ("matte", "--plate", "frames/####.png", "--matte", "1=masks/0001.png", "-o", "out/####.png"), "out/0002.png")):
    add("existing/" + _name, onto_existing(_words, _file))


def new_onto_notes(shot):
    """--overwrite replaces a project, and nothing that only has its name."""
    prepared(shot)
    shot.put("n.weft", "precious")
    words = ["new", "n.weft", "--plate", "frames/####.png", "-o", "x/####.png"]
    for more in ([], ["--overwrite"]):
        yield Step([*words, *more], exits=(USAGE,))
    assert shot.get("n.weft") == b"precious"
    os.remove(shot.path("n.weft"))
    yield Step(words, may_write=("n.weft",), outputs=[Output("n.weft")])
    yield Step(words, exits=(USAGE,))
    yield Step([*words, "--overwrite"], may_write=("n.weft",), outputs=[Output("n.weft")])


add("existing/new", new_onto_notes)


def two_sequences(shot):
    prepared(shot)
    for frame in shot.numbers:
        shot.put(f"other/{frame:04d}.png", png("plate", frame + 1))


add("existing/worst", onto_existing(("diff", "frames/####.png", "other/####.png", "--matte", "masks/####.png", "--worst", "out/w.png"),
                                    "out/w.png", prepare=two_sequences, done=(DIFFERS,)))


def self_overwriting(words):
    def build(shot):
        prepared(shot)
        shot.put("sheet.json", "{}")
        yield Step([*words], exits=(USAGE,))
        yield Step([*words, "--overwrite"], exits=(USAGE,))
    return build


for _name, _words in {"synth": ("synth", "sample.png", "-o", "sample.png", "--size", "96x96"), "synth_map": (
        "synth", "sample.png", "-o", "out/p.png", "--source-map", "sample.png"), "synth_second": (
        "synth", "sample.png", "tile.png", "-o", "tile.png", "--size", "96x96"), "synth_light": (
        "synth", "sample.png", "-o", "tile.png", "--light", "tile.png", "--size", "64x64"),
        "matte": ("matte", "--plate", "frames/####.png", "--matte", "1=masks/0001.png", "-o", "masks/####.png"),
        "matte_plate": ("matte", "--plate", "frames/####.png", "--matte", "1=masks/0001.png", "-o", "frames/####.png"),
        "look_project": ("look", "save", "shot.weft", "shot.weft", "--region", "wall"),
        "look_texture": ("look", "save", "shot.weft", "tile.png", "--region", "wall"),
        "new_plate": ("new", "frames/0001.png", "--plate", "frames/####.png", "-o", "x/####.png"),
        "worst": ("diff", "frames/####.png", "frames/####.png", "--matte", "masks/####.png", "--worst", "frames/0001.png"),
        "study": ("study", "--plate", "frames/####.png", "--matte", "masks/####.png", "--texture", "sample.png", "-o", "frames", "--methods", "still"),
        "measure": ("measure", "--result", "frames/####.png", "--plate", "frames/####.png", "--matte", "masks/####.png", "--report", "frames/0001.png"),
        }.items():
    add("onto/self_" + _name, self_overwriting(_words))


def links_in_output(shot):
    """A link among the output's frames is replaced; what it leads to stays."""
    shot.ordinary()
    shot.put("precious.png", png("plate", 0, (10, 10)))
    shot.folder("out")
    for frame in shot.numbers:
        shot.link("../precious.png", f"out/{numbered(frame)}.png")
    yield Step(shot.replace(), exits=(USAGE,))
    yield Step(shot.replace("--overwrite"), outputs=frames(shot))
    assert not os.path.islink(shot.path("out/0001.png"))


add("existing/links", links_in_output)


def foreign(option, exits, junk):
    def build(shot):
        shot.ordinary()
        shot.put("out/0002.png", junk)
        yield Step(shot.replace(option), exits=exits)
    return build


for _label, _junk in {"picture": png("plate", 1), "other_size": png("plate", 1, (10, 10)), "text": b"notes", "empty": b""}.items():
    add("existing/resume_" + _label, foreign("--resume", (USAGE,), _junk))
    add("existing/skip_" + _label, foreign("--skip-existing", (OK, USAGE, UNREADABLE), _junk))
add("existing/contradiction", lambda shot: iter([Step(shot.ordinary().replace("--overwrite", "--skip-existing"), exits=(USAGE,))]))
