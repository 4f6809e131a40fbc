#include "engine/mask/covered_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "engine/core/median.h"
#include "engine/core/parallel.h"
#include "engine/mask/nearest_pixel.h"
#include "engine/mask/piece_motion.h"
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

// Where the surface is seen well inside: beside a boundary measured motion is often that of what
// passes.
std::vector<PlacePair> seen_motion(const GroundStep& step) {
    constexpr float kWellInside_px = 8;
    constexpr int kStep = 2;
    std::vector<PlacePair> out;
    for (int y = step.area.y0; y < step.area.y1; y += kStep) {
        for (int x = step.area.x0; x < step.area.x1; x += kStep) {
            const bool inside = step.phi.row(y)[x] >= kWellInside_px * step.unit_px;
            if (inside && step.flow.valid.row(y)[x] != 0) out.push_back(pair_at(step.flow, x, y));
        }
    }
    return out;
}

// How far what moves with the surface may be from the plane that fits all of it. On a plain cloth
// the motion of a hand in front of it is measured far beyond the hand.
float tolerance_of(const std::vector<PlacePair>& seen, const glm::dmat3& plane, float unit_px) {
    constexpr float kLeast_px = 1, kTimes = 3;
    std::vector<float> misses;
    misses.reserve(seen.size());
    for (const PlacePair& pair : seen)
        misses.push_back(glm::length(pair.to - mapped(plane, pair.from)));
    return std::max(kLeast_px * unit_px, kTimes * median_of(misses, 0.0f));
}

// The motion of what is hidden, over the whole frame: a plane's, and what those miss of it near by
// that move with the surface. 0 outside the area.
ImageF2 hidden_motion(const GroundStep& step) {
    ImageF2 out(step.frame.size());
    if (step.area.empty()) return out;
    const std::vector<PlacePair> seen = seen_motion(step);
    const glm::dmat3 plane = fit_piece(seen);
    const float tolerance = tolerance_of(seen, plane, step.unit_px);
    ImageF2 misses(step.area.size());
    ImageF1 weight(step.area.size());
    for (const PlacePair& pair : seen) {
        const Vec2 miss = pair.to - mapped(plane, pair.from);
        if (glm::length(miss) > tolerance) continue;
        const int x = static_cast<int>(pair.from.x) - step.area.x0;
        const int y = static_cast<int>(pair.from.y) - step.area.y0;
        weight.at(x, y) = 1;
        misses.pixel(x, y)[0] = miss.x, misses.pixel(x, y)[1] = miss.y;
    }
    const ImageF2 near_by = spread_motion(misses, weight, Vec2(0), step.unit_px);
    parallel_rows(step.area.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < step.area.width(); ++x) {
                const Vec2i at(step.area.x0 + x, step.area.y0 + y);
                const float* miss = near_by.pixel(x, y);
                const Vec2 d = moved_by(plane, Vec2(at)) + Vec2(miss[0], miss[1]);
                out.pixel(at.x, at.y)[0] = d.x, out.pixel(at.x, at.y)[1] = d.y;
            }
        }
    });
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
