#pragma once
// Mattes of a region by layer number: 0 is the matte, k is holdout k − 1.

#include "app/project/edit.h"

namespace weft {

/// Returns the matte or holdout; an empty one if the region has no such holdout.
[[nodiscard]] const MatteSource& layer_source(const Region& region, int layer);
/// The edit that replaces this layer by `source`; a number beyond the last holdout adds one.
[[nodiscard]] Edit set_layer(const Region& region, int layer, MatteSource source);
/// The edit that removes a painted keyframe; a holdout without keyframes is removed too.
[[nodiscard]] Edit without_layer_key(const Region& region, int layer, int frame);
/// "wall", or "holdout 2 of wall".
[[nodiscard]] std::string layer_name(const Region& region, int layer);

}  // namespace weft
