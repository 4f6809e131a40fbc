#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace weft {

/// The upper median, or `none` if there are no values. Reorders them.
inline float median_of(std::vector<float>& values, float none) {
    if (values.empty()) return none;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// A median of absolute values as the standard deviation of a normal distribution.
constexpr float kDeviationOfMedian = 1.4826f;

}  // namespace weft
