"""Renders the mini corpus in draft, and compares with its truth: usage: mini_test.py WEFT.

The limits guard what is reached: each is the figure of 23 to 28 November 2026 with a margin for what rounding and another
compiler may change. Whoever makes a figure better moves its limit."""
import json
import sys
import tempfile
import unittest
from functools import cache, partial
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "bench" / "evaluation"))
try:
    import images
    import light
    import mattes
    import textures
    from layout import Scene
    from rendered import UNTOUCHED
    from runs import Runs, frame_file
    from truth import SurfaceTruth
except ImportError as missing:
    print("mini_test: skipped: %s (Debian: python3-numpy, python3-openimageio)" % missing)
    sys.exit(77)

CORPUS = ROOT / "tests" / "data" / "corpus"
WEFT = None
# By scene and surface: TDE over the floor (times) and drift (px), the light's correlation and error (levels), and the
# propagated matte's IoU and leak on the worst frame.
LIMITS = {
    "cloth-12, hanging": {
        "tde_over_floor": 9.92, "drift_px": 1.75, "correlation": 0.972, "levels": 1.74, "iou": 0.989, "leak": 0.005},
    "cloth-12, wall": {
        "tde_over_floor": 4.35, "drift_px": 0.41, "correlation": 0.979, "levels": 0.64, "iou": 0.986, "leak": 0.005},
    "leaves-13, ball": {
        "tde_over_floor": 21.5, "drift_px": 5.76, "correlation": 0.843, "levels": 14.91, "iou": 0.969, "leak": 0.0054},
    "leaves-13, floor": {
        "tde_over_floor": 6.1, "drift_px": 1.72, "correlation": 0.717, "levels": 23.9, "iou": 0.983, "leak": 0.005},
    "leaves-13, wall": {
        "tde_over_floor": 6.73, "drift_px": 1.41, "correlation": 0.761, "levels": 14.8, "iou": 0.987, "leak": 0.005},
    "room-11, floor": {
        "tde_over_floor": 1.36, "drift_px": 0.14, "correlation": 0.929, "levels": 5.61, "iou": 0.984, "leak": 0.005},
    "room-11, table": {
        "tde_over_floor": 26.6, "correlation": 0.816, "levels": 4.37, "iou": 0.899, "leak": 0.005},
    "room-11, wall": {
        "tde_over_floor": 1.32, "drift_px": 0.12, "correlation": 0.976, "levels": 1.79, "iou": 0.979, "leak": 0.005},
}


@cache
def followed_texture():
    """The bytes of the texture that is followed, the same for every surface: drawn once."""
    with tempfile.TemporaryDirectory(prefix="weft-mini-") as folder:
        return textures.followed(Path(folder, "followed.png")).read_bytes()


class Mini(unittest.TestCase):
    def surface(self, scene, part):
        truth = SurfaceTruth(scene, part)
        with tempfile.TemporaryDirectory(prefix="weft-mini-") as work:
            runs = Runs(WEFT, Path(work))
            plate, matte = scene.pattern("plate", ending="png"), ("--matte", truth.coverage_pattern)
            found = {**self.motion(scene, runs, plate, matte), **self.light(scene, truth, runs, plate, matte),
                     **self.matte(scene, truth, runs, plate)}
        return found

    def motion(self, scene, runs, plate, matte):
        texture = runs.work / "followed.png"
        texture.write_bytes(followed_texture())
        shared = (*matte, "--plane", texture)
        _, frames, _ = runs.render("followed", plate, (*shared, *UNTOUCHED, "--quality", "draft"))
        said = runs("measured", "measure", "--result", frames, "--plate", plate, *shared, "--motion",
                    scene.pattern("motion", ending="png"), "--reference-frame", 1, "--frames", "1-6")
        return {"tde_over_floor": said["tde_over_floor"], "drift_px": said["drift_px"]}

    def light(self, scene, truth, runs, plate, matte):
        grey = textures.grey(runs.work / "grey.png", scene.facts["grey"])
        _, frames, _ = runs.render("grey", plate, (*matte, "--plane", grey, "--quality", "draft", "--grain", "0"),
                                  ending="exr")
        inside = []
        for frame in scene.truth_frames:
            core = truth.core(frame, light.MARGIN_PX)
            inside.append((images.rgb(frame_file(frames, frame))[core], images.rgb(scene.file(frame, "grey"))[core]))
        found = light.interior(inside, *light.fitted_gains(inside))
        return {"correlation": found["correlation"], "levels": found["levels"]}

    def matte(self, scene, truth, runs, plate):
        images.write(runs.work / "painted.png", truth.coverage(1) >= 0.5, "uint8")
        pattern = runs.work / "matte" / "####.png"
        runs("matte", "matte", "--plate", plate, "--matte", "1=%s" % (runs.work / "painted.png"), "-o", pattern)
        found = mattes.measure(list(scene.frames), [1], truth.coverage,
                               lambda f: images.grey(frame_file(str(pattern), f)))
        return {"iou": found["iou_worst"], "leak": found["leak_worst"]}

    def test_every_pass_was_verified(self):
        for folder in sorted(CORPUS.iterdir()):
            self.assertTrue(json.loads((folder / "verified.json").read_text(encoding="utf-8"))["holds"], folder.name)


def add_tests():
    for folder in sorted(CORPUS.iterdir()):
        scene = Scene(folder)
        for part in scene.surfaces:
            name = "%s, %s" % (scene.name, part["name"])
            setattr(Mini, "test_" + name, partial(check, name, scene, part))


def check(name, scene, part):
    case = Mini()
    found = case.surface(scene, part)
    print(name, {k: None if v is None else round(v, 4) for k, v in found.items()})
    for figure, limit in LIMITS[name].items():
        at_least = figure in ("correlation", "iou")
        assert found[figure] is not None, "%s: %s could not be measured" % (name, figure)
        holds = found[figure] >= limit if at_least else found[figure] <= limit
        assert holds, "%s: %s is %.4f, and %s %.4f is wanted" % (name, figure, found[figure],
                                                                "at least" if at_least else "at most", limit)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    WEFT = Path(sys.argv.pop(1)).resolve()
    add_tests()
    unittest.main()
