#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/mask/boundary_refiner.h"
#include "engine/mask/hidden_part.h"
#include "engine/mask/matte_propagation.h"
#include "engine/mask/signed_distance.h"
#include "engine/mask/soft_matting.h"

namespace weft {
namespace {

constexpr float kAgreedOdds = 4;  // log odds where both estimates agree

// Bounds of where either estimate is inside.
Recti joint_bounds(ViewF1 before, ViewF1 after) {
    Recti box;
    for (int y = 0; y < before.height(); ++y) {
        for (int x = 0; x < before.width(); ++x) {
            if (before.row(y)[x] > 0 || after.row(y)[x] > 0) box = box.united({x, y, x + 1, y + 1});
        }
    }
    return box;
}

// Two estimates of a shape, combined over an area. `share` is the later one's weight.
struct JointShape {
    JointShape(ViewF1 before_phi, ViewF1 after_phi, float share, float band_px)
        : before(before_phi),
          after(after_phi),
          expected(before.size()),
          agreed(before.size()),
          side_odds(before.size()) {
        for (int y = 0; y < before.height(); ++y) {
            for (int x = 0; x < before.width(); ++x) {
                const float a = before.row(y)[x], b = after.row(y)[x];
                const bool same = (a > 0) == (b > 0);
                const float blend = a + share * (b - a);
                // Where they disagree nothing is settled, even far from the blended boundary.
                expected.row(y)[x] = same ? blend : std::clamp(blend, 1 - band_px, band_px - 1);
                agreed.row(y)[x] = !same ? 0 : (a > 0 ? std::min(a, b) : std::max(a, b));
                side_odds.row(y)[x] = kAgreedOdds * ((1 - share) * std::clamp(a / 2, -1.0f, 1.0f) +
                                                     share * std::clamp(b / 2, -1.0f, 1.0f));
                agreeing += same && a > 0 ? 1 : 0;
                either += a > 0 || b > 0 ? 1 : 0;
            }
        }
    }

    ViewF1 before, after;  ///< Signed distances, pixels.
    ImageF1 expected;      ///< The same distances blended, pixels.
    ImageF1 agreed;     ///< Distance to the nearer boundary where both take the same side, else 0.
    ImageF1 side_odds;  ///< Log odds for inside by the estimates' weights.
    double agreeing = 0, either = 0;
};

// Edges are soft where either estimate has a soft edge.
Matte soften(ViewU8x3 frame, const RefinedBoundary& found, ViewU8x1 before, ViewU8x1 after,
             const JointShape& joint, float share, const MatteOptions& options) {
    if (!options.soft_edges) return found.matte;
    constexpr float kWidestPx = 20;
    const auto softness_of = [](ViewU8x1 matte, ViewF1 phi) {
        return edge_softness(matte, shape_without_strands(phi, 2 * kWidestPx), kWidestPx);
    };
    ImageF1 softness = softness_of(before, joint.before);
    const ImageF1 other = softness_of(after, joint.after);
    Matte expected(frame.size());
    for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
            softness.at(x, y) = std::max(softness.at(x, y), other.at(x, y));
            const float a = before.row(y)[x], b = after.row(y)[x];
            expected.at(x, y) = static_cast<std::uint8_t>(a + share * (b - a) + 0.5f);
        }
    }
    return with_soft_edges(frame, found.phi, softness, found.matte, expected, options.steadiness);
}

}  // namespace

MatteEstimate merge_estimates(const MatteEstimate& from_before, const MatteEstimate& from_after,
                              float position, ViewU8x3 frame, const MatteOptions& options,
                              ViewU8x1 in_front) {
    if (position <= 0) return from_before;
    if (position >= 1) return from_after;
    // Squared: a walk with half the confidence is more than twice as likely to be wrong.
    const float before = std::max(from_before.confidence, 1e-3f);
    const float after = std::max(from_after.confidence, 1e-3f);
    const float before_weight = (1 - position) * before * before;
    const float after_weight = position * after * after;
    const float share = after_weight / (before_weight + after_weight);

    const RefineScale scale(frame.size());
    const ImageF1 phi_before = signed_distance(inside_of(from_before.matte), scale.limit_px);
    const ImageF1 phi_after = signed_distance(inside_of(from_after.matte), scale.limit_px);
    MatteEstimate merged{Matte(frame.size()), (1 - share) * before + share * after};
    const Recti bounds = joint_bounds(phi_before, phi_after);
    if (bounds.empty()) return merged;
    const int margin = static_cast<int>(scale.band_px) + scale.window_half_px + 4;
    const Recti area = bounds.grown(margin).intersected(rect_of(frame.size()));

    const JointShape joint(phi_before.view().crop(area), phi_after.view().crop(area), share,
                           scale.band_px);
    const ViewU8x3 part = frame.crop(area);
    std::vector<ColorWindow> windows = place_windows(joint.expected, scale.window_step_px);
    for (ColorWindow& w : windows)
        w.source_centers = {w.center};
    const Matte hidden = in_front.empty() ? Matte() : hidden_part(in_front.crop(area));
    const ImageF1 seen = hidden.empty() ? ImageF1() : seen_distance(joint.agreed, hidden);
    LocalColorField colors(std::move(windows),
                           {{part, hidden.empty() ? joint.agreed : seen, 1.5f, 1.0f, 1.0f}},
                           scale.window_half_px, scale.sample_stride, part.size());
    colors.leave_out(hidden);
    const RefinedBoundary found = refine_boundary(part, joint.expected, colors, joint.side_odds,
                                                  ViewF1(), scale, options.steadiness);
    const Matte matte = soften(part, found, from_before.matte.view().crop(area),
                               from_after.matte.view().crop(area), joint, share, options);
    for (int y = 0; y < area.height(); ++y) {
        std::copy(matte.row(y), matte.row(y) + area.width(),
                  merged.matte.pixel(area.x0, area.y0 + y));
    }
    // Two independent walks that end at the same shape confirm each other.
    const auto agreement = static_cast<float>(joint.agreeing / joint.either);
    merged.confidence += (1 - merged.confidence) * agreement * agreement * agreement;
    return merged;
}

}  // namespace weft
