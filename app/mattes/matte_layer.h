#pragma once
// A region's mattes by number: 0 its own, k the holdout k − 1, −1 − k the zone k (zone_layer()).

#include "app/project/edit.h"

namespace weft {

/// The matte of that number; an empty one where the region has none.
[[nodiscard]] const MatteSource& layer_source(const Region& region, int layer);
/// The numbers that can be painted on: those that the region has, and one more to each side, with
/// which a zone or a holdout begins.
[[nodiscard]] int first_layer(const Region& region);
[[nodiscard]] int last_layer(const Region& region);
/// The edit that puts `source` in its place; one beyond the last holdout or zone is added.
[[nodiscard]] Edit set_layer(const Region& region, int layer, MatteSource source);
/// The edit that takes a painted keyframe away; a holdout or zone without one left goes altogether.
[[nodiscard]] Edit without_layer_key(const Region& region, int layer, int frame);
/// "wall", "holdout 2 of wall" or "zone 1 of wall".
[[nodiscard]] std::string layer_name(const Region& region, int layer);

}  // namespace weft
