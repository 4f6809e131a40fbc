"""Project files that are broken, hostile, very large, or from elsewhere; and the commands that read them."""
import json

from cases import add, frames
from oracle import MISSING, OK, POLICY, SPACE, UNREADABLE, USAGE, Step
from shot import png

BAD = (UNREADABLE, USAGE, MISSING, SPACE)


def raw(text, exits=BAD, more=()):
    """The bytes of a project, read by every command that reads one."""
    def build(shot):
        shot.ordinary()
        shot.put("shot.weft", text)
        for words in (["validate", "shot.weft"], ["info", "shot.weft", "--json"], ["render", "shot.weft", "--threads", "1"],
                      ["region", "list", "shot.weft"], ["submit", "shot.weft", "--to", "openjd", "-o", "out/job"],
                      ["collect", "shot.weft", "out/all"], ["region", "add", "shot.weft", "--name", "x"]):
            yield Step(words, exits=exits)
    return build


HEAD = '{"schema": "weft.project/1", '
for _name, _text in {
        "empty": "", "null": "null", "number": "1e999", "list": "[]", "string": '"weft"', "open": "{", "deep_lists": HEAD + '"x": ' + "[" * 200000,
        "deep_objects": HEAD + '"x": ' + '{"a":' * 5000 + "1" + "}" * 5001, "no_schema": "{}", "newer": '{"schema": "weft.project/999"}',
        "other": '{"schema": "nuke/1"}', "schema_number": '{"schema": 1}', "negative_schema": '{"schema": "weft.project/-1"}',
        "huge_schema": '{"schema": "weft.project/99999999999999999999"}', "key_twice": HEAD + '"name": "a", "name": "b"}', "trailing": HEAD + '"name": "a"} x',
        "not_utf8": HEAD.encode() + b'"name": "\xff\xfe"}', "surrogate": HEAD + '"name": "\\ud800"}', "utf16": (HEAD + '"name": "a"}').encode("utf-16"),
        "zeros": b"\0" * 4096, "png": png("plate", 0), "comment": HEAD + "/* x */ }", "many_keys": HEAD + ",".join(f'"k{i}": 1' for i in range(100000)) + "}",
        "long_string": HEAD + '"name": "' + "n" * (33 << 20) + '"}', "escapes": HEAD + '"regions": "\\u001b[2J\\u001b]0;t\\u0007"}',
        "escape_in_key": HEAD + '"plate": {"path": 5}, "\\u001b[2J": 1}', "schema_of_escapes": '{"schema": "\\u001b[31mweft"}',
        "password": "root:x:0:0:root:/root:/bin/bash\n"}.items():
    add("project/" + _name, raw(_text))


def changed(change, exits=BAD, outputs=False):
    """A good project with one thing changed."""
    def build(shot):
        shot.ordinary()
        project = shot.project()
        change(project)
        shot.put("shot.weft", json.dumps(project))
        yield Step(["render", "shot.weft", "--threads", "1"], exits=exits, outputs=frames(shot, picture=False) if outputs else [])
        yield Step(["validate", "shot.weft", "--json"], exits=exits + (OK,))
        yield Step(["info", "shot.weft"], exits=exits + (OK,))
    return build


def at(path, value):
    """Sets a value of the document: a path of keys and indices."""
    def change(project):
        *before, last = path
        for key in before:
            project = project[key] if isinstance(key, int) else project.setdefault(key, {})
        project[last] = value
    return change


R = ("regions", 0)
NUMBERS = {"nan": float("nan"), "infinite": float("inf"), "huge": 1e300, "negative": -1e9, "text": "5", "list": [5], "null": None, "true": True,
           "long": 10 ** 30}
for _path in (("plate", "movie_start"), ("plate", "fps"), ("settings", "seed"), ("output", "jpeg_quality"), ("next_region_id",), (*R, "id"), (*R, "color"),
              (*R, "placement", "scale"), (*R, "placement", "rotate_deg"), (*R, "synthesis", "overlap_px"), (*R, "temporal", "blend"),
              (*R, "light", "strength"), (*R, "finish", "grain"), (*R, "finish", "shutter_deg")):
    for _name, _value in NUMBERS.items():
        if _name in ("nan", "huge", "text", "null") or _path[-1] in ("scale", "id"):
            # What is in range of one is out of range of another; none may do anything but render or be refused.
            add(f"project/{'_'.join(str(p) for p in _path)}_{_name}", changed(at(_path, _value), BAD + (OK,)))
TEXTS = {"number": 5, "list": ["a"], "zero_byte": "a\0b", "long": "n" * 100000, "object": {"a": 1}, "escape": "\x1b[31mred"}
for _path in (("plate", "path"), ("output", "path"), ("output", "movie"), (*R, "name"), (*R, "matte", "files"), (*R, "texture", "plane"),
              ("settings", "frames"), ("color", "working_space"), (*R, "temporal", "mode"), (*R, "light", "lamps"), (*R, "placement", "scale_keys")):
    for _name, _value in TEXTS.items():
        add(f"project/{'_'.join(str(p) for p in _path)}_{_name}", changed(at(_path, _value), BAD + ((OK,) if _path[-1] == "name" else ())))
for _name, _value in {"crossed": [10, 10, 50, 40, 50, 10, 10, 40], "one_point": [5] * 8, "seven": [1] * 7, "nan": [float("nan")] * 8,
                      "far": [1e9, 0, 2e9, 0, 2e9, 1e9, 1e9, 1e9], "line": [0, 0, 10, 0, 20, 0, 30, 0]}.items():
    add("project/corners_" + _name, changed(at((*R, "placement", "corners_px"), _value), BAD + (OK,)))
for _name, _change in {
        "ids_twice": lambda p: p["regions"].append(dict(p["regions"][0], name="b")), "names_twice": lambda p: p["regions"].append(dict(p["regions"][0], id=2)),
        "no_regions": at(("regions",), []), "region_is_null": at(("regions",), [None]), "regions_is_object": at(("regions",), {}),
        "both_textures": at((*R, "texture", "sample"), "sample.png"), "no_texture": at((*R, "texture"), {}),
        "matte_twofold": at((*R, "matte", "keyframes"), [{"frame": 1, "path": "masks/0001.png"}]),
        "keyframe_without_path": at((*R, "matte"), {"keyframes": [{"frame": 1}]}),
        "keyframes_many": at((*R, "matte"), {"keyframes": [{"frame": i, "path": "masks/0001.png"} for i in range(100000)]}),
        "unknown_licence": at(("settings", "excluded_licences"), "NOSUCH-1.0"), "reference_far": at((*R, "reference_frames"), [2147483647]),
        "reference_text": at((*R, "reference_frames"), ["1"]), "frozen_far": at((*R, "matte", "frozen"), [1, 2147483647]),
        "amendment_runs": at((*R, "amendments"), [{"kind": "keep", "runs": [[-1, 2 ** 40, -5, 1e308, 0]]}]),
        "amendment_huge": at((*R, "amendments"), [{"kind": "again", "seed": 1, "runs": [[0, 0, 2147483647, 0, 0]]}]),
        "pins": at((*R, "corrections"), [{"frame": 1, "pins": [{"from": [1e308, 1], "to": [float("nan"), 1]}]}]),
        "track_and_motion": at((*R, "motion"), {"files": "a.flo", "track": "b.txt"}),
        "also_hundred": at((*R, "texture", "also"), ["sample.png"] * 100)}.items():
    add("project/" + _name, changed(_change, BAD + ((OK,) if "far" in _name or "amendment" in _name or _name in ("no_regions", "names_twice") else ())))
add("project/unknown_keys_are_kept", changed(lambda p: p.update(future={"a": [1, {"b": None}]}), (OK,), outputs=True))
add("project/disabled", changed(at((*R, "enabled"), False), (OK, USAGE)))


def regions(count, seconds):
    def build(shot):
        shot.ordinary(numbers=(1, 2))
        project = shot.project()
        project["next_region_id"] = count + 1
        project["regions"] = [dict(project["regions"][0], id=i + 1, name=f"r{i}") for i in range(count)]
        shot.put("shot.weft", json.dumps(project))
        yield Step(["render", "shot.weft", "--threads", "1"], outputs=frames(shot), seconds=seconds)
    return build


add("project/two_hundred_regions", regions(200, 30))


def outside(key, exits=(OK, UNREADABLE, USAGE, POLICY)):
    """A project that writes or reads outside of its folder: nothing appears there."""
    def build(shot):
        shot.ordinary()
        project = shot.project()
        at(*key)(project)
        shot.put("p/shot.weft", json.dumps(project).replace('"frames/', '"../frames/').replace('"masks/', '"../masks/').replace('"tile', '"../tile'))
        yield Step(["render", "p/shot.weft", "--threads", "1", "--output-root", "out"], exits=(USAGE, POLICY, UNREADABLE), may_write=())
        yield Step(["submit", "p/shot.weft", "--to", "openjd", "-o", "out/job"], exits=exits, may_write=("out/**", "out"))
        yield Step(["collect", "p/shot.weft", "out/all"], exits=(OK, UNREADABLE, USAGE), may_write=("out", "out/**"))
        yield Step(["info", "p/shot.weft"], exits=(OK, UNREADABLE, USAGE), may_write=())
        yield Step(["validate", "p/shot.weft"], exits=(OK, UNREADABLE, USAGE), may_write=())
    return build


for _name, _key in {"output": (("output", "path"), "../evil/####.png"), "absolute": (("output", "path"), "/tmp/weft_adversary_must_not_be/####.png"),
                    "movie": (("output", "movie"), "../../evil.mp4"), "layers": (("output", "layers_path"), "../evil/####.exr")}.items():
    add("project/outside_" + _name, outside(_key))
add("project/inside_root", lambda shot: iter([(shot.ordinary(), shot.put("shot.weft", json.dumps(shot.project()))) and Step(
    ["render", "shot.weft", "--threads", "1", "--output-root", "out"], outputs=frames(shot))]))


def mutated(index):
    """A good project with bytes, words or values exchanged at random."""
    def build(shot):
        shot.ordinary()
        project = shot.project()
        project["regions"][0].update(placement={"scale": 1.5, "offset_px": [3.0, 4.0]}, light={"source": "plate", "strength": 0.5},
                                     temporal={"mode": "locked"}, holdouts=[])
        words = json.dumps(project).split('"')
        for _ in range(shot.chance.choice((1, 2, 4))):
            i, j = shot.chance.randrange(len(words)), shot.chance.randrange(len(words))
            words[i] = shot.chance.choice((words[j], "", "-1", "2147483648", "1e308", "\\u0000", "../../x", words[i] * 50))
        shot.put("shot.weft", '"'.join(words))
        yield Step(["render", "shot.weft", "--threads", "1"], exits=BAD + (OK, POLICY), may_write=("out", "out/**", "*.png", "[0-9]*"))
    return build


for _index in range(60):
    add(f"project/mutated{_index}", mutated(_index))
ACTIONS = {"empty": "", "empty_list": "[]", "object": "{}", "unknown": '[{"action": "delete_all_files"}]', "no_action": '[{"region": "wall"}]',
           "many": json.dumps([{"action": "set_region_parameter", "region": "wall", "key": "placement.scale", "value": 2}] * 20000),
           "escape": '[{"action": "\\u001b[2J"}]', "deep": "[" * 100000, "no_region": '[{"action": "remove_region", "region": "nosuch\\u001b[31m"}]',
           "bad_value": '[{"action": "set_region_parameter", "region": "wall", "key": "placement.scale", "value": "x"}]',
           "bad_key": '[{"action": "set_region_parameter", "region": "wall", "key": "../../etc", "value": 1}]',
           "half_good": '[{"action": "rename_region", "region": "wall", "name": "x"}, {"action": "nosuch"}]',
           "duplicate_name": '[{"action": "add_region", "region": {"name": "wall"}}]', "password": "root:x:0:0:root:/root:/bin/bash\n"}
for _name, _text in ACTIONS.items():
    def build(shot, text=_text, good=_name in ("empty_list", "many")):
        shot.ordinary()
        shot.put("shot.weft", json.dumps(shot.project()))
        shot.put("a.json", text)
        for words in (["apply", "shot.weft", "a.json", "--dry-run"], ["apply", "shot.weft", "a.json", "--json"]):
            yield Step(words, exits=(OK,) if good else (UNREADABLE, USAGE), may_write=("shot.weft",) if good else (), silent=("root:x",))
    add("actions/" + _name, build)
del build
