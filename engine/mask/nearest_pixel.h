#pragma once
#include <cmath>

#include "engine/core/geometry.h"

namespace weft {

/// The pixel whose centre is nearest to a place that is given by whole numbers at the centres.
[[nodiscard]] inline Vec2i nearest_pixel(Vec2 place) {
    return {static_cast<int>(std::lround(place.x)), static_cast<int>(std::lround(place.y))};
}

}  // namespace weft
