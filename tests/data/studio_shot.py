# blender -b -P studio_shot.py -- OUTPUT WIDTH HEIGHT FRAMES SAMPLES PICTURE
# A wall and a ball that rolls in front of it, seen by a moving camera: a multilayer EXR a frame with colour, Vector, UV,
# the diffuse colour and Cryptomatte. PICTURE is the wall's texture.
import math
import sys

import bpy

output, width, height, frames, samples, picture = sys.argv[sys.argv.index("--") + 1:][:6]

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = int(samples)
scene.cycles.seed = 1
scene.cycles.use_denoising = False
scene.cycles.max_bounces = 0  # light from the lamps alone: a wall's colour reaches nothing but itself
scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)
scene.render.resolution_percentage = 100
scene.frame_start, scene.frame_end = 1, int(frames)
scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
scene.render.image_settings.color_depth = "32"
scene.render.image_settings.exr_codec = "ZIP"
scene.render.use_stamp = False
scene.render.filepath = output
scene.view_layers[0].name = "shot"
layer = scene.view_layers[0]
layer.use_pass_vector = layer.use_pass_uv = layer.use_pass_diffuse_color = True
layer.use_pass_cryptomatte_object = True
layer.pass_cryptomatte_depth = 6


def material(name, colour=None, image=None):
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    nodes, links = m.node_tree.nodes, m.node_tree.links
    nodes.clear()
    out, diffuse = nodes.new("ShaderNodeOutputMaterial"), nodes.new("ShaderNodeBsdfDiffuse")
    links.new(diffuse.outputs[0], out.inputs[0])
    if image:
        texture = nodes.new("ShaderNodeTexImage")
        texture.image = bpy.data.images.load(image)
        texture.interpolation = "Cubic"
        links.new(texture.outputs[0], diffuse.inputs[0])
    else:
        diffuse.inputs[0].default_value = (*colour, 1)
    return m


bpy.ops.mesh.primitive_plane_add(size=6, location=(0, 2, 1), rotation=(math.radians(90), 0, math.radians(12)))
wall = bpy.context.object
wall.name = "Wall"
wall.data.materials.append(material("wall", image=picture))
bpy.ops.mesh.primitive_uv_sphere_add(radius=0.6, segments=64, ring_count=32)
ball = bpy.context.object
ball.name = "Ball"
bpy.ops.object.shade_smooth()
ball.data.materials.append(material("ball", colour=(0.6, 0.15, 0.1)))
bpy.ops.mesh.primitive_plane_add(size=40, location=(0, 0, -1.6))
bpy.context.object.name = "Ground"
bpy.context.object.data.materials.append(material("ground", colour=(0.3, 0.35, 0.3)))
bpy.ops.object.light_add(type="SUN", rotation=(math.radians(50), math.radians(15), math.radians(-20)))
bpy.context.object.data.energy = 3
bpy.context.object.data.angle = 0.05
bpy.ops.object.light_add(type="AREA", location=(-3, -3, 3), rotation=(math.radians(60), 0, math.radians(-40)))
bpy.context.object.data.energy = 250
bpy.context.object.data.size = 2
bpy.context.object.data.color = (1, 0.85, 0.7)
bpy.ops.object.camera_add(location=(0, -6, 1), rotation=(math.radians(88), 0, 0))
camera = bpy.context.object
scene.camera = camera
world = bpy.data.worlds.new("world")
scene.world = world
world.color = (0.05, 0.06, 0.08)


def keys(thing, path, values):
    for frame, value in values.items():
        setattr(thing, path, value)
        thing.keyframe_insert(path, frame=frame)
    for curve in thing.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


keys(ball, "location", {1: (-1.6, 0.2, 0.1), 25: (1.6, 0.2, 0.1)})
keys(camera, "location", {1: (-0.3, -6, 1), 25: (0.5, -5.2, 1.2)})
bpy.ops.render.render(animation=True)
