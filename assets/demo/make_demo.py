#!/usr/bin/env python3
# SPDX-License-Identifier: CC0-1.0
"""Weft's demo shot, made from nothing: scene, frames, object ids, mattes, true motion.

    blender -b --factory-startup -noaudio -P make_demo.py            # everything, in place
    blender -b --factory-startup -noaudio -P make_demo.py -- --help  # options

Written for Debian 12's Blender 3.4.1, which has Cycles on the CPU and no denoiser.
It needs nothing beyond Blender and the numpy that comes with it; there are no
external assets.  Every seed and sample count is fixed.

A sunlit courtyard.  A wooden figure in a cape walks out from before a hanging cloth, that
billows in the wind, and past a plaster wall; a painted ball rolls the other way across
the foreground; the shadow of palm fronds off screen sweeps over the lot; the camera
trucks slowly to the left.

How a frame is made (three cheap Cycles renders, put together in numpy):

  key    the sun alone, no bounces.  Practically free of noise, so it stays untouched.
         Also yields the albedo and, through shader AOVs, the soft coverage mattes.
  fill   sky and bounced light alone, few samples.  Its *irradiance* is smoothed by an
         edge-avoiding filter guided by position and normal, and then multiplied by
         the albedo of `key`: clean light, untouched texture.
  data   one sample in the exact centre of each pixel: object ids and the Vector pass,
         neither of them mixed across an edge.

All movement is baked to one key a frame (rigid parts) or to one absolute shape key a
frame (cloth and cape), so the Vector pass is exact.
"""
import argparse
import math
import os
import random
import struct
import subprocess
import sys
import time
import zlib

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

FIRST, LAST, FPS = 1001, 1048, 24
WIDTH, HEIGHT = 960, 540
KEY_SAMPLES, FILL_SAMPLES = 16, 6
# Baking runs one frame over at either end: the Vector pass looks at N-1 and N+1.
BAKE = range(FIRST - 1, LAST + 2)

# Object ids: the values of the pixels in ids/####.png.
IDS = dict(wall=10, ground=20, cloth=30, ball=40, cape=50, figure=60, hat=70,
           door=80, doorframe=90, rail=100, pot=110, cactus=120)
# Objects with a soft matte; AOVs carry three apiece in R, G, B.
MATTES = ["wall", "cloth", "ball", "cape", "ground", "door"]


def phase(frame):
    """0 at the first frame, 1 at the last (a little outside at the baked margins)."""
    return (frame - FIRST) / (LAST - FIRST)


# --------------------------------------------------------------------------------------
# Shading: a thin layer over node trees
# --------------------------------------------------------------------------------------
class Shader:
    """A material under construction.  Methods make a node and give back its output."""

    def __init__(self, name):
        self.mat = bpy.data.materials.new(name)
        self.mat.use_nodes = True
        self.tree = self.mat.node_tree
        self.tree.nodes.clear()

    def node(self, kind, inputs=None, **props):
        n = self.tree.nodes.new(kind)
        for k, v in props.items():
            setattr(n, k, v)
        for k, v in (inputs or {}).items():
            if isinstance(v, bpy.types.NodeSocket):
                self.tree.links.new(v, n.inputs[k])
            elif v is not None:
                sock = n.inputs[k]
                if sock.type == "RGBA" and not isinstance(v, (int, float)) and len(v) == 3:
                    v = (*v, 1.0)
                elif sock.type == "RGBA" and isinstance(v, (int, float)):
                    v = (v, v, v, 1.0)
                sock.default_value = v
        return n

    def coord(self, which="Object"):
        return self.node("ShaderNodeTexCoord").outputs[which]

    def mapping(self, vec, scale=(1, 1, 1), loc=(0, 0, 0), rot=(0, 0, 0)):
        return self.node("ShaderNodeMapping", {"Vector": vec, "Scale": scale,
                                               "Location": loc, "Rotation": rot}).outputs[0]

    def noise(self, vec, scale, detail=3.0, rough=0.55, distort=0.0, out="Fac"):
        return self.node("ShaderNodeTexNoise", {"Vector": vec, "Scale": scale, "Detail": detail,
                                                "Roughness": rough, "Distortion": distort}).outputs[out]

    def wave(self, vec, scale, distort=0.0, detail=2.0, dscale=1.0, **props):
        return self.node("ShaderNodeTexWave", {"Vector": vec, "Scale": scale, "Distortion": distort,
                                               "Detail": detail, "Detail Scale": dscale},
                         **props).outputs["Fac"]

    def voronoi(self, vec, scale, out="Distance", **props):
        return self.node("ShaderNodeTexVoronoi", {"Vector": vec, "Scale": scale}, **props).outputs[out]

    def ramp(self, fac, stops, interp="LINEAR"):
        n = self.node("ShaderNodeValToRGB", {"Fac": fac})
        cr = n.color_ramp
        cr.interpolation = interp
        while len(cr.elements) < len(stops):
            cr.elements.new(0.5)
        for e, (p, c) in zip(cr.elements, stops):
            e.position = p
            e.color = (c, c, c, 1) if isinstance(c, (int, float)) else (*c, 1)
        return n.outputs["Color"]

    def math(self, op, a, b=None, c=None):
        n = self.node("ShaderNodeMath", operation=op)
        for i, v in enumerate((a, b, c)):
            if isinstance(v, bpy.types.NodeSocket):
                self.tree.links.new(v, n.inputs[i])
            elif v is not None:
                n.inputs[i].default_value = v
        return n.outputs[0]

    def mix(self, fac, a, b, blend="MIX"):
        return self.node("ShaderNodeMixRGB", {"Fac": fac, "Color1": a, "Color2": b},
                         blend_type=blend).outputs[0]

    def xyz(self, vec):
        return self.node("ShaderNodeSeparateXYZ", {"Vector": vec}).outputs

    def combine(self, x, y, z=0.0):
        return self.node("ShaderNodeCombineXYZ", {"X": x, "Y": y, "Z": z}).outputs[0]

    def bump(self, height, distance, strength=1.0):
        return self.node("ShaderNodeBump", {"Height": height, "Distance": distance,
                                            "Strength": strength}).outputs[0]

    def finish(self, color, normal=None, rough=0.8, specular=0.15, matte=None):
        bsdf = self.node("ShaderNodeBsdfPrincipled", {"Base Color": color, "Roughness": rough,
                                                      "Specular": specular, "Normal": normal})
        out = self.node("ShaderNodeOutputMaterial")
        self.tree.links.new(bsdf.outputs[0], out.inputs["Surface"])
        # Coverage: 1 in this object's own channel, 0 in all others.
        for group in range(2):
            want = [1.0 if matte == m else 0.0 for m in MATTES[group * 3:group * 3 + 3]]
            aov = self.node("ShaderNodeOutputAOV", {"Color": want})
            aov.name = "matte%d" % group
        return self.mat


def mat_plaster():
    s = Shader("plaster")
    p = s.coord()
    broad = s.noise(p, 0.9, 2, 0.6, 0.6)
    mid = s.noise(p, 5.0, 4, 0.62, 0.3)
    fine = s.noise(p, 38.0, 1, 0.6)
    trowel = s.noise(s.mapping(p, (1.6, 1, 5.0), rot=(0, 0.5, 0)), 3.2, 3, 0.6, 1.2)
    c = s.ramp(broad, [(0.32, (0.60, 0.40, 0.225)), (0.50, (0.70, 0.50, 0.31)), (0.68, (0.74, 0.575, 0.40))])
    c = s.mix(0.75, c, s.ramp(mid, [(0.30, 0.52), (0.50, 0.90), (0.70, 1.04)]), "MULTIPLY")
    c = s.mix(0.50, c, s.ramp(trowel, [(0.36, 0.72), (0.56, 1.03)]), "MULTIPLY")
    c = s.mix(0.65, c, s.ramp(fine, [(0.33, 0.66), (0.52, 1.0), (0.7, 1.06)]), "MULTIPLY")
    # Patches where the paint has come off, paler and cooler.
    worn = s.ramp(s.noise(s.mapping(p, loc=(3.1, 0, 1.7)), 1.5, 5, 0.66, 0.5), [(0.585, 0.0), (0.615, 1.0)])
    c = s.mix(s.math("MULTIPLY", worn, 0.72), c, s.ramp(mid, [(0.35, (0.44, 0.36, 0.27)), (0.65, (0.66, 0.57, 0.46))]))
    # Splashed dirt at the foot of the wall.
    z = s.xyz(p)["Z"]
    dirt = s.math("SUBTRACT", s.math("MULTIPLY", mid, 0.75), z)
    c = s.mix(s.ramp(dirt, [(0.0, 0.0), (0.42, 0.62)]), c, (0.235, 0.155, 0.095))
    h = s.math("ADD", s.math("MULTIPLY", trowel, 0.7), s.math("MULTIPLY", mid, 0.55))
    h = s.math("ADD", h, s.math("MULTIPLY", fine, 0.22))
    h = s.math("SUBTRACT", h, s.math("MULTIPLY", worn, 0.18))
    return s.finish(c, s.bump(h, 0.035), 0.9, 0.1, "wall")


def mat_flags():
    s = Shader("flagstones")
    p = s.coord()
    warp = s.mix(0.045, p, s.noise(p, 2.2, 2, out="Color"), "ADD")
    edge = s.voronoi(warp, 1.75, feature="DISTANCE_TO_EDGE", voronoi_dimensions="2D")
    cell = s.voronoi(warp, 1.75, "Color", feature="F1", voronoi_dimensions="2D")
    tone = s.xyz(cell)["X"]
    mid = s.noise(p, 6.5, 5, 0.62)
    fine = s.noise(p, 42.0, 1, 0.6)
    c = s.ramp(tone, [(0.0, (0.33, 0.25, 0.19)), (0.4, (0.46, 0.355, 0.26)), (0.7, (0.42, 0.355, 0.295)), (1.0, (0.54, 0.41, 0.285))])
    c = s.mix(0.85, c, s.ramp(mid, [(0.30, 0.58), (0.68, 1.08)]), "MULTIPLY")
    c = s.mix(0.7, c, s.ramp(fine, [(0.33, 0.62), (0.68, 1.1)]), "MULTIPLY")
    joint = s.ramp(edge, [(0.012, 0.0), (0.035, 1.0)])
    c = s.mix(joint, (0.165, 0.12, 0.085), c)
    h = s.math("ADD", s.math("MULTIPLY", joint, 0.8), s.math("MULTIPLY", mid, 0.6))
    h = s.math("ADD", h, s.math("MULTIPLY", fine, 0.18))
    return s.finish(c, s.bump(h, 0.022), 0.85, 0.15, "ground")


def stripes(s, v, table):
    """Constant bands along v (0..1): table of (start, colour)."""
    return s.ramp(v, table, "CONSTANT")


def mat_cloth():
    s = Shader("banner cloth")
    uv = s.coord("UV")
    u, v, _ = s.xyz(uv)
    indigo, deep, cream, ochre = (0.035, 0.115, 0.20), (0.022, 0.065, 0.125), (0.60, 0.515, 0.38), (0.55, 0.27, 0.055)
    wob = s.math("MULTIPLY", s.math("SUBTRACT", s.noise(uv, 14, 2), 0.5), 0.008)
    vv = s.math("ADD", v, wob)
    # A field of diamonds, of a lighter indigo, with bands of cream and ochre above and below.
    def tri(x, k):
        return s.math("ABSOLUTE", s.math("SUBTRACT", s.math("FRACT", s.math("MULTIPLY", x, k)), 0.5))
    d = s.math("ADD", tri(s.math("ADD", u, wob), 5.0), tri(vv, 5.0))
    field = s.ramp(d, [(0.0, ochre), (0.10, indigo), (0.26, cream), (0.34, indigo), (0.5, deep), (0.74, indigo), (0.9, cream)], "CONSTANT")
    band = stripes(s, vv, [(0.0, ochre), (0.035, cream), (0.055, deep), (0.10, cream), (0.115, indigo), (0.165, cream), (0.18, indigo),
                           (0.82, cream), (0.835, indigo), (0.885, cream), (0.90, deep), (0.945, cream), (0.965, ochre)])
    inside = s.math("MULTIPLY", s.math("GREATER_THAN", vv, 0.2), s.math("LESS_THAN", vv, 0.8))
    c = s.mix(inside, band, field)
    # Woven threads, uneven dye.
    wx = s.wave(uv, 42, 1.5, 2, 2.0, bands_direction="X")
    wy = s.wave(uv, 42, 1.5, 2, 2.0, bands_direction="Y")
    weave = s.math("ADD", s.math("MULTIPLY", wx, 0.5), s.math("MULTIPLY", wy, 0.5))
    slub = s.noise(s.mapping(uv, (6, 60, 1)), 3.0, 4, 0.6)
    slub2 = s.noise(s.mapping(uv, (60, 6, 1)), 3.0, 4, 0.6)
    dye = s.noise(uv, 7.0, 5, 0.6)
    c = s.mix(0.42, c, s.ramp(weave, [(0.15, 0.45), (0.85, 1.25)]), "MULTIPLY")
    c = s.mix(0.8, c, s.ramp(slub, [(0.3, 0.55), (0.7, 1.25)]), "MULTIPLY")
    c = s.mix(0.7, c, s.ramp(slub2, [(0.3, 0.6), (0.7, 1.2)]), "MULTIPLY")
    c = s.mix(0.55, c, s.ramp(dye, [(0.3, 0.6), (0.7, 1.2)]), "MULTIPLY")
    # Faded by the sun: blacks lifted.
    c = s.mix(0.075, c, (0.55, 0.50, 0.42))
    h = s.math("ADD", weave, s.math("MULTIPLY", slub, 1.2))
    return s.finish(c, s.bump(h, 0.004), 0.95, 0.05, "cloth")


def mat_ball():
    s = Shader("painted ball")
    p = s.coord()
    n = s.node("ShaderNodeTexGradient", {"Vector": p}, gradient_type="RADIAL")
    ang = n.outputs["Fac"]
    wob = s.math("MULTIPLY", s.math("SUBTRACT", s.noise(p, 6, 3), 0.5), 0.018)
    seg = s.math("FRACT", s.math("MULTIPLY", s.math("ADD", ang, wob), 4.0))
    red, cream, teal, ochre = (0.52, 0.095, 0.045), (0.58, 0.49, 0.36), (0.045, 0.22, 0.22), (0.54, 0.29, 0.055)
    c = stripes(s, seg, [(0.0, red), (0.25, cream), (0.5, teal), (0.75, cream)])
    z = s.math("ADD", s.math("ABSOLUTE", s.xyz(p)["Z"]), wob)
    c = s.mix(s.math("GREATER_THAN", z, 0.285), c, ochre)
    c = s.mix(s.math("GREATER_THAN", z, 0.335), c, red)
    # Chipped down to the wood, scuffed, brushed.
    chip = s.ramp(s.noise(p, 9.0, 6, 0.7, 0.4), [(0.605, 0.0), (0.625, 1.0)])
    grain = s.wave(s.mapping(p, (1, 1, 0.35)), 11, 7, 3, 1.6)
    c = s.mix(chip, c, s.ramp(grain, [(0.0, (0.20, 0.105, 0.05)), (1.0, (0.42, 0.25, 0.12))]))
    fine = s.noise(p, 55, 3, 0.65)
    mid = s.noise(p, 14, 4, 0.6)
    c = s.mix(0.7, c, s.ramp(mid, [(0.3, 0.62), (0.7, 1.08)]), "MULTIPLY")
    c = s.mix(0.6, c, s.ramp(fine, [(0.33, 0.6), (0.68, 1.08)]), "MULTIPLY")
    h = s.math("ADD", s.math("MULTIPLY", fine, 0.25), s.math("MULTIPLY", chip, -0.5))
    return s.finish(c, s.bump(h, 0.008), 0.5, 0.15, "ball")


def mat_cape():
    s = Shader("cape")
    uv = s.coord("UV")            # u around (in wales), v down from the neck
    u, v, _ = s.xyz(uv)
    rust, cream, dark, gold = (0.46, 0.105, 0.037), (0.56, 0.46, 0.325), (0.12, 0.045, 0.03), (0.54, 0.27, 0.042)
    zig = s.math("ABSOLUTE", s.math("SUBTRACT", s.math("FRACT", s.math("MULTIPLY", u, 26.0)), 0.5))
    vz = s.math("ADD", v, s.math("MULTIPLY", zig, 0.05))
    c = stripes(s, vz, [(0.0, rust), (0.10, dark), (0.14, rust), (0.36, gold), (0.41, cream), (0.47, dark), (0.50, cream), (0.56, gold),
                        (0.61, rust), (0.76, dark), (0.785, rust), (0.83, cream), (0.875, rust), (0.93, gold), (0.97, dark)])
    yarn = s.wave(s.mapping(uv, (1, 1, 1)), 20, 1.0, 2, 6.0, bands_direction="Y")
    fuzz = s.noise(s.mapping(uv, (150, 45, 1)), 1.0, 4, 0.65)
    dye = s.noise(s.mapping(uv, (14, 5, 1)), 1.2, 4, 0.6)
    c = s.mix(0.75, c, s.ramp(fuzz, [(0.28, 0.5), (0.72, 1.3)]), "MULTIPLY")
    c = s.mix(0.30, c, s.ramp(yarn, [(0.1, 0.5), (0.9, 1.2)]), "MULTIPLY")
    c = s.mix(0.6, c, s.ramp(dye, [(0.3, 0.65), (0.7, 1.15)]), "MULTIPLY")
    c = s.mix(0.03, c, (0.6, 0.5, 0.4))
    h = s.math("ADD", fuzz, s.math("MULTIPLY", yarn, 0.7))
    return s.finish(c, s.bump(h, 0.007), 0.95, 0.05, "cape")


def mat_wood(name, dark, light, scale=1.0, axis=(1, 1, 0.22), specular=0.2, matte=None):
    s = Shader(name)
    p = s.coord()
    q = s.mapping(p, axis, loc=(0.31, 0.17, 0.05))
    grain = s.wave(q, 9 * scale, 6, 3, 1.3)
    fib = s.noise(s.mapping(p, (axis[0] * 60, axis[1] * 60, axis[2] * 30)), scale, 3, 0.6)
    mid = s.noise(p, 7 * scale, 3, 0.6)
    c = s.ramp(grain, [(0.0, dark), (0.55, light), (1.0, tuple(x * 0.86 for x in light))])
    c = s.mix(0.7, c, s.ramp(fib, [(0.3, 0.62), (0.7, 1.12)]), "MULTIPLY")
    c = s.mix(0.5, c, s.ramp(mid, [(0.3, 0.65), (0.7, 1.1)]), "MULTIPLY")
    return s.finish(c, s.bump(s.math("ADD", grain, fib), 0.003), 0.6, specular, matte)


def mat_door():
    s = Shader("door")
    p = s.coord()
    x, _, z = s.xyz(p)
    k = s.math("MULTIPLY", x, 5.2)
    seam = s.math("ABSOLUTE", s.math("SUBTRACT", s.math("FRACT", k), 0.5))
    plank = s.math("FRACT", s.math("MULTIPLY", s.math("SINE", s.math("MULTIPLY", s.math("FLOOR", k), 12.9898)), 43.758))
    off = s.combine(s.math("MULTIPLY", plank, 7.0), 0.0, s.math("MULTIPLY", plank, 3.0))
    q = s.mix(1.0, p, off, "ADD")
    fib = s.noise(s.mapping(q, (34, 1, 2.4)), 1.5, 4, 0.62, 0.3)
    c = s.ramp(plank, [(0.0, (0.045, 0.19, 0.20)), (1.0, (0.085, 0.29, 0.285))])
    c = s.mix(0.8, c, s.ramp(fib, [(0.28, 0.45), (0.72, 1.25)]), "MULTIPLY")
    worn = s.ramp(s.noise(s.mapping(q, (9, 1, 1.6)), 1.6, 6, 0.7), [(0.58, 0.0), (0.64, 1.0)])
    c = s.mix(s.math("MULTIPLY", worn, 0.8), c, s.ramp(fib, [(0.3, (0.15, 0.085, 0.045)), (0.7, (0.36, 0.25, 0.15))]))
    gap = s.ramp(seam, [(0.455, 1.0), (0.485, 0.0)])
    c = s.mix(gap, (0.012, 0.02, 0.02), c)
    h = s.math("ADD", s.math("MULTIPLY", gap, 1.5), s.math("MULTIPLY", fib, 0.5))
    return s.finish(c, s.bump(h, 0.01), 0.6, 0.2, "door")


def mat_stone():
    s = Shader("stone blocks")
    p = s.coord()
    r = s.node("ShaderNodeNewGeometry").outputs["Random Per Island"]
    mid, fine = s.noise(p, 8, 5, 0.65), s.noise(p, 45, 3, 0.65)
    c = s.ramp(r, [(0.0, (0.40, 0.32, 0.235)), (0.5, (0.52, 0.42, 0.31)), (1.0, (0.47, 0.40, 0.325))])
    c = s.mix(0.8, c, s.ramp(mid, [(0.3, 0.6), (0.7, 1.1)]), "MULTIPLY")
    c = s.mix(0.7, c, s.ramp(fine, [(0.33, 0.6), (0.68, 1.1)]), "MULTIPLY")
    return s.finish(c, s.bump(s.math("ADD", mid, s.math("MULTIPLY", fine, 0.3)), 0.02), 0.85, 0.1)


def mat_straw():
    s = Shader("straw")
    uv = s.coord("UV")
    ring = s.wave(uv, 9, 0.8, 2, 3.0, bands_direction="Y")
    ply = s.noise(s.mapping(uv, (60, 14, 1)), 1.0, 3, 0.6)
    c = s.ramp(ring, [(0.0, (0.28, 0.165, 0.055)), (0.45, (0.52, 0.365, 0.15)), (1.0, (0.58, 0.43, 0.21))])
    c = s.mix(0.8, c, s.ramp(ply, [(0.3, 0.55), (0.7, 1.15)]), "MULTIPLY")
    v = s.xyz(uv)["Y"]
    band = s.math("MULTIPLY", s.math("GREATER_THAN", v, 0.33), s.math("LESS_THAN", v, 0.47))
    c = s.mix(band, c, s.mix(0.8, (0.05, 0.17, 0.18), s.ramp(ply, [(0.3, 0.5), (0.7, 1.3)]), "MULTIPLY"))
    return s.finish(c, s.bump(ring, 0.006), 0.75, 0.1)


def mat_clay():
    s = Shader("terracotta")
    p = s.coord()
    mid, fine = s.noise(p, 7, 5, 0.65), s.noise(p, 50, 3, 0.6)
    ring = s.wave(p, 9, 1.5, 2, 1, bands_direction="Z")
    c = s.ramp(mid, [(0.3, (0.34, 0.12, 0.055)), (0.7, (0.56, 0.24, 0.12))])
    c = s.mix(0.6, c, s.ramp(fine, [(0.33, 0.6), (0.68, 1.15)]), "MULTIPLY")
    c = s.mix(0.35, c, s.ramp(ring, [(0.0, 0.7), (1.0, 1.1)]), "MULTIPLY")
    return s.finish(c, s.bump(ring, 0.006), 0.8, 0.12)


def mat_cactus():
    s = Shader("cactus")
    p = s.coord()
    mid = s.noise(p, 8, 4, 0.6)
    c = s.ramp(mid, [(0.3, (0.05, 0.13, 0.055)), (0.7, (0.14, 0.27, 0.10))])
    spots = s.ramp(s.voronoi(p, 17.0), [(0.12, 1.0), (0.24, 0.0)])
    c = s.mix(spots, c, (0.62, 0.58, 0.40))
    return s.finish(c, s.bump(s.math("ADD", mid, spots), 0.008), 0.6, 0.2)


def mat_plain(name, color, specular=0.3, rough=0.4):
    s = Shader(name)
    n = s.noise(s.coord(), 30, 3, 0.6)
    return s.finish(s.mix(0.7, color, s.ramp(n, [(0.3, 0.6), (0.7, 1.2)]), "MULTIPLY"), None, rough, specular)


# --------------------------------------------------------------------------------------
# Geometry
# --------------------------------------------------------------------------------------
def add_mesh(name, verts, faces, mat, kind=None, uvs=None, smooth=True, parent=None):
    """A mesh object of object id IDS[kind]; uvs holds one (u, v) a vertex."""
    me = bpy.data.meshes.new(name)
    me.from_pydata([tuple(map(float, v)) for v in verts], [], faces)
    if uvs is not None:
        layer = me.uv_layers.new(name="UV")
        idx = np.empty(len(me.loops), np.int32)
        me.loops.foreach_get("vertex_index", idx)
        layer.data.foreach_set("uv", np.asarray(uvs, np.float32)[idx].ravel())
    me.polygons.foreach_set("use_smooth", [smooth] * len(me.polygons))
    me.materials.append(mat)
    me.update()
    ob = bpy.data.objects.new(name, me)
    ob.pass_index = IDS[kind] if kind else 0
    bpy.context.scene.collection.objects.link(ob)
    ob.parent = parent
    return ob


def grid_faces(rows, cols, wrap=False):
    out = []
    for r in range(rows - 1):
        for c in range(cols if wrap else cols - 1):
            d = (c + 1) % cols
            out.append((r * cols + c, r * cols + d, (r + 1) * cols + d, (r + 1) * cols + c))
    return out


def lathe(name, profile, mat, kind, segments=48, scale=(1, 1, 1)):
    """Turn a list of (radius, z) about z.  u runs 0..1 there and back (no seam), v along."""
    verts, uvs = [], []
    n = len(profile)
    for i, (r, z) in enumerate(profile):
        for k in range(segments):
            a = 2 * math.pi * k / segments
            verts.append((r * math.cos(a) * scale[0], r * math.sin(a) * scale[1], z * scale[2]))
            uvs.append((abs(2 * k / segments - 1), i / (n - 1)))
    return add_mesh(name, verts, grid_faces(n, segments, True), mat, kind, uvs)


def sphere(name, radius, mat, kind, scale=(1, 1, 1), rings=32, segments=64):
    prof = [(max(radius * math.sin(math.pi * i / rings), 1e-5), -radius * math.cos(math.pi * i / rings)) for i in range(rings + 1)]
    return lathe(name, prof, mat, kind, segments, scale)


def rod(name, r0, r1, length, mat, kind, segments=28):
    """A tapered stick from the origin down to -z, with rounded ends."""
    e = 0.35
    prof = [(1e-4, r0 * e), (r0 * 0.6, r0 * e * 0.8), (r0, 0), (r1, -length), (r1 * 0.6, -length - r1 * e * 0.8), (1e-4, -length - r1 * e)]
    ob = lathe(name, prof, mat, kind, segments)
    return ob


def box(name, size, mat, kind, bevel=0.0):
    x, y, z = (s / 2 for s in size)
    v = [(-x, -y, -z), (x, -y, -z), (x, y, -z), (-x, y, -z), (-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z)]
    f = [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    ob = add_mesh(name, v, f, mat, kind, smooth=bevel > 0)
    if bevel:
        m = ob.modifiers.new("bevel", "BEVEL")
        m.width, m.segments = bevel, 4
    return ob


def bake_rigid(ob, matrix_at):
    """Key location and rotation once a frame, linear in between."""
    ob.rotation_mode = "QUATERNION"
    last = None
    for f in BAKE:
        loc, rot, _ = matrix_at(f).decompose()
        if last is not None:
            rot.make_compatible(last)
        last = rot.copy()
        ob.location, ob.rotation_quaternion = loc, rot
        ob.keyframe_insert("location", frame=f)
        ob.keyframe_insert("rotation_quaternion", frame=f)
    for fc in ob.animation_data.action.fcurves:
        for k in fc.keyframe_points:
            k.interpolation = "LINEAR"


def bake_shape(ob, verts_at):
    """One absolute shape key a frame; eval_time walks through them."""
    for f in BAKE:
        kb = ob.shape_key_add(name="f%d" % f, from_mix=False)
        kb.data.foreach_set("co", np.asarray(verts_at(f), np.float32).ravel())
        kb.interpolation = "KEY_LINEAR"
    keys = ob.data.shape_keys
    keys.use_relative = False
    for f, kb in zip(BAKE, keys.key_blocks):
        keys.eval_time = kb.frame
        keys.keyframe_insert("eval_time", frame=f)
    for fc in keys.animation_data.action.fcurves:
        for k in fc.keyframe_points:
            k.interpolation = "LINEAR"


# --------------------------------------------------------------------------------------
# The hanging cloth: a small position-based simulation on a grid
# --------------------------------------------------------------------------------------
CLOTH_W, CLOTH_H = 2.06, 2.06
CLOTH_AT = Vector((1.40, -0.62, 2.38))       # middle of the upper hem


def simulate_cloth(cols=53, rows=54, substeps=14, settle=90):
    """World positions of the cloth's vertices, {frame: (rows*cols, 3)}.

    Distance constraints along threads, across (shear) and over two cells (bending),
    solved in independent colours so that each is one numpy slice operation."""
    u = np.linspace(0, 1, cols)
    v = np.linspace(0, 1, rows)
    dx, dz = CLOTH_W / (cols - 1), CLOTH_H / (rows - 1)
    P = np.zeros((rows, cols, 3))
    # Upper hem: drawn together a little between rings, so that it falls in folds.
    hem = 0.90
    folds = 5
    P[..., 0] = (u - 0.5) * CLOTH_W * hem
    P[..., 1] = (0.045 * np.sin(2 * np.pi * folds * u))[None, :] * (1 - 0.3 * v[:, None])
    P[..., 2] = -v[:, None] * CLOTH_H
    P += np.array(CLOTH_AT)
    top = P[0].copy()
    V = np.zeros_like(P)
    w = np.ones((rows, cols, 1))
    w[0] = 0.0

    def links():
        for (di, dj, rest, k) in ((0, 1, dx, 1.0), (1, 0, dz, 1.0), (1, 1, math.hypot(dx, dz), 0.35),
                                  (1, -1, math.hypot(dx, dz), 0.35), (0, 2, 2 * dx, 0.10), (2, 0, 2 * dz, 0.10),
                                  (0, 6, 6 * dx, 0.015), (6, 0, 6 * dz, 0.015)):
            # Colours: rows by i modulo 2*di (or all), columns likewise.
            for ci in range(2 * di if di else 1):
                for cj in range(2 * abs(dj) if (dj and not di) else 1):
                    si = 2 * di if di else 1
                    sj = 2 * abs(dj) if (dj and not di) else 1
                    yield di, dj, rest, k, ci, si, cj, sj

    plan = []
    I, J = np.meshgrid(np.arange(rows), np.arange(cols), indexing="ij")
    for di, dj, rest, k, ci, si, cj, sj in links():
        sel = (I % si == ci) if di == 1 or (di == 0) else ((I % si) // di == 0 if ci == 0 else (I % si) // di == 1)
        if di > 1 and ci > 1:
            continue
        if di == 0:
            if dj > 1:
                if cj > 1:
                    continue
                sel = (J % sj) // dj == cj
            else:
                sel = J % sj == cj
        a = sel & (I + di < rows) & (J + dj < cols) & (J + dj >= 0)
        ia = (I * cols + J)[a]
        ib = ((I + di) * cols + J + dj)[a]
        plan.append((ia, ib, rest, k))

    wf = w.reshape(-1, 1)
    dt = 1.0 / FPS / substeps
    gravity = np.array([0, 0, -9.8])
    out = {}
    X = P.reshape(-1, 3)
    Vf = V.reshape(-1, 3)
    for f in range(BAKE[0] - settle, BAKE[-1] + 1):
        for sub in range(substeps):
            t = (f - FIRST) / FPS + sub * dt
            G = X.reshape(rows, cols, 3)
            # Wind: a steady breath along the wall with gusts travelling through the cloth.
            gu, gv = u[None, :], v[:, None]
            gust = (1.75 * np.sin(2 * np.pi * (0.62 * t - 0.75 * gu - 0.45 * gv))
                    + 1.05 * np.sin(2 * np.pi * (1.07 * t - 1.6 * gu + 0.5 * gv) + 1.3)
                    + 0.5 * np.sin(2 * np.pi * (0.41 * t - 0.3 * gu - 1.2 * gv) + 4.0))
            wind = np.zeros((rows, cols, 3))
            wind[..., 0] = 0.55 + 0.5 * np.sin(2 * np.pi * 0.45 * t + 0.6)
            wind[..., 1] = gust - 0.25
            wind[..., 2] = 0.45
            n = np.cross(np.gradient(G, axis=1), np.gradient(G, axis=0))
            n /= np.linalg.norm(n, axis=-1, keepdims=True) + 1e-9
            rel = wind - Vf.reshape(rows, cols, 3)
            drag = 3.3 * np.sum(rel * n, -1, keepdims=True) * n + 0.35 * rel
            Vf = Vf + dt * (gravity + drag.reshape(-1, 3)) * wf
            prev = X
            X = X + dt * Vf
            X.reshape(rows, cols, 3)[0] = top
            for _ in range(2):
                for ia, ib, rest, k in plan:
                    d = X[ib] - X[ia]
                    length = np.sqrt(np.einsum("ij,ij->i", d, d))[:, None]
                    wa, wb = wf[ia], wf[ib]
                    c = k * (length - rest) / (length * np.maximum(wa + wb, 1e-9)) * d
                    X[ia] += wa * c
                    X[ib] -= wb * c
            X[:, 1] = np.minimum(X[:, 1], -0.05)          # the wall
            Vf = (X - prev) / dt * wf
        if f >= BAKE[0]:
            out[f] = X.copy()
    return out, rows, cols


# --------------------------------------------------------------------------------------
# The figure
# --------------------------------------------------------------------------------------
HEADING = Vector((-1.0, -0.16, 0.0)).normalized()
WALK_FROM, WALK_LENGTH = Vector((0.60, -1.28, 0.0)), 1.42
CYCLE = 24.0                                   # frames for two steps
SPEED = WALK_LENGTH / (LAST - FIRST)           # metres a frame
HIP, THIGH, SHIN, ANKLE = 0.62, 0.335, 0.335, 0.075


def yaw_matrix(extra=0.0):
    return Matrix.Rotation(math.atan2(HEADING.y, HEADING.x) + extra, 4, "Z")


def walk_root(f):
    """Ground point under the pelvis; the body's x axis is the heading, y its left."""
    c = 2 * math.pi * (f - FIRST) / CYCLE
    p = WALK_FROM + HEADING * (SPEED * (f - FIRST))
    return p, c


def body_matrix(f):
    p, c = walk_root(f)
    bob = 0.016 * math.cos(2 * c + 0.6)
    sway = 0.018 * math.sin(c)
    m = Matrix.Translation(p + Vector((0, 0, bob))) @ yaw_matrix()
    m = m @ Matrix.Translation((0, sway, 0)) @ Matrix.Rotation(0.045 * math.sin(c), 4, "X")
    return m @ Matrix.Rotation(0.035 + 0.012 * math.sin(2 * c), 4, "Y")


def foot_local(f, side):
    """(forward, lift, pitch) of the ankle in the walking frame; flat and locked in stance."""
    s = ((f - FIRST) / CYCLE + (0.5 if side > 0 else 0.0) + 0.12) % 1.0
    half = SPEED * CYCLE / 4
    if s < 0.5:                                # stance: the ground carries it back
        return half - SPEED * CYCLE * s, 0.0, 0.0
    q = (s - 0.5) * 2                          # swing
    ease = 0.55 * q + 0.45 * (0.5 - 0.5 * math.cos(math.pi * q))
    return -half + 2 * half * ease, 0.085 * math.sin(math.pi * q), 0.45 * math.sin(2 * math.pi * q) * (1 - 0.3 * q)


def leg(f, side):
    """World points hip, knee, ankle, and the boot's pitch."""
    p, _ = walk_root(f)
    fwd, lift, pitch = foot_local(f, side)
    hip = body_matrix(f) @ Vector((0, side * 0.105, HIP))
    lat = yaw_matrix() @ Vector((0, side * 0.105, 0))
    ankle = p + lat + HEADING * fwd + Vector((0, 0, ANKLE + lift))
    d = ankle - hip
    dist = min(d.length, THIGH + SHIN - 1e-3)
    along = (THIGH ** 2 - SHIN ** 2 + dist ** 2) / (2 * dist)
    out = math.sqrt(max(THIGH ** 2 - along ** 2, 0))
    axis = d.normalized()
    bend = (HEADING - axis * HEADING.dot(axis)).normalized()
    return hip, hip + axis * along + bend * out, ankle, pitch


def aim(a, b):
    """A frame at a whose -z points to b."""
    q = (b - a).to_track_quat("-Z", "Y")
    return Matrix.Translation(a) @ q.to_matrix().to_4x4()


CAPE_ROWS, CAPE_COLS = 44, 128


def cape_shape(f):
    """The cape around the walking body, in world space: a bell with folds that lags,
    swings with the steps and is pushed out by the thighs."""
    _, c = walk_root(f)
    s = np.linspace(0, 1, CAPE_ROWS)[:, None]
    th = np.linspace(0, 2 * np.pi, CAPE_COLS, endpoint=False)[None, :]
    sh = np.clip(s / 0.34, 0, 1)
    r = np.where(s < 0.34, 0.085 + 0.185 * np.sin(sh * np.pi / 2) ** 1.15, 0)
    z = np.where(s < 0.34, 1.135 - 0.15 * (1 - np.cos(sh * np.pi / 2)) ** 1.0, 0)
    t = np.clip((s - 0.34) / 0.66, 0, 1)
    side = np.abs(np.sin(th))                   # shorter over the arms
    hem = 0.50 + 0.07 * side ** 2
    r = np.where(s < 0.34, r, 0.27 + 0.135 * t ** 1.1)
    z = np.where(s < 0.34, z, 0.985 + (hem - 0.985) * t)
    w = np.clip((s - 0.12) / 0.88, 0, 1) ** 1.3
    fold = (np.cos(7 * th + 0.9 * np.sin(th + 0.5) + 0.45 * np.sin(c - 1.6 * s))
            + 0.55 * np.cos(11 * th + 1.7 + 0.5 * np.sin(c + 2.0 - 2.2 * s)))
    r = r * (1 + 0.085 * w * fold)
    # thighs push the front and back out in turn
    push = 0.055 * np.sin(c + 0.75) * np.cos(th) * np.sin(th) * 2
    r = r + w * t * (push + 0.022 * np.cos(2 * c) * np.cos(th))
    x, y = r * np.cos(th) * 0.94, r * np.sin(th) * 1.06
    # drag: the hem trails behind and swings, a wave running downward
    x = x - 0.055 * w ** 1.6 + 0.026 * w ** 1.5 * np.sin(2 * c - 2.4 * s + 0.5)
    y = y + 0.040 * w ** 1.5 * np.sin(c - 2.0 * s + 2.2)
    z = z + 0.020 * w * np.sin(2 * c - 2.0 * s + th) + np.zeros_like(th)
    local = np.stack([x, y, z], -1).reshape(-1, 3)
    m = np.array(body_matrix(f))
    return local @ m[:3, :3].T + m[:3, 3]


def build_figure():
    wood = mat_wood("figure wood", (0.30, 0.15, 0.065), (0.60, 0.38, 0.20), 1.4)
    dark = mat_plain("ink", (0.02, 0.014, 0.012), 0.5, 0.25)
    blush = mat_plain("blush", (0.55, 0.16, 0.08))
    boots = mat_wood("boots", (0.055, 0.11, 0.115), (0.11, 0.20, 0.20), 2.0)

    verts = cape_shape(BAKE[0])
    uvs = [(abs(2 * k / CAPE_COLS - 1), i / (CAPE_ROWS - 1)) for i in range(CAPE_ROWS) for k in range(CAPE_COLS)]
    cape = add_mesh("cape", verts, grid_faces(CAPE_ROWS, CAPE_COLS, True), mat_cape(), "cape", uvs)
    bake_shape(cape, cape_shape)
    cape.modifiers.new("cloth thickness", "SOLIDIFY").thickness = 0.012

    def head_matrix(f):
        _, c = walk_root(f)
        look = 0.86 + 0.26 * phase(f) + 0.10 * math.sin(5.0 * phase(f) + 0.5)      # towards the camera
        return (body_matrix(f) @ Matrix.Translation((0.02, 0, 1.30))
                @ Matrix.Rotation(look, 4, "Z") @ Matrix.Rotation(0.05 * math.sin(c + 0.8), 4, "X")
                @ Matrix.Rotation(0.04 * math.cos(2 * c), 4, "Y"))

    def part(ob, base, local=Matrix.Identity(4)):
        bake_rigid(ob, lambda f: base(f) @ local)

    R = 0.195
    part(sphere("head", R, wood, "figure", (1, 1, 1.06)), head_matrix)
    part(rod("neck", 0.07, 0.08, 0.25, wood, "figure"), body_matrix, Matrix.Translation((0, 0, 1.22)))
    for side in (-1, 1):
        def on_face(az, el, lift=0.0):
            d = Vector((math.cos(el) * math.cos(az), math.cos(el) * math.sin(az), math.sin(el)))
            return Matrix.Translation((d.x * (R + lift), d.y * (R + lift), d.z * (R + lift) * 1.06))
        part(sphere("eye", 0.027, dark, "figure", (1, 1, 1.35), 16, 24), head_matrix, on_face(side * 0.36, -0.02, -0.008))
        part(sphere("cheek", 0.036, blush, "figure", (1, 1, 0.8), 16, 24), head_matrix, on_face(side * 0.62, -0.36, -0.024))
    part(sphere("nose", 0.038, wood, "figure", (1, 1, 1), 16, 24), head_matrix, Matrix.Translation((R + 0.018, 0, -0.055)))

    hat = lathe("hat", [(0.36, -0.012), (0.362, 0.0), (0.35, 0.006), (0.30, 0.012), (0.245, 0.022), (0.205, 0.034), (0.196, 0.05), (0.192, 0.085),
                        (0.188, 0.12), (0.178, 0.15), (0.15, 0.172), (0.10, 0.184), (0.05, 0.186), (0.0001, 0.184)], mat_straw(), "hat", 72)
    m = hat.modifiers.new("smooth", "SUBSURF")
    m.levels = m.render_levels = 1
    part(hat, head_matrix, Matrix.Translation((-0.012, 0, 0.105)) @ Matrix.Rotation(-0.10, 4, "Y"))

    for side in (-1, 1):
        part(rod("thigh", 0.085, 0.07, THIGH, wood, "figure"), lambda f, s=side: aim(*leg(f, s)[:2]))
        part(rod("shin", 0.064, 0.05, SHIN, wood, "figure"), lambda f, s=side: aim(*leg(f, s)[1:3]))
        part(sphere("knee", 0.074, wood, "figure", (1, 1, 1), 16, 28), lambda f, s=side: Matrix.Translation(leg(f, s)[1]) @ yaw_matrix())
        boot = box("boot", (0.25, 0.125, 0.115), boots, "figure", 0.05)
        part(boot, lambda f, s=side: (Matrix.Translation(leg(f, s)[2]) @ yaw_matrix() @ Matrix.Rotation(leg(f, s)[3], 4, "Y")
                                      @ Matrix.Translation((0.055, 0, -0.0175))))


# --------------------------------------------------------------------------------------
# Scene
# --------------------------------------------------------------------------------------
FILL_STRENGTH = 0.50
SUN_TO = Vector((-0.80, -0.80, 0.60)).normalized()      # direction towards the sun
BALL_R = 0.36
BALL_FROM, BALL_DIR, BALL_TRAVEL = Vector((-0.52, -2.22, BALL_R)), Vector((1.0, -0.12, 0.0)).normalized(), 0.80


def ball_matrix(f):
    d = BALL_TRAVEL * phase(f)
    axis = Vector((0, 0, 1)).cross(BALL_DIR)
    start = Quaternion((1, 0.3, 0.2), 1.05).to_matrix().to_4x4()
    return Matrix.Translation(BALL_FROM + BALL_DIR * d) @ Matrix.Rotation(d / BALL_R, 4, axis) @ start


def build_door():
    cx, half, spring = -2.18, 0.50, 1.50
    n = 28
    arc = [(half * math.cos(a), spring + half * math.sin(a)) for a in np.linspace(0, math.pi, n)]
    outline = [(half, 0.0)] + arc + [(-half, 0.0)]
    verts = [(x, 0.0, z) for x, z in outline]
    door = add_mesh("door", verts, [tuple(range(len(verts)))], mat_door(), "door", smooth=False)
    door.location = (cx, -0.015, 0)
    # Stone blocks around it: jambs and voussoirs, a little apart.
    rnd = random.Random(7)
    V, F = [], []

    def block(corners, depth):
        o = len(V)
        V.extend([(x, 0.0, z) for x, z in corners] + [(x, -depth, z) for x, z in corners])
        F.extend([(o + 7, o + 6, o + 5, o + 4), (o, o + 4, o + 5, o + 1), (o + 1, o + 5, o + 6, o + 2),
                  (o + 2, o + 6, o + 7, o + 3), (o + 3, o + 7, o + 4, o)])
    g = 0.008
    for sx in (-1, 1):
        z = 0.0
        while z < spring - 0.05:
            h = min(rnd.uniform(0.24, 0.34), spring - z)
            if spring - z - h < 0.15:
                h = spring - z
            o = half + rnd.uniform(0.17, 0.24)
            cs = [(sx * half, z + g), (sx * o, z + g), (sx * o, z + h - g), (sx * half, z + h - g)]
            block(cs if sx > 0 else cs[::-1], rnd.uniform(0.09, 0.12))
            z += h
    k = 9
    for i in range(k):
        a0, a1 = math.pi * i / k + 0.012, math.pi * (i + 1) / k - 0.012
        o = half + (0.28 if i == k // 2 else rnd.uniform(0.19, 0.23))
        block([(half * math.cos(a0), spring + half * math.sin(a0)), (o * math.cos(a0), spring + o * math.sin(a0)),
               (o * math.cos(a1), spring + o * math.sin(a1)), (half * math.cos(a1), spring + half * math.sin(a1))], rnd.uniform(0.10, 0.13))
    fr = add_mesh("doorframe", V, F, mat_stone(), "doorframe", smooth=False)
    fr.location = (cx, 0, 0)
    m = fr.modifiers.new("bevel", "BEVEL")
    m.width, m.segments = 0.014, 2
    step = box("step", (1.55, 0.42, 0.10), mat_stone(), "doorframe", 0.02)
    step.location = (cx, -0.21, 0.05)
    iron = mat_plain("iron", (0.035, 0.03, 0.028), 0.4, 0.5)
    knob = sphere("knob", 0.045, iron, "rail", (1, 1, 1), 16, 24)
    knob.location = (cx + 0.36, -0.06, 1.0)


def build_fronds():
    """Palm fronds off screen, between the sun and the wall; seen only as shadows."""
    rnd = random.Random(11)
    mat = mat_plain("frond", (0.05, 0.10, 0.03))
    right = Vector((0, 0, 1)).cross(SUN_TO).normalized()
    up = SUN_TO.cross(right)
    basis = Matrix((right, up, SUN_TO)).transposed().to_4x4()
    # (point of the wall its root shades, direction, length, curl, extra distance, sway phase)
    specs = [((-1.50, 2.92), -0.50, 2.5, -0.45, 5.4, 0.0), ((-1.75, 3.12), -0.92, 2.3, -0.35, 5.7, 1.1), ((-0.95, 3.30), -0.12, 2.9, -0.6, 6.0, 2.3)]
    for n, ((wx, wz), angle, length, curl, dist, ph) in enumerate(specs):
        V, F = [], []

        def tri(a, b, c):
            V.extend([(p[0], p[1], 0.0) for p in (a, b, c)])
            F.append((len(V) - 3, len(V) - 2, len(V) - 1))
        pts, a, p = [], angle, Vector((0, 0))
        steps = 26
        for i in range(steps + 1):
            pts.append((p.copy(), a))
            p += Vector((math.cos(a), math.sin(a))) * length / steps
            a += curl / steps
        for i in range(steps):
            (p0, a0), (p1, _) = pts[i], pts[i + 1]
            q = i / steps
            nrm = Vector((-math.sin(a0), math.cos(a0)))
            wd = 0.024 * (1 - 0.7 * q)
            tri(p0 + nrm * wd, p0 - nrm * wd, p1)
            if i < 3:
                continue
            leaf = 0.62 * math.sin(math.pi * (0.16 + 0.80 * q)) ** 0.8 * rnd.uniform(0.88, 1.08)
            for sd in (-1, 1):
                la = a0 + sd * (1.05 - 0.45 * q + rnd.uniform(-0.07, 0.07))
                dv = Vector((math.cos(la), math.sin(la)))
                pv = Vector((-dv.y, dv.x)) * 0.030
                tip = p0 + dv * leaf + Vector((0, -0.10 * leaf))
                midp = p0 + dv * leaf * 0.45
                tri(p0, midp + pv, midp - pv)
                tri(midp + pv, tip, midp - pv)
        ob = add_mesh("frond%d" % n, V, F, mat, None, smooth=False)
        ob.visible_camera = False
        root = Vector((wx, 0, wz)) + SUN_TO * dist

        def at(f, root=root, ph=ph):
            q = phase(f)
            travel = Vector((1.45 * q, 0, -0.12 * q))
            sway = 0.11 * math.sin(2 * math.pi * 0.95 * q + ph) + 0.03 * math.sin(2 * math.pi * 2.3 * q + 2 * ph)
            return Matrix.Translation(root + travel) @ basis @ Matrix.Rotation(sway, 4, "Z")
        bake_rigid(ob, at)


def build_scene(args):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.render.fps = FIRST, LAST, FPS

    # Wall and ground (large enough for any shadow or bounce to find them).
    wall = add_mesh("wall", [(-6, 0, 0), (6, 0, 0), (6, 0, 4.2), (-6, 0, 4.2)], [(0, 1, 2, 3)], mat_plaster(), "wall")
    add_mesh("ground", [(-8, -9, 0), (8, -9, 0), (8, 0, 0), (-8, 0, 0)], [(0, 1, 2, 3)], mat_flags(), "ground")
    build_door()

    # The hanging cloth, its pole, rings and brackets.
    t0 = time.time()
    shapes, rows, cols = simulate_cloth()
    np.savez_compressed(os.path.join(args.tmp, "cloth.npz"), **{str(k): v for k, v in shapes.items()})
    print("cloth simulated in %.1f s" % (time.time() - t0))
    uvs = [(c / (cols - 1), 1 - r / (rows - 1)) for r in range(rows) for c in range(cols)]
    cloth = add_mesh("cloth", shapes[BAKE[0]], [f[::-1] for f in grid_faces(rows, cols)], mat_cloth(), "cloth", uvs)
    bake_shape(cloth, lambda f: shapes[f])
    m = cloth.modifiers.new("smooth", "SUBSURF")
    m.levels = m.render_levels = 1
    rail_wood = mat_wood("rail", (0.10, 0.05, 0.025), (0.24, 0.13, 0.06), 2.0)
    pole = rod("pole", 0.032, 0.032, 2.34, rail_wood, "rail")
    pole.rotation_euler = (0, math.pi / 2, 0)
    pole.location = (CLOTH_AT.x + 1.17, CLOTH_AT.y, CLOTH_AT.z + 0.05)
    for sx in (-1, 1):
        knob = sphere("finial", 0.058, rail_wood, "rail", (1, 1, 1), 16, 28)
        knob.location = (CLOTH_AT.x + sx * 1.19, CLOTH_AT.y, CLOTH_AT.z + 0.05)
        arm = box("bracket", (0.05, -CLOTH_AT.y, 0.05), rail_wood, "rail", 0.008)
        arm.location = (CLOTH_AT.x + sx * 1.09, CLOTH_AT.y / 2, CLOTH_AT.z + 0.05)
    hem = shapes[BAKE[0]].reshape(rows, cols, 3)[0]
    for k in range(6):
        x, y, z = hem[round(k * (cols - 1) / 5)]
        ring = lathe("loop", [(0.042, -0.045), (0.044, 0.0), (0.042, 0.045)], rail_wood, "rail", 28)
        ring.rotation_euler = (0, math.pi / 2, 0)
        ring.location = (x, CLOTH_AT.y, CLOTH_AT.z + 0.045)

    ball = sphere("ball", BALL_R, mat_ball(), "ball", rings=64, segments=128)
    bake_rigid(ball, ball_matrix)

    clay, green = mat_clay(), mat_cactus()

    def potted(x, y, k, tall):
        pot = lathe("pot", [(0.0001, 0.0), (0.17, 0.0), (0.185, 0.01), (0.245, 0.32), (0.255, 0.335), (0.29, 0.335), (0.30, 0.345), (0.30, 0.42),
                            (0.29, 0.43), (0.26, 0.43), (0.25, 0.41), (0.24, 0.36), (0.0001, 0.36)], clay, "pot", 64)
        pot.location, pot.scale = (x, y, 0), (k, k, k)

        def lobe(px, pz, r, h, tilt=0.0):
            rows, cols = 40, 96
            ii = np.linspace(0, math.pi, rows)[:, None]
            th = np.linspace(0, 2 * math.pi, cols, endpoint=False)[None, :]
            rr = r * np.sin(ii) ** 0.8 * (1 + 0.075 * np.cos(12 * th)) + 1e-5
            v = np.stack([rr * np.cos(th), rr * np.sin(th), (1 - np.cos(ii)) * h / 2 + 0 * th], -1).reshape(-1, 3)
            ob = add_mesh("cactus", v, grid_faces(rows, cols, True), green, "cactus")
            ob.location, ob.scale, ob.rotation_euler = (x + px * k, y, pz * k), (k, k, k), (0, tilt, 0)
        lobe(0, 0.33, 0.19, 0.80 * tall)
        lobe(0.13, 0.62 * tall + 0.06, 0.105, 0.42 * tall, 0.45)
        lobe(-0.12, 0.52 * tall + 0.06, 0.09, 0.33 * tall, -0.55)
    potted(2.93, -0.75, 1.0, 1.15)
    potted(-1.27, -0.34, 0.62, 0.8)

    build_figure()
    build_fronds()

    # Light: the sun twice (see render()), once as key and once as the source of bounces.
    def sun(name):
        light = bpy.data.lights.new(name, "SUN")
        light.energy, light.color, light.angle = 2.85, (1.0, 0.835, 0.62), math.radians(0.32)
        ob = bpy.data.objects.new(name, light)
        ob.rotation_euler = (-SUN_TO).to_track_quat("-Z", "Y").to_euler()
        scene.collection.objects.link(ob)
        return ob
    key, bounce = sun("sun key"), sun("sun bounce")
    bounce.data.use_nodes = True
    tree = bounce.data.node_tree
    path = tree.nodes.new("ShaderNodeLightPath")
    gt = tree.nodes.new("ShaderNodeMath")
    gt.operation = "GREATER_THAN"
    gt.inputs[1].default_value = 0.5
    tree.links.new(path.outputs["Ray Depth"], gt.inputs[0])
    emission = next(n for n in tree.nodes if n.type == "EMISSION")
    tree.links.new(gt.outputs[0], emission.inputs["Strength"])

    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.46, 0.62, 1.0, 1)

    cam = bpy.data.cameras.new("camera")
    cam.lens, cam.sensor_width, cam.shift_y = 40.0, 36.0, -0.052
    camera = bpy.data.objects.new("camera", cam)
    scene.collection.objects.link(camera)
    scene.camera = camera

    def cam_at(f):
        q = phase(f)
        return (Matrix.Translation((0.20 - 0.40 * q, -7.2 + 0.12 * q, 1.25 + 0.02 * q))
                @ Matrix.Rotation(math.radians(90), 4, "X") @ Matrix.Rotation(math.radians(0.5 * q - 0.25), 4, "Y"))
    bake_rigid(camera, cam_at)
    return dict(scene=scene, key=key, bounce=bounce, world=world.node_tree.nodes["Background"])


# --------------------------------------------------------------------------------------
# Rendering
# --------------------------------------------------------------------------------------
def setup_render(scene, args):
    r, c = scene.render, scene.cycles
    r.engine = "CYCLES"
    r.resolution_x, r.resolution_y, r.resolution_percentage = WIDTH, HEIGHT, args.scale
    r.use_motion_blur = False
    r.threads_mode, r.threads = "FIXED", args.threads
    r.use_compositing = r.use_sequencer = False
    r.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    r.image_settings.color_depth, r.image_settings.exr_codec = "32", "NONE"
    r.use_persistent_data = False
    c.device, c.seed = "CPU", 20
    c.use_adaptive_sampling = c.use_denoising = False
    c.sample_clamp_indirect = 4.0
    c.caustics_reflective = c.caustics_refractive = False
    scene.view_settings.view_transform = "Standard"
    layer = scene.view_layers[0]
    for name in ("matte0", "matte1"):
        aov = layer.aovs.add()
        aov.name, aov.type = name, "COLOR"
    return layer


def render(env, layer, frame, kind, args):
    """Render one frame's `key`, `fill` or `data`; gives back {channel: array}."""
    scene, c = env["scene"], env["scene"].cycles
    on = lambda *names: [setattr(layer, "use_pass_" + n, n in names) for n in (
        "diffuse_direct", "diffuse_indirect", "diffuse_color", "normal", "position", "vector", "object_index", "z")]
    if kind == "key":
        on("diffuse_color", "normal", "position")
        c.samples, c.max_bounces, c.filter_width = args.key, 0, 1.5
        env["world"].inputs["Strength"].default_value = 0.0
    elif kind == "fill":
        on("diffuse_direct", "diffuse_indirect")
        c.samples, c.max_bounces, c.filter_width = args.fill, 2, 1.5
        env["world"].inputs["Strength"].default_value = FILL_STRENGTH
    else:
        on("vector", "object_index")
        c.samples, c.max_bounces, c.filter_width = 1, 0, 0.01
        env["world"].inputs["Strength"].default_value = 0.0
    c.diffuse_bounces, c.glossy_bounces, c.transmission_bounces = c.max_bounces, 0, 0
    env["key"].hide_render = kind != "key"
    env["bounce"].hide_render = kind != "fill"
    scene.frame_set(frame)
    path = os.path.join(args.tmp, "%s.%d.exr" % (kind, os.getpid()))
    scene.render.filepath = path
    scene.render.use_file_extension = False
    bpy.ops.render.render(write_still=True)
    data = read_exr(path)
    os.remove(path)
    return data


def read_exr(path):
    """Read an uncompressed scanline OpenEXR file: {'Combined.R': (h, w) float32, ...}."""
    buf = open(path, "rb").read()
    assert buf[:4] == b"\x76\x2f\x31\x01"
    pos, attrs = 8, {}

    def cstr(p):
        e = buf.index(b"\0", p)
        return buf[p:e].decode(), e + 1
    while buf[pos]:
        name, pos = cstr(pos)
        _, pos = cstr(pos)
        size = struct.unpack_from("<i", buf, pos)[0]
        attrs[name] = buf[pos + 4:pos + 4 + size]
        pos += 4 + size
    pos += 1
    assert attrs["compression"] == b"\0"
    x0, y0, x1, y1 = struct.unpack("<4i", attrs["dataWindow"])
    w, h = x1 - x0 + 1, y1 - y0 + 1
    chans, p, raw = [], 0, attrs["channels"]
    while raw[p]:
        e = raw.index(b"\0", p)
        kind = struct.unpack_from("<i", raw, e + 1)[0]
        chans.append((raw[p:e].decode(), {0: "<u4", 1: "<f2", 2: "<f4"}[kind]))
        p = e + 17
    offsets = struct.unpack_from("<%dQ" % h, buf, pos)
    row = np.dtype([("y", "<i4"), ("size", "<i4")] + [("c%d" % i, t, (w,)) for i, (_, t) in enumerate(chans)])
    rows = np.stack([np.frombuffer(buf, row, 1, o)[0] for o in offsets])
    order = np.argsort(rows["y"])
    out = {}
    for i, (name, _) in enumerate(chans):
        out[".".join(name.split(".")[-2:])] = np.ascontiguousarray(rows["c%d" % i][order]).astype(np.float32)
    return out


def stack(data, name, chans="RGB"):
    return np.stack([data["%s.%s" % (name, ch)] for ch in chans], -1)


def smooth_light(light, pos, nrm, ids, levels=5):
    """Edge-avoiding a-trous filter of an irradiance image.

    A neighbour counts as far as it lies in this pixel's tangent plane, faces the same way,
    and belongs to the same object."""
    kernel = (1 / 16, 1 / 4, 3 / 8, 1 / 4, 1 / 16)
    h, w, _ = light.shape
    ids = ids.astype(np.float32)
    nrm = nrm / np.maximum(np.linalg.norm(nrm, axis=-1, keepdims=True), 1e-6)
    cur = light
    for level in range(levels):
        step = 1 << level
        acc = np.zeros_like(cur)
        tot = np.zeros((h, w, 1), np.float32)
        for j in range(-2, 3):
            for i in range(-2, 3):
                dy, dx = j * step, i * step
                a = (slice(max(0, -dy), min(h, h - dy)), slice(max(0, -dx), min(w, w - dx)))
                b = (slice(max(0, dy), min(h, h + dy)), slice(max(0, dx), min(w, w + dx)))
                if a[0].start >= a[0].stop or a[1].start >= a[1].stop:
                    continue
                d = pos[b] - pos[a]
                off = np.abs(np.einsum("ijk,ijk->ij", d, nrm[a]))
                far = np.einsum("ijk,ijk->ij", d, d)
                cosn = np.einsum("ijk,ijk->ij", nrm[a], nrm[b])
                wt = np.exp(-off / 0.03 - far / (2 * 0.16 ** 2) - (1 - cosn) / 0.12)
                wt = (kernel[j + 2] * kernel[i + 2] * wt * (ids[a] == ids[b]))[..., None]
                acc[a] += wt * cur[b]
                tot[a] += wt
        cur = acc / np.maximum(tot, 1e-8)
    return cur


# --------------------------------------------------------------------------------------
# Files
# --------------------------------------------------------------------------------------
def write_png(path, a):
    """Write 8- or 16-bit grey or RGB.  The filter is chosen for the whole image by trial."""
    a = np.ascontiguousarray(a)
    depth = a.dtype.itemsize * 8
    h, w = a.shape[:2]
    ch = a.shape[2] if a.ndim == 3 else 1
    raw = a.astype(">u2" if depth == 16 else "u1").reshape(h, -1).view(np.uint8).reshape(h, -1)
    bpp = ch * depth // 8
    x = raw.astype(np.int16)
    left = np.zeros_like(x)
    left[:, bpp:] = x[:, :-bpp]
    up = np.zeros_like(x)
    up[1:] = x[:-1]
    ul = np.zeros_like(x)
    ul[1:, bpp:] = x[:-1, :-bpp]
    p = left + up - ul
    pa, pb, pc = abs(p - left), abs(p - up), abs(p - ul)
    paeth = np.where((pa <= pb) & (pa <= pc), left, np.where(pb <= pc, up, ul))
    cands = [(x - f) & 255 for f in (0, left, up, (left + up) >> 1, paeth)]
    cands = [c.astype(np.uint8) for c in cands]
    # besides the five pure choices: per row, that of the smallest sum of |residual|
    cost = np.stack([np.abs(c.view(np.int8).astype(np.int32)).sum(1) for c in cands])
    best = cost.argmin(0)
    plans = [np.full(h, k) for k in range(5)] + [best]
    def packed(plan, level, strategy):
        body = np.empty((h, raw.shape[1] + 1), np.uint8)
        body[:, 0] = plan
        for k in range(5):
            body[plan == k, 1:] = cands[k][plan == k]
        z = zlib.compressobj(level, zlib.DEFLATED, 15, 9, strategy)
        return z.compress(body.tobytes()) + z.flush()
    plan = min(plans, key=lambda p: len(packed(p, 3, zlib.Z_DEFAULT_STRATEGY)))
    smallest = min((packed(plan, 9, st) for st in (zlib.Z_DEFAULT_STRATEGY, zlib.Z_FILTERED)), key=len)

    def chunk(tag, data):
        return struct.pack(">I", len(data)) + tag + data + struct.pack(">I", zlib.crc32(tag + data))
    with open(path, "wb") as f:
        f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", w, h, depth, 2 if ch == 3 else 0, 0, 0, 0))
                + chunk(b"IDAT", smallest) + chunk(b"IEND", b""))


def write_jpeg(path, rgb8, quality):
    """Chroma at full resolution (4:4:4), which Blender's own writer cannot do: by Pillow
    (Debian's python3-pil, seen by Debian's Blender), else by ImageMagick."""
    try:
        from PIL import Image
    except ImportError:
        h, w, _ = rgb8.shape
        subprocess.run(["convert", "-size", "%dx%d" % (w, h), "-depth", "8", "rgb:-", "-sampling-factor", "1x1",
                        "-quality", str(quality), path], input=rgb8.tobytes(), check=True)
    else:
        Image.fromarray(rgb8).save(path, quality=quality, subsampling=0, optimize=True)


def srgb(x):
    x = np.clip(x, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def encode_motion(data, steps):
    """KITTI: R = u, G = v, value = pixels * 64 + 32768, u right, v down; B = 1 where valid.

    Blender's Vector pass holds in (z, w) this position minus the next one, in pixels,
    y upwards.  To the next frame, y downwards, that is (-z, +w)."""
    u, v = -data["Vector.Z"], data["Vector.W"]
    valid = data["IndexOB.X"] > 0
    q = 64 // steps
    enc = [np.clip(np.rint(c * steps) * q + 32768, 0, 65535) * valid for c in (u, v)]
    return np.stack(enc + [valid.astype(float)], -1).astype(np.uint16)


def make_frame(env, layer, frame, args):
    t0 = time.time()
    name = "%04d" % frame
    path = lambda *p: os.path.join(args.out, *p)
    data = render(env, layer, frame, "data", args)
    ids = np.rint(data["IndexOB.X"]).astype(np.uint8)
    if "data" in args.stages:
        write_png(path("ids", name + ".png"), ids)
        if frame < LAST:
            write_png(path("motion", name + ".png"), encode_motion(data, args.flow_steps))
    t1 = time.time()
    if "plates" in args.stages:
        key = render(env, layer, frame, "key", args)
        t2 = time.time()
        fill = render(env, layer, frame, "fill", args)
        t3 = time.time()
        light = stack(fill, "DiffDir") + stack(fill, "DiffInd")
        light = smooth_light(light, stack(key, "Position", "XYZ"), stack(key, "Normal", "XYZ"), ids)
        image = stack(key, "Combined") + light * stack(key, "DiffCol")
        out = srgb(image)
        print("  linear max %.3f  p99.9 %.3f  clipped %.4f%%" % (image.max(), np.percentile(image, 99.9), 100 * (image.max(-1) > 1).mean()))
        write_jpeg(path("plates", name + ".jpg"), np.rint(out * 255).astype(np.uint8), args.quality)
        for i, m in enumerate(MATTES):
            cov = key["matte%d.%s" % (i // 3, "RGB"[i % 3])]
            write_png(path("mattes", m, name + ".png"), np.rint(np.clip(cov, 0, 1) * 255).astype(np.uint8))
        print("  key %.1f  fill %.1f  rest %.1f" % (t2 - t1, t3 - t2, time.time() - t3))
    print("frame %d: %.1f s" % (frame, time.time() - t0), flush=True)


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    ap = argparse.ArgumentParser(prog="make_demo.py")
    ap.add_argument("--out", default=here, help="folder to write to (default: this script's)")
    ap.add_argument("--tmp", default="/tmp/weft_demo", help="scratch folder")
    ap.add_argument("--frames", default="%d-%d" % (FIRST, LAST), help="e.g. 1001-1048 or 1001,1024")
    ap.add_argument("--scale", type=int, default=100, help="percent of %dx%d" % (WIDTH, HEIGHT))
    ap.add_argument("--stages", default="data,plates")
    ap.add_argument("--threads", type=int, default=2)
    ap.add_argument("--key", type=int, default=KEY_SAMPLES, help="samples of the key render")
    ap.add_argument("--fill", type=int, default=FILL_SAMPLES, help="samples of the fill render")
    ap.add_argument("--quality", type=int, default=93, help="of the JPEG plates")
    ap.add_argument("--flow-steps", type=int, default=64, choices=(16, 32, 64), help="flow is rounded to 1/this pixel")
    args = ap.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    args.stages = args.stages.split(",")
    os.makedirs(args.tmp, exist_ok=True)
    for d in ["plates", "ids", "motion"] + ["mattes/" + m for m in MATTES]:
        os.makedirs(os.path.join(args.out, d), exist_ok=True)
    frames = []
    for part in args.frames.split(","):
        a, _, b = part.partition("-")
        frames += range(int(a), int(b or a) + 1)
    env = build_scene(args)
    layer = setup_render(env["scene"], args)
    for f in frames:
        make_frame(env, layer, f, args)


try:
    main()
except BaseException as e:          # Blender would otherwise exit with 0
    if not isinstance(e, SystemExit):
        import traceback
        traceback.print_exc()
    sys.stdout.flush()
    os._exit(e.code or 0 if isinstance(e, SystemExit) else 1)
