#include "engine/mask/shape_matte.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/core/smooth_step.h"
#include "engine/core/unsqueezed_image.h"

namespace weft {
namespace {

constexpr int kCurveSteps = 16;

Vec2 mixed(Vec2 a, Vec2 b, float t) {
    return a + (b - a) * t;
}

// de Casteljau.
Vec2 on_curve(const RotoPoint& a, const RotoPoint& b, float t) {
    const Vec2 p0 = a.at, p1 = a.at + a.out, p2 = b.at + b.in, p3 = b.at;
    const Vec2 q0 = mixed(p0, p1, t), q1 = mixed(p1, p2, t), q2 = mixed(p2, p3, t);
    return mixed(mixed(q0, q1, t), mixed(q1, q2, t), t);
}

RotoShape unsqueezed(RotoShape shape, PixelAspect aspect) {
    for (RotoPoint& p : shape.points) {
        p.at = aspect.unsqueezed(p.at);
        p.in = aspect.unsqueezed(p.in);
        p.out = aspect.unsqueezed(p.out);
    }
    return shape;
}

}  // namespace

std::vector<Vec2> outline_of(const RotoShape& shape, int steps) {
    std::vector<Vec2> out;
    const std::size_t count = shape.points.size();
    for (std::size_t k = 0; k < count; ++k)
        for (int s = 0; s < steps; ++s)
            out.push_back(on_curve(shape.points[k], shape.points[(k + 1) % count],
                                   static_cast<float>(s) / static_cast<float>(steps)));
    return out;
}

Matte polygon_matte(const std::vector<Vec2>& points, Size size) {
    Matte out(size);
    if (points.size() < 3 || size.empty()) return out;
    constexpr int kShift = 4;
    // Far beyond the frame a place is cut off: OpenCV's integers would overflow.
    constexpr float kFarPx = 1 << 18;
    const auto fixed = [&](float v) {
        const float near = v >= -kFarPx ? std::min(v, kFarPx) : -kFarPx;  // also of what is NaN
        return static_cast<int>(std::lround((near - 0.5f) * (1 << kShift)));
    };
    std::vector<cv::Point> corners;
    corners.reserve(points.size());
    for (const Vec2 p : points)
        corners.emplace_back(fixed(p.x), fixed(p.y));
    cv::Mat area(size.height, size.width, CV_8UC1, out.data());
    cv::fillPoly(area, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(255), cv::LINE_AA,
                 kShift);
    return out;
}

Matte matte_of_shape(const RotoShape& shape, Size size, PixelAspect aspect) {
    const std::vector<Vec2> outline = outline_of(shape, kCurveSteps);
    Matte out = polygon_matte(outline, size);
    float widest = 0;
    for (const RotoPoint& point : shape.points)
        widest = std::max(widest, point.feather_px);
    if (widest <= 0 || outline.size() < 3) return out;
    if (!aspect.square()) {
        Matte soft = matte_of_shape(unsqueezed(shape, aspect), aspect.unsqueezed(size));
        soft = squeezed(std::move(soft), aspect, size);
        std::transform(out.data(), out.data() + out.size_bytes(), soft.data(), out.data(),
                       [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
        return out;
    }
    // Outside the shape, the nearest curve point gives the feather width, found by a labelled
    // distance transform.
    cv::Mat curve(size.height, size.width, CV_8UC1, cv::Scalar(255)), distance, labels;
    std::vector<std::pair<cv::Point, float>> places;
    const std::size_t count = shape.points.size();
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2 from = outline[k], to = outline[(k + 1) % outline.size()];
        const float a = shape.points[k / kCurveSteps].feather_px;
        const float b = shape.points[(k / kCurveSteps + 1) % count].feather_px;
        // A shape of which most lies far away is no more than its part in the frame.
        constexpr float kMostDots = 1 << 14;
        const int dots = 1 + static_cast<int>(std::min(
                                 kMostDots, 2 * std::sqrt((to.x - from.x) * (to.x - from.x) +
                                                          (to.y - from.y) * (to.y - from.y))));
        for (int d = 0; d < dots; ++d) {
            const float part = static_cast<float>(d) / static_cast<float>(dots);
            const Vec2 p = mixed(from, to, part);
            if (!(p.x >= 0 && p.y >= 0 && p.x < static_cast<float>(size.width) &&
                  p.y < static_cast<float>(size.height)))
                continue;
            const cv::Point at(static_cast<int>(p.x), static_cast<int>(p.y));
            const float t = (static_cast<float>(k % kCurveSteps) + part) / kCurveSteps;
            curve.at<std::uint8_t>(at) = 0;
            places.emplace_back(at, a + t * (b - a));
        }
    }
    if (places.empty()) return out;
    cv::distanceTransform(curve, distance, labels, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
    std::vector<float> width_of(places.size() + 1);
    for (const auto& [at, width] : places) {
        float& kept = width_of[static_cast<std::size_t>(labels.at<int>(at))];
        kept = std::max(kept, width);
    }
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float width = width_of[static_cast<std::size_t>(labels.at<int>(y, x))];
            if (width <= 0.5f) continue;
            const float t = std::clamp(1 - distance.at<float>(y, x) / width, 0.0f, 1.0f);
            const float soft = smooth_rise(t) * 255.0f;
            out.at(x, y) = std::max(out.at(x, y), static_cast<std::uint8_t>(soft + 0.5f));
        }
    }
    return out;
}

RotoShape between(const RotoShape& a, const RotoShape& b, float t) {
    if (a.points.size() != b.points.size()) return a;
    RotoShape out = a;
    for (std::size_t k = 0; k < out.points.size(); ++k) {
        RotoPoint& p = out.points[k];
        const RotoPoint& q = b.points[k];
        p.at = mixed(p.at, q.at, t);
        p.in = mixed(p.in, q.in, t);
        p.out = mixed(p.out, q.out, t);
        p.feather_px += t * (q.feather_px - p.feather_px);
    }
    return out;
}

RotoShape smoothed(RotoShape shape) {
    const std::size_t count = shape.points.size();
    if (count < 3) return shape;
    for (std::size_t k = 0; k < count; ++k) {
        RotoPoint& p = shape.points[k];
        if (!(p.in == Vec2{0, 0}) || !(p.out == Vec2{0, 0})) continue;
        const Vec2 along =
            shape.points[(k + 1) % count].at - shape.points[(k + count - 1) % count].at;
        p.out = along * (1.0f / 6.0f);
        p.in = along * (-1.0f / 6.0f);
    }
    return shape;
}

}  // namespace weft
