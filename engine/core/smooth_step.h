#pragma once
#include <algorithm>

namespace weft {

/// 0 up to `low`, 1 from `high` on, and a smooth rise between (Hermite, 3t² − 2t³). low < high.
template <typename T>
[[nodiscard]] constexpr T smooth_step(T x, T low, T high) {
    const T t = std::clamp((x - low) / (high - low), T(0), T(1));
    return t * t * (T(3) - T(2) * t);
}

}  // namespace weft
