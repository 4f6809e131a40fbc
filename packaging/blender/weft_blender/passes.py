"""Which of a render's passes Weft is given, and as what. Knows no Blender."""

# Of each pass its names, in older and newer versions of Blender.
NAMES = {
    "vector": ("Vector",),
    "position": ("Position",),
    "normal": ("Normal",),
    "depth": ("Depth", "Z"),
    "uv": ("UV",),
    "direct": ("DiffDir", "Diffuse Direct"),
    "indirect": ("DiffInd", "Diffuse Indirect"),
    "colour": ("DiffCol", "Diffuse Color"),
}


def found(channels, layer):
    """The full name of each pass that the file has of a view layer: {"depth": "ViewLayer.Depth"}."""
    there = {name.rsplit(".", 1)[0] for name in channels if "." in name}
    out = {}
    for what, names in NAMES.items():
        for name in names:
            if f"{layer}.{name}" in there:
                out[what] = f"{layer}.{name}"
                break
    return out


def has_cryptomatte(channels, layer):
    return any(name.startswith(f"{layer}.CryptoObject") for name in channels)


def quoted_object(name):
    """An object's name in --matte crypto:NAME."""
    return "crypto:" + "".join("\\" + c if c in ',"*\\' else c for c in name)


def region_options(files, passes, fov_deg, still_shutter):
    """The options of `weft region add` for a pattern of files with these passes. `still_shutter`: there is no motion
    blur, with which Blender's Vector is zero."""
    options = []
    if "vector" in passes and still_shutter:
        options += ["--motion", files, "--motion-convention", "blender", "--motion-layer", passes["vector"]]
    if "position" in passes:
        options += ["--position-pass", files, "--position-layer", passes["position"]]
    if "normal" in passes:
        options += ["--normal-pass", files, "--normal-layer", passes["normal"], "--normal-space", "world"]
    if "depth" in passes:
        options += ["--depth-pass", files, "--depth-layer", passes["depth"]]
    if fov_deg:
        options += ["--fov", f"{fov_deg:.4f}"]
    if "direct" in passes and "indirect" in passes:
        options += ["--lighting", files, "--light-layer", passes["direct"] + "+" + passes["indirect"]]
    elif "colour" in passes:
        options += ["--albedo", files, "--light-layer", passes["colour"]]
    return options
