#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace weft {

constexpr int kPatchRadius = 2;  // 5×5 pixels
constexpr int kPatchValues = 3 * (2 * kPatchRadius + 1) * (2 * kPatchRadius + 1);

/// Sum of absolute differences of two 8-bit RGB patches around the pixels `a` and `b`, which lie at
/// least kPatchRadius from the border. Stops early once it is not below `best`. Strides in
/// elements.
[[nodiscard]] inline int patch_difference(const std::uint8_t* a, std::ptrdiff_t a_stride,
                                          const std::uint8_t* b, std::ptrdiff_t b_stride,
                                          int best) {
    int sum = 0;
    for (int v = -kPatchRadius; v <= kPatchRadius && sum < best; ++v) {
        const std::uint8_t* p = a + v * a_stride - 3 * kPatchRadius;
        const std::uint8_t* q = b + v * b_stride - 3 * kPatchRadius;
        for (int i = 0; i < 3 * (2 * kPatchRadius + 1); ++i)
            sum += std::abs(p[i] - q[i]);
    }
    return sum;
}

}  // namespace weft
