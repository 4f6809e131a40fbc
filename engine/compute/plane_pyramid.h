#pragma once
// A texture plane prepared for filtered sampling.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/compute/wrap_mode.h"
#include "engine/core/image.h"

namespace weft {

/// Levels of a texture plane, each half the size of the one before. With detail for magnification
/// the first are larger than the plane (finer_level()); plane_level() is the plane itself. Texels
/// are four floats in the working space (the fourth is padding, so that one load fetches a texel).
/// Immutable; copies share the texels.
class PlanePyramid {
  public:
    using Level = Image<float, 4>;

    PlanePyramid() = default;
    /// `linear`: H×W×3, linear light; values that are negative or not finite count as 0. `finer`
    /// levels above it, 0 to 2. Costs about 21 bytes a texel, with one finer level 85, with two
    /// 341.
    PlanePyramid(ViewF3 linear, WrapMode wrap, int finer = 0);

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] WrapMode wrap() const { return wrap_; }
    [[nodiscard]] std::span<const Level> levels() const {
        return levels_ ? std::span<const Level>(*levels_) : std::span<const Level>();
    }
    /// The index in levels() of the plane itself: the number of finer ones.
    [[nodiscard]] int plane_level() const { return plane_level_; }
    [[nodiscard]] bool empty() const { return !levels_; }
    /// Identifies the texels: within a process, pyramids with the same identity hold the same
    /// texels. 0 is the empty pyramid.
    [[nodiscard]] std::uint64_t identity() const { return empty() ? 0 : identity_; }

  private:
    Size size_;
    int plane_level_ = 0;
    WrapMode wrap_ = WrapMode::kRepeat;
    std::shared_ptr<const std::vector<Level>> levels_;  // null: empty
    std::uint64_t identity_ = 0;
};

/// The texel index in [0, n) for any index `i`.
[[nodiscard]] int wrapped_index(int i, int n, WrapMode wrap);

}  // namespace weft
