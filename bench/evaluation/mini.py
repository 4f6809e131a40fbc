"""The mini corpus in tests/data/corpus: three small scenes, reduced to what the tests read, below 5 MB.

    scene.json, verified.json           as in layout.py, without rays
    plate/####.png, coverage/PART/####.png
    grey/####.exr
    motion/####.png                     KITTI, to the next frame; valid where the point is seen there
"""
import json
import os
import shutil
from pathlib import Path

import numpy as np

import images
from visibility import FORWARD, motion

MOST_BYTES = 5_000_000
FOLDER = Path(__file__).resolve().parent.parent.parent / "tests" / "data" / "corpus"


def reduce(scene, target):
    """Writes the reduced scene to `target`/NAME, in place of an older one."""
    folder = target / scene.name
    partial = target / (".partial-" + scene.name)
    shutil.rmtree(partial, ignore_errors=True)
    partial.mkdir(parents=True)
    facts = {key: value for key, value in scene.facts.items() if key not in ("probes", "seconds")}
    (partial / "scene.json").write_text(json.dumps(facts) + "\n", encoding="utf-8")
    shutil.copy(scene.folder / "verified.json", partial)
    shutil.copytree(scene.folder / "plate", partial / "plate")
    for part in scene.surfaces:
        shutil.copytree(scene.folder / "coverage" / part["name"], partial / "coverage" / part["name"])
    shutil.copytree(scene.folder / "grey", partial / "grey")
    for frame in list(scene.frames)[:-1]:
        write_kitti(scene, frame, partial / "motion" / ("%04d.png" % frame))
    shutil.rmtree(folder, ignore_errors=True)
    os.replace(partial, folder)


def write_kitti(scene, frame, path):
    """R = u, G = v: 64 × px + 32768; B = 1 where the point is seen on the next frame."""
    flow = motion(images.read(scene.file(frame, "data")), FORWARD)
    seen = np.rint(images.grey(scene.file(frame, "visible", ending="png")) * 255).astype(int) & FORWARD
    code = np.clip(np.rint(flow * 64 + 32768), 0, 65535) * (seen > 0)[..., None]
    images.write(path, np.dstack([code, seen > 0]) / 65535, "uint16")


def size_of(target):
    return sum(f.stat().st_size for f in target.rglob("*") if f.is_file())
