#include "engine/mask/taken_over.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "engine/core/geometry.h"
#include "engine/mask/matte_box.h"
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
    const Recti bounds = pieces.empty() ? Recti() : matte_box(pieces, 1);
    if (bounds.empty()) return;
    const int w = matte.width(), h = matte.height(), pw = pieces.width(), ph = pieces.height();
    const int block = std::max(1, (w + pw / 2) / pw), side = 2 * block + 1;
    const Recti box = Recti{bounds.x0 * w / pw, bounds.y0 * h / ph, (bounds.x1 * w + pw - 1) / pw,
                            (bounds.y1 * h + ph - 1) / ph}
                          .grown(2 * side)
                          .intersected(rect_of(matte.size()));
    cv::Mat inside(box.height(), box.width(), CV_32F), near(inside.size(), CV_8U, cv::Scalar(0));
    for (int y = 0; y < inside.rows; ++y) {
        for (int x = 0; x < inside.cols; ++x) {
            const Vec2i at(box.x0 + x, box.y0 + y);
            const bool joins = pieces.at(at.x * pw / w, at.y * ph / h) != 0;
            inside.at<float>(y, x) = joins ? 1.0f : static_cast<float>(matte.at(at.x, at.y)) / 255;
            if (joins) near.at<std::uint8_t>(y, x) = 255;
        }
    }
    // The steps of its blocks are smoothed, to an edge of two pixels.
    cv::blur(inside, inside, {side, side});
    cv::blur(inside, inside, {side, side});
    cv::dilate(near, near, cv::Mat::ones(side, side, CV_8U));
    const float steep = 0.75f * static_cast<float>(side);
    for (int y = 0; y < inside.rows; ++y) {
        for (int x = 0; x < inside.cols; ++x) {
            if (near.at<std::uint8_t>(y, x) == 0) continue;
            const float share =
                std::clamp(0.5f + steep * (inside.at<float>(y, x) - 0.5f), 0.0f, 1.0f);
            std::uint8_t& code = matte.at(box.x0 + x, box.y0 + y);
            code = std::max(code, static_cast<std::uint8_t>(std::lround(255 * share)));
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

Matte inside_with(ViewF1 distance, const Matte& pieces) {
    Matte out(distance.size());
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y) = distance.row(y)[x] > 0 || pieces.at(x, y) != 0 ? 255 : 0;
    }
    return out;
}

}  // namespace weft
