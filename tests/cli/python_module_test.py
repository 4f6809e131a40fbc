#!/usr/bin/env python3
# The Python module: what each kind of value becomes on the command line, that it has every command, and what its errors
# carry. usage: python_module_test.py PROGRAM SOURCE
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1:3]
sys.path.insert(0, os.path.join(SOURCE, "packaging", "python"))
sys.dont_write_bytecode = True
import weft  # noqa: E402

# Stands in for the program: answers with its own arguments.
ECHO = """#!%s
import json, sys
print(json.dumps({"words": sys.argv[1:], "exit_code": 0}))
""" % sys.executable


class Arguments(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="weft_python_")
        echo = os.path.join(self.folder.name, "echo")
        with open(echo, "w") as file:
            file.write(ECHO)
        os.chmod(echo, 0o755)
        os.environ["WEFT"] = echo

    def tearDown(self):
        self.folder.cleanup()

    def words(self, *given, **options):
        words = weft.run(*given, **options)["words"]
        self.assertEqual(words[-1], "--json")
        return words[:-1]

    def test_every_kind_of_value(self):
        self.assertEqual(self.words("replace", align=False), ["replace", "--align=false"])
        self.assertEqual(self.words("region", enabled=False, overwrite=True),
                         ["region", "--enabled=false", "--overwrite"])
        self.assertEqual(self.words("a", nothing=None), ["a"])
        self.assertEqual(self.words("a", threads=0, scale=1.5, rotate=-12.0),
                         ["a", "--threads=0", "--scale=1.5", "--rotate=-12.0"])
        self.assertEqual(self.words(pathlib.Path("x.weft"), output=pathlib.Path("out") / "####.png"),
                         ["x.weft", "--output=" + os.path.join("out", "####.png")])
        self.assertEqual(self.words("a", matte=["12=a.png", pathlib.Path("b.png")], holdout=()),
                         ["a", "--matte=12=a.png", "--matte=b.png"])
        self.assertEqual(self.words("a", corners=["0,0", "9,0", "9,9", "0,9"]),
                         ["a", "--corners", "0,0", "9,0", "9,9", "0,9"])
        self.assertEqual(self.words("a", texture=""), ["a", "--texture="])


class Program(unittest.TestCase):
    def setUp(self):
        os.environ["WEFT"] = PROGRAM

    def commands(self, *group):
        text = subprocess.run([PROGRAM, *group, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
        listed = re.search(r"^Commands:\n((?:  .*\n)+)", text, re.M)
        return re.findall(r"^  ([a-z]+)", listed.group(1), re.M) if listed else []

    def test_every_command_is_a_function(self):
        names = []
        for command in self.commands():
            parts = self.commands(command)
            names += [f"{command}_{part}" for part in parts] or [command]
        self.assertGreater(len(names), 30)
        for name in names:
            self.assertTrue(callable(getattr(weft, name, None)), name)
            self.assertIn(name, weft.__all__)
            self.assertIn("weft " + name.replace("_", " "), getattr(weft, name).__doc__)

    def test_errors_carry_code_message_and_field(self):
        with self.assertRaises(weft.Error) as caught:
            weft.render("nosuch.weft")
        self.assertEqual((caught.exception.code, caught.exception.name), (3, "unreadable"))
        self.assertIn("nosuch.weft", str(caught.exception))
        with self.assertRaises(weft.Error) as caught:
            weft.render("nosuch.weft", threads="many")
        self.assertEqual((caught.exception.code, caught.exception.field), (2, "--threads"))
        self.assertIn("'many'", caught.exception.message)

    def test_a_project_is_made_and_changed(self):
        with tempfile.TemporaryDirectory() as folder:
            shot = pathlib.Path(folder) / "shot.weft"
            weft.new(shot, plate="frames/####.png", output="out/####.png")
            added = weft.region_add(shot, name="wall", matte="masks/####.png", texture="brick.jpg", align=False)
            self.assertEqual(added["region"]["name"], "wall")
            weft.region_set(shot, "wall", enabled=False)
            (wall,) = weft.region_list(shot)
            self.assertFalse(wall["enabled"])
            self.assertIn('"align": false', shot.read_text())
            with self.assertRaises(weft.Error):
                weft.region_add(shot, name="wall", matte="masks/####.png", texture="brick.jpg")
            weft.region_remove(shot, "wall")
            self.assertEqual(weft.region_list(shot), [])
        self.assertEqual(weft.schema("error")["properties"]["schema"]["const"], "weft.error/1")
        self.assertIn("cpu", weft.version()["backends"])


unittest.main(argv=sys.argv[:1])
