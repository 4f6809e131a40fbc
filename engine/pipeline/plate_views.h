#pragma once
#include <memory>

// The plate as the analysis sees it: display-encoded, 8 bit.

#include "engine/color/color_space.h"
#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

struct PlateViews {
    ImageU8x3 display;  ///< sRGB codes; NaN as 0, values outside [0, 1] clipped.
    Matte luma;         ///< Rec. 709 luma of it.
    Matte finite;       ///< 255 where all components are finite, else 0; empty: everywhere.
    // At follow_size(); empty if that is the plate's.
    Matte small_luma;
    std::shared_ptr<const ImageU8x3> small_display;  ///< Walks keep it; null instead of empty.

    /// The luma that surfaces are followed by, of follow_size().
    [[nodiscard]] const Matte& followed() const { return small_luma.empty() ? luma : small_luma; }
    /// The colours of the same size.
    [[nodiscard]] const ImageU8x3& followed_display() const {
        return small_display ? *small_display : display;
    }
};

[[nodiscard]] PlateViews make_views(const ImageF3& plate, const ColorTransform& display_from_plate);

/// The image converted to another space.
[[nodiscard]] ImageF3 transformed(const ImageF3& image, const ColorTransform& transform);

/// extent · (1 − holdout), rounded; `holdout` may be empty.
[[nodiscard]] Matte without_holdout(const Matte& extent, const Matte& holdout);
/// Sets `mask` to 0 where `finite` is 0; an empty `finite` changes nothing.
void drop_nonfinite(Matte& mask, const Matte& finite);

[[nodiscard]] inline Vec2 centre_of_pixel(int x, int y) {
    return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
}

/// The part inside the box, which must lie inside the matte.
[[nodiscard]] Matte cropped(const Matte& matte, const Recti& box);
/// The smallest rectangle around the pixels above 0.
[[nodiscard]] Recti matte_bounds(ViewU8x1 matte);

}  // namespace weft
