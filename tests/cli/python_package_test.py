#!/usr/bin/env python3
# The Python module as pipelines use it: objects, progress, cancelling, its examples, its types, and the wheel in a virtual
# environment. usage: python_package_test.py PROGRAM SOURCE
import contextlib
import io
import os
import pathlib
import runpy
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

PROGRAM, SOURCE = sys.argv[1:3]
PACKAGE = pathlib.Path(SOURCE, "packaging", "python")
DEMO = pathlib.Path(SOURCE, "assets", "demo")
sys.path.insert(0, str(PACKAGE))
sys.dont_write_bytecode = True
import weft  # noqa: E402

PLATE, MATTE = str(DEMO / "plates" / "####.jpg"), str(DEMO / "mattes" / "wall" / "####.png")
BRICK = str(DEMO / "textures" / "brick.png")


class Scratch(unittest.TestCase):
    """Each test in a folder of its own, with a cache of its own."""

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(prefix="weft_python_")
        self.folder = pathlib.Path(self.scratch.name)
        self.before = os.getcwd()
        os.chdir(self.folder)
        self.environment = {"WEFT": PROGRAM, "HOME": str(self.folder), "XDG_CACHE_HOME": str(self.folder / "cache")}
        self.kept = {name: os.environ.get(name) for name in self.environment}
        os.environ.update(self.environment)

    def tearDown(self):
        for name, value in self.kept.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
        os.chdir(self.before)
        self.scratch.cleanup()

    def shot(self, frames="1001-1002"):
        shot = weft.Project.create("shot.weft", plate=PLATE, frames=frames, output="out/####.png", quality="draft")
        shot.add_region("wall", matte=MATTE, texture=BRICK, motion=str(DEMO / "motion" / "####.png"))
        return shot


class Objects(Scratch):
    def test_projects_and_regions(self):
        shot = self.shot()
        self.assertEqual(shot.info["plate"]["size"], [960, 540])
        wall = shot.region("wall")
        wall.set(scale=2, name="brickwork")
        self.assertEqual(wall.settings["placement"]["scale"], 2)
        self.assertEqual([region.name for region in shot], ["brickwork"])
        self.assertEqual(shot.regions[0].id, wall.id)
        shot.apply([{"action": "set_region_parameter", "region": "brickwork", "key": "placement.scale", "value": 3}])
        self.assertEqual(wall.settings["placement"]["scale"], 3)
        self.assertEqual(shot.issues(), [])
        wall.set(texture="gone.png")
        self.assertTrue(any("gone.png" in issue["message"] for issue in shot.issues()))
        with self.assertRaises(weft.Error) as caught:
            shot.region("floor")
        self.assertEqual(caught.exception.name, "usage")
        wall.remove()
        self.assertEqual(shot.regions, [])

    def test_rendering_tells_its_progress(self):
        shot, steps = self.shot(), []
        self.assertEqual(shot.estimate()["frame_count"], 2)
        report = shot.render(progress=steps.append)
        self.assertEqual([frame["frame"] for frame in report["frames"]], [1001, 1002])
        rendered = [step for step in steps if step.stage == "render"]
        self.assertEqual(sorted(step.frame for step in rendered), [1001, 1002])
        self.assertEqual(rendered[-1].fraction, 1)
        self.assertTrue(all(step.seconds >= 0 for step in steps))

    def test_a_render_is_stopped_and_goes_on(self):
        shot, cancel = self.shot("1001-1024"), weft.Cancel()

        def stop_soon(step):
            if step.stage == "render":
                threading.Thread(target=cancel.cancel).start()

        start = time.monotonic()
        with self.assertRaises(weft.Cancelled) as caught:
            shot.render(progress=stop_soon, cancel=cancel, threads=1)
        self.assertIn(caught.exception.code, (130, 143))
        self.assertTrue(cancel.cancelled)
        done = sorted(path.name for path in pathlib.Path("out").iterdir())
        self.assertGreater(len(done), 0)
        self.assertLess(len(done), 24)
        with self.assertRaises(weft.Cancelled):
            shot.render(cancel=cancel, resume=True)  # what is cancelled stays so
        report = shot.render(frames="1001-1002", resume=True)
        self.assertEqual([bool(frame.get("skipped")) for frame in report["frames"]][0], True)
        self.assertLess(time.monotonic() - start, 300)

    def test_an_exception_of_the_caller_stops_the_program(self):
        class Enough(Exception):
            pass

        def enough(step):
            raise Enough

        with self.assertRaises(Enough):
            self.shot("1001-1048").render(progress=enough, threads=1)
        self.assertLess(len(list(pathlib.Path("out").iterdir())), 48)

    def test_errors_keep_the_warnings_out(self):
        with self.assertRaises(weft.Error) as caught:
            self.shot().render("out/####.xyz", progress=lambda step: None)
        self.assertEqual(caught.exception.code, 2)
        self.assertIn("xyz", str(caught.exception))


class Examples(Scratch):
    def example(self, name, *arguments):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            code = runpy.run_path(str(PACKAGE / "examples" / name))["main"](*map(str, arguments))
        return code, out.getvalue()

    def test_all_of_them_run(self):
        plate = self.folder / "plate"
        plate.mkdir()
        for frame in (1001, 1002):
            shutil.copy(DEMO / "plates" / f"{frame}.jpg", plate)
        code, said = self.example("render_with_progress.py", plate / "####.jpg", MATTE, BRICK, "out/####.png")
        self.assertEqual(code, 0)
        self.assertRegex(said, r"render 100[12] 100%")  # two frames at a time
        self.assertIn("2 frames", said)
        _, said = self.example("motion_and_measure.py", "shot.weft", "out/####.png", MATTE, "motion")
        self.assertIn("surface moves as", said)
        self.assertIn("flicker", said)
        self.assertTrue((self.folder / "motion" / "motion.json").exists())
        library = weft.Library("library.db")
        library.add(BRICK, DEMO / "textures" / "knit.png")
        _, said = self.example("choose_texture.py", "shot.weft", library.path, "brick")
        self.assertIn("surface: ", said)
        self.assertNotEqual(weft.Project("shot.weft").region("surface").settings["texture"]["sample"], BRICK)
        found = library.search("brick")[0]
        self.assertIn("brick", library.texture(found["id"])["name"])
        self.assertIsInstance(library.similar(BRICK, count=2), list)
        ran = {"render_with_progress.py", "motion_and_measure.py", "choose_texture.py"}
        self.assertEqual({path.name for path in (PACKAGE / "examples").glob("*.py")}, ran)


class Packaging(Scratch):
    def test_types(self):
        mypy = shutil.which("mypy")
        if not mypy:
            self.skipTest("there is no mypy on this machine (apt install mypy)")
        files = [str(PACKAGE / "weft"), *map(str, (PACKAGE / "examples").glob("*.py"))]
        done = subprocess.run([mypy, "--strict", "--cache-dir", str(self.folder / "mypy"), *files],
                              stdout=subprocess.PIPE, text=True, env={**os.environ, "MYPYPATH": str(PACKAGE)})
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_everything_is_documented(self):
        for name in weft.__all__:
            one = getattr(weft, name)
            if isinstance(one, type):
                for member, value in vars(one).items():
                    if callable(value) and not member.startswith("_") and member not in ("cancel",):
                        self.assertTrue(value.__doc__, f"{name}.{member}")
            if callable(one) and one.__module__.startswith("weft"):
                self.assertTrue(one.__doc__, name)

    def test_the_version_is_the_programs(self):
        text = (PACKAGE / "pyproject.toml").read_text()
        self.assertIn(f'version = "{weft.version()["version"]}"', text)

    def test_a_wheel_in_a_virtual_environment(self):
        python = "/usr/bin/python3"
        probe = subprocess.run([python, "-c", "import setuptools, wheel, pip, ensurepip"], stderr=subprocess.DEVNULL)
        if probe.returncode:
            self.skipTest("python3-venv, python3-pip, python3-setuptools or python3-wheel is missing")
        source = shutil.copytree(PACKAGE, self.folder / "source")  # setuptools builds beside the sources
        subprocess.run([python, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "--no-index", "-w",
                        "dist", str(source)], check=True, cwd=self.folder)
        (wheel,) = (self.folder / "dist").glob("*.whl")
        subprocess.run([python, "-m", "venv", "venv"], check=True, cwd=self.folder)
        inside = str(self.folder / "venv" / "bin" / "python")
        subprocess.run([inside, "-m", "pip", "install", "-q", "--no-index", str(wheel)], check=True)
        said = subprocess.run([inside, "-c", "import weft, pathlib; print(weft.version()['backends']); "
                               "print(pathlib.Path(weft.__file__).with_name('py.typed').exists())"],
                              check=True, stdout=subprocess.PIPE, text=True, cwd="/").stdout
        self.assertIn("cpu", said)
        self.assertIn("True", said)


unittest.main(argv=sys.argv[:1])
