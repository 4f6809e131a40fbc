#include "engine/mask/spread_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr std::array<float, 3> kRadiiPx = {4, 12, 40};  // at 854×480
constexpr float kWiderWeight = 0.03f;  // weight of each wider radius against the one before

}  // namespace

ImageF2 spread_motion(ViewF2 motion, ViewF1 weight, Vec2 fallback, float unit_px) {
    const int w = motion.width(), h = motion.height();
    cv::Mat weighted(h, w, CV_32FC3);
    for (int y = 0; y < h; ++y) {
        auto* out = weighted.ptr<cv::Vec3f>(y);
        for (int x = 0; x < w; ++x) {
            const float known = weight.row(y)[x];
            const float* d = motion.pixel(x, y);
            out[x] = cv::Vec3f(known, known * d[0], known * d[1]);
        }
    }
    std::vector<cv::Mat> blurred;
    for (const float radius : kRadiiPx) {
        const int r = std::max(1, static_cast<int>(std::lround(radius * unit_px)));
        cv::Mat b;
        cv::boxFilter(weighted, b, CV_32F, cv::Size(2 * r + 1, 2 * r + 1), cv::Point(-1, -1), true,
                      cv::BORDER_REPLICATE);
        blurred.push_back(b);
    }
    const std::array<float, 3> say = {1.0f, kWiderWeight, kWiderWeight * kWiderWeight};
    ImageF2 out(w, h);
    parallel_rows(h, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < w; ++x) {
                Vec2 sum = fallback * 1e-7f;
                float total = 1e-7f;
                for (std::size_t i = 0; i < blurred.size(); ++i) {
                    const auto& v = blurred[i].at<cv::Vec3f>(y, x);
                    sum += say[i] * Vec2(v[1], v[2]);
                    total += say[i] * v[0];
                }
                out.pixel(x, y)[0] = sum.x / total;
                out.pixel(x, y)[1] = sum.y / total;
            }
        }
    });
    return out;
}

}  // namespace weft
