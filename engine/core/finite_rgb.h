#pragma once
#include <cmath>

namespace weft {

/// Whether three values in a row (R, G, B) are all finite.
[[nodiscard]] inline bool finite_rgb(const float* p) {
    return std::isfinite(p[0] + p[1] + p[2]);
}

}  // namespace weft
