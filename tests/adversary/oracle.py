"""What must hold of every run, whatever was asked of it."""
import fnmatch
import json
import os
import re
import stat
from dataclasses import dataclass, field
from typing import Optional

import probes

DOCUMENTED = {0, 1, 2, 3, 4, 5, 6, 7, 8}
OK, FAILED, USAGE, UNREADABLE, MISSING, BACKEND, SPACE, POLICY, DIFFERS = range(9)

# What the libraries below Weft say, and what C++ says when nobody catches.
FOREIGN = re.compile(
    r"json\.exception|\{json|FAILED|std::|terminate called|what\(\)|\[default\]|bad_alloc|\bOIIO\b|OpenImageIO|OpenCV\(|"
    r"cv::|Imf_|Iex|IEX|libpng|libtiff|TIFFOpen|INT:INT|UINT|TEXT:|FLOAT in|\{false\}|\{true\}|basic_string|vector::|"
    r"Segmentation|AddressSanitizer|runtime error|Assertion|syntax error while|parse error at|SQLITE|nullptr|(?<!\d)0x[0-9a-f]{6,}")
REMEDY = re.compile(
    r"\b(give|use|add|check|choose|write|remove|delete|rename|make|set|try|pass|name|run|move|free|copy|install|convert|"
    r"select|lower|raise|save|export|split|take|close|start|put|see|expected|must|allowed|between|one of|needs?|wanted|"
    r"leave|keep|correct|repair|replace|supply|render|submit|open|lists?|ask|mark|trust|quote|limit|point|paint|provide|"
    r"change|create|restore|update|end|begin|drop|reduce|fit|allows?|build|train|encode|import|overwrite|resume|enable|specify|read|decode|lie|lies)\b", re.I)
CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")


@dataclass
class Output:
    """A file that the run promises. picture: rows of (r, g, b), compared in the frame's outermost two pixels."""
    path: str
    size: tuple = None
    channels: int = None      # at least
    frames: int = None        # of a movie
    picture: Optional[list] = None
    tolerance: float = 6.0    # mean absolute difference in 8-bit levels
    linear: bool = False
    lit: bool = True          # not all zero


@dataclass
class Step:
    """One run and what is known of it beforehand."""
    words: list
    exits: tuple = (OK,)
    outputs: list = field(default_factory=list)
    may_write: tuple = ("out", "out/**")  # besides the cache and temporary files
    says: tuple = ()          # patterns that stderr must match
    silent: tuple = ()        # patterns that neither stream may match
    seconds: float = 60
    rss_mb: float = 900
    stdin: str = "/dev/null"
    environment: dict = field(default_factory=dict)
    outcome: object = None    # set when it has run


def matches(name, patterns):
    return any(fnmatch.fnmatchcase(name, p) or (p.endswith("/**") and name.startswith(p[:-2])) for p in patterns)


def changes(before, after, may_write):
    """What happened to files that the run had no business with."""
    found = []
    for name in sorted(before.keys() | after.keys()):
        if before.get(name) == after.get(name) or matches(name, may_write):
            continue
        what = "appeared" if name not in before else "is gone" if name not in after else "changed"
        found.append(f"{name!r} {what}")
    return found


def leftovers(before, after, outputs):
    """Temporary files and folders that are still there."""
    promised_names = [o.path for o in outputs]
    return [f"{name!r} was left behind" for name in sorted(after.keys() - before.keys())
            if name.startswith("../tmp/") or (os.path.basename(name).startswith(".") and not name.startswith("../home/") and
                                              not any(p == name or p.startswith(name + "/") for p in promised_names))]


def messages(step, outcome):
    """Form of what was said."""
    found = []
    for stream, text in (("stdout", outcome.out), ("stderr", outcome.err)):
        hit = CONTROL.search(text.replace("\t", " "))
        if hit:
            found.append(f"{stream} holds the control character {hit.group()!r}")
        hit = FOREIGN.search(text if stream == "stderr" else "")
        if hit:
            found.append(f"{stream} holds a library's own words: {hit.group()!r}")
        for pattern in step.silent:
            if re.search(pattern, text):
                found.append(f"{stream} must not match {pattern!r}")
    lines = outcome.err.splitlines()
    machine = "--json" in step.words or "json" in step.words or "openjd" in step.words
    spoken = [l for l in lines if not (machine and (l.startswith("{") or l.startswith("frame ") or l.startswith("analyse ")))]
    strange = [l for l in spoken if not l.startswith("weft: ")]
    if strange:
        found.append(f"stderr has a line that is not Weft's: {strange[0]!r}")
    errors = [l for l in spoken if l.startswith("weft: ") and not l.startswith("weft: warning: ")]
    if outcome.exit not in (OK, DIFFERS):
        if len(errors) != 1:
            found.append(f"{len(errors)} lines of error on stderr, not one")
        elif not REMEDY.search(errors[0]):
            found.append(f"the error says nothing of what to do: {errors[0]!r}")
    for line in spoken:
        sentences = [s.strip() for s in re.split(r"(?<=[.!?]) ", line[6:]) if len(s) > 12]
        if len(sentences) != len(set(sentences)):
            found.append(f"a sentence stands twice: {line!r}")
        if len(line) > 1500 + 3 * max(map(len, step.words)):
            found.append(f"a line of {len(line)} characters: {line[:120]!r}…")
    for pattern in step.says:
        if not re.search(pattern, outcome.err):
            found.append(f"stderr says nothing like {pattern!r}")
    return found


def machine_readable(step, outcome):
    """With --json stdout is one JSON value, errors included."""
    if "--json" not in step.words or "--help" in step.words:
        return []
    try:
        value = json.loads(outcome.out)
    except ValueError:
        return [f"--json gives no JSON value: {outcome.out[:120]!r}"]
    if outcome.exit not in (OK, DIFFERS) and not (isinstance(value, dict) and ("error" in value or "exit" in value or
                                                                           "exit_code" in value)):
        return [f"--json does not tell the error: {outcome.out[:200]!r}"]
    return []


def edge_difference(one, other):
    """Mean absolute difference of the outermost two pixels, where no matte is."""
    height, width, total, count = len(one), len(one[0]), 0, 0
    for y in range(height):
        edge = y < 2 or y >= height - 2
        for x in range(width) if edge else (0, 1, width - 2, width - 1):
            total += sum(abs(a - b) for a, b in zip(one[y][x], other[y][x]))
            count += 3
    return total / count


def promised(outputs, folder):
    """Faults of promised files."""
    found, there = [], []
    for output in outputs:
        path = os.path.join(folder, output.path)
        if not os.path.exists(path):
            found.append(f"{output.path}: promised and not there")
        elif os.path.getsize(path) == 0:
            found.append(f"{output.path}: empty")
        else:
            there.append((output, path))
    images = [(o, path) for o, path in there if path.lower().endswith(probes.PICTURES)]
    seen = probes.pictures([path for _, path in images])
    compared = [o for o, path in images if o.picture]
    for output, path in images:
        # Of a sequence the first and the last are compared; between them stands nothing else.
        found += picture_faults(output, path, seen[path], output in (compared[:1] + compared[-1:]))
    for output, path in there:
        if path.lower().endswith(probes.MOVIES):
            found += movie_faults(output, path)
    return found


def picture_faults(output, path, seen, compare):
    if isinstance(seen, probes.Unreadable):
        return [f"{output.path}: {seen}"]
    if output.size and tuple(seen.size) != tuple(output.size):
        return [f"{output.path}: {seen.size} pixels, not {output.size}"]
    found = []
    if output.channels and seen.channels < output.channels:
        found.append(f"{output.path}: {seen.channels} channels, not {output.channels}")
    if output.lit and not seen.largest > 0:
        found.append(f"{output.path}: all zero")
    if compare:
        try:
            off = edge_difference(probes.rgb8(path, output.linear, seen.size[0], seen.part), output.picture)
            if off > output.tolerance:
                found.append(f"{output.path}: another picture than the plate's outside of the matte, {off:.1f} levels off")
        except probes.Unreadable as error:
            found.append(f"{output.path}: {error}")
    return found


def movie_faults(output, path):
    try:
        size, frames = probes.movie(path)
    except probes.Unreadable as error:
        return [f"{output.path}: {error}"]
    found = []
    if output.frames is not None and frames != output.frames:
        found.append(f"{output.path}: {frames} frames, not {output.frames}")
    if output.size and tuple(size) != tuple(output.size):
        found.append(f"{output.path}: {size} pixels, not {output.size}")
    return found


def readable(folder, before, after, known):
    """Every picture or movie that a run left is whole, also when it failed."""
    left = [name for name, entry in sorted(after.items()) if stat.S_ISREG(entry.kind) and before.get(name) != entry and
            name not in known and name.startswith("out/")]
    return promised([Output(name, lit=False) for name in left if name.lower().endswith(probes.PICTURES + probes.MOVIES)], folder)


def judge(step, outcome, folder, before, after):
    """All faults of a run, as texts; none: it kept what is promised."""
    found = []
    if outcome.timed_out:
        return [f"still running after {step.seconds:.0f} s"]
    if outcome.exit < 0:
        found.append(f"ended by signal {-outcome.exit}")
    elif outcome.exit not in DOCUMENTED:
        found.append(f"exit code {outcome.exit} is not documented")
    elif outcome.exit not in step.exits:
        found.append(f"exit code {outcome.exit}, not {' or '.join(map(str, step.exits))}")
    if outcome.peak_rss_mb > step.rss_mb:
        found.append(f"{outcome.peak_rss_mb:.0f} MB of memory, more than {step.rss_mb}")
    # A refused request writes nothing at all.
    allowed = () if outcome.exit == USAGE else step.may_write
    found += changes(before, after, ("../home/**", "../tmp/**", *allowed))
    found += leftovers(before, after, step.outputs)
    found += messages(step, outcome)
    found += machine_readable(step, outcome)
    if outcome.exit in (OK, DIFFERS):
        found += promised(step.outputs, folder)
    found += readable(folder, before, after, {o.path for o in step.outputs} if outcome.exit in (OK, DIFFERS) else set())
    return found
