"""Bring back: the result of Weft as an image sequence, as compositor nodes, or as the object's texture by its UVs."""
import os
import re

import bpy

from . import exr, gather, panel, program


def result_files(folder):
    """The rendered frames, ascending. Raises program.Failed."""
    out = os.path.join(folder, os.path.dirname(panel.OUTPUT))
    names = os.listdir(out) if os.path.isdir(out) else []
    found = sorted((int(match[1]), name) for name in names if (match := re.fullmatch(r"(-?\d+)\.exr", name)))
    if not found:
        raise program.Failed("There is no result yet: render in Weft.")
    return [os.path.join(out, name) for _, name in found]


def linear(image):
    for name in ("Linear", "Linear Rec.709"):
        try:
            image.colorspace_settings.name = name
            return
        except TypeError:
            continue


def as_sequence(files, name):
    image = bpy.data.images.load(files[0], check_existing=False)
    image.name, image.source = "Weft " + name, "SEQUENCE"
    linear(image)
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "IMAGE_EDITOR":
                area.spaces.active.image = image
    return image


def as_nodes(folder):
    """Runs the script that Weft wrote beside its render."""
    script = os.path.join(folder, panel.TREE)
    if not os.path.exists(script):
        raise program.Failed("Weft wrote no node tree: render with the button here, or with --export-composite.")
    with open(script, encoding="utf-8") as file:
        code = compile(file.read(), script, "exec")
    exec(code, {"__name__": "__main__", "__file__": script})


def texture_image(files, layer, side, name, folder):
    apart = os.path.join(folder, os.path.dirname(panel.LAYERS_OUTPUT))
    pairs = [(file, os.path.join(apart, os.path.basename(file))) for file in files]
    pixels, shown = gather.gathered(pairs, layer, side)
    image = bpy.data.images.new("Weft " + name, side, side, float_buffer=True)
    linear(image)
    flat = [1.0] * (side * side * 4)
    for c in range(3):
        flat[c::4] = pixels[..., c].ravel().tolist()
    image.pixels.foreach_set(flat)
    image.file_format = "OPEN_EXR"
    image.filepath_raw = os.path.join(folder, re.sub(r"[^\w-]", "_", name) + "_texture.exr")
    image.save()
    return image, shown


def put_on(thing, image):
    """Gives the object a copy of its material with the image as its colour, by its active UVs."""
    old = thing.active_material
    new = old.copy() if old else bpy.data.materials.new("Weft " + thing.name)
    new.name = "Weft " + thing.name
    new.use_nodes = True
    nodes, links = new.node_tree.nodes, new.node_tree.links
    shader = next((node for node in nodes for name in ("Base Color", "Color")
                   if node.type.startswith("BSDF") and name in node.inputs), None)
    if shader is None:
        shader = nodes.new("ShaderNodeBsdfPrincipled")
        output = next((node for node in nodes if node.type == "OUTPUT_MATERIAL"), None)
        links.new(shader.outputs[0], (output or nodes.new("ShaderNodeOutputMaterial")).inputs["Surface"])
    texture, uvs = nodes.new("ShaderNodeTexImage"), nodes.new("ShaderNodeUVMap")
    texture.image = image
    uvs.uv_map = thing.data.uv_layers.active.name
    links.new(uvs.outputs[0], texture.inputs[0])
    links.new(texture.outputs[0], shader.inputs["Base Color" if "Base Color" in shader.inputs else "Color"])
    if old:
        thing.material_slots[thing.active_material_index].material = new
    else:
        thing.data.materials.append(new)


class WEFT_OT_render(bpy.types.Operator):
    """Render the project in Weft; frames that are up to date stay"""

    bl_idname = "weft.render"
    bl_label = "Render in Weft"

    def execute(self, context):
        window = context.window_manager
        try:
            weft, folder = panel.weft_of(context), panel.folder_of(context.scene)
            window.progress_begin(0, 1)
            program.run(weft, folder, "render", panel.PROJECT, "-o", panel.OUTPUT, "--layers-output",
                        panel.LAYERS_OUTPUT, "--resume", "--trust", "--export-composite", panel.TREE,
                        progress=lambda done, total: window.progress_update(done / max(1, total)))
        except (program.Failed, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            window.progress_end()
        return {"FINISHED"}


class WEFT_OT_bring_back(bpy.types.Operator):
    """Load the result of Weft"""

    bl_idname = "weft.bring_back"
    bl_label = "Bring back"
    bl_options = {"REGISTER", "UNDO"}

    kind: bpy.props.EnumProperty(name="As", items=(
        ("SEQUENCE", "Image sequence", "As an image of all frames"),
        ("COMPOSITOR", "Compositor nodes", "As plate and layers, joined by nodes"),
        ("TEXTURE", "Texture by UVs", "As the colour of the object's material, gathered from the frames by its UVs")))

    def execute(self, context):
        scene, thing = context.scene, context.object
        try:
            folder = panel.folder_of(scene)
            files = result_files(folder)
            if self.kind == "SEQUENCE":
                as_sequence(files, thing.name if thing else "")
            elif self.kind == "COMPOSITOR":
                as_nodes(folder)
            else:
                if thing is None or thing.type != "MESH" or not thing.data.uv_layers.active:
                    raise program.Failed("Select the object; it needs a UV map.")
                image, shown = texture_image(files, context.view_layer.name, scene.weft.side, thing.name, folder)
                put_on(thing, image)
                self.report({"INFO"}, f"The frames show {shown:.0%} of the texture; the rest is filled.")
        except (program.Failed, exr.Unreadable, gather.NothingSeen, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}
