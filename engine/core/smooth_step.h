#pragma once
#include <algorithm>

namespace weft {

/// The smooth rise from 0 at t = 0 to 1 at t = 1 (Hermite, 3t² − 2t³); `t` from 0 to 1.
template <typename T>
[[nodiscard]] constexpr T smooth_rise(T t) {
    return t * t * (T(3) - T(2) * t);
}

/// 0 up to `low`, 1 from `high` on, and smooth_rise() between. low < high.
template <typename T>
[[nodiscard]] constexpr T smooth_step(T x, T low, T high) {
    return smooth_rise(std::clamp((x - low) / (high - low), T(0), T(1)));
}

}  // namespace weft
