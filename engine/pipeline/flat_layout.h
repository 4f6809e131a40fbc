#pragma once
// How a region's surface lies in its flat picture.

#include <array>

#include "engine/core/geometry.h"

namespace weft {

/// A picture on the coordinates of the reference frame: the frame itself, `texels_per_px` times as
/// large, with the same margin on all sides for what other frames show beyond it.
struct FlatLayout {
    Size plate;  ///< Of the reference frame, px.
    int texels_per_px = 1;
    int margin_px = 0;

    [[nodiscard]] Size size() const {
        return {texels_per_px * (plate.width + 2 * margin_px),
                texels_per_px * (plate.height + 2 * margin_px)};
    }
    /// Where a place of the reference frame (px) lies in the picture (texels).
    [[nodiscard]] Vec2 texel(Vec2 pixel) const {
        const auto margin = static_cast<float>(margin_px);
        return (pixel + Vec2(margin, margin)) * static_cast<float>(texels_per_px);
    }
    /// The picture's corners on the reference frame: top left, top right, bottom right, bottom
    /// left.
    [[nodiscard]] std::array<Vec2, 4> corners() const {
        const auto low = static_cast<float>(-margin_px);
        const auto right = static_cast<float>(plate.width + margin_px);
        const auto bottom = static_cast<float>(plate.height + margin_px);
        return {Vec2(low, low), Vec2(right, low), Vec2(right, bottom), Vec2(low, bottom)};
    }
    bool operator==(const FlatLayout&) const = default;
};

}  // namespace weft
