"""Files cut off or with flipped bits, in the place of every kind of input."""
import json
import os

from cases import add
from oracle import MISSING, OK, SPACE, UNREADABLE, USAGE, Step

ANY = (OK, UNREADABLE, USAGE, MISSING, SPACE)


def cut(shot, data):
    return data[:shot.chance.randrange(1, len(data))]


def flipped(shot, data):
    data = bytearray(data)
    for _ in range(shot.chance.choice((1, 3, 20))):
        data[shot.chance.randrange(len(data))] ^= 1 << shot.chance.randrange(8)
    return bytes(data)


def head_flipped(shot, data):
    data = bytearray(data)
    for _ in range(shot.chance.choice((1, 2, 5))):
        data[shot.chance.randrange(min(400, len(data)))] = shot.chance.choice((0, 1, 127, 128, 255))
    return bytes(data)


def spliced(shot, data):
    """A part stands twice."""
    at, count = shot.chance.randrange(len(data)), shot.chance.randrange(1, 200)
    return data[:at] + data[at:at + count] + data[at:]


DAMAGE = {"cut": cut, "flipped": flipped, "head": head_flipped, "spliced": spliced}
PLATES = {"png": (".png", ()), "png16": (".png", ("-d", "uint16")), "jpg": (".jpg", ()), "tif": (".tif", ("--compression", "lzw")),
          "tiled": (".tif", ("--tile", "16", "16", "--compression", "zip")), "dpx": (".dpx", ()), "exr_zip": (".exr", ("-d", "half")),
          "exr_piz": (".exr", ("-d", "half", "--compression", "piz")), "exr_b44": (".exr", ("-d", "half", "--compression", "b44")),
          "exr_dwaa": (".exr", ("-d", "half", "--compression", "dwaa")), "exr_tiled": (".exr", ("-d", "float", "--tile", "16", "16"))}


def damaged_plate(kind, damage):
    def build(shot):
        extension, options = PLATES[kind]
        shot.converted(extension, *options)
        name = "frames/0002" + extension
        shot.put(name, DAMAGE[damage](shot, shot.get(name)))
        yield Step(shot.replace(plate="frames/####" + extension, out="out/####" + extension), exits=ANY, seconds=30)
    return build


for _kind in PLATES:
    for _damage in DAMAGE:
        add(f"damage/{_kind}_{_damage}", damaged_plate(_kind, _damage))


def damaged_input(words, name, damage):
    """Another input of a run: a file made by Weft or by `ordinary`."""
    def build(shot):
        shot.ordinary()
        shot.put("shot.weft", json.dumps(shot.project(), indent=1))
        shot.put("actions.json", json.dumps([{"action": "set_region_parameter", "region": "wall", "key": "placement.scale", "value": 2}]))
        if "out" in name:
            yield Step(["render", "shot.weft", "--threads", "1", "--recipe", "out/r.json"])
        if name == "brick.look.json":
            yield Step(["look", "save", "shot.weft", name, "--region", "wall"], may_write=(name,))
        if name.startswith("job/"):
            yield Step(["submit", "shot.weft", "--to", "openjd", "-o", "job"], may_write=("job", "job/**"))
        shot.put(name, DAMAGE[damage](shot, shot.get(name)))
        yield Step(list(words) if words else shot.replace(), exits=ANY + (8, 1), may_write=("out", "out/**", "job/**", "shot.weft"), seconds=30)
    return build


for _name, _words in {"masks/0002.png": (), "tile.png": (), "shot.weft": ("render", "shot.weft"), "actions.json": ("apply", "shot.weft", "actions.json"),
                      "out/r.json": ("verify", "out/r.json", "--quick"), "out/0002.png": ("render", "shot.weft", "--resume"),
                      "brick.look.json": ("look", "apply", "brick.look.json", "shot.weft"), "job/job.json": ("task", "job/job.json", "frames", "0")}.items():
    for _damage in DAMAGE:
        add(f"damage/{_name.replace('/', '_')}_{_damage}", damaged_input(_words, _name, _damage))


def cache(damage):
    """A damaged cache is made again: the frames are the same."""
    def build(shot):
        shot.ordinary()
        yield Step(shot.replace())
        whole = shot.get("out/0003.png")
        for folder, _, names in os.walk(os.path.join(shot.root, "home")):
            for name in names:
                path = os.path.join(folder, name)
                with open(path, "rb") as file:
                    data = file.read()
                if data:
                    with open(path, "wb") as file:
                        file.write(DAMAGE[damage](shot, data))
        yield Step(shot.replace("--overwrite"))
        assert shot.get("out/0003.png") == whole, "a damaged cache changed the picture"
    return build


for _damage in DAMAGE:
    add("damage/cache_" + _damage, cache(_damage))
