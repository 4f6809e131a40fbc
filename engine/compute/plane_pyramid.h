#pragma once
// A texture plane prepared for filtered sampling.

#include <cstdint>
#include <vector>

#include "engine/compute/wrap_mode.h"
#include "engine/core/image.h"

namespace weft {

/// Levels of a texture plane: level 0 is the plane magnified twice by a cubic, level 1 the plane
/// itself, each further one half the size. Texels are linear light in 16 bits relative to `range`,
/// four to a texel (the fourth is padding, so that one load fetches a texel).
class PlanePyramid {
  public:
    using Level = Image<std::uint16_t, 4>;

    PlanePyramid() = default;
    /// `linear`: H×W×3, linear light, values ≥ 0 (negative and NaN count as 0). Costs about 45 bytes
    /// a texel.
    PlanePyramid(ViewF3 linear, WrapMode wrap);

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] WrapMode wrap() const { return wrap_; }
    [[nodiscard]] float range() const { return range_; }   ///< Value of the code 65535.
    [[nodiscard]] const std::vector<Level>& levels() const { return levels_; }
    [[nodiscard]] bool empty() const { return levels_.empty(); }

  private:
    Size size_;
    WrapMode wrap_ = WrapMode::kRepeat;
    float range_ = 1;
    std::vector<Level> levels_;
};

/// The index that `i` stands for on an axis of n texels; any i.
[[nodiscard]] int wrapped_index(int i, int n, WrapMode wrap);

}  // namespace weft
