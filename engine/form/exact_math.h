#pragma once
// Functions by way of long double, so that results are the same on every machine: see
// docs/decisions/0002-determinism.md.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {

[[nodiscard]] inline double ln(double v) {
    return static_cast<double>(std::log(static_cast<long double>(v)));
}

[[nodiscard]] inline double exponential(double v) {
    return static_cast<double>(std::exp(static_cast<long double>(v)));
}

/// Of a cosine that may be off by rounding.
[[nodiscard]] inline double degrees_of_cosine(double c) {
    return static_cast<double>(std::acos(static_cast<long double>(std::clamp(c, -1.0, 1.0))) * 180 /
                               std::numbers::pi_v<long double>);
}

}  // namespace weft
