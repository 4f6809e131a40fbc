#!/usr/bin/env python3
# The parts of Blender's add-on that need no Blender: its reader of EXR, the options that it gives, and the texture that it
# gathers. usage: addon_test.py SOURCE
import os
import struct
import sys
import tempfile
import unittest

SOURCE = sys.argv[1]
SKIPPED = 77
try:
    import numpy as np
    import OpenImageIO as oiio
except ImportError as missing:
    print(f"SKIPPED: {missing} (apt install python3-numpy python3-openimageio)")
    sys.exit(SKIPPED)

# Its modules without its __init__, which needs Blender.
import importlib.machinery  # noqa: E402
import importlib.util  # noqa: E402

FOLDER = os.path.join(SOURCE, "packaging", "blender", "weft_blender")
sys.dont_write_bytecode = True
package = importlib.util.module_from_spec(importlib.machinery.ModuleSpec("weft_blender", None, is_package=True))
package.__path__ = [FOLDER]
sys.modules["weft_blender"] = package
from weft_blender import exr, gather, passes  # noqa: E402


class Scratch(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="weft_addon_")

    def tearDown(self):
        self.folder.cleanup()

    def path(self, name="a.exr"):
        return os.path.join(self.folder.name, name)

    def put(self, channels, compression="zip", name="a.exr", offset=(0, 0)):
        """Channels: name -> (format, picture)."""
        height, width = next(iter(channels.values()))[1].shape
        spec = oiio.ImageSpec(width, height, len(channels), "float")
        spec.x, spec.y = offset
        spec.channelnames = tuple(channels)
        spec.channelformats = tuple(oiio.TypeDesc(kind) for kind, _ in channels.values())
        spec.attribute("compression", compression)
        out = oiio.ImageOutput.create("x.exr")
        self.assertTrue(out.open(self.path(name), spec), out.geterror())
        out.write_image(np.dstack([picture for _, picture in channels.values()]).astype(np.float32))
        out.close()


class Reader(Scratch):
    def test_all_that_blender_and_weft_write(self):
        chance = np.random.RandomState(1)
        for compression in ("zip", "zips", "none"):
            for size in ((37, 53), (16, 8), (1, 1)):
                pictures = {"a.X": ("float", chance.randn(*size)), "b": ("half", chance.rand(*size)),
                            "b.Z": ("half", np.zeros(size))}
                name = f"{compression}_{size[0]}.exr"  # OpenImageIO remembers what it read
                self.put(pictures, compression, name, offset=(3, -5))
                buffer = oiio.ImageBuf(self.path(name))
                there, names = buffer.get_pixels(oiio.FLOAT), list(buffer.spec().channelnames)
                self.assertEqual(exr.channel_names(self.path(name)), sorted(pictures))
                for name, picture in exr.read(self.path(name), ["a.X", "b"]).items():
                    self.assertTrue(np.array_equal(picture, there[:, :, names.index(name)]), (compression, size, name))

    def test_what_is_damaged_is_an_error(self):
        self.put({"a": ("half", np.random.RandomState(2).rand(40, 40))})
        with open(self.path(), "rb") as file:
            whole = file.read()
        for length in (0, 3, 8, 60, len(whole) // 2, len(whole) - 1):
            with open(self.path(), "wb") as file:
                file.write(whole[:length])
            with self.assertRaises(exr.Unreadable, msg=length):
                exr.read(self.path(), ["a"])
        # A header that claims 2 GB.
        at = whole.index(b"channels\0chlist\0") + len(b"channels\0chlist\0")
        with open(self.path(), "wb") as file:
            file.write(whole[:at] + struct.pack("<i", 2147483647) + whole[at + 4:])
        with self.assertRaises(exr.Unreadable):
            exr.channel_names(self.path())
        self.put({"a": ("half", np.zeros((4, 4)))}, "piz")
        with self.assertRaisesRegex(exr.Unreadable, "ZIP"):
            exr.read(self.path(), ["a"])
        self.put({"a": ("half", np.zeros((4, 4)))})
        with self.assertRaisesRegex(exr.Unreadable, "no channel b"):
            exr.read(self.path(), ["b"])


class Passes(unittest.TestCase):
    CHANNELS = [f"L.{name}" for name in ("Combined.R", "Vector.X", "Position.X", "Normal.X", "Depth.Z", "UV.U",
                                         "DiffDir.R", "DiffInd.R", "DiffCol.R", "CryptoObject00.r")]

    def test_a_project_uses_them(self):
        options = passes.region_options("cg/####.exr", passes.found(self.CHANNELS, "L"), 40, True)
        text = " ".join(options)
        for part in ("--motion cg/####.exr --motion-convention blender --motion-layer L.Vector",
                     "--position-pass cg/####.exr --position-layer L.Position", "--normal-space world",
                     "--depth-layer L.Depth", "--fov 40.0000", "--light-layer L.DiffDir+L.DiffInd"):
            self.assertIn(part, text)
        self.assertNotIn("--motion", passes.region_options("f", passes.found(self.CHANNELS, "L"), 40, False))
        self.assertEqual(passes.region_options("f", passes.found(self.CHANNELS, "M"), None, True), [])
        newer = passes.found(["L.Diffuse Color.R", "L.Depth.V"], "L")
        self.assertIn("L.Diffuse Color", passes.region_options("f", newer, None, True))

    def test_names_of_objects(self):
        self.assertEqual(passes.quoted_object('Wall, "a" * \\'), 'crypto:Wall\\, \\"a\\" \\* \\\\')
        self.assertTrue(passes.has_cryptomatte(self.CHANNELS, "L"))
        self.assertFalse(passes.has_cryptomatte(self.CHANNELS, "M"))


class Gather(Scratch):
    def test_the_texture_is_found_again(self):
        side = 64
        v, u = np.mgrid[0:side, 0:side] / side
        true = np.dstack([0.5 + 0.4 * np.sin(6.28 * u), 0.5 + 0.4 * np.cos(6.28 * v), 0.3 + 0 * u])
        paths = []
        for frame in range(3):
            y, x = np.mgrid[0:90, 0:120].astype(float)
            s, t = x / 100 + 0.013 * frame, 1 - y / 80 - 0.007 * frame  # beyond 0 to 1, too: a texture repeats
            i, j = np.floor(s * side).astype(int) % side, np.floor(t * side).astype(int) % side
            inside = (x > 4) & (x < 112) & ~((x > 50) & (x < 60))
            colours = true[j, i] * inside[..., None]
            self.put({"L.UV.U": ("float", s), "L.UV.V": ("float", t), "matte.A": ("half", inside.astype(float)),
                      **{f"texture.{c}": ("half", colours[..., k]) for k, c in enumerate("RGB")}}, name=f"{frame}.exr")
            paths.append((self.path(f"{frame}.exr"),) * 2)
        found, shown = gather.gathered(paths, "L", side)
        self.assertLess(np.abs(found - true).mean(), 0.03)
        self.assertGreater(shown, 0.85)
        self.assertLess(shown, 1, "a strip was never seen, and is filled")

    def test_nothing_seen(self):
        zero = np.zeros((8, 8))
        self.put({name: ("half", zero) for name in ("L.UV.U", "L.UV.V", "matte.A", "texture.R", "texture.G",
                                                    "texture.B")})
        with self.assertRaises(gather.NothingSeen):
            gather.gathered([(self.path(), self.path())], "L", 16)


unittest.main(argv=sys.argv[:1])
