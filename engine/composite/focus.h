#pragma once
// The plate's focus: how blurred its sharpest edges are, and the same blur on a texture that is
// sharper (method: "Composite").

#include "engine/core/image.h"

namespace weft {

/// Deviation in pixels of the Gaussian that would blur ideal steps to the picture's sharper edges
/// inside the matte (lower third of its strong edges), by the ratio of gradients before and after a
/// known blur (Zhuo & Sim 2011, eq. 5). 0 where there are too few edges to tell. Linear light;
/// values above 1 count as 1.
[[nodiscard]] float edge_blur_px(ViewF3 linear, ViewU8x1 matte);

/// Blurs by a Gaussian of deviation `sigma_px`, from pixels where the matte is above 0 only; the
/// others are left as they are. Less than 0.2 px changes nothing.
void blur_inside(ImageView<float, 3> picture, ViewU8x1 matte, float sigma_px);

/// The blur that takes edges of `from_px` to `to_px`; 0 where they are no sharper than by a tenth.
[[nodiscard]] float blur_between(float from_px, float to_px);

}  // namespace weft
