#include "engine/form/planar_track.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "engine/form/homography_fit.h"

namespace weft {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Eigen::Vector2d through(const Eigen::Matrix3d& map, const Eigen::Vector2d& p) {
    const Eigen::Vector3d q = map * p.homogeneous();
    return q.hnormalized();
}

// Least trimmed squares over the direct linear transform: fitted, again and again, to the four
// fifths that agree best with the last fit (the C-steps of Rousseeuw & Van Driessen 2006,
// "Computing LTS regression for large data sets"). What is left out was covered, or left the plane.
std::optional<Eigen::Matrix3d> robust_fit(const Points& from, const Points& to) {
    constexpr int kSteps = 20;
    auto fit = fit_homography(from, to);
    const std::size_t kept = std::max<std::size_t>(4, 4 * from.size() / 5);
    std::vector<std::size_t> last;
    for (int step = 0; fit && step < kSteps; ++step) {
        std::vector<double> apart(from.size());
        for (std::size_t k = 0; k < from.size(); ++k)
            apart[k] = (through(*fit, from[k]) - to[k]).squaredNorm();
        std::vector<std::size_t> order(from.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t m, std::size_t n) { return apart[m] < apart[n]; });
        order.resize(kept);
        std::sort(order.begin(), order.end());
        if (order == last) break;
        Points near_from, near_to;
        for (const std::size_t k : order) {
            near_from.push_back(from[k]);
            near_to.push_back(to[k]);
        }
        const auto again = fit_homography(near_from, near_to);
        if (!again) break;
        fit = again;
        last = std::move(order);
    }
    return fit;
}

}  // namespace

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
    // The fit wants places about 1 from the origin.
    const Eigen::Vector2d middle(0.5 * (box_[0].x + box_[2].x), 0.5 * (box_[0].y + box_[2].y));
    const double unit = 0.5 * std::max(box_[2].x - box_[0].x, box_[2].y - box_[0].y);
    const auto scaled = [&](double x, double y) -> Eigen::Vector2d {
        return (Eigen::Vector2d(x, y) - middle) / unit;
    };
    Points from, to;
    for (const Vec2 p : places_) {
        const Vec2 q = p + there_from_here.at(p);
        from.push_back(scaled(p.x, p.y));
        to.push_back(scaled(q.x, q.y));
    }
    const auto map = robust_fit(from, to);
    Quad<double> quad{};
    for (std::size_t k = 0; map && k < quad.size(); ++k) {
        const Eigen::Vector2d q = through(*map, scaled(box_[k].x, box_[k].y)) * unit + middle;
        quad[k] = {q.x(), q.y()};
    }
    if (!map || !is_convex(quad))
        return fail(ErrorCode::kRenderFailed,
                    "Its motion on frame " + std::to_string(frame) + " is not that of a plane.");
    track_[frame] = quad;
    return {};
}

}  // namespace weft
