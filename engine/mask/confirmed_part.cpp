#include "engine/mask/confirmed_part.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "engine/core/parallel.h"

namespace weft {
namespace {

// A walk without a known frame has no say.
float position_of(const MergePlace& place) {
    if (!place.after) return 0;
    if (!place.before) return 1;
    if (*place.after <= *place.before) return 0;  // confirmed on this frame, in both walks
    return std::clamp(static_cast<float>(place.frame - *place.before) /
                          static_cast<float>(*place.after - *place.before),
                      0.0f, 1.0f);
}

}  // namespace

Matte with_confirmed(Matte matte, const ConfirmedPart& part) {
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x)
            if (is_confirmed(part.area.at(x, y))) matte.at(x, y) = part.matte.at(x, y);
    }
    return matte;
}

void ConfirmedPlaces::add(ViewU8x1 area) {
    if (since_.empty()) since_ = FramesSince(area.size(), kNeverConfirmed);
    for (int y = 0; y < area.height(); ++y) {
        for (int x = 0; x < area.width(); ++x)
            if (is_confirmed(area.row(y)[x])) since_.at(x, y) = 0;
    }
}

void ConfirmedPlaces::move(ViewF2 prev_from_cur, const Recti& area) {
    if (since_.empty()) return;
    FramesSince moved(since_.size(), kNeverConfirmed);
    parallel_rows(area.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < area.width(); ++x) {
                const float* d = prev_from_cur.pixel(x, y);
                const auto u =
                    static_cast<int>(std::lround(static_cast<float>(area.x0 + x) + d[0]));
                const auto v =
                    static_cast<int>(std::lround(static_cast<float>(area.y0 + y) + d[1]));
                if (u < 0 || v < 0 || u >= since_.width() || v >= since_.height()) continue;
                const std::uint16_t before = since_.at(u, v);
                if (before < kNeverConfirmed - 1)
                    moved.at(area.x0 + x, area.y0 + y) = static_cast<std::uint16_t>(before + 1);
            }
        }
    });
    since_ = std::move(moved);
}

ImageF1 merge_positions(const MergePlace& place, const FramesSince& before,
                        const FramesSince& after, Size size) {
    ImageF1 positions(size, position_of(place));
    if (before.empty() && after.empty()) return positions;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const std::uint16_t b = before.empty() ? kNeverConfirmed : before.at(x, y);
            const std::uint16_t a = after.empty() ? kNeverConfirmed : after.at(x, y);
            if (b == kNeverConfirmed && a == kNeverConfirmed) continue;
            MergePlace here = place;
            if (b != kNeverConfirmed) here.before = place.frame - b;
            if (a != kNeverConfirmed) here.after = place.frame + a;
            positions.at(x, y) = position_of(here);
        }
    }
    // Where confirmed parts end, the outline must not step from one walk's to the other's.
    constexpr int kBlur_px = 9;
    cv::Mat pixels(size.height, size.width, CV_32F, positions.data(),
                   static_cast<std::size_t>(positions.stride()) * sizeof(float));
    cv::blur(pixels, pixels, {kBlur_px, kBlur_px}, {-1, -1}, cv::BORDER_REPLICATE);
    return positions;
}

}  // namespace weft
