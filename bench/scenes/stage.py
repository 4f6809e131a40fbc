"""A scene under construction: parts, lights and a camera, animated by one key a frame."""
import math
from dataclasses import dataclass
from typing import Callable, Optional

import bpy
import numpy as np
from mathutils import Matrix, Vector

from meshes import Mesh
from paints import Paint
from shader import Shader

GREY = 0.35           # the plain grey of the second rendering, linear
TILE_M = 0.5          # what the tiled picture of the third rendering covers, metres
SENSOR_MM = 36.0


@dataclass
class Part:
    """An object with an id. `surface`: one of those whose material is replaced.

    `pose`: 4×4 or a function of the frame that returns one. `shape`: a function of the frame that returns the
    vertices (n, 3). `hidden`: casts shadows only, and no pass shows it."""
    name: str
    id: int
    mesh: Mesh
    paint: Paint
    surface: bool
    pose: Callable
    shape: Optional[Callable]
    hidden: bool
    object: bpy.types.Object = None
    still: bool = False


class Stage:
    """`frames` frames, numbered from 1. Everything is baked from frame 0 to `frames` + 1, since motion needs the neighbours.

    `shutter_deg` is 0 for a scene without motion blur."""

    def __init__(self, frames, size):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scene = bpy.context.scene
        self.frames, self.size = frames, size
        self.scene.frame_start, self.scene.frame_end = 1, frames
        self.scene.render.resolution_x, self.scene.render.resolution_y = size
        self.scene.render.resolution_percentage = 100
        self.parts, self.lamps, self.shutter_deg = [], [], 0
        self.sky((1, 1, 1), 0.0)
        self.camera = None

    @property
    def baked(self):
        return range(0, self.frames + 2)

    def at(self, frame):
        """0 on the first frame, 1 on the last."""
        return (frame - 1) / max(1, self.frames - 1)

    # ---- parts --------------------------------------------------------------------------------------

    def add(self, name, mesh, paint, surface=False, pose=None, shape=None, hidden=False):
        fixed = Matrix.Identity(4) if pose is None else pose
        place = fixed if callable(fixed) else lambda frame: fixed
        part = Part(name, len(self.parts) + 1, mesh, paint, surface, place, shape, hidden)
        part.still = not callable(fixed) and shape is None
        part.object = self._object(part)
        self._animate(part.object, place, animated=callable(fixed))
        if shape is not None:
            self._bake_shape(part.object, shape)
        self.parts.append(part)
        return part

    def _object(self, part):
        data = bpy.data.meshes.new(part.name)
        mesh = part.mesh
        data.vertices.add(len(mesh.vertices))
        data.vertices.foreach_set("co", mesh.vertices.astype(np.float32).ravel())
        count = len(mesh.triangles)
        data.loops.add(3 * count)
        data.loops.foreach_set("vertex_index", mesh.triangles.astype(np.int32).ravel())
        data.polygons.add(count)
        data.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
        data.polygons.foreach_set("loop_total", np.full(count, 3, np.int32))
        data.polygons.foreach_set("use_smooth", np.full(count, smooth(mesh), bool))
        layer = data.uv_layers.new(name="metres")
        layer.data.foreach_set("uv", mesh.uv.astype(np.float32).ravel())
        rest = data.attributes.new("rest", "FLOAT_VECTOR", "POINT")
        rest.data.foreach_set("vector", mesh.vertices.astype(np.float32).ravel())
        data.update(calc_edges=True)
        # What deforms keeps its vertices: auto smooth splits them where faces meet sharply, on some frames and not on
        # others, and Cycles then has no motion of them.
        if smooth(mesh) and part.shape is None:
            data.use_auto_smooth, data.auto_smooth_angle = True, math.radians(40)
        o = bpy.data.objects.new(part.name, data)
        o.pass_index = part.id
        if part.hidden:
            o.visible_camera = False
            o.pass_index = 0
        self.scene.collection.objects.link(o)
        return o

    def _animate(self, o, place, animated):
        o.rotation_mode = "QUATERNION"
        last = None
        for frame in self.baked if animated else (1,):
            location, rotation, scale = place(frame).decompose()
            if last is not None:
                rotation.make_compatible(last)
            last = rotation.copy()
            o.location, o.rotation_quaternion, o.scale = location, rotation, scale
            if animated:
                o.keyframe_insert("location", frame=frame)
                o.keyframe_insert("rotation_quaternion", frame=frame)
        straighten(o.animation_data)

    def _bake_shape(self, o, shape):
        o.shape_key_add(name="rest", from_mix=False)
        for frame in self.baked:
            key = o.shape_key_add(name="f%d" % frame, from_mix=False)
            key.data.foreach_set("co", np.asarray(shape(frame), np.float32).ravel())
            key.interpolation = "KEY_LINEAR"
        keys = o.data.shape_keys
        keys.use_relative = False
        for frame, key in zip(self.baked, list(keys.key_blocks)[1:]):
            keys.eval_time = key.frame
            keys.keyframe_insert("eval_time", frame=frame)
        straighten(keys.animation_data)

    # ---- camera and light ---------------------------------------------------------------------------

    def look(self, view, lens_mm=35.0):
        """`view`: a function of the frame that returns where the camera is and what it looks at, metres."""
        data = bpy.data.cameras.new("camera")
        data.lens, data.sensor_width, data.clip_start = lens_mm, SENSOR_MM, 0.05
        self.camera = bpy.data.objects.new("camera", data)
        self.scene.collection.objects.link(self.camera)
        self.scene.camera = self.camera
        self._animate(self.camera, lambda f: looking(*view(f)), animated=True)

    def sky(self, colour, strength):
        """Uniform light from everywhere, without noise where nothing stands in its way."""
        world = self.scene.world or bpy.data.worlds.new("sky")
        self.scene.world = world
        world.use_nodes = True
        self.sky_light = [float(c) * strength for c in colour]
        node = world.node_tree.nodes["Background"]
        node.inputs["Color"].default_value = (*colour, 1)
        node.inputs["Strength"].default_value = strength
        # Directions drawn from the surface's cosine: a uniform sky is then exact wherever all of it is seen.
        world.cycles.sampling_method = "NONE"

    def sun(self, towards, strength, angle_deg=0.53, colour=(1, 0.96, 0.9)):
        """`towards`: the direction in which its light travels, or a function of the frame."""
        light = bpy.data.lights.new("sun", "SUN")
        light.energy, light.angle, light.color = strength, math.radians(angle_deg), colour
        return self._lamp(light, (lambda f: (Vector((0, 0, 0)), Vector(towards(f)))) if callable(towards)
                          else (Vector((0, 0, 0)), Vector(towards)))

    def lamp(self, place, aim, watts, side_m, colour=(1, 0.85, 0.65)):
        """A square lamp; a small `side_m` casts crisp shadows."""
        light = bpy.data.lights.new("lamp", "AREA")
        light.energy, light.size, light.color = watts, side_m, colour
        return self._lamp(light, (Vector(place), Vector(aim)))

    def _lamp(self, light, line):
        o = bpy.data.objects.new(light.name, light)
        self.scene.collection.objects.link(o)
        self.lamps.append(o)
        animated = callable(line)
        self._animate(o, lambda f: looking(*(line(f) if animated else line)), animated)
        return o

    # ---- what the parts look like -------------------------------------------------------------------

    def dress(self, variant, tile_picture=None):
        """`variant`: "old", "grey" or "tiled", without any reflection: the surfaces in question change, nothing else does.
        Or "gloss" (the reflections alone) or "gloss elsewhere" (those of all but the surfaces in question)."""
        for part in self.parts:
            shader = Shader("%s %s" % (part.name, variant))
            if variant.startswith("gloss"):
                self._reflect(shader, part, part.surface and variant == "gloss elsewhere")
            elif variant == "grey" and part.surface:
                shader.diffuse((GREY,) * 3)
            elif variant == "tiled" and part.surface:
                shader.diffuse(shader.picture(tile_picture, shader.scaled(shader.uv, (1 / TILE_M, -1 / TILE_M, 1))))
            elif part.paint.gloss is not None:
                shader.under_coat(part.paint.colour(shader))
            else:
                shader.diffuse(part.paint.colour(shader))
            shader.aov("rest", shader.rest)
            # In place of Cycles' UV pass, which is empty or another attribute once materials have been exchanged.
            shader.aov("metres", shader.uv)
            for group in range(self.coverage_groups):
                shader.aov("coverage%d" % group, [float(part.id == 3 * group + c + 1) for c in range(3)])
            materials = part.object.data.materials
            materials.clear()
            materials.append(shader.material)

    def _reflect(self, shader, part, left_out):
        if part.paint.gloss is None or left_out:
            shader.in_reflections(part.paint.colour(shader))
        else:
            shader.coat(part.paint.gloss)

    @property
    def glossy(self):
        return any(part.paint.gloss is not None for part in self.parts)

    def white(self):
        shader = Shader("white")
        shader.diffuse((1, 1, 1))
        return shader.material

    @property
    def coverage_groups(self):
        """Coverage passes of three parts each (R, G, B)."""
        return (len(self.parts) + 2) // 3


def smooth(mesh):
    """Whether a mesh is shaded smoothly: all but a few large facets, or loose strands."""
    return len(mesh.triangles) > 24 and 3 * len(mesh.vertices) < 5 * len(mesh.triangles)


def straighten(animation):
    if animation and animation.action:
        for curve in animation.action.fcurves:
            for key in curve.keyframe_points:
                key.interpolation = "LINEAR"


def looking(place, target):
    """A pose at `place` whose −z points at `target` and whose y points up."""
    place, target = Vector(place), Vector(target)
    turn = (target - place).to_track_quat("-Z", "Y")
    return Matrix.Translation(place) @ turn.to_matrix().to_4x4()
