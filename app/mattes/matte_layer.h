#pragma once
// Mattes of a region by layer number: 0 is the matte, k is holdout k − 1, −1 − k is zone k
// (zone_layer()).

#include "app/project/edit.h"

namespace weft {

/// Returns the matte of this layer; an empty one if the region has no such layer.
[[nodiscard]] const MatteSource& layer_source(const Region& region, int layer);
/// The range of layers that can be painted: those of the region, and one more at each end, which
/// adds a zone or a holdout.
[[nodiscard]] int first_layer(const Region& region);
[[nodiscard]] int last_layer(const Region& region);
/// The edit that replaces this layer by `source`; a number beyond the last holdout or zone adds
/// one, a zone with the kind and the value of `begun`.
[[nodiscard]] Edit set_layer(const Region& region, int layer, MatteSource source,
                             const Zone& begun = {});
/// The edit that removes a painted keyframe, or what is confirmed on a frame; a holdout or zone
/// without keyframes is removed too.
[[nodiscard]] Edit without_layer_key(const Region& region, int layer, int frame);
/// "wall", "holdout 2 of wall" or "zone 1 of wall".
[[nodiscard]] std::string layer_name(const Region& region, int layer);

}  // namespace weft
