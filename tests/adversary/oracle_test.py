#!/usr/bin/env python3
"""The oracle finds faults that are planted in a program of its own, and none in one that behaves."""
import os
import random
import shutil
import stat
import tempfile
import unittest

import cases
import oracle
import raw_makers
from oracle import OK, UNREADABLE, USAGE, Output, Step
from shot import Shot, plate, png

GOOD = "weft: a.png cannot be read. Copy it again."


class Planted(unittest.TestCase):
    def setUp(self):
        self.root = tempfile.mkdtemp(prefix="weft_oracle_")
        self.addCleanup(shutil.rmtree, self.root)
        self.program = os.path.join(self.root, "weft")

    def faults(self, script, step=None):
        """What the oracle finds in a run of a shell script in the shot's folder."""
        with open(self.program, "w") as file:
            file.write("#!/bin/sh\n" + script)
        os.chmod(self.program, stat.S_IRWXU)
        shot = Shot(tempfile.mkdtemp(dir=self.root), self.program, random.Random(1)).ordinary()
        shot.put("frame.png", png("plate", 0))
        step = step or Step(["render"])
        before = shot.tree()
        outcome = shot.run(step.words, step.seconds, step.stdin, step.environment)
        return oracle.judge(step, outcome, shot.shot, before, shot.tree())

    def finds(self, pattern, script, step=None):
        found = self.faults(script, step)
        self.assertEqual(len(found), 1, found)
        self.assertRegex(found[0], pattern)

    def failing(self, text, code=3, **more):
        return f"printf '{text}\\n' >&2; exit {code}", Step(["render"], exits=(USAGE, UNREADABLE), **more)

    def test_nothing_in_a_program_that_behaves(self):
        frame = Output("out/1.png", size=(64, 48), channels=3, picture=plate(0))
        self.assertEqual(self.faults("mkdir out && cp frame.png out/1.png", Step(["render"], outputs=[frame])), [])
        self.assertEqual(self.faults(*self.failing(GOOD)), [])
        self.assertEqual(self.faults("echo 'weft: warning: odd' >&2; echo '{}'", Step(["render", "--json"])), [])

    def test_inputs_that_change(self):
        self.finds("'tile.png' changed", "echo x >> tile.png")
        self.finds("'tile.png' is gone", "rm tile.png")
        self.finds("'masks/0001.png' changed", "ln -sf ../tile.png masks/0001.png")
        self.finds("'frames/0002.png' changed", "chmod 600 frames/0002.png")
        self.finds("'frames/0002.png' changed", "cp frames/0002.png x; cat x > frames/0002.png; rm x")

    def test_files_that_appear_elsewhere(self):
        self.finds("'pwned' appeared", "touch pwned")
        self.finds("'../beside' appeared", "touch ../beside")
        self.finds("'out' appeared", "mkdir out; " + self.failing(GOOD, 2)[0], self.failing(GOOD, 2)[1])
        self.finds("left behind", "mkdir out && touch out/.1.png.tmp")
        self.finds("left behind", "touch $TMPDIR/weft_x")

    def test_outputs_that_are_none(self):
        wanted = Step(["render"], outputs=[Output("out/1.png", size=(64, 48), channels=3, picture=plate(0))])
        self.finds("promised and not there", "exit 0", wanted)
        self.finds("empty", "mkdir out && : > out/1.png", wanted)
        self.finds(r"out/1\.png: ", "mkdir out && head -c 300 frame.png > out/1.png", wanted)
        self.finds(r"pixels, not \(64, 48\)", "mkdir out && cp tile.png out/1.png", wanted)
        self.finds("another picture", "mkdir out && oiiotool frame.png --invert -o out/1.png", wanted)
        self.finds("all zero", "mkdir out && oiiotool frame.png --mulc 0 -o out/1.png", Step(["render"], outputs=[Output("out/1.png")]))
        self.finds("channels", "mkdir out && oiiotool frame.png --ch 0 -o out/1.png", Step(["render"], outputs=[Output("out/1.png", channels=3)]))
        self.finds("frames, not 9", "mkdir out && ffmpeg -v error -i frame.png out/a.mkv", Step(["render"], outputs=[Output("out/a.mkv", frames=9)]))
        self.finds("empty", "mkdir out && : > out/2.exr")

    def test_exit_codes(self):
        self.finds("not documented", "echo '" + GOOD + "' >&2; exit 9")
        self.finds("exit code 3, not 0", "echo '" + GOOD + "' >&2; exit 3")
        self.finds("exit code 0, not 2", "exit 0", Step(["render"], exits=(USAGE,)))
        self.assertIn("ended by signal 11", self.faults("kill -11 $$")[0])

    def test_words(self):
        for text, fault in {GOOD + "\\n" + GOOD: "2 lines", "weft: No.": "what to do", "oops": "not Weft", "weft: Give a file that is there. Give a file that is there.": "twice",
                            "weft: Give [json.exception.type_error.302].": "library", "weft: Give \\033[31mred.": "control", "": "0 lines"}.items():
            found = self.faults(*self.failing(text))
            self.assertTrue(any(fault in f for f in found), (text, found))
        self.finds("nothing like 'deep'", *self.failing(GOOD, says=("deep",)))
        self.finds("must not match", "echo root:x", Step(["render"], silent=("root:x",)))
        self.finds("no JSON", "echo hello", Step(["render", "--json"]))
        self.finds("not tell the error", "echo {}; " + self.failing(GOOD)[0], Step(["render", "--json"], exits=(UNREADABLE,)))

    def test_bounds(self):
        self.finds("still running", "sleep 30", Step(["render"], seconds=0.5))
        self.finds("MB of memory", "exec python3 -c 'x = b\"1\" * (300 << 20)'", Step(["render"], rss_mb=200))

    def test_pictures_of_the_makers_are_what_they_say(self):
        shot = Shot(tempfile.mkdtemp(dir=self.root), "", random.Random(1))
        shot.put("a.exr", raw_makers.exr({"R": (1, 1, 1, lambda x, y: x / 64)}, (-4, -2, 11, 9), (0, 0, 7, 7)))
        shot.put("a.dpx", raw_makers.dpx([[(0.0, 0.5, 1.0)] * 6] * 4, 10))
        text = shot.tool("oiiotool", "--info", "-v", "a.exr", "a.dpx")
        for words in ("16 x   12, 1 channel, half", "pixel data origin: x=-4, y=-2", "full/display size: 8 x 8", "6 x    4, 3 channel, uint10"):
            self.assertIn(words, text)

    def test_cases_have_names_of_their_own(self):
        import adversary  # noqa: F401  reads all modules of cases
        names = [case.name for case in cases.EVERY]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreaterEqual(len(names), 500)
        self.assertLessEqual(cases.PLAIN, set(names))


if __name__ == "__main__":
    unittest.main()
