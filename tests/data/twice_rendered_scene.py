# Renders one moving scene several times: with its old materials, with one surface in flat grey or in
# another texture (all others keep theirs, so that soft edges can be compared too), and its mattes.
# Lights cast no bounced light, so that all differences between two renderings come from the material.
#   blender -b -P twice_rendered_scene.py -- OUT_DIR TEXTURES_DIR FRAMES WIDTH HEIGHT SAMPLES [WHAT] [AT]
# WHAT: some of old, grey_wall, grey_ball, new_wall, new_ball, matte_wall, matte_ball, by commas [all].
# AT: frames of the truths (grey_…, new_…), by commas [all]. OUT_DIR/WHAT/####.png is written.
import math
import os
import sys
import bpy
from mathutils import Vector

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from scene_setup import picture_into, sharp_scene

arguments = sys.argv[sys.argv.index("--") + 1:]
out, textures, frames, width, height, samples = arguments[:6]
names = ("old", "grey_wall", "grey_ball", "new_wall", "new_ball", "matte_wall", "matte_ball")
wanted = arguments[6].split(",") if len(arguments) > 6 else names
frames, width, height, samples = int(frames), int(width), int(height), int(samples)

scene = sharp_scene(frames, width, height, samples)
scene.render.image_settings.file_format = "PNG"
scene.render.image_settings.color_mode = "RGB"
scene.render.use_persistent_data = True
scene.render.dither_intensity = 0  # a matte must be 0 outside
world = bpy.data.worlds.new("world")
scene.world = world
world.use_nodes = True
world.node_tree.nodes["Background"].inputs[0].default_value = (0.02, 0.03, 0.05, 1)


def material(name, picture=None, colour=(0.8, 0.8, 0.8), scale=1.0, emission=None):
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    nodes, links = m.node_tree.nodes, m.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    if emission is not None:
        shader = nodes.new("ShaderNodeEmission")
        shader.inputs[0].default_value = (emission, emission, emission, 1)
    else:
        shader = nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs[0].default_value = (*colour, 1)
    if picture:
        picture_into(m, shader, textures + "/" + picture, scale)
    links.new(shader.outputs[0], output.inputs[0])
    return m


def sun(name, energy, angle_deg, direction, shadow, colour=(1, 1, 1)):
    light = bpy.data.lights.new(name, "SUN")
    light.energy, light.angle, light.color = energy, math.radians(angle_deg), colour
    light.cycles.cast_shadow = shadow
    o = bpy.data.objects.new(name, light)
    o.rotation_euler = Vector(direction).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(o)
    return light


def plane(name, sx, sy, location, rotation):
    bpy.ops.mesh.primitive_plane_add(size=1, location=location, rotation=rotation)
    o = bpy.context.object
    o.name, o.scale = name, (sx, sy, 1)
    return o


wall = plane("wall", 7.0, 3.4, (0, 1.6, 1.9), (math.radians(90), 0, 0))
floor = plane("floor", 30, 30, (0, 0, 0), (0, 0, 0))
back = plane("back", 60, 40, (0, 6, 0), (math.radians(90), 0, 0))
bpy.ops.mesh.primitive_uv_sphere_add(radius=0.85, segments=96, ring_count=48, location=(1.9, 0.1, 0.85))
ball = bpy.context.object
bpy.ops.object.shade_smooth()
# What casts the shadow: a post and a disc that pass in front of the sun, out of the picture.
bpy.ops.mesh.primitive_cylinder_add(radius=0.28, depth=14, location=(0, -8, 6))
post = bpy.context.object
bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5, segments=64, ring_count=32, location=(0, -8, 4))
disc = bpy.context.object
for o in (post, disc):
    o.visible_camera = False

key = sun("key", 4.5, 0.4, (0.0, 1.0, -0.45), True, (1.0, 0.95, 0.88))
sun("fill", 0.9, 0, (0.5, 0.6, -0.8), False, (0.85, 0.92, 1.0))
sun("fill2", 0.4, 0, (-0.7, 0.8, -0.1), False, (0.85, 0.92, 1.0))

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
scene.camera = camera
camera.data.lens = 32

for f in range(1, frames + 1):
    s = (f - 1) / max(1, frames - 1)
    camera.location = (-0.9 + 1.1 * s, -4.6 + 0.3 * s, 1.75)
    camera.rotation_euler = (math.radians(89), 0, math.radians(-9 + 7 * s))
    camera.keyframe_insert("location", frame=f)
    camera.keyframe_insert("rotation_euler", frame=f)
    post.location.x = -3.4 + 5.0 * s
    post.keyframe_insert("location", frame=f)
    disc.location = (2.6 - 4.0 * s, -8, 5.6)
    disc.keyframe_insert("location", frame=f)
    dim = 1 - 0.4 * s
    for light, energy in ((key, 4.5), (bpy.data.lights["fill"], 0.9), (bpy.data.lights["fill2"], 0.4)):
        light.energy = energy * dim
        light.keyframe_insert("energy", frame=f)


truth_frames = [int(f) for f in arguments[7].split(",")] if len(arguments) > 7 else range(1, frames + 1)


def render(name, at, **materials):
    if name not in wanted:
        return
    for o in (wall, ball, floor, back):
        o.data.materials.clear()
        o.data.materials.append(materials[o.name])
    for f in at:
        scene.frame_set(f)
        scene.render.filepath = out + "/%s/%04d.png" % (name, f)
        bpy.ops.render.render(write_still=True)


every = range(1, frames + 1)
ball.name = "ball"
old = {"wall": material("brick", "brick/ufoai_wall_bricks005.jpg", scale=2.0),
       "ball": material("planks", "wood/ufoai_wood012.jpg", scale=3.0),
       "floor": material("ground", "dirt_soil/nexuiz_bdirt.jpg", scale=12.0),
       "back": material("backdrop", colour=(0.35, 0.42, 0.5))}
grey = material("grey", colour=(0.35, 0.35, 0.35))
gravel = material("gravel", "gravel/ufoai_pebbles_m_1.jpg", scale=2.0)
straw = material("straw", "straw/ufoai_straw.jpg", scale=3.0)
render("old", every, **old)
render("grey_wall", truth_frames, **{**old, "wall": grey})
render("grey_ball", truth_frames, **{**old, "ball": grey})
render("new_wall", truth_frames, **{**old, "wall": gravel})
render("new_ball", truth_frames, **{**old, "ball": straw})

# Mattes: the surface emits light, all else is black. The sun's blockers are in no picture.
post.hide_render = disc.hide_render = True
for light in bpy.data.lights:
    light.animation_data_clear()
    light.energy = 0
world.node_tree.nodes["Background"].inputs[0].default_value = (0, 0, 0, 1)
scene.view_settings.view_transform = "Raw"
black, white = material("black", emission=0.0), material("white", emission=1.0)
hidden = {name: black for name in old}
render("matte_wall", every, **{**hidden, "wall": white})
render("matte_ball", every, **{**hidden, "ball": white})
