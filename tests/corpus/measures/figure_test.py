import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np
import worlds  # noqa: F401

import drift
import figure
import images
import layout
import measure

HEIGHT, WIDTH = 40, 80
TORSO, SLEEVE, WALL = 3, 5, 9
PARTS = [{"name": "torso", "id": TORSO, "surface": True}, {"name": "other sleeve", "id": SLEEVE, "surface": False},
         {"name": "wall", "id": WALL, "surface": True}]


def halves(frame):
    """The torso on the left, the sleeve on the right, which goes to the left by a pixel a frame."""
    x = np.mgrid[0:HEIGHT, 0:WIDTH][1]
    ids = np.where(x < 40, TORSO, SLEEVE)
    ids[:4] = WALL
    moved = np.where(x < 40, x, x - 40 + frame)
    rest = np.stack([moved * 0.01, np.mgrid[0:HEIGHT, 0:WIDTH][0] * 0.01, np.zeros(ids.shape)], -1)
    return SimpleNamespace(ids=ids, rest=rest.astype(np.float32), to_previous=np.zeros((HEIGHT, WIDTH, 2), np.float32))


class Figure(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.scene = layout.Scene.__new__(layout.Scene)
        self.scene.folder = Path(self.folder.name)
        self.scene.facts = {"family": "body", "seed": 1, "frames": 3, "parts": PARTS}
        for frame in self.scene.frames:
            for part in PARTS:
                share = np.float32(halves(frame).ids == part["id"])
                images.write(self.scene.file(frame, "coverage", part["name"], ending="png"), share, "uint16")
        reader = mock.patch("truth.data_of", lambda path: halves(int(path.stem)))
        reader.start()
        self.addCleanup(reader.stop)

    def truth(self):
        return figure.FigureTruth(self.scene, figure.of_scene(self.scene)[0])

    def test_is_measured_beside_the_surfaces_in_question(self):
        self.assertEqual([p["name"] for p in measure.measured_of(self.scene)], ["torso", "wall", "figure"])
        self.scene.facts["family"] = "room"
        self.assertEqual([p["name"] for p in measure.measured_of(self.scene)], ["torso", "wall"])

    def test_covers_what_its_parts_cover(self):
        share = self.truth().coverage(1)
        self.assertEqual(share[:4].max(), 0)
        self.assertEqual(share[4:].min(), 1)

    def test_no_point_of_a_part_is_found_on_another(self):
        """Both parts have the same places of their own: each must be found on itself."""
        matches = [m for _, base, m in drift.matched(self.truth()) if base == 1]
        here, there = (np.concatenate([getattr(m, k) for m in matches]) for k in ("here", "there"))
        self.assertGreater(len(here), 100)
        self.assertTrue(((here[:, 0] < 40) == (there[:, 0] < 40)).all())
        torso = here[:, 0] < 40
        self.assertLess(np.abs(there[torso] - here[torso]).max(), 0.01)
        moved = (there - here)[~torso]
        self.assertLess(np.abs(np.sort(np.unique(np.rint(moved[:, 0]))) - (1, 2)).max(), 0.01)

    def test_where_parts_meet_nothing_is_compared(self):
        smooth = self.truth().smooth(2)
        self.assertFalse(smooth[:, 39:41].any())
        self.assertTrue(smooth[20, 20] and smooth[20, 60])


if __name__ == "__main__":
    unittest.main()
