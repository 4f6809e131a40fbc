"""Runs of weft: what each took, and what failed. A failed run is a record, so that the rest is still measured."""
import json
import os
import resource
import shlex
import subprocess
import time
from pathlib import Path

STDERR_LINES = 8


class RunFailed(Exception):
    """`record`: {command, exit_code, stderr}."""

    def __init__(self, record):
        super().__init__(record["stderr"][-1] if record["stderr"] else "weft failed")
        self.record = record


class Runs:
    """Runs `weft` with a cache in `work`. `seconds`: {name of the run: {wall, cpu}} of all that were done.

    One run at a time, since CPU seconds are those of all children that have ended."""

    def __init__(self, weft, work, timeout_s=900):
        self.weft, self.work, self.timeout_s = str(weft), Path(work), timeout_s
        self.cache = self.work / "cache"
        self.work.mkdir(parents=True, exist_ok=True)
        self.seconds = {}

    def __call__(self, name, *arguments):
        """What `weft ARGUMENTS --json` prints, as an object. Raises RunFailed."""
        command = [self.weft] + [str(a) for a in arguments] + ["--json", "--cache", str(self.cache)]
        before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        environment = dict(os.environ, LC_ALL="C.UTF-8")
        try:
            done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace",
                                  timeout=self.timeout_s, env=environment, check=False)
            code, out, err = done.returncode, done.stdout, done.stderr
        except subprocess.TimeoutExpired:
            code, out, err = None, "", "ended after %d s" % self.timeout_s
        except OSError as error:
            code, out, err = None, "", str(error)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.seconds[name] = {"wall": round(time.monotonic() - started, 3), "cpu": round(cpu, 3)}
        try:
            said = json.loads(out) if code == 0 else None
        except ValueError:
            said, err = None, err + "\nno JSON on its standard output"
        if said is None:
            raise RunFailed({"command": shlex.join(command), "exit_code": code,
                             "stderr": err.strip().splitlines()[-STDERR_LINES:]})
        return said

    def render(self, name, plate, options, ending="png", layers=None):
        """`weft replace` into the folder `name`: (its report, the frames' pattern, the layers' pattern or None)."""
        frames = self.work / name / ("####." + ending)
        arguments = ["replace", "--plate", plate, *options, "-o", frames, "--overwrite", "--progress", "none"]
        kept = self.work / (name + "-layers") / "####.exr" if layers else None
        if layers:
            arguments += ["--layers", layers, "--layers-output", kept]
        return self(name, *arguments), str(frames), str(kept) if layers else None


def frame_file(pattern, frame):
    return pattern.replace("####", "%04d" % frame)
