"""Renders one scene of the corpus; run by Blender 3.4:

    blender -b --factory-startup -noaudio -P render_scene.py -- FAMILY SEED FOLDER FRAMES WIDTHxHEIGHT SAMPLES TILE_PICTURE

FOLDER gets old/, grey/, tiled/, sky/, data/ and of glossy scenes gloss/####.exr, and scene.json; bench/corpus makes the
rest from them."""
import importlib
import os
import sys
import time
import traceback

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import passes
import rays
from stage import GREY, TILE_M, Stage


def main(family, seed, folder, frames, size, samples, tile_picture):
    started = time.time()
    rng = np.random.default_rng(int(seed))
    stage = Stage(int(frames), tuple(int(n) for n in size.split("x")))
    importlib.import_module("families." + family).build(stage, rng)
    passes.set_up(stage, os.cpu_count())
    stage.dress("old", tile_picture)
    camera = passes.camera_track(stage)
    passes.render_pictures(stage, "old", os.path.join(folder, "old"), int(samples))
    passes.render_data(stage, os.path.join(folder, "data"))
    passes.render_sky(stage, os.path.join(folder, "sky"), max(1, int(samples) * 3 // 4))
    for variant in ("grey", "tiled"):
        stage.dress(variant, tile_picture)
        passes.render_pictures(stage, variant, os.path.join(folder, variant), int(samples))
    if stage.glossy:
        for variant, shown in (("gloss", range(1, stage.frames + 1)),
                               ("gloss elsewhere", passes.truth_frames(stage.frames))):
            stage.dress(variant)
            passes.render_gloss(stage, os.path.join(folder, variant), int(samples), shown)
    probed = sorted({1, (stage.frames + 1) // 2, stage.frames})
    passes.write_json(os.path.join(folder, "scene.json"), {
        "family": family, "seed": int(seed), "frames": stage.frames,
        "truth_frames": passes.truth_frames(stage.frames), "camera": camera, "shutter_deg": stage.shutter_deg,
        "samples": int(samples), "glossy": stage.glossy, "grey": GREY, "tile_m": TILE_M, "sky": stage.sky_light,
        "parts": [{"name": p.name, "id": p.id, "surface": p.surface, "hidden": p.hidden, "still": p.still}
                  for p in stage.parts],
        "probes": rays.probe(stage, camera, probed, 300, np.random.default_rng(1)),
        "seconds": round(time.time() - started, 1)})


try:
    main(*sys.argv[sys.argv.index("--") + 1:])
except BaseException:  # Blender itself would exit with 0
    traceback.print_exc()
    sys.stdout.flush()
    os._exit(1)
