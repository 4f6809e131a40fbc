#include "engine/temporal/surface_walker.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "engine/motion/surface_fit.h"
#include "engine/temporal/stretch_limit.h"

namespace weft {
namespace {

cv::Mat as_mat(ViewU8x1 v) {
    return {v.height(), v.width(), CV_8UC1, const_cast<std::uint8_t*>(v.data()),
            static_cast<std::size_t>(v.stride())};
}

Matte copy_of(ViewU8x1 v) {
    Matte out(v.size());
    for (int y = 0; y < v.height(); ++y)
        std::copy(v.row(y), v.row(y) + v.width(), out.row(y));
    return out;
}

Recti bounds_of(ViewU8x1 mask) {
    Recti box;
    for (int y = 0; y < mask.height(); ++y) {
        const std::uint8_t* row = mask.row(y);
        const auto inside = [](std::uint8_t m) { return m >= 128; };
        const auto* first = std::find_if(row, row + mask.width(), inside);
        if (first == row + mask.width()) continue;
        int last = mask.width();
        while (row[last - 1] < 128)
            --last;
        box = box.united({static_cast<int>(first - row), y, last, y + 1});
    }
    return box;
}

}  // namespace

struct SurfaceWalker::State {
    SurfaceWalkerOptions options;
    LatticeField ref_from_cur, prev_from_cur;

    // The frame that the present one is registered against.
    Matte anchor_luma, anchor_visible;
    LatticeField ref_from_anchor, anchor_from_cur;
    int anchor_age = 0;

    void become_anchor(ViewU8x1 luma, ViewU8x1 visible) {
        anchor_luma = copy_of(luma);
        anchor_visible = copy_of(visible);
        ref_from_anchor = ref_from_cur;
        anchor_from_cur = LatticeField(luma.size(), options.spacing_px);
        anchor_age = 0;
    }

    [[nodiscard]] SurfaceFitOptions fit_options() const {
        SurfaceFitOptions fit;
        fit.spacing_px = options.spacing_px;
        if (options.exact_motion) {
            fit.finest_px = 8;
            fit.correlation_px = 1;
            fit.noise_floor_px = 0.005f;
        }
        return fit;
    }

    // The share of the region that the anchor still explains; corrects anchor_from_cur on the way.
    float register_against_anchor(ViewU8x1 luma, ViewU8x1 visible);
};

namespace {

// The anchor's picture and matte as the present frame should show them.
struct Prediction {
    cv::Mat luma, visible;
};

Prediction predict(const Matte& luma, const Matte& visible, const LatticeField& anchor_from_cur,
                   const Recti& area) {
    const ImageF2 d = anchor_from_cur.dense(area);
    cv::Mat map(area.height(), area.width(), CV_32FC2);
    for (int y = 0; y < area.height(); ++y) {
        auto* m = map.ptr<cv::Vec2f>(y);
        for (int x = 0; x < area.width(); ++x) {
            const float* p = d.pixel(x, y);
            m[x] = {static_cast<float>(area.x0 + x) + p[0], static_cast<float>(area.y0 + y) + p[1]};
        }
    }
    Prediction out;
    cv::remap(as_mat(luma), out.luma, map, {}, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    cv::remap(as_mat(visible), out.visible, map, {}, cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
    return out;
}

// Zero-mean normalised correlation in windows, 0–1: does the prediction show what the frame shows?
cv::Mat agreement(const cv::Mat& a8, const cv::Mat& b8) {
    constexpr int kWindow = 17;
    const auto mean = [](const cv::Mat& m) {
        cv::Mat out;
        cv::boxFilter(m, out, CV_32F, {kWindow, kWindow}, {-1, -1}, true, cv::BORDER_REPLICATE);
        return out;
    };
    cv::Mat a, b;
    a8.convertTo(a, CV_32F);
    b8.convertTo(b, CV_32F);
    const cv::Mat ma = mean(a), mb = mean(b);
    const cv::Mat vab = mean(a.mul(b)) - ma.mul(mb);
    const cv::Mat vaa = mean(a.mul(a)) - ma.mul(ma), vbb = mean(b.mul(b)) - mb.mul(mb);
    cv::Mat out(a.size(), CV_32F);
    for (int y = 0; y < out.rows; ++y) {
        const float *ab = vab.ptr<float>(y), *aa = vaa.ptr<float>(y), *bb = vbb.ptr<float>(y);
        float* o = out.ptr<float>(y);
        for (int x = 0; x < out.cols; ++x) {
            // Four grey levels of noise variance keep flat places from agreeing by chance.
            const float va = std::max(aa[x], 0.0f) + 4, vb = std::max(bb[x], 0.0f) + 4;
            o[x] = std::clamp(ab[x] / std::sqrt(va * vb), 0.0f, 1.0f);
        }
    }
    return out;
}

}  // namespace

float SurfaceWalker::State::register_against_anchor(ViewU8x1 luma, ViewU8x1 visible) {
    const Recti area = bounds_of(visible).grown(16).intersected(rect_of(luma.size()));
    if (area.empty()) return 0;
    const Prediction seen = predict(anchor_luma, anchor_visible, anchor_from_cur, area);

    // What is left: for each pixel of the frame where the prediction shows it.
    Matte predicted(area.width(), area.height());
    seen.luma.copyTo(cv::Mat(area.height(), area.width(), CV_8UC1, predicted.data()));
    const FlowField left = estimate_flow(luma.crop(area), predicted, FlowQuality::kDraft);

    const cv::Mat match = agreement(as_mat(luma.crop(area)), seen.luma);
    Matte both(area.width(), area.height());
    long in_region = 0, agreeing = 0;
    for (int y = 0; y < area.height(); ++y) {
        const float* m = match.ptr<float>(y);
        for (int x = 0; x < area.width(); ++x) {
            if (visible.at(area.x0 + x, area.y0 + y) < 128) continue;
            ++in_region;
            if (seen.visible.at<std::uint8_t>(y, x) < 250 || m[x] < 0.5f) continue;
            ++agreeing;
            both.at(x, y) = 255;
        }
    }
    if (in_region == 0) return 0;

    const Matte weights = motion_weights(luma.crop(area), both, left.valid, 4);
    SurfaceFitOptions fit;
    fit.spacing_px = options.spacing_px;
    fit.finest_px = 20;
    const LatticeField rest = fit_surface_motion(left.d, weights, fit);

    // A part of it is put right at once: the chain is steady but drifts, the registration does not
    // drift but trembles, and this is the gain of the (stationary) Kalman filter between them.
    constexpr float kGain = 0.3f;
    LatticeField correction(luma.size(), options.spacing_px);
    const Vec2 origin(static_cast<float>(area.x0), static_cast<float>(area.y0));
    const Vec2 low = origin - 32.0f, high = origin + Vec2(area.width(), area.height()) + 32.0f;
    for (int j = 0; j < correction.nodes().height(); ++j) {
        for (int i = 0; i < correction.nodes().width(); ++i) {
            // Far outside of the region the correction stays what it is at its border.
            const Vec2 p = correction.node_position(i, j);
            const Vec2 q(std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y));
            correction.set_node(i, j, kGain * rest.at(q - origin));
        }
    }
    anchor_from_cur = compose(correction, anchor_from_cur);
    return static_cast<float>(agreeing) / static_cast<float>(in_region);
}

SurfaceWalker::SurfaceWalker(ViewU8x1 luma, ViewU8x1 visible, const SurfaceWalkerOptions& options,
                             const LatticeField* ref_from_start)
    : state_(std::make_unique<State>()) {
    const LatticeField still(luma.size(), options.spacing_px);
    state_->options = options;
    state_->ref_from_cur = ref_from_start ? *ref_from_start : still;
    state_->prev_from_cur = still;
    state_->become_anchor(luma, visible);
}

SurfaceWalker::~SurfaceWalker() = default;
SurfaceWalker::SurfaceWalker(SurfaceWalker&&) noexcept = default;
SurfaceWalker& SurfaceWalker::operator=(SurfaceWalker&&) noexcept = default;

const LatticeField& SurfaceWalker::advance(ViewU8x1 luma, ViewU8x1 visible,
                                           const FlowField& prev_from_cur) {
    State& s = *state_;
    const int border = s.options.exact_motion ? 2 : 6;
    const Matte weights = motion_weights(luma, visible, prev_from_cur.valid, border);
    s.prev_from_cur = fit_surface_motion(prev_from_cur.d, weights, s.fit_options());
    s.anchor_from_cur = compose(s.prev_from_cur, s.anchor_from_cur);
    ++s.anchor_age;
    if (s.options.exact_motion) {
        s.ref_from_cur = compose(s.anchor_from_cur, s.ref_from_anchor);
        return s.ref_from_cur;
    }
    const float explained = s.register_against_anchor(luma, visible);
    s.ref_from_cur = compose(s.anchor_from_cur, s.ref_from_anchor);
    constexpr float kEnough = 0.6f;
    constexpr int kLongest = 24;
    const bool slid = limit_stretch(s.ref_from_cur, visible);
    if (slid || explained < kEnough || s.anchor_age >= kLongest) s.become_anchor(luma, visible);
    return s.ref_from_cur;
}

void SurfaceWalker::anchor_here(ViewU8x1 luma, ViewU8x1 visible) {
    state_->become_anchor(luma, visible);
}

const LatticeField& SurfaceWalker::ref_from_cur() const {
    return state_->ref_from_cur;
}
const LatticeField& SurfaceWalker::prev_from_cur() const {
    return state_->prev_from_cur;
}

}  // namespace weft
