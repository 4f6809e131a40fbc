"""Film clips (bench/clips.json) as scenes: what has a truth is laid out as layout.py says, and measured like a scene.

A clip becomes a folder with plate, and for each of its surfaces coverage, and motion where it is known. Frames are
numbered from 1 there."""
import json
import re
from pathlib import Path

import numpy as np

import images
from drawn import kitti
from layout import Scene

LIST = Path(__file__).resolve().parent.parent / "clips.json"
EDGE_PX = 2  # motion next to an object's edge is a mixture of what meets there


def numbered(pattern, frame):
    """The file of a frame: "frames/#####.png"."""
    return re.sub("#+", lambda digits: "%0*d" % (len(digits.group()), frame), str(pattern))


def scenes(folder, work, say=print):
    """Scenes of the clips that lie in `folder`, laid out below `work`; `say` is told of those that are left out."""
    found = []
    for clip in json.loads(LIST.read_text(encoding="utf-8"))["clips"]:
        source = Path(folder) / clip["name"]
        if not source.is_dir():
            say("%s is left out: there is no folder %s" % (clip["name"], source))
        elif not ("masks" in clip or "ids" in clip):
            say("%s is left out: it has no truth" % clip["name"])
        else:
            found.append(arranged(clip, source, Path(work) / "clips" / clip["name"]))
    return found


def arranged(clip, source, folder):
    facts = {"family": clip["name"], "seed": 0, "frames": clip["last"] - clip["first"] + 1, "film": True,
             "parts": [{"name": name, "id": number, "surface": True, "hidden": False}
                       for name, number in clip.get("surfaces", {"object": None}).items()]}
    marker = folder / "scene.json"
    if not marker.is_file() or json.loads(marker.read_text(encoding="utf-8")) != facts:
        folder.mkdir(parents=True, exist_ok=True)
        for frame in range(clip["first"], clip["last"] + 1):
            arrange_frame(clip, source, folder, facts["parts"], frame)
        marker.write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")
    return Scene(folder)


def arrange_frame(clip, source, folder, parts, frame):
    name = "%04d.png" % (frame - clip["first"] + 1)
    images.write(folder / "plate" / name, images.rgb(source / numbered(clip["frames"], frame)), "uint8")
    for part in parts:
        images.write(folder / "coverage" / part["name"] / name, mask(clip, source, part, frame), "uint16")
        if "motion" in clip and frame < clip["last"]:
            flow, known = kitti(source / numbered(clip["motion"], frame))
            pixels = np.concatenate([(flow * 64 + 32768) / 65535, known[..., None] / np.float32(65535)], -1)
            images.write(folder / "motion" / part["name"] / name, pixels, "uint16")


def mask(clip, source, part, frame):
    if "masks" in clip:
        return images.grey(source / numbered(clip["masks"], frame))
    return np.rint(255 * images.grey(source / numbered(clip["ids"], frame))) == part["id"]
