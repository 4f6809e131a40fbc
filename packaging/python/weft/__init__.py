"""Weft from Python: a thin layer over the command line, without dependencies.

    import weft
    report = weft.replace(plate="frames/####.png", matte="masks/####.png", texture="wool.jpg", output="out/####.png")
    print(report["fps"], report["warnings"])

Keyword arguments are the command's options with _ for -: a list repeats an option, True is a flag, None is left out.
"""
import json
import os
import subprocess

__all__ = ["Error", "run", "replace", "render", "verify", "info", "cryptomatte", "submit", "version"]


class Error(RuntimeError):
    """A command that failed: `code` is its exit code (docs/CLI.md), the message is the program's own."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def _program():
    return os.environ.get("WEFT", "weft")


def _options(options):
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            yield flag
            continue
        for one in value if isinstance(value, (list, tuple)) else [value]:
            yield flag
            yield str(one)


def run(*words, **options):
    """Runs a command and returns what it printed. Raises Error."""
    done = subprocess.run([_program(), *map(str, words), *_options(options)], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        raise Error(done.returncode, lines[-1] if lines else f"weft ended with {done.returncode}")
    return done.stdout


def _json(*words, **options):
    return json.loads(run(*words, json=True, **options))


def replace(**options):
    """weft replace; returns the report."""
    return _json("replace", **options)


def render(project, **options):
    """weft render; returns the report."""
    return _json("render", project, **options)


def verify(recipe, **options):
    """weft verify; True when the frames are proved."""
    try:
        return _json("verify", recipe, **options)["proved"]
    except Error as error:
        if error.code == 8:
            return False
        raise


def info(project):
    """weft info, as a dictionary."""
    return _json("info", project)


def cryptomatte(frame, **options):
    """weft cryptomatte: a list of objects."""
    return _json("cryptomatte", frame, **options)


def submit(project, to, output, **options):
    """weft submit; returns the files it wrote."""
    return _json("submit", project, to=to, output=output, **options)["files"]


def version():
    """The text of weft --version."""
    return run("--version").strip()
