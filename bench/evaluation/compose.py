"""Composes what Blender rendered: adds the sky's light, freed of noise, and makes the camera's pictures.

A picture is  Σ sun and lamps by sample  +  albedo · sky light  +  reflections,  all means over the pixel. The sky's light
is smooth but for its noise, and is the same in the old, the grey and the tiled picture, so that these differ in the
material alone."""
import os
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import images
from camera import camera_picture
from layout import Scene
from visibility import seen_again


def smooth_sky(light, position, normal, ids, depth, focal_px, levels=4):
    """`light` (h, w) without noise: an à-trous filter (Dammertz et al. 2010, eq. 2 to 5) with weights of the surface alone.

    A neighbour counts as far as it is of the same part, faces the same way and lies in this pixel's tangent plane,
    in units of the surface that a pixel covers."""
    pixel_m = (depth / focal_px).astype(np.float32)
    current, height, width = light.astype(np.float32), *light.shape
    kernel = (1 / 16, 1 / 4, 3 / 8, 1 / 4, 1 / 16)
    for level in range(levels):
        step = 1 << level
        total, weights = kernel[2] ** 2 * current, np.full_like(current, kernel[2] ** 2)
        for dy in (-2, -1, 0, 1, 2):
            for dx in (-2, -1, 0, 1, 2):
                y, x = dy * step, dx * step
                if (y, x) == (0, 0) or abs(y) >= height or abs(x) >= width:
                    continue
                here = (slice(max(0, -y), height - max(0, y)), slice(max(0, -x), width - max(0, x)))
                there = (slice(max(0, y), height - max(0, -y)), slice(max(0, x), width - max(0, -x)))
                between = position[there] - position[here]
                off = np.abs(np.einsum("ijk,ijk->ij", between, normal[here])) / (step * pixel_m[here] + 1e-9)
                turned = 1 - np.einsum("ijk,ijk->ij", normal[there], normal[here])
                w = kernel[dy + 2] * kernel[dx + 2] * np.exp(-off - turned / 0.02) * (ids[here] == ids[there])
                total[here] += w * current[there]
                weights[here] += w
        current = total / weights
    return current


def compose(folder, seed):
    """Makes the files of layout.py from Blender's in `folder`/raw, which is removed."""
    scene = Scene(folder)
    # Threads, since OpenImageIO has some of its own, which a forked process would wait for in vain; numpy and
    # OpenImageIO let others run while they work.
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda frame: compose_frame(scene, frame, [seed, frame]), scene.frames))
        list(pool.map(lambda frame: write_visible(scene, frame), scene.frames))
    movie(scene)
    shutil.rmtree(scene.folder / "raw")


def write_visible(scene, frame):
    images.write(scene.file(frame, "visible", ending="png"), seen_again(scene, frame) / 255, "uint8")


def compose_frame(scene, frame, noise_seed):
    variants = {"old": "clean", **({"grey": "grey", "tiled": "tiled"} if frame in scene.truth_frames else {})}
    raw = {name: images.read(scene.file(frame, "raw", name)) for name in (*variants, "sky")}
    data = data_alone(scene.file(frame, "data"))
    sky = sky_light(scene, raw["sky"], data)
    light = images.channels(raw["old"], "DiffDir.R", "DiffDir.G", "DiffDir.B") + sky
    gloss = {"old": reflected(scene, frame, "gloss")}
    if len(variants) > 1:
        gloss["grey"] = gloss["tiled"] = reflected(scene, frame, "gloss elsewhere")
    albedo = images.channels(raw["old"], "DiffCol.R", "DiffCol.G", "DiffCol.B")
    for name, folder in variants.items():
        colour = images.channels(raw[name], "DiffCol.R", "DiffCol.G", "DiffCol.B")
        picture = combined(raw[name]) + colour * sky + gloss[name]
        write_rgb(scene, frame, folder, picture)
        if name == "old":
            clean = picture
    write_rgb(scene, frame, "light", light)
    write_rgb(scene, frame, "albedo", albedo)
    background = images.channels(raw["old"], "Env.R", "Env.G", "Env.B")
    write_rgb(scene, frame, "gloss", gloss["old"] + background)
    for part in scene.parts:
        group, place = divmod(part["id"] - 1, 3)
        share = images.channels(raw["old"], "coverage%d.%s" % (group, "RGB"[place]))
        images.write(scene.file(frame, "coverage", part["name"], ending="png"), np.clip(share, 0, 1), "uint16")
    images.write(scene.file(frame, "plate", ending="png"), camera_picture(clean, np.random.default_rng(noise_seed)), "uint8")


def data_alone(path):
    """Leaves out of a data file what the pictures' passes are for, and names the rest as Blender does; returns it."""
    names, pixels = images.read(path)
    names = [n.replace("metres.R", "UV.U").replace("metres.G", "UV.V") for n in names]
    left_out = (".Combined.", ".coverage", ".metres.", "rest.A")
    kept = [k for k, n in enumerate(names) if not any(part in n for part in left_out)]
    picture = [names[k] for k in kept], pixels[..., kept]
    images.write(path, picture[1], "float", picture[0], "zip")
    return picture


def sky_light(scene, raw, data):
    """(h, w, 3), linear. The sky is of one colour: one channel is filtered."""
    strength = np.array(scene.facts["sky"], np.float32)
    if strength.max() == 0:
        return np.zeros((*raw[1].shape[:2], 3), np.float32)
    seen = images.channels(raw, "DiffDir.G") / strength[1]
    normal = images.channels(data, "Normal.X", "Normal.Y", "Normal.Z")
    seen = smooth_sky(seen, images.channels(data, "Position.X", "Position.Y", "Position.Z"), normal,
                      images.channels(data, "IndexOB.X"), images.channels(data, "Depth.Z"),
                      scene.facts["camera"]["focal_px"])
    return seen[..., None] * strength


def combined(raw):
    return images.channels(raw, "Combined.R", "Combined.G", "Combined.B")


def reflected(scene, frame, name):
    """The reflections of a glossy scene; 0 of another."""
    return combined(images.read(scene.file(frame, "raw", name))) if scene.facts["glossy"] else np.float32(0)


def write_rgb(scene, frame, folder, picture):
    images.write(scene.file(frame, folder), picture, "half", "RGB", "zip")


def movie(scene):
    """plate.mp4: H.264 at the quality of a phone's or an editor's intermediate."""
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-framerate", "24", "-i", str(scene.folder / "plate" / "%04d.png"),
                    "-c:v", "libx264", "-crf", "20", "-pix_fmt", "yuv420p", "-movflags", "+faststart",
                    str(scene.folder / "plate.mp4")], check=True)


def arrange(folder):
    """Puts Blender's pictures into raw/, from which the others are made."""
    os.makedirs(folder / "raw", exist_ok=True)
    for name in ("old", "grey", "tiled", "sky", "gloss", "gloss elsewhere"):
        if (folder / name).is_dir():
            os.replace(folder / name, folder / "raw" / name)
