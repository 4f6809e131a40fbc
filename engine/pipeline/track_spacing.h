#pragma once
#include <algorithm>

namespace weft {

/// The spacing of a track's lattice, px, on a plate of this width. True motion follows smaller
/// parts than estimated motion can.
[[nodiscard]] inline int track_spacing_px(bool true_motion, int plate_width) {
    return std::max(true_motion ? 4 : 8, plate_width / 160);
}

}  // namespace weft
