# blender -b --factory-startup -P map_uv.py -- PICTURE ST_MAP OUTPUT WIDTH HEIGHT
# A linear picture through an ST-map by Blender's Map UV, written as an EXR of 32 bit floats.
import sys

import bpy

picture, st_map, output, width, height = sys.argv[sys.argv.index("--") + 1:][:5]
scene = bpy.context.scene
scene.use_nodes = True
tree = scene.node_tree
tree.nodes.clear()
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = int(width), int(height), 100


def loaded(path):
    node = tree.nodes.new("CompositorNodeImage")
    node.image = bpy.data.images.load(path)
    node.image.colorspace_settings.name = "Linear"
    return node.outputs[0]


mapped = tree.nodes.new("CompositorNodeMapUV")
mapped.alpha = 0
tree.links.new(loaded(picture), mapped.inputs[0])
tree.links.new(loaded(st_map), mapped.inputs[1])
tree.links.new(mapped.outputs[0], tree.nodes.new("CompositorNodeComposite").inputs[0])
settings = scene.render.image_settings
settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR", "32", "ZIP"
scene.render.use_stamp = False
scene.render.filepath = output
bpy.ops.render.render(write_still=True)
