"""Renders a stage with Cycles: pictures with many samples a pixel, data with one in its centre.

The light of the sky is rendered by itself, once a frame: pictures hold sun and lamps, which have no noise, and
bench/evaluation/compose.py adds the sky's light, freed of noise, in the same way to all of them."""
import json
import os

import bpy
import numpy as np

# The width of the filter that jitters the sample of a data pass, px: its values are those of the surface point seen
# through the pixel's centre, to within half of this. (Cycles writes Position and ids from the first sample alone.)
DATA_FILTER_PX = 0.01
LIGHT_PASSES = ("diffuse_direct", "diffuse_color", "environment")
DATA_PASSES = ("position", "normal", "z", "vector", "object_index")


def set_up(stage, threads):
    render, cycles = stage.scene.render, stage.scene.cycles
    render.engine, cycles.device = "CYCLES", "CPU"
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.caustics_reflective = cycles.caustics_refractive = False
    # One seed for every frame and variant: what differs between two renderings of a frame is the material alone.
    cycles.seed = 7
    # Nothing lights anything else, so that a new material changes its own pixels only.
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 0
    cycles.transmission_bounces = cycles.volume_bounces = 0
    render.threads_mode, render.threads = "FIXED", threads
    render.use_compositing = render.use_sequencer = False
    # Blender 3.4 loses mesh attributes, or stops, when passes or materials change under data that is kept.
    render.use_persistent_data = False
    render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    render.image_settings.exr_codec = "ZIP"
    stage.scene.view_settings.view_transform = "Standard"
    layer = stage.scene.view_layers[0]
    layer.name = "scene"
    for name in ["rest", "metres"] + ["coverage%d" % g for g in range(stage.coverage_groups)]:
        aov = layer.aovs.add()
        aov.name, aov.type = name, "COLOR"


def passes_on(layer, names):
    for name in LIGHT_PASSES + DATA_PASSES:
        setattr(layer, "use_pass_" + name, name in names)


def render_pictures(stage, variant, folder, samples):
    """`folder`/####.exr, half: the picture in the light of sun and lamps, its albedo; of the old materials also light,
    gloss and coverage. Other variants on `truth_frames` only."""
    with_samples(stage, samples)
    stage.scene.view_layers[0].use_pass_combined = True
    sky_seen_by(stage, "camera")
    passes_on(stage.scene.view_layers[0], LIGHT_PASSES if variant == "old" else ("diffuse_color",))
    write_frames(stage, folder, range(1, stage.frames + 1) if variant == "old" else truth_frames(stage.frames))


def render_gloss(stage, folder, samples, frames):
    """`folder`/####.exr, half: Combined is what is reflected once. By itself, since Cycles gives light that a coat's
    sample finds to the colour below the coat as well."""
    with_samples(stage, samples)
    cycles, layer = stage.scene.cycles, stage.scene.view_layers[0]
    cycles.max_bounces = cycles.glossy_bounces = 1
    layer.use_pass_combined = True
    sky_seen_by(stage, "glossy")
    passes_on(layer, ())
    write_frames(stage, folder, frames)
    cycles.max_bounces = cycles.glossy_bounces = 0


def render_sky(stage, folder, samples):
    """`folder`/####.exr, half: DiffDir is the sky's light alone, with noise."""
    with_samples(stage, samples)
    layer = stage.scene.view_layers[0]
    layer.use_pass_combined = False
    layer.material_override = stage.white()
    sky_seen_by(stage, "diffuse")
    for lamp in stage.lamps:
        lamp.hide_render = True
    passes_on(layer, ("diffuse_direct",))
    write_frames(stage, folder, range(1, stage.frames + 1))
    layer.material_override = None
    for lamp in stage.lamps:
        lamp.hide_render = False


def with_samples(stage, samples):
    render, cycles = stage.scene.render, stage.scene.cycles
    cycles.samples, cycles.filter_width = samples, 1.5
    render.use_motion_blur, render.motion_blur_shutter = stage.shutter_deg > 0, max(stage.shutter_deg, 1) / 360
    render.image_settings.color_depth = "16"


def sky_seen_by(stage, rays):
    """`rays`: "camera", "diffuse" or "glossy"."""
    for kind in ("camera", "diffuse", "glossy"):
        setattr(stage.scene.world.cycles_visibility, kind, kind == rays)
    stage.scene.world.update_tag()


def render_data(stage, folder):
    """`folder`/####.exr, float: Position, Normal, Depth (z), Vector, IndexOB, metres (UV) and rest at the pixels' centres."""
    render, cycles, layer = stage.scene.render, stage.scene.cycles, stage.scene.view_layers[0]
    sky_seen_by(stage, "camera")
    cycles.samples, cycles.filter_width = 1, DATA_FILTER_PX
    render.use_motion_blur = False
    render.image_settings.color_depth = "32"
    layer.use_pass_combined = False
    passes_on(layer, DATA_PASSES)
    write_frames(stage, folder, range(1, stage.frames + 1))


def truth_frames(count):
    """Every second pair of frames: half of the cost, and what changes from frame to frame still shows."""
    return [f for f in range(1, count + 1) if f % 4 in (1, 2)]


def write_frames(stage, folder, frames):
    os.makedirs(folder, exist_ok=True)
    for frame in frames:
        stage.scene.frame_set(frame)
        stage.scene.render.filepath = os.path.join(folder, "%04d.exr" % frame)
        bpy.ops.render.render(write_still=True)


def camera_track(stage):
    """Per frame: `world_from_camera` (4×4; the camera looks along −z, y up). `focal_px`; the centre is the picture's."""
    data = stage.camera.data
    poses = {}
    for frame in stage.baked:
        stage.scene.frame_set(frame)
        poses[frame] = np.array(stage.camera.matrix_world).tolist()
    return {"focal_px": data.lens / data.sensor_width * stage.size[0], "size": list(stage.size),
            "world_from_camera": poses}


def write_json(path, value):
    with open(path, "w", encoding="utf-8") as f:
        json.dump(value, f, indent=1)
