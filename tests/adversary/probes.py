"""What other programs say of a file: OpenImageIO's oiiotool of pictures, FFmpeg's ffprobe of movies."""
import json
import os
import re
import subprocess
import tempfile
from dataclasses import dataclass

PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr", ".dpx")
MOVIES = (".mp4", ".mkv", ".mov", ".avi")


@dataclass
class Picture:
    size: tuple
    channels: int
    largest: float  # of all samples; 1 is white in integer files
    part: int  # the first that has R, G and B; 0 where none has


class Unreadable(Exception):
    pass


def _run(*words):
    done = subprocess.run([os.fsencode(str(w)) for w in words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, timeout=60)
    if done.returncode != 0:
        raise Unreadable(done.stderr.decode(errors="replace").strip() or done.stdout.decode(errors="replace").strip())
    return done.stdout


def _described(text):
    """One file's part of what --info and --stats print."""
    sizes = re.findall(r"(\d+) x +(\d+), (\d+) channel", text)
    largest = 0.0
    for values, top in re.findall(r"Stats Max:((?: +[-\w.+]+)+) \((?:of )?(\w+)\)", text):
        scale = float(top) if top.isdigit() else 1.0
        largest = max([largest] + [float(v) / scale for v in values.split() if v not in ("nan", "-nan")])
    display = re.search(r"full/display size: (\d+) x (\d+)", text)
    size = display.groups() if display else sizes[0][:2]
    listed = sizes[1:] if len(sizes) > 1 else sizes
    lists = [set(re.findall(r"\w+", names)) for names in re.findall(r"channel list: (.*)", text)]
    part = next((i for i, names in enumerate(lists) if {"R", "G", "B"} <= names), 0)
    return Picture((int(size[0]), int(size[1])), sum(int(s[2]) for s in listed), largest, part)


def _plainly_named(paths, folder):
    """Links of plain names: oiiotool takes '#', '%', '?' and braces in names for patterns and expressions."""
    links = []
    for index, path in enumerate(paths):
        links.append(os.path.join(folder, f"{index:05}{os.path.splitext(path)[1].lower()}"))
        os.symlink(os.path.abspath(path), links[-1])
    return links


def pictures(paths):
    """Path -> Picture, or an Unreadable. Channels are those of all parts together."""
    if not paths:
        return {}
    try:
        with tempfile.TemporaryDirectory() as folder:
            text = _run("oiiotool", "--wildcardoff", "--info:verbose=1", "-a", "--stats", *_plainly_named(paths, folder)).decode()
        starts = [m.start() for m in re.finditer(r"\s:\s+\d+ x +\d+, \d+ channel", text)] + [len(text)]
        if len(starts) == len(paths) + 1:
            return {path: _described(text[starts[i]:starts[i + 1]]) for i, path in enumerate(paths)}
        if len(paths) == 1:
            raise Unreadable(f"{len(starts) - 1} pictures in: {text}")
    except Unreadable as error:
        if len(paths) == 1:
            return {paths[0]: error}
    return {path: pictures([path])[path] for path in paths}


def rgb8(path, linear, width, part=0):
    """Rows of (r, g, b) as 8-bit sRGB codes."""
    with tempfile.TemporaryDirectory() as folder:
        made = os.path.join(folder, "made.ppm")
        _run("oiiotool", *_plainly_named([path], folder), *(("--subimage", part) if part else ()), "--croptofull", *(("--colorconvert", "linear", "sRGB") if linear else ()),
             "--ch", "R,G,B" if linear else "0,1,2", "-d", "uint8", "-o", made)
        with open(made, "rb") as file:
            raw = file.read()
    match = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", raw)
    if not match or int(match.group(1)) != width:
        raise Unreadable(f"{path}: no picture of {width} pixels in width")
    data = raw[match.end():]
    return [[tuple(data[3 * (y * width + x):3 * (y * width + x) + 3]) for x in range(width)]
            for y in range(int(match.group(2)))]


def movie(path):
    """(width, height), number of frames that decode."""
    text = _run("ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
                "stream=width,height,nb_read_frames", "-of", "json", "file:" + path)
    streams = json.loads(text).get("streams", [])
    if not streams:
        raise Unreadable(f"{path}: no picture stream")
    return (streams[0]["width"], streams[0]["height"]), int(streams[0].get("nb_read_frames", 0))
