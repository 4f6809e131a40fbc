#pragma once
// Internal: coverage as mattes hold it.

#include <cstddef>
#include <cstdint>

#include "engine/core/image.h"

namespace weft {

/// The code of a coverage, 0–1; NaN becomes 0.
[[nodiscard]] inline std::uint8_t matte_code(float coverage) {
    if (!(coverage > 0.0f)) return 0;
    return coverage >= 1.0f ? std::uint8_t{255}
                            : static_cast<std::uint8_t>(coverage * 255.0f + 0.5f);
}

inline void invert_matte(Matte& matte) {
    std::uint8_t* const p = matte.data();
    for (std::size_t i = 0; i < matte.size_bytes(); ++i)
        p[i] = static_cast<std::uint8_t>(255 - p[i]);
}

}  // namespace weft
