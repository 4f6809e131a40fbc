#include "engine/metrics/measuring_motion.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/optflow.hpp>
#include <opencv2/video/tracking.hpp>

#include "engine/core/parallel.h"
#include "engine/metrics/motion_chain.h"
#include "engine/metrics/region.h"

namespace weft {
namespace {

constexpr int kContextPx = 48;
constexpr int kLeastSidePx = 64;  // The estimators' pyramids need some room.
constexpr float kTolerancePx = 0.5f;
constexpr float kToleranceOfWay = 0.05f;

Recti bounds(ViewU8x1 matte) {
    Recti box;
    for (int y = 0; y < matte.height(); ++y) {
        const std::uint8_t* row = matte.row(y);
        for (int x = 0; x < matte.width(); ++x) {
            if (row[x] != 0) box = box.united({x, y, x + 1, y + 1});
        }
    }
    return box;
}

cv::Mat quantised(ViewF1 luma, const Recti& box) {
    cv::Mat out(box.height(), box.width(), CV_8U);
    for (int y = 0; y < box.height(); ++y) {
        const float* in = luma.pixel(box.x0, box.y0 + y);
        auto* o = out.ptr<std::uint8_t>(y);
        for (int x = 0; x < box.width(); ++x) {
            o[x] = std::isfinite(in[x])
                       ? static_cast<std::uint8_t>(std::clamp(in[x] + 0.5f, 0.0f, 255.0f))
                       : std::uint8_t{0};
        }
    }
    return out;
}

cv::Mat farneback(const cv::Mat& from, const cv::Mat& to) {
    cv::Mat flow;
    cv::calcOpticalFlowFarneback(from, to, flow, 0.5, 5, 15, 5, 5, 1.1, 0);
    return flow;
}

cv::Mat deep_flow(const cv::Mat& from, const cv::Mat& to) {
    cv::Mat flow;
    cv::optflow::createOptFlow_DeepFlow()->calc(from, to, flow);
    return flow;
}

FlowField to_field(const cv::Mat& flow) {
    FlowField f(Size{flow.cols, flow.rows});
    for (int y = 0; y < flow.rows; ++y)
        std::copy_n(flow.ptr<float>(y), 2 * flow.cols, f.d.row(y));
    return f;
}

bool returns(const FlowField& there, const FlowField& back, const Matte& all, int x, int y) {
    const Vec2 d(there.d.at(x, y, 0), there.d.at(x, y, 1));
    const Vec2 p = Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) + d;
    if (!(p.x >= 0 && p.y >= 0 && p.x < static_cast<float>(all.width()) &&
          p.y < static_cast<float>(all.height())))
        return false;
    Vec2 b;
    if (!lookup_motion(back, all, p, b)) return false;
    return std::hypot(d.x + b.x, d.y + b.y) <=
           kTolerancePx + kToleranceOfWay * std::hypot(d.x, d.y);
}

}  // namespace

const char* name_of(MeasuringEstimator estimator) {
    return estimator == MeasuringEstimator::kDeepFlow ? "deepflow" : "farneback";
}

FlowField measuring_motion(ViewF1 earlier_luma, ViewF1 later_luma, ViewU8x1 earlier_matte,
                           ViewU8x1 later_matte, MeasuringEstimator estimator, int beyond_px) {
    FlowField out(earlier_luma.size());
    out.valid = Matte(out.size(), 0);
    const Recti seen = bounds(earlier_matte);
    if (seen.empty() || bounds(later_matte).empty()) return out;
    const Recti both = seen.united(bounds(later_matte));
    const int more = std::max(0, (kLeastSidePx - std::min(both.width(), both.height()) + 1) / 2);
    const Recti box = both.grown(std::max(kContextPx, more)).intersected(rect_of(out.size()));
    const cv::Mat earlier = quantised(earlier_luma, box);
    const cv::Mat later = quantised(later_luma, box);

    FlowField there;
    FlowField back;
    const auto estimate = estimator == MeasuringEstimator::kFarneback ? farneback : deep_flow;
    parallel_for(2, [&](std::size_t i) {
        if (i == 0)
            there = to_field(estimate(earlier, later));
        else
            back = to_field(estimate(later, earlier));
    });
    const Matte all(there.size(), 255);
    const Matte judged = beyond_px > 0 ? grown_cover(earlier_matte, beyond_px) : Matte();
    const ViewU8x1 inside = beyond_px > 0 ? judged.view() : earlier_matte;
    parallel_rows(box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            std::copy_n(there.d.row(y), 2 * box.width(), out.d.pixel(box.x0, box.y0 + y));
            for (int x = 0; x < box.width(); ++x) {
                if (inside.at(box.x0 + x, box.y0 + y) != 0 && returns(there, back, all, x, y))
                    out.valid.at(box.x0 + x, box.y0 + y) = 255;
            }
        }
    });
    return out;
}

}  // namespace weft
