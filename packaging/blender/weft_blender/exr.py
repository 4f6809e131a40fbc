"""Reads EXR files as Blender and Weft write them: scan lines, not compressed or by ZIP. Blender gives scripts no access
to the layers of an image, and not every Blender has OpenImageIO's module. Needs numpy, which Blender has, and no Blender."""
import struct
import zlib

import numpy as np

NONE, ZIPS, ZIP = 0, 2, 3
LINES = {NONE: 1, ZIPS: 1, ZIP: 16}
SAMPLES = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}
LARGEST_HEADER = 1 << 20


class Unreadable(Exception):
    """A file that cannot be read, with the reason."""


def _header(file, name):
    magic, version = struct.unpack("<II", file.read(8))
    if magic != 20000630:
        raise Unreadable(f"{name} is no EXR file.")
    if version & 0x1A00:
        raise Unreadable(f"{name} has tiles, several parts or deep samples; write it as plain scan lines.")

    def text():
        out = bytearray()
        while (byte := file.read(1)) not in (b"\0", b""):
            out += byte
            if len(out) > 255:
                raise Unreadable(f"{name} is damaged.")
        return bytes(out)

    attributes = {}
    while key := text():
        text()  # its type
        (size,) = struct.unpack("<i", file.read(4))
        if not 0 <= size <= LARGEST_HEADER:
            raise Unreadable(f"{name} is damaged.")
        attributes[key.decode()] = file.read(size)
    return attributes


def _channels(block):
    """Of each channel in the order of the file: its name and its kind of sample."""
    found, at = [], 0
    while block[at]:
        end = block.index(b"\0", at)
        (kind,) = struct.unpack_from("<i", block, end + 1)
        found.append((block[at:end].decode(), SAMPLES[kind]))
        at = end + 17
    return found


def _unpacked(packed, size):
    if len(packed) == size:
        return packed
    raw = np.frombuffer(zlib.decompress(packed), np.uint8)
    # Each byte is the difference from the one before, and the even ones come first.
    plain = (np.cumsum(raw.astype(np.int64) - np.where(np.arange(len(raw)) > 0, 128, 0)) & 255).astype(np.uint8)
    half = (len(raw) + 1) // 2
    out = np.empty(len(raw), np.uint8)
    out[0::2], out[1::2] = plain[:half], plain[half:]
    return out.tobytes()


def channel_names(path):
    """The names of all channels, ascending."""
    return [name for name, _ in _opened(path, lambda file, attributes: _channels(attributes["channels"]))]


def read(path, wanted):
    """The channels of the names `wanted`, each as an array of floats, height x width of the data window."""
    return _opened(path, lambda file, attributes: _read(file, attributes, path, list(wanted)))


def _opened(path, work):
    try:
        with open(path, "rb") as file:
            return work(file, _header(file, path))
    except (struct.error, ValueError, KeyError, IndexError, zlib.error) as error:
        raise Unreadable(f"{path} is truncated or damaged ({error}).") from None


def _read(file, attributes, path, wanted):
    compression = attributes["compression"][0]
    if compression not in LINES:
        raise Unreadable(f"{path} is compressed in another way than ZIP.")
    x0, y0, x1, y1 = struct.unpack("<iiii", attributes["dataWindow"])
    width, height, lines = x1 - x0 + 1, y1 - y0 + 1, LINES[compression]
    if not (0 < width <= 1 << 16 and 0 < height <= 1 << 16):
        raise Unreadable(f"{path} is damaged.")
    channels = _channels(attributes["channels"])
    missing = [name for name in wanted if name not in dict(channels)]
    if missing:
        raise Unreadable(f"{path} has no channel {missing[0]}.")
    line_bytes = sum(width * sample.itemsize for _, sample in channels)
    out = {name: np.empty((height, width), np.float32) for name in wanted}
    chunks = (height + lines - 1) // lines
    file.read(8 * chunks)  # where the chunks are; they follow one after the other
    for _ in range(chunks):
        y, size = struct.unpack("<ii", file.read(8))
        here = min(lines, y1 + 1 - y)
        packed = file.read(size)
        if len(packed) != size or not y0 <= y <= y1:
            raise Unreadable(f"{path} is truncated or damaged.")
        data, at = _unpacked(packed, here * line_bytes), 0
        for line in range(y - y0, y - y0 + here):
            for name, sample in channels:
                if name in out:
                    out[name][line] = np.frombuffer(data, sample, width, at)
                at += width * sample.itemsize
    return out
