#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace weft {

/// The value below which `share` of the values lie. There is at least one; reorders them.
[[nodiscard]] inline float quantile(std::vector<float>& values, float share) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<float>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace weft
