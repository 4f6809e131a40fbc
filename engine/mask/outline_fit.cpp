#include "engine/mask/outline_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr double kReachPx = 6;           // over which an outline's direction is taken
constexpr float kCornerCosine = 0.766f;  // of 40°
constexpr double kRmsPx = 0.3, kWorstPx = 0.9;
constexpr double kShortestPx = 6;  // between two points
constexpr std::size_t kMostPoints = 2000;
constexpr int kMostRounds = 12;
constexpr std::size_t kChords = 16;  // of a curve, to measure distances

// The part of an outline between two points, at equal steps of about a pixel.
struct OutlineArc {
    double from = 0, length = 0;
    std::vector<Vec2> samples;  // both ends and what lies between
};

OutlineArc arc_between(const PlacedPoints& on, std::size_t k) {
    const std::size_t count = on.places.size();
    OutlineArc out;
    out.from = on.places[k];
    const double to = k + 1 < count ? on.places[k + 1] : on.places.front() + on.path->length();
    out.length = std::max(0.0, to - out.from);
    const int steps = std::clamp(static_cast<int>(std::ceil(out.length)), 2, 4096);
    for (int s = 0; s <= steps; ++s)
        out.samples.push_back(on.path->at(out.from + out.length * s / steps));
    return out;
}

struct ArcHandles {
    Vec2 leaving{0}, arriving{0};  // from the arc's ends
};

// Both handles along their directions, as long as fits the samples best.
ArcHandles handles_along(const OutlineArc& arc, Vec2 leave, Vec2 arrive) {
    const Vec2 p = arc.samples.front(), q = arc.samples.back();
    const std::size_t steps = arc.samples.size() - 1;
    double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0;
    for (std::size_t s = 1; s < steps; ++s) {
        const float t = static_cast<float>(s) / static_cast<float>(steps), u = 1 - t;
        const Vec2 a = 3 * u * u * t * leave, b = -3 * u * t * t * arrive;
        const Vec2 rest = arc.samples[s] - (u * u * (u + 3 * t)) * p - (t * t * (t + 3 * u)) * q;
        aa += static_cast<double>(glm::dot(a, a));
        ab += static_cast<double>(glm::dot(a, b));
        bb += static_cast<double>(glm::dot(b, b));
        ra += static_cast<double>(glm::dot(a, rest));
        rb += static_cast<double>(glm::dot(b, rest));
    }
    const double det = aa * bb - ab * ab;
    double first = arc.length / 3, second = first;
    if (det > 1e-6 * aa * bb) {
        first = (ra * bb - rb * ab) / det;
        second = (rb * aa - ra * ab) / det;
    }
    // Longer ones, or backward ones, make loops.
    const auto size = [&](double value) {
        return static_cast<float>(value > 0 ? std::min(value, arc.length) : arc.length / 3);
    };
    return {size(first) * leave, -size(second) * arrive};
}

struct ArcError {
    double rms_px = 0, worst_px = 0;
};

float square_to_chord(Vec2 p, Vec2 a, Vec2 b) {
    const Vec2 side = b - a;
    const float square = glm::dot(side, side);
    const float t = square > 0 ? std::clamp(glm::dot(p - a, side) / square, 0.0f, 1.0f) : 0.0f;
    const Vec2 off = p - a - t * side;
    return glm::dot(off, off);
}

ArcError error_of(const OutlineArc& arc, const RotoPoint& from, const RotoPoint& to) {
    std::array<Vec2, kChords + 1> curve{};
    const Vec2 p1 = from.at + from.out, p2 = to.at + to.in;
    for (std::size_t s = 0; s <= kChords; ++s) {
        const float t = static_cast<float>(s) / static_cast<float>(kChords), u = 1 - t;
        curve[s] =
            u * u * u * from.at + 3 * u * u * t * p1 + 3 * u * t * t * p2 + t * t * t * to.at;
    }
    double sum = 0;
    float worst = 0;
    for (const Vec2 p : arc.samples) {
        float least = std::numeric_limits<float>::infinity();
        for (std::size_t s = 0; s < kChords; ++s)
            least = std::min(least, square_to_chord(p, curve[s], curve[s + 1]));
        sum += static_cast<double>(least);
        worst = std::max(worst, least);
    }
    return {std::sqrt(sum / static_cast<double>(arc.samples.size())),
            std::sqrt(static_cast<double>(worst))};
}

// The arcs of a frame that a curve does not follow closely enough.
std::vector<char> poor_arcs(const PlacedPoints& on) {
    const RotoShape shape = fitted_shape(on);
    std::vector<char> poor(on.places.size(), 0);
    for (std::size_t k = 0; k < poor.size(); ++k) {
        const OutlineArc arc = arc_between(on, k);
        if (arc.length < 2 * kShortestPx) continue;
        const ArcError error =
            error_of(arc, shape.points[k], shape.points[(k + 1) % shape.points.size()]);
        poor[k] = error.rms_px > kRmsPx || error.worst_px > kWorstPx;
    }
    return poor;
}

void split_arcs(PlacedPoints& on, const std::vector<char>& poor) {
    std::vector<double> out;
    for (std::size_t k = 0; k < on.places.size(); ++k) {
        out.push_back(on.places[k]);
        if (!poor[k]) continue;
        const double next =
            k + 1 < on.places.size() ? on.places[k + 1] : on.places.front() + on.path->length();
        out.push_back(on.places[k] + (next - on.places[k]) / 2);
    }
    on.places = std::move(out);
}

}  // namespace

std::vector<double> bend_places(const OutlinePath& path, double tolerance_px) {
    std::vector<cv::Point2f> all, kept;
    for (const Vec2 p : path.points())
        all.emplace_back(p.x, p.y);
    cv::approxPolyDP(all, kept, tolerance_px, true);
    std::vector<double> out;
    std::size_t k = 0;
    // What is kept are points of the outline; they begin anywhere on it.
    for (const cv::Point2f& p : kept) {
        for (std::size_t seen = 0; seen < all.size() && all[k] != p; ++seen)
            k = (k + 1) % all.size();
        out.push_back(path.place_of(k));
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    if (out.size() < 3) out = {0, path.length() / 3, 2 * path.length() / 3};
    return out;
}

RotoShape fitted_shape(const PlacedPoints& points) {
    const std::size_t count = points.places.size();
    std::vector<OutlineArc> arcs;
    for (std::size_t k = 0; k < count; ++k)
        arcs.push_back(arc_between(points, k));
    std::vector<Vec2> leaving(count), arriving(count);
    for (std::size_t k = 0; k < count; ++k) {
        const auto reach = [&](double length) { return std::clamp(length / 2, 0.5, kReachPx); };
        const double place = points.places[k];
        Vec2 in = points.path->direction(place, -1, reach(arcs[(k + count - 1) % count].length));
        Vec2 out = points.path->direction(place, 1, reach(arcs[k].length));
        const Vec2 both = in + out;
        if (glm::dot(in, out) > kCornerCosine) in = out = glm::normalize(both);
        arriving[k] = in, leaving[k] = out;
    }
    RotoShape shape;
    shape.points.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t next = (k + 1) % count;
        shape.points[k].at = arcs[k].samples.front();
        const ArcHandles handles = handles_along(arcs[k], leaving[k], arriving[next]);
        shape.points[k].out = handles.leaving;
        shape.points[next].in = handles.arriving;
    }
    return shape;
}

std::vector<RotoShape> fitted_shapes(std::vector<PlacedPoints> frames) {
    for (int round = 0; round < kMostRounds && !frames.empty(); ++round) {
        std::vector<std::vector<char>> each(frames.size());
        parallel_for(frames.size(), [&](std::size_t k) { each[k] = poor_arcs(frames[k]); });
        std::vector<char> poor = each.front();
        for (const std::vector<char>& other : each)
            for (std::size_t k = 0; k < poor.size(); ++k)
                poor[k] = poor[k] || other[k];
        const auto more = static_cast<std::size_t>(std::count(poor.begin(), poor.end(), 1));
        if (more == 0 || poor.size() + more > kMostPoints) break;
        for (PlacedPoints& on : frames)
            split_arcs(on, poor);
    }
    std::vector<RotoShape> out;
    out.reserve(frames.size());
    for (const PlacedPoints& on : frames)
        out.push_back(fitted_shape(on));
    return out;
}

}  // namespace weft
