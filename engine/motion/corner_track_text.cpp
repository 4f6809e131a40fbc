#include "engine/motion/corner_track_text.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <functional>

#include "engine/core/short_number.h"

namespace weft {
namespace {

using Corner = glm::dvec2;

// "curve x1001 12.5 12.75 …": a key for each frame.
std::string nuke_curve(const CornerTrack& track,
                       const std::function<double(const Quad<double>&)>& of) {
    std::string text = fmt::format("{{curve x{}", track.begin()->first);
    for (const auto& [frame, quad] : track)
        text += " " + short_number(of(quad));
    return text + "}";
}

// Nuke and Blender name the corners from the bottom or one by one; these are indices of Quad.
constexpr std::array<std::size_t, 4> kNukeOrder{3, 2, 1, 0};
struct NamedCorner {
    const char* name;
    std::size_t index;
};
constexpr std::array<NamedCorner, 4> kEffectCorners{
    {{"0001", 0}, {"0002", 1}, {"0003", 3}, {"0004", 2}}};
constexpr std::array<NamedCorner, 4> kBlenderCorners{
    {{"Upper Left", 0}, {"Upper Right", 1}, {"Lower Left", 3}, {"Lower Right", 2}}};

}  // namespace

std::string nuke_corner_pin(const CornerTrack& track, const CornerTextContext& context) {
    assert(track.count(context.reference) == 1);
    const double height = context.plate.height;
    std::string text =
        "set cut_paste_input [stack 0]\nversion 12.0 v1\npush $cut_paste_input\nCornerPin2D {\n";
    for (std::size_t k = 0; k < kNukeOrder.size(); ++k) {
        const std::size_t corner = kNukeOrder[k];
        text += fmt::format(
            " to{} {{{} {}}}\n", k + 1,
            nuke_curve(track, [&](const Quad<double>& quad) { return quad[corner].x; }),
            nuke_curve(track, [&](const Quad<double>& quad) { return height - quad[corner].y; }));
    }
    text += " invert false\n";
    const Quad<double>& at = track.at(context.reference);
    for (std::size_t k = 0; k < kNukeOrder.size(); ++k) {
        const Corner from = at[kNukeOrder[k]];
        text += fmt::format(" from{} {{{} {}}}\n", k + 1, short_number(from.x),
                            short_number(height - from.y));
    }
    return text + fmt::format(" name {}\n label \"reference frame {}\"\n selected true\n}}\n",
                              context.name, context.reference);
}

std::string after_effects_corner_pin(const CornerTrack& track, const CornerTextContext& context) {
    std::string text = fmt::format(
        "Adobe After Effects 8.0 Keyframe Data\r\n\r\n\tUnits Per Second\t{}\r\n"
        "\tSource Width\t{}\r\n\tSource Height\t{}\r\n\tSource Pixel Aspect Ratio\t{}\r\n"
        "\tComp Pixel Aspect Ratio\t{}\r\n\r\n",
        short_number(context.fps), context.plate.width, context.plate.height,
        short_number(context.pixel_aspect), short_number(context.pixel_aspect));
    for (const NamedCorner& corner : kEffectCorners) {
        text += fmt::format(
            "Effects\tADBE Corner Pin #1\tADBE Corner Pin-{}\r\n\tFrame\tX pixels\tY pixels\t\r\n",
            corner.name);
        for (const auto& [frame, quad] : track) {
            const Corner at = quad[corner.index];
            text += fmt::format("\t{}\t{}\t{}\t\r\n", frame - context.first_frame,
                                short_number(at.x), short_number(at.y));
        }
        text += "\r\n";
    }
    return text + "End of Keyframe Data\r\n";
}

std::string blender_corner_pin(const CornerTrack& track, const CornerTextContext& context) {
    constexpr int kDecimals = 7;
    std::string text = fmt::format(
        "# Corner pin {0}, {1}x{2}: run it in Blender's text editor.\n"
        "import bpy\n\n"
        "CORNERS = {{  # by frame: upper left, upper right, lower left, lower right, 0 to 1\n",
        context.name, context.plate.width, context.plate.height);
    for (const auto& [frame, quad] : track) {
        text += fmt::format("    {}: (", frame);
        for (const NamedCorner& corner : kBlenderCorners) {
            const Corner at = quad[corner.index];
            text += fmt::format("({}, {}), ", short_number(at.x / context.plate.width, kDecimals),
                                short_number(1 - at.y / context.plate.height, kDecimals));
        }
        text += "),\n";
    }
    return text + fmt::format(
                      "}}\n\n"
                      "scene = bpy.context.scene\n"
                      "scene.use_nodes = True\n"
                      "node = scene.node_tree.nodes.new('CompositorNodeCornerPin')\n"
                      "node.name = node.label = '{}'\n"
                      "for frame, corners in CORNERS.items():\n"
                      "    for name, (x, y) in zip(('Upper Left', 'Upper Right', 'Lower Left', "
                      "'Lower Right'), corners):\n"
                      "        node.inputs[name].default_value = (x, y, 0)\n"
                      "        node.inputs[name].keyframe_insert('default_value', frame=frame)\n",
                      context.name);
}

}  // namespace weft
