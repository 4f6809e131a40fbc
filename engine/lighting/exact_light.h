#pragma once
#include "engine/core/image.h"

namespace weft {

/// The artist's light, as it is: texture ← texture · (1 + λ (L − 1)), channel by channel. L is
/// plate / albedo, or the lighting pass itself where `albedo` says so by being empty. All of one
/// size, linear light. Where a channel of the albedo is too dark (below 0.004) the others' mean
/// stands for it; L is kept below 64; NaN and infinity change nothing.
void apply_exact_light(ImageView<float, 3> texture, ViewF3 plate, ViewF3 albedo, ViewF3 lighting,
                       ViewU8x1 matte, float strength);

}  // namespace weft
