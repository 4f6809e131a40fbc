"""Command lines: every option with values that it cannot have, words that are none, and JSON for each."""
import json

from cases import add, frames
from oracle import MISSING, OK, POLICY, SPACE, UNREADABLE, USAGE, Step

REFUSED = (USAGE, UNREADABLE, MISSING, SPACE)
# Option -> a value that it takes.
NUMBERS = {"--scale": "1.5", "--rotate": "30", "--overlap": "24", "--feather": "2", "--refine": "1", "--seed": "7", "--temporal-blend": "0.5",
           "--temporal-weight": "2", "--light-strength": "0.5", "--light-tint": "0.2", "--highlights": "1", "--highlight-roughness": "0.4", "--grain": "0.5", "--defocus": "0.5",
           "--shutter": "180", "--light-detail": "0.7", "--keep-detail": "0.5", "--match-plate": "0.5", "--exposure": "-0.5", "--temperature": "40",
           "--contrast": "1.1", "--gamma": "0.9", "--saturation": "1.2", "--hue": "-20", "--opacity": "0.7", "--form-amount": "0.5", "--line-width": "3", "--matte-stabilize": "0.2", "--threads": "2", "--jpeg-quality": "80"}
WORDS = {"--quality": "draft", "--depth": "16", "--seam": "dp", "--seam-cost": "paper", "--temporal": "none", "--light": "none",
         "--blend-mode": "detail", "--plane-wrap": "mirror", "--motion-direction": "backward", "--backend": "cpu", "--progress": "json",
         "--missing": "hold", "--layer-blend": "soft-light", "--layers": "all", "--motion-convention": "files", "--matte-propagate": "both", "--stage": "motion"}
LISTS = {"--offset": "3,4", "--multiply": "1,0.9,0.8", "--color-offset": "0,0.01,0", "--scale-keys": "1:1 3:1.5", "--rotate-keys": "1:0 3:20", "--offset-keys": "1:0,0 3:4,4", "--light-keys": "1:1:smooth 3:0.3", "--form-amount-keys": "1:0:hold 3:1",
         "--lamps": "point 30,20 10 1.5", "--map": "/a=/b", "--exclude-licences": "GPL", "--frames": "1-2"}


def given(option, value, exits, texture=("--plane", "tile.png")):
    def build(shot):
        shot.ordinary()
        words = shot.replace(texture=texture)
        if option in words:
            at = words.index(option)
            del words[at:at + 2]
        yield Step([*words, f"{option}={value}"], exits=exits)
    return build


def label(value):
    return value[:20] if value.isascii() and value.isalnum() else "odd" + "".join(f"{ord(c):x}" for c in value[:6])


for _option, _value in NUMBERS.items():
    _texture = ("--texture", "sample.png") if _option in ("--overlap", "--feather", "--refine", "--seed") else ("--plane", "tile.png")
    add(f"option/{_option[2:]}_good", given(_option, _value, (OK,), _texture))
    for _bad in ("nan", "-inf", "", "1 2", "-99999999999999999999"):
        add(f"option/{_option[2:]}_{label(_bad)}", given(_option, _bad, REFUSED))
for _option, _value in WORDS.items():
    if _option not in ("--stage", "--layers"):
        add(f"option/{_option[2:]}_good", given(_option, _value, (OK, USAGE) if _option in ("--blend-mode", "--temporal") else (OK,)))
    for _bad in ("", "nosuch\x1b[31m"):
        add(f"option/{_option[2:]}_{label(_bad)}", given(_option, _bad, REFUSED + ((OK,) if not _bad else ())))
for _option, _value in LISTS.items():
    add(f"option/{_option[2:]}_good", given(_option, _value, (OK,)))
    for _bad in ("nan,nan", ":", "1:1:1", ";" * 3000, "\x1b[2J", "9" * 400):
        _maybe = (OK, POLICY) if _option in ("--lamps", "--exclude-licences") else ()
        add(f"option/{_option[2:]}_{label(_bad)}", given(_option, _bad, REFUSED + _maybe))


def words(*spoken, exits=(USAGE,), stdin="/dev/null", **more):
    def build(shot):
        shot.ordinary()
        shot.put("shot.weft", json.dumps(shot.project()))
        yield Step(list(spoken), exits=exits, stdin=stdin, **more)
    return build


COMMANDS = ("replace", "render", "matte", "synth", "measure", "study", "verify", "cryptomatte", "look", "collect", "submit", "task", "doctor", "diff", "new",
            "region", "apply", "info", "validate", "texture", "demo", "bench", "schema", "trust")
for _command in COMMANDS:
    add(f"usage/{_command}_help", words(_command, "--help", exits=(OK,)))
    add(f"usage/{_command}_unknown_option", words(_command, "--no-such-option\x1b[2J", exits=(USAGE,)))
    add(f"usage/{_command}_json_unknown_option", words(_command, "--json", "--nosuch"))
    if _command not in ("doctor", "demo", "bench", "schema", "trust"):
        add(f"usage/{_command}_alone", words(_command, exits=(USAGE,)))
        if _command != "new":  # which makes the file
            add(f"usage/{_command}_json_missing_file", words(_command, "nosuch\x1b[2J.x", "--json", exits=REFUSED))
for _label, _spoken in {"unknown": ("paint",), "typo": ("rendre",), "escape": ("\x1b[2J",), "empty": ("",), "dashes": ("--",), "dash": ("-",),
                        "long": ("x" * 100000,), "many": ("x",) * 3000, "twice": ("render", "shot.weft", "shot.weft"), "response_file": ("@shot.weft",),
                        "config": ("--config", "shot.weft")}.items():
    add("usage/command_" + _label, words(*_spoken))
add("usage/version", words("--version", exits=(OK,)))
add("usage/help", words("--help", exits=(OK,)))
add("usage/doctor", words("doctor", exits=(OK, 1, 3, 5)))
add("usage/doctor_json", words("doctor", "--json", exits=(OK, 1, 3, 5)))
add("usage/backend_cuda", words("render", "shot.weft", "--backend", "cuda", exits=(5, OK)))
add("usage/backend_cuda_json", words("render", "shot.weft", "--backend", "cuda", "--json", exits=(5, OK)))
for _command, _spoken in {
        "render": ("render", "shot.weft", "--threads", "1"), "render_dry": ("render", "shot.weft", "--dry-run"), "info": ("info", "shot.weft"),
        "validate": ("validate", "shot.weft"), "region_list": ("region", "list", "shot.weft"), "diff": ("diff", "frames/####.png", "frames/####.png"),
        "synth": ("synth", "sample.png", "-o", "out/p.png", "--size", "64x64"), "submit": ("submit", "shot.weft", "--to", "openjd", "-o", "out/j"),
        "collect": ("collect", "shot.weft", "out/all"), "look_save": ("look", "save", "shot.weft", "out/l.json", "--region", "wall"),
        "new": ("new", "out/n.weft", "--plate", "frames/####.png", "-o", "x/####.png"),
        "matte": ("matte", "--plate", "frames/####.png", "--matte", "1=masks/0001.png", "-o", "out/####.png"),
        "measure": ("measure", "--result", "frames/####.png", "--plate", "frames/####.png", "--matte", "masks/####.png"),
        "texture_import": ("texture", "import", "sample.png", "--db", "../home/l.db")}.items():
    add("json/" + _command, words(*_spoken, "--json", exits=(OK,), may_write=("out", "out/**", "shot.weft")))
for _command, _spoken in {
        "region_add": ("region", "add", "shot.weft", "--name", "b", "--matte", "masks/####.png", "--plane", "tile.png"),
        "region_set": ("region", "set", "shot.weft", "wall", "--scale", "2"), "region_remove": ("region", "remove", "shot.weft", "wall"),
        "region_add_twice": ("region", "add", "shot.weft", "--name", "wall"), "region_remove_none": ("region", "remove", "shot.weft", "nosuch"),
        "region_set_none": ("region", "set", "shot.weft", "nosuch", "--scale", "2")}.items():
    add("json/" + _command, words(*_spoken, "--json", exits=(USAGE,) if _command[-5:] in ("_none", "twice") else (OK,),
                                  may_write=("shot.weft",)))
for _words in (("a.weft",), ("a\x1b[2J.weft", "x"), ("-o", "frames/####.png")):
    add(f"json/render_errors{len(_words)}_{label(_words[0])}", words("render", *_words, "--json", exits=REFUSED))
add("json/no_such_frames", words("render", "shot.weft", "--frames", "77", "--json", exits=(MISSING,)))
add("json/existing", lambda shot: iter([Step(shot.ordinary().replace("--json"), outputs=frames(shot)), Step(shot.replace("--json"), exits=(USAGE,))]))
