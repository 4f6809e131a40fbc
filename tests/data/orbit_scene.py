# Renders a shot of 150 frames twice: with its old materials under a moving sun, and with a given
# picture, unlit, on wall, cloth and slab. The camera goes a hundred degrees round the scene; a pillar
# hides the slab for 20 frames on the way; the cloth hangs flat on the first frame, then waves.
#   blender -b -P orbit_scene.py -- OUT_DIR TEXTURES_DIR PICTURE FRAMES WIDTH HEIGHT SAMPLES [STEP]
# The second rendering can be of every STEP-th frame alone.
# Writes old/####.png, new/####.png, mattes/####.png (coverage: red wall, green cloth, blue slab) and
# corners.json: where the picture's corners (top left, top right, bottom right, bottom left) lie in
# every frame, pixels, for the two flat surfaces, and for the cloth on the first frame.
import json
import math
import os
import sys
import bpy
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from scene_setup import picture_into, sharp_scene

arguments = sys.argv[sys.argv.index("--") + 1:]
out, textures, picture, frames, width, height, samples = arguments[:7]
step = int(arguments[7]) if len(arguments) > 7 else 1
frames, width, height, samples = int(frames), int(width), int(height), int(samples)

scene = sharp_scene(frames, width, height, samples)
scene.render.use_persistent_data = True
world = bpy.data.worlds.new("world")
scene.world = world
world.use_nodes = True
world.node_tree.nodes["Background"].inputs[0].default_value = (0.25, 0.32, 0.42, 1)
scene.view_layers[0].aovs.add().name = "coverage"


def material(name, file, scale=1.0, lit=True, coverage=(0, 0, 0)):
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    nodes, links = m.node_tree.nodes, m.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    shader = nodes.new("ShaderNodeBsdfDiffuse" if lit else "ShaderNodeEmission")
    image = picture_into(m, shader, file, scale)
    image.extension = "REPEAT" if scale != 1 else "EXTEND"
    links.new(shader.outputs[0], output.inputs[0])
    aov = nodes.new("ShaderNodeOutputAOV")
    aov.name = "coverage"
    aov.inputs[0].default_value = (*coverage, 1)
    return m


def plane(name, sx, sy, location, rotation):
    bpy.ops.mesh.primitive_plane_add(size=1, location=location, rotation=rotation)
    o = bpy.context.object
    o.name, o.scale = name, (sx, sy, 1)
    return o


UPRIGHT = (math.radians(90), 0, 0)
wall = plane("wall", 6.4, 3.2, (0, 2.6, 1.7), UPRIGHT)
back = plane("back", 60, 30, (0, 5.5, 5), UPRIGHT)
floor = plane("floor", 40, 40, (0, 0, 0), (0, 0, 0))
slab = plane("slab", 1.05, 1.05, (0, 0, 1.05), UPRIGHT)
bpy.ops.mesh.primitive_cylinder_add(radius=0.6, depth=6, location=(0, -2.5, 3), vertices=64)
pillar = bpy.context.object
bpy.ops.object.shade_smooth()
# A cloth of its own mesh: UVs follow it, so the picture does.
bpy.ops.mesh.primitive_grid_add(x_subdivisions=120, y_subdivisions=120, size=1,
                                location=(-2.0, 1.0, 1.75), rotation=UPRIGHT)
cloth = bpy.context.object
cloth.scale = (1.7, 1.9, 1)
bpy.ops.object.shade_smooth()
rest = [v.co.copy() for v in cloth.data.vertices]


def wave(frame):
    t = (frame - 1) / 24
    swell = min(1.0, (frame - 1) / 24)
    for v, r in zip(cloth.data.vertices, rest):
        hang = 0.5 - r.y  # 0 at the rod, 1 at the hem
        depth = 0.10 * math.sin(7.5 * r.x + 2.6 * t + 2 * r.y) + 0.06 * math.sin(4 * r.y - 3.1 * t)
        v.co = r + Vector((0.02 * math.sin(2.2 * t + 5 * r.y) * hang, 0, depth * hang)) * swell
    cloth.data.update()


sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy, sun.data.angle = 3.2, math.radians(0.5)
fill = bpy.data.objects.new("fill", bpy.data.lights.new("fill", "SUN"))
fill.data.energy, fill.data.cycles.cast_shadow = 0.9, False
fill.rotation_euler = Vector((0.4, 0.7, -0.5)).to_track_quat("-Z", "Y").to_euler()
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
for o in (sun, fill, camera):
    scene.collection.objects.link(o)
scene.camera = camera
camera.data.lens = 32


def set_up(frame):
    s = (frame - 1) / 149
    phi = math.radians(-50 + 100 * s)
    camera.location = (6 * math.sin(phi), -6 * math.cos(phi), 1.6 + 0.25 * math.sin(3 * s))
    target = Vector((0, 0.2, 1.25))
    camera.rotation_euler = (target - camera.location).to_track_quat("-Z", "Y").to_euler()
    sun.rotation_euler = Vector((0.9 - 1.2 * s, 1.0, -0.9)).to_track_quat("-Z", "Y").to_euler()
    sun.data.energy = 3.2 * (1 - 0.25 * s)
    wave(frame)
    bpy.context.view_layer.update()


def corners(o):
    found = []
    for x, y in ((-0.5, 0.5), (0.5, 0.5), (0.5, -0.5), (-0.5, -0.5)):
        p = world_to_camera_view(scene, camera, o.matrix_world @ Vector((x, y, 0)))
        found.append([round(p.x * width, 3), round((1 - p.y) * height, 3)])
    return found


scene.use_nodes = True
tree = scene.node_tree
tree.nodes.clear()
layers = tree.nodes.new("CompositorNodeRLayers")
composite = tree.nodes.new("CompositorNodeComposite")
files = tree.nodes.new("CompositorNodeOutputFile")
files.format.file_format, files.format.color_mode = "PNG", "RGB"
files.base_path = out
tree.links.new(layers.outputs["Image"], composite.inputs[0])


def outputs(*slots):
    files.file_slots.clear()
    for name, source in slots:
        files.file_slots.new(name + "/")
        slot = files.file_slots[-1]
        slot.use_node_format = False
        slot.format.file_format, slot.format.color_mode = "PNG", "RGB"
        slot.format.color_management = "OVERRIDE"
        slot.format.view_settings.view_transform = "Raw" if name == "mattes" else "Standard"
        tree.links.new(layers.outputs[source], files.inputs[-1])


def dress(wall_material, cloth_material, slab_material):
    for o, m in ((wall, wall_material), (cloth, cloth_material), (slab, slab_material),
                 (floor, ground), (back, plaster), (pillar, stone)):
        o.data.materials.clear()
        o.data.materials.append(m)


def photo(name):
    return textures + "/" + name


ground = material("ground", photo("dirt_soil/nexuiz_bdirt.jpg"), 16)
plaster = material("plaster", photo("concrete/ufoai_concrete003.jpg"), 12)
stone = material("stone", photo("stone/ufoai_rock004.jpg"), 3)
R, G, B = (1, 0, 0), (0, 1, 0), (0, 0, 1)
old = (material("brick", photo("brick/ufoai_wall_bricks005.jpg"), 3, True, R),
       material("weave", photo("carpet/ufoai_carpet009.jpg"), 1.001, True, G),
       material("planks", photo("wood/ufoai_wood012.jpg"), 1.001, True, B))
new = tuple(material("new", picture, 1, False, c) for c in (R, G, B))
places = {"wall": [], "slab": [], "cloth": []}
for name, materials in (("old", old), ("new", new)):
    dress(*materials)
    outputs(*(((name, "Image"), ("mattes", "coverage")) if name == "old" else ((name, "Image"),)))
    for frame in range(1, frames + 1, 1 if name == "old" else step):
        scene.frame_set(frame)
        set_up(frame)
        if name == "old":
            places["wall"].append(corners(wall))
            places["slab"].append(corners(slab))
            if frame == 1:
                places["cloth"].append(corners(cloth))
        bpy.ops.render.render(write_still=False)
with open(out + "/corners.json", "w") as f:
    json.dump(places, f)
