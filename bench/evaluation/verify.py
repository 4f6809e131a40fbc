"""Checks every pass of a scene against another one, and against rays that other code cast at the meshes.

Each check gives how far the passes are apart, and what is allowed. What is allowed was set from what the numbers
mean (half precision, the width of the data passes' filter, the samples of a pixel); that of coverage inside of ids was
set again when fur, whose tips are thinner than a pixel, had 0.003."""
import json

import numpy as np

import images
from visibility import BACKWARD, FORWARD, motion

DATA_FILTER_PX = 0.01


class Checks:
    def __init__(self):
        self.found = []

    def at_most(self, name, value, limit, unit):
        value = float(value)
        self.found.append({"check": name, "value": round(value, 6), "limit": limit, "unit": unit,
                           "holds": bool(np.isfinite(value) and value <= limit)})


def verify(scene):
    """{"holds", "checks"}, written to verified.json."""
    checks = Checks()
    if scene.drawn:
        verify_drawn(scene, checks)
    else:
        frames = sorted({p["frame"] for p in scene.facts["probes"]})
        data = {f: images.read(scene.file(f, "data")) for f in frames}
        against_rays(scene, data, checks)
        against_camera(scene, data, checks)
        rigid_motion(scene, data, checks)
        coverage_against_ids(scene, data, checks)
        light_against_picture(scene, frames, checks)
        variants_agree(scene, scene.truth_frames[::4], checks)
    result = {"scene": scene.name, "holds": all(c["holds"] for c in checks.found), "checks": checks.found}
    with open(scene.folder / "verified.json", "w", encoding="utf-8") as f:
        json.dump(result, f, indent=1)
    return result


def vector(data, *names):
    return images.channels(data, *names).astype(float)


def against_rays(scene, data, checks):
    """Ids, positions, depth, UV, motion and visibility of 300 pixels of each probed frame."""
    wrong_id, off, depth, uv, turned, moved, unseen, hits, asked = 0, [], [], [], [], [], 0, 0, 0
    focal = scene.facts["camera"]["focal_px"]
    flows = {f: {d: motion(p, d) for d in (FORWARD, BACKWARD)} for f, p in data.items()}
    visible = {f: np.rint(images.grey(scene.file(f, "visible", ending="png")) * 255).astype(int) for f in data}
    steps = {f: uv_step(vector(p, "UV.U", "UV.V")) for f, p in data.items()}
    for ray in scene.facts["probes"]:
        frame, x, y = ray["frame"], ray["x"], ray["y"]
        if on_edge(data[frame], x, y):
            continue  # a ray and a sample that is 0.005 px off may hit different parts
        hits += 1
        if round(float(images.channels(data[frame], "IndexOB.X")[y, x])) != ray["id"]:
            wrong_id += 1
            continue
        if ray["id"] == 0:
            continue
        pixel = ray["depth"] / focal
        facing = abs(np.dot(ray["normal"], view_direction(scene, frame, ray["position"])))
        place = vector(data[frame], "Position.X", "Position.Y", "Position.Z")[y, x]
        off.append(np.linalg.norm(place - ray["position"]) / pixel * facing)
        depth.append(abs(float(images.channels(data[frame], "Depth.Z")[y, x]) - ray["depth"]) / pixel * facing)
        uv.append(np.abs(vector(data[frame], "UV.U", "UV.V")[y, x] - ray["uv"]).max() / steps[frame][y, x])
        normal = vector(data[frame], "Normal.X", "Normal.Y", "Normal.Z")[y, x]
        turned.append(np.degrees(np.arccos(np.clip(abs(normal @ ray["normal"]), 0, 1))))
        for direction, name, other in ((FORWARD, "forward", frame + 1), (BACKWARD, "backward", frame - 1)):
            there = np.array([x + 0.5, y + 0.5]) + flows[frame][direction][y, x]
            moved.append(np.linalg.norm(there - ray[name]))
            if other in scene.frames:
                asked += 1
                unseen += bool(visible[frame][y, x] & direction) != ray[name + "_seen"]
    checks.at_most("rays hit the part that the ids name: share that do not", wrong_id / max(1, hits), 0.002, "")
    checks.at_most("Position against rays, 99 %", high(off), 2 * DATA_FILTER_PX, "px")
    checks.at_most("Depth against rays, 99 %", high(depth), 2 * DATA_FILTER_PX, "px")
    checks.at_most("UV against rays, 95 %", high(uv, 95), 3 * DATA_FILTER_PX, "px")
    checks.at_most("Normal against the hit triangles' corners, 99 %", high(turned), 0.1, "degrees")
    checks.at_most("Vector against the hit triangles' motion, 99 %", high(moved), 2 * DATA_FILTER_PX, "px")
    checks.at_most("visibility against rays: share that differ", unseen / max(1, asked), 0.02, "")


def high(values, percent=99):
    return np.percentile(values, percent) if len(values) else np.inf


def on_edge(data, x, y):
    """Whether the 3×3 pixels around are of several parts, or fold."""
    ids = images.channels(data, "IndexOB.X")
    around = ids[max(0, y - 1):y + 2, max(0, x - 1):x + 2]
    if around.min() != around.max():
        return True
    depth = images.channels(data, "Depth.Z")[max(0, y - 1):y + 2, max(0, x - 1):x + 2]
    return around.max() > 0 and depth.max() / depth.min() > 1.05


def view_direction(scene, frame, place):
    pose = np.array(scene.facts["camera"]["world_from_camera"][str(frame)])
    to = np.asarray(place) - pose[:3, 3]
    return to / np.linalg.norm(to, axis=-1, keepdims=True)


def uv_step(uv):
    """(h, w): metres of UV per pixel; a seam's jump is left out by the smaller of two sides."""
    across, down = (np.linalg.norm(np.diff(uv, axis=a), axis=-1) for a in (1, 0))
    across = np.minimum(np.pad(across, ((0, 0), (1, 0)), mode="edge"), np.pad(across, ((0, 0), (0, 1)), mode="edge"))
    down = np.minimum(np.pad(down, ((1, 0), (0, 0)), mode="edge"), np.pad(down, ((0, 1), (0, 0)), mode="edge"))
    return np.maximum(np.maximum(across, down), 1e-6)


def to_camera(scene, frame, positions):
    """(…, 3) of the world: pixel coordinates (pixel centres at whole numbers) and z."""
    camera = scene.facts["camera"]
    inverse = np.linalg.inv(np.array(camera["world_from_camera"][str(frame)]))
    local = positions @ inverse[:3, :3].T + inverse[:3, 3]
    z = -local[..., 2]
    width, height = camera["size"]
    x = width / 2 - 0.5 + camera["focal_px"] * local[..., 0] / z
    return np.stack([x, height / 2 - 0.5 - camera["focal_px"] * local[..., 1] / z], -1), z


def against_camera(scene, data, checks):
    """Every position must lie behind its own pixel's centre, at its depth."""
    beside, deep = [], []
    for frame, passes in data.items():
        surface = images.channels(passes, "IndexOB.X") > 0
        position = vector(passes, "Position.X", "Position.Y", "Position.Z")
        place, z = to_camera(scene, frame, position)
        y, x = np.nonzero(surface)
        # Across the line of sight: what is seen edge-on is as far off along it as a cosine says.
        normal, seen = vector(passes, "Normal.X", "Normal.Y", "Normal.Z"), view_direction(scene, frame, position)
        off = np.linalg.norm(place[y, x] - np.stack([x, y], -1), axis=-1)
        beside.append(np.percentile(off * np.abs((normal * seen).sum(axis=-1))[y, x], 99.99))
        deep.append((np.abs(z - images.channels(passes, "Depth.Z")) / np.maximum(z, 1e-6))[surface].max())
    checks.at_most("Position seen by the camera against the pixel's centre, 99.99 %", max(beside), DATA_FILTER_PX, "px")
    checks.at_most("Depth against Position and camera, largest", max(deep), 1e-4, "of the depth")


def rigid_motion(scene, data, checks):
    """Where nothing but the camera moves, Vector follows from Position and the two cameras."""
    still = [p["id"] for p in scene.parts if p.get("still")]
    worst = []
    for frame, passes in data.items():
        ids = images.channels(passes, "IndexOB.X")
        here = np.isin(ids, still)
        if not here.any():
            continue
        for direction, other in ((FORWARD, frame + 1), (BACKWARD, frame - 1)):
            place, _ = to_camera(scene, other, vector(passes, "Position.X", "Position.Y", "Position.Z"))
            y, x = np.mgrid[0:ids.shape[0], 0:ids.shape[1]]
            apart = np.linalg.norm(motion(passes, direction) + np.stack([x, y], -1) - place, axis=-1)
            worst.append(np.percentile(apart[here], 99.9))
    if worst:
        checks.at_most("Vector against Position and cameras on still parts, 99.9 %", max(worst), 2 * DATA_FILTER_PX, "px")


def coverage_against_ids(scene, data, checks):
    """Coverages sum to one; inside of a part (its 5×5 pixels share one id) its coverage is one."""
    total_off, inside_off = 0, 0
    blurred = scene.facts["shutter_deg"] > 0
    for frame, passes in data.items():
        ids = images.channels(passes, "IndexOB.X")
        total = np.zeros_like(ids)
        core = inside_of(ids)
        wrong = np.zeros(ids.shape, bool)
        for part in scene.parts:
            share = images.grey(scene.file(frame, "coverage", part["name"], ending="png"))
            total += share
            wrong |= core & (ids == part["id"]) & (share < 0.999)
        total_off = max(total_off, np.abs(np.where(core & (ids > 0), total, 1) - 1).max(), total.max() - 1)
        inside_off = max(inside_off, wrong.sum() / max(1, core.sum()))
    if not blurred:
        checks.at_most("coverages' sum inside of parts, largest error", total_off, 0.002, "")
        # What is thinner than a pixel between two centres, as a hair's tip, shows in the samples and not in the ids.
        checks.at_most("coverage below one inside of its part's id: share", inside_off, 0.01, "")
    else:
        checks.at_most("coverages' sum above one, largest", total_off, 1.0, "")


def inside_of(ids):
    core = np.zeros(ids.shape, bool)
    core[2:-2, 2:-2] = True
    for dy in range(-2, 3):
        for dx in range(-2, 3):
            core[2:-2, 2:-2] &= ids[2:-2, 2:-2] == ids[2 + dy:ids.shape[0] - 2 + dy, 2 + dx:ids.shape[1] - 2 + dx]
    return core


def light_against_picture(scene, frames, checks):
    """albedo · light + gloss is the picture. Within a pixel albedo and light can vary together, so the mean's product is
    exact only where one of them is smooth: the share of pixels that are off is limited, and the rest is exact."""
    apart = []
    for frame in frames:
        clean, light, albedo, gloss = (images.rgb(scene.file(frame, n)) for n in ("clean", "light", "albedo", "gloss"))
        made = albedo * light + gloss
        apart.append(np.abs(made - clean).max(axis=-1) / np.maximum(clean.max(axis=-1), 0.02))
    apart = np.concatenate([a.ravel() for a in apart])
    checks.at_most("albedo · light + gloss against the picture, median", np.median(apart), 2e-3, "of the picture")
    checks.at_most("albedo · light + gloss against the picture: share off by 5 %", (apart > 0.05).mean(), 0.06, "")


def variants_agree(scene, frames, checks):
    """The grey rendering: grey · light on the surfaces in question, the old picture everywhere else."""
    inside, outside, means = [], [], []
    for frame in frames:
        grey, clean, light = (images.rgb(scene.file(frame, n)) for n in ("grey", "clean", "light"))
        share = sum(images.grey(scene.file(frame, "coverage", p["name"], ending="png")) for p in scene.surfaces)
        away, on = share == 0, share > 0.9999
        if not scene.facts["glossy"] and away.any():
            outside.append((np.abs(grey - clean) / np.maximum(clean, 0.01))[away].max())
        means.append((scene.facts["grey"] * light[on]).mean() / grey[on].mean() - 1)
        inside.append((np.abs(grey - scene.facts["grey"] * light).max(axis=-1) / np.maximum(grey.max(axis=-1), 0.02))[on])
    inside = np.concatenate(inside)
    # light is a mean weighted by the old albedo. With n samples that each meet one of two lamps (deviation of the light
    # 1), on a pattern (deviation of the albedo 0.5), a pixel is off by 1 · 0.5 / √n; on the mean it is exact.
    checks.at_most("grey rendering against grey · light on its surfaces, 95 %", np.percentile(inside, 95),
                   0.5 / np.sqrt(scene.facts["samples"]), "")
    checks.at_most("grey rendering against grey · light on its surfaces, mean", abs(np.mean(means)), 2e-3, "")
    if outside:
        # A sample at the filter's rim has less weight than coverage can tell: one unit of half precision.
        checks.at_most("grey rendering against the old one elsewhere, largest", max(outside), 2.0 ** -10, "of the picture")


def verify_drawn(scene, checks):
    """Motion keeps on the extent of its fill; coverage lies within it."""
    off, outside = [], []
    for part in scene.surfaces:
        for frame in list(scene.frames)[:-1]:
            extent, later = (images.grey(scene.file(f, "extent", part["name"], ending="png")) for f in (frame, frame + 1))
            pixels = images.read(scene.file(frame, "motion", part["name"], ending="png"))[1] * 65535
            y, x = np.nonzero((extent > 0.999) & (pixels[..., 2] > 0))
            tx = np.rint(x + (pixels[y, x, 0] - 32768) / 64).astype(int)
            ty = np.rint(y + (pixels[y, x, 1] - 32768) / 64).astype(int)
            inside = (tx >= 0) & (tx < extent.shape[1]) & (ty >= 0) & (ty < extent.shape[0])
            off.append((later[ty[inside], tx[inside]] < 0.02).mean() if inside.any() else 0)
            share = images.grey(scene.file(frame, "coverage", part["name"], ending="png"))
            outside.append((share - extent).max())
    checks.at_most("motion leads out of its fill: share of pixels, largest", max(off), 0.005, "")
    checks.at_most("coverage beyond the extent, largest", max(outside), 0.01, "")
