"""Runs Weft. The add-on changes projects through the program alone."""
import json
import os
import shutil
import subprocess


class Failed(Exception):
    """What Weft said."""


def find(given):
    """The program: the one of the preferences, else of the variable WEFT, else on the PATH. Raises Failed."""
    for name in (given, os.environ.get("WEFT"), "weft"):
        found = shutil.which(name) if name else None
        if found:
            return found
    raise Failed("Weft is not found: set its program in the add-on's preferences.")


def run(weft, folder, *words, progress=None):
    """Runs `weft WORDS… --json` in a folder and returns its answer; progress(done, total) of a render. Raises Failed."""
    command = [weft, *map(str, words), "--json"]
    if progress:
        command.append("--progress=json")
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                          text=True, errors="replace", env={**os.environ, "PYTHONPATH": ""}) as process:
        said = ""
        for line in process.stderr:
            step = _step(line) if progress else None
            if step:
                progress(*step)
            else:
                said = line.strip() or said
        printed = process.stdout.read()
    try:
        answer = json.loads(printed)
    except ValueError:
        raise Failed(said or f"Weft ended with {process.returncode}.") from None
    if "error" in answer:
        raise Failed(answer["error"]["message"])
    return answer


def _step(line):
    try:
        step = json.loads(line)
        return (step["done"], step["total"]) if step["stage"] == "render" else (0, 0)
    except (ValueError, KeyError, TypeError):
        return None
