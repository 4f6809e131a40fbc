#pragma once
// Points of an outline on the outline of another frame.

#include <vector>

#include "engine/mask/outline_path.h"

namespace weft {

/// Where a point of an outline is expected on another frame's.
struct CarriedPoint {
    Vec2 at{0};        ///< By the motion.
    Vec2 along{0};     ///< Which way the outline goes there.
    double share = 0;  ///< Of the outline's length before it, on the frame that it comes from.
};

/// Places for points in the order in which they go round: each at the nearest part of the outline
/// that goes the same way, in order and never on top of one another; one that lies further than
/// `reach_px` from it is placed between those beside it, by length. `points` are three or more.
[[nodiscard]] std::vector<double> followed_places(const OutlinePath& outline,
                                                  const std::vector<CarriedPoint>& points,
                                                  float reach_px);

/// True if an outline is another one, carried: most of each (90 %) lies within `reach_px` of
/// the other, so none has a part that the other lacks. `distance_px` is the mean of both ways.
struct SameOutline {
    bool same = false;
    float distance_px = 0;
};
[[nodiscard]] SameOutline same_outline(const std::vector<Vec2>& carried, const OutlinePath& outline,
                                       float reach_px);

}  // namespace weft
