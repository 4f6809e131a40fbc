#include "engine/motion/outline_shape.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "engine/motion/view_mat.h"

namespace weft {
namespace {

constexpr float kWidest_px = 24;

// The luma's lines and tones inside, smoothed, in units of a line's contrast.
cv::Mat ink_of(const cv::Mat& light, const cv::Mat& share, float sigma) {
    constexpr float kInk = 20, kMostInk = 1.5f;  // levels that count as 1; the most
    constexpr float kNone = 1e-3f;
    cv::Mat near, near_share, wide, wide_share;
    const double surroundings = 4.0 * sigma + 6.0;
    cv::GaussianBlur(light, near, {0, 0}, sigma);
    cv::GaussianBlur(share, near_share, {0, 0}, sigma);
    cv::GaussianBlur(light, wide, {0, 0}, surroundings);
    cv::GaussianBlur(share, wide_share, {0, 0}, surroundings);
    cv::Mat ink(light.size(), CV_32F);
    for (int y = 0; y < ink.rows; ++y) {
        const auto *n = near.ptr<float>(y), *ns = near_share.ptr<float>(y);
        const auto *w = wide.ptr<float>(y), *ws = wide_share.ptr<float>(y);
        auto* out = ink.ptr<float>(y);
        for (int x = 0; x < ink.cols; ++x) {
            const float v = n[x] / (ns[x] + kNone) - w[x] / (ws[x] + kNone);
            out[x] = std::clamp(v / kInk, -kMostInk, kMostInk);
        }
    }
    return ink;
}

}  // namespace

struct OutlineShape::State {
    Size frame;
    cv::Rect box;
    Vec2 middle{0};  // of the extent, px
    float area = 0;  // px
    OutlineCurve curve;
    cv::Mat distance;              // signed, positive inside
    cv::Mat open;                  // visible, away from holdouts
    cv::Mat light, share;          // luma where open, and 1 there
    std::mutex making;             // guards what follows; std::map's values stay where they are
    std::map<float, cv::Mat> ink;  // by σ, px
    std::map<std::pair<float, float>, RegistrationPicture> pictures;
};

OutlineShape::OutlineShape(const OutlineView& view) : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.frame = view.extent.size();
    const cv::Mat all = as_mat(view.extent) >= 128;
    s.box = cv::boundingRect(all);
    if (s.box.empty()) return;
    s.curve = outline_curve(view.extent);
    const int margin = static_cast<int>(kWidest_px) + 2;
    s.box -= cv::Point(margin, margin);
    s.box += cv::Size(2 * margin, 2 * margin);
    s.box &= cv::Rect(0, 0, view.extent.width(), view.extent.height());
    const cv::Mat inside = all(s.box), outside = ~inside;
    const cv::Moments moments = cv::moments(inside, true);
    s.area = static_cast<float>(moments.m00);
    s.middle = Vec2(static_cast<float>(moments.m10 / moments.m00 + s.box.x + 0.5),
                    static_cast<float>(moments.m01 / moments.m00 + s.box.y + 0.5));
    cv::Mat away;
    cv::distanceTransform(inside, s.distance, cv::DIST_L2, 5);
    cv::distanceTransform(outside, away, cv::DIST_L2, 5);
    s.distance -= away;
    // The ink of an occluder covers the surface beside it.
    s.open = as_mat(view.visible)(s.box) >= 250;
    cv::erode(s.open, s.open, cv::getStructuringElement(cv::MORPH_ELLIPSE, {7, 7}));
    s.open.convertTo(s.share, CV_32F, 1.0 / 255);
    as_mat(view.luma)(s.box).convertTo(s.light, CV_32F);
    s.light = s.light.mul(s.share);
}

OutlineShape::~OutlineShape() = default;
OutlineShape::OutlineShape(OutlineShape&&) noexcept = default;
OutlineShape& OutlineShape::operator=(OutlineShape&&) noexcept = default;

bool OutlineShape::empty() const {
    return state_->box.empty();
}

Size OutlineShape::frame_size() const {
    return state_->frame;
}

const OutlineCurve& OutlineShape::curve() const {
    return state_->curve;
}

Vec2 OutlineShape::middle() const {
    return state_->middle;
}

float OutlineShape::area_px() const {
    return state_->area;
}

const RegistrationPicture& OutlineShape::picture(float band_px, float sigma_px) const {
    constexpr float kDistance_px = 6;  // that counts as 1
    State& s = *state_;
    const std::lock_guard lock(s.making);
    const auto [kept, is_new] = s.pictures.try_emplace({band_px, sigma_px});
    RegistrationPicture& out = kept->second;
    if (!is_new || s.box.empty()) return out;
    cv::Mat& ink = s.ink[sigma_px];
    if (ink.empty()) ink = ink_of(s.light, s.share, sigma_px);
    out.area = {s.box.x, s.box.y, s.box.x + s.box.width, s.box.y + s.box.height};
    out.value = ImageF1(s.box.width, s.box.height);
    out.inside = ImageF1(s.box.width, s.box.height);
    for (int y = 0; y < s.box.height; ++y) {
        const auto *distance = s.distance.ptr<float>(y), *tone = ink.ptr<float>(y);
        const auto* open = s.open.ptr<std::uint8_t>(y);
        for (int x = 0; x < s.box.width; ++x) {
            const float d = distance[x];
            float value = (std::clamp(d, -band_px, band_px) - band_px) / kDistance_px;
            bool compared = std::abs(d) < band_px;
            if (d >= band_px && open[x] != 0) {
                value += tone[x];
                compared = true;
            }
            out.value.row(y)[x] = value;
            out.inside.row(y)[x] = compared ? 1.0f : 0.0f;
        }
    }
    return out;
}

}  // namespace weft
