#include "engine/mask/keyed_shape.h"

#include <cmath>
#include <glm/matrix.hpp>
#include <iterator>
#include <optional>

#include "engine/mask/shape_matte.h"

namespace weft {
namespace {

using Corners = Quad<double>;

const Corners& corners_on(const CornerTrack& track, int frame) {
    const auto after = track.lower_bound(frame);
    if (after == track.end()) return track.rbegin()->second;
    if (after->first == frame || after == track.begin()) return after->second;
    return std::prev(after)->second;  // completed() leaves no gaps
}

glm::dvec2 middle_of(const Corners& q) {
    return 0.25 * (q[0] + q[1] + q[2] + q[3]);
}

// The similarity that fits the corners best in least squares: as complex numbers, b ≈ s a + t
// (Umeyama 1991 in two dimensions, without mirroring).
glm::dmat3 similarity(const Corners& from, const Corners& to) {
    const glm::dvec2 a0 = middle_of(from), b0 = middle_of(to);
    double re = 0, im = 0, spread = 0;
    for (std::size_t k = 0; k < from.size(); ++k) {
        const glm::dvec2 a = from[k] - a0, b = to[k] - b0;
        re += a.x * b.x + a.y * b.y;
        im += a.x * b.y - a.y * b.x;
        spread += a.x * a.x + a.y * a.y;
    }
    re /= spread;
    im /= spread;
    const glm::dvec2 t = b0 - glm::dvec2(re * a0.x - im * a0.y, im * a0.x + re * a0.y);
    return {re, im, 0, -im, re, 0, t.x, t.y, 1};
}

// One of the picture unsqueezed, from plate pixels to plate pixels.
glm::dmat3 unsqueezed_similarity(Corners from, Corners to, PixelAspect aspect) {
    for (Corners* corners : {&from, &to})
        for (glm::dvec2& corner : *corners)
            corner = aspect.unsqueezed(corner);
    glm::dmat3 out = similarity(from, to);
    const auto ratio = static_cast<double>(aspect.ratio());
    out[0][1] *= ratio;
    out[1][0] /= ratio;
    out[2][0] /= ratio;
    return out;
}

struct PlaceInDepth {
    glm::dvec2 at;
    double depth;
};
PlaceInDepth through(const glm::dmat3& m, Vec2 p) {
    const glm::dvec3 q = m * glm::dvec3(glm::dvec2(p), 1.0);
    return {glm::dvec2(q.x, q.y) / q.z, q.z};
}

// How much larger a small thing at `p` becomes: the root of the map's determinant there.
double growth(const glm::dmat3& m, double depth) {
    return std::sqrt(std::abs(glm::determinant(m) / (depth * depth * depth)));
}

}  // namespace

glm::dmat3 track_motion(const CornerTrack& track, ShapeFollow follow, int from, int to,
                        PixelAspect aspect) {
    glm::dmat3 out(1);
    if (track.empty() || follow == ShapeFollow::kNone || from == to) return out;
    const Corners &a = corners_on(track, from), &b = corners_on(track, to);
    if (a == b) return out;
    if (follow == ShapeFollow::kPosition) {
        const glm::dvec2 step = middle_of(b) - middle_of(a);
        out[2] = {step.x, step.y, 1};
        return out;
    }
    if (follow == ShapeFollow::kSimilarity) return unsqueezed_similarity(a, b, aspect);
    return square_to_quad(b) * glm::inverse(square_to_quad(a));
}

RotoShape moved(const RotoShape& shape, const glm::dmat3& motion) {
    // Behind the plane's horizon there is no place; a homography of the plane keeps the sign of the
    // depth on the side that is seen.
    RotoShape out = shape;
    std::optional<bool> side;
    for (RotoPoint& point : out.points) {
        const PlaceInDepth at = through(motion, point.at),
                           in = through(motion, point.at + point.in),
                           end = through(motion, point.at + point.out);
        for (const double depth : {at.depth, in.depth, end.depth}) {
            constexpr double kLeast = 1e-9;
            if (!(std::abs(depth) > kLeast) || (side && *side != (depth > 0))) return shape;
            side = depth > 0;
        }
        const bool corner_in = point.in == Vec2{0, 0}, corner_out = point.out == Vec2{0, 0};
        point.feather_px =
            static_cast<float>(static_cast<double>(point.feather_px) * growth(motion, at.depth));
        point.at = Vec2(at.at);
        point.in = corner_in ? Vec2{0, 0} : Vec2(in.at - at.at);
        point.out = corner_out ? Vec2{0, 0} : Vec2(end.at - at.at);
    }
    return out;
}

RotoShape shape_on(const KeyedShape& shape, const CornerTrack& track, int frame,
                   PixelAspect aspect) {
    const auto here = [&](const auto& key) {
        return moved(key.second, track_motion(track, shape.follow, key.first, frame, aspect));
    };
    const auto after = shape.keys.lower_bound(frame);
    if (after == shape.keys.end()) return here(*shape.keys.rbegin());
    if (after->first == frame) return after->second;
    if (after == shape.keys.begin()) return here(*after);
    const auto before = std::prev(after);
    return between(here(*before), here(*after),
                   static_cast<float>(frame - before->first) /
                       static_cast<float>(after->first - before->first));
}

}  // namespace weft
