#pragma once
// What the plate shows beyond its estimated shading: given to the light as far as the artist says
// that it is light, or kept as a factor of its own.

#include "engine/core/image.h"
#include "engine/lighting/shading.h"

namespace weft {

/// The light detail that changes nothing.
constexpr float kEstimatedDetail = 0.5f;

/// The shading with more or less detail. `amount` (0 to 1) is for each pixel of the plate: 0 is
/// broad light only (its fine structures count as paint), kEstimatedDetail the shading as it is, 1
/// all that the plate shows (the old surface's luminance, at the shading's level), and between them
/// a mix of the logarithms. `linear` (H×W×3, linear light), `visible` and `amount` have the plate's
/// size. The result has the plate's size; where `amount` is kEstimatedDetail, or `visible` is 0, it
/// is the shading interpolated. `box` bounds the matte. Thread-safe, and bit-identical for any
/// number of threads.
[[nodiscard]] Shading with_light_detail(const Shading& shading, ViewF3 linear, ViewU8x1 visible,
                                        const Recti& box, ViewF1 amount);

/// Multiplies the texture, whose pixel (0, 0) lies at `origin` on the plate, by the old surface's
/// fine detail (creases, seams, dirt: about 8 px at 960 px wide), raised to `amount`. `shading`
/// takes out what is in the light already; null: nothing. `matte` has the texture's size, `linear`
/// the plate's. Amount 0 changes no bit. Thread-safe.
void keep_plate_detail(ImageView<float, 3> texture, Vec2i origin, ViewF3 linear, ViewU8x1 matte,
                       const Shading* shading, float amount);

}  // namespace weft
