#include "engine/mask/shape_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "engine/core/short_number.h"

namespace weft {
namespace {

using PointNumbers = std::function<std::vector<double>(const RotoPoint&)>;

// A literal that Python and JSON read alike: by shape its name, level and frames, and by frame and
// point the numbers of the point.
std::string shape_list(const std::vector<MatteShape>& shapes, int decimals,
                       const PointNumbers& numbers) {
    std::string text = "[\n";
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        text += fmt::format(" {{\"name\": \"{}\", \"level\": {}, \"frames\": [",
                            shape_name(shapes, k), shapes[k].level);
        std::string points;
        for (const auto& [frame, shape] : shapes[k].keys) {
            const bool first = points.empty();
            text += fmt::format("{}{}", first ? "" : ", ", frame);
            points += first ? "  [" : ",\n  [";
            for (const RotoPoint& point : shape.points) {
                points += &point == &shape.points.front() ? "[" : ", [";
                bool more = false;
                for (const double number : numbers(point)) {
                    points += (more ? ", " : "") + short_number(number, decimals);
                    more = true;
                }
                points += "]";
            }
            points += "]";
        }
        text +=
            fmt::format("], \"points\": [\n{}]}}{}\n", points, k + 1 < shapes.size() ? "," : "");
    }
    return text + "]\n";
}

constexpr const char* kNukeScript = R"(
import nuke.rotopaint as rp

nodes = {}
for entry in SHAPES:
    level = entry['level']
    if level not in nodes:
        nodes[level] = nuke.nodes.Roto(name='NAME_%d' % level, output='alpha')
    curves = nodes[level]['curves']
    shape = rp.Shape(curves)
    shape.name = entry['name']
    for x, y, in_x, in_y, out_x, out_y in entry['points'][0]:
        shape.append(rp.ShapeControlPoint(x, y))
    for frame, points in zip(entry['frames'], entry['points']):
        for point, (x, y, in_x, in_y, out_x, out_y) in zip(shape, points):
            point.center.addPositionKey(frame, (x, y))
            point.leftTangent.addPositionKey(frame, (in_x, in_y))
            point.rightTangent.addPositionKey(frame, (out_x, out_y))
            point.featherCenter.addPositionKey(frame, (0, 0))
            point.featherLeftTangent.addPositionKey(frame, (in_x, in_y))
            point.featherRightTangent.addPositionKey(frame, (out_x, out_y))
    first, last = entry['frames'][0], entry['frames'][-1]
    shape.setVisible(first - 1, False)
    shape.setVisible(first, True)
    shape.setVisible(last, True)
    shape.setVisible(last + 1, False)
    curves.rootLayer.append(shape)
    curves.changed()

# Holes are stencilled out of the outlines around them, what is inside of them is put back.
below = None
for level in sorted(nodes):
    if below is not None:
        below = nuke.nodes.Merge2(inputs=[below, nodes[level]],
                                  operation='stencil' if level % 2 else 'max')
    else:
        below = nodes[level]
)";

constexpr const char* kBlenderScript = R"(
mask = bpy.data.masks.new('NAME')
mask.animation_data_create()
mask.animation_data.action = bpy.data.actions.new('NAME')
curves = mask.animation_data.action.fcurves


def key(path, index, frames, values, interpolation):
    points = curves.new(path, index=index).keyframe_points
    points.add(len(frames))
    points.foreach_set('co', [n for pair in zip(frames, values) for n in pair])
    for point in points:
        point.interpolation = interpolation


for entry in SHAPES:
    layer = mask.layers.new(name=entry['name'])
    layer.blend = 'SUBTRACT' if entry['level'] % 2 else 'ADD'
    spline = layer.splines.new()
    spline.points.add(len(entry['points'][0]) - len(spline.points))
    spline.use_cyclic = True
    frames = entry['frames']
    at = 'layers["%s"].' % layer.name
    for k, point in enumerate(spline.points):
        point.handle_left_type = point.handle_right_type = 'FREE'
        numbers = list(zip(*[points[k] for points in entry['points']]))
        for n, name in enumerate(('co', 'handle_left', 'handle_right')):
            setattr(point, name, entry['points'][0][k][2 * n:2 * n + 2])
            for axis in (0, 1):
                key(at + 'splines[0].points[%d].%s' % (k, name), axis, frames,
                    numbers[2 * n + axis], 'LINEAR')
    key(at + 'alpha', 0, [frames[0] - 1, frames[0], frames[-1] + 1], [0, 1, 0], 'CONSTANT')
)";

std::string with_name(std::string script, std::string_view name) {
    constexpr std::string_view kName = "NAME";
    for (std::size_t at = script.find(kName); at != std::string::npos;
         at = script.find(kName, at + name.size()))
        script.replace(at, kName.size(), name);
    return script;
}

// The others add to nothing and take off of it: a shape beside the picture.
std::string cleared_picture(const std::vector<MatteShape>& shapes, int first_frame) {
    int in = shapes.front().keys.begin()->first, out = in;
    for (const MatteShape& shape : shapes) {
        in = std::min(in, shape.keys.begin()->first);
        out = std::max(out, shape.keys.rbegin()->first);
    }
    std::string points;
    for (const char* at : {"[-2, -2]", "[-1.5, -2]", "[-1.5, -1.5]"})
        points += fmt::format("{}[{}, {}, {}]", points.empty() ? "" : ", ", at, at, at);
    return fmt::format(
        "[\n {{\"name\": \"clear\", \"mlt_service\": \"rotoscoping\", \"mode\": \"alpha\", "
        "\"alpha_operation\": \"clear\", \"in\": {}, \"out\": {}, \"spline\": {{\n  \"0\": [{}]\n "
        "}}}},\n",
        in - first_frame, out - first_frame, points);
}

}  // namespace

std::string shape_name(const std::vector<MatteShape>& shapes, std::size_t index) {
    return fmt::format("{}_{}", shapes[index].level % 2 == 1 ? "hole" : "outline", index + 1);
}

std::string nuke_shapes(const std::vector<MatteShape>& shapes, const ShapeTextContext& context) {
    const double height = context.plate.height;
    return fmt::format(
               "# Roto shapes {0}, {1}x{2}: run it in Nuke's Script Editor.\n"
               "# By frame and point: x, y upwards, and the handles before and after it, from it.\n"
               "import nuke\n\nSHAPES = ",
               context.name, context.plate.width, context.plate.height) +
           shape_list(shapes, 3,
                      [&](const RotoPoint& p) {
                          const glm::dvec2 at(p.at), in(p.in), out(p.out);
                          return std::vector{at.x, height - at.y, in.x, -in.y, out.x, -out.y};
                      }) +
           with_name(kNukeScript, context.name);
}

std::string blender_shapes(const std::vector<MatteShape>& shapes, const ShapeTextContext& context) {
    // The longer side of the picture is 0 to 1, the shorter one lies in the middle of that.
    const glm::dvec2 half(context.plate.width / 2.0, context.plate.height / 2.0);
    const double longer = std::max(context.plate.width, context.plate.height);
    return fmt::format(
               "# Mask {0}, {1}x{2}: run it in Blender's text editor.\n"
               "# By frame and point: the point, the handle before it and the one after it, x and "
               "y.\n"
               "import bpy\n\nSHAPES = ",
               context.name, context.plate.width, context.plate.height) +
           shape_list(shapes, 7,
                      [&](const RotoPoint& p) {
                          std::vector<double> numbers;
                          for (const Vec2 q : {p.at, p.at + p.in, p.at + p.out}) {
                              numbers.push_back((static_cast<double>(q.x) - half.x) / longer + 0.5);
                              numbers.push_back((half.y - static_cast<double>(q.y)) / longer + 0.5);
                          }
                          return numbers;
                      }) +
           with_name(kBlenderScript, context.name);
}

std::string mlt_shapes(const std::vector<MatteShape>& shapes, const ShapeTextContext& context,
                       int first_frame) {
    const double width = context.plate.width, height = context.plate.height;
    const auto place = [&](Vec2 p) {
        return "[" + short_number(static_cast<double>(p.x) / width, 7) + ", " +
               short_number(static_cast<double>(p.y) / height, 7) + "]";
    };
    std::string text = cleared_picture(shapes, first_frame);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        const auto& keys = shapes[k].keys;
        const int in = keys.begin()->first, out = keys.rbegin()->first;
        text += fmt::format(
            " {{\"name\": \"{}\", \"mlt_service\": \"rotoscoping\", \"mode\": \"alpha\", "
            "\"alpha_operation\": \"{}\", \"in\": {}, \"out\": {}, \"spline\": {{\n",
            shape_name(shapes, k), shapes[k].level % 2 == 1 ? "sub" : "add", in - first_frame,
            out - first_frame);
        for (const auto& [frame, shape] : keys) {
            text += fmt::format("  \"{}\": [", frame - in);
            for (const RotoPoint& p : shape.points)
                text += fmt::format("{}[{}, {}, {}]", &p == &shape.points.front() ? "" : ", ",
                                    place(p.at + p.in), place(p.at), place(p.at + p.out));
            text += frame == out ? "]\n" : "],\n";
        }
        text += k + 1 < shapes.size() ? " }},\n" : " }}\n";
    }
    return text + "]\n";
}

}  // namespace weft
