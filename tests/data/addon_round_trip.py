# blender -b -P addon_round_trip.py -- ADDON FOLDER SIDE OLD NEW
# A wall with a picture and a ball before it are sent to Weft, rendered there with another picture, and brought back in
# each way. What Blender then renders is written to FOLDER for the test to compare. SIDE: pixels of the frame's height.
import os
import sys

import bpy

addon, folder, side, old, new = sys.argv[sys.argv.index("--") + 1:][:5]
sys.path[:0] = [os.path.dirname(os.path.abspath(__file__)), addon]
from scene_setup import picture_into, sharp_scene  # noqa: E402

FRAMES = 3
scene = sharp_scene(FRAMES, int(side) * 16 // 9, int(side), 16)


def material(name, picture=None, colour=(0.5, 0.1, 0.1)):
    one = bpy.data.materials.new(name)
    one.use_nodes = True
    nodes, links = one.node_tree.nodes, one.node_tree.links
    nodes.clear()
    output, diffuse = nodes.new("ShaderNodeOutputMaterial"), nodes.new("ShaderNodeBsdfDiffuse")
    links.new(diffuse.outputs[0], output.inputs[0])
    if picture:
        picture_into(one, diffuse, picture)
    else:
        diffuse.inputs["Color"].default_value = (*colour, 1)
    return one


def keyed(thing, before, after):
    for frame, place in ((1, before), (FRAMES, after)):
        thing.location = place
        thing.keyframe_insert("location", frame=frame)
    for curve in thing.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


bpy.ops.mesh.primitive_plane_add(size=5, location=(0, 2, 0), rotation=(1.5707963, 0, 0.2))
wall = bpy.context.object
wall.name = 'Wall, "left"'
wall.data.materials.append(material("wall", old))
bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5)
ball = bpy.context.object
ball.name = "Ball"
ball.data.materials.append(material("ball"))
keyed(ball, (-1.2, 0.3, -0.3), (-0.9, 0.3, -0.3))
bpy.ops.object.light_add(type="SUN", rotation=(0.9, 0.2, -0.3))
bpy.context.object.data.energy = 3
bpy.ops.object.camera_add(location=(0, -6, 0.2), rotation=(1.55, 0, 0))
scene.camera = bpy.context.object
scene.world = bpy.data.worlds.new("sky")  # no shadow is wholly black
scene.world.color = (0.3, 0.3, 0.3)
keyed(scene.camera, (-0.1, -6, 0.2), (0.15, -5.8, 0.25))

import weft_blender  # noqa: E402

weft_blender.register()
before = (scene.render.filepath, scene.render.image_settings.file_format, bpy.context.view_layer.use_pass_vector)
scene.weft.folder, scene.weft.texture, scene.weft.side = folder, new, 512
bpy.context.view_layer.objects.active = wall


def finished(result):
    if result != {"FINISHED"}:
        sys.exit(1)


def still(path, frame):
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR", "32", "ZIP"
    scene.render.filepath = os.path.join(folder, path)
    scene.frame_set(frame)
    bpy.ops.render.render(write_still=True)


finished(bpy.ops.weft.send())
assert before == (scene.render.filepath, scene.render.image_settings.file_format,
                  bpy.context.view_layer.use_pass_vector), "the scene's settings changed"
finished(bpy.ops.weft.render())
finished(bpy.ops.weft.bring_back(kind="SEQUENCE"))
sequence = bpy.data.images['Weft Wall, "left"']
assert sequence.source == "SEQUENCE", sequence.source
finished(bpy.ops.weft.bring_back(kind="TEXTURE"))
still("by_uvs.exr", FRAMES)
finished(bpy.ops.weft.bring_back(kind="COMPOSITOR"))
still("by_nodes.exr", FRAMES)
weft_blender.unregister()
print("round trip done")
