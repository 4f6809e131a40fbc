#include "app/mattes/paint.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <opencv2/imgproc.hpp>

#include "engine/core/smooth_step.h"
#include "engine/mask/shape_matte.h"
#include "engine/motion/view_mat.h"

namespace weft {
namespace {

std::uint8_t to_code(float v) {
    return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 255.0f) + 0.5f);
}

// Falls smoothly from 1 in the core to 0 at the radius, over at least one pixel, so that a hard
// brush is anti-aliased.
float profile(float distance, float radius, float hardness) {
    const float soft = std::max(1.0f, radius * (1.0f - hardness));
    const float t = std::clamp((radius + 0.5f - distance) / soft, 0.0f, 1.0f);
    return smooth_rise(t);
}

Matte from_mat(const cv::Mat& mat) {
    Matte out(mat.cols, mat.rows);
    for (int y = 0; y < mat.rows; ++y)
        std::copy_n(mat.ptr<std::uint8_t>(y), mat.cols, out.row(y));
    return out;
}

Matte merged(const Matte& before, const cv::Mat& area, bool subtract) {
    Matte out = before;
    for (int y = 0; y < out.height(); ++y) {
        const std::uint8_t* a = area.ptr<std::uint8_t>(y);
        std::uint8_t* row = out.row(y);
        for (int x = 0; x < out.width(); ++x) {
            row[x] = subtract ? static_cast<std::uint8_t>(row[x] * (255 - a[x]) / 255)
                              : std::max(row[x], a[x]);
        }
    }
    return out;
}

// Signed distance to the edge at half coverage: positive inside.
cv::Mat signed_distance(const Matte& matte) {
    cv::Mat inside, outside, in_distance, out_distance;
    cv::threshold(as_mat(matte), inside, 127, 255, cv::THRESH_BINARY);
    cv::bitwise_not(inside, outside);
    cv::distanceTransform(inside, in_distance, cv::DIST_L2, cv::DIST_MASK_5);
    cv::distanceTransform(outside, out_distance, cv::DIST_L2, cv::DIST_MASK_5);
    return in_distance - out_distance;
}

// The columns of a row within `reach` of a line. A long slanting line touches little of its
// bounding box.
std::pair<int, int> columns_near(Vec2 from, Vec2 to, float y, Vec2 reach, Recti box) {
    float first = 0, last = 1;
    if (const float down = to.y - from.y; std::abs(down) > 1e-3f) {
        first = (y - reach.y - from.y) / down;
        last = (y + reach.y - from.y) / down;
        if (first > last) std::swap(first, last);
        first = std::clamp(first, 0.0f, 1.0f);
        last = std::clamp(last, 0.0f, 1.0f);
    }
    const float a = from.x + first * (to.x - from.x), b = from.x + last * (to.x - from.x);
    return {std::max(box.x0, static_cast<int>(std::floor(std::min(a, b) - reach.x))),
            std::min(box.x1, static_cast<int>(std::ceil(std::max(a, b) + reach.x)))};
}

}  // namespace

Stroke::Stroke(std::shared_ptr<const Matte> before, const Brush& brush)
    : before_(std::move(before)),
      coverage_(static_cast<std::uint8_t*>(
          std::calloc(std::max<std::size_t>(1, before_->size_bytes()), 1))),
      brush_(brush) {
    if (!coverage_) throw std::bad_alloc();
}

Matte Stroke::covered() const {
    Matte out(before_->size());
    for (int y = touched_.y0; y < touched_.y1; ++y) {
        const std::uint8_t* row =
            coverage_.get() + static_cast<std::size_t>(y) * static_cast<std::size_t>(out.width());
        for (int x = touched_.x0; x < touched_.x1; ++x)
            out.at(x, y) = row[x] > 0 ? 255 : 0;
    }
    return out;
}

Recti Stroke::move_to(Vec2 to, float pressure, Matte& matte) {
    const float press = std::clamp(pressure, 0.05f, 1.0f);
    const float radius = std::max(0.5f, brush_.radius_px * (brush_.pressure_size ? press : 1.0f));
    const float strength = brush_.pressure_opacity ? press : 1.0f;
    const float from_strength = last_ ? last_pressure_ : strength;
    const Vec2 from = last_.value_or(to);
    const float from_radius = last_ ? last_radius_ : radius;
    last_ = to;
    last_radius_ = radius;
    last_pressure_ = strength;
    const PixelAspect aspect = brush_.aspect;
    const float widest = std::max(radius, from_radius);
    const Vec2 reach = aspect.squeezed(Vec2(widest, widest)) + 2.0f;
    const Recti box = Recti{static_cast<int>(std::floor(std::min(from.x, to.x) - reach.x)),
                            static_cast<int>(std::floor(std::min(from.y, to.y) - reach.y)),
                            static_cast<int>(std::ceil(std::max(from.x, to.x) + reach.x)),
                            static_cast<int>(std::ceil(std::max(from.y, to.y) + reach.y))}
                          .intersected(rect_of(matte.size()));
    const Vec2 along = aspect.unsqueezed(to - from);
    const float length2 = along.x * along.x + along.y * along.y;
    const float target = brush_.subtract ? 0.0f : 255.0f;
    for (int y = box.y0; y < box.y1; ++y) {
        const auto [x0, x1] = columns_near(from, to, static_cast<float>(y) + 0.5f, reach, box);
        std::uint8_t* covered =
            coverage_.get() + static_cast<std::size_t>(y) * static_cast<std::size_t>(matte.width());
        for (int x = x0; x < x1; ++x) {
            const Vec2 p =
                aspect.unsqueezed(Vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f - from);
            const float t = length2 > 0
                                ? std::clamp((p.x * along.x + p.y * along.y) / length2, 0.0f, 1.0f)
                                : 0.0f;
            const float dx = p.x - t * along.x, dy = p.y - t * along.y;
            const float r = from_radius + t * (radius - from_radius);
            const float s = from_strength + t * (strength - from_strength);
            const auto cover =
                to_code(255.0f * s * profile(std::sqrt(dx * dx + dy * dy), r, brush_.hardness));
            std::uint8_t& known = covered[x];
            if (cover <= known) continue;
            known = cover;
            const auto base = static_cast<float>(before_->at(x, y));
            matte.at(x, y) = to_code(base + (target - base) * brush_.opacity *
                                                static_cast<float>(cover) / 255.0f);
        }
    }
    touched_ = touched_.united(box);
    return box;
}

Matte fill_polygon(const Matte& before, const std::vector<Vec2>& points, bool subtract) {
    if (points.size() < 3) return before;
    return merged(before, as_mat(polygon_matte(points, before.size())), subtract);
}

Matte flood_select(const Matte& before, ViewU8x3 picture, Vec2i seed, int tolerance,
                   bool subtract) {
    if (picture.size() != before.size() || !rect_of(before.size()).contains(seed.x, seed.y))
        return before;
    cv::Mat colours(picture.height(), picture.width(), CV_8UC3,
                    const_cast<std::uint8_t*>(picture.data()),
                    static_cast<std::size_t>(picture.stride()));
    cv::Mat area = cv::Mat::zeros(picture.height() + 2, picture.width() + 2, CV_8UC1);
    const cv::Scalar spread = cv::Scalar::all(tolerance);
    constexpr int kFill = 255 << 8;
    cv::floodFill(colours, area, {seed.x, seed.y}, {}, nullptr, spread, spread,
                  4 | kFill | cv::FLOODFILL_FIXED_RANGE | cv::FLOODFILL_MASK_ONLY);
    cv::Mat inner = area(cv::Rect(1, 1, picture.width(), picture.height())).clone();
    // Closes pinholes from noise, and smooths the stair-stepped edge.
    cv::morphologyEx(inner, inner, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
    cv::GaussianBlur(inner, inner, {3, 3}, 0);
    return merged(before, inner, subtract);
}

Matte changed_area(const Matte& before, const Matte& after) {
    constexpr int kAround_px = 4;
    cv::Mat changed, wide;
    cv::compare(as_mat(before), as_mat(after), changed, cv::CMP_NE);
    cv::dilate(
        changed, wide,
        cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kAround_px + 1, 2 * kAround_px + 1}));
    return from_mat(wide);
}

Matte grow_matte(const Matte& before, float px) {
    const cv::Mat distance = signed_distance(before);
    cv::Mat codes;
    distance.convertTo(codes, CV_8UC1, 255.0, (px + 0.5) * 255.0);
    return from_mat(codes);
}

Matte feather_matte(const Matte& before, float px) {
    if (px <= 0) return before;
    cv::Mat soft;
    cv::GaussianBlur(as_mat(before), soft, {0, 0}, px * 0.5);
    return from_mat(soft);
}

}  // namespace weft
