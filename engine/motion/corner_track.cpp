#include "engine/motion/corner_track.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "engine/core/frame_range.h"

namespace weft {
namespace {

using Point = glm::dvec2;
using Path = std::map<int, Point>;  // one corner over time

tl::unexpected<Error> unreadable(std::string message, std::string remedy) {
    return fail(ErrorCode::kUnreadable, std::move(message), std::move(remedy));
}

std::vector<std::string_view> words(std::string_view text, std::string_view between) {
    std::vector<std::string_view> out;
    for (std::size_t at = 0;
         (at = text.find_first_not_of(between, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(between, at), text.size());
        out.push_back(text.substr(at, end - at));
        at = end;
    }
    return out;
}

std::vector<std::string_view> lines_of(std::string_view text) {
    return words(text, "\r\n");
}

bool read_number(std::string_view word, double& out) {
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), out);
    return error == std::errc() && stop == word.data() + word.size() && std::isfinite(out);
}

bool read_frame(std::string_view word, int& out) {
    double number = 0;
    if (!read_number(word, number) || number != std::floor(number) ||
        std::abs(number) > kMaxFrameNumber)
        return false;
    out = static_cast<int>(number);
    return true;
}

template <class T>
T between(const std::map<int, T>& path, int frame) {
    const auto after = path.lower_bound(frame);
    if (after == path.end()) return path.rbegin()->second;
    if (after->first == frame || after == path.begin()) return after->second;
    const auto before = std::prev(after);
    const double t = static_cast<double>(frame - before->first) /
                     static_cast<double>(after->first - before->first);
    return before->second + (after->second - before->second) * t;
}

// Four paths, in the order of Quad, over all frames that any of them names.
Expected<CornerTrack> joined(const std::array<Path, 4>& paths) {
    CornerTrack track;
    for (const Path& path : paths) {
        for (const auto& [frame, point] : path)
            track.try_emplace(frame);
    }
    for (auto& [frame, quad] : track) {
        for (std::size_t k = 0; k < 4; ++k)
            quad[k] = between(paths[k], frame);
    }
    return completed(std::move(track));
}

// ---- lines of numbers -------------------------------------------------------------------------

// A plane that moves with a point and neither turns nor grows.
Quad<double> square_at(Point p) {
    constexpr double kHalfPx = 50;
    return {p + Point(-kHalfPx, -kHalfPx), p + Point(kHalfPx, -kHalfPx),
            p + Point(kHalfPx, kHalfPx), p + Point(-kHalfPx, kHalfPx)};
}

Expected<CornerTrack> parse_lines(std::string_view text, bool points) {
    CornerTrack track;
    int number = 0;
    for (const std::string_view line : lines_of(text)) {
        ++number;
        const auto numbers = words(line.substr(0, line.find('#')), " \t,;");
        if (numbers.empty()) continue;
        int frame = 0;
        Quad<double> quad;
        const bool is_point = points && numbers.size() == 3;
        bool good = (numbers.size() == 9 || is_point) && read_frame(numbers[0], frame);
        if (Point at(0); good && is_point) {
            good = read_number(numbers[1], at.x) && read_number(numbers[2], at.y);
            quad = square_at(at);
        }
        for (std::size_t k = 0; good && !is_point && k < 4; ++k) {
            good = read_number(numbers[1 + 2 * k], quad[k].x) &&
                   read_number(numbers[2 + 2 * k], quad[k].y);
        }
        if (!good) {
            return unreadable("Line " + std::to_string(number) +
                                  " is not a frame and the x and y of four corners.",
                              std::string("Write nine numbers on each line: the frame, then x and "
                                          "y of the four corners") +
                                  (points ? "; or three for a point" : ""));
        }
        if (!track.emplace(frame, quad).second)
            return unreadable("Frame " + std::to_string(frame) + " occurs twice.",
                              "Keep one of its lines");
    }
    return completed(std::move(track));
}

// ---- After Effects ----------------------------------------------------------------------------

constexpr int kNoCorner = -1;

// Is a section about a place that is tracked?
bool is_point_section(std::string_view line) {
    return line.find("Position") != std::string_view::npos ||
           line.find("Feature Center") != std::string_view::npos;
}

// Which corner (of Quad) a section is about.
int effects_corner(std::string_view line) {
    constexpr struct {
        std::string_view name;
        int corner;
    } kNames[] = {{"CC Power Pin-0002", 0}, {"CC Power Pin-0003", 1}, {"CC Power Pin-0004", 3},
                  {"CC Power Pin-0005", 2}, {"Corner Pin-0001", 0},   {"Corner Pin-0002", 1},
                  {"Corner Pin-0003", 3},   {"Corner Pin-0004", 2},   {"Upper Left", 0},
                  {"Upper Right", 1},       {"Lower Left", 3},        {"Lower Right", 2},
                  {"Top Left", 0},          {"Top Right", 1},         {"Bottom Left", 3},
                  {"Bottom Right", 2}};
    if (line.find("Pin") == std::string_view::npos) return kNoCorner;
    for (const auto& known : kNames) {
        if (line.find(known.name) != std::string_view::npos) return known.corner;
    }
    return kNoCorner;
}

Expected<CornerTrack> parse_after_effects(std::string_view text,
                                          const CornerTrackContext& context) {
    std::array<Path, 4> paths;
    CornerTrack point;
    Point size(context.plate.width, context.plate.height), source = size;
    int corner = kNoCorner;
    bool in_point = false;
    for (const std::string_view line : lines_of(text)) {
        const auto numbers = words(line, " \t");
        if (numbers.empty()) continue;
        const bool starts_section = line.front() != '\t' && line.front() != ' ';
        if (starts_section) {
            corner = effects_corner(line);
            in_point = context.points && corner == kNoCorner && is_point_section(line);
        }
        double value = 0;
        if (line.find("Source Width") != std::string_view::npos &&
            read_number(numbers.back(), value))
            source.x = value;
        if (line.find("Source Height") != std::string_view::npos &&
            read_number(numbers.back(), value))
            source.y = value;
        int frame = 0;
        Point at(0);
        if ((corner == kNoCorner && !in_point) || numbers.size() < 3 ||
            !read_frame(numbers[0], frame) || !read_number(numbers[1], at.x) ||
            !read_number(numbers[2], at.y))
            continue;
        frame += context.first_frame;
        if (in_point)
            point.try_emplace(frame, square_at(at * size / source));
        else
            paths[static_cast<std::size_t>(corner)][frame] = at * size / source;
    }
    if (!point.empty() && paths[0].empty()) return completed(std::move(point));
    constexpr const char* kCorners[] = {"upper left", "upper right", "lower right", "lower left"};
    for (std::size_t k = 0; k < 4; ++k) {
        if (paths[k].empty())
            return unreadable(std::string("The keyframe data has no ") + kCorners[k] + " corner.",
                              "Copy the keyframes of all four corners");
    }
    return joined(paths);
}

// ---- Nuke -------------------------------------------------------------------------------------

// The values of a knob: "12.5", or "curve x1 12 13 x5 14", where each x sets the frame and each
// number is the value of the next frame. Slopes and kinds of curve are skipped.
std::map<int, double> knob_values(std::string_view text) {
    std::map<int, double> out;
    int frame = 0;
    for (const std::string_view word : words(text, " \t\r\n{}")) {
        double value = 0;
        if (word.size() > 1 && word.front() == 'x' && read_frame(word.substr(1), frame)) continue;
        if (read_number(word, value)) out[frame++] = value;
    }
    return out;
}

// The text between an opening brace and the one that closes it.
std::string_view braced(std::string_view text) {
    int depth = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
        depth += text[k] == '{';
        depth -= text[k] == '}';
        if (depth == 0) return text.substr(1, k - 1);
    }
    return {};
}

// A knob of two numbers, each of which may be a curve.
Expected<Path> knob_path(std::string_view node, const std::string& name, double height) {
    const auto missing = [&] {
        return unreadable("The CornerPin2D node has no usable " + name + ".",
                          "Export the four points to1 to to4");
    };
    std::size_t at = std::string_view::npos;
    for (std::size_t from = 0; (from = node.find(name + " ", from)) != std::string_view::npos;
         ++from) {
        if (from == 0 || node[from - 1] == ' ' || node[from - 1] == '\n' ||
            node[from - 1] == '\t') {
            at = from;
            break;
        }
    }
    if (at == std::string_view::npos) return missing();
    at = node.find_first_not_of(" \t", at + name.size());
    if (at == std::string_view::npos || node[at] != '{') return missing();
    const std::string_view inside = braced(node.substr(at));
    std::array<std::map<int, double>, 2> values;
    std::size_t count = 0;
    for (std::size_t k = 0; k < inside.size() && count < 2;) {
        k = inside.find_first_not_of(" \t\r\n", k);
        if (k == std::string_view::npos) break;
        const bool is_curve = inside[k] == '{';
        const std::string_view one = is_curve
                                         ? braced(inside.substr(k))
                                         : inside.substr(k, inside.find_first_of(" \t\r\n", k) - k);
        values[count++] = knob_values(one);
        k += one.size() + (is_curve ? 2 : 0);
    }
    if (count < 2 || values[0].empty() || values[1].empty()) return missing();
    Path path;
    for (const auto& [frame, x] : values[0])
        path[frame] = {};
    for (const auto& [frame, y] : values[1])
        path[frame] = {};
    for (auto& [frame, p] : path)
        p = {between(values[0], frame), height - between(values[1], frame)};
    return path;
}

Expected<CornerTrack> parse_nuke(std::string_view text, const CornerTrackContext& context) {
    const std::string_view node = text.substr(text.find("CornerPin2D"));
    std::array<Path, 4> paths;
    constexpr const char* kKnobs[] = {"to4", "to3", "to2", "to1"};
    for (std::size_t k = 0; k < 4; ++k) {
        WEFT_TRY(path, knob_path(node, kKnobs[k], context.plate.height));
        paths[k] = std::move(path);
    }
    return joined(paths);
}

}  // namespace

Expected<CornerTrack> completed(CornerTrack track) {
    if (track.empty())
        return unreadable("The track has no frames.", "Export it again with its frames");
    for (const auto& [frame, quad] : track) {
        if (!is_convex(quad)) {
            return unreadable("On frame " + std::to_string(frame) +
                                  " the corners do not go around a convex quadrilateral: top left, "
                                  "top right, bottom right, bottom left.",
                              "Correct them, or remove the frame");
        }
    }
    constexpr int kLongest = 1'000'000;
    const int first = track.begin()->first, last = track.rbegin()->first;
    if (last - first > kLongest)
        return unreadable("The track has too many frames.", "Remove those far from the shot");
    CornerTrack out;
    for (int frame = first; frame <= last; ++frame) {
        const auto after = track.lower_bound(frame);
        if (after->first == frame) {
            out[frame] = after->second;
            continue;
        }
        const auto before = std::prev(after);
        const double t = static_cast<double>(frame - before->first) /
                         static_cast<double>(after->first - before->first);
        for (std::size_t k = 0; k < 4; ++k)
            out[frame][k] = before->second[k] + t * (after->second[k] - before->second[k]);
    }
    return out;
}

Expected<CornerTrack> parse_corner_track(std::string_view text, const CornerTrackContext& context) {
    if (text.find("CornerPin2D") != std::string_view::npos) return parse_nuke(text, context);
    if (text.find("Keyframe Data") != std::string_view::npos)
        return parse_after_effects(text, context);
    return parse_lines(text, context.points);
}

LatticeField plane_motion(const Quad<double>& source, const Quad<double>& target, Size full,
                          int spacing) {
    const glm::dmat3 map = square_to_quad(target) * glm::inverse(square_to_quad(source));
    const auto depth = [&](Point p) { return (map * glm::dvec3(p, 1.0)).z; };
    const double middle = depth(0.25 * (source[0] + source[1] + source[2] + source[3]));
    constexpr double kNearest = 0.1;  // of the depth in the middle
    LatticeField field(full, spacing);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 node = field.node_position(i, j);
            const glm::dvec3 q = map * glm::dvec3(node.x, node.y, 1.0);
            const double z = middle * std::max(kNearest, q.z / middle);
            field.set_node(
                i, j, {static_cast<float>(q.x / z - node.x), static_cast<float>(q.y / z - node.y)});
        }
    }
    return field;
}

}  // namespace weft
