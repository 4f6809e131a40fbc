#pragma once
#include "engine/core/keyed_numbers.h"

namespace weft {

/// Edge tools of a matte (engine/mask/matte_edge.h), in full-resolution plate pixels. They change
/// the matte that the picture is made with, never what is propagated and tracked.
struct MatteEdgeParams {
    int min_island_px = 0, min_hole_px = 0;  ///< Areas.
    double smooth_px = 0;
    double choke_px = 0;    ///< Above 0 the matte grows, below 0 it shrinks.
    double feather_px = 0;  ///< Above 0 outwards, below 0 inwards.
    double blur_px = 0;
    /// Over time, in place of the values above.
    KeyedNumbers choke_keys, feather_keys, blur_keys;
    bool operator==(const MatteEdgeParams&) const = default;
};

}  // namespace weft
