"""Names with blanks, quotes, line breaks, escape sequences, percent and number signs, UTF-8 and bytes that are none."""
import json
import os

from cases import add, frames
from oracle import MISSING, OK, SPACE, UNREADABLE, USAGE, Step
from shot import numbered

NAMES = {"blank": "a b", "quotes": "it's \"x\"", "line_break": "a\nb", "return": "a\rb", "escape": "a\x1b[31mred\x1b]0;t\x07", "utf8": "Wänd 壁 🧱",
         "dash": "-o", "dollar": "$(touch pwned)`x`", "backslash": "a\\b", "star": "*?[a-z]", "braces": "{TOP.filename}", "colon": "a:b",
         "semicolon": "a;b&c|d", "equals": "1=b", "comma": "a,b", "leading_dot": ".hidden", "tab": "a\tb", "long": "n" * 200,
         "bidi": "a\u202egnp.exe", "csi_of_8_bits": "a\x9b31m", "combining": "e\u0301" * 20, "nothing_printable": "\u200b"}


def in_folder(name):
    def build(shot):
        shot.ordinary(plates=name + "/{}.png", mattes=f"m{name}" + "/{}.png")
        yield Step(shot.replace(plate=f"./{name}/####.png", matte=f"./m{name}/####.png", out=f"out/{name}/####.png"),
                   outputs=frames(shot, "out/" + name + "/{}.png"))
        # The same name in an error and in a project.
        yield Step(shot.replace(plate=f"./{name}/no.####.png"), exits=(MISSING, UNREADABLE, USAGE))
        project = shot.project()
        project["plate"]["path"], project["regions"][0]["matte"]["files"] = f"./{name}/####.png", f"m{name}/####.png"
        project["regions"][0]["name"], project["name"] = name, name
        shot.put("shot.weft", json.dumps(project))
        yield Step(["info", "shot.weft", "--json"], exits=(OK, USAGE, UNREADABLE))
        yield Step(["render", "shot.weft", "--threads", "1", "--overwrite"], exits=(OK, USAGE, UNREADABLE))
        yield Step(["region", "list", "shot.weft"], exits=(OK, USAGE, UNREADABLE))
        yield Step(["region", "set", "shot.weft", name + "?", "--scale", "2"], exits=(USAGE, UNREADABLE), may_write=())
    return build


for _label, _name in NAMES.items():
    add("name/folder_" + _label, in_folder(_name))
    add("name/file_" + _label, lambda shot, name=_name: iter([
        Step(shot.ordinary(plates="frames/" + name + ".{}.png").replace(
            plate=f"frames/{name}.####.png", out=f"out/{name}.####.png"), exits=(OK, USAGE) if "*" in name else (OK,),
            outputs=frames(shot, "out/" + name + ".{}.png"))]))


def bytes_name(shot):
    """A file name that is no UTF-8."""
    shot.ordinary()
    folder = os.fsencode(shot.path("")) + b"b\xff\xfe"
    os.mkdir(folder)
    for frame in shot.numbers:
        with open(folder + b"/" + numbered(frame).encode() + b".png", "wb") as file:
            file.write(shot.get(f"frames/{numbered(frame)}.png"))
    yield Step(shot.replace(plate=os.fsdecode(b"b\xff\xfe/####.png")), exits=(OK, UNREADABLE, USAGE))
    yield Step(shot.replace("--json", plate=os.fsdecode(b"no\xff/####.png")), exits=(MISSING, UNREADABLE, USAGE))
    yield Step(shot.replace(plate=os.fsdecode(b"b\xff\xfe/####.png"), out=os.fsdecode(b"out/\xff.####.png")), exits=(OK, UNREADABLE, USAGE))


add("name/no_utf8", bytes_name)

PATTERNS = {"two_numbers": "frames/##/####.png", "two_in_name": "frames/##.####.png", "in_folder": "fr%04d/0001.png", "percent_s": "frames/%s.png",
            "percent_n": "frames/%n.png", "percent_large": "frames/%099999999999d.png", "percent_only": "frames/%.png", "percent_two": "frames/%d%d.png",
            "thirteen": "frames/" + "#" * 13 + ".png", "thousand": "frames/" + "#" * 3000 + ".png", "at": "frames/@@@@.png",
            "mixed": "frames/##@@.png", "percent_x": "frames/%04x.png", "percent_star": "frames/%*d.png", "percent_dollar": "frames/%1$d.png",
            "no_extension": "frames/####", "folder": "frames", "folder_slash": "frames/", "dot": ".", "dots": "frames/../frames/####.png",
            "slashes": "frames////####.png", "nothing": "", "blank": " ", "nul": "frames/%c.png", "url": "http://127.0.0.1:9/####.png",
            "data": "data:image/png;base64,AAAA", "file_url": "file:///etc/passwd", "pipe": "|touch pwned", "oiio": "a.null?RES=100000x100000",
            "concat": "concat:a.mp4|b.mp4", "long": "x" * 5000 + "/####.png", "etc": "/etc/passwd", "proc": "/proc/self/mem", "root": "/"}
GOOD = {"at", "folder", "folder_slash", "dots", "slashes"}
for _label, _pattern in PATTERNS.items():
    add("pattern/plate_" + _label, lambda shot, p=_pattern, good=_label in GOOD: iter([Step(
        shot.ordinary().replace(plate=p), exits=(OK,) if good else (OK, USAGE, UNREADABLE, MISSING) if "#" in p and "@" in p else (
            USAGE, UNREADABLE, MISSING), silent=("root:x",))]))
    if not _pattern.startswith("/"):
        add("pattern/out_" + _label, lambda shot, p=_pattern: iter([Step(
            shot.ordinary().replace(out=p.replace("frames", "out")), exits=(OK, USAGE, UNREADABLE, SPACE), may_write=("out", "out/**", "http:*"))]))
