#pragma once
#include <utility>

#include "engine/core/texture_mapping.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Where the places of one frame lie on a region's surface: followed to the reference frame, laid
/// flat by the form, seen squarely by the corners. There the placement's scale, rotation and offset
/// act. Immutable and thread-safe.
class SurfacePlaces {
  public:
    /// `ground`: the region's mapping without scale, rotation and offset.
    SurfacePlaces(LatticeField ref_from_cur, TextureMapping ground)
        : ref_from_cur_(std::move(ref_from_cur)), ground_(std::move(ground)) {}
    [[nodiscard]] Vec2 at(Vec2 plate) const { return ground_.texel(reference(plate)); }
    /// Where a place of this frame lies on the reference frame.
    [[nodiscard]] Vec2 reference(Vec2 plate) const { return plate + ref_from_cur_.at(plate); }
    /// The way back: where this frame shows a place of the reference frame, by Newton's method with
    /// differences. Near where the surface folds, a place close to it.
    [[nodiscard]] Vec2 frame(Vec2 of_reference) const {
        constexpr int kSteps = 8;
        constexpr float kNearPx = 0.01f;
        Vec2 at = of_reference - ref_from_cur_.at(of_reference);
        for (int step = 0; step < kSteps; ++step) {
            const Vec2 off = of_reference - reference(at);
            if (off.x * off.x + off.y * off.y < kNearPx * kNearPx) break;
            const Vec2 x(0.5f, 0), y(0, 0.5f);
            const Vec2 a = reference(at + x) - reference(at - x);
            const Vec2 b = reference(at + y) - reference(at - y);
            const float det = a.x * b.y - b.x * a.y;
            constexpr float kFlat = 0.05f;
            at += det > kFlat ? Vec2(b.y * off.x - b.x * off.y, a.x * off.y - a.y * off.x) / det
                              : off;
        }
        return at;
    }

  private:
    LatticeField ref_from_cur_;
    TextureMapping ground_;
};

}  // namespace weft
