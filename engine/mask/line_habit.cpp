#include "engine/mask/line_habit.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace weft {
namespace {

// Distances from the pixels of lines to the nearest fill of a side, px.
cv::Mat distance_to(const FillSides& sides, std::uint8_t side) {
    cv::Mat away(sides.height(), sides.width(), CV_8U), distance;
    for (int y = 0; y < sides.height(); ++y) {
        for (int x = 0; x < sides.width(); ++x)
            away.at<std::uint8_t>(y, x) = sides.at(x, y) == side ? 0 : 255;
    }
    cv::distanceTransform(away, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    return distance;
}

struct Place {
    bool near = false, rim = false;  // near: within reach
    std::size_t step = 0;            // of the distance from the surface's nearest fill
};

Place place_of(float to_own, float to_other, std::size_t reach) {
    constexpr float kBetween_px = 3;  // so much further away, another fill is across a fill
    Place out;
    out.step = static_cast<std::size_t>(std::max(1.0f, std::min(to_own, 1000.0f) + 0.5f)) - 1;
    out.near = out.step < reach;
    out.rim = to_other < to_own + kBetween_px;
    return out;
}

}  // namespace

LineHabit::LineHabit(const FillSides& sides, ViewF1 phi) {
    const cv::Mat own = distance_to(sides, 1), other = distance_to(sides, 2);
    for (int y = 0; y < sides.height(); ++y) {
        for (int x = 0; x < sides.width(); ++x) {
            if (sides.at(x, y) != 0) continue;
            const Place at = place_of(own.at<float>(y, x), other.at<float>(y, x), kReach);
            if (!at.near) continue;
            Counts& counts = at.rim ? at_the_rim_ : within_;
            ++counts.all[at.step];
            counts.inside[at.step] += phi.row(y)[x] > 0;
        }
    }
}

Matte LineHabit::complete(const FillSides& sides) const {
    constexpr int kEnough = 12;  // px on the keyframe
    const cv::Mat own = distance_to(sides, 1), other = distance_to(sides, 2);
    Matte out(sides.size());
    for (int y = 0; y < sides.height(); ++y) {
        for (int x = 0; x < sides.width(); ++x) {
            if (sides.at(x, y) != 0) {
                out.at(x, y) = sides.at(x, y) == 1 ? 1 : 0;
                continue;
            }
            const float to_own = own.at<float>(y, x), to_other = other.at<float>(y, x);
            const Place at = place_of(to_own, to_other, kReach);
            if (!at.near) continue;
            const Counts& counts = at.rim ? at_the_rim_ : within_;
            // At corners lines reach a little further than beside fills.
            const std::size_t step =
                counts.all[at.step] < kEnough && at.step > 0 ? at.step - 1 : at.step;
            const bool inside = counts.all[step] >= kEnough
                                    ? 2 * counts.inside[step] > counts.all[step]
                                    : to_own <= to_other;
            out.at(x, y) = inside ? 1 : 0;
        }
    }
    return out;
}

}  // namespace weft
