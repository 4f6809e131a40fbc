#include "engine/mask/matte_propagation.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/boundary_refiner.h"
#include "engine/mask/match_evidence.h"
#include "engine/mask/shape_transport.h"
#include "engine/mask/signed_distance.h"
#include "engine/mask/tuning.h"

namespace weft {
float g_tune[64] = {0.6f,0.35f,1.0f,2.0f,4.0f, 10.0f,20.0f,12.0f,1.0f,3.0f,4.0f, 6.0f,0.5f,10.0f, 4,12,40,0.05f,0.02f, 0.0f, 2.0f, 3.0f};
namespace {

template <class T, int C>
Image<T, C> copy_of(ImageView<const T, C> v) {
    Image<T, C> result(v.size());
    for (int y = 0; y < v.height(); ++y) {
        std::copy(v.row(y), v.row(y) + static_cast<std::ptrdiff_t>(v.width()) * C, result.row(y));
    }
    return result;
}

template <class T, int C>
void paste(Image<T, C>& into, const Image<T, C>& part, Vec2i at) {
    for (int y = 0; y < part.height(); ++y) {
        std::copy(part.row(y), part.row(y) + part.stride(), into.pixel(at.x, at.y + y));
    }
}

Image<std::uint8_t, 1> inside_of(ViewU8x1 matte) {
    Image<std::uint8_t, 1> inside(matte.size());
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) inside.row(y)[x] = matte.row(y)[x] >= 128 ? 1 : 0;
    }
    return inside;
}

Recti clipped_to(Recti r, Size size) { return r.intersected(rect_of(size)); }

}  // namespace

struct MatteWalker::State {
    ImageU8x3 frame;
    ImageF1 phi;
    RefineScale scale{Size{}};
    float confidence = 1;
};

MatteWalker::MatteWalker(ViewU8x3 frame, ViewU8x1 key) : state_(std::make_unique<State>()) {
    state_->scale = RefineScale(frame.size());
    state_->frame = copy_of(frame);
    state_->phi = smooth_distance(signed_distance(inside_of(key), state_->scale.limit_px), 1);
}

MatteWalker::~MatteWalker() = default;
MatteWalker::MatteWalker(MatteWalker&&) noexcept = default;
MatteWalker& MatteWalker::operator=(MatteWalker&&) noexcept = default;

MatteEstimate MatteWalker::advance(ViewU8x3 frame, const FlowField& prev_from_cur) {
    State& s = *state_;
    const RefineScale& scale = s.scale;
    MatteEstimate estimate{Matte(frame.size()), 0};
    const int margin = static_cast<int>(scale.band_px) + scale.window_half_px + 4;
    const Recti area =
        clipped_to(transported_bounds(s.phi, prev_from_cur).grown(margin), frame.size());
    if (area.empty()) {  // the surface has left the frame
        s.confidence = 0;
        s.phi = ImageF1(frame.size(), -scale.limit_px);
        s.frame = copy_of(frame);
        return estimate;
    }
    const TransportedShape shape = transport_shape(s.phi, prev_from_cur, area, scale);
    const ViewU8x3 part = frame.crop(area);

    std::vector<ColorWindow> windows = place_windows(shape.phi, scale.window_step_px);
    for (ColorWindow& w : windows) {
        const float* d = shape.prev_from_cur.pixel(w.center.x, w.center.y);
        w.source_centers = {
            Vec2i(area.x0 + w.center.x + static_cast<int>(std::lround(d[0])),
                  area.y0 + w.center.y + static_cast<int>(std::lround(d[1]))),
            w.center};
    }
    const LocalColorField colors(std::move(windows),
                                 {{s.frame, s.phi, 1.5f, 1.0f},
                                  {part, shape.phi, T(11), T(12)}},
                                 scale.window_half_px, scale.sample_stride, part.size());
    ImageF1 matched = match_evidence({part, shape.phi, shape.prev_from_cur, shape.outside_motion,
                                            Vec2i(area.x0, area.y0), s.frame, s.phi, prev_from_cur.d},
                                           scale.band_px);
    for (int i = 0; i < matched.width() * matched.height(); ++i) matched.data()[i] *= T(20);
    RefinedBoundary found = refine_boundary(part, shape.phi, colors, matched, scale);

    const BoundaryEvidence& e = found.evidence;
    const float risk = (1 - e.separability) + (1 - e.certainty) + 0.5f * (1 - e.steadiness) +
                       0.5f * (1 - shape.consistency);
    s.confidence *= std::exp(-risk / T(13));
    estimate.confidence = s.confidence;
    paste(estimate.matte, found.matte, Vec2i(area.x0, area.y0));
    s.phi = ImageF1(frame.size(), -scale.limit_px);
    paste(s.phi, found.phi, Vec2i(area.x0, area.y0));
    s.frame = copy_of(frame);
    return estimate;
}

namespace {

// The expected boundary between two estimates: their distances blended. Where they disagree nothing is
// settled, however far it lies from the blended boundary.
ImageF1 blend_shapes(ViewF1 before, ViewF1 after, float after_weight, float band_px) {
    ImageF1 phi(before.size());
    for (int y = 0; y < phi.height(); ++y) {
        for (int x = 0; x < phi.width(); ++x) {
            const float a = before.row(y)[x], b = after.row(y)[x];
            float d = a + after_weight * (b - a);
            if ((a > 0) != (b > 0)) d = std::clamp(d, -(band_px - 1), band_px - 1);
            phi.row(y)[x] = d;
        }
    }
    return phi;
}

Recti bounds_of(ViewF1 phi, float above) {
    Recti box;
    for (int y = 0; y < phi.height(); ++y) {
        for (int x = 0; x < phi.width(); ++x) {
            if (phi.row(y)[x] > above) box = box.united({x, y, x + 1, y + 1});
        }
    }
    return box;
}

}  // namespace

MatteEstimate merge_estimates(const MatteEstimate& from_before, const MatteEstimate& from_after,
                              float position, ViewU8x3 frame) {
    if (position <= 0) return from_before;
    if (position >= 1) return from_after;
    const float before_weight = (1 - position) * std::max(from_before.confidence, 1e-3f);
    const float after_weight = position * std::max(from_after.confidence, 1e-3f);
    const float share = after_weight / (before_weight + after_weight);
    MatteEstimate merged{Matte(frame.size()),
                         (1 - share) * from_before.confidence + share * from_after.confidence};
    const RefineScale scale(frame.size());
    const ImageF1 before = signed_distance(inside_of(from_before.matte), scale.limit_px);
    const ImageF1 after = signed_distance(inside_of(from_after.matte), scale.limit_px);
    const ImageF1 blend = blend_shapes(before, after, share, scale.band_px);
    const int margin = static_cast<int>(scale.band_px) + scale.window_half_px + 4;
    const Recti area = clipped_to(
        bounds_of(before, 0).united(bounds_of(after, 0)).grown(margin), frame.size());
    if (area.empty()) return merged;

    ImageF1 phi(area.size());
    for (int y = 0; y < phi.height(); ++y) {
        const float* row = blend.row(area.y0 + y) + area.x0;
        std::copy(row, row + phi.width(), phi.row(y));
    }
    // Samples: what both estimates agree on.
    ImageF1 agreed(area.size());
    for (int y = 0; y < phi.height(); ++y) {
        for (int x = 0; x < phi.width(); ++x) {
            const float a = before.row(area.y0 + y)[area.x0 + x];
            const float b = after.row(area.y0 + y)[area.x0 + x];
            agreed.row(y)[x] = (a > 0) == (b > 0) ? (a > 0 ? std::min(a, b) : std::max(a, b)) : 0;
        }
    }
    const ViewU8x3 part = frame.crop(area);
    std::vector<ColorWindow> windows = place_windows(phi, scale.window_step_px);
    for (ColorWindow& w : windows) w.source_centers = {w.center};
    const LocalColorField colors(std::move(windows), {{part, agreed, 1.5f, 1.0f}},
                                 scale.window_half_px, scale.sample_stride, part.size());
    const RefinedBoundary found = refine_boundary(part, phi, colors, ViewF1(), scale);
    paste(merged.matte, found.matte, Vec2i(area.x0, area.y0));
    return merged;
}

}  // namespace weft
