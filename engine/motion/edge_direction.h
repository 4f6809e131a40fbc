#pragma once
// Internal to the folder.

#include <glm/geometric.hpp>

#include "engine/core/image.h"

namespace weft {

/// The outward direction of a matte's edge at a pixel, of length 1, from the matte within 4 px,
/// which lie in it; 0 where it has none.
[[nodiscard]] inline Vec2 outwards(ViewU8x1 extent, int x, int y) {
    constexpr int kReach = 4;
    Vec2 sum(0);
    for (int dy = -kReach; dy <= kReach; ++dy) {
        for (int dx = -kReach; dx <= kReach; ++dx) {
            if (extent.at(x + dx, y + dy) < 128)
                sum += Vec2(static_cast<float>(dx), static_cast<float>(dy));
        }
    }
    const float length = glm::length(sum);
    return length > 0 ? sum / length : Vec2(0);
}

}  // namespace weft
