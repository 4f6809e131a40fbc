"""Pictures as numpy arrays, by OpenImageIO. Values are float32; 8 and 16 bit are 0 to 1."""
import os

import numpy as np
import OpenImageIO as oiio


def read(path):
    """(channel names, array of height × width × channels)."""
    source = oiio.ImageInput.open(str(path))
    if source is None:
        raise OSError("%s cannot be read as a picture: %s" % (path, oiio.geterror()))
    spec = source.spec()
    pixels = source.read_image(0, 0, 0, spec.nchannels, "float")
    source.close()
    if pixels is None:
        raise OSError("%s is damaged: its pixels cannot be read" % path)
    return list(spec.channelnames), np.asarray(pixels, np.float32).reshape(spec.height, spec.width, spec.nchannels)


def channels(picture, *names):
    """The channels of read() whose names end with `names`, stacked: ("Position.X", "Position.Y")."""
    have, pixels = picture
    found = [next((k for k, c in enumerate(have) if c == n or c.endswith("." + n)), None) for n in names]
    if None in found:
        raise KeyError("no channel %s among %s" % (names[found.index(None)], ", ".join(have)))
    return pixels[..., found] if len(found) > 1 else pixels[..., found[0]]


def rgb(path):
    """The first three channels."""
    return read(path)[1][..., :3]


def grey(path):
    return read(path)[1][..., 0]


def write(path, pixels, kind, names=None, compression=None):
    """`kind`: "uint8", "uint16", "half" or "float". The file gets its name when it is whole."""
    os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
    pixels = np.atleast_3d(np.asarray(pixels, np.float32))
    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], kind)
    if names:
        spec.channelnames = tuple(names)
    if compression:
        spec.attribute("compression", compression)
    folder, name = os.path.split(str(path))
    partial = os.path.join(folder, ".partial-%d-%s" % (os.getpid(), name))
    target = oiio.ImageOutput.create(partial)
    if target is None or not target.open(partial, spec) or not target.write_image(np.ascontiguousarray(pixels)):
        raise OSError("%s cannot be written: %s" % (path, target.geterror() if target else oiio.geterror()))
    if not target.close():
        raise OSError("%s cannot be written: %s" % (path, target.geterror()))
    os.replace(partial, path)


def srgb_from_linear(x):
    x = np.clip(x, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.power(x, 1 / 2.4) - 0.055).astype(np.float32)


def linear_from_srgb(x):
    return np.where(x <= 0.04045, x / 12.92, np.power((x + 0.055) / 1.055, 2.4)).astype(np.float32)


def luma(picture):
    """Rec. 709, of linear RGB."""
    return picture @ np.array([0.2126, 0.7152, 0.0722], np.float32)
