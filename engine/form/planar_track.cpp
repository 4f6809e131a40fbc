#include "engine/form/planar_track.h"

#include <algorithm>

#include "engine/motion/plane_fit.h"

namespace weft {

PlanarTracker::PlanarTracker(std::vector<Vec2> places) : places_(std::move(places)) {
    if (places_.empty()) return;
    Vec2 low = places_[0], high = places_[0];
    for (const Vec2 p : places_) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    box_ = {{{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}};
}

Status PlanarTracker::add(int frame, const LatticeField& there_from_here) {
    constexpr std::size_t kLeast = 8;
    if (places_.size() < kLeast || !is_convex(box_))
        return fail(ErrorCode::kUsage, "The shape is too small to be followed.",
                    "Draw a larger one.");
    std::vector<PlacePair> pairs;
    pairs.reserve(places_.size());
    for (const Vec2 p : places_)
        pairs.push_back({p, p + there_from_here.at(p)});
    const glm::dmat3 plane = fit_plane(pairs);
    Quad<double> quad{};
    for (std::size_t k = 0; k < quad.size(); ++k) {
        const glm::dvec3 q = plane * glm::dvec3(box_[k].x, box_[k].y, 1);
        quad[k] = glm::dvec2(q) / q.z;
    }
    if (!is_convex(quad))
        return fail(ErrorCode::kRenderFailed,
                    "Its motion on frame " + std::to_string(frame) + " is not that of a plane.");
    track_[frame] = quad;
    return {};
}

}  // namespace weft
