#pragma once

namespace weft {

/// The placement of one frame.
struct PlacementNumbers {
    double scale = 1;
    double rotate_deg = 0;  ///< Counter-clockwise.
    double x = 0, y = 0;    ///< Offset.
    bool operator==(const PlacementNumbers&) const = default;
};

}  // namespace weft
