#pragma once
// A region's matte and its holdouts by number: 0 the matte, k the holdout k − 1.

#include "app/project/edit.h"

namespace weft {

/// The matte or holdout; an empty one where the region has no such holdout.
[[nodiscard]] const MatteSource& layer_source(const Region& region, int layer);
/// The edit that puts `source` in its place; one beyond the last holdout is added.
[[nodiscard]] Edit set_layer(const Region& region, int layer, MatteSource source);
/// The edit that takes a painted keyframe away; a holdout without one left goes altogether.
[[nodiscard]] Edit without_layer_key(const Region& region, int layer, int frame);
/// "wall", or "holdout 2 of wall".
[[nodiscard]] std::string layer_name(const Region& region, int layer);

}  // namespace weft
