#pragma once
// Blur that varies over a picture: along a depth pass, or from place to place.

#include <optional>
#include <vector>

#include "engine/composite/focus.h"
#include "engine/core/image.h"

namespace weft {

/// How a lens blurs what is so near: the variance is a parabola over the nearness, since the circle
/// of confusion grows with the difference of reciprocal distances (thin lens). Held at its ends.
struct FocusModel {
    float constant = 0, linear = 0, square = 0;  ///< Of (nearness − middle).
    float middle = 0, lowest = 0, highest = 0;   ///< Of the nearness it was fitted to.
    [[nodiscard]] float blur_px(float nearness) const;
};

/// Fits the lens to a picture's edges. `nearness` has the picture's size; edges next to a step of
/// it do not count, for they are between two things. Nothing where too few edges tell, or all is
/// equally near.
[[nodiscard]] std::optional<FocusModel> fit_focus(const std::vector<EdgeBlur>& edges,
                                                  const ImageF1& nearness);

/// Blur from place to place without a depth pass: a plane through the variances of tiles of 64 px.
/// Nothing where too few tiles have edges, or where they do not agree on a slope; one blur for all
/// is right then. Pixels of the picture that the edges are of, `size`.
[[nodiscard]] std::optional<ImageF1> sloping_blur(const std::vector<EdgeBlur>& edges, Size size);

/// blur_inside() by a deviation of its own for each pixel. `sigma_px` has the picture's size.
void blur_by_map(ImageView<float, 3> picture, ViewU8x1 matte, const ImageF1& sigma_px);

}  // namespace weft
