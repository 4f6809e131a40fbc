#pragma once
#include "engine/core/image.h"

namespace weft {

/// Applies the artist's light exactly: texture ← texture · (1 + λ (L − 1)) by channel, λ =
/// `strength` (0–1). L is plate / albedo, or the lighting pass if `albedo` is empty. All H×W,
/// linear light. A channel whose albedo is below 0.004 takes the mean L of the others. L is limited
/// to 64. NaN and infinity leave the texture unchanged.
void apply_exact_light(ImageView<float, 3> texture, ViewF3 plate, ViewF3 albedo, ViewF3 lighting,
                       ViewU8x1 matte, float strength);

}  // namespace weft
