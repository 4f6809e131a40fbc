#include "engine/form/manhattan_frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/form/exact_math.h"
#include "engine/form/plane_starts.h"
#include "engine/form/unit_vector.h"

namespace weft {
namespace {

constexpr double kEnd_px = 0.7;  // how exactly a line's end is found, at the long side kSide
constexpr double kSide = 960;
constexpr double kLens = 0.3 * std::numbers::pi / 180;  // what lenses bend, radians
constexpr double kStray = 0.3;        // of the lines that run to no vanishing point
constexpr double kHalfWeight = 0.03;  // of the long side: a line of that length counts half

// Of the picture of a step along an axis, at a place: finite also for a vanishing point at
// infinity.
glm::dvec2 towards(glm::dvec2 middle, const glm::dvec3& axis, double tangent) {
    return {axis.x - tangent * middle.x * axis.z, axis.y - tangent * middle.y * axis.z};
}

double length_of(glm::dvec2 v) {
    return std::sqrt(v.x * v.x + v.y * v.y);
}

}  // namespace

ManhattanFrame stepped(const ManhattanFrame& frame, const FrameStep& step) {
    // A unit quaternion, without trigonometry: the same turn to the third order.
    const glm::dvec3 half = 0.5 * glm::dvec3(step[0], step[1], step[2]);
    const double w = 1 / std::sqrt(1 + glm::dot(half, half));
    const glm::dvec3 v = w * half;
    ManhattanFrame out;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 a = frame.axes[k], across = glm::cross(v, a);
        out.axes[k] = a + 2.0 * (w * across + glm::cross(v, across));
    }
    // What rounding adds up to over many steps.
    out.axes[0] = unit(out.axes[0]);
    out.axes[1] = unit(out.axes[1] - out.axes[0] * glm::dot(out.axes[0], out.axes[1]));
    out.axes[2] = glm::cross(out.axes[0], out.axes[1]);
    // A lens that is given may lie beyond those that are found.
    out.tangent = std::clamp(frame.tangent + step[3], std::min(kLongestLens, frame.tangent),
                             std::max(kWidestLens, frame.tangent));
    return out;
}

double off_axis(const ManhattanLines::Line& line, const glm::dvec3& axis, double tangent) {
    const glm::dvec2 to = towards(line.middle, axis, tangent);
    const double length = length_of(to);
    if (!(length > 1e-9)) return 1;
    return (line.direction.x * to.y - line.direction.y * to.x) / length;
}

ManhattanLines::ManhattanLines(const std::vector<PictureLine>& lines, Size picture, int axes,
                               double most)
    : axes_(axes) {
    const double side = std::max(picture.width, picture.height);
    const glm::dvec2 centre(0.5 * picture.width, 0.5 * picture.height);
    double all = 0;
    for (const PictureLine& line : lines) {
        const glm::dvec2 d = line.to - line.from;
        const double length = line.length() / side;
        if (!(length > 0)) continue;
        const double ends = std::numbers::sqrt2 * kEnd_px / (kSide * length);
        lines_.push_back({(0.5 * (line.from + line.to) - centre) / side, d / (length * side),
                          std::sqrt(ends * ends + kLens * kLens), length / (length + kHalfWeight),
                          0});
        all += lines_.back().weight;
    }
    if (all > most)
        for (Line& line : lines_)
            line.weight *= most / all;
    set_most_gains();
}

void ManhattanLines::set_most_gains() {
    // Next to stray lines, whose angle is anything within half a turn.
    const double share = (1 - kStray) / (axes_ * kStray);
    for (Line& line : lines_)
        line.most_gain = ln(1 + share * std::sqrt(std::numbers::pi / 2) / line.sigma);
}

ManhattanLines ManhattanLines::blurred(double radians) const {
    ManhattanLines out = *this;
    for (Line& line : out.lines_)
        line.sigma = std::sqrt(line.sigma * line.sigma + radians * radians);
    out.set_most_gains();
    return out;
}

std::pair<int, double> ManhattanLines::best_axis(const Line& line,
                                                 const ManhattanFrame& frame) const {
    std::pair<int, double> best{-1, 0};
    for (int k = 0; k < axes_; ++k) {
        const double off = off_axis(line, frame.axes[k], frame.tangent) / line.sigma;
        const double gain = line.most_gain - 0.5 * off * off;
        if (gain > best.second) best = {k, gain};
    }
    return best;
}

double ManhattanLines::gain(const ManhattanFrame& frame) const {
    double out = 0;
    for (const Line& line : lines_)
        out += line.weight * best_axis(line, frame).second;
    return out;
}

double ManhattanLines::log_likelihood(const ManhattanFrame& frame, int axes) const {
    // Next to any angle within half a turn.
    std::vector<double> densities;
    for (const Line& line : lines_) {
        double sum = 0;
        for (int k = 0; k < axes; ++k) {
            const double off = off_axis(line, frame.axes[k], frame.tangent) / line.sigma;
            sum += std::sqrt(std::numbers::pi / 2) / line.sigma * exponential(-0.5 * off * off);
        }
        densities.push_back(sum / axes);
    }
    double best = 0;
    for (int tenth = 1; tenth < 10; ++tenth) {
        const double stray = 0.1 * tenth;
        double sum = 0;
        for (std::size_t k = 0; k < lines_.size(); ++k)
            sum += lines_[k].weight * ln(stray + (1 - stray) * densities[k]);
        best = std::max(best, sum);
    }
    return best;
}

double ManhattanLines::loose_likelihood(const ManhattanFrame& frame) const {
    double best = 0;
    for (const double loose : {0.05, 0.1, 0.2})
        best = std::max(best, blurred(loose).log_likelihood(frame, axes_));
    return best;
}

double ManhattanLines::explained(const ManhattanFrame& frame) const {
    double all = 0, some = 0;
    for (const Line& line : lines_) {
        all += line.weight;
        if (best_axis(line, frame).first >= 0) some += line.weight;
    }
    return all > 0 ? some / all : 0;
}

void ManhattanLines::linearise(const ManhattanFrame& frame, FrameMatrix& matrix,
                               FrameStep& right) const {
    for (const Line& line : lines_) {
        const int axis = best_axis(line, frame).first;
        if (axis < 0) continue;
        const glm::dvec3 a = frame.axes[axis];
        const glm::dvec2 to = towards(line.middle, a, frame.tangent);
        const double length = length_of(to);
        if (!(length > 1e-9)) continue;
        const auto across = [&](glm::dvec2 v) {
            return line.direction.x * v.y - line.direction.y * v.x;
        };
        const double off = across(to) / length;
        // How `to` changes with the turn and the tangent.
        std::array<glm::dvec2, 4> changes;
        for (int k = 0; k < 3; ++k) {
            glm::dvec3 about(0);
            about[k] = 1;
            changes[static_cast<std::size_t>(k)] =
                towards(line.middle, glm::cross(about, a), frame.tangent);
        }
        changes[3] = -line.middle * a.z;
        FrameStep slope;
        for (std::size_t k = 0; k < 4; ++k)
            slope[k] =
                (across(changes[k]) - off * (to.x * changes[k].x + to.y * changes[k].y) / length) /
                length;
        const double weight = line.weight / (line.sigma * line.sigma);
        for (std::size_t i = 0; i < 4; ++i) {
            right[i] -= weight * slope[i] * off;
            for (std::size_t j = 0; j < 4; ++j)
                matrix[i][j] += weight * slope[i] * slope[j];
        }
    }
}

}  // namespace weft
