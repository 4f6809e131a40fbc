# Renders a board that flies past a wall, turning, and a square that spins, through a shutter: with
# old materials, with one given picture on board and spinner, unlit, and their mattes with the blur in
# them (R board, G square).
#   blender -b -P blurred_scene.py -- OUT_DIR TEXTURES_DIR PICTURE FRAMES WIDTH HEIGHT SAMPLES DEGREES
# OUT_DIR/old, OUT_DIR/new and OUT_DIR/mattes/####.png are written. DEGREES of 360 a frame; 0: sharp.
import math
import os
import sys
import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from scene_setup import picture_into, sharp_scene

out, textures, picture, frames, width, height, samples, degrees = sys.argv[sys.argv.index("--") + 1:][:8]
frames, width, height, samples, degrees = int(frames), int(width), int(height), int(samples), float(degrees)

scene = sharp_scene(frames, width, height, samples)
scene.render.image_settings.file_format = "PNG"
scene.render.image_settings.color_mode = "RGB"
scene.render.dither_intensity = 0  # a matte must be 0 outside
scene.render.use_motion_blur = degrees > 0
scene.render.motion_blur_shutter = max(degrees, 1) / 360
scene.cycles.motion_blur_position = "CENTER"


def unlit(name, source=None, scale=1.0, colour=(0, 0, 0)):
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    nodes, links = m.node_tree.nodes, m.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    shader = nodes.new("ShaderNodeEmission")
    shader.inputs[0].default_value = (*colour, 1)
    if source:
        picture_into(m, shader, source, scale)
    links.new(shader.outputs[0], output.inputs[0])
    return m


def plane(name, sx, sy, location):
    bpy.ops.mesh.primitive_plane_add(size=1, location=location, rotation=(math.radians(90), 0, 0))
    o = bpy.context.object
    o.name, o.scale = name, (sx, sy, 1)
    return o


# The camera looks along +y at the plane y = 0, which it sees 6 units wide.
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
scene.camera = camera
camera.data.lens, camera.data.sensor_width = 36, 36
camera.location = (0, -6, 0)
camera.rotation_euler = (math.radians(90), 0, 0)

back = plane("back", 8, 5, (0, 0.4, 0))
board = plane("board", 2.2, 1.5, (0, 0, 0.55))
spinner = plane("spinner", 1.5, 1.5, (1.9, -0.1, -0.75))
for f in (0, frames + 1):  # at an even speed from before the first frame to after the last
    s = (f - 1) / max(1, frames - 1)
    board.location.x = -1.75 + 2.4 * s
    board.rotation_euler = (math.radians(90), math.radians(-6 + 14 * s), 0)
    spinner.rotation_euler = (math.radians(90), math.radians(110 * s), 0)
    board.keyframe_insert("location", frame=f)
    for o in (board, spinner):
        o.keyframe_insert("rotation_euler", frame=f)
for o in (board, spinner):
    for curve in o.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


def render(name, materials):
    for o in (back, board, spinner):
        o.data.materials.clear()
        o.data.materials.append(materials[o.name])
    for f in range(1, frames + 1):
        scene.frame_set(f)
        scene.render.filepath = out + "/%s/%04d.png" % (name, f)
        bpy.ops.render.render(write_still=True)


old = {"back": unlit("backdrop", textures + "/concrete/ufoai_concrete013.jpg", 3.0),
       "board": unlit("gravel", textures + "/gravel/ufoai_pebbles_m_1.jpg", 1.0),
       "spinner": unlit("bricks", textures + "/brick/ufoai_wall_bricks005.jpg", 1.0)}
given = unlit("given", picture)
render("old", old)
render("new", {**old, "board": given, "spinner": given})
# A matte is linear coverage: no display curve.
scene.view_settings.view_transform = "Raw"
render("mattes", {"back": unlit("black"), "board": unlit("red", colour=(1, 0, 0)),
                  "spinner": unlit("green", colour=(0, 1, 0))})
