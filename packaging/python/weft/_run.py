"""Runs the program and reads what it answers: the one place of the module that starts a process."""
from __future__ import annotations

import json
import os
import signal
import subprocess
import threading
from typing import IO, Any, Callable, Dict, Iterator, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

PathOrText = Union[str, int, float, "os.PathLike[str]"]
One = Union[None, bool, PathOrText]
Value = Union[One, Sequence[One]]
"""What an option may be given."""
Answer = Dict[str, Any]
"""An object that a command printed with --json."""

DIFFERS = 8
CANCELLED = (128 + signal.SIGINT, 128 + signal.SIGTERM)


class Error(RuntimeError):
    """A command that failed.

    code: its exit code (docs/CLI.md); name: the code's name, such as "unreadable"; message: one line that says what is
    wrong, where, and what to do; field: the option or project path that the error is about, or None; remedy: what to
    do, or None; answer: the whole object that the command printed.
    """

    def __init__(self, code: int, message: str, name: Optional[str] = None, field: Optional[str] = None,
                 remedy: Optional[str] = None, answer: Optional[Answer] = None) -> None:
        super().__init__(message)
        self.code, self.message = code, message
        self.name, self.field, self.remedy = name, field, remedy
        self.answer: Answer = answer if answer is not None else {}


class Cancelled(Error):
    """A command that was stopped by a Cancel, or by a signal from elsewhere. Frames that were finished stay."""


class Progress(NamedTuple):
    """A finished step of a command."""

    stage: str  #: "analyse", "render", "export" or "wait"
    frame: int
    done: int  #: steps, of `total`
    total: int
    seconds: float  #: that the step took

    @property
    def fraction(self) -> float:
        """How much of the stage is done, 0 to 1."""
        return self.done / self.total if self.total else 1.0


class Cancel:
    """Stops commands that it was given to: cancel() may be called from any thread, before or while they run."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._cancelled = False
        self._running: List["subprocess.Popen[str]"] = []

    def cancel(self) -> None:
        with self._lock:
            self._cancelled = True
            for process in self._running:
                process.terminate()

    @property
    def cancelled(self) -> bool:
        return self._cancelled

    def _enter(self, process: "subprocess.Popen[str]") -> None:
        with self._lock:
            self._running.append(process)
            if self._cancelled:
                process.terminate()

    def _leave(self, process: "subprocess.Popen[str]") -> None:
        with self._lock:
            self._running.remove(process)


ProgressFn = Callable[[Progress], None]


def program() -> str:
    """The program that is run: the one named by the environment variable WEFT, else `weft` on the PATH."""
    return os.environ.get("WEFT", "weft")


def text_of(value: PathOrText) -> str:
    return os.fspath(value) if isinstance(value, os.PathLike) else str(value)


def options_of(options: Mapping[str, Value]) -> Iterator[str]:
    """The command line's words for keyword arguments."""
    for name, value in options.items():
        flag = "--" + name.rstrip("_").replace("_", "-")  # an option may have a keyword's name: from_=
        values: Sequence[One] = value if isinstance(value, (list, tuple)) else [value]  # type: ignore[list-item]
        if name == "corners":  # the one option of several words
            yield flag
            yield from (text_of(one) for one in values if one is not None)
            continue
        for one in values:
            if one is None:
                continue
            if one is True:
                yield flag
            elif one is False:
                yield flag + "=false"
            else:
                # In one word, so that a value may begin with a hyphen.
                yield flag + "=" + text_of(one)


def _progress_of(line: str) -> Optional[Progress]:
    if not line.startswith("{"):
        return None
    try:
        step = json.loads(line)
        return Progress(step["stage"], step["frame"], step["done"], step["total"], step["seconds"])
    except (ValueError, KeyError, TypeError):
        return None


def _finish(process: "subprocess.Popen[str]", progress: Optional[ProgressFn]) -> Tuple[str, List[str]]:
    """What the process prints to stdout, and the lines of stderr that are no progress."""
    messages: List[str] = []
    printed: List[str] = []
    out, err = process.stdout, process.stderr
    assert out and err

    def read_out(stream: IO[str]) -> None:
        printed.append(stream.read())

    reader = threading.Thread(target=read_out, args=(out,))
    reader.start()
    try:
        for line in err:
            step = _progress_of(line) if progress else None
            if step is None:
                messages.append(line.strip())
            elif progress:
                progress(step)
    except BaseException:
        # Of the caller's function, or a key: nothing goes on behind the caller's back.
        process.terminate()
        for line in err:
            messages.append(line.strip())
        raise
    finally:
        reader.join()
        process.wait()
        out.close()
        err.close()
    return "".join(printed), messages


def run(*words: PathOrText, progress: Optional[ProgressFn] = None, cancel: Optional[Cancel] = None,
        **options: Any) -> Answer:
    """Runs `weft WORDS… --json` and returns the object that it printed.

    progress: called with each finished step, on this thread; an exception in it stops the command. cancel: stops the
    command. Raises Error, and Cancelled where the command was stopped.
    """
    command = [program(), *map(text_of, words), *options_of(options)]
    if progress:
        command.append("--progress=json")
    command.append("--json")
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True,
                          encoding="utf-8", errors="replace") as process:
        if cancel:
            cancel._enter(process)
        try:
            printed, messages = _finish(process, progress)
        finally:
            if cancel:
                cancel._leave(process)
        code = process.returncode
    kind = Cancelled if code in CANCELLED or code in (-signal.SIGTERM, -signal.SIGINT) else Error
    try:
        answer: Answer = json.loads(printed)
    except ValueError:
        said = [message for message in messages if message]
        raise kind(code, said[-1] if said else f"weft ended with {code}") from None
    if "error" in answer:
        error = answer["error"]
        raise kind(code, error["message"], error["name"], error.get("field"), error.get("remedy"), answer)
    if code not in (0, DIFFERS):
        raise kind(code, f"weft ended with {code}", answer=answer)
    return answer
