#include <fmt/format.h>

#include <cassert>

#include "app/composites/composite.h"
#include "engine/core/short_number.h"

namespace weft {
namespace {

std::string python_string(std::string_view text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') out += '\\';
        out += c;
    }
    return out + "'";
}

// What the script does with the values above it. Blender 5 has the tree in the scene's
// `compositing_node_group`, and its nodes are those of shaders where there is one for both.
constexpr const char* kScript = R"(

def folder():
    """Of this file: run by --python, or opened in the text editor."""
    space = getattr(bpy.context, 'space_data', None)
    text = getattr(space, 'text', None)
    name = (text.filepath if text else '') or globals().get('__file__', '') or bpy.data.filepath
    return os.path.dirname(bpy.path.abspath(name))


def tree_of(scene):
    if hasattr(scene, 'compositing_node_group'):
        if scene.compositing_node_group is None:
            scene.compositing_node_group = bpy.data.node_groups.new('Weft', 'CompositorNodeTree')
        return scene.compositing_node_group
    scene.use_nodes = True
    return scene.node_tree


scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = SIZE
scene.render.resolution_percentage = 100
scene.render.pixel_aspect_x = PIXEL_ASPECT
scene.render.fps, scene.render.fps_base = round(FPS), round(FPS) / FPS
scene.frame_start, scene.frame_end = FRAMES
tree = tree_of(scene)
across, down = 0, 0


def node(name, *kinds, label=''):
    """The first of the kinds that this Blender has."""
    global across
    for kind in kinds:
        try:
            new = tree.nodes.new(kind)
        except RuntimeError:
            continue
        new.name, new.label = name, label or name
        new.location = across, down
        across += 200
        return new
    raise RuntimeError('This Blender has none of the nodes ' + ', '.join(kinds) + '.')


def setting(of, name, socket, value):
    """A property of a node; newer versions have a socket instead."""
    if hasattr(of, name):
        setattr(of, name, value)
    else:
        of.inputs[socket].default_value = value


def picture(name, path, numbered, space):
    global across, down
    across, down = 0, down - 330
    image = bpy.data.images.load(os.path.join(folder(), *path.split('/')), check_existing=False)
    image.name = name
    of = node(name, 'CompositorNodeImage')
    if numbered:
        image.source = 'SEQUENCE'
    of.image = image
    if numbered:
        of.frame_start, of.frame_offset = FRAMES[0], FRAMES[0] - 1
        of.frame_duration = FRAMES[1] - FRAMES[0] + 1
        of.use_auto_refresh = True
    for known in space:
        try:
            image.colorspace_settings.name = known
        except TypeError:
            continue
        break
    image.alpha_mode = 'CHANNEL_PACKED'
    return of


def joined(name, a, b, operation, label=''):
    """Channel by channel: MULTIPLY or ADD."""
    try:
        of = node(name, 'CompositorNodeMixRGB', label=label)
        of.inputs[0].default_value = 1
        ends = of.inputs[1], of.inputs[2], of.outputs[0]
    except RuntimeError:
        of = node(name, 'ShaderNodeMix', label=label)
        of.data_type = 'RGBA'
        of.inputs[0].default_value = 1
        ends = of.inputs[6], of.inputs[7], of.outputs[2]
    of.blend_type = operation
    tree.links.new(a, ends[0])
    tree.links.new(b, ends[1])
    return ends[2]


def through_st(plane, layers, path):
    """A plane through the ST-map; blue is made 1, since Map UV multiplies by it."""
    apart = node('Weft_st_%d' % plane, 'CompositorNodeSeparateColor')
    again = node('Weft_st_white_%d' % plane, 'CompositorNodeCombineColor')
    again.inputs[2].default_value = 1
    tree.links.new(layers.outputs['st'], apart.inputs[0])
    tree.links.new(apart.outputs[0], again.inputs[0])
    tree.links.new(apart.outputs[1], again.inputs[1])
    source = picture('Weft_plane_%d' % plane, path, False, LINEAR)
    of = node('Weft_st_map_%d' % plane, 'CompositorNodeMapUV')
    if hasattr(of, 'alpha'):
        of.alpha = 0
    tree.links.new(source.outputs[0], of.inputs[0])
    tree.links.new(again.outputs[0], of.inputs[1])
    return of.outputs[0]


def where(plane, shown, layers):
    """The colours where the region of this number is on top."""
    is_it = node('Weft_is_%d' % plane, 'CompositorNodeMath', 'ShaderNodeMath')
    is_it.operation = 'COMPARE'
    is_it.inputs[1].default_value, is_it.inputs[2].default_value = plane, 0.5
    tree.links.new(layers.outputs['id'], is_it.inputs[0])
    return joined('Weft_region_%d' % plane, shown, is_it.outputs[0], 'MULTIPLY')


plate = picture('Weft_plate', *PLATE)
shown = PLATE_LAYER.rpartition('.')  # a layer of Blender's, and its pass
if shown[0]:
    plate.layer = shown[0]
plate = plate.outputs[shown[2] or 0]
layers = picture('Weft_layers', *LAYERS)
through = None
for plane, path in PLANES:
    shown = through_st(plane, layers, path)
    if not ONE_REGION:
        shown = where(plane, shown, layers)
    through = shown if through is None else joined('Weft_regions_%d' % plane, through, shown, 'ADD')
texture = layers.outputs['texture']
if through is not None:
    switch = node('Weft_texture', 'CompositorNodeSwitch',
                  label='Texture: off as rendered, on the plane through the ST-map')
    setting(switch, 'check', 'Switch', False)
    ends = [end for end in switch.inputs if end.type == 'RGBA']
    tree.links.new(texture, ends[0])
    tree.links.new(through, ends[1])
    texture = switch.outputs[0]
across, down = 0, down - 330
texture = joined('Weft_light', texture, layers.outputs['light'], 'MULTIPLY')
texture = joined('Weft_gloss', texture, layers.outputs['gloss'], 'ADD')
texture = joined('Weft_finish', texture, layers.outputs['finish'], 'ADD', label='Grain, ink, blending')
holdout = node('Weft_holdout', 'CompositorNodeSetAlpha', label='Coverage, holdouts taken off')
setting(holdout, 'mode', 'Type', 'APPLY')
tree.links.new(texture, holdout.inputs[0])
tree.links.new(layers.outputs['matte'], holdout.inputs[1])
over = node('Weft_over', 'CompositorNodeAlphaOver', label='Over the plate')
beneath, above = [end for end in over.inputs if end.type == 'RGBA'][:2]
tree.links.new(plate, beneath)
tree.links.new(holdout.outputs[0], above)
result = joined('Weft_edge', over.outputs[0], layers.outputs['edge'], 'ADD',
                label='What soft edges take away of the old surface')
for old in [old for old in tree.nodes if old.bl_idname == 'CompositorNodeComposite']:
    tree.nodes.remove(old)
try:
    tree.links.new(result, node('Weft_result', 'CompositorNodeComposite').inputs[0])
except RuntimeError:
    if not any(end.item_type == 'SOCKET' and end.in_out == 'OUTPUT' for end in tree.interface.items_tree):
        tree.interface.new_socket('Image', in_out='OUTPUT', socket_type='NodeSocketColor')
    tree.links.new(result, node('Weft_result', 'NodeGroupOutput').inputs[0])
)";

std::string pictures_text(const CompositePictures& of, const char* space) {
    return fmt::format("({}, {}, {})", python_string(of.first), of.numbered ? "True" : "False",
                       space);
}

}  // namespace

std::string blender_composite(const Composite& of) {
    assert(of.curve != PlateCurve::kCineon);
    std::string text = fmt::format(
        "# {} in Blender's compositor: run it in\n# the text editor, or with blender --python. "
        "Nodes that are there stay.\n"
        "import os\n\nimport bpy\n\n"
        "LINEAR = ('Linear', 'Linear Rec.709')  # a name for each version of Blender\n"
        "SIZE, PIXEL_ASPECT, FPS = ({}, {}), {}, {}\nFRAMES = ({}, {})\n",
        kCompositeMark, of.size.width, of.size.height, short_number(of.pixel_aspect, 6),
        short_number(of.fps, 6), of.first, of.last);
    text +=
        fmt::format("PLATE = {}\nPLATE_LAYER = {}\nLAYERS = {}\n",
                    pictures_text(of.plate, of.curve == PlateCurve::kSrgb ? "('sRGB',)" : "LINEAR"),
                    python_string(of.plate_layer), pictures_text(of.layers, "LINEAR"));
    text +=
        "# The number of a region, and its texture plane, graded and in linear light.\nPLANES = [";
    for (const CompositePlane& plane : of.planes)
        text += fmt::format("({}, {}), ", plane.id, python_string(plane.path));
    if (!of.planes.empty()) text.resize(text.size() - 2);
    return text + fmt::format("]\nONE_REGION = {}\n", of.one_region ? "True" : "False") + kScript;
}

}  // namespace weft
