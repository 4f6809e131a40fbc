#pragma once
// Drawn animation: which lines a painted matte takes in.

#include <array>

#include "engine/core/image.h"

namespace weft {

/// What lies between the fills of a drawing: 1 where a pixel is of a fill of the surface, 2 of
/// another fill, 0 of a line or its edge.
using FillSides = Image<std::uint8_t, 1>;

/// Whether a matte goes to the inner edge of the surface's lines, to their middle or around them,
/// and whether it takes in those between its own fills: learnt from the keyframe, by distance.
class LineHabit {
  public:
    /// What lies further than this from all fills of the surface does not matter, px.
    static constexpr int kSees_px = 12;

    LineHabit() = default;
    /// From the keyframe's `sides` and its matte, `phi` > 0 inside; H×W.
    LineHabit(const FillSides& sides, ViewF1 phi);

    /// The surface's pixels (1, else 0) of a later frame: of its fills, and of lines as the
    /// keyframe had them; where it had none so far from a fill, the nearer side decides. Pure.
    [[nodiscard]] Matte complete(const FillSides& sides) const;

  private:
    static constexpr std::size_t kReach = 8;  // px from the surface's nearest fill
    struct Counts {
        std::array<int, kReach> inside{}, all{};
    };
    Counts within_, at_the_rim_;  // between fills of the surface; beside another fill
};

}  // namespace weft
