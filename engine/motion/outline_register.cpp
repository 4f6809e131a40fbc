#include "engine/motion/outline_register.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "engine/motion/photometric_register.h"

namespace weft {
namespace {

cv::Mat as_mat(ViewU8x1 v) {
    return {v.height(), v.width(), CV_8UC1, const_cast<std::uint8_t*>(v.data()),
            static_cast<std::size_t>(v.stride())};
}

constexpr float kWidest_px = 24;

// What all pictures of a frame are computed from.
struct Shape {
    cv::Rect box;
    cv::Mat distance;      // signed, positive inside
    cv::Mat open;          // visible, away from holdouts
    cv::Mat light, share;  // luma where open, and 1 there

    explicit Shape(const OutlineView& view) {
        const cv::Mat all = as_mat(view.extent) >= 128;
        box = cv::boundingRect(all);
        if (box.empty()) return;
        const int margin = static_cast<int>(kWidest_px) + 2;
        box -= cv::Point(margin, margin);
        box += cv::Size(2 * margin, 2 * margin);
        box &= cv::Rect(0, 0, view.extent.width(), view.extent.height());
        const cv::Mat inside = all(box), outside = ~inside;
        cv::Mat away;
        cv::distanceTransform(inside, distance, cv::DIST_L2, 5);
        cv::distanceTransform(outside, away, cv::DIST_L2, 5);
        distance -= away;
        // The ink of an occluder covers the surface beside it.
        open = as_mat(view.visible)(box) >= 250;
        cv::erode(open, open, cv::getStructuringElement(cv::MORPH_ELLIPSE, {7, 7}));
        open.convertTo(share, CV_32F, 1.0 / 255);
        as_mat(view.luma)(box).convertTo(light, CV_32F);
        light = light.mul(share);
    }
};

// Compares the distance within `band` px of the outline and, inside, the luma smoothed by `sigma`
// less its surroundings.
RegistrationPicture picture(const Shape& shape, float band, float sigma) {
    constexpr float kDistance_px = 6, kInk = 20;  // that count as 1
    constexpr float kMostInk = 1.5f;
    RegistrationPicture out;
    if (shape.box.empty()) return out;
    cv::Mat near, near_share, wide, wide_share;
    const double surroundings = 4.0 * sigma + 6.0;
    cv::GaussianBlur(shape.light, near, {0, 0}, sigma);
    cv::GaussianBlur(shape.share, near_share, {0, 0}, sigma);
    cv::GaussianBlur(shape.light, wide, {0, 0}, surroundings);
    cv::GaussianBlur(shape.share, wide_share, {0, 0}, surroundings);
    out.area = {shape.box.x, shape.box.y, shape.box.x + shape.box.width,
                shape.box.y + shape.box.height};
    out.value = ImageF1(shape.box.width, shape.box.height);
    out.inside = ImageF1(shape.box.width, shape.box.height);
    for (int y = 0; y < shape.box.height; ++y) {
        for (int x = 0; x < shape.box.width; ++x) {
            const float d = shape.distance.at<float>(y, x);
            float value = (std::clamp(d, -band, band) - band) / kDistance_px;
            bool compared = std::abs(d) < band;
            if (d >= band && shape.open.at<std::uint8_t>(y, x) != 0) {
                constexpr float kNone = 1e-3f;
                const float ink = near.at<float>(y, x) / (near_share.at<float>(y, x) + kNone) -
                                  wide.at<float>(y, x) / (wide_share.at<float>(y, x) + kNone);
                value += std::clamp(ink / kInk, -kMostInk, kMostInk);
                compared = true;
            }
            out.value.at(x, y) = value;
            out.inside.at(x, y) = compared ? 1.0f : 0.0f;
        }
    }
    return out;
}

struct Stage {
    float band_px, sigma_px;
    int lattice_px;
    float stiffness_px;
    int iterations;
};

class OutlineMatch {
  public:
    OutlineMatch(const OutlineView& prev, const OutlineView& cur)
        : prev_(prev), cur_(cur), scale_(static_cast<float>(cur.luma.width()) / 640.0f) {}

    [[nodiscard]] bool empty() const { return prev_.box.empty() || cur_.box.empty(); }

    // True if a homography was found; `field` is its start and its result.
    bool planar(LatticeField& field) const {
        for (const Stage& stage : {Stage{24, 4, 0, 0, 15}, Stage{10, 2, 0, 0, 12}}) {
            const PlanarRegistration found =
                register_planar(of(prev_, stage), of(cur_, stage), field, options(stage));
            if (!found.found) return false;
            field = found.anchor_from_cur;
        }
        return true;
    }
    void smooth(LatticeField& field) const {
        // Stiff, because what the outline does not determine is best taken from the surroundings.
        // (assets/drawn, mean error of a step: cape 1.5 px; at four times the stiffness 3.0, at a
        // third 2.2.)
        for (const Stage& stage : {Stage{20, 4, 32, 0.25f, 14}, Stage{12, 2.5f, 24, 0.17f, 10},
                                   Stage{8, 1.2f, 16, 0.08f, 8}}) {
            field = register_lattice(of(prev_, stage), of(cur_, stage), field, options(stage));
        }
    }
    [[nodiscard]] double residual(const LatticeField& field, float band_px) const {
        const Stage stage{band_px, 2, 16, 0.1f, 1};
        const RegistrationFit fit =
            registration_fit(of(prev_, stage), of(cur_, stage), field, options(stage));
        return fit.residual + (1.0 - fit.share);
    }

  private:
    [[nodiscard]] static RegistrationPicture of(const Shape& shape, const Stage& stage) {
        return picture(shape, stage.band_px, stage.sigma_px);
    }
    [[nodiscard]] RegistrationOptions options(const Stage& stage) const {
        RegistrationOptions out;
        out.samples = 40000;
        out.iterations = stage.iterations;
        out.lattice_px = std::max(
            4, static_cast<int>(std::lround(scale_ * static_cast<float>(stage.lattice_px))));
        out.stiffness_px = stage.stiffness_px;
        return out;
    }

    Shape prev_, cur_;
    float scale_;  // of the lattices
};

}  // namespace

LatticeField register_outline(const OutlineView& prev, const OutlineView& cur,
                              const LatticeField& initial) {
    const OutlineMatch match(prev, cur);
    if (match.empty()) return initial;
    constexpr float kNarrow = 8;
    LatticeField field = initial;
    match.smooth(field);
    LatticeField plane(initial.full_size(), initial.spacing());
    if (!match.planar(plane)) return field;
    LatticeField bent = plane;
    match.smooth(bent);
    // A raw estimate may fit the outline while the surface slips along it. A result that starts
    // from a homography slips less and is preferred unless it fits clearly worse.
    constexpr double kClearlyWorse = 1.35;
    double with_field = match.residual(field, kNarrow);
    const double with_bent = match.residual(bent, kNarrow);
    if (with_bent <= kClearlyWorse * with_field) {
        field = std::move(bent);
        with_field = with_bent;
    }
    constexpr double kAsWell = 1.03, kAlmostNothing = 0.03;
    return match.residual(plane, kNarrow) <= kAsWell * with_field + kAlmostNothing ? plane : field;
}

}  // namespace weft
