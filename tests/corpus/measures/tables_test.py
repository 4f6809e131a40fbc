import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import worlds  # noqa: F401

import results
import tables


def surface(name, drift, iou=None):
    return {"name": name, "motion": {"final": {"drift_worst_median_px": drift}}, "matte": {"one": {"iou": iou}}}


def header(**more):
    digest = "0" * 64
    return {"schema": results.SCHEMA, "version": 1, "commit": "a" * 40, "dirty": False, "date": "2026-01-31",
            "machine": {"cpu": "a CPU", "cores": 2, "memory_gib": 8.0, "system": "a system"}, "half": "develop",
            "seeds": [["room", 1]], "weft": "weft 0.1.0", "weft_sha256": digest, "scenes": [], **more}


def scenes(*surfaces):
    return [{"name": "room-1", "family": "room", "seed": 1, "verified": True, "failures": [],
             "surfaces": list(surfaces)}]


class Tables(unittest.TestCase):
    def test_cells_are_median_and_worst(self):
        found = header(scenes=scenes(surface("a", 1.0, 0.9), surface("b", 2.0, 0.5), surface("c", 9.0, 0.8)))
        self.assertIn("| room | 3 | 2.00 / 9.00 |", tables.by_family(found, tables.TABLES["Motion"]))
        self.assertIn("| room | 3 | 0.800 / 0.500 |", tables.by_family(found, tables.TABLES["Matte"]))

    def test_a_body_as_one_region_is_a_family_of_its_own(self):
        found = header(scenes=scenes(surface("torso", 1.0), surface("figure", 5.0)))
        rows = tables.by_family(found, tables.TABLES["Motion"])
        self.assertIn("| room | 1 | 1.00 / 1.00 |", rows)
        self.assertIn("| figure | 1 | 5.00 / 5.00 |", rows)

    def test_the_worst_come_first_and_what_was_not_measured_is_left_out(self):
        found = header(scenes=scenes(surface("a", 1.0), surface("b", None), surface("c", 9.0)))
        rows = tables.worst(found, tables.TABLES["Motion"]).splitlines()[2:]
        self.assertEqual([r.split("|")[1].strip() for r in rows], ["room-1, c", "room-1, a"])

    def test_markdown_names_failed_runs(self):
        found = header(scenes=scenes(surface("a", 1.0)))
        found["scenes"][0]["failures"] = [{"surface": "a", "measure": "light", "command": "weft", "exit_code": 3,
                                           "stderr": ["weft: no | such file"]}]
        self.assertIn("| room-1, a | light | weft: no \\| such file |", tables.markdown(found))

    def test_text_goes_between_the_markers(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            page.write_text("above\n%s\nold\n%s\nbelow\n" % (tables.BEGIN, tables.END), encoding="utf-8")
            tables.replace_between(page, "new")
            whole = page.read_text(encoding="utf-8")
            self.assertEqual(whole, "above\n%s\nnew\n%s\nbelow\n" % (tables.BEGIN, tables.END))
            page.write_text("no markers", encoding="utf-8")
            self.assertRaises(ValueError, tables.replace_between, page, "new")


    def test_scenes_whose_truth_is_not_verified_are_named(self):
        found = header()
        found["scenes"] = [{"name": n, "family": "room", "verified": v, "surfaces": [], "failures": []}
                           for n, v in (("room-1", True), ("room-2", False))]
        text = tables.markdown(found)
        self.assertIn("fails** on room-2 (", text)
        found["scenes"].pop()
        self.assertNotIn("A check of the truth", tables.markdown(found))


class Results(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        facts = {"family": "room", "seed": 1}
        self.scene = SimpleNamespace(name="room-1", facts=facts, figure=[], surfaces=[{"name": "wall"}, {"name": "floor"}])
        self.measured = {"name": "room-1", "family": "room", "seed": 1, "verified": True, "failures": [],
                         "surfaces": [{"name": "floor", "matte": {"one": {"iou": 0.5}}}]}

    def test_only_what_is_not_measured_is_measured(self):
        found = header()
        self.assertEqual(results.to_measure(found, self.scene), ["wall", "floor"])
        results.put(found, self.scene, self.measured)
        self.assertEqual(results.to_measure(found, self.scene), ["wall"])
        results.put(found, self.scene, {**self.measured, "surfaces": [{"name": "wall"}]})
        self.assertEqual([s["name"] for s in found["scenes"][0]["surfaces"]], ["wall", "floor"])
        self.assertEqual(results.to_measure(found, self.scene), [])

    def test_another_program_another_scene_or_a_failure_is_measured_again(self):
        found = header()
        results.put(found, self.scene, self.measured)
        other = {**found, "weft_sha256": "1" * 64}
        self.assertIn("floor", results.to_measure(other, self.scene))
        self.scene.facts["frames"] = 9
        self.assertIn("floor", results.to_measure(found, self.scene))
        results.put(found, self.scene, {**self.measured, "failures": [{"surface": "floor"}]})
        self.assertIn("floor", results.to_measure(found, self.scene))

    def test_results_are_validated_and_whole(self):
        path = Path(self.folder.name) / "results.json"
        found = header()
        results.put(found, self.scene, self.measured)
        results.save(path, found)
        before = path.read_bytes()
        found["scenes"][0]["surfaces"][0]["matte"]["one"]["iou"] = "good"
        self.assertRaises(results.jsonschema.ValidationError, results.save, path, found)
        self.assertEqual(path.read_bytes(), before)
        self.assertEqual(len(list(Path(self.folder.name).iterdir())), 1)

    def test_opening_keeps_the_scenes_that_are_asked_for(self):
        path = Path(self.folder.name) / "results.json"
        found = header()
        results.put(found, self.scene, self.measured)
        results.save(path, found)
        with mock.patch.object(results, "run", return_value="b" * 40):
            kept = results.opened(path, __file__, "develop", [("room", 1)], "0" * 40)
            self.assertEqual([s["name"] for s in kept["scenes"]], ["room-1"])
            self.assertEqual(results.opened(path, __file__, "develop", [("room", 2)], "0" * 40)["scenes"], [])


if __name__ == "__main__":
    unittest.main()
