#include "engine/mask/growth_evidence.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/core/parallel.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr int kUnknown = 3 * 255 + 1;
// Colours as foreign as the rarest tenth of the surface's own are not held against a pixel. Beyond
// them the plate's word for inside loses its weight over kForeignRange, and from kForeignFrom on
// the colour speaks against inside: it is known, and of something else.
constexpr float kRareShare = 0.1f;
constexpr float kForeignRange = 2, kForeignFrom = 1.5f, kForeignWeight = 0.5f;

// Difference, summed over channels, of a pixel and the most similar one of the surface around where
// it was.
int least_difference(const GrowthInput& in, const std::uint8_t* c, Vec2i at) {
    int least = kUnknown;
    const int u0 = std::max(0, at.x - 1), u1 = std::min(in.prev_frame.width() - 1, at.x + 1);
    for (int v = std::max(0, at.y - 1); v <= std::min(in.prev_frame.height() - 1, at.y + 1); ++v) {
        for (int u = u0; u <= u1; ++u) {
            if (in.prev_phi.row(v)[u] <= 0) continue;
            const std::uint8_t* p = in.prev_frame.pixel(u, v);
            least = std::min(least,
                             std::abs(c[0] - p[0]) + std::abs(c[1] - p[1]) + std::abs(c[2] - p[2]));
        }
    }
    return least;
}

}  // namespace

ImageF1 surface_difference(const GrowthInput& in, const SurfacePalette& palette, float reach_px) {
    const int w = in.frame.width(), h = in.frame.height();
    cv::Mat sums(h, w, CV_32FC2, cv::Scalar::all(0));
    parallel_rows(h, 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < w; ++x) {
                if (in.expected_phi.row(y)[x] < -reach_px) continue;
                if (palette.odds(in.frame.pixel(x, y)) < 0) continue;
                const float* d = in.surface_motion.pixel(x, y);
                const Vec2i at(
                    static_cast<int>(std::lround(static_cast<float>(in.area.x0 + x) + d[0])),
                    static_cast<int>(std::lround(static_cast<float>(in.area.y0 + y) + d[1])));
                const int least = least_difference(in, in.frame.pixel(x, y), at);
                if (least == kUnknown) continue;
                sums.at<cv::Vec2f>(y, x) = cv::Vec2f(1, static_cast<float>(least) / 3);
            }
        }
    });
    cv::Mat patch;
    cv::boxFilter(sums, patch, CV_32F, cv::Size(3, 3), cv::Point(-1, -1), false);
    ImageF1 difference(in.frame.size(), -1.0f);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const auto& p = patch.at<cv::Vec2f>(y, x);
            if (sums.at<cv::Vec2f>(y, x)[0] > 0) difference.at(x, y) = p[1] / p[0];
        }
    }
    return difference;
}

void limit_growth(ImageF1& plate_odds, const GrowthInput& in, const SurfacePalette& palette,
                  float far_px) {
    const int w = in.frame.width(), h = in.frame.height();
    const float usual = std::min(0.0f, palette.own_odds(kRareShare));
    parallel_rows(h, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const int fy = in.area.y0 + y;
            for (int x = 0; x < w; ++x) {
                const int fx = in.area.x0 + x;
                float& odds = plate_odds.at(x, y);
                const float color = palette.odds(in.frame.pixel(x, y)) - usual;
                if (odds > 0) odds *= std::clamp(1 + color / kForeignRange, 0.0f, 1.0f);
                const float against = kForeignWeight * std::min(0.0f, color + kForeignFrom);
                odds = std::max(odds + against, std::min(odds, -kForeignWeight));
                if (odds <= 0 || in.flow->valid.row(fy)[fx] == 0) continue;
                const float* d = in.flow->d.pixel(fx, fy);
                const float was = sample_bilinear(in.prev_phi, static_cast<float>(fx) + d[0],
                                                  static_cast<float>(fy) + d[1]);
                if (was < -far_px) odds = 0;
            }
        }
    });
}

}  // namespace weft
