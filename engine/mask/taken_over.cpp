#include "engine/mask/taken_over.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "engine/mask/signed_distance.h"

namespace weft {

Matte differing(const Matte& inside, const ImageF1& distance) {
    Matte out(inside.size());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y) = (distance.at(x, y) > 0) == (inside.at(x, y) != 0) ? 0 : 255;
    return out;
}

void take_over(const Matte& inside, float limit_px, ImageF1& distance, Matte& matte) {
    constexpr float kBeside_px = 2;
    const ImageF1 found = smooth_distance(signed_distance(inside, limit_px), 1);
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            const bool as_before = (distance.at(x, y) > 0) == (inside.at(x, y) != 0);
            if (as_before && std::abs(distance.at(x, y) - found.at(x, y)) < kBeside_px) continue;
            distance.at(x, y) = found.at(x, y);
            matte.at(x, y) = static_cast<std::uint8_t>(
                std::lround(255 * std::clamp(0.5f + found.at(x, y), 0.0f, 1.0f)));
        }
    }
}

void add_pieces(const Matte& pieces, Matte& matte) {
    const int w = matte.width(), h = matte.height();
    const auto joins = [&](int x, int y) {
        return pieces.at(x * pieces.width() / w, y * pieces.height() / h) != 0;
    };
    cv::Mat inside(h, w, CV_32F), near(h, w, CV_8U, cv::Scalar(0));
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const bool piece = joins(x, y);
            inside.at<float>(y, x) = piece ? 1.0f : static_cast<float>(matte.at(x, y)) / 255;
            if (piece) near.at<std::uint8_t>(y, x) = 255;
        }
    }
    if (cv::countNonZero(near) == 0) return;
    // The steps of its blocks are smoothed, to an edge of two pixels.
    const int block = std::max(1, (w + pieces.width() / 2) / pieces.width());
    const int side = 2 * block + 1;
    cv::blur(inside, inside, {side, side});
    cv::blur(inside, inside, {side, side});
    cv::dilate(near, near, cv::Mat::ones(side, side, CV_8U));
    const float steep = 0.75f * static_cast<float>(side);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            if (near.at<std::uint8_t>(y, x) == 0) continue;
            const float share =
                std::clamp(0.5f + steep * (inside.at<float>(y, x) - 0.5f), 0.0f, 1.0f);
            matte.at(x, y) =
                std::max(matte.at(x, y), static_cast<std::uint8_t>(std::lround(255 * share)));
        }
    }
}

Matte inside_without(ViewF1 distance, const Matte& pieces) {
    Matte out(distance.size());
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y) = distance.row(y)[x] > 0 && pieces.at(x, y) == 0 ? 255 : 0;
    }
    return out;
}

}  // namespace weft
