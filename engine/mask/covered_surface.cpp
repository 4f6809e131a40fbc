#include "engine/mask/covered_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mask/nearest_pixel.h"
#include "engine/mask/spread_motion.h"

namespace weft {
namespace {

constexpr std::uint8_t kOwn = 8;  // frames inside, from which on something is the surface's own

ImageF1 turned_out(ViewF1 phi) {
    ImageF1 out(phi.size());
    for (int y = 0; y < phi.height(); ++y)
        std::transform(phi.row(y), phi.row(y) + phi.width(), out.row(y), std::negate<>());
    return out;
}

// The motion of what is hidden, over the whole frame, as that of what is seen well inside: beside a
// boundary measured motion is often that of what passes. 0 outside the area.
ImageF2 hidden_motion(const GroundStep& step) {
    constexpr float kWellInside_px = 8;
    ImageF2 out(step.frame.size());
    if (step.area.empty()) return out;
    ImageF1 weight(step.area.size());
    Vec2 mean(0);
    float total = 0;
    for (int y = 0; y < weight.height(); ++y) {
        const int fy = step.area.y0 + y;
        for (int x = 0; x < weight.width(); ++x) {
            const int fx = step.area.x0 + x;
            if (step.flow.valid.row(fy)[fx] == 0) continue;
            if (step.phi.row(fy)[fx] < kWellInside_px * step.unit_px) continue;
            const float* d = step.flow.d.pixel(fx, fy);
            weight.at(x, y) = 1;
            mean += Vec2(d[0], d[1]);
            total += 1;
        }
    }
    const ImageF2 motion = spread_motion(step.flow.d.view().crop(step.area), weight,
                                         mean / std::max(total, 1.0f), step.unit_px);
    for (int y = step.area.y0; y < step.area.y1; ++y)
        std::copy_n(motion.row(y - step.area.y0), 2 * step.area.width(),
                    out.row(y) + 2 * step.area.x0);
    return out;
}

}  // namespace

CoveredSurface::CoveredSurface(ViewU8x3 key_frame, ViewF1 key_phi)
    : motion_(key_phi.size()),
      frames_(key_phi.size()),
      behind_(key_phi.size()),
      plate_(key_frame, turned_out(key_phi)) {
    for (int y = 0; y < frames_.height(); ++y) {
        for (int x = 0; x < frames_.width(); ++x)
            frames_.at(x, y) = key_phi.row(y)[x] > 0 ? kOwn : 0;
    }
}

void CoveredSurface::advance(const GroundStep& step) {
    const Recti frame = rect_of(behind_.size());
    motion_ = hidden_motion(step);
    plate_.move(motion_);
    Matte frames(behind_.size()), behind(behind_.size());
    parallel_rows(step.area.height(), 16, [&](int y0, int y1) {
        for (int y = step.area.y0 + y0; y < step.area.y0 + y1; ++y) {
            for (int x = step.area.x0; x < step.area.x1; ++x) {
                const Vec2i from = place_before(x, y);
                if (!frame.contains(from.x, from.y)) continue;
                if (!step.dropped.empty() && step.dropped.row(y)[x] != 0) continue;
                const bool was_behind = behind_.at(from.x, from.y) != 0;
                const std::uint8_t so_far = was_behind ? kOwn : frames_.at(from.x, from.y);
                if (step.phi.row(y)[x] > 0)
                    frames.at(x, y) = std::min<std::uint8_t>(kOwn, so_far + 1);
                else if (so_far == kOwn)
                    behind.at(x, y) = 255;
            }
        }
    });
    frames_ = std::move(frames);
    behind_ = std::move(behind);
    plate_.update(step.frame, turned_out(step.phi));
}

void CoveredSurface::correct(ViewU8x1 wrong, ViewU8x1 inside) {
    plate_.forget(wrong);
    for (int y = 0; y < wrong.height(); ++y) {
        for (int x = 0; x < wrong.width(); ++x) {
            if (wrong.row(y)[x] == 0) continue;
            frames_.at(x, y) = inside.row(y)[x] != 0 ? kOwn : 0;
            behind_.at(x, y) = 0;
        }
    }
}

Vec2i CoveredSurface::place_before(int x, int y) const {
    const float* d = motion_.pixel(x, y);
    return nearest_pixel(Vec2(x, y) + Vec2(d[0], d[1]));
}

ImageF1 CoveredSurface::odds(ViewU8x3 frame) const {
    constexpr float kNoise_levels = 3, kSpread_levels = 160, kMost = 3;
    const float most = std::log(kSpread_levels / (2 * kNoise_levels));
    ImageF1 out(behind_.size());
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                if (behind_.at(x, y) == 0) continue;
                const float difference = plate_.difference(frame.pixel(x, y), x, y);
                if (difference < 0) continue;
                out.at(x, y) = std::clamp(most - difference / kNoise_levels, -kMost, kMost);
            }
        }
    });
    return out;
}

}  // namespace weft
