"""Has Blender render scenes of the corpus, and composes and verifies them."""
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import compose
import verify
from layout import Scene
from tile_picture import tile_picture

SCENES = Path(__file__).resolve().parent.parent / "scenes"


class RenderError(Exception):
    pass


class Look:
    """How a scene is rendered."""

    def __init__(self, frames=24, size="640x360", samples=16):
        self.frames, self.size, self.samples = frames, size, samples


def render(corpus, family, seed, look):
    """Renders FAMILY-SEED into `corpus`; what is there and whole is kept. Returns (Scene, seconds spent)."""
    started, folder = time.time(), Path(corpus) / ("%s-%d" % (family, seed))
    if not (folder / "verified.json").exists():
        partial = Path(corpus) / (".partial-%s-%d" % (family, seed))
        shutil.rmtree(partial, ignore_errors=True)
        partial.mkdir(parents=True)
        if family == "drawn":
            draw(seed, partial, look)
        else:
            photograph(corpus, family, seed, partial, look)
        if not (partial / "tile.png").exists():
            shutil.copy(tile_of(corpus), partial / "tile.png")
        verify.verify(Scene(partial))
        shutil.rmtree(folder, ignore_errors=True)
        os.replace(partial, folder)
    check_look(Scene(folder), look)
    return Scene(folder), time.time() - started


def check_look(scene, look):
    """A scene that is there is kept, but not taken for one of another length or size."""
    width, height = scene.facts.get("size") or scene.facts["camera"]["size"]
    there = (scene.facts["frames"], "%dx%d" % (width, height))
    if there != (look.frames, look.size):
        raise RenderError("%s has %d frames of %s, not %d of %s: remove it, or name another folder with --corpus" % (
            scene.folder, *there, look.frames, look.size))


def tile_of(corpus):
    path = Path(corpus) / "tile.png"
    if not path.exists():
        tile_picture(path)
    return path


def photograph(corpus, family, seed, folder, look):
    command = ["blender", "-b", "--factory-startup", "-noaudio", "-P", str(SCENES / "render_scene.py"), "--", family,
               str(seed), str(folder), str(look.frames), look.size, str(look.samples), str(tile_of(corpus))]
    log = folder / "blender.log"
    try:
        with open(log, "wb") as out:
            run = subprocess.run(command, stdout=out, stderr=subprocess.STDOUT, check=False,
                                 env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
    except FileNotFoundError:
        raise RenderError("blender is not installed: apt-get install blender (3.4 of Debian 12)") from None
    if run.returncode:
        raise RenderError("Blender stopped at %s-%d; the last lines of %s:\n%s" % (
            family, seed, log, "\n".join(log.read_text(errors="replace").splitlines()[-15:])))
    log.unlink()
    compose.arrange(folder)
    compose.compose(folder, seed)


def draw(seed, folder, look):
    sys.path.insert(0, str(SCENES))
    import drawings
    drawings.make(seed, str(folder), look.frames, tuple(int(n) for n in look.size.split("x")))
