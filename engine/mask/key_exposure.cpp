#include "engine/mask/key_exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/mask/copy_of.h"

namespace weft {
namespace {

constexpr float kDarkest = 12, kBrightest = 235;  // codes between which a ratio tells
constexpr float kUnseen = 0.05f;                  // natural logarithm: too little to be undone
using Curve = std::array<std::uint8_t, 256>;

// How much of a gain a camera's curve leaves at a code: measured on film that grew four times as
// bright, where 55 became 110, 78 became 140 and 187 became 245.
float share_at(float code) {
    constexpr float kTakenAtWhite = 0.6f;
    return 1 - kTakenAtWhite * code * code / (255 * 255);
}

Curve curve_of(float change) {
    const float undone = std::copysign(std::max(std::abs(change) - kUnseen, 0.0f), -change);
    Curve curve{};
    float highest = 0;
    for (std::size_t code = 0; code < curve.size(); ++code) {
        const auto c = static_cast<float>(code);
        highest = std::clamp(c * std::exp(undone * share_at(c)), highest, 255.0f);
        curve[code] = static_cast<std::uint8_t>(std::lround(highest));
    }
    return curve;
}

void recode(const std::array<Curve, 3>& curves, ImageU8x3& frame) {
    for (int y = 0; y < frame.height(); ++y) {
        std::uint8_t* p = frame.row(y);
        for (int x = 0; x < frame.width(); ++x, p += 3)
            for (std::size_t c = 0; c < 3; ++c)
                p[c] = curves[c][p[c]];
    }
}

// The means about each pixel, in which noise hardly counts.
ImageU8x3 local_means(ImageU8x3& frame, int side) {
    ImageU8x3 out(frame.size());
    const cv::Mat from(frame.height(), frame.width(), CV_8UC3, frame.row(0));
    cv::Mat to(frame.height(), frame.width(), CV_8UC3, out.row(0));
    cv::blur(from, to, {side, side});
    return out;
}

// By how much the whole picture changed: the median, if three quarters changed the same way.
float common_change(std::vector<float>& changes) {
    constexpr std::size_t kFewest = 64;
    if (changes.size() < kFewest) return 0;
    const auto at = [&](std::size_t quarter) {
        const auto place =
            changes.begin() + static_cast<std::ptrdiff_t>(changes.size() * quarter / 4);
        std::nth_element(changes.begin(), place, changes.end());
        return *place;
    };
    return at(1) * at(3) > 0 ? at(2) : 0;
}

}  // namespace

ImageU8x3 KeyExposure::evened(ViewU8x3 frame, ViewU8x3 before, const FlowField& prev_from_cur) {
    constexpr int kStep = 8;  // pixels
    std::array<Curve, 3> curves{};
    std::ranges::transform(change_, curves.begin(), curve_of);
    ImageU8x3 now = copy_of(frame);
    recode(curves, now);
    ImageU8x3 was = copy_of(before);
    const ImageU8x3 mean_now = local_means(now, kStep), mean_before = local_means(was, kStep);
    std::array<std::vector<float>, 3> changes;
    for (int y = kStep / 2; y < frame.height(); y += kStep) {
        for (int x = kStep / 2; x < frame.width(); x += kStep) {
            if (prev_from_cur.valid.row(y)[x] == 0) continue;
            const float* d = prev_from_cur.d.pixel(x, y);
            const int px = static_cast<int>(std::lround(static_cast<float>(x) + d[0]));
            const int py = static_cast<int>(std::lround(static_cast<float>(y) + d[1]));
            if (px < 0 || py < 0 || px >= frame.width() || py >= frame.height()) continue;
            for (int c = 0; c < 3; ++c) {
                const float is = mean_now.pixel(x, y)[c], of = mean_before.pixel(px, py)[c];
                if (std::min(is, of) < kDarkest || std::max(is, of) > kBrightest) continue;
                changes[static_cast<std::size_t>(c)].push_back(std::log(is / of) / share_at(is));
            }
        }
    }
    bool any = false;
    for (std::size_t c = 0; c < 3; ++c) {
        const float step = common_change(changes[c]);
        any |= step != 0;
        change_[c] += step;
    }
    if (!any) return now;
    std::ranges::transform(change_, curves.begin(), curve_of);
    ImageU8x3 out = copy_of(frame);
    recode(curves, out);
    return out;
}

}  // namespace weft
