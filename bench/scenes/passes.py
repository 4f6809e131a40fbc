"""Renders a stage with Cycles: pictures with many samples a pixel, data with one in its centre."""
import json
import os

import bpy
import numpy as np

# The width of the filter that jitters the sample of a data pass, px: its values are those of the surface point seen
# through the pixel's centre, to within half of this. (Cycles writes Position and ids from the first sample alone.)
DATA_FILTER_PX = 0.01
LIGHT_PASSES = ("diffuse_direct", "diffuse_indirect", "diffuse_color", "glossy_direct", "glossy_indirect", "glossy_color",
                "environment")
DATA_PASSES = ("position", "normal", "z", "vector", "uv", "object_index")


def set_up(stage, threads):
    render, cycles = stage.scene.render, stage.scene.cycles
    render.engine, cycles.device = "CYCLES", "CPU"
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.caustics_reflective = cycles.caustics_refractive = False
    # One seed for every frame and variant: what differs between two renderings of a frame is the material alone.
    cycles.seed = 7
    # Diffuse surfaces light nothing else, so that a new material changes its own pixels only.
    cycles.max_bounces = cycles.glossy_bounces = stage.bounces
    cycles.diffuse_bounces = cycles.transmission_bounces = cycles.volume_bounces = 0
    render.threads_mode, render.threads = "FIXED", threads
    render.use_compositing = render.use_sequencer = False
    render.use_persistent_data = True
    render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    render.image_settings.exr_codec = "ZIP"
    stage.scene.view_settings.view_transform = "Standard"
    layer = stage.scene.view_layers[0]
    layer.name = "scene"
    for name in ["rest"] + ["coverage%d" % g for g in range(stage.coverage_groups)]:
        aov = layer.aovs.add()
        aov.name, aov.type = name, "COLOR"


def passes_on(layer, names):
    for name in LIGHT_PASSES + DATA_PASSES:
        setattr(layer, "use_pass_" + name, name in names)


def render_pictures(stage, variant, folder, samples, step=1):
    """`folder`/####.exr, half: the picture; of the old materials also light, albedo, gloss and coverage."""
    render, cycles, layer = stage.scene.render, stage.scene.cycles, stage.scene.view_layers[0]
    cycles.samples, cycles.filter_width = samples, 1.5
    render.use_motion_blur, render.motion_blur_shutter = stage.shutter_deg > 0, max(stage.shutter_deg, 1) / 360
    render.image_settings.color_depth = "16"
    layer.use_pass_combined = True
    passes_on(layer, LIGHT_PASSES if variant == "old" else ())
    write_frames(stage, folder, step)


def render_data(stage, folder):
    """`folder`/####.exr, float: Position, Normal, Depth (z), Vector, UV, IndexOB and rest at the pixels' centres."""
    render, cycles, layer = stage.scene.render, stage.scene.cycles, stage.scene.view_layers[0]
    cycles.samples, cycles.filter_width = 1, DATA_FILTER_PX
    render.use_motion_blur = False
    render.image_settings.color_depth = "32"
    layer.use_pass_combined = False
    passes_on(layer, DATA_PASSES)
    write_frames(stage, folder, 1)


def write_frames(stage, folder, step):
    os.makedirs(folder, exist_ok=True)
    for frame in range(1, stage.frames + 1, step):
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
