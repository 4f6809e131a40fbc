#pragma once
// The shape of a plate's pixels.

#include <algorithm>
#include <cmath>

#include "engine/core/geometry.h"

namespace weft {

/// How wide a pixel of the plate is for its height: 2 for a classic anamorphic plate. Places are
/// kept in plate pixels, in which such a picture is squeezed; lengths and angles that an artist
/// sees are those of *unsqueezed* places, whose x counts in heights of a pixel. Square pixels leave
/// every number as it is.
class PixelAspect {
  public:
    static constexpr double kLeast = 0.1, kMost = 10;  ///< Of what can be set.

    PixelAspect() = default;
    /// `ratio`: above 0. Within half a percent of 1 it is 1: densities of stills and the aspects of
    /// movies are rounded.
    explicit PixelAspect(double ratio)
        : ratio_(std::abs(ratio - 1) < 0.005 ? 1 : static_cast<float>(ratio)) {}

    [[nodiscard]] float ratio() const { return ratio_; }
    [[nodiscard]] bool square() const { return ratio_ == 1; }

    // Of a place in plate pixels, or of a step.
    [[nodiscard]] Vec2 unsqueezed(Vec2 plate) const { return {plate.x * ratio_, plate.y}; }
    [[nodiscard]] Vec2 squeezed(Vec2 unsqueezed) const {
        return {unsqueezed.x / ratio_, unsqueezed.y};
    }
    [[nodiscard]] glm::dvec2 unsqueezed(glm::dvec2 plate) const {
        return {plate.x * static_cast<double>(ratio_), plate.y};
    }
    [[nodiscard]] glm::dvec2 squeezed(glm::dvec2 unsqueezed) const {
        return {unsqueezed.x / static_cast<double>(ratio_), unsqueezed.y};
    }
    /// The size of a picture with square pixels that shows the same.
    [[nodiscard]] Size unsqueezed(Size plate) const {
        if (square()) return plate;
        const auto width = std::lround(static_cast<float>(plate.width) * ratio_);
        return {std::max(1, static_cast<int>(width)), plate.height};
    }

    bool operator==(const PixelAspect&) const = default;

  private:
    float ratio_ = 1;
};

}  // namespace weft
