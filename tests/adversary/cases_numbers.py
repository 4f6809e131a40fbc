"""Numbering of frames: negative, with gaps, far away, in mixed padding, twice, many; and lists of frames."""
import os

from cases import add, frames
from oracle import MISSING, OK, UNREADABLE, USAGE, Step
from shot import numbered, png

LIMIT = 2147483647
LARGEST = 100000000  # frames beyond are refused


def numbering(numbers, exits=(OK,), more=(), rendered=None):
    def build(shot):
        shot.ordinary(numbers=numbers)
        if rendered is not None:
            shot.numbers = list(rendered)
        yield Step(shot.replace(*more), exits=exits, outputs=frames(shot, picture=rendered is None, lit="black" not in more))
    return build


for _name, _numbers in {"negative": (-3, -2, -1), "across_zero": (-1, 0, 1), "zero": (0, 1, 2), "five_digits": (99999, 100000, 100001),
                        "across_padding": (9998, 9999, 10000), "millions": (1000000, 1000001), "one": (7,),
                        "largest": (LARGEST - 1, LARGEST), "least": (-LARGEST, 1 - LARGEST)}.items():
    add("number/" + _name, numbering(_numbers))
for _name, _numbers in {"last": (LIMIT,), "last_two": (LIMIT - 1, LIMIT), "first": (-LIMIT,), "first_of_all": (-LIMIT - 1,)}.items():
    add("number/" + _name, numbering(_numbers, (UNREADABLE,)))
for _number in (LARGEST + 1, LIMIT + 1, 99999999999, 10 ** 18, -LIMIT - 2):
    add(f"number/beyond_{_number}", numbering((_number,), (MISSING, UNREADABLE, USAGE)))
add("number/first_and_last", numbering((1, LIMIT), (MISSING, UNREADABLE, USAGE, 6)))
add("number/from_end_to_end", numbering((-LIMIT, LIMIT), (MISSING, UNREADABLE, USAGE, 6)))
add("number/gap", numbering((1, 2, 4), (MISSING,)))
add("number/large_gap", numbering((1, 100000), (MISSING,)))
for _policy, _rendered in {"hold": (1, 2, 3, 4), "black": (1, 2, 3, 4), "skip": (1, 2, 4)}.items():
    add("number/gap_" + _policy, numbering((1, 2, 4), (OK, MISSING), ("--missing", _policy), _rendered))
    add("number/huge_gap_" + _policy, numbering((1, LARGEST), (OK, MISSING, USAGE, 6), ("--missing", _policy, "--frames", "1"), (1,)))
add("number/gap_unknown", numbering((1, 2, 4), (USAGE,), ("--missing", "guess")))


def present(extra, exits, says=()):
    """Further files beside the sequence."""
    def build(shot):
        shot.ordinary()
        extra(shot)
        yield Step(shot.replace(plate="frames"), exits=exits, says=says)
        yield Step(shot.replace("--overwrite"), exits=(OK,), outputs=frames(shot))
    return build


def beside(*names):
    return lambda shot: [shot.put("frames/" + name, png("plate", 1)) for name in names]


for _name, _extra in {"mixed_padding": beside("00001.png", "3.png"), "other_extension": beside("0001.PNG", "0002.tiff", "0003.exr.bak"),
                      "two_sequences": beside("b.0001.png", "b.0002.png"), "hidden": beside(".0004.png", "._0001.png"),
                      "text": lambda s: s.put("frames/readme.txt", "hello"), "temporary": beside("0004.png.tmp", "0004.png~"),
                      "folder_of_that_name": lambda s: s.folder("frames/0004.png.d"), "same_number_twice": beside("0001.jpg"),
                      "minus_zero": beside("-0000.png"), "plus": beside("+0004.png"), "hexadecimal": beside("0x04.png"),
                      "utf8_digits": beside("٠٠٠٤.png")}.items():
    add("number/beside_" + _name, present(_extra, (OK, USAGE, UNREADABLE)))

LISTS = {"1": (1,), "1-3": (1, 2, 3), "1-3x2": (1, 3), "1,3": (1, 3), "3,1": (1, 3), "1,1,1": (1,), "1-2,2-3": (1, 2, 3), "2-2": (2,)}
for _list, _rendered in LISTS.items():
    add("frames/" + _list, numbering((1, 2, 3), more=("--frames", _list), rendered=_rendered))
for _list in ("", "3-1", "1-", "-", "a", "1-3x0", "1-3x-1", "1;3", "1..3", "1,,3", ",", "1-99999999999", "1e3", "0x1", "1-2000000000",
              "-2147483648-2147483647", "1\n2", "1-3x99999999999", "\x1b[2J", "1," * 40000 + "1", "٣", "1 - 3", "1-3-5"):
    _label = _list if len(_list) < 30 and _list.isprintable() and _list.isascii() else "odd" + str(len(_list))
    add("frames/bad_" + _label.replace("/", "_"), numbering((1, 2, 3), (USAGE, MISSING, OK) if " " in _list or _list[:3] == "1,1" or _list == "" else (
        USAGE, MISSING), ("--frames", _list), ()))
add("frames/not_there", numbering((1, 2, 3), (MISSING,), ("--frames", "2-9"), ()))
add("frames/negative", numbering((-5, -4, -3), (OK,), ("--frames=-5--4",), (-5, -4)))


def links(name, make, exits=(OK,)):
    def build(shot):
        shot.ordinary(plates="source/{}.png")
        shot.folder("frames")
        for frame in shot.numbers:
            make(shot, numbered(frame))
        yield Step(shot.replace(), exits=exits, outputs=frames(shot))
    add("links/" + name, build)


links("to_files", lambda s, n: s.link(f"../source/{n}.png", f"frames/{n}.png"))
links("absolute", lambda s, n: s.link(s.path(f"source/{n}.png"), f"frames/{n}.png"))
links("chain", lambda s, n: (s.link(f"../source/{n}.png", f"frames/l{n}"), s.link(f"l{n}", f"frames/{n}.png")))
links("hard", lambda s, n: os.link(s.path(f"source/{n}.png"), s.path(f"frames/{n}.png")))
links("loop", lambda s, n: s.link(f"{n}.png", f"frames/{n}.png"), (UNREADABLE, MISSING))


def linked_folder(shot):
    shot.ordinary(plates="source/{}.png")
    shot.link("source", "frames")
    yield Step(shot.replace(), outputs=frames(shot))
    yield Step(shot.replace("--overwrite", out="frames/####.png"), exits=(USAGE,))


add("links/folder", linked_folder)


def output_link(shot):
    """The output's folder is a link to another one."""
    shot.ordinary()
    shot.folder("elsewhere")
    shot.link("elsewhere", "out")
    yield Step(shot.replace(), may_write=("elsewhere/**",), outputs=frames(shot))


add("links/output_folder", output_link)


def many(count, seconds):
    def build(shot):
        shot.ordinary(numbers=range(1, count + 1), size=(16, 12))
        yield Step(shot.replace("--frames", "1-2"), outputs=frames(shot)[:2], seconds=seconds)
    return build


add("number/three_thousand_files", many(3000, 60))
