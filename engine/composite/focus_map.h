#pragma once
// Blur that varies over a picture: along a depth pass, or from place to place.

#include <optional>
#include <vector>

#include "engine/composite/focus.h"
#include "engine/core/image.h"

namespace weft {

/// The blur of a lens by nearness. The variance is a parabola over nearness, because the circle of
/// confusion grows with the difference of reciprocal distances (thin lens). Constant beyond its
/// ends.
struct FocusModel {
    float constant = 0, linear = 0, square = 0;  ///< Of (nearness − middle).
    float middle = 0, lowest = 0, highest = 0;   ///< Of the nearness it was fitted to.
    [[nodiscard]] float blur_px(float nearness) const;
};

/// Fits the lens to a picture's edges. `nearness` has the picture's size. Edges next to a step of
/// the nearness are ignored, because they separate two objects. Empty if there are too few edges or
/// all are equally near.
[[nodiscard]] std::optional<FocusModel> fit_focus(const std::vector<EdgeBlur>& edges,
                                                  const ImageF1& nearness);

/// Blur that varies over the picture, without a depth pass: a plane through the variances of 64 px
/// tiles.
struct BlurSlope {
    float constant = 0, by_x = 0, by_y = 0;  ///< Variance at (0, 0), and its change by pixel.
    float least_px = 0, most_px = 0;         ///< The blur at its ends.
    /// How far the tiles agree on a slope, 0–1; 0: one blur for all is right.
    float agreement = 0;
    [[nodiscard]] float variance(float x, float y) const;
};

/// That of a picture of `size` with these edges. Places are relative to its origin.
[[nodiscard]] BlurSlope blur_slope(const std::vector<EdgeBlur>& edges, Size size);

/// blur_inside() with a deviation for each pixel. `sigma_px` has the picture's size.
void blur_by_map(ImageView<float, 3> picture, ViewU8x1 matte, const ImageF1& sigma_px);

}  // namespace weft
