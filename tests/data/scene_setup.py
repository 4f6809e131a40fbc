# What the scenes rendered for measuring share: run by Blender, which has bpy.
import bpy


def sharp_scene(frames, width, height, samples):
    """An empty scene whose renders repeat byte by byte: one bounce, no denoising, a fixed seed."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.max_bounces = 0
    scene.cycles.seed = 7
    scene.render.threads_mode = "FIXED"
    scene.render.threads = 2
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Standard"
    scene.frame_start, scene.frame_end = 1, frames
    return scene


def picture_into(material, shader, path, scale=1.0):
    """Puts a picture, repeated `scale` times over the UVs, into a shader's colour; returns its node."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    image = nodes.new("ShaderNodeTexImage")
    image.image = bpy.data.images.load(path, check_existing=True)
    coords = nodes.new("ShaderNodeTexCoord")
    mapping = nodes.new("ShaderNodeMapping")
    mapping.inputs["Scale"].default_value = (scale, scale, scale)
    links.new(coords.outputs["UV"], mapping.inputs[0])
    links.new(mapping.outputs[0], image.inputs[0])
    links.new(image.outputs[0], shader.inputs[0])
    return image
