"""Send to Weft: renders the shot with the passes that Weft uses, and makes a project of it."""
import math
import os

import bpy

from . import exr, panel, passes, program

PLATE = "cg"
LAYERS = "patch,edge,light,gloss,st,matte,id,texture,finish"
LAYER_PASSES = ("use_pass_combined", "use_pass_z", "use_pass_vector", "use_pass_position", "use_pass_normal",
                "use_pass_uv", "use_pass_diffuse_direct", "use_pass_diffuse_indirect", "use_pass_diffuse_color",
                "use_pass_cryptomatte_object", "use_pass_cryptomatte_accurate")


class Kept:
    """Changes settings, and puts them back."""

    def __init__(self):
        self.before = []

    def __enter__(self):
        return self

    def set(self, owner, name, value):
        if not hasattr(owner, name):
            return
        self.before.append((owner, name, getattr(owner, name)))
        try:
            setattr(owner, name, value)
        except (TypeError, AttributeError):
            self.before.pop()

    def __exit__(self, *error):
        for owner, name, value in reversed(self.before):
            setattr(owner, name, value)


def render_passes(scene, layer, folder):
    """Renders the scene's frames as folder/cg/0001.exr …"""
    with Kept() as kept:
        for name in LAYER_PASSES:
            kept.set(layer, name, True)
        kept.set(layer, "pass_cryptomatte_depth", 6)
        for name, value in (("use_compositing", False), ("use_sequencer", False), ("use_file_extension", True),
                            ("use_overwrite", True), ("use_placeholder", False), ("use_border", False),
                            ("filepath", os.path.join(folder, PLATE, "####"))):
            kept.set(scene.render, name, value)
        settings = scene.render.image_settings
        kept.set(settings, "media_type", "MULTI_LAYER_IMAGE")  # of Blender 5
        # Lossless, as Vector, Position and Cryptomatte have to be.
        for name, value in (("file_format", "OPEN_EXR_MULTILAYER"), ("color_depth", "32"), ("exr_codec", "ZIP")):
            kept.set(settings, name, value)
        bpy.ops.render.render(animation=True, scene=scene.name)


def make_project(weft, folder, scene, layer, thing, texture, channels):
    """Makes the project, or adds the object to the one that is there. Returns a warning, or None."""
    files = f"{PLATE}/####.exr"
    there = passes.found(channels, layer.name)
    if not passes.has_cryptomatte(channels, layer.name):
        raise program.Failed(f"{scene.render.engine} wrote no Cryptomatte, by which Weft knows the object.")
    project = os.path.join(folder, panel.PROJECT)
    if not os.path.exists(project):
        fps = scene.render.fps / scene.render.fps_base
        program.run(weft, folder, "new", panel.PROJECT, "--plate", files, "--plate-layer", layer.name + ".Combined",
                    "--fps", f"{fps:.6g}", "-o", panel.OUTPUT, "--layers", LAYERS,
                    "--layers-output", panel.LAYERS_OUTPUT)
    regions = program.run(weft, folder, "region", "list", panel.PROJECT)["regions"]
    camera = scene.camera.data
    fov = math.degrees(camera.angle_x) if camera.type == "PERSP" else None
    still = not scene.render.use_motion_blur
    options = ["--matte", passes.quoted_object(thing.name), *passes.region_options(files, there, fov, still)]
    if texture:
        options += ["--texture", texture]
    if any(region["name"] == thing.name for region in regions):
        program.run(weft, folder, "region", "set", panel.PROJECT, thing.name, *options)
    else:
        program.run(weft, folder, "region", "add", panel.PROJECT, "--name", thing.name, *options)
    if not still:
        return "With motion blur Blender writes no motion: Weft finds it from the pictures."
    if "vector" not in there:
        return f"{scene.render.engine} writes no Vector pass: Weft finds the motion from the pictures."
    return None


class WEFT_OT_send(bpy.types.Operator):
    """Render the shot with the passes that Weft uses, and make a project that replaces the object's texture"""

    bl_idname = "weft.send"
    bl_label = "Send to Weft"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.scene.camera is not None

    def execute(self, context):
        scene, layer, thing = context.scene, context.view_layer, context.object
        if scene.frame_step != 1:
            self.report({"ERROR"}, "Weft follows surfaces from frame to frame: set the frame step to 1.")
            return {"CANCELLED"}
        try:
            weft, folder = panel.weft_of(context), panel.folder_of(scene)
            os.makedirs(os.path.join(folder, PLATE), exist_ok=True)
            render_passes(scene, layer, folder)
            first = os.path.join(folder, PLATE, f"{scene.frame_start:04d}.exr")
            texture = scene.weft.texture and bpy.path.abspath(scene.weft.texture)
            warning = make_project(weft, folder, scene, layer, thing, texture, exr.channel_names(first))
        except (program.Failed, exr.Unreadable, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"WARNING"} if warning else {"INFO"}, warning or f"Sent to {folder}.")
        return {"FINISHED"}
