#pragma once
// Drawn animation: a flat fill between ink lines belongs to a surface as a whole, or not at all.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/image.h"
#include "engine/mask/line_habit.h"

namespace weft {

/// What a keyframe shows of fills: which colours are the surface's, and which are not.
class FlatFills {
  public:
    /// From the keyframe's display codes, H×W, and the signed distance of its matte, px. A surface
    /// that is not mostly flat fills has none.
    FlatFills(ViewU8x3 frame, ViewF1 phi);

    /// Which pixels of a later frame belong to the surface (not 0), where that differs from the
    /// sign of `phi`, the boundary that was found. A fill of a colour that the surface alone had on
    /// the keyframe is taken as a whole where a part of it was found, one of a colour that it never
    /// had is left out, and one of a colour of both goes with most of its area. Colours that the
    /// key's boundary divides, or that the key did not show, are left as they were found. Lines are
    /// taken as the keyframe's matte took them (LineHabit). Empty if nothing differs. Pure;
    /// deterministic.
    [[nodiscard]] Matte corrected(ViewU8x3 frame, ViewF1 phi) const;

  private:
    struct Paint {
        std::array<int, 3> color;
        std::int64_t inside = 0, outside = 0;  // px on the keyframe
        bool divided = false;                  // a fill of it lies on both sides
    };
    [[nodiscard]] const Paint* paint_of(const std::array<int, 3>& color) const;

    std::vector<Paint> paints_;
    LineHabit lines_;
};

}  // namespace weft
