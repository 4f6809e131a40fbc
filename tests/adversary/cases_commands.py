"""Ordinary and odd uses of the other commands: synth, measure, diff, look, collect, submit, task, verify, cryptomatte, texture."""
import json
import os
import struct

import raw_makers
from cases import add, case, frames
from oracle import DIFFERS, MISSING, OK, POLICY, SPACE, UNREADABLE, USAGE, Output, Step
from shot import numbered, png

JOB = ("out", "out/**")


def projected(shot, change=lambda project: None, name="shot.weft"):
    shot.ordinary()
    project = shot.project()
    change(project)
    shot.put(name, json.dumps(project))
    return shot


def synth(name, size, *more, exits=(OK,), out="out/p.png", sample="sample.png", seconds=60):
    def build(shot):
        shot.ordinary()
        pixels = tuple(int(v) for v in size.split("x")) if size.replace("x", "").isdigit() and size.count("x") == 1 else None
        yield Step(["synth", *sample.split(), "-o", out, "--size", size, "--threads", "1", *more], exits=exits, seconds=seconds,
                   outputs=[Output(out, size=pixels)])
    add("synth/" + name, build)


for _size in ("1x1", "2x300", "97x53", "128x128"):
    synth("size_" + _size, _size)
for _size in ("0x0", "-1x5", "16385x1", "1e3x2", "99999999999x1", "x", "", "64", "64x64x64", "nanxnan"):
    synth("bad_size_" + _size, _size, exits=(USAGE,))
for _name, _more in {"tileable": ("--tileable",), "rotations": ("--rotations", "--mirror"), "dp": ("--seam", "dp"), "none": ("--seam", "none"),
                     "paper": ("--seam-cost", "paper"), "no_align": ("--no-align",), "endless": ("--endless", "--at", "-70000,90000"),
                     "light": ("--light", "tile.png"), "map": ("--source-map", "out/m.exr"), "feather": ("--feather", "5")}.items():
    synth(_name, "120x80", *_more)
for _name, _out in {"exr": "out/p.exr", "tif": "out/p.tif", "jpg": "out/p.jpg", "dpx": "out/p.dpx"}.items():
    synth(_name, "64x64", out=_out, exits=(OK, USAGE) if _name == "dpx" else (OK,))
for _name, _more in {"endless_tileable": ("--endless", "--tileable"), "at_far": ("--endless", "--at", "9999999999,0"), "isa": ("--isa", "neon"),
                     "light_missing": ("--light", "nosuch.png"), "weight_nan": ("--light-weight", "nan"), "overlap": ("--overlap", "1000000")}.items():
    synth("bad_" + _name, "64x64", *_more, exits=(USAGE, UNREADABLE, MISSING))
synth("same_twice", "64x64", sample="sample.png sample.png", exits=(OK, USAGE))
synth("tiny_sample", "64x64", sample="tiny.png", exits=(UNREADABLE, USAGE, MISSING))
synth("to_a_movie", "64x64", out="out/p.mp4", exits=(USAGE,))


@case("diff/same_and_other")
def diff(shot):
    shot.ordinary()
    yield Step(["diff", "frames/####.png", "frames/####.png"])
    yield Step(["diff", "frames/####.png", "masks/####.png", "--json"], exits=(DIFFERS,))
    yield Step(["diff", "frames/0001.png", "tile.png"], exits=(UNREADABLE, USAGE, DIFFERS))
    yield Step(["diff", "frames/####.png", "frames/0001.png"], exits=(DIFFERS, USAGE, MISSING))
    yield Step(["diff", "frames/####.png", "frames/####.png", "--tolerance", "nan"], exits=(USAGE,))
    yield Step(["diff", "frames/####.png", "frames/####.png", "--frames", "9"], exits=(MISSING, USAGE))
    yield Step(["diff", "frames/####.png", "masks/####.png", "--matte", "masks/####.png", "--worst", "out/w.png"], exits=(DIFFERS,),
               outputs=[Output("out/w.png")])


@case("measure/result")
def measure(shot):
    shot.ordinary()
    yield Step(shot.replace())
    words = ["measure", "--result", "out/####.png", "--plate", "frames/####.png", "--matte", "masks/####.png"]
    yield Step([*words, "--json"])
    yield Step([*words, "--frames", "1"], exits=(OK, USAGE))
    yield Step([*words[:2], "masks/no.####.png", *words[3:]], exits=(MISSING, UNREADABLE, USAGE))
    yield Step([*words[:2], "tile.png", *words[3:], "--json"], exits=(MISSING, UNREADABLE, USAGE))


@case("matte/propagated")
def propagated(shot):
    shot.ordinary()
    words = ["matte", "--plate", "frames/####.png", "--matte", "1=masks/0001.png", "--threads", "1", "-o", "out/####.png"]
    yield Step([*words, "--json"], outputs=frames(shot, picture=False)[:0] + [Output(f"out/{numbered(f)}.png", size=shot.size) for f in shot.numbers])
    yield Step(words, exits=(USAGE,))
    yield Step([*words[:-1], "out/####.jpg"], exits=(USAGE,))
    yield Step([*words[:-1], "out/one.png"], exits=(USAGE,))


@case("look/carried")
def look(shot):
    projected(shot)
    projected(shot, lambda p: p["regions"][0].update(name="floor"), "other.weft")
    yield Step(["look", "save", "shot.weft", "out/l.json", "--region", "wall"], outputs=[Output("out/l.json")])
    yield Step(["look", "apply", "out/l.json", "other.weft"], may_write=("other.weft",), exits=(OK, USAGE))
    yield Step(["look", "apply", "out/l.json", "other.weft", "--region", "nosuch\x1b[2J"], exits=(USAGE,))
    yield Step(["look", "save", "shot.weft", "out/m.json", "--region", "nosuch"], exits=(USAGE,))
    yield Step(["look", "apply", "shot.weft", "other.weft"], exits=(UNREADABLE, USAGE))
    yield Step(["look", "apply", "out/l.json", "nosuch.weft"], exits=(UNREADABLE, MISSING))


@case("collect/gathered")
def collect(shot):
    projected(shot)
    yield Step(["collect", "shot.weft", "out/all"], outputs=[Output("out/all/shot.weft")])
    yield Step(["render", "out/all/shot.weft", "--threads", "1"])
    yield Step(["collect", "shot.weft", "out/all"], exits=(USAGE, OK), may_write=())
    yield Step(["collect", "shot.weft", "frames"], exits=(USAGE, OK, UNREADABLE), may_write=("frames/shot.weft", "frames/files", "frames/files/**"))
    yield Step(["collect", "shot.weft", "tile.png"], exits=(USAGE, UNREADABLE), may_write=())
    yield Step(["collect", "shot.weft", "."], exits=(USAGE, UNREADABLE), may_write=())


for _engine in ("openjd", "slurm", "deadline", "opencue", "flamenco"):
    def build(shot, engine=_engine):
        projected(shot)
        yield Step(["submit", "shot.weft", "--to", engine, "-o", "out/job", "--chunk", "2"], outputs=[Output("out/job/job.json")])
        job = shot.get("out/job/job.json")
        yield Step(["submit", "shot.weft", "--to", engine, "-o", "out/job"], exits=(USAGE, OK), may_write=JOB)
        shot.put("out/job/job.json", job)
        stages = json.loads(job)
        assert stages, "an empty job"
        for stage, index in (("motion", 0), ("motion", 1), ("analyse", 0), ("planes", 0), ("frames", 0), ("frames", 1)):
            yield Step(["task", "out/job/job.json", stage, str(index)], exits=(OK, USAGE) if stage == "motion" else (OK,))
        yield Step(["task", "out/job/job.json", "frames", "99"], exits=(USAGE, MISSING))
        yield Step(["task", "out/job/job.json", "nosuch\x1b[2J", "0"], exits=(USAGE,))
        yield Step(["task", "out/job/job.json", "frames", "-1"], exits=(USAGE,))
    add("farm/" + _engine, build)
del build


@case("farm/frozen_snapshot")
def snapshot(shot):
    """A project that is changed after its submission does not change the job."""
    projected(shot)
    yield Step(["submit", "shot.weft", "--to", "openjd", "-o", "job", "--chunk", "1"], may_write=("job", "job/**"))
    for stage, count in (("motion", 3), ("analyse", 1), ("planes", 1)):
        for index in range(count):
            yield Step(["task", "job/job.json", stage, str(index)], exits=(OK, USAGE), may_write=("job/**", "out", "out/**"))
    yield Step(["task", "job/job.json", "frames", "0"], may_write=("job/**", "out", "out/**"))
    before = shot.get("out/0001.png")
    yield Step(["region", "set", "shot.weft", "wall", "--rotate", "45"], may_write=("shot.weft",))
    for index in (0, 1, 2):
        yield Step(["task", "job/job.json", "frames", str(index)], may_write=("job/**", "out", "out/**"))
    assert shot.get("out/0001.png") == before, "the frame follows the changed project"
    settings = {shot.tool("oiiotool", "--info", "-v", f"out/{numbered(f)}.png").split("settings=")[1][:32] for f in shot.numbers}
    assert len(settings) == 1, f"frames of one job with {len(settings)} settings"


def job_with(change, exits):
    def build(shot):
        projected(shot)
        yield Step(["submit", "shot.weft", "--to", "openjd", "-o", "job"], may_write=("job", "job/**"))
        job = json.loads(shot.get("job/job.json"))
        change(job)
        shot.put("job/job.json", json.dumps(job))
        yield Step(["task", "job/job.json", "frames", "0"], exits=exits, may_write=("job/**", "out", "out/**"))
    return build


def every_path_elsewhere(job):
    """All strings that look like paths lead out of the shot."""
    for key, value in job.items():
        if isinstance(value, str) and "/" in value:
            job[key] = "/proc/weft_adversary/" + os.path.basename(value)
        elif isinstance(value, dict):
            every_path_elsewhere(value)


add("farm/job_elsewhere", job_with(every_path_elsewhere, (USAGE, UNREADABLE, MISSING, POLICY, SPACE)))
add("farm/job_empty", job_with(lambda job: job.clear(), (UNREADABLE, USAGE)))
add("farm/job_of_strings", job_with(lambda job: job.update({k: "x" for k in job}), (UNREADABLE, USAGE, MISSING)))
add("farm/job_of_numbers", job_with(lambda job: job.update({k: -1 for k in job}), (UNREADABLE, USAGE, MISSING)))


def refused(name, change, exits=(USAGE, UNREADABLE, MISSING, POLICY)):
    """`submit` refuses what `render` refuses."""
    def build(shot):
        projected(shot, change)
        yield Step(["render", "shot.weft", "--threads", "1"], exits=exits)
        yield Step(["submit", "shot.weft", "--to", "openjd", "-o", "out/job"], exits=exits)
    add("farm/refused_" + name, build)


refused("no_region", lambda p: p.update(regions=[]))
refused("no_output", lambda p: p.pop("output"))
refused("no_plate", lambda p: p.pop("plate"))
refused("licence", lambda p: p["settings"].update(excluded_licences="unknown"))
refused("frames", lambda p: p["settings"].update(frames="50-60"))
refused("onto_plate", lambda p: p["output"].update(path="frames/####.png"))
refused("missing_matte", lambda p: p["regions"][0].update(matte={"files": "nosuch/####.png"}))
refused("format", lambda p: p["output"].update(path="out/####.gif"))


@case("verify/proved")
def verify(shot):
    projected(shot)
    yield Step(["render", "shot.weft", "--threads", "1", "--recipe", "out/r.json"], outputs=[Output("out/r.json")])
    yield Step(["verify", "out/r.json", "--json"])
    yield Step(["verify", "out/r.json", "--quick"])
    yield Step(["verify", "out/r.json", "--frames", "77"], exits=(USAGE, MISSING))
    data = bytearray(shot.get("out/0002.png"))
    data[len(data) // 2] ^= 1
    shot.put("out/0002.png", bytes(data))
    yield Step(["verify", "out/r.json", "--quick"], exits=(DIFFERS,))
    shot.put("tile.png", png("texture", 5, (48, 48)))
    yield Step(["verify", "out/r.json", "--quick", "--json"], exits=(DIFFERS,))
    recipe = json.loads(shot.get("out/r.json"))
    recipe["inputs"] = [{"path": "/dev/zero", "hash": "0" * 32}, {"path": "/proc/self/mem", "hash": "0" * 32}]
    shot.put("out/s.json", json.dumps(recipe))
    yield Step(["verify", "out/s.json", "--quick"], exits=(DIFFERS, UNREADABLE, MISSING, USAGE), seconds=20)
    recipe["project"] = {"schema": "x\x1b[2J"}
    shot.put("out/s.json", json.dumps(recipe))
    yield Step(["verify", "out/s.json"], exits=(DIFFERS, UNREADABLE, MISSING, USAGE), seconds=20)


def cryptomatte_file(names, hashes=None, manifest=None):
    values = [0x3f000000 + 7 * i for i in range(len(names))] if hashes is None else hashes
    if manifest is None:
        manifest = json.dumps({n: f"{v:08x}" for n, v in zip(names, values)})

    def text(name, value):
        return raw_makers.exr_attribute("cryptomatte/1234567/" + name, "string", value.encode("utf-8", "surrogatepass"))

    extra = text("name", "obj") + text("hash", "MurmurHash3_32") + text("conversion", "uint32_to_float32") + text("manifest", manifest)

    def of(x):
        return struct.unpack("<f", struct.pack("<I", values[x * len(values) // 64]))[0]

    channels = {c: (2, 1, 1, lambda x, y: 0.5) for c in "RGB"}
    channels |= {"obj00.r": (2, 1, 1, lambda x, y: of(x)), "obj00.g": (2, 1, 1, lambda x, y: 1.0), "obj00.b": (2, 1, 1, lambda x, y: 0.0),
                 "obj00.a": (2, 1, 1, lambda x, y: 0.0)}
    return raw_makers.exr(channels, (0, 0, 63, 47), extra=extra)


def cryptomatte(name, data, exits=(OK,), chosen="a"):
    def build(shot):
        shot.ordinary(plates=None)
        for frame in shot.numbers:
            shot.put(f"frames/{numbered(frame)}.exr", data)
        yield Step(["cryptomatte", "frames/0001.exr", "--json"], exits=exits)
        yield Step(["cryptomatte", "frames/0001.exr", "--at", "3,3"], exits=exits)
        yield Step(["cryptomatte", "frames/0001.exr", "--at", "64,48"], exits=(USAGE, UNREADABLE))
        yield Step(shot.replace(plate="frames/####.exr", matte="crypto:" + chosen), exits=exits + (USAGE,))
        yield Step(shot.replace(plate="frames/####.exr", matte="crypto:nosuch\x1b[2J"), exits=(USAGE, UNREADABLE))
    add("crypto/" + name, build)


cryptomatte("plain", cryptomatte_file(["a", "b"]))
cryptomatte("escapes", cryptomatte_file(["\x1b[2Ja", "b\nc"]), (OK,), "*")
cryptomatte("nan_ids", cryptomatte_file(["a", "b"], [0x7fc00000, 0xffffffff]), (OK, UNREADABLE))
cryptomatte("manifest_broken", cryptomatte_file(["a"], manifest='{"a": '), (OK, UNREADABLE))
cryptomatte("manifest_deep", cryptomatte_file(["a"], manifest="[" * 100000), (OK, UNREADABLE))
cryptomatte("manifest_of_numbers", cryptomatte_file(["a"], manifest='{"a": 5, "b": null}'), (OK, UNREADABLE))
cryptomatte("none", raw_makers.exr({c: (1, 1, 1, lambda x, y: 0.5) for c in "RGB"}, (0, 0, 63, 47)), (UNREADABLE, USAGE))


def imported(name, make, exits=(OK,), more=()):
    def build(shot):
        shot.ordinary()
        shot.folder("new")
        make(shot)
        words = ["texture", "import", "new", "--db", "../home/l.db", "--material", "wood", *more]
        yield Step([*words, "--json"], exits=exits)
        yield Step(["texture", "search", "wood\x1b[2J", "--db", "../home/l.db"], exits=(OK, USAGE))
        yield Step(["texture", "list", "--db", "../home/l.db", "--json"])
        yield Step(["texture", "verify", "--db", "../home/l.db"], exits=(OK,))
    add("texture/import_" + name, build)


imported("one", lambda s: s.put("new/a.png", s.get("sample.png")))
imported("none", lambda s: None, (OK, UNREADABLE, MISSING, USAGE))
imported("odd_names", lambda s: [s.put(f"new/{n}.png", png("texture", i, (96, 96))) for i, n in enumerate(("a b", "\x1b[2J", "a\nb", "壁", "%s", "-o"))])
imported("broken", lambda s: (s.put("new/a.png", s.get("sample.png")[:500]), s.put("new/b.png", s.get("sample.png"))), (OK, UNREADABLE))
imported("credit_of_escapes", lambda s: (s.put("new/a.png", s.get("sample.png")), s.put("new/a.png.credit.json", '{"author": "\\u001b[2J", "licence": "CC0-1.0"}')))
imported("credit_deep", lambda s: (s.put("new/a.png", s.get("sample.png")), s.put("new/a.png.credit.json", "[" * 100000)), (OK, UNREADABLE))
imported("unknown_licence", lambda s: s.put("new/a.png", s.get("sample.png")), (OK, USAGE), ("--licence", "NOSUCH\x1b[2J"))
imported("link_loop", lambda s: (s.link(".", "new/loop"), s.put("new/a.png", s.get("sample.png"))))
imported("link_to_root", lambda s: (s.link("/proc/self", "new/p"), s.put("new/a.png", s.get("sample.png"))))


@case("texture/library_is_no_library")
def no_library(shot):
    shot.ordinary()
    for name, data in {"text.db": b"this is no database\x1b[2J", "empty.db": b"", "half.db": b"SQLite format 3\0" + b"\1" * 5000}.items():
        shot.put(name, data)
        yield Step(["texture", "list", "--db", name], exits=(OK, UNREADABLE), may_write=(name + "*",) if not data else ())
        yield Step(shot.replace("--db", name, texture=("--texture", "db:0123456789")), exits=(UNREADABLE, USAGE), may_write=(name + "*",) if not data else ())


@case("study/two_methods")
def study(shot):
    shot.ordinary()
    yield Step(["study", "--plate", "frames/####.png", "--matte", "masks/####.png", "--texture", "sample.png", "--quality", "draft", "--threads", "1",
                "--methods", "still,locked", "-o", "out"], outputs=[Output("out/report.html"), Output("out/report.json"), Output("out/report.csv")])
    yield Step(["study", "--plate", "frames/####.png", "--matte", "masks/####.png", "--texture", "sample.png", "--methods", "nosuch", "-o", "out2"],
               exits=(USAGE,))


@case("trust/project_from_elsewhere")
def trust(shot):
    """A project that was written into a folder by somebody else may render into its own folder only."""
    projected(shot, lambda p: p["output"].update(path="../elsewhere/####.png"))
    yield Step(["render", "shot.weft", "--threads", "1", "--output-root", "out"], exits=(USAGE, POLICY, UNREADABLE), may_write=())
    os.mkdir(os.path.join(shot.root, "elsewhere"))
    shot.link("../elsewhere", "inside")
    projected(shot, lambda p: p["output"].update(path="inside/####.png"))
    yield Step(["render", "shot.weft", "--threads", "1", "--output-root", "."], exits=(USAGE, POLICY, UNREADABLE), may_write=())
