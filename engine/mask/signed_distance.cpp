#include "engine/mask/signed_distance.h"

#include <algorithm>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/core/parallel.h"

namespace weft {

Image<std::uint8_t, 1> inside_of(ViewU8x1 matte) {
    Image<std::uint8_t, 1> inside(matte.size());
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x)
            inside.row(y)[x] = matte.row(y)[x] >= 128 ? 1 : 0;
    }
    return inside;
}

ImageF1 signed_distance(ViewU8x1 inside, float limit_px) {
    ImageF1 phi(inside.size());
    if (phi.empty()) return phi;
    cv::Mat in(inside.height(), inside.width(), CV_8U);
    cv::Mat out(inside.height(), inside.width(), CV_8U);
    for (int y = 0; y < inside.height(); ++y) {
        for (int x = 0; x < inside.width(); ++x) {
            const bool is_inside = inside.row(y)[x] != 0;
            in.ptr<std::uint8_t>(y)[x] = is_inside ? 1 : 0;
            out.ptr<std::uint8_t>(y)[x] = is_inside ? 0 : 1;
        }
    }
    cv::Mat to_outside, to_inside;
    parallel_for(2, [&](std::size_t side) {
        cv::distanceTransform(side == 0 ? in : out, side == 0 ? to_outside : to_inside, cv::DIST_L2,
                              5, CV_32F);
    });
    for (int y = 0; y < inside.height(); ++y) {
        const auto* a = to_outside.ptr<float>(y);
        const auto* b = to_inside.ptr<float>(y);
        float* p = phi.row(y);
        for (int x = 0; x < inside.width(); ++x) {
            p[x] = a[x] > 0 ? std::min(a[x] - 0.5f, limit_px) : std::max(0.5f - b[x], -limit_px);
        }
    }
    return phi;
}

ImageF1 smooth_distance(ViewF1 phi, int passes) {
    ImageF1 result(phi.size());
    for (int y = 0; y < phi.height(); ++y) {
        std::copy(phi.row(y), phi.row(y) + phi.width(), result.row(y));
    }
    if (phi.width() < 2 || phi.height() < 2) return result;
    ImageF1 across(phi.size());
    const int w = phi.width(), h = phi.height();
    for (int pass = 0; pass < passes; ++pass) {
        parallel_rows(h, 32, [&](int y0, int y1) {
            for (int y = y0; y < y1; ++y) {
                const float* s = result.row(y);
                float* d = across.row(y);
                for (int x = 1; x + 1 < w; ++x) {
                    d[x] = 0.25f * (s[x - 1] + s[x + 1]) + 0.5f * s[x];
                }
                d[0] = 0.75f * s[0] + 0.25f * s[1];
                d[w - 1] = 0.75f * s[w - 1] + 0.25f * s[w - 2];
            }
        });
        parallel_rows(h, 32, [&](int y0, int y1) {
            for (int y = y0; y < y1; ++y) {
                const float* a = across.row(std::max(0, y - 1));
                const float* b = across.row(y);
                const float* c = across.row(std::min(h - 1, y + 1));
                float* d = result.row(y);
                for (int x = 0; x < w; ++x)
                    d[x] = 0.25f * (a[x] + c[x]) + 0.5f * b[x];
            }
        });
    }
    return result;
}

double area_of(ViewF1 phi) {
    double count = 0;
    for (int y = 0; y < phi.height(); ++y)
        count += static_cast<double>(
            std::count_if(phi.row(y), phi.row(y) + phi.width(), [](float d) { return d > 0; }));
    return count;
}

}  // namespace weft
