"""In place of every input in turn: a FIFO, devices, folders, links that dangle, loop or lead elsewhere, an empty file, a socket."""
import json
import os
import socket

from cases import add
from oracle import MISSING, OK, SPACE, UNREADABLE, USAGE, Step
from shot import png

REFUSED = (UNREADABLE, USAGE, MISSING, SPACE)


def fifo(shot, path):
    os.mkfifo(path)


def unix_socket(shot, path):
    # A socket's path may have 107 bytes only, so it is bound relative to its folder.
    bound = socket.socket(socket.AF_UNIX)
    folder = os.open(os.path.dirname(path), os.O_RDONLY)
    try:
        bound.bind(f"/proc/self/fd/{folder}/{os.path.basename(path)}")
    finally:
        os.close(folder)
        bound.close()


def linked(target):
    return lambda shot, path: os.symlink(target, path)


def empty(shot, path):
    open(path, "wb").close()


def endless(shot, path):
    """A sparse file of 8 GB."""
    with open(path, "wb") as file:
        file.truncate(8 << 30)


KINDS = {"fifo": fifo, "socket": unix_socket, "zero": linked("/dev/zero"), "null": linked("/dev/null"), "random": linked("/dev/urandom"),
         "folder": lambda shot, path: os.mkdir(path), "dangling": linked("nowhere/at/all"), "empty": empty, "sparse": endless,
         "self": lambda shot, path: os.symlink(os.path.basename(path), path), "stdin": linked("/dev/stdin")}


def shot_words(*more, **other):
    return lambda shot: shot.replace(*more, **other)


def project_file(shot, name, change):
    project = shot.project()
    change(project)
    shot.put(name, json.dumps(project))


def with_project(*words):
    def build(shot):
        project_file(shot, "shot.weft", lambda p: None)
        return list(words)
    return build


# Input -> (the file's name, the words of the run).
INPUTS = {
    "plate_frame": ("frames/0002.png", shot_words()),
    "plate_file": ("one.png", shot_words(plate="one.png")),
    "plate_movie": ("shot.mp4", shot_words(plate="shot.mp4")),
    "plate_exr": ("one.exr", shot_words(plate="one.exr")),
    "matte_frame": ("masks/0002.png", shot_words()),
    "painted_matte": ("a.png", shot_words("--matte", "1=a.png", matte=None)),
    "holdout": ("h.png", shot_words("--holdout", "h.png")),
    "zone": ("z.png", shot_words("--zone", "light=0@z.png")),
    "texture": ("t.png", shot_words(texture=("--texture", "t.png"))),
    "texture_also": ("t.png", shot_words("--texture-also", "t.png", texture=("--texture", "sample.png"))),
    "plane": ("t.exr", shot_words(texture=("--plane", "t.exr"))),
    "light": ("light.png", shot_words("--light", "light.png")),
    "albedo": ("p.exr", shot_words("--albedo", "p.exr")),
    "lighting": ("p.exr", shot_words("--lighting", "p.exr")),
    "depth_pass": ("p.exr", shot_words("--depth-pass", "p.exr")),
    "lines": ("p.png", shot_words("--lines", "p.png")),
    "uv": ("p.exr", shot_words("--uv", "p.exr")),
    "position_pass": ("p.exr", shot_words("--position-pass", "p.exr")),
    "motion": ("flow/0001.flo", shot_words("--motion", "flow/####.flo")),
    "motion_pass": ("flow/0001.exr", shot_words("--motion", "flow/####.exr", "--motion-convention", "nuke")),
    "track": ("t.txt", shot_words("--track", "t.txt")),
    "crypto": ("c.exr", shot_words("--matte", "crypto:*", "--crypto-files", "c.exr", matte=None)),
    "library": ("lib.db", shot_words("--db", "lib.db", texture=("--texture", "db:0123456789"))),
    "project": ("p.weft", lambda shot: ["render", "p.weft"]),
    "validated": ("p.weft", lambda shot: ["validate", "p.weft"]),
    "info": ("p.weft", lambda shot: ["info", "p.weft"]),
    "changed": ("p.weft", lambda shot: ["region", "add", "p.weft", "--name", "x"]),
    "actions": ("a.json", with_project("apply", "shot.weft", "a.json")),
    "look": ("l.json", with_project("look", "apply", "l.json", "shot.weft")),
    "recipe": ("r.json", lambda shot: ["verify", "r.json"]),
    "job": ("job.json", lambda shot: ["task", "job.json", "frames", "0"]),
    "synth": ("t.png", lambda shot: ["synth", "t.png", "-o", "out/p.png", "--size", "64x64"]),
    "diff": ("t.png", lambda shot: ["diff", "t.png", "tile.png"]),
    "cryptomatte": ("c.exr", lambda shot: ["cryptomatte", "c.exr"]),
    "measure": ("t.png", lambda shot: ["measure", "--result", "t.png", "--plate", "frames/####.png", "--matte", "masks/####.png"]),
    "imported": ("new/t.png", lambda shot: ["texture", "import", "new", "--db", "../home/lib.db", "--material", "wood"]),
}
for _name in INPUTS:
    # An import goes on with the other pictures; draft quality looks at no depth.
    _exits = REFUSED + ((OK,) if _name in ("imported", "depth_pass") else ())
    for _kind, _make in KINDS.items():
        def build(shot, name=_name, make=_make, exits=_exits):
            path, words = INPUTS[name]
            shot.ordinary()
            os.makedirs(os.path.dirname(shot.path(path)), exist_ok=True)
            if os.path.lexists(shot.path(path)):
                os.remove(shot.path(path))
            spoken = words(shot)
            make(shot, shot.path(path))
            yield Step(spoken, exits=exits, seconds=20)
        add(f"special/{_name}_{_kind}", build)
del build


def out_is(make, exits):
    """The folder or a frame of the output is something else."""
    def build(shot):
        shot.ordinary()
        make(shot)
        yield Step(shot.replace(), exits=exits)
        yield Step(shot.replace("--overwrite"), exits=exits + (OK,), may_write=("out/**",))
    return build


def made(folder, kind, name):
    def make(shot):
        if folder:
            shot.folder(folder)
        KINDS[kind](shot, shot.path(name))
    return make


for _kind in KINDS:
    if _kind not in ("sparse", "folder"):
        add(f"special/out_folder_{_kind}", out_is(made("", _kind, "out"), (UNREADABLE, USAGE, SPACE)))
    if _kind not in ("sparse",):
        add(f"special/out_frame_{_kind}", out_is(made("out", _kind, "out/0002.png"), (USAGE, UNREADABLE)))


def unused(shot):
    """Damage on frames that nothing asks for."""
    shot.ordinary(numbers=range(1, 9))
    os.remove(shot.path("frames/0007.png"))
    shot.link("nowhere", "frames/0007.png")
    shot.put("frames/0008.png", shot.get("frames/0006.png")[:40])
    yield Step(shot.replace("--frames", "1-3"))


add("special/unused_frames", unused)
