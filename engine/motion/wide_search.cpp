#include "engine/motion/wide_search.h"

#include <algorithm>
#include <cmath>

#include "engine/core/smooth_step.h"
#include "engine/motion/bending_system.h"
#include "engine/motion/photometric_samples.h"
#include "engine/motion/surface_fit.h"

namespace weft {
namespace {

// The anchor where it is expected on the frame: within `area` of it.
struct MovedAnchor {
    RegistrationPicture picture;
    Matte visible;
};

MovedAnchor moved_to(const SurfaceView& anchor, const Recti& area, const LatticeField& expected) {
    // Up to the surface's edge, whose pixels registration leaves out.
    RegistrationPicture whole = anchor.picture;
    std::fill_n(whole.inside.data(), whole.inside.size_bytes() / sizeof(float), 1.0f);
    const Size frame = expected.full_size();
    MovedAnchor out{
        {area, ImageF1(area.width(), area.height()), ImageF1(area.width(), area.height())},
        Matte(frame)};
    std::fill_n(out.visible.data(), out.visible.size_bytes(), std::uint8_t{0});
    const ImageF2 way = expected.dense(area);
    for (int y = area.y0; y < area.y1; ++y) {
        for (int x = area.x0; x < area.x1; ++x) {
            const int i = x - area.x0, j = y - area.y0;
            const float* d = way.pixel(i, j);
            const Vec2 there(static_cast<float>(x) + 0.5f + d[0],
                             static_cast<float>(y) + 0.5f + d[1]);
            const int column = static_cast<int>(std::floor(there.x));
            const int row = static_cast<int>(std::floor(there.y));
            const bool seen =
                rect_of(frame).contains(column, row) && anchor.visible.at(column, row) >= 128;
            const auto value = seen ? look_up(whole, there) : std::nullopt;
            out.picture.value.at(i, j) = value.value_or(0.0f);
            out.picture.inside.at(i, j) = value ? 1.0f : 0.0f;
            if (value) out.visible.at(x, y) = 255;
        }
    }
    return out;
}

double known_share(const FlowField& flow, ViewU8x1 visible, ViewU8x1 moved) {
    std::int64_t both = 0, known = 0;
    for (int y = 0; y < visible.height(); ++y) {
        for (int x = 0; x < visible.width(); ++x) {
            if (visible.at(x, y) < 128 || moved.at(x, y) == 0) continue;
            ++both;
            known += flow.valid.at(x, y) != 0;
        }
    }
    return both > 0 ? static_cast<double>(known) / static_cast<double>(both) : 0;
}

LatticeField misses_of_surface(const FlowField& misses, ViewU8x1 weights, int spacing_px) {
    SurfaceFitOptions fit;
    fit.spacing_px = spacing_px;
    return fit_surface_motion(misses.d, weights, fit);
}

// Registration reaches what misses by less than a pixel, and knows it better.
LatticeField misses_of_parts(const FlowField& misses, ViewU8x1 weights, const LatticeField& like) {
    constexpr float kReached_px = 0.5f, kLost_px = 1.5f;
    constexpr double kNoise_px = 0.5, kPatch_px = 8, kBend_px = 1;  // of raw motion; of the field
    constexpr int kEveryOther = 2, kIterations = 80;
    LatticeField out(like.full_size(), like.spacing());
    BendingSystem system(out);
    constexpr double kEach =
        kEveryOther * kEveryOther / (kPatch_px * kPatch_px * kNoise_px * kNoise_px);
    const Size size = weights.size();
    for (int y = 0; y < size.height; y += kEveryOther) {
        for (int x = 0; x < size.width; x += kEveryOther) {
            const double w = kEach * weights.at(x, y) / 255;
            if (!(w > 0)) continue;
            const float* d = misses.d.pixel(x, y);
            const float lost = smooth_step(std::hypot(d[0], d[1]), kReached_px, kLost_px);
            const Vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            system.measure(p, {w, 0, w}, w * static_cast<double>(lost) * glm::dvec2(d[0], d[1]));
        }
    }
    const std::vector<glm::dvec2> before(system.count());
    const auto& solved = system.solve(before, 1 / (kBend_px * kBend_px), kIterations);
    for (int j = 0, n = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i, ++n)
            out.set_node(i, j, Vec2(solved[static_cast<std::size_t>(n)]));
    }
    return out;
}

}  // namespace

WideSearch search_around(const SurfaceView& anchor, const SurfaceView& cur, ViewU8x1 luma,
                         const LatticeField& expected, MissedBy missed, FlowQuality quality) {
    if (anchor.picture.area.empty() || cur.picture.area.empty()) return {expected, 0};
    constexpr int kMatteBorder_px = 6;
    const MovedAnchor moved = moved_to(anchor, cur.picture.area, expected);
    const FlowField misses =
        estimate_surface_flow(cur, {moved.picture, moved.visible}, expected.full_size(), quality);
    const Matte weights = motion_weights(luma, cur.visible, misses.valid, kMatteBorder_px);
    const LatticeField by = missed == MissedBy::kParts
                                ? misses_of_parts(misses, weights, expected)
                                : misses_of_surface(misses, weights, expected.spacing());
    return {compose(by, expected), known_share(misses, cur.visible, moved.visible)};
}

}  // namespace weft
