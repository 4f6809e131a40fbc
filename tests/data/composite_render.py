# blender -b --factory-startup -P TREE.py -P composite_render.py -- OUTPUT FRAME TEXTURE
# Renders a composite that Weft wrote as an EXR of 32 bit floats; TEXTURE 1 turns its switch on.
import sys

import bpy

output, frame, texture = sys.argv[sys.argv.index("--") + 1:][:3]
scene = bpy.context.scene
tree = getattr(scene, "compositing_node_group", None) or scene.node_tree
switch = tree.nodes.get("Weft_texture")
if int(texture):
    if hasattr(switch, "check"):
        switch.check = True
    else:
        switch.inputs["Switch"].default_value = True
settings = scene.render.image_settings
settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR", "32", "ZIP"
scene.render.use_stamp = False
scene.frame_set(int(frame))
scene.render.filepath = output
bpy.ops.render.render(write_still=True)
