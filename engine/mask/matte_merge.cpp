#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
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
// The weight of a walk where it has not followed what it sees from its keyframe; elsewhere it is 1.
constexpr float kGuessed = 0.03f;
// A share of less than this, or of more than 1 less this, is a decision, which the picture does not
// change; but two edges that are no farther apart are one that it places.
constexpr float kDoubt = 0.4f, kDecidedOdds = 40, kOneEdge_px = 2;

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

bool is_confirmed_in(const MatteEstimate& e, int x, int y) {
    return !e.since.empty() && e.since.at(x, y) != kNeverConfirmed;
}

float known(float confidence) {
    return std::max(confidence, 1e-3f);
}

// How far a walk knows each pixel, kGuessed to 1, in the mean near by: single pixels of measured
// motion fail anywhere. Empty: it does not tell.
ImageF1 knowledge_of(const Matte& followed) {
    ImageF1 known(followed.size());
    if (followed.empty()) return known;
    constexpr int kNear_px = 7;
    for (int y = 0; y < known.height(); ++y) {
        for (int x = 0; x < known.width(); ++x)
            known.at(x, y) = followed.at(x, y) != 0 ? 1 : kGuessed;
    }
    cv::Mat pixels(known.height(), known.width(), CV_32F, known.data(),
                   static_cast<std::size_t>(known.stride()) * sizeof(float));
    cv::blur(pixels, pixels, {kNear_px, kNear_px}, {-1, -1}, cv::BORDER_REPLICATE);
    return known;
}

// Where both walks know something and disagree, the one that is right has the weight, but for what
// an artist has confirmed.
void give_to_the_right(ImageF1& shares, ViewF1 inside, const MatteEstimate& before,
                       const MatteEstimate& after) {
    constexpr float kSure = 0.02f;
    for (int y = 0; y < shares.height(); ++y) {
        for (int x = 0; x < shares.width(); ++x) {
            const bool a = before.matte.at(x, y) > 127, b = after.matte.at(x, y) > 127;
            float& share = shares.at(x, y);
            if (a == b || share <= 0 || share >= 1 || is_confirmed_in(before, x, y) ||
                is_confirmed_in(after, x, y))
                continue;
            const float in = std::clamp(2 * inside.row(y)[x] - 0.5f, kSure, 1 - kSure);
            share = b ? in : 1 - in;
        }
    }
}

float mean_share(ViewF1 shares) {
    double sum = 0;
    for (int y = 0; y < shares.height(); ++y)
        sum = std::accumulate(shares.row(y), shares.row(y) + shares.width(), sum);
    return static_cast<float>(sum / (double{1} * shares.width() * shares.height()));
}

// Two estimates of a shape, combined over an area. `shares` are the later one's weights; `decided`:
// they say who is right.
struct JointShape {
    JointShape(ViewF1 before_phi, ViewF1 after_phi, ViewF1 shares, float band_px, bool decided)
        : before(before_phi),
          after(after_phi),
          expected(before.size()),
          agreed(before.size()),
          side_odds(before.size()) {
        for (int y = 0; y < before.height(); ++y) {
            for (int x = 0; x < before.width(); ++x) {
                const float a = before.row(y)[x], b = after.row(y)[x];
                const float share = shares.row(y)[x];
                const bool same = (a > 0) == (b > 0);
                const float blend = a + share * (b - a);
                // Where they disagree and that is not decided nothing is settled, even far from the
                // blended boundary.
                const bool settled = !same && decided && std::abs(a - b) > kOneEdge_px &&
                                     std::min(share, 1 - share) < kDoubt;
                expected.row(y)[x] =
                    same || settled ? blend : std::clamp(blend, 1 - band_px, band_px - 1);
                agreed.row(y)[x] = !same ? 0 : (a > 0 ? std::min(a, b) : std::max(a, b));
                side_odds.row(y)[x] = (settled ? kDecidedOdds : kAgreedOdds) *
                                      ((1 - share) * std::clamp(a / 2, -1.0f, 1.0f) +
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
             const JointShape& joint, ViewF1 shares, const MatteOptions& options) {
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
            expected.at(x, y) =
                static_cast<std::uint8_t>(std::lround(a + shares.row(y)[x] * (b - a)));
        }
    }
    return with_soft_edges(frame, found.phi, softness, found.matte, expected, options.steadiness);
}

// What only one walk knows of stays as that has it.
void keep_single(Matte& merged, const MatteEstimate& before, const MatteEstimate& after,
                 const ImageF1& shares) {
    for (int y = 0; y < merged.height(); ++y) {
        for (int x = 0; x < merged.width(); ++x) {
            if (shares.at(x, y) <= 0) merged.at(x, y) = before.matte.at(x, y);
            if (shares.at(x, y) >= 1) merged.at(x, y) = after.matte.at(x, y);
        }
    }
}

}  // namespace

// What was confirmed is as certain as since then.
ImageF1 merge_shares(const MatteEstimate& from_before, const MatteEstimate& from_after,
                     const MergePlace& place, Size size) {
    ImageF1 shares = merge_positions(place, from_before.since, from_after.since, size);
    const auto confidence = [](const MatteEstimate& e, int x, int y) {
        return known(is_confirmed_in(e, x, y) ? e.since_confidence : e.confidence);
    };
    const ImageF1 before_known = knowledge_of(from_before.followed);
    const ImageF1 after_known = knowledge_of(from_after.followed);
    const bool told = !before_known.empty() && !after_known.empty();
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float position = shares.at(x, y);
            // Squared: a walk with half the confidence is more than twice as likely to be wrong.
            const float before = confidence(from_before, x, y);
            const float after = confidence(from_after, x, y);
            float before_weight = (1 - position) * before * before;
            float after_weight = position * after * after;
            if (told) {
                before_weight *= before_known.at(x, y);
                after_weight *= after_known.at(x, y);
            }
            shares.at(x, y) = after_weight / (before_weight + after_weight);
        }
    }
    return shares;
}

MatteEstimate merge_estimates(const MatteEstimate& from_before, const MatteEstimate& from_after,
                              const MergePlace& place, ViewU8x3 frame, const MatteOptions& options,
                              ViewU8x1 in_front, ViewF1 inside) {
    const bool confirmed = !from_before.since.empty() || !from_after.since.empty();
    if (!confirmed && place.before && place.frame <= *place.before) return from_before;
    if (!confirmed && place.after && place.frame >= *place.after) return from_after;
    ImageF1 shares = merge_shares(from_before, from_after, place, frame.size());
    if (!inside.empty()) give_to_the_right(shares, inside, from_before, from_after);
    const RefineScale scale(frame.size());
    const ImageF1 phi_before = signed_distance(inside_of(from_before.matte), scale.limit_px);
    const ImageF1 phi_after = signed_distance(inside_of(from_after.matte), scale.limit_px);
    const Recti bounds = joint_bounds(phi_before, phi_after);
    const int margin = static_cast<int>(scale.band_px) + scale.window_half_px + 4;
    const Recti frame_area = rect_of(frame.size());
    const Recti area = bounds.empty() ? frame_area : bounds.grown(margin).intersected(frame_area);
    const ViewF1 shares_here = shares.view().crop(area);
    const float share = mean_share(shares_here);
    MatteEstimate merged{Matte(frame.size()), (1 - share) * known(from_before.confidence) +
                                                  share * known(from_after.confidence)};
    if (bounds.empty()) return merged;

    const JointShape joint(phi_before.view().crop(area), phi_after.view().crop(area), shares_here,
                           scale.band_px, !inside.empty());
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
                               from_after.matte.view().crop(area), joint, shares_here, options);
    for (int y = 0; y < area.height(); ++y) {
        std::copy(matte.row(y), matte.row(y) + area.width(),
                  merged.matte.pixel(area.x0, area.y0 + y));
    }
    if (confirmed) keep_single(merged.matte, from_before, from_after, shares);
    // Two independent walks that end at the same shape confirm each other.
    const auto agreement = static_cast<float>(joint.agreeing / joint.either);
    merged.confidence += (1 - merged.confidence) * agreement * agreement * agreement;
    return merged;
}

}  // namespace weft
